// Compares two runs' results by their numbers: arrays, pictures, folders of both.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace drape::compare {

/// Limits of the differences. Arrays are judged by those of the first two that are given, and must be equal if neither
/// is; pictures are judged by the last two in the same way.
struct Limits {
    std::optional<double> largest, rms;   ///< on the differences of an array's values
    std::optional<double> psnr, channel;  ///< dB, at least; largest difference of a channel, of 255
};

/// An array, picture or file that both folders have, or only one of them.
struct Row {
    std::string name;
    std::string text;   ///< how it differs
    bool over = false;  ///< over a limit
    /// Largest and RMS difference of an array or of a picture's channels, and PSNR in dB, where they are known; equal
    /// pictures have no PSNR.
    std::optional<double> largest, rms, psnr;
};

/// Returns whether `compare_files` can read the file: .npy, .npz or .png.
bool is_result_file(const std::filesystem::path& path);

/// Throws OutputError naming the file that cannot be read.
std::vector<Row> compare_files(const std::filesystem::path& a, const std::filesystem::path& b, const Limits& limits);

/// Compares file by file, by name: other files must have equal bytes, the manifests are left out. A file that only one
/// has is over the limit. Throws OutputError.
std::vector<Row> compare_folders(const std::filesystem::path& a, const std::filesystem::path& b, const Limits& limits);

std::string rows_text(const std::vector<Row>& rows);
std::string rows_json(const std::vector<Row>& rows);

}  // namespace drape::compare
