// Reads the text of a file of JSON.
#pragma once

#include <cstddef>
#include <string>

namespace drape {

struct TextFile {
    std::string text;
    std::string error;  ///< "cannot read: ..."; empty: the file was read
};

/// Reads a file, a pipe or a device, up to a byte more than a scene may have.
TextFile read_text_file(const std::string& path);

/// Returns what is wrong with a text of this size, as text to follow the file's name; empty: nothing is.
std::string size_fault(std::size_t size);

}  // namespace drape
