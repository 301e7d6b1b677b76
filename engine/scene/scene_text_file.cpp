#include "scene/scene_text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "drape/scene_reader.h"

namespace drape {

TextFile read_text_file(const std::string& path) {
    TextFile result;
    const auto close = [](std::FILE* file) { std::fclose(file); };
    const std::unique_ptr<std::FILE, decltype(close)> file(std::fopen(path.c_str(), "rb"), close);
    // This reads to a byte over the limit rather than asking for the size, which pipes and devices do not have.
    std::array<char, 65536> chunk;
    while (file && result.text.size() <= scene_file_byte_limit) {
        const std::size_t wanted = std::min(chunk.size(), scene_file_byte_limit + 1 - result.text.size());
        const std::size_t count = std::fread(chunk.data(), 1, wanted, file.get());
        result.text.append(chunk.data(), count);
        if (count < wanted) break;
    }
    if (!file || std::ferror(file.get()) != 0) result.error = fmt::format("cannot read: {}", std::strerror(errno));
    return result;
}

std::string size_fault(std::size_t size) {
    if (size <= scene_file_byte_limit) return {};
    return fmt::format("expected a file of at most {} bytes, got {}{}", scene_file_byte_limit,
                       size > scene_file_byte_limit + 1 ? "" : "at least ", size);
}

}  // namespace drape
