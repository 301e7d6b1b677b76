#include "run/reproducer.h"

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
/// This value depends on the first frame too, so it cannot be compared by itself.
constexpr const char* drift = "energy_drift_j";

Json::Value settings_json(const Reproducer& reproducer) {
    Json::Value json;
    json["path"] = reproducer.scene.path;
    json["overrides"] = Json::arrayValue;
    for (const std::string& each : reproducer.scene.overrides) json["overrides"].append(each);
    json["skip"] = reproducer.scene.skip;
    json["kernels"] = reproducer.scene.kernels.text();
    json["keep_failed"] = reproducer.keep_failed;
    json["start"] = reproducer.start;
    json["end"] = reproducer.end;
    json["step"] = reproducer.step;
    return json;
}

Json::Value about_json(const Reproducer& reproducer) {
    Json::Value json;
    json["settings"] = settings_json(reproducer);
    json["program_version"] = reproducer.program_version;
    json["run_key"] = reproducer.run_key;
    json["device"]["name"] = reproducer.device.name;
    json["device"]["driver"] = reproducer.device.driver;
    json["device"]["driver_version"] = reproducer.device.driver_version;
    json["device"]["uuid"] = reproducer.device.uuid;
    json["status"] = reproducer.status;
    json["failure"] = reproducer.reason;
    if (reproducer.failed) json["failed_frame"] = reproducer.failed->frame;
    if (reproducer.last_frame) {
        json["last_frame"]["frame"] = Json::Int64{reproducer.last_frame->frame};
        for (const auto& [name, value] : reproducer.last_frame->values)
            if (name != drift) json["last_frame"]["values"][name] = value;
    }
    return json;
}

/// Throws Json::Exception and Error.
void take_about(const Json::Value& json, Reproducer& reproducer) {
    const Json::Value& settings = json["settings"];
    reproducer.scene.path = settings["path"].asString();
    for (const Json::Value& each : settings["overrides"]) reproducer.scene.overrides.push_back(each.asString());
    reproducer.scene.skip = settings["skip"].asBool();
    const auto kernels = Kernels::parse(settings["kernels"].asString());
    if (!kernels) throw Error("it names no kernels");
    reproducer.scene.kernels = *kernels;
    reproducer.keep_failed = settings["keep_failed"].asBool();
    reproducer.start = settings["start"].asUInt();
    reproducer.end = settings["end"].asUInt();
    reproducer.step = settings["step"].asUInt();
    if (reproducer.step == 0) throw Error("it has a step of 0 frames");
    reproducer.program_version = json["program_version"].asString();
    reproducer.run_key = json["run_key"].asString();
    const Json::Value& device = json["device"];
    reproducer.device = {device["name"].asString(),
                         device["driver"].asString(),
                         device["driver_version"].asString(),
                         {},
                         device["uuid"].asString()};
    reproducer.status = json["status"].asString();
    reproducer.reason = json["failure"].asString();
    if (json.isMember("failed_frame")) {
        reproducer.failed.emplace();
        reproducer.failed->frame = json["failed_frame"].asUInt();
    }
    if (!json.isMember("last_frame")) return;
    reproducer.last_frame.emplace();
    reproducer.last_frame->frame = json["last_frame"]["frame"].asUInt();
    const Json::Value& values = json["last_frame"]["values"];
    for (auto value = values.begin(); value != values.end(); ++value)
        reproducer.last_frame->values[value.name()] = value->asDouble();
}

Json::Value json_of(const std::vector<std::byte>& bytes) {
    const std::optional<Json::Value> json = parse_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    if (!json || !json->isObject()) throw Error("its part 'about' is no JSON object");
    return *json;
}

}  // namespace

void write_reproducer(OutputFolder& folder, const Reproducer& reproducer) {
    Sections sections;
    const auto put = [&](const std::string& name, std::string_view text) {
        const auto bytes = bytes_of(text);
        sections[name].assign(bytes.begin(), bytes.end());
    };
    put(about_part, json_text(about_json(reproducer)));
    put(scene_part, reproducer.scene_text);
    if (reproducer.checkpoint)
        for (auto& [name, bytes] : sections_of(*reproducer.checkpoint, reproducer.run_key))
            sections[checkpoint_prefix + name] = bytes;
    write_file(folder, std::string(reproducer_file_name), encode_sections(reproducer_format, sections));
}

Reproducer decode_reproducer(std::span<const std::byte> file) {
    Reproducer reproducer;
    try {
        const Sections sections = decode_sections(reproducer_format, file);
        const auto about = sections.find(about_part), scene = sections.find(scene_part);
        if (about == sections.end() || scene == sections.end()) throw Error("it has not all its parts");
        take_about(json_of(about->second), reproducer);
        reproducer.scene_text.assign(reinterpret_cast<const char*>(scene->second.data()), scene->second.size());
        Sections checkpoint;
        const std::string prefix = checkpoint_prefix;
        for (const auto& [name, bytes] : sections)
            if (name.starts_with(prefix)) checkpoint[name.substr(prefix.size())] = bytes;
        std::string key;
        if (!checkpoint.empty()) reproducer.checkpoint = checkpoint_of(checkpoint, key);
    } catch (const OutputError&) {
        throw;
    } catch (const Json::Exception& error) {
        throw OutputError(fmt::format("is damaged: {}", error.what()));
    } catch (const Error& error) {
        throw OutputError(fmt::format("is damaged: {}", error.what()));
    }
    return reproducer;
}

Reproducer read_reproducer(const std::string& path) {
    const std::string file = read_file(path);
    try {
        return decode_reproducer(bytes_of(file));
    } catch (const OutputError& error) {
        throw OutputError(fmt::format("'{}' {}", path, error.what()));
    }
}

}  // namespace drape
