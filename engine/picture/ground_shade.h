// The shade that cloth and bodies cast on the floor from all around: where they stand between it and the sky
// (shaders/ground_shade.comp).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "drape/scene.h"
#include "graph/executor.h"
#include "picture/framing.h"
#include "picture/raster_cloth.h"
#include "shared/raster_types.h"
#include "solver/pipelines.h"

namespace drape {

/// The square part of a floor that the maps of its shade show.
struct GroundMap {
    Vec3 x, normal, z;       ///< axes of the floor's coordinates, in the world
    Vec3 corner;             ///< m, in the world: where both of the map's coordinates are 0
    double column_side = 1;  ///< m
    /// Returns x, y on the map and the height above the floor, in columns' sides.
    Vec3 place(const Vec3& world) const;
};

/// Returns the map of a floor, a plane that keeps still, below the extent and half as wide again.
GroundMap ground_map(const Collider& floor, const BoundingSphere& extent);

class GroundShade {
  public:
    /// `bodies`: all colliders but the floor. `cut`: some cloth has cut vertices.
    GroundShade(Pipelines& pipelines, const GroundMap& map, const std::vector<Collider>& bodies, bool cut);

    /// Adds the passes that make the shade, in the stage "shadow"; returns the buffer that the encoding pass reads.
    graph::Handle add(graph::Graph& graph, std::span<const RasterCloth> cloths) const;
    /// Fills the host input of a slot. `bodies`: where those of the constructor are at `time` (s).
    void write(const graph::ResourcePool& pool, std::uint32_t slot, std::span<const Collider> bodies,
               double time) const;

    /// Returns the lowest and the highest point of bodies in each column, as shaders/include/ground_columns.h has them.
    std::vector<glsl::uint> columns(std::span<const Collider> bodies, double time) const;

    static constexpr const char* bodies_name = "ground/columns of bodies";
    static constexpr const char* columns_name = "ground/columns";
    static constexpr const char* open_name = "ground/open";
    static constexpr const char* shade_name = "ground/shade";

  private:
    void add_cloth(graph::Graph& graph, const RasterCloth& cloth, graph::Handle& columns) const;

    GroundMap map_;
    /// Points on each body's surface in its own frame, m, close enough to each other to miss no column; none of a
    /// plane.
    std::vector<std::vector<Vec3>> points_;
    const vulkan::ComputePipeline *cloth_, *cut_cloth_ = nullptr, *levels_, *shade_, *spread_;
};

}  // namespace drape
