#include "sweep/sweep_folder.h"

#include <fmt/format.h>
#include <json/json.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "output/atomic_file.h"
#include "output/csv_text.h"
#include "output/json_file.h"
#include "output/json_text.h"
#include "output/manifest.h"
#include "run/run.h"
#include "sweep/dataset.h"

namespace drape::sweep {

namespace fs = std::filesystem;

namespace {

bool is_there(const fs::path& path) {
    std::error_code ignored;
    return fs::exists(path, ignored);
}

/// Returns the content of a file; nothing when it does not exist.
std::optional<std::string> content(const fs::path& path) {
    return is_there(path) ? std::optional(read_file(path)) : std::nullopt;
}

constexpr JsonRule record_rules[] = {{"/exit_code", JsonRule::Kind::whole_number},
                                     {"/message", JsonRule::Kind::text},
                                     {"/seconds", JsonRule::Kind::number},
                                     {"/values", JsonRule::Kind::object},
                                     {"/values/*", JsonRule::Kind::number}};

void make_folder(const fs::path& path) {
    std::error_code error;
    fs::create_directories(path, error);
    if (error) throw OutputError(fmt::format("cannot make '{}': {}", path.string(), error.message()));
}

/// Returns whether the folder contains anything except unfinished files of killed processes. These are removed, unless
/// they are so new that a process on another machine may be writing them.
bool holds_anything(const fs::path& folder) {
    bool found = false;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        const bool left = is_left_over(entry->path().filename().string());
        found = found || !left;
        std::error_code ignored;
        if (left && fs::file_time_type::clock::now() - entry->last_write_time(ignored) > std::chrono::minutes(1))
            fs::remove(entry->path(), ignored);
    }
    return found;
}

/// Statistics that a table of runs has: the largest of any frame and cloth.
constexpr std::string_view worst_values[] = {"stretch_max",   "stretch_rms",   "stretch_error_rms",
                                             "penetration_m", "speed_max_m_s", "motion_error_m_s"};

/// "flag/stretch_max" -> "stretch_max"
std::string_view without_cloth(std::string_view name) { return name.substr(name.find('/') + 1); }

std::map<std::string, double> manifest_values(const Json::Value& manifest) {
    std::map<std::string, double> values;
    for (const Json::Value& frame : manifest["statistics"])
        for (const std::string& key : frame.getMemberNames()) {
            const std::string_view name = without_cloth(key);
            if (std::ranges::find(worst_values, name) == std::end(worst_values)) continue;
            const auto [entry, is_new] = values.emplace(std::string(name) + "_worst", frame[key].asDouble());
            if (!is_new) entry->second = std::max(entry->second, frame[key].asDouble());
        }
    const Json::Value& frames = manifest["statistics"];
    if (!frames.empty()) {
        const Json::Value& last = frames[frames.size() - 1];
        for (const char* name : {"energy_j", "kinetic_energy_j"})
            if (last.isMember(name)) values[std::string(name) + "_last"] = last[name].asDouble();
    }
    values["frames"] = static_cast<double>(frames.size());
    for (const Json::Value& file : manifest["files"]) values["bytes"] += file["bytes"].asDouble();
    return values;
}

/// A value as a table has it: numbers as they are, words without the quotes of JSON.
std::string csv_value(const std::string& json) {
    const Json::Value value = *parse_json(json);
    return value.isNumeric() ? json : csv_text(value.isString() ? value.asString() : json);
}

}  // namespace

std::string JobRecord::status() const {
    if (done()) return "done";
    for (const ExitCodeRow& row : exit_code_rows)
        if (static_cast<int>(row.code) == exit_code) return row.name;
    return exit_code > 128 ? fmt::format("signal {}", exit_code - 128) : fmt::format("exit code {}", exit_code);
}

std::string Tally::text() const {
    std::string text =
        fmt::format("{} done, {} failed, {} missing; {:.1f} MB", done, failed.size(), missing.size(), bytes / 1e6);
    constexpr std::size_t most = 20;
    for (std::size_t i = 0; i < std::min(failed.size(), most); ++i)
        text += fmt::format("\n  run {}: {}: {}", failed[i].index, failed[i].status(), failed[i].message);
    if (failed.size() > most) text += fmt::format("\n  and {} more: results.csv lists all", failed.size() - most);
    return text;
}

SweepFolder::SweepFolder(const fs::path& path, const SweepSpec& spec, bool fresh) : path_(path), spec_(spec) {
    Json::Value json(Json::objectValue);
    json["format"] = "drape sweep 1";
    json["program_version"] = program_version();
    json["scene"] = spec.scene;
    json["scene_hash"] = xxh3_128_hex(content(spec.scene).value_or(""));
    json["count"] = spec.count;
    json["specification"] = parse_json(spec.text).value_or(Json::Value(spec.text));
    const std::string text = json_text(json);
    const fs::path file = path_ / "sweep.json";
    auto there = content(file);
    const auto looks_foreign = [&] { return !there && holds_anything(path_) && !is_there(path_ / "jobs"); };
    // Another job of the sweep may be making the folder just now.
    for (int wait = 0; wait < 20 && looks_foreign(); ++wait, there = content(file))
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    if (there && *there != text)
        throw OutputError(
            fmt::format("'{}' is another sweep's: its specification, scene or program differs", path.string()));
    if (fresh && holds_anything(path_ / "jobs"))
        throw OutputError(fmt::format("'{}' has runs already: --resume goes on with it", path.string()));
    if (looks_foreign()) throw OutputError(fmt::format("'{}' is not empty, and no sweep", path.string()));
    // The file that says whose folder it is comes first: without room for the rest the sweep can still go on.
    make_folder(path_);
    if (!there) write_file(file, text);
    for (const char* name : {"runs", "jobs"}) make_folder(path_ / name);
}

std::string SweepFolder::number(std::uint32_t index) const {
    return fmt::format("{:0{}}", index, std::max<std::size_t>(4, fmt::formatted_size("{}", spec_.count - 1)));
}

fs::path SweepFolder::trajectory(std::uint32_t index) const {
    return path_ / "dataset" / fmt::format("trajectory_{}.npz", number(index));
}

bool SweepFolder::has_trajectory(std::uint32_t index) const { return is_there(trajectory(index)); }

void SweepFolder::remove_logs_of_processes() const {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(path_ / "jobs", error))
        if (entry.path().extension() == ".log" && entry.path().stem().string().find('-') != std::string::npos)
            fs::remove(entry.path(), error);
}

std::optional<JobRecord> SweepFolder::record(std::uint32_t index) const {
    const fs::path file = path_ / "jobs" / (number(index) + ".json");
    if (!is_there(file)) return std::nullopt;
    const Json::Value json = read_json(file, record_rules);
    JobRecord record{index, static_cast<int>(json["exit_code"].asUInt()), json["message"].asString(),
                     json["seconds"].asDouble()};
    for (const std::string& name : json["values"].getMemberNames())
        record.values[name] = json["values"][name].asDouble();
    return record;
}

void SweepFolder::write(JobRecord record, bool dataset) const {
    if (const fs::path run = run_folder(record.index); is_there(run / manifest_file_name))
        record.values = manifest_values(read_manifest(run));
    if (dataset && record.done()) {
        make_folder(path_ / "dataset");
        give_file(run_folder(record.index) / "trajectory.npz", trajectory(record.index));
    }
    Json::Value json(Json::objectValue);
    json["index"] = record.index;
    json["status"] = record.status();
    json["exit_code"] = record.exit_code;
    if (spec_.split) json["part"] = std::string(spec_.part_of(record.index));
    json["message"] = record.message;
    json["seconds"] = record.seconds;
    json["parameters"] = Json::Value(Json::objectValue);
    for (const auto& [pointer, value] : spec_.parameters_of(record.index))
        json["parameters"][pointer] = *parse_json(value);
    json["values"] = Json::Value(Json::objectValue);
    for (const auto& [name, value] : record.values) json["values"][name] = value;
    write_file(path_ / "jobs" / (number(record.index) + ".json"), json_text(json));
}

Tally SweepFolder::collect(bool dataset) const {
    Tally tally;
    std::vector<JobRecord> records;
    std::map<std::string, bool> names;
    for (std::uint32_t index = 0; index < spec_.count; ++index) {
        const auto found = record(index);
        if (!found) {
            tally.missing.push_back(index);
            continue;
        }
        for (const auto& [name, value] : found->values) {
            names[name];
            if (name == "bytes") tally.bytes += value;
        }
        if (found->done())
            ++tally.done;
        else
            tally.failed.push_back(*found);
        records.push_back(*found);
    }
    std::string csv = spec_.split ? "index,status,exit_code,message,part" : "index,status,exit_code,message";
    for (const auto& [pointer, distribution] : spec_.parameters) csv += "," + csv_text(pointer);
    for (const auto& [name, unused] : names) csv += "," + csv_text(name);
    csv += ",seconds\n";
    for (const JobRecord& job : records) {
        csv += fmt::format("{},{},{},{}", job.index, job.status(), job.exit_code, csv_text(job.message));
        if (spec_.split) csv += fmt::format(",{}", spec_.part_of(job.index));
        for (const auto& [pointer, value] : spec_.parameters_of(job.index)) csv += "," + csv_value(value);
        for (const auto& [name, unused] : names) {
            const auto value = job.values.find(name);
            csv += value == job.values.end() ? "," : fmt::format(",{}", value->second);
        }
        csv += fmt::format(",{:.3f}\n", job.seconds);
    }
    write_file(path_ / "results.csv", csv);
    if (dataset) describe_dataset();
    return tally;
}

void SweepFolder::describe_dataset() const {
    if (const fs::path folder = path_ / "dataset"; is_there(folder) && !is_there(folder / "meta.json"))
        write_meta(folder, spec_);
}

}  // namespace drape::sweep
