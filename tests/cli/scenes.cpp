#include "scenes.h"

#include <fmt/format.h>
#include <json/json.h>

#include <sstream>

#include "base/output_error.h"
#include "input/png_picture.h"

namespace drape {

namespace fs = std::filesystem;

std::string small_scene(int frame_count) {
    return fmt::format(R"({{
  "name": "small",
  "time": {{"fps": 60, "frames": {}}},
  "gravity": [0, -9.81, 0],
  "cloths": [{{
    "name": "sheet", "grid": [8, 6], "size": [1, 0.7], "placement": {{"origin": [-0.5, 1.5, 0]}},
    "areal_density": 0.2,
    "pins": [{{"corner": "top_left"}}, {{"corner": "top_right"}}]
  }}],
  "colliders": {{"planes": [{{"normal": [0, 1, 0], "offset": 0}}]}},
  "solver": {{"method": "relax", "substeps": 4}},
  "image": {{"size": [64, 48], "samples": 1}}
}}
)",
                       frame_count);
}

SceneFolder::SceneFolder(const std::string& scene_text) { write_text(scene(), scene_text); }

std::map<std::string, std::string> everything_below(const fs::path& folder) {
    std::map<std::string, std::string> found;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const std::string name = fs::relative(entry.path(), folder).string();
        if (entry.is_directory())
            found[name + "/"];
        else
            found[name] = read_text(entry.path());
    }
    return found;
}

std::set<int> frame_numbers(const fs::path& folder) {
    std::set<int> numbers;
    if (!fs::exists(folder)) return numbers;
    for (const std::string& name : names_in(folder))
        if (name.starts_with("frame_") && name.ends_with(".png")) numbers.insert(std::stoi(name.substr(6)));
    return numbers;
}

std::string frame_name(int frame) { return fmt::format("frame_{:04}.png", frame); }

Json::Value lasting_manifest(const fs::path& folder) {
    std::istringstream stream(read_text(folder / "manifest.json"));
    Json::Value manifest;
    std::string errors;
    if (!Json::parseFromStream(Json::CharReaderBuilder(), stream, &manifest, &errors)) throw std::runtime_error(errors);
    if (!manifest.isMember("run")) throw std::runtime_error("no \"run\" in the manifest");
    manifest.removeMember("run");
    return manifest;
}

bool is_whole_picture(const fs::path& file, unsigned width, unsigned height) {
    try {
        const Picture picture = read_png(file);
        return picture.width == width && picture.height == height;
    } catch (const OutputError&) {
        return false;
    }
}

}  // namespace drape
