// Reads the poses of a mesh whose vertices move.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace drape::input {

struct PointPoses {
    std::size_t points = 0, count = 0;
    std::vector<float> xyz;  ///< in the file's unit; pose by pose, point by point
};

/// The largest number of bytes of poses that are read.
inline constexpr std::uint64_t most_pose_bytes = std::uint64_t{512} << 20;

/// Returns the poses of so many points that a file or several have, of the kind that the name ends in:
/// - .npy: float32 or float64, [poses, points, 3]; .npz: the same as its array `positions`;
/// - .pc2: the samples of a point cache;
/// - .obj: the vertices of files with # in the name for the digits of their numbers, from the least number on.
/// Throws OutputError naming the file: where it is not that, is of another number of points (both are said), has
/// coordinates that are not finite, ends too early, or where there are too many poses, or a number is missing.
PointPoses read_poses(const std::filesystem::path& path, std::size_t points);

}  // namespace drape::input
