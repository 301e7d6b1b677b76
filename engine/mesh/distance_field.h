// Distances to a body at the points of a lattice, which devices interpolate.
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

/// A field has at most so many points, unless its spacing is asked for: 32 MiB on a device.
inline constexpr std::size_t usual_field_points = std::size_t{1} << 21;
/// All fields of a scene have at most so many: 128 MiB on a device, what every one takes as a buffer.
inline constexpr std::size_t most_field_points = std::size_t{1} << 23;

/// A field that is made anew for every frame, of a mesh that deforms, has at most so many, unless its spacing is asked
/// for.
inline constexpr std::size_t usual_moving_points = std::size_t{1} << 18;

/// Returns a field without its samples.
DistanceField empty_field(const MeshShape& shape, double spacing, double margin);
/// Returns how far from the body distances are exact, m: contact does not look farther than the margin beyond a
/// surface; deeper inside, distances only have to lead out.
double exact_within(double spacing, double margin);
/// Returns how many points a field with this spacing has that goes `margin` (m) beyond the body.
std::size_t field_points(const MeshShape& shape, double spacing, double margin);
/// Returns the least spacing, not below `wanted`, with which a field has at most `most` points.
double field_spacing(const MeshShape& shape, double wanted, double margin, std::size_t most);

/// Returns the field, by all cores. The same one, asked for again while it is in use, is not made again.
std::shared_ptr<const DistanceField> distance_field(const std::shared_ptr<const MeshShape>& shape, double spacing,
                                                    double margin);

}  // namespace drape
