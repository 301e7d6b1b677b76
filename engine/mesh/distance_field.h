// Distances to a body at the points of a lattice, between which devices interpolate.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "mesh/mesh_shape.h"

namespace drape {

struct DistanceField {
    Vec3 lower{};                         ///< m: the first point, in the body's frame
    double spacing = 0;                   ///< m
    std::array<std::uint32_t, 3> size{};  ///< points along x, y, z
    std::vector<float> samples;           ///< m, negative inside; x varies fastest, then y
};

/// The largest number of points in a field, unless its spacing is asked for: 32 MiB on a device.
inline constexpr std::size_t usual_field_points = std::size_t{1} << 21;
/// The largest number of points in all fields of a scene: 128 MiB on a device, which every device allows for a buffer.
inline constexpr std::size_t most_field_points = std::size_t{1} << 23;

/// The largest number of points in a field that is computed again for every frame, of a mesh that deforms, unless its
/// spacing is asked for.
inline constexpr std::size_t usual_moving_points = std::size_t{1} << 18;

/// Returns a field without its samples.
DistanceField empty_field(const MeshShape& shape, double spacing, double margin);
/// Returns the distance from the body within which the field is exact, m: contact needs no distance farther than the
/// margin beyond a surface; deeper inside, distances only have to lead out.
double exact_within(double spacing, double margin);
/// Returns the number of points of a field with this spacing that extends `margin` (m) beyond the body.
std::size_t field_points(const MeshShape& shape, double spacing, double margin);
/// Returns the least spacing, not below `wanted`, with which a field has at most `most` points.
double field_spacing(const MeshShape& shape, double wanted, double margin, std::size_t most);

/// Returns the field, computed by all cores. A field that is still in use is not computed again.
std::shared_ptr<const DistanceField> distance_field(const std::shared_ptr<const MeshShape>& shape, double spacing,
                                                    double margin);

}  // namespace drape
