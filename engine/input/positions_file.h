// Reads the places of a grid's particles.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace drape::input {

/// Returns x y z (in m) of each particle of a grid, row by row, as they stand in a file of the kind that its name ends
/// in:
/// - .npy: float32 or float64, [rows, columns, 3] or [frames, rows, columns, 3], of which the last frame is taken;
/// - .npz: the same as its array `positions`, which drape's archives have;
/// - .obj: its vertices (`v`), as many as particles, in their order;
/// - .pc2: the last sample of a point cache of as many points.
/// Meshes and point caches may have only the particles for which `is_used` (empty: all); each of the others is then put
/// in the middle of its neighbours, those first that have some.
/// Throws OutputError naming the file: where it is not that, is of another shape (both are said), or ends too early.
std::vector<std::array<double, 3>> read_positions(const std::filesystem::path& path, std::uint32_t columns,
                                                  std::uint32_t rows, const std::vector<bool>& is_used = {});
/// Returns the particles' velocities (m/s) in the same way, from .npy, or from .npz as its array `velocities`.
std::vector<std::array<double, 3>> read_velocities(const std::filesystem::path& path, std::uint32_t columns,
                                                   std::uint32_t rows);

}  // namespace drape::input
