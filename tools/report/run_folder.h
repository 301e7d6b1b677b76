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
    Json::Value manifest;               ///< of a run that is not finished what its pictures say of it
    std::vector<std::string> files;     ///< names of those that the manifest names and that are there
    std::vector<std::string> pictures;  ///< those of them that are pictures, in order of frames
    bool is_finished = true;            ///< whether the run has ended and written its manifest
};

/// Reads a folder that has a manifest of drape's or, of a run that goes on or was killed, pictures. Throws OutputError
/// when it has neither, or one of them cannot be read.
RunFolder read_run_folder(const std::filesystem::path& path);

/// A picture as PNG of at most `width` pixels across (the mean of what falls into a pixel, in linear light), in base64.
/// Throws OutputError.
std::string small_picture(const std::filesystem::path& file, std::uint32_t width);

/// Returns at most `most` numbers below `count`, at least one, evenly spread, the first and the last among them.
std::vector<std::size_t> evenly_chosen(std::size_t count, std::size_t most);

std::string base64(const std::vector<std::uint8_t>& bytes);

}  // namespace drape::report
