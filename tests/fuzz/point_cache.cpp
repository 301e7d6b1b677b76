// A point cache is read as poses and as positions, or gives an error that names its file.
#include "file_input.h"
#include "input/point_poses.h"
#include "input/positions_file.h"

extern "C" int DRAPE_FUZZ_ENTRY(point_cache)(const std::uint8_t* data, std::size_t size) {
    using namespace drape;
    fuzz::read_file("cache.pc2", data, size, [](const auto& path) { input::read_poses(path, 6); });
    fuzz::read_file("cache.pc2", data, size, [](const auto& path) { input::read_positions(path, 3, 2); });
    return 0;
}
