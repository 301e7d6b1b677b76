// A run's folder as a report reads it: its manifest and its pictures.
#pragma once

#include <json/value.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace drape::report {

struct RunFolder {
    std::filesystem::path path;
    Json::Value manifest;
    std::vector<std::string> pictures;  ///< file names, in order of frames
};

/// Throws OutputError when there is no manifest of drape's: the run is not done, or the folder is no run's.
RunFolder read_run_folder(const std::filesystem::path& path);

/// A picture as PNG of at most `width` pixels across (the mean of what falls into a pixel, in linear light), in base64.
/// Throws OutputError.
std::string small_picture(const std::filesystem::path& file, std::uint32_t width);

std::string base64(const std::vector<std::uint8_t>& bytes);

}  // namespace drape::report
