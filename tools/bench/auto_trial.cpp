#include "bench/auto_trial.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>

#include "bench/line_file.h"
#include "bench/measure.h"
#include "bench/random_scenes.h"
#include "bench/trial_run.h"
#include "bench/wild_scenes.h"
#include "output/kept_frames.h"
#include "output/output_error.h"
#include "run/run.h"

namespace drape::bench {

namespace {

namespace fs = std::filesystem;

const SceneGenerator generators[] = {
    {"a", full_random_scene}, {"b", [](std::uint32_t seed, std::uint32_t index) { return wild_scene(seed, index); }}};

class Trial {
  public:
    Trial(const TrialRequest& request, const Device& device)
        : request_(request),
          device_(device),
          file_(fs::path(request.folder) / "scenes.jsonl", [this](const auto& line) {
              if (std::optional<TrialResult> result = parsed_trial(line)) known_[result->key] = std::move(*result);
          }) {}

    /// Throws Stopped.
    void run(TrialSummary& summary) {
        for (std::uint32_t k = 0; k < request_.count; ++k) {
            const std::uint32_t index = request_.first + k;
            const std::string key = key_of(index);
            if (const auto known = known_.find(key); known != known_.end()) {
                ++summary.kept_count;
                results_.push_back(known->second);
                continue;
            }
            if (request_.stopped()) throw Stopped{};
            run_scene(index, key);
            ++summary.run_count;
            say(k);
        }
    }

    const std::vector<TrialResult>& results() const { return results_; }

  private:
    std::string name_of(std::uint32_t index) const {
        return fmt::format("{}/{}/{}", request_.generator, request_.seed, index);
    }

    std::string key_of(std::uint32_t index) const {
        const DeviceInfo& device = device_.info();
        return run_key(std::vector<std::string>{
            program_hash(), device.uuid_text(), device.driver, device.driver_version, name_of(index),
            fmt::format("{}", request_.tolerance), request_.reference ? "reference" : ""});
    }

    void run_scene(std::uint32_t index, const std::string& key) {
        SceneDescription scene = find_generator(request_.generator)->scene(request_.seed, index);
        scene.solver.tolerance = request_.tolerance;
        TrialResult result = try_scene(device_, scene, request_.reference, [this] { return request_.stopped(); });
        result.name = name_of(index);
        result.key = key;
        file_.add(trial_line(result));
        results_.push_back(result);
    }

    void say(std::uint32_t done) const {
        const TrialResult& result = results_.back();
        std::string text = fmt::format("{}/{} {}: {}", done + 1, request_.count, result.name,
                                       spelling(trial_outcome_spellings, result.outcome));
        const auto number = [&](const char* name, const char* words) {
            if (const auto found = result.numbers.find(name); found != result.numbers.end())
                text += fmt::format(", {} {:.3g}", words, found->second);
        };
        number("worst_stretch_error", "stretch error");
        number("worst_spring", "worst spring");
        number("substeps_max", "substeps");
        number("error", "position error");
        number("wall_s", "seconds");
        request_.say(text);
    }

    const TrialRequest& request_;
    const Device& device_;
    std::map<std::string, TrialResult> known_;
    std::vector<TrialResult> results_;
    LineFile file_;
};

}  // namespace

const SceneGenerator* find_generator(const std::string& name) {
    const auto found = std::ranges::find(generators, name, &SceneGenerator::name);
    return found == std::end(generators) ? nullptr : &*found;
}

TrialSummary run_trial(const TrialRequest& request) {
    if (!find_generator(request.generator))
        throw UsageError(fmt::format("--generator: expected a or b, got '{}'", request.generator));
    const Device device(request.device, validation_if(request.validate));
    make_folder(request.folder);
    TrialSummary summary;
    Trial trial(request, device);
    try {
        trial.run(summary);
    } catch (const Stopped&) {
        summary.stopped = true;
        return summary;
    }
    const DeviceInfo& info = device.info();
    summary.text = fmt::format("drape {} on {} ({} {}), scenes {} to {} of generator {}, seed {}{}\n\n",
                               program_version(), info.name, info.driver, info.driver_version, request.first,
                               request.first + request.count - 1, request.generator, request.seed,
                               request.tolerance > 0 ? fmt::format(", tolerance {:g}", request.tolerance) : "");
    summary.text += trial_text(trial.results());
    summary.fails = trial_fails(trial.results());
    summary.validation_count = device.validation_count();
    return summary;
}

}  // namespace drape::bench
