// Reads NumPy's files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace drape::input {

struct Array {
    std::string name;  ///< its name in an archive; empty for an NPY file
    std::string type;  ///< as NumPy spells it: "<f4"
    std::vector<std::uint64_t> shape;
    std::vector<std::byte> bytes;  ///< C order

    /// Returns whether its values are numbers that `value` can read.
    bool has_numbers() const;
    std::size_t count() const;
    double value(std::size_t index) const;
    /// Returns "float32 (61, 65, 65, 3)".
    std::string text() const;
    /// Returns the place of the value with this index, "(3, 0, 1)".
    std::string place(std::size_t index) const;
};

/// Returns the one array of an NPY file, or those of an NPZ archive by name; of the archive only those whose names are
/// wanted, where it is said. Throws OutputError naming the file.
std::vector<Array> load_arrays(const std::filesystem::path& path,
                               const std::function<bool(std::string_view)>& is_wanted = {});

/// Receives an array of numbers whose values are not read yet, and returns how many of the last ones are wanted; may
/// throw.
using WantedValues = std::function<std::uint64_t(const Array&)>;
/// Returns the array of an NPY file, or the one of this name in an NPZ archive, with its last values alone. Throws
/// OutputError naming the file, what `wanted` throws, and for values that are not numbers.
Array load_array(const std::filesystem::path& path, std::string_view name, const WantedValues& wanted);

}  // namespace drape::input
