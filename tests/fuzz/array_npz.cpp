// An archive of NumPy is read whole, as poses and as velocities, or gives an error that names its file.
#include "file_input.h"
#include "input/array_file.h"
#include "input/point_poses.h"
#include "input/positions_file.h"

extern "C" int DRAPE_FUZZ_ENTRY(array_npz)(const std::uint8_t* data, std::size_t size) {
    using namespace drape;
    const auto values = [](const std::filesystem::path& path) {
        for (const input::Array& array : input::load_arrays(path))
            if (array.has_numbers() && array.count() > 0) static_cast<void>(array.value(array.count() - 1));
    };
    fuzz::read_file("arrays.npz", data, size, values);
    fuzz::read_file("arrays.npz", data, size, [](const auto& path) { input::read_poses(path, 6); });
    fuzz::read_file("arrays.npz", data, size, [](const auto& path) { input::read_velocities(path, 3, 2); });
    return 0;
}
