#include "bench/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <set>

#include "output/json_text.h"

namespace drape::bench {

namespace {

std::string variable_name(const OrderClaim& claim) {
    return claim.variable == OrderClaim::Variable::size ? "N" : "substeps";
}

std::string order_subject(const OrderClaim& claim) {
    return fmt::format("{}{}, {}: {}{} against {}", claim.problem, claim.size ? fmt::format("/{}", claim.size) : "",
                       claim.family, claim.kind == OrderClaim::Kind::differences ? "differences of " : "", claim.metric,
                       variable_name(claim));
}

std::string number(double value) { return value == 0 ? "0" : fmt::format("{:.3g}", value); }

std::string passes_text(double passes) { return passes > 0 ? number(passes) : "-"; }

struct Column {
    const char *head, *metric;
};

/// Beside the problem's own error; one that no case has is left out.
constexpr Column motion_columns[] = {{"its worst", "worst_position"},  {"center", "center_error"},
                                     {"strain", "stretch_rms"},        {"true strain", "stretch_rms_reference"},
                                     {"stretch err", "stretch_error"}, {"worst frame", "worst_stretch_error"},
                                     {"worst spring", "worst_spring"}};

std::vector<Column> columns_of(const Problem& problem, const std::vector<const CaseResult*>& results) {
    std::vector<Column> columns{{"error", problem.metric.c_str()}};
    if (problem.timed)
        for (const Column& column : motion_columns)
            if (std::ranges::any_of(results, [&](const CaseResult* r) { return r->metrics.contains(column.metric); }))
                columns.push_back(column);
    return columns;
}

bool below_reference(const Problem& problem, const CaseResult& result) {
    const std::optional<double> error = result.metric(problem.metric), own = result.metric("reference_error");
    return error && own && *error < *own;
}

std::string case_row(const Problem& problem, const CaseResult& result, const std::vector<Column>& columns,
                     bool doubtful) {
    std::string text = fmt::format("{:<34}{:>9}{:>11.3f}{:>11.3f}", result.name, passes_text(result.passes),
                                   result.device.median, result.wall.median);
    for (const Column& column : columns) {
        const std::optional<double> value = result.metric(column.metric);
        text += fmt::format("{:>13}", value                                          ? number(*value)
                                      : result.diverged && &column == columns.data() ? "diverged"
                                                                                     : "-");
    }
    if (doubtful) text += "  time doubtful";
    if (below_reference(problem, result)) text += "  below the reference's own error";
    if (result.stiffness_share < 0.995) text += fmt::format("  softened to {:.2f}", result.stiffness_share);
    return text + "\n";
}

/// Sizes and families in the order they ran first, settings of a family by their passes.
void sort_by_family(std::vector<const CaseResult*>& results) {
    std::map<std::pair<std::uint32_t, std::string>, std::size_t> places;
    for (const CaseResult* result : results) places.try_emplace({result->size, result->family()}, places.size());
    std::ranges::stable_sort(results, {}, [&](const CaseResult* result) {
        return std::pair(places.at({result->size, result->family()}), result->passes);
    });
}

/// Sizes and settings of one problem.
std::string problem_table(const Problem& problem, const Report& report) {
    std::vector<const CaseResult*> results;
    for (const CaseResult& result : report.results)
        if (result.problem == problem.name) results.push_back(&result);
    if (results.empty()) return {};
    sort_by_family(results);
    const std::vector<Column> columns = columns_of(problem, results);
    std::string text = fmt::format("\n{} ({}, {})\n", problem.title, problem.metric, problem.unit);
    if (const auto note = report.notes.find(problem.name); note != report.notes.end()) text += note->second;
    text += fmt::format("{:<34}{:>9}{:>11}{:>11}", "case", "passes", "device ms", "wall ms");
    for (const Column& column : columns) text += fmt::format("{:>13}", column.head);
    text += "\n";
    for (const CaseResult* result : results)
        text += case_row(problem, *result, columns, report.doubtful.contains(result->name));
    return text;
}

/// The setting of any family that meets each target of a user's scene soonest.
std::string cheapest_text(const Report& report, const Problem& problem) {
    std::string text = "\nCheapest measured setting for a wanted error\n";
    double own_error = 0;
    for (const CaseResult& result : report.results)
        if (result.problem == problem.name)
            own_error = std::max(own_error, result.metric("reference_error").value_or(0));
    for (const Target& target : problem.targets) {
        const Soonest* best = nullptr;
        for (const Soonest& s : report.soonest)
            if (s.problem == problem.name && s.metric == target.metric && s.limit == target.limit && !s.name.empty() &&
                (!best || s.milliseconds < best->milliseconds))
                best = &s;
        const bool is_position = target.metric == problem.metric;
        text += fmt::format("  {:<20}{:>8}{:<3}", target.metric, number(target.limit), is_position ? " m" : "");
        if (is_position && target.limit < own_error)
            text += fmt::format("cannot be told: the reference's own error is {}\n", number(own_error));
        else if (!best)
            text += "no measured setting\n";
        else
            text +=
                fmt::format("{:<26}{:>10.3f} ms per frame, measured {}\n", best->name.substr(best->name.find('/') + 1),
                            best->milliseconds, number(best->measured));
    }
    return text;
}

std::string orders_text(const Report& report) {
    if (report.orders.empty()) return {};
    std::string text = "\nOrders of convergence (slope of the logarithms)\n";
    for (const OrderFit& fit : report.orders)
        text += fmt::format("{:<72}{:>8.2f}  expected {:g} +- {:g}: {}\n", order_subject(fit.claim), fit.slope,
                            fit.claim.expected, fit.claim.tolerance, fit.met ? "met" : "NOT MET");
    return text;
}

std::string limits_text(const Report& report) {
    if (report.limits.empty()) return {};
    std::string text = "\nLimits\n";
    for (const LimitCheck& check : report.limits)
        text += fmt::format("{:<34}{:<28}{:>10} of at most {:>9}: {}\n", check.name, check.metric,
                            number(check.measured), number(check.limit), check.met() ? "met" : "NOT MET");
    return text;
}

std::string soonest_text(const Report& report) {
    if (report.soonest.empty()) return {};
    std::string text =
        "\nSoonest measured setting that meets an error; times sooner, times fewer passes than relax's "
        "best\n";
    std::string before;
    for (const Soonest& s : report.soonest) {
        const std::string head = fmt::format("{} {}, {} at most {:g}", s.problem, s.size, s.metric, s.limit);
        if (head != before) text += head + "\n";
        before = head;
        if (s.name.empty()) {
            text += fmt::format("  {:<32}no measured setting\n", s.family);
            continue;
        }
        const auto ratio = [](double value) { return value > 0 ? fmt::format("{:.2f}x", value) : std::string("-"); };
        text += fmt::format("  {:<32}{:<26}{:>10.3f} ms{:>9} passes{:>12}{:>9}{:>9}\n", s.family,
                            s.name.substr(s.name.find('/') + 1), s.milliseconds, passes_text(s.passes),
                            number(s.measured), ratio(s.time_ratio), ratio(s.passes_ratio));
    }
    return text;
}

std::string auto_text(const Report& report) {
    if (report.auto_ratios.empty()) return {};
    std::string text = "\nWhat auto took, over the soonest measured setting that keeps its tolerance\n";
    for (const AutoRatio& a : report.auto_ratios)
        text += fmt::format("  {:<12}worst error {:>9} of {:>6}: {:<9}{:>9.3f} ms{:>8.2f}x  {}\n",
                            fmt::format("{} {}", a.problem, a.size), number(a.worst_error), number(a.tolerance),
                            a.met() ? "kept" : "NOT KEPT", a.milliseconds, a.ratio(),
                            a.best.empty() ? "no other setting keeps it" : a.best);
    return text;
}

Json::Value ratio_json(const AutoRatio& ratio) {
    Json::Value value = json_object({{"problem", ratio.problem},
                                     {"size", ratio.size},
                                     {"tolerance", ratio.tolerance},
                                     {"kept", ratio.met()},
                                     {"ms_per_frame", ratio.milliseconds}});
    if (std::isfinite(ratio.worst_error)) value["worst_stretch_error"] = ratio.worst_error;  // else it diverged
    if (ratio.best.empty()) return value;
    value["soonest"] = ratio.best;
    value["soonest_ms_per_frame"] = ratio.best_milliseconds;
    value["ratio"] = ratio.ratio();
    return value;
}

Json::Value fit_json(const OrderFit& fit) {
    const OrderClaim& claim = fit.claim;
    Json::Value value = json_object({{"problem", claim.problem},
                                     {"family", claim.family},
                                     {"metric", claim.metric},
                                     {"variable", variable_name(claim)},
                                     {"of_differences", claim.kind == OrderClaim::Kind::differences},
                                     {"slope", fit.slope},
                                     {"expected", claim.expected},
                                     {"tolerance", claim.tolerance},
                                     {"met", fit.met},
                                     {"points", points_json(fit.points)}});
    if (claim.size) value["size"] = claim.size;
    return value;
}

Json::Value limit_json(const LimitCheck& check) {
    return json_object({{"case", check.name},
                        {"metric", check.metric},
                        {"limit", check.limit},
                        {"measured", check.measured},
                        {"met", check.met()}});
}

Json::Value soonest_json(const Soonest& soonest) {
    Json::Value value = json_object({{"problem", soonest.problem},
                                     {"size", soonest.size},
                                     {"metric", soonest.metric},
                                     {"limit", soonest.limit},
                                     {"family", soonest.family},
                                     {"meets", !soonest.name.empty()}});
    if (soonest.name.empty()) return value;
    value["case"] = soonest.name;
    value["ms_per_frame"] = soonest.milliseconds;
    value["passes_per_frame"] = soonest.passes;
    value["measured"] = soonest.measured;
    if (soonest.passes_ratio > 0) value["relax_passes_over_these"] = soonest.passes_ratio;
    if (soonest.time_ratio > 0) value["relax_time_over_this"] = soonest.time_ratio;
    return value;
}

}  // namespace

void evaluate(Report& report) {
    report.doubtful = doubtful_times(report.results);
    report.orders = fit_orders(order_claims(), report.results);
    report.limits = check_limits(report.results);
    report.soonest = find_soonest(report.results, report.targets);
    report.auto_ratios = auto_ratios(report.results);
}

std::size_t missed_count(const Report& report) {
    const auto count = [](const auto& rows, auto met) {
        return static_cast<std::size_t>(std::ranges::count_if(rows, std::not_fn(met)));
    };
    return count(report.orders, &OrderFit::met) + count(report.limits, &LimitCheck::met) +
           count(report.auto_ratios, &AutoRatio::met);
}

std::string report_text(const Report& report, const std::vector<Problem>& problems) {
    std::string text = fmt::format("{}, {}\n", report.text(), report.created);
    if (!report.complete) text += "The budget of time left cases out.\n";
    for (const Problem& problem : problems) text += problem_table(problem, report);
    text += orders_text(report) + limits_text(report) + soonest_text(report) + auto_text(report);
    for (const Problem& problem : problems)
        if (problem.of_user) text += cheapest_text(report, problem);
    return text;
}

std::string report_json(const Report& report) {
    Json::Value value = report.json("drape bench accuracy 1");
    value["compared_with"] = Json::Value(Json::objectValue);
    for (const auto& [problem, note] : report.notes) value["compared_with"][problem] = note;
    value["results"] = json_array(report.results, json_of<CaseResult>);
    value["orders"] = json_array(report.orders, fit_json);
    value["limits"] = json_array(report.limits, limit_json);
    value["soonest"] = json_array(report.soonest, soonest_json);
    value["auto"] = json_array(report.auto_ratios, ratio_json);
    return json_text(value);
}

std::string report_csv(const Report& report) {
    std::vector<std::string> columns{"case",
                                     "problem",
                                     "size",
                                     "method",
                                     "substeps",
                                     "iterations",
                                     "passes_per_frame",
                                     "stiffness_share",
                                     "device_ms_per_frame",
                                     "device_ms_least",
                                     "device_ms_spread",
                                     "wall_ms_per_frame",
                                     "wall_ms_least",
                                     "wall_ms_spread",
                                     "time_doubtful",
                                     "diverged"};
    std::set<std::string> metrics;
    std::vector<Json::Value> rows;
    for (const CaseResult& result : report.results) {
        Json::Value& row = rows.emplace_back(json_of(result));
        row["case"] = result.name;
        row["time_doubtful"] = report.doubtful.contains(result.name);
        for (const auto& [name, value] : result.metrics) {
            row[name] = value;
            metrics.insert(name);
        }
    }
    columns.insert(columns.end(), metrics.begin(), metrics.end());
    return csv_table(rows, columns);
}

}  // namespace drape::bench
