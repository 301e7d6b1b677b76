// Meshes of shapes whose distances are known, and their files.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "base/vectors.h"
#include "drape/scene.h"
#include "mesh/mesh_sequence.h"

namespace drape::test {

struct Triangles {
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;
};

/// A surface with two parameters that both go around, of `columns` x `rows` quads; `at(u, v)`: u and v from 0 to 1.
/// With poles its first and last row are points each.
template <class At>
Triangles around(std::uint32_t columns, std::uint32_t rows, bool poles, const At& at) {
    Triangles mesh;
    const std::uint32_t last = poles ? rows : rows - 1;
    for (std::uint32_t row = 0; row <= last; ++row)
        for (std::uint32_t column = 0; column < columns; ++column)
            mesh.vertices.push_back(
                at(poles && (row == 0 || row == rows) ? 0 : double(column) / columns, double(row) / rows));
    for (std::uint32_t row = 0; row < rows; ++row)
        for (std::uint32_t column = 0; column < columns; ++column) {
            const std::uint32_t below = (row + 1) % (last + 1), right = (column + 1) % columns;
            const std::uint32_t a = row * columns + column, b = row * columns + right, c = below * columns + column,
                                d = below * columns + right;
            mesh.triangles.push_back({a, c, d});
            mesh.triangles.push_back({a, d, b});
        }
    return mesh;
}

inline Vec3 on_ball(double radius, double u, double v) {
    const double polar = std::numbers::pi * v, azimuth = 2 * std::numbers::pi * u;
    if (v == 0 || v == 1) return {0, v == 0 ? radius : -radius, 0};
    return {radius * std::sin(polar) * std::sin(azimuth), radius * std::cos(polar),
            radius * std::sin(polar) * std::cos(azimuth)};
}

inline Triangles ball_mesh(double radius, std::uint32_t columns) {
    return around(columns, columns / 2, true, [=](double u, double v) { return on_ball(radius, u, v); });
}

/// A torus about y.
inline Triangles torus_mesh(double ring, double tube, std::uint32_t columns) {
    return around(columns, columns / 2, false, [=](double u, double v) {
        const double a = 2 * std::numbers::pi * u, b = 2 * std::numbers::pi * v, out = ring + tube * std::cos(b);
        return Vec3{out * std::sin(a), -tube * std::sin(b), out * std::cos(a)};
    });
}

/// A capsule along y, its ends' centres at -half and half. With an even number of rows its equator is a row of the one
/// ball and the next one of the other.
inline Triangles capsule_mesh(double half, double radius, std::uint32_t columns) {
    const std::uint32_t half_around = columns / 2, rows = half_around + 1;
    return around(columns, rows, true, [=](double u, double v) {
        const auto row = static_cast<std::uint32_t>(std::lround(v * rows));
        const bool upper = row <= columns / 4;
        Vec3 point = on_ball(radius, u, double(upper ? row : row - 1) / half_around);
        point[1] += upper ? half : -half;
        return point;
    });
}

inline Triangles box_mesh(const Vec3& half) {
    Triangles mesh;
    for (unsigned corner = 0; corner < 8; ++corner)
        mesh.vertices.push_back(
            {corner & 1 ? half[0] : -half[0], corner & 2 ? half[1] : -half[1], corner & 4 ? half[2] : -half[2]});
    mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
    return mesh;
}

/// A collider's shape as if it had been read from a file.
inline Mesh mesh_of(const Triangles& triangles, const Vec3& position, std::optional<double> shell = {}) {
    Mesh mesh;
    mesh.position = position;
    mesh.shell = shell;
    mesh.shape = std::make_shared<const MeshShape>(triangles.vertices, triangles.triangles, shell);
    return mesh;
}

/// A mesh that deforms: `at(place, pose)` says where a vertex is in each pose that stands at `place` in the mesh, m.
template <class At>
Mesh deforming_mesh(const Triangles& triangles, const Vec3& position, std::size_t poses, double per_second,
                    const At& at, std::optional<double> shell = {}) {
    Mesh mesh;
    mesh.position = position;
    mesh.shell = shell;
    mesh.frames_per_second = per_second;
    std::vector<std::uint32_t> places;
    const MeshShape form(triangles.vertices, triangles.triangles, shell, &places);
    std::vector<float> xyz;
    for (std::size_t pose = 0; pose < poses; ++pose)
        for (const Vec3& vertex : triangles.vertices)
            for (const double x : at(vertex, pose)) xyz.push_back(static_cast<float>(x));
    mesh.sequence = std::make_shared<const MeshSequence>(form, places, xyz);
    mesh.shape = mesh.sequence->form();
    return mesh;
}

/// Returns how often triangles wind around a point: the sum of their angles (van Oosterom and Strackee 1983; Jacobson
/// and others 2013) over the whole one.
inline double winding(const Triangles& mesh, const Vec3& p) {
    double sum = 0;
    for (const auto& [i, j, k] : mesh.triangles) {
        const Vec3 a = unit_of(minus(mesh.vertices[i], p)), b = unit_of(minus(mesh.vertices[j], p)),
                   c = unit_of(minus(mesh.vertices[k], p));
        sum += std::atan2(dot(a, cross(b, c)), 1 + dot(a, b) + dot(b, c) + dot(c, a));
    }
    return sum / (2 * std::numbers::pi);
}

inline void shift(Triangles& mesh, const Vec3& by) {
    for (Vec3& vertex : mesh.vertices)
        for (std::size_t axis = 0; axis < 3; ++axis) vertex[axis] += by[axis];
}

inline void add(Triangles& mesh, const Triangles& other) {
    const auto before = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
    for (const auto& [a, b, c] : other.triangles) mesh.triangles.push_back({before + a, before + b, before + c});
}

/// Writes an OBJ file into the folder for temporary files and returns its name.
inline std::string obj_file(const Triangles& mesh, const std::string& name, int digits = 9) {
    const std::filesystem::path path = std::filesystem::path(::testing::TempDir()) / name;
    std::ofstream file(path);
    file.precision(digits);
    for (const Vec3& v : mesh.vertices) file << "v " << v[0] << ' ' << v[1] << ' ' << v[2] << '\n';
    for (const auto& [a, b, c] : mesh.triangles) file << "f " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';
    return path.string();
}

}  // namespace drape::test
