#include "output/manifest.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <json/value.h>

#include <algorithm>
#include <cmath>

#include "output/json_file.h"
#include "output/json_text.h"

namespace drape {

namespace {

constexpr std::size_t write_size = std::size_t{1} << 16;

Json::Value texts(const std::vector<std::string>& values) {
    Json::Value array(Json::arrayValue);
    for (const std::string& value : values) array.append(value);
    return array;
}

Json::Value number(double value, const std::string& what) {
    if (!std::isfinite(value)) throw OutputError(fmt::format("manifest: {} is not a finite number ({})", what, value));
    return value;
}

Json::Value scene_json(const Manifest::Scene& scene) {
    Json::Value json;
    json["path"] = scene.path;
    json["name"] = scene.name;
    json["hash"] = scene.hash;
    json["overrides"] = texts(scene.overrides);
    return json;
}

Json::Value device_json(const Manifest::Device& device) {
    Json::Value json;
    json["name"] = device.name;
    json["driver"] = device.driver;
    json["driver_version"] = device.driver_version;
    json["api_version"] = device.api_version;
    json["uuid"] = device.uuid;
    return json;
}

Json::Value frames_json(const Manifest::Frames& frames) {
    Json::Value json;
    json["start"] = Json::Int64(frames.start);
    json["end"] = Json::Int64(frames.end);
    json["step"] = Json::Int64(frames.step);
    json["count"] = Json::UInt64(frames.count);
    json["fps"] = number(frames.fps, "frames.fps");
    return json;
}

Json::Value picture_json(const Manifest::Picture& picture) {
    Json::Value json;
    json["width"] = picture.width;
    json["height"] = picture.height;
    json["samples"] = picture.samples;
    if (!picture.view.empty()) json["view"] = picture.view;
    if (picture.strain_range > 0) json["strain_range"] = picture.strain_range;
    if (picture.motion_blur > 1) json["motion_blur"] = picture.motion_blur;
    if (!picture.camera) return json;
    const auto vector = [&json](const char* name, const Vec3& value) {
        for (const double part : value) json["camera"][name].append(number(part, name));
    };
    vector("position", picture.camera->position);
    vector("target", picture.camera->target);
    vector("up", picture.camera->up);
    json["camera"]["fov"] = picture.camera->fov;
    return json;
}

Json::Value files_json(const std::vector<FileRecord>& files) {
    Json::Value array(Json::arrayValue);
    for (const FileRecord& file : files) {
        Json::Value json;
        json["name"] = file.name;
        json["bytes"] = Json::UInt64(file.bytes);
        json["hash"] = file.hash;
        array.append(std::move(json));
    }
    return array;
}

Json::Value statistics_json(const Manifest::FrameStatistics& statistics) {
    Json::Value json;
    json["frame"] = Json::Int64(statistics.frame);
    for (const auto& [name, value] : statistics.values) {
        if (name == "frame") throw OutputError("manifest: a statistic may not be named 'frame'");
        json[name] = number(value, fmt::format("statistic '{}' of frame {}", name, statistics.frame));
    }
    return json;
}

Json::Value cuts_json(const std::vector<Manifest::Cut>& cuts) {
    Json::Value json(Json::arrayValue);
    for (const Manifest::Cut& cut : cuts) {
        Json::Value row(Json::objectValue);
        row["frame"] = Json::Int64{cut.frame};
        row["cloth"] = cut.cloth;
        row["springs"] = cut.spring_count;
        row["torn"] = cut.torn_count;
        row["triangles"] = cut.triangle_count;
        row["pieces"] = cut.piece_count;
        row["crumbs"] = cut.crumb_count;
        json.append(row);
    }
    return json;
}

Json::Value split_json(const std::vector<Manifest::SplitTriangles>& split) {
    Json::Value json(Json::arrayValue);
    for (const auto& [cloth, first_frame, count] : split) {
        Json::Value row(Json::objectValue);
        row["cloth"] = cloth;
        row["first_frame"] = Json::Int64{first_frame};
        row["triangles"] = Json::UInt64{count};
        json.append(row);
    }
    return json;
}

Json::Value beside_seams_json(const Manifest::SelfCollision& told) {
    Json::Value json(Json::arrayValue);
    for (const auto& [cloth, count, closing_count] : told.beside_seams) {
        Json::Value row(Json::objectValue);
        row["cloth"] = cloth;
        row["triangles"] = Json::UInt64{count};
        row["closing"] = Json::UInt64{closing_count};
        json.append(row);
    }
    return json;
}

/// Returns what seams leave out, after a comma or semicolon.
std::string beside_seams_text(const Manifest::SelfCollision& told) {
    std::uint64_t count = 0, closing_count = 0;
    for (const Manifest::SeamTriangles& each : told.beside_seams) {
        count += each.count;
        closing_count += each.closing_count;
    }
    std::string text;
    if (count > 0) text = fmt::format("; not covered: {} triangles beside seams of unlike sides", count);
    if (closing_count > 0)
        text += fmt::format("; not covered: {} triangles beside seams that close, the last at {:.4g} s", closing_count,
                            told.seams_close);
    return text;
}

/// Returns the proof of the triangles that meet others.
std::string proof_text(const Manifest::SelfCollision& told) {
    std::string met = !told.not_covered.empty()    ? "no crossing of whole triangles in any substep"
                      : !told.beside_seams.empty() ? "no crossing of covered triangles in any substep"
                                                   : "no crossing in any substep";
    if (told.first_unproved == 0u)
        met = "not proved from frame 0 on: a cloth started through itself";
    else if (told.first_unproved)
        met = fmt::format(
            "not proved from frame {} on: a held particle moved farther than was shown to cross nothing, or cloth "
            "touched",
            *told.first_unproved);
    if (told.crossed.empty()) return met;
    if (told.apart_since)
        return fmt::format(
            "not proved before frame {}: cloths that started through each other have come apart; since then, and of "
            "the others: {}",
            *told.apart_since, met);
    return "not proved from frame 0 on: cloths that started through each other do not meet; of the others: " + met;
}

std::string certificate_of(const Manifest::SelfCollision& told) {
    const std::string seams = beside_seams_text(told);
    if (told.not_covered.empty()) return proof_text(told) + seams;
    return fmt::format("{}; not covered: {} that were split from frame {} on{}", proof_text(told),
                       triangles_text(told.not_covered), told.not_covered.front().first_frame, seams);
}

Json::Value self_collision_json(const Manifest::SelfCollision& told) {
    Json::Value json(Json::objectValue);
    for (const std::string& cloth : told.cloths) json["cloths"].append(cloth);
    json["between_cloths"] = told.between_cloths;
    json["proved"] = !told.first_unproved && told.crossed.empty();
    json["certificate"] = certificate_of(told);
    for (const auto& [one, other] : told.crossed) {
        Json::Value pair(Json::arrayValue);
        pair.append(one);
        pair.append(other);
        json["crossed_at_start"].append(pair);
    }
    if (told.apart_since) json["apart_since_frame"] = *told.apart_since;
    if (told.first_unproved) json["first_unproved_frame"] = *told.first_unproved;
    if (!told.not_covered.empty()) json["not_covered"] = split_json(told.not_covered);
    if (!told.beside_seams.empty()) json["beside_seams"] = beside_seams_json(told);
    json["most_pairs"] = told.most_pairs;
    json["motions_cut_short"] = Json::UInt64(told.truncated);
    json["longest_lag_m"] = told.longest_lag;
    json["lag_limit_m"] = told.lag_limit;
    json["lagging_frames"] = told.lagging_frames;
    return json;
}

Json::Value skipped_json(const std::vector<Manifest::Skipped>& skipped) {
    Json::Value array(Json::arrayValue);
    for (const auto& [what, reason] : skipped) {
        Json::Value json;
        json["what"] = what;
        json["reason"] = reason;
        array.append(std::move(json));
    }
    return array;
}

Json::Value compromises_json(const std::vector<Manifest::Compromise>& compromises) {
    Json::Value array(Json::arrayValue);
    for (const auto& [what, reason, enough_substeps] : compromises) {
        Json::Value json;
        json["what"] = what;
        json["reason"] = reason;
        if (enough_substeps > 0) json["enough_substeps"] = enough_substeps;
        array.append(std::move(json));
    }
    return array;
}

Json::Value momenta_json(const std::vector<Momenta>& momenta) {
    Json::Value array(Json::arrayValue);
    for (const auto& [cloth, about, momentum_by, angular_momentum_by] : momenta) {
        Json::Value json;
        json["cloth"] = cloth;
        json["about"] = about;
        json["momentum_by"] = texts(momentum_by);
        json["angular_momentum_by"] = texts(angular_momentum_by);
        array.append(std::move(json));
    }
    return array;
}

Json::Value run_json(const Manifest& manifest) {
    Json::Value json;
    json["created"] = manifest.created;
    json["command_line"] = texts(manifest.command_line);
    if (manifest.frame_time) {
        Json::Value& time = json["frame_ms"];
        time["median"] = number(manifest.frame_time->median, "the median frame time");
        time["min"] = number(manifest.frame_time->minimum, "the shortest frame time");
        time["max"] = number(manifest.frame_time->maximum, "the longest frame time");
    }
    for (const auto& [stage, median] : manifest.stage_median_ms) {
        json["stage_median_ms"][stage] = number(median, fmt::format("the time of stage '{}'", stage));
    }
    return json;
}

/// A number that is not finite is left out: JSON has none for it, and the sentence says it.
Json::Value failed_frame_json(const FrameFailure& failure) {
    Json::Value json;
    json["frame"] = failure.frame;
    if (!failure.cloth.empty()) json["cloth"] = failure.cloth;
    if (failure.particle)
        for (const std::uint32_t index : *failure.particle) json["particle"].append(index);
    if (failure.criterion.empty()) return json;
    json["criterion"] = failure.criterion;
    if (std::isfinite(failure.value)) json["value"] = failure.value;
    if (std::isfinite(failure.bound)) json["bound"] = failure.bound;
    return json;
}

}  // namespace

std::optional<Manifest::FrameTime> summarize_frame_times(std::span<const double> milliseconds) {
    if (milliseconds.empty()) return std::nullopt;
    std::vector<double> sorted(milliseconds.begin(), milliseconds.end());
    std::ranges::sort(sorted);
    const size_t middle = sorted.size() / 2;
    const double median = sorted.size() % 2 ? sorted[middle] : 0.5 * (sorted[middle - 1] + sorted[middle]);
    return Manifest::FrameTime{median, sorted.front(), sorted.back()};
}

std::string triangles_text(std::span<const Manifest::SplitTriangles> split) {
    std::uint64_t count = 0;
    for (const Manifest::SplitTriangles& each : split) count += each.count;
    const std::string text = fmt::format("{} triangle{}", count, count == 1 ? "" : "s");
    return split.size() == 1 ? fmt::format("{} of cloth '{}'", text, split.front().cloth) : text;
}

std::string utc_timestamp(std::chrono::system_clock::time_point time) {
    return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::chrono::system_clock::to_time_t(time)));
}

Json::Value solver_json(const Manifest::Solver& solver) {
    Json::Value json;
    json["method"] = solver.method;
    json["kernels"] = solver.kernels;
    json["substeps"] = solver.substeps;
    json["iterations"] = solver.iterations;
    json["tethers"] = solver.tethers;
    if (!solver.asked.empty()) {
        json["asked"] = solver.asked;
        json["choice"] = solver.choice;
    }
    if (solver.tolerance > 0) json["tolerance"] = solver.tolerance;
    if (solver.stretch_error) json["stretch_error_rms"] = *solver.stretch_error;
    return json;
}

/// Returns all but the statistics, which are an empty array.
Json::Value frameless_json(const Manifest& manifest) {
    Json::Value json;
    json["format"] = std::string(manifest_format);
    json["program_version"] = manifest.program_version;
    json["program_commit"] = manifest.program_commit;
    json["status"] = manifest.status;
    if (!manifest.failure.empty()) json["failure"] = manifest.failure;
    if (!manifest.reproducer.empty()) json["reproducer"] = manifest.reproducer;
    if (manifest.failed_frame) json["failed"] = failed_frame_json(*manifest.failed_frame);
    json["scene"] = scene_json(manifest.scene);
    json["device"] = device_json(manifest.device);
    json["frames"] = frames_json(manifest.frames);
    if (manifest.picture) json["picture"] = picture_json(*manifest.picture);
    json["run_key"] = manifest.run_key;
    json["solver"] = solver_json(manifest.solver);
    json["validation"]["enabled"] = manifest.validation.enabled;
    json["validation"]["messages"] = Json::UInt64(manifest.validation.message_count);
    if (manifest.self_collision) json["self_collision"] = self_collision_json(*manifest.self_collision);
    if (!manifest.off_collider_edges.empty())
        json["collider_edges"]["not_covered"] = split_json(manifest.off_collider_edges);
    if (!manifest.cuts.empty()) json["cuts"] = cuts_json(manifest.cuts);
    json["skipped"] = skipped_json(manifest.skipped);
    json["compromises"] = compromises_json(manifest.compromises);
    if (!manifest.momenta.empty()) json["momenta"] = momenta_json(manifest.momenta);
    json["warnings"] = Json::Value(Json::arrayValue);
    for (const std::string& warning : manifest.warnings) json["warnings"].append(warning);
    json["files"] = files_json(manifest.files);
    json["statistics"] = Json::Value(Json::arrayValue);
    json["run"] = run_json(manifest);
    return json;
}

void put_manifest(const Manifest& manifest, const std::function<void(std::string_view)>& append) {
    const std::string text = json_text(frameless_json(manifest));
    const std::string_view whole(text), array = "\n  \"statistics\": [";
    const std::size_t inside = whole.find(array) + array.size();
    append(whole.substr(0, inside));
    bool any = false;
    const auto put = [&](const Manifest::FrameStatistics& statistics) {
        append((any ? ",\n    " : "\n    ") + json_text(statistics_json(statistics), 4));
        any = true;
    };
    if (manifest.statistics) manifest.statistics(put);
    if (any) append("\n  ");
    append(whole.substr(inside));
}

// The rules are for the values that are read of a manifest.
static std::span<const JsonRule> manifest_rules() {
    using enum JsonRule::Kind;
    static constexpr JsonRule rules[] = {
        {"/format", text},
        {"/status", text},
        {"/failure", text},
        {"/scene/name", text},
        {"/scene/path", text},
        {"/device", object},
        {"/frames/end", number},
        {"/frames/step", number},
        {"/frames/fps", number},
        {"/picture", object},
        {"/solver", object},
        {"/validation/messages", whole_number},
        {"/self_collision/proved", boolean},
        {"/self_collision/certificate", text},
        {"/self_collision/not_covered", list},
        {"/self_collision/not_covered/*/cloth", text},
        {"/self_collision/not_covered/*/first_frame", whole_number},
        {"/self_collision/not_covered/*/triangles", whole_number},
        {"/cuts", list},
        {"/cuts/*/cloth", text},
        {"/cuts/*/frame", whole_number},
        {"/cuts/*/springs", whole_number},
        {"/cuts/*/torn", whole_number},
        {"/cuts/*/triangles", whole_number},
        {"/cuts/*/pieces", whole_number},
        {"/cuts/*/crumbs", whole_number},
        {"/warnings", list},
        {"/files", list},
        {"/files/*/name", text},
        {"/files/*/bytes", number},
        {"/statistics", list},
        {"/statistics/*", object},
        {"/statistics/*/*", number},
        {"/run/command_line", list},
        {"/run/command_line/*", text},
        {"/run/frame_ms/median", number},
        {"/run/stage_median_ms", object},
        {"/run/stage_median_ms/*", number},
    };
    return rules;
}

Json::Value read_manifest(const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / manifest_file_name;
    Json::Value manifest = read_json(file, manifest_rules());
    if (manifest["format"] != Json::Value(std::string(manifest_format)))
        throw OutputError(fmt::format("'{}' is no manifest of this program", file.string()));
    return manifest;
}

void write_manifest(OutputFolder& folder, const Manifest& manifest) {
    folder.sync();  // "done" must not reach the disk before the names of the files it lists
    AtomicFile file(folder, std::string(manifest_file_name));
    std::string waiting;
    const auto write = [&] {
        file.append(bytes_of(waiting));
        waiting.clear();
    };
    put_manifest(manifest, [&](std::string_view piece) {
        waiting += piece;
        if (waiting.size() > write_size) write();
    });
    write();
    file.commit();
    folder.sync();
}

}  // namespace drape
