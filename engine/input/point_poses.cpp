#include "input/point_poses.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstring>
#include <map>
#include <string>

#include "input/array_file.h"
#include "input/file_source.h"
#include "input/obj_file.h"
#include "input/point_cache.h"

namespace drape::input {

namespace {

/// Larger coordinates have squares that overflow in single precision.
constexpr double most_coordinate = 1e15;

OutputError of_another_mesh(const std::string& name, std::size_t points, const std::string& got) {
    return unreadable(name, fmt::format("the mesh has {} vertices, and it has {}", points, got));
}

void expect_room(const std::string& name, std::size_t points, std::uint64_t poses) {
    const std::uint64_t bytes = 12 * std::max<std::uint64_t>(points, 1);
    if (poses > most_pose_bytes / bytes)
        throw unreadable(name, fmt::format("{} poses of {} vertices are more than the {} bytes there is room for",
                                           poses, points, most_pose_bytes));
}

PointPoses array_poses(const std::filesystem::path& path, std::size_t points) {
    const Array array = load_array(path, "positions", [&](const Array& head) -> std::uint64_t {
        const std::vector<std::uint64_t>& shape = head.shape;
        const bool is_real = head.type == "<f4" || head.type == "<f8";
        if (!is_real || shape.size() != 3 || shape[1] != points || shape[2] != 3 || shape[0] == 0)
            throw unreadable(
                path.string(),
                fmt::format("the mesh needs float32 or float64 (poses, {}, 3), and it has {}", points, head.text()));
        expect_room(path.string(), points, shape[0]);
        return head.count();
    });
    PointPoses poses{points, array.shape[0], std::vector<float>(array.count())};
    for (std::size_t i = 0; i < poses.xyz.size(); ++i) poses.xyz[i] = static_cast<float>(array.value(i));
    return poses;
}

PointPoses cached_poses(const std::filesystem::path& path, std::size_t points) {
    FileSource file(path);
    const PointCacheHead head = read_head(file);
    if (static_cast<std::size_t>(head.points) != points)
        throw of_another_mesh(file.name(), points, fmt::format("{}", head.points));
    PointPoses poses{points, static_cast<std::size_t>(head.samples), {}};
    expect_room(file.name(), points, poses.count);
    const std::uint64_t bytes = 12 * std::uint64_t{points} * poses.count;
    if (file.size() < bytes) throw unreadable(file.name(), "it ends too early");  // before memory is taken for it
    poses.xyz.resize(3 * points * poses.count);
    if (file.read(reinterpret_cast<char*>(poses.xyz.data()), bytes) != bytes)
        throw unreadable(file.name(), "it ends too early");
    return poses;
}

/// Returns the files by number.
std::map<std::uint64_t, std::filesystem::path> numbered_files(const std::filesystem::path& path) {
    const std::string name = path.filename().string();
    const std::size_t first = name.find('#'), last = name.find_last_of('#');
    if (first == name.npos || name.find_first_not_of('#', first) <= last)
        throw unreadable(path.string(), "one run of # must stand in its name for the digits of the files' numbers");
    const std::string before = name.substr(0, first), after = name.substr(last + 1);
    std::map<std::uint64_t, std::filesystem::path> files;
    std::error_code code;
    const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
    for (const auto& each : std::filesystem::directory_iterator(folder, code)) {
        const std::string found = each.path().filename().string();
        if (found.size() < name.size() || !found.starts_with(before) || !found.ends_with(after)) continue;
        const std::string digits = found.substr(first, found.size() - before.size() - after.size());
        std::uint64_t number = 0;
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
        if (error == std::errc{} && end == digits.data() + digits.size()) files[number] = each.path();
    }
    if (files.empty()) throw unreadable(path.string(), "there is no such file, with digits for the #");
    std::uint64_t expected = files.begin()->first;
    for (const auto& [number, file] : files)
        if (number != expected++)
            throw unreadable(path.string(), fmt::format("number {} is missing before {}", expected - 1, file.string()));
    return files;
}

PointPoses obj_poses(const std::filesystem::path& path, std::size_t points) {
    const auto files = numbered_files(path);
    expect_room(path.string(), points, files.size());
    PointPoses poses{points, files.size(), {}};
    for (const auto& [number, name] : files) {
        const std::vector<std::array<double, 3>> vertices = read_obj_vertices(name);
        if (vertices.size() != points) throw of_another_mesh(name.string(), points, fmt::format("{}", vertices.size()));
        for (const std::array<double, 3>& at : vertices)
            for (const double x : at) poses.xyz.push_back(static_cast<float>(x));
    }
    return poses;
}

}  // namespace

PointCacheHead read_head(FileSource& file) {
    PointCacheHead head{};
    if (file.read(reinterpret_cast<char*>(&head), sizeof head) != sizeof head ||
        std::memcmp(head.signature, "POINTCACHE2", 12) != 0 || head.points < 0 || head.samples < 1)
        throw unreadable(file.name(), "it is no point cache (PC2) with a sample");
    return head;
}

PointPoses read_poses(const std::filesystem::path& path, std::size_t points) {
    const std::string extension = extension_of(path);
    PointPoses poses;
    if (extension == ".npy" || extension == ".npz")
        poses = array_poses(path, points);
    else if (extension == ".pc2")
        poses = cached_poses(path, points);
    else if (extension == ".obj")
        poses = obj_poses(path, points);
    else
        throw unreadable(path.string(), "poses are read from .npy, .npz, .pc2 and .obj");
    for (std::size_t i = 0; i < poses.xyz.size(); ++i)
        if (!(std::abs(poses.xyz[i]) < most_coordinate))
            throw unreadable(path.string(), fmt::format("coordinates must be finite, vertex {} of pose {} has {}",
                                                        i / 3 % points, i / 3 / points, poses.xyz[i]));
    return poses;
}

}  // namespace drape::input
