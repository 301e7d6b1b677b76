#include "profile/profile_report.h"

#include <fmt/format.h>
#include <json/value.h>

#include <algorithm>

#include "graph/dump.h"
#include "output/json_text.h"

namespace drape::profile {

namespace {

/// Returns what the declarations say of a row of passes; nothing of other rows, or where substeps differ from frame to
/// frame.
const PassWork* work_of(const Profile& profile, const Row& row) {
    if (!profile.passes || profile.substeps_vary) return nullptr;
    const auto found = std::ranges::find(profile.work, row.name, &PassWork::name);
    return found == profile.work.end() ? nullptr : &*found;
}

/// Returns bytes or operations per second.
double rate(double amount, double milliseconds) { return milliseconds > 0 ? amount / (1e-3 * milliseconds) : 0; }
double byte_rate(const PassWork& work, double milliseconds) {
    return rate(static_cast<double>(work.bytes), milliseconds);
}

std::string work_text(const Profile& profile, const Row& row, double median) {
    const PassWork* work = work_of(profile, row);
    if (!work || median == 0) return {};
    const double bytes = byte_rate(*work, median);
    std::string text = fmt::format("{:>7}{:>12}{:>9.2f}", work->count, graph::size_text(work->bytes), 1e-9 * bytes);
    text += profile.copy_bandwidth > 0 ? fmt::format("{:>8.0f} %", 100 * bytes / profile.copy_bandwidth)
                                       : fmt::format("{:>10}", "-");
    if (work->flops > 0) text += fmt::format("{:>10.1f}{:>9.2f}", 1e-6 * work->flops, 1e-9 * rate(work->flops, median));
    return text;
}

std::string effort_text(const Profile& profile) {
    if (!profile.substeps_vary) return {};
    std::vector<double> substeps, attempts;
    for (const ProfiledFrame& frame : profile.frames) {
        substeps.push_back(frame.effort.substeps);
        attempts.push_back(frame.effort.attempts);
    }
    return fmt::format(
        "{:.3f} ms per frame on the host on average, frames done again included; device times are those of the attempt "
        "that was kept\nsubsteps per frame: median {:g}, most {:g}; attempts: most {:g}\n",
        mean_frame(profile), statistics_of(substeps).median, std::ranges::max(substeps), std::ranges::max(attempts));
}

std::string memory_text(const Profile& profile) {
    constexpr std::size_t shown = 12;
    std::string text = fmt::format("\nmemory: {} in all\n", graph::size_text(profile.memory_used));
    for (std::size_t k = 0; k < std::min(shown, profile.memory.size()); ++k)
        text += fmt::format("  {:<40}{:>12}\n", profile.memory[k].name, graph::size_text(profile.memory[k].bytes));
    if (profile.memory.size() > shown) {
        std::uint64_t rest = 0;
        for (std::size_t k = shown; k < profile.memory.size(); ++k) rest += profile.memory[k].bytes;
        text += fmt::format("  {:<40}{:>12}\n", fmt::format("{} more", profile.memory.size() - shown),
                            graph::size_text(rest));
    }
    return text;
}

Json::Value context(const Profile& profile) {
    Json::Value value;
    value["date"] = profile.created;
    value["executable"] = "drape " + profile.program_version;
    value["scene"] = profile.scene;
    value["device"] = profile.device;
    value["driver"] = profile.driver;
    value["solver"] = profile.solver;
    value["kernels"] = profile.kernels;
    value["draws"] = profile.draw;
    value["by"] = profile.passes ? "passes" : "stages";
    value["memory_bytes"] = Json::UInt64(profile.memory_used);
    if (profile.copy_bandwidth > 0) value["copy_bytes_per_second"] = profile.copy_bandwidth;
    return value;
}

Json::Value entry(const std::string& name, double milliseconds) {
    Json::Value value;
    value["run_name"] = name;
    value["real_time"] = value["cpu_time"] = milliseconds;
    value["time_unit"] = "ms";
    value["threads"] = 1;
    return value;
}

/// `work`: what the declarations say of the row, or null.
void add_row(const Row& row, const PassWork* work, Json::Value& list) {
    for (std::size_t k = 0; k < row.milliseconds.size(); ++k) {
        Json::Value value = entry(row.name, row.milliseconds[k]);
        value["name"] = row.name;
        value["run_type"] = "iteration";
        value["iterations"] = 1;
        value["repetitions"] = Json::UInt64(row.milliseconds.size());
        value["repetition_index"] = Json::UInt64(k);
        list.append(value);
    }
    const Statistics statistics = statistics_of(row.milliseconds);
    for (const auto& [aggregate, milliseconds] : {std::pair{"min", statistics.minimum},
                                                  {"median", statistics.median},
                                                  {"p95", statistics.p95},
                                                  {"p99", statistics.p99}}) {
        Json::Value value = entry(row.name, milliseconds);
        value["name"] = row.name + "_" + aggregate;
        value["run_type"] = "aggregate";
        value["aggregate_name"] = aggregate;
        value["aggregate_unit"] = "time";
        // As Google Benchmark has them: counters are members.
        if (work && aggregate == std::string("median")) {
            value["bytes_per_second"] = byte_rate(*work, milliseconds);
            if (work->flops > 0) value["flops_per_second"] = rate(work->flops, milliseconds);
        }
        list.append(value);
    }
}

Json::Value event(const char* phase, int track, const std::string& name) {
    Json::Value value;
    value["ph"] = phase;
    value["pid"] = 1;
    value["tid"] = track;
    value["name"] = name;
    return value;
}

Json::Value span(int track, const std::string& name, double begin, double seconds) {
    Json::Value value = event("X", track, name);
    value["ts"] = 1e6 * begin;
    value["dur"] = 1e6 * seconds;
    return value;
}

Json::Value track_name(int track, const char* name) {
    Json::Value value = event("M", track, "thread_name");
    value["args"]["name"] = name;
    return value;
}

}  // namespace

std::string profile_text(const Profile& profile) {
    std::string text = fmt::format("drape {} on {} ({}), {}, method {}, kernels {}, {} frames\n",
                                   profile.program_version, profile.device, profile.driver, profile.scene,
                                   profile.solver, profile.kernels, profile.frames.size());
    if (profile.frames.empty()) return text;
    const std::vector<Row> rows = rows_of(profile);
    std::size_t width = 8;
    for (const Row& row : rows) width = std::max(width, row.name.size());
    text += fmt::format("\n{:<{}}{:>10}{:>10}{:>10}{:>10}{:>12}", "ms per frame", width + 2, "min", "median", "p95",
                        "p99", "IQR/median");
    const bool work = std::ranges::any_of(rows, [&](const Row& row) { return work_of(profile, row) != nullptr; });
    if (work)
        text +=
            fmt::format("{:>7}{:>12}{:>9}{:>10}{:>10}{:>9}", "passes", "bytes", "GB/s", "of copy", "Mflop", "GFLOP/s");
    text += "\n";
    for (const Row& row : rows) {
        const Statistics s = statistics_of(row.milliseconds);
        text += fmt::format("{:<{}}{:>10.3f}{:>10.3f}{:>10.3f}{:>10.3f}{:>10.0f} %{}\n", row.name, width + 2, s.minimum,
                            s.median, s.p95, s.p99, 100 * s.spread, work_text(profile, row, s.median));
    }
    if (rows.size() < 2) text += "device times: unavailable (the device has no timestamps)\n";
    if (profile.copy_bandwidth > 0) text += fmt::format("a copy moves {:.2f} GB/s\n", 1e-9 * profile.copy_bandwidth);
    return text + effort_text(profile) + memory_text(profile);
}

std::string profile_csv(const Profile& profile) {
    std::string text =
        "name,min_ms,median_ms,p95_ms,p99_ms,spread,passes,bytes,bytes_per_second,share_of_copy,flops,flops_per_"
        "second\n";
    if (profile.frames.empty()) return text;
    for (const Row& row : rows_of(profile)) {
        const Statistics s = statistics_of(row.milliseconds);
        text +=
            fmt::format("{},{:.6g},{:.6g},{:.6g},{:.6g},{:.4g}", row.name, s.minimum, s.median, s.p95, s.p99, s.spread);
        const PassWork* work = work_of(profile, row);
        if (!work) {
            text += ",,,,,,\n";
            continue;
        }
        const double bytes = byte_rate(*work, s.median);
        text += fmt::format(",{},{},{:.6g},", work->count, work->bytes, bytes);
        if (profile.copy_bandwidth > 0) text += fmt::format("{:.4g}", bytes / profile.copy_bandwidth);
        text += work->flops > 0 ? fmt::format(",{:.6g},{:.6g}\n", work->flops, rate(work->flops, s.median)) : ",,\n";
    }
    return text;
}

std::string profile_json(const Profile& profile) {
    Json::Value value;
    value["context"] = context(profile);
    value["benchmarks"] = Json::Value(Json::arrayValue);
    if (!profile.frames.empty())
        for (const Row& row : rows_of(profile)) add_row(row, work_of(profile, row), value["benchmarks"]);
    return json_text(value);
}

std::string profile_trace(const Profile& profile) {
    constexpr int host = 1, device = 2;
    Json::Value events(Json::arrayValue);
    events.append(track_name(host, "host: frames"));
    events.append(track_name(device, "device"));
    for (const ProfiledFrame& frame : profile.frames) {
        Json::Value whole = span(host, fmt::format("frame {}", frame.frame), frame.begin, frame.end - frame.begin);
        whole["args"]["substeps"] = frame.effort.substeps;
        whole["args"]["attempts"] = frame.effort.attempts;
        events.append(whole);
        double at = frame.end;
        for (const StageTime& time : frame.device) at -= 1e-3 * time.milliseconds;
        for (const StageTime& time : frame.device) {
            events.append(span(device, time.name, at, 1e-3 * time.milliseconds));
            at += 1e-3 * time.milliseconds;
        }
    }
    Json::Value value;
    value["displayTimeUnit"] = "ms";
    value["traceEvents"] = events;
    return json_text(value);
}

}  // namespace drape::profile
