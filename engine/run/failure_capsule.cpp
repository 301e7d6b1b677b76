#include "run/failure_capsule.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <json/json.h>

#include <algorithm>

#include "output/atomic_file.h"
#include "output/json_file.h"
#include "output/json_text.h"
#include "output/section_file.h"
#include "run/run_statistics.h"
#include "simulation/frame_checks.h"

namespace drape {

namespace {

constexpr const char *about_part = "about", *scene_part = "scene", *checkpoint_prefix = "checkpoint/";
/// Not a frame's own: of the first frame too.
constexpr const char* drift = "energy_drift_j";

Json::Value settings_json(const FailureCapsule& capsule) {
    Json::Value json;
    json["path"] = capsule.scene.path;
    json["overrides"] = Json::arrayValue;
    for (const std::string& each : capsule.scene.overrides) json["overrides"].append(each);
    json["skip"] = capsule.scene.skip;
    json["schedule"] = std::string(spelling(schedule_spellings, capsule.scene.schedule));
    json["keep_failed"] = capsule.keep_failed;
    json["start"] = capsule.start;
    json["end"] = capsule.end;
    json["step"] = capsule.step;
    return json;
}

Json::Value about_json(const FailureCapsule& capsule) {
    Json::Value json;
    json["settings"] = settings_json(capsule);
    json["program_version"] = capsule.program_version;
    json["run_key"] = capsule.run_key;
    json["device"]["name"] = capsule.device.name;
    json["device"]["driver"] = capsule.device.driver;
    json["device"]["driver_version"] = capsule.device.driver_version;
    json["device"]["uuid"] = capsule.device.uuid;
    json["status"] = capsule.status;
    json["failure"] = capsule.reason;
    if (capsule.failed) json["failed_frame"] = capsule.failed->frame;
    if (capsule.last_frame) {
        json["last_frame"]["frame"] = Json::Int64{capsule.last_frame->frame};
        for (const auto& [name, value] : capsule.last_frame->values)
            if (name != drift) json["last_frame"]["values"][name] = value;
    }
    return json;
}

/// Throws Json::Exception and Error.
void take_about(const Json::Value& json, FailureCapsule& capsule) {
    const Json::Value& settings = json["settings"];
    capsule.scene.path = settings["path"].asString();
    for (const Json::Value& each : settings["overrides"]) capsule.scene.overrides.push_back(each.asString());
    capsule.scene.skip = settings["skip"].asBool();
    const auto* schedule =
        std::ranges::find(schedule_spellings, settings["schedule"].asString(), &Spelling<Schedule>::name);
    if (schedule == std::end(schedule_spellings)) throw Error("it names no schedule");
    capsule.scene.schedule = schedule->value;
    capsule.keep_failed = settings["keep_failed"].asBool();
    capsule.start = settings["start"].asUInt();
    capsule.end = settings["end"].asUInt();
    capsule.step = settings["step"].asUInt();
    if (capsule.step == 0) throw Error("it has a step of 0 frames");
    capsule.program_version = json["program_version"].asString();
    capsule.run_key = json["run_key"].asString();
    const Json::Value& device = json["device"];
    capsule.device = {device["name"].asString(),
                      device["driver"].asString(),
                      device["driver_version"].asString(),
                      {},
                      device["uuid"].asString()};
    capsule.status = json["status"].asString();
    capsule.reason = json["failure"].asString();
    if (json.isMember("failed_frame")) {
        capsule.failed.emplace();
        capsule.failed->frame = json["failed_frame"].asUInt();
    }
    if (!json.isMember("last_frame")) return;
    capsule.last_frame.emplace();
    capsule.last_frame->frame = json["last_frame"]["frame"].asUInt();
    const Json::Value& values = json["last_frame"]["values"];
    for (auto value = values.begin(); value != values.end(); ++value)
        capsule.last_frame->values[value.name()] = value->asDouble();
}

Json::Value json_of(const std::vector<std::byte>& bytes) {
    const std::optional<Json::Value> json = parse_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    if (!json || !json->isObject()) throw Error("its part 'about' is no JSON object");
    return *json;
}

}  // namespace

void write_capsule(OutputFolder& folder, const FailureCapsule& capsule) {
    Sections sections;
    const auto put = [&](const std::string& name, std::string_view text) {
        const auto bytes = bytes_of(text);
        sections[name].assign(bytes.begin(), bytes.end());
    };
    put(about_part, json_text(about_json(capsule)));
    put(scene_part, capsule.scene_text);
    if (capsule.checkpoint)
        for (auto& [name, bytes] : sections_of(*capsule.checkpoint, capsule.run_key))
            sections[checkpoint_prefix + name] = bytes;
    write_file(folder, std::string(capsule_file_name), encode_sections(capsule_format, sections));
}

FailureCapsule decode_capsule(std::span<const std::byte> file) {
    FailureCapsule capsule;
    try {
        const Sections sections = decode_sections(capsule_format, file);
        const auto about = sections.find(about_part), scene = sections.find(scene_part);
        if (about == sections.end() || scene == sections.end()) throw Error("it has not all its parts");
        take_about(json_of(about->second), capsule);
        capsule.scene_text.assign(reinterpret_cast<const char*>(scene->second.data()), scene->second.size());
        Sections checkpoint;
        const std::string prefix = checkpoint_prefix;
        for (const auto& [name, bytes] : sections)
            if (name.starts_with(prefix)) checkpoint[name.substr(prefix.size())] = bytes;
        std::string key;
        if (!checkpoint.empty()) capsule.checkpoint = checkpoint_of(checkpoint, key);
    } catch (const OutputError&) {
        throw;
    } catch (const Json::Exception& error) {
        throw OutputError(fmt::format("is damaged: {}", error.what()));
    } catch (const Error& error) {
        throw OutputError(fmt::format("is damaged: {}", error.what()));
    }
    return capsule;
}

FailureCapsule read_capsule(const std::string& path) {
    const std::string file = read_file(path);
    try {
        return decode_capsule(bytes_of(file));
    } catch (const OutputError& error) {
        throw OutputError(fmt::format("'{}' {}", path, error.what()));
    }
}

}  // namespace drape
