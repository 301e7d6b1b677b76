// Small scenes, and readers of what a run left in its folder.
#pragma once

#include <json/value.h>

#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "output/temporary_folder.h"

namespace drape {

/// A scene of one cloth of 8 x 6 particles hung by two corners, 4 substeps, 64 x 48 pixels.
std::string small_scene(int frame_count);

class SceneFolder : public TemporaryFolder {
  public:
    explicit SceneFolder(const std::string& scene_text);
    std::string scene() const { return (*this / "scene.json").string(); }
    std::string out(const std::string& name = "out") const { return (*this / name).string(); }
};

/// Returns everything below a folder: relative name -> content; folders end with '/'.
std::map<std::string, std::string> everything_below(const std::filesystem::path& folder);

/// Returns the numbers of the frame_NNNN.png files.
std::set<int> frame_numbers(const std::filesystem::path& folder);
std::string frame_name(int frame);

/// Returns manifest.json without the entries that may differ between two runs.
Json::Value lasting_manifest(const std::filesystem::path& folder);

/// Returns whether a file is a whole PNG of this size, in which every checksum fits.
bool is_whole_picture(const std::filesystem::path& file, unsigned width, unsigned height);

}  // namespace drape
