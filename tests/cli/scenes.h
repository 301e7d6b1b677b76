// Small scenes, and what a run left in its folder.
#pragma once

#include <json/value.h>

#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "output/temporary_folder.h"

namespace drape {

/// One cloth of 8 x 6 particles hung by two corners, 4 substeps, 64 x 48 pixels.
std::string small_scene(int frame_count);

/// A folder that holds scene.json.
class SceneFolder : public TemporaryFolder {
  public:
    explicit SceneFolder(const std::string& scene_text);
    std::string scene() const { return (*this / "scene.json").string(); }
    std::string out(const std::string& name = "out") const { return (*this / name).string(); }
};

/// Everything below a folder: relative name -> content; folders end with '/'.
std::map<std::string, std::string> everything_below(const std::filesystem::path& folder);

/// The numbers of the frame_NNNN.png files.
std::set<int> frame_numbers(const std::filesystem::path& folder);
std::string frame_name(int frame);

/// manifest.json without what may differ between two runs.
Json::Value lasting_manifest(const std::filesystem::path& folder);

/// A whole PNG file (every checksum fits), of this size.
bool is_whole_picture(const std::filesystem::path& file, unsigned width, unsigned height);

}  // namespace drape
