#include "bench/speed_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "bench/claims.h"
#include "solver/kernel_choice.h"

namespace drape::bench {

const SpeedTime* SpeedResult::find(const std::string& name) const {
    const auto found = std::ranges::find(times, name, &SpeedTime::name);
    return found == times.end() ? nullptr : &*found;
}

double SpeedResult::ratio(const std::string& name, const std::string& to) const {
    const SpeedTime *above = find(name), *below = find(to);
    return above && below && below->statistics.median > 0 ? above->statistics.median / below->statistics.median : 0;
}

std::vector<ScalingFit> fit_scaling(const std::vector<SpeedResult>& results) {
    constexpr std::uint32_t least_size = 64;  // smaller cloths pay for dispatches
    std::vector<ScalingFit> fits;
    for (const SpeedResult& result : results) {
        const SpeedCase& about = result.about;
        if (about.kind != SpeedKind::solve || about.colliders > 0) continue;
        const bool of_cloths = about.cloths > 1;
        if (!of_cloths && about.size < least_size) continue;
        for (const SpeedTime& time : result.times) {
            const auto same = [&](const ScalingFit& fit) { return fit.group == about.group && fit.time == time.name; };
            auto fit = std::ranges::find_if(fits, same);
            if (fit == fits.end())
                fit = fits.insert(fits.end(), {about.group, time.name, of_cloths ? "cloths" : "particles", {}});
            fit->points.push_back(
                {of_cloths ? about.cloths : about.particles(), time.statistics.median / about.substeps()});
        }
    }
    std::erase_if(fits, [](ScalingFit& fit) {
        const std::optional<double> slope = log_slope(fit.points);
        fit.exponent = slope.value_or(0);
        return fit.points.size() < 3 || !slope;
    });
    return fits;
}

std::vector<MeasuredCost> fit_costs(const std::vector<SpeedResult>& results) {
    std::vector<MeasuredCost> costs;
    for (const SolverMethodName& method : solver_method_names) {
        // t = a + b x, each equation over t: the sums of the normal equations.
        double count = 0, ones = 0, mixed = 0, squares = 0, right = 0, right_x = 0;
        for (const SpeedResult& result : results) {
            const SpeedTime* time = result.find("frame");
            if (result.about.kind != SpeedKind::kernels || result.about.method != method.method ||
                result.about.cloths > 1 || !time)
                continue;
            const double t = time->statistics.median / result.about.substeps(), x = result.about.particles();
            ++count, ones += 1 / (t * t), mixed += x / (t * t), squares += x * x / (t * t);
            right += 1 / t, right_x += x / t;
        }
        const double determinant = ones * squares - mixed * mixed;
        if (count < 2 || !(determinant > 0)) continue;
        costs.push_back({method.method,
                         {(right * squares - right_x * mixed) / determinant,
                          1e6 * (right_x * ones - right * mixed) / determinant}});
    }
    return costs;
}

namespace {

double per_substep(const SpeedResult& result, const char* name) {
    const SpeedTime* time = result.find(name);
    return time ? time->statistics.median / result.about.substeps() : 0;
}

std::string number(double value, int width, int digits) {
    return value > 0 ? fmt::format("{:>{}.{}f}", value, width, digits) : fmt::format("{:>{}}", "-", width);
}

bool is_doubtful(const SpeedResult& result) { return std::ranges::any_of(result.times, &SpeedTime::doubtful); }

const char* mark(const SpeedResult& result) { return is_doubtful(result) ? "  time doubtful" : ""; }

/// An amount of a solver case per second of the device's time, or of the frame's where that is not known.
double rate(const SpeedResult& result, double amount) {
    const SpeedTime* time = result.find(result.find("device") ? "device" : "frame");
    return time && time->statistics.median > 0 ? amount / (1e-3 * time->statistics.median) : 0;
}

/// The milliseconds in which a copy between buffers moves as many bytes as a frame of a solver case declares; 0: not
/// known.
double copy_time(const SpeedReport& report, const SpeedResult& result) {
    return report.copy_bandwidth > 0 ? 1e3 * result.bytes / report.copy_bandwidth : 0;
}

std::string solver_table(const SpeedReport& report) {
    std::string text =
        "\nSolvers, ms per substep (medians), beside the device's own and those of a copy of as many bytes\n";
    text += fmt::format("{:<24}{:>11}{:>11}{:>11}{:>10}{:>9}{:>8}{:>9}{:>9}{:>7}\n", "case", "Drape", "device", "copy",
                        "/ device", "ns/part.", "GB/s", "of copy", "GFLOP/s", "IQR");
    bool any = false;
    for (const SpeedResult& r : report.results) {
        if (r.about.kind != SpeedKind::solve) continue;
        any = true;
        const double copy = copy_time(report, r), bytes = rate(r, r.bytes);
        text += fmt::format("{:<24}", r.about.name);
        text += number(per_substep(r, "frame"), 11, 4) + number(per_substep(r, "device"), 11, 4);
        text += number(copy / r.about.substeps(), 11, 4) + number(r.ratio("frame", "device"), 10, 2);
        text += number(1e6 * per_substep(r, "frame") / r.about.particles(), 9, 1) + number(1e-9 * bytes, 8, 1);
        text += copy > 0 ? number(100 * bytes / report.copy_bandwidth, 7, 0) + " %" : fmt::format("{:>9}", "-");
        text += number(1e-9 * rate(r, r.flops), 9, 1);
        const SpeedTime* frame = r.find("frame");
        text += fmt::format("{:>5.0f} %{}\n", frame ? 100 * frame->statistics.spread : 0, mark(r));
    }
    return any ? text : std::string();
}

/// Every time of pictures or starts by its name.
std::string parts_table(const SpeedReport& report, SpeedKind kind, const char* head) {
    std::string text;
    for (const SpeedResult& r : report.results) {
        if (r.about.kind != kind) continue;
        text += r.about.name + "\n";
        for (const SpeedTime& time : r.times)
            text += fmt::format("  {:<30}{:>10.2f}{:>10.2f}{:>5.0f} %{}\n", time.name, time.statistics.median,
                                time.statistics.minimum, 100 * time.statistics.spread,
                                time.doubtful() ? "  time doubtful" : "");
    }
    return text.empty() ? text
                        : fmt::format("\n{}\n{:<32}{:>10}{:>10}{:>7}\n", head, "ms", "median", "min", "IQR") + text;
}

std::string skip_table(const SpeedReport& report) {
    std::string text;
    for (const SpeedResult& r : report.results) {
        const SpeedTime *with = r.find("frame"), *without = r.find("without");
        if (r.about.kind != SpeedKind::skip || !with || !without) continue;
        text += fmt::format("{:<24}{:>9.2f}{:>9.2f}{:>8.0f} %  {}{}\n", r.about.name, with->statistics.median,
                            without->statistics.median, 100 * (1 - r.ratio("frame", "without")), r.note, mark(r));
    }
    return text.empty()
               ? text
               : "\nSkips, ms per frame with and without\n" +
                     fmt::format("{:<24}{:>9}{:>9}{:>10}  {}\n", "case", "with", "without", "saved", "of") + text;
}

/// The time of a case that is the shortest, apart from "frame", which is one of them again.
const SpeedTime& fastest(const SpeedResult& result) {
    return *std::ranges::min_element(result.times.begin() + 1, result.times.end(), {},
                                     [](const SpeedTime& time) { return time.statistics.median; });
}

std::string kernel_table(const SpeedReport& report) {
    std::string text;
    for (const SpeedResult& r : report.results) {
        if (r.about.kind != SpeedKind::kernels) continue;
        text += fmt::format("{:<32}", r.about.name);
        for (const KernelSet& set : all_kernel_sets)
            text += number(per_substep(r, std::string(set.name).c_str()), 14, 4);
        text += fmt::format("  {:<14}{:>6.2f}{}  {}\n", fastest(r).name, r.ratio("frame", fastest(r).name), mark(r),
                            r.note);
    }
    if (text.empty()) return text;
    std::string head = fmt::format("\nKernels, ms per substep (medians); taken: by `auto`\n{:<32}", "case");
    for (const KernelSet& set : all_kernel_sets) head += fmt::format("{:>14}", set.name);
    return head + fmt::format("  {:<14}{:>6}  {}\n", "fastest", "ratio", "taken") + text;
}

std::string cost_table(const SpeedReport& report) {
    std::string text;
    for (const MeasuredCost& measured : fit_costs(report.results)) {
        text += fmt::format("{:<12}{:>12.4f}{:>12.3f}", named(measured.method).name, measured.cost.ms,
                            measured.cost.particle_ns);
        for (const DeviceKind kind : {DeviceKind::cpu, DeviceKind::gpu}) {
            const SubstepCost& known = costs_of(kind).of(measured.method);
            text += fmt::format("{:>14.4f}{:>12.3f}", known.ms, known.particle_ns);
        }
        text += "\n";
    }
    if (text.empty()) return text;
    return fmt::format(
               "\nCosts of a bare substep: ms, and ns for each particle; on kinds of devices: what `auto` goes by\n"
               "{:<12}{:>12}{:>12}{:>14}{:>12}{:>14}{:>12}\n",
               "method", "measured", "", "on a CPU", "", "on a GPU", "") +
           text;
}

std::string fit_table(const SpeedReport& report) {
    std::string text;
    for (const ScalingFit& fit : fit_scaling(report.results))
        text += fmt::format("{:<28}{:<20}{:>6.2f}  of {}, {:.4g} to {:.4g}\n", fit.group, fit.time, fit.exponent,
                            fit.variable, fit.points.front()[0], fit.points.back()[0]);
    return text.empty() ? text : "\nScaling: exponents of the times\n" + text;
}

/// Cloth frames a second of ensembles, and of processes, one on each core.
std::string ensemble_table(const SpeedReport& report) {
    std::string text;
    for (const SpeedResult& result : report.results) {
        if (result.about.kind != SpeedKind::ensemble) continue;
        const auto median = [&](const char* name) {
            const SpeedTime* const time = result.find(name);
            return time ? time->statistics.median : 0;
        };
        const double together = 1e3 * result.about.cloths / median("frame");
        const double processes = 1e3 * report.cores / median("alone");
        text += fmt::format("{:<28}{:>12.3f}{:>12.3f}{:>16.0f}{:>16.0f}{:>10.2f}\n", result.about.name, median("frame"),
                            median("device"), together, processes, together / processes);
    }
    if (text.empty()) return text;
    return fmt::format(
               "\nEnsembles: ms a step, and cloth frames a second beside processes, one on each core\n"
               "{:<28}{:>12}{:>12}{:>16}{:>16}{:>10}\n",
               "case", "step", "device", "together", "processes", "ratio") +
           text;
}

const char* kind_name(SpeedKind kind) {
    constexpr const char* names[] = {"solve", "picture", "skip", "start", "kernels", "ensemble"};
    return names[static_cast<std::size_t>(kind)];
}

/// The case and how much it works.
Json::Value about_json(const SpeedCase& about) {
    return json_object({{"case", about.name},
                        {"kind", kind_name(about.kind)},
                        {"method", std::string(named(about.method).name)},
                        {"particles", about.particles()},
                        {"substeps_per_frame", about.substeps()},
                        {"cloths", about.cloths},
                        {"colliders", about.colliders}});
}

Json::Value time_json(const SpeedResult& result, const SpeedTime& time) {
    const profile::Statistics& s = time.statistics;
    Json::Value value = json_object({{"min", s.minimum},
                                     {"median", s.median},
                                     {"p95", s.p95},
                                     {"iqr_over_median", s.spread},
                                     {"doubtful", time.doubtful()}});
    const double ratio = result.ratio("frame", time.name);
    if (time.name != "frame" && ratio > 0) value["frame_over_this"] = ratio;
    return value;
}

Json::Value result_json(const SpeedResult& result) {
    Json::Value value = about_json(result.about);
    if (result.about.kind == SpeedKind::skip)
        for (const char* name : {"method", "particles", "substeps_per_frame", "cloths", "colliders"})
            value.removeMember(name);
    if (!result.note.empty()) value[result.about.kind == SpeedKind::kernels ? "taken" : "skipped"] = result.note;
    if (result.bytes > 0) value["bytes_per_frame"] = result.bytes;
    if (result.flops > 0) value["flops_per_frame"] = result.flops;
    for (const SpeedTime& time : result.times) value["ms"][time.name] = time_json(result, time);
    return value;
}

Json::Value scaling_json(const ScalingFit& fit) {
    return json_object({{"group", fit.group},
                        {"time", fit.time},
                        {"variable", fit.variable},
                        {"exponent", fit.exponent},
                        {"ms_per_substep", points_json(fit.points)}});
}

/// Points of one time of a group.
plot::Curve curve_of(const std::vector<const SpeedResult*>& group, const char* time, const std::string& name,
                     bool per_particle) {
    plot::Curve curve{name};
    for (const SpeedResult* r : group) {
        const SpeedTime* found = r->find(time);
        if (!found) continue;
        const double ms = per_substep(*r, time);
        curve.points.push_back(per_particle ? std::array{r->about.particles(), 1e6 * ms / r->about.particles()}
                                            : std::array{double(r->about.variable), ms});
        curve.doubtful.push_back(found->doubtful());
    }
    return curve;
}

std::string file_name(const std::string& group) {
    std::string name = "speed_" + group + ".svg";
    std::erase(name, ',');
    std::ranges::replace(name, ' ', '_');
    return name;
}

}  // namespace

std::string speed_text(const SpeedReport& report) {
    std::string text = fmt::format("{}, {} cores, {}\n", report.text(), report.cores, report.created);
    if (report.copy_bandwidth > 0) text += fmt::format("a copy moves {:.2f} GB/s\n", 1e-9 * report.copy_bandwidth);
    if (!report.complete) text += "Cases were left out: by the budget of time, or for want of the shipped scenes.\n";
    return text + solver_table(report) + kernel_table(report) + cost_table(report) + fit_table(report) +
           ensemble_table(report) +
           parts_table(report, SpeedKind::picture, "Pictures of 64x64 particles, 1280x720, ms per frame") +
           skip_table(report) + parts_table(report, SpeedKind::start, "Starts");
}

std::string speed_json(const SpeedReport& report) {
    Json::Value value = report.json("drape bench speed 1");
    value["cores"] = report.cores;
    if (report.copy_bandwidth > 0) value["copy_bytes_per_second"] = report.copy_bandwidth;
    value["cases"] = json_array(report.results, result_json);
    value["scaling"] = json_array(fit_scaling(report.results), scaling_json);
    return json_text(value);
}

std::string speed_csv(const SpeedReport& report) {
    std::vector<Json::Value> rows;
    for (const SpeedResult& result : report.results)
        for (const SpeedTime& time : result.times) {
            const profile::Statistics& s = time.statistics;
            Json::Value& row = rows.emplace_back(about_json(result.about));
            row["substeps"] = result.about.substeps();
            row["time"] = time.name;
            row["min_ms"] = s.minimum, row["median_ms"] = s.median, row["p95_ms"] = s.p95;
            row["iqr_over_median"] = s.spread, row["doubtful"] = time.doubtful();
            if (const double ratio = result.ratio("frame", time.name); ratio > 0) row["frame_over_this"] = ratio;
        }
    return csv_table(rows, {"case", "kind", "particles", "substeps", "cloths", "colliders", "time", "min_ms",
                            "median_ms", "p95_ms", "iqr_over_median", "doubtful", "frame_over_this"});
}

plot::Plots speed_plots(const SpeedReport& report) {
    std::vector<std::pair<std::string, std::vector<const SpeedResult*>>> groups;
    for (const SpeedResult& r : report.results) {
        if (r.about.kind != SpeedKind::solve) continue;
        auto group = std::ranges::find(groups, r.about.group, [](const auto& each) { return each.first; });
        if (group == groups.end()) group = groups.insert(groups.end(), {r.about.group, {}});
        group->second.push_back(&r);
    }
    plot::Plots plots;
    for (const auto& [name, group] : groups) {
        if (group.size() < 2) continue;
        const bool of_sheets = group[0]->about.cloths == 1 && group[0]->about.colliders == 0;
        const bool of_cloths = group[0]->about.cloths > 1;
        plot::Plot plot{"Speed: " + name,
                        of_sheets   ? "particles"
                        : of_cloths ? "cloths"
                                    : "colliders",
                        of_sheets ? "ns per particle and substep" : "ms per substep"};
        plot.curves.push_back(curve_of(group, "frame", "Drape", of_sheets));
        plot.curves.push_back(curve_of(group, "device", "device", of_sheets));
        std::erase_if(plot.curves, [](const plot::Curve& curve) { return curve.points.empty(); });
        plots.emplace_back(file_name(name), plot);
    }
    return plots;
}

}  // namespace drape::bench
