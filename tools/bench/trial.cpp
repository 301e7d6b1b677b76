#include "bench/trial.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/benchmarks.h"
#include "bench/measure.h"
#include "bench/random_scenes.h"
#include "output/kept_frames.h"
#include "run/run.h"

namespace drape::bench {

namespace {

std::optional<double> number_of(const TrialResult& result, const std::string& name) {
    const auto found = result.numbers.find(name);
    return found == result.numbers.end() ? std::nullopt : std::optional(found->second);
}

bool is_impossible(const TrialResult& result) { return result.outcome == TrialOutcome::impossible; }
bool is_refused(const TrialResult& result) { return result.outcome != TrialOutcome::kept && !is_impossible(result); }
bool is_silent(const TrialResult& result) { return number_of(result, "missed_frames").value_or(0) > 0; }

struct Value {
    double value;
    std::string name;  ///< of the scene
};

using Measure = std::function<std::optional<double>(const TrialResult&)>;

/// Ascending, of the scenes that have it.
std::vector<Value> values_of(std::span<const TrialResult> results, const Measure& measure) {
    std::vector<Value> values;
    for (const TrialResult& result : results)
        if (const std::optional<double> value = measure(result)) values.push_back({*value, result.name});
    std::ranges::sort(values, {}, &Value::value);
    return values;
}

std::string distribution(const char* what, std::span<const TrialResult> results, const Measure& measure) {
    const std::vector<Value> values = values_of(results, measure);
    if (values.empty()) return {};
    const auto at = [&](double share) {
        return values[static_cast<std::size_t>(std::lround(share * static_cast<double>(values.size() - 1)))];
    };
    return fmt::format("{:<46}{:>6}{:>11.3g}{:>11.3g}{:>11.3g}{:>11.3g}  {}\n", what, values.size(),
                       values.front().value, at(0.5).value, at(0.9).value, values.back().value, values.back().name);
}

std::optional<double> ratio(const TrialResult& result, const char* over, const char* under) {
    const std::optional<double> a = number_of(result, over), b = number_of(result, under);
    return a && b && *b > 0 ? std::optional(*a / *b) : std::nullopt;
}

/// Only where the true error is one: above what the reference itself may be off.
std::optional<double> estimate_ratio(const TrialResult& result) {
    const std::optional<double> error = number_of(result, "error_at_end"), own = number_of(result, "reference_error");
    return error && own && *error > 3 * *own ? ratio(result, "stated_error", "error_at_end") : std::nullopt;
}

std::string distributions(std::span<const TrialResult> results) {
    const auto plain = [](const char* name) { return [name](const TrialResult& r) { return number_of(r, name); }; };
    const auto share = [](const char* over, const char* under) {
        return [=](const TrialResult& r) { return ratio(r, over, under); };
    };
    std::string text = fmt::format("\n{:<46}{:>6}{:>11}{:>11}{:>11}{:>11}\n", "over scenes", "count", "least", "median",
                                   "90 %", "worst");
    text += distribution("substeps per frame, mean of a scene", results, plain("substeps_mean"));
    text += distribution("substeps per frame, most", results, plain("substeps_max"));
    text += distribution("redone frames, share", results, share("redone_frames", "frames"));
    text += distribution("sensitive frames, share", results, share("sensitive_frames", "frames"));
    text += distribution("worst RMS stretch error, m/m", results, plain("worst_stretch_error"));
    text += distribution("worst spring, m/m", results, plain("worst_spring"));
    text += distribution("wall time, s per frame", results, share("wall_s", "frames"));
    text += distribution("RMS position error, m, mean over frames", results, plain("error"));
    text += distribution("RMS position error over the cloth's size, worst", results, share("worst_error", "size"));
    text += distribution("the reference's own error, m", results, plain("reference_error"));
    text += distribution("stated over true position error", results, estimate_ratio);
    text += distribution("time over the best fixed setting's", results, share("wall_s", "best_wall_s"));
    return text;
}

std::string tag_table(std::span<const TrialResult> results) {
    struct Row {
        std::size_t scenes = 0, refused = 0, silent = 0;
    };
    std::map<std::string, Row> rows;
    for (const TrialResult& result : results)
        for (const std::string& tag : result.tags) {
            Row& row = rows[tag];
            ++row.scenes;
            row.refused += is_refused(result) ? 1 : 0;
            row.silent += is_silent(result) ? 1 : 0;
        }
    std::string text = fmt::format("\n{:<20}{:>8}{:>10}{:>10}\n", "scenes with", "scenes", "refused", "silent");
    for (const auto& [tag, row] : rows)
        text += fmt::format("{:<20}{:>8}{:>10}{:>10}\n", tag, row.scenes, row.refused, row.silent);
    return text;
}

double share_of(std::span<const TrialResult> results, const std::function<bool(const TrialResult&)>& is) {
    return static_cast<double>(std::ranges::count_if(results, is)) /
           std::max<double>(static_cast<double>(results.size()), 1);
}

}  // namespace

bool trial_fails(std::span<const TrialResult> results) {
    return share_of(results, is_refused) > 0.01 || std::ranges::any_of(results, is_silent);
}

std::string trial_text(std::span<const TrialResult> results) {
    std::string text;
    for (const TrialResult& result : results)
        if (result.outcome != TrialOutcome::kept)
            text += fmt::format("{} {}: {}\n", result.name, spelling(trial_outcome_spellings, result.outcome),
                                result.reason);
    for (const TrialResult& result : results)
        if (is_silent(result))
            text += fmt::format(
                "{} silently missed in {:g} of {:g} frames: stretch error {:.3g} of {:g}, worst spring {:.3g}\n",
                result.name, result.numbers.at("missed_frames"), result.numbers.at("frames"),
                result.numbers.at("worst_stretch_error"), result.numbers.at("tolerance"),
                result.numbers.at("worst_spring"));
    text += distributions(results) + tag_table(results);
    const auto kept = [](const TrialResult& result) { return result.outcome == TrialOutcome::kept; };
    text += fmt::format(
        "\n{} scenes: {:.1f} % kept, {:.1f} % refused, {:.1f} % impossible (explicit micro-steps miss the limits there "
        "too), {:.1f} % with frames that were silently missed\n",
        results.size(), 100 * share_of(results, kept), 100 * share_of(results, is_refused),
        100 * share_of(results, is_impossible), 100 * share_of(results, is_silent));
    return text;
}

namespace {

SceneDescription scene_of(const TrialRequest& request, std::uint32_t index) {
    SceneDescription scene =
        request.generator == "a" ? full_random_scene(request.seed, index) : wild_scene(request.seed, index);
    scene.solver.tolerance = request.tolerance;
    return scene;
}

std::string name_of(const TrialRequest& request, std::uint32_t index) {
    return fmt::format("{}/{}/{}", request.generator, request.seed, index);
}

std::string progress_text(const TrialResult& result) {
    std::string text = fmt::format("{}: {}", result.name, spelling(trial_outcome_spellings, result.outcome));
    for (const auto& [name, words] : {std::pair{"worst_stretch_error", "stretch error"},
                                      {"worst_spring", "worst spring"},
                                      {"substeps_max", "substeps"},
                                      {"error", "position error"}})
        if (const auto number = number_of(result, name)) text += fmt::format(", {} {:.3g}", words, *number);
    return text;
}

}  // namespace

BenchSummary run_trial(const TrialRequest& request) {
    const Device device(request.device, validation_if(request.validate));
    make_folder(request.folder);
    const ReportHead head = report_head(device.info());
    ResultStore<TrialResult> store(std::filesystem::path(request.folder) / "scenes.jsonl");
    CaseLoop loop(request, std::nullopt, 1);
    for (std::uint32_t k = 0; k < request.count; ++k) loop.plan(1);
    std::vector<TrialResult> results;
    for (std::uint32_t k = 0; k < request.count; ++k) {
        const std::uint32_t index = request.first + k;
        const std::string key = run_key(
            std::vector<std::string>{program_hash(), device.info().uuid_text(), head.driver, name_of(request, index),
                                     fmt::format("{}", request.tolerance), request.reference ? "reference" : ""});
        const auto run = [&] {
            TrialResult result =
                try_scene(device, scene_of(request, index), request.reference, [&] { return request.stopped(); });
            result.name = name_of(request, index);
            return result;
        };
        if (auto result = loop.next(store, key, 1, run, progress_text)) results.push_back(std::move(*result));
    }
    BenchSummary summary = loop.summary();
    summary.text = fmt::format("{}, scenes {} to {} of generator {}, seed {}{}\n\n", head.text(), request.first,
                               request.first + request.count - 1, request.generator, request.seed,
                               request.tolerance > 0 ? fmt::format(", tolerance {:g}", request.tolerance) : "") +
                   trial_text(results);
    if (trial_fails(results))
        summary.missed = "method auto refused more than 1 % of the scenes, or handed out frames that miss their limits";
    summary.validation_count = device.validation_count();
    return summary;
}

}  // namespace drape::bench
