// Two runs' results by their numbers: arrays, pictures, folders of both.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace drape::compare {

/// What may differ. Arrays are judged by what is given of the first two, and must be equal where neither is; pictures
/// likewise by the last two.
struct Limits {
    std::optional<double> largest, rms;   ///< of the differences of an array's values
    std::optional<double> psnr, channel;  ///< dB, at least; largest difference of a channel, of 255
};

/// One thing that both have, or only one.
struct Row {
    std::string name;
    std::string text;   ///< how it differs
    bool over = false;  ///< a limit
    /// Where they are known: largest and RMS difference of an array or of a picture's channels; PSNR in dB, nothing for
    /// equal pictures.
    std::optional<double> largest, rms, psnr;
};

/// Whether the file is one that `compare_files` reads: .npy, .npz or .png.
bool is_result_file(const std::filesystem::path& path);

/// Throws OutputError naming the file that cannot be read.
std::vector<Row> compare_files(const std::filesystem::path& a, const std::filesystem::path& b, const Limits& limits);

/// File by file, by name: other files must have equal bytes, the manifests are left out. A file that only one has is
/// over the limit. Throws OutputError.
std::vector<Row> compare_folders(const std::filesystem::path& a, const std::filesystem::path& b, const Limits& limits);

std::string rows_text(const std::vector<Row>& rows);
std::string rows_json(const std::vector<Row>& rows);

}  // namespace drape::compare
