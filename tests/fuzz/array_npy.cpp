// An array of NumPy is read whole, as poses, as positions and as a map, or gives an error that names its file.
#include "file_input.h"
#include "input/array_file.h"
#include "input/map_file.h"
#include "input/point_poses.h"
#include "input/positions_file.h"

extern "C" int DRAPE_FUZZ_ENTRY(array_npy)(const std::uint8_t* data, std::size_t size) {
    using namespace drape;
    const auto values = [](const std::filesystem::path& path) {
        for (const input::Array& array : input::load_arrays(path)) {
            fuzz::require(!array.text().empty(), "an array without a text");
            if (array.has_numbers() && array.count() > 0) static_cast<void>(array.value(array.count() - 1));
        }
    };
    fuzz::read_file("array.npy", data, size, values);
    fuzz::read_file("array.npy", data, size, [](const auto& path) { input::read_poses(path, 6); });
    fuzz::read_file("array.npy", data, size, [](const auto& path) { input::read_positions(path, 3, 2); });
    fuzz::read_file("array.npy", data, size, [](const auto& path) { input::read_map(path); });
    return 0;
}
