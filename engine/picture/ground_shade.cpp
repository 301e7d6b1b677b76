#include "picture/ground_shade.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <memory>
#include <set>

#include "base/vectors.h"
#include "picture/collider_mesh.h"
#include "picture/collider_surface.h"
#include "vulkan/api.h"
#include "world/collider_pose.h"

namespace drape {

using graph::Access;
using graph::Handle;

namespace {

constexpr auto map_side = static_cast<std::size_t>(glsl::ground_side);
constexpr std::size_t finest_count = map_side * map_side;
/// The coarser maps have a quarter, a sixteenth and a sixty-fourth as many.
constexpr std::size_t column_count = finest_count + finest_count / 4 + finest_count / 16 + finest_count / 64;
constexpr glsl::uint no_height = UINT32_MAX;

glsl::vec4 row(const Vec3& axis, double offset) {
    return {static_cast<float>(axis[0]), static_cast<float>(axis[1]), static_cast<float>(axis[2]),
            static_cast<float>(offset)};
}

/// Calls `take` for points of a surface that are at most `apart` metres from each other along edges, but for edges
/// longer than that 256 times.
template <class Take>
void for_points(const ColliderSurface& surface, double apart, const Take& take) {
    for (const auto& [a, b, c] : surface.triangles) {
        const Vec3& corner = surface.vertices[a];
        const Vec3 along = minus(surface.vertices[b], corner), across = minus(surface.vertices[c], corner);
        const double longest = std::max({length(along), length(across), length(minus(along, across))});
        const int parts = static_cast<int>(std::clamp(std::ceil(longest / apart), 1.0, 256.0));
        for (int i = 0; i <= parts; ++i)
            for (int j = 0; i + j <= parts; ++j)
                take(plus(corner, plus(times(double(i) / parts, along), times(double(j) / parts, across))));
    }
}

/// Returns one point of each small cube in which a surface has some.
std::vector<Vec3> thinned_points(const ColliderSurface& surface, double apart) {
    std::set<std::array<std::int64_t, 3>> cubes;
    std::vector<Vec3> points;
    for_points(surface, apart, [&](const Vec3& at) {
        std::array<std::int64_t, 3> cube{};
        for (std::size_t k = 0; k < 3; ++k) cube[k] = static_cast<std::int64_t>(std::floor(at[k] / apart));
        if (cubes.insert(cube).second) points.push_back(at);
    });
    return points;
}

ColliderSurface surface_of(const Collider& body) { return collider_surface(body, 48, {}); }

}  // namespace

Vec3 GroundMap::place(const Vec3& world) const {
    const Vec3 away = minus(world, corner);
    return times(1 / column_side, {dot(x, away), dot(z, away), dot(normal, away)});
}

GroundMap ground_map(const Collider& floor, const BoundingSphere& extent) {
    const auto& r = plane_pose(floor, 0).rotation;
    const Vec3 center = plane_pose(floor, 0).center;
    const double half_side = 1.5 * extent.radius;
    GroundMap map{{r[0], r[3], r[6]}, {r[1], r[4], r[7]}, {r[2], r[5], r[8]}, {}, 2 * half_side / glsl::ground_side};
    const double height = dot(map.normal, minus(extent.center, center));
    map.corner = minus(extent.center, plus(times(height, map.normal), times(half_side, plus(map.x, map.z))));
    return map;
}

GroundShade::GroundShade(Pipelines& pipelines, const GroundMap& map, const std::vector<Collider>& bodies, bool cut)
    : map_(map),
      levels_(&pipelines.get("ground_levels.comp")),
      shade_(&pipelines.get("ground_shade.comp")),
      spread_(&pipelines.get("ground_spread.comp")) {
    const auto cloth_of = [&](std::uint32_t is_cut) {
        return &pipelines.get("ground_columns.comp", [is_cut](std::string_view) { return is_cut; });
    };
    cloth_ = cloth_of(0);
    if (cut) cut_cloth_ = cloth_of(1);
    for (const Collider& body : bodies) {
        const bool unbounded = special(body.shape).plane != nullptr;
        points_.push_back(unbounded || body.deforms() ? std::vector<Vec3>{}
                                                      : thinned_points(surface_of(body), 0.5 * map.column_side));
    }
}

std::vector<glsl::uint> GroundShade::columns(std::span<const Collider> bodies, double time) const {
    std::vector<glsl::uint> found(2 * finest_count, 0);
    for (std::size_t column = 0; column < finest_count; ++column) found[2 * column] = no_height;
    const auto enter = [&](const Vec3& place) {
        if (!(place[0] >= 0 && place[1] >= 0 && place[0] < double(map_side) && place[1] < double(map_side))) return;
        const std::size_t column = static_cast<std::size_t>(place[1]) * map_side + static_cast<std::size_t>(place[0]);
        const auto height = std::bit_cast<glsl::uint>(static_cast<float>(std::max(place[2], 0.0)));
        found[2 * column] = std::min(found[2 * column], height);
        found[2 * column + 1] = std::max(found[2 * column + 1], height);
    };
    for (std::size_t k = 0; k < points_.size(); ++k) {
        const Collider body = formed(bodies[k], time);
        const ColliderPose pose = collider_pose(body, time);
        const auto enter_local = [&](const Vec3& local) {
            enter(map_.place(plus(pose.center, rotate(pose.rotation, local))));
        };
        if (body.deforms())
            for_points(surface_of(body), 0.5 * map_.column_side, enter_local);
        else
            std::ranges::for_each(points_[k], enter_local);
    }
    return found;
}

void GroundShade::write(const graph::ResourcePool& pool, std::uint32_t slot, std::span<const Collider> bodies,
                        double time) const {
    const std::vector<glsl::uint> found = columns(bodies, time);
    std::memcpy(pool.buffer(bodies_name, slot).mapped().data(), found.data(), found.size() * sizeof(glsl::uint));
}

void GroundShade::add_cloth(graph::Graph& graph, const RasterCloth& cloth, Handle& columns) const {
    const bool cut = cloth.cut_vertices.valid();
    const std::uint32_t triangles = cloth.index_count / 3;
    const double spacing = std::max(cloth.size_u / (cloth.columns - 1.0), cloth.size_v / (cloth.rows - 1.0));
    const auto parts = static_cast<std::uint32_t>(std::clamp(std::ceil(spacing / map_.column_side), 1.0, 64.0));
    const double scale = 1 / map_.column_side;
    const auto row_of = [&](const Vec3& axis) { return row(times(scale, axis), -scale * dot(axis, map_.corner)); };
    const glsl::GroundColumnsPush push{{cloth.columns, cloth.rows, triangles, parts},
                                       {row_of(map_.x), row_of(map_.z), row_of(map_.normal)}};
    graph.add_pass(
        {cloth.name + "/columns", "shadow", "ground columns"},
        [&](graph::PassSetup& setup) {
            setup.read(cloth.position, Access::compute_read, "position");
            setup.read(cloth.indices, Access::compute_read, "triangles");
            if (cut) setup.read(cloth.cut_vertices, Access::compute_read, "cut_vertices");
            setup.read(columns, Access::compute_read);
            columns = setup.write(columns, Access::compute_write, "columns");
        },
        [pipeline = cut ? cut_cloth_ : cloth_, triangles, push](graph::PassContext& context) {
            context.dispatch(*pipeline, push, triangles, 1);
        });
}

Handle GroundShade::add(graph::Graph& graph, std::span<const RasterCloth> cloths) const {
    const Handle bodies = graph.buffer<glsl::uint>(bodies_name, 2 * finest_count, graph::Lifetime::host_input);
    Handle columns = graph.buffer<glsl::uint>(columns_name, 2 * column_count, graph::Lifetime::transient);
    Handle open = graph.buffer<float>(open_name, finest_count, graph::Lifetime::transient);
    Handle shade = graph.buffer({.name = shade_name,
                                 .byte_count = 4 * finest_count * sizeof(glsl::vec4),
                                 .element = &glsl::layout_of<glsl::vec4>(),
                                 .texels = true});
    const auto copied = std::make_shared<Handle>();
    graph.add_pass(
        {"ground columns of bodies", "shadow", "ground columns of bodies"},
        [&](graph::PassSetup& setup) {
            setup.read(bodies, Access::transfer_read);
            *copied = columns = setup.write(columns, Access::transfer_write);
        },
        [copied, bodies](graph::PassContext& context) {
            const VkBufferCopy region{0, 0, 2 * finest_count * sizeof(glsl::uint)};
            vkCmdCopyBuffer(context.commands(), context.buffer(bodies).handle(), context.buffer(*copied).handle(), 1,
                            &region);
        });
    for (const RasterCloth& cloth : cloths) add_cloth(graph, cloth, columns);
    const auto add_pass = [&](const char* name, const vulkan::ComputePipeline* pipeline, std::size_t invocations,
                              const std::function<void(graph::PassSetup&)>& setup) {
        graph.add_pass({name, "shadow", name}, setup, [pipeline, invocations](graph::PassContext& context) {
            context.dispatch(*pipeline, {}, static_cast<std::uint32_t>(invocations), 1);
        });
    };
    add_pass("ground levels", levels_, column_count - finest_count, [&](graph::PassSetup& setup) {
        setup.read(columns, Access::compute_read);
        columns = setup.write(columns, Access::compute_write, "columns");
    });
    add_pass("ground shade", shade_, finest_count, [&](graph::PassSetup& setup) {
        setup.read(columns, Access::compute_read, "columns");
        open = setup.write(open, Access::compute_write, "open");
    });
    add_pass("ground spread", spread_, 4 * finest_count, [&](graph::PassSetup& setup) {
        setup.read(open, Access::compute_read, "open");
        shade = setup.write(shade, Access::compute_write, "ground_shade");
    });
    return shade;
}

}  // namespace drape
