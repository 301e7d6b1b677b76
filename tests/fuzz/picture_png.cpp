// A picture, as it is and with the checksums of its parts repaired, is read in colours and as a map, or gives an error
// that names its file.
#include "file_input.h"
#include "input/map_file.h"
#include "input/png_picture.h"

namespace {

std::uint32_t word(std::span<const std::uint8_t> bytes) {
    return static_cast<std::uint32_t>(bytes[0]) << 24 | static_cast<std::uint32_t>(bytes[1]) << 16 |
           static_cast<std::uint32_t>(bytes[2]) << 8 | bytes[3];
}

std::uint32_t crc32(std::span<const std::uint8_t> bytes) {
    std::uint32_t crc = ~0u;
    for (const std::uint8_t byte : bytes) {
        crc ^= byte;
        for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xEDB88320u : 0u);
    }
    return ~crc;
}

/// Gives each chunk the checksum that it must end with.
void repair(std::vector<std::uint8_t>& png) {
    for (std::size_t at = 8; at + 12 <= png.size();) {
        const std::uint64_t length = word(std::span(png).subspan(at));
        if (at + 12 + length > png.size()) return;
        const std::uint32_t crc = crc32(std::span(png).subspan(at + 4, 4 + length));
        for (std::size_t k = 0; k < 4; ++k) png[at + 8 + length + k] = static_cast<std::uint8_t>(crc >> (24 - 8 * k));
        at += 12 + length;
    }
}

}  // namespace

extern "C" int DRAPE_FUZZ_ENTRY(picture_png)(const std::uint8_t* data, std::size_t size) {
    using namespace drape;
    const auto both = [](std::span<const std::uint8_t> png) {
        fuzz::read_file("picture.png", png.data(), png.size(), [](const auto& path) {
            const Picture picture = read_png(path);
            fuzz::require(picture.rgb.size() == std::size_t{3} * picture.width * picture.height, "pixels are missing");
        });
        fuzz::read_file("picture.png", png.data(), png.size(), [](const auto& path) {
            const GreyPicture map = input::read_map(path);
            fuzz::require(map.values.size() == std::size_t{map.width} * map.height, "values are missing");
        });
    };
    both({data, size});
    std::vector<std::uint8_t> repaired(data, data + size);
    repair(repaired);
    both(repaired);
    return 0;
}
