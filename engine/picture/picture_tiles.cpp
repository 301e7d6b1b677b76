#include "picture/picture_tiles.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "picture/camera.h"
#include "picture/picture_places.h"
#include "world/collider_pose.h"

namespace drape {

namespace {

using Corners = std::array<std::array<double, 2>, 2>;

/// Returns the smallest and the largest x, y, pixels, of the corners of a box around a body; nothing if it may appear
/// anywhere in the picture.
std::optional<Corners> bounds_of(const Collider& body, double time, const Camera& camera, std::uint32_t width,
                                 std::uint32_t height) {
    const double reach = shape_geometry(body.shape).reach;
    if (!std::isfinite(reach)) return std::nullopt;
    const Vec3 center = collider_pose(body, time).center;
    Corners bounds{{{INFINITY, INFINITY}, {-INFINITY, -INFINITY}}};
    for (unsigned corner = 0; corner < 8; ++corner) {
        const auto side = [&](unsigned axis) { return corner >> axis & 1u ? reach : -reach; };
        const PixelPosition at = project(camera, width, height, sum(center, {side(0), side(1), side(2)}));
        if (!std::isfinite(at.depth)) return std::nullopt;
        bounds[0] = {std::min(bounds[0][0], at.x), std::min(bounds[0][1], at.y)};
        bounds[1] = {std::max(bounds[1][0], at.x), std::max(bounds[1][1], at.y)};
    }
    return bounds;
}

}  // namespace

PictureTiles::PictureTiles(std::uint32_t width, std::uint32_t height) : width_(width), height_(height) {
    // The tiles along a side are at most 128, so that a shader's loop over all of them ends.
    while ((std::max(width, height) - 1) >> shift_ >= 128) ++shift_;
    across_ = ((width - 1) >> shift_) + 1;
    down_ = ((height - 1) >> shift_) + 1;
}

std::vector<vulkan::SpecializationConstant> PictureTiles::constants() const {
    return {{"picture_width", width_}, {"picture_height", height_}, {"tile_shift", shift_}};
}

std::uint32_t PictureTiles::constant(std::string_view name) const {
    for (const vulkan::SpecializationConstant& each : constants())
        if (each.name == name) return each.value;
    throw std::logic_error("the picture's tiles have no constant " + std::string(name));
}

void PictureTiles::mark(const std::array<double, 2>& low, const std::array<double, 2>& high,
                        std::vector<std::uint32_t>& marks) const {
    // A margin of two pixels at either side allows for rounding, and for pictures that are moved by parts of a pixel.
    const auto tile = [&](double at, std::uint32_t size) {
        return static_cast<std::uint32_t>(std::clamp(at, 0.0, size - 1.0)) >> shift_;
    };
    for (std::uint32_t y = tile(low[1] - 2, height_); y <= tile(high[1] + 2, height_); ++y)
        for (std::uint32_t x = tile(low[0] - 2, width_); x <= tile(high[0] + 2, width_); ++x)
            marks[y * across_ + x] = 1;
}

std::vector<std::uint32_t> PictureTiles::marks(std::span<const Collider> bodies, double time,
                                               const Camera& camera) const {
    std::vector<std::uint32_t> marks(count());
    for (const Collider& body : bodies) {
        const std::optional<Corners> bounds = bounds_of(body, time, camera, width_, height_);
        if (!bounds) return std::vector<std::uint32_t>(count(), 1);
        mark((*bounds)[0], (*bounds)[1], marks);
    }
    return marks;
}

}  // namespace drape
