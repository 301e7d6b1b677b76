// Scenes that tests build in code: one sheet of given size, no camera.
#pragma once

#include "scene/scene_description.h"

namespace drape::test {

/// A vertical sheet in the xy plane: columns along +x, rows along -y, corner (0, 0) at `origin`.
inline SceneDescription sheet(std::uint32_t columns, std::uint32_t rows, double width, double height,
                              std::uint32_t substeps, std::uint32_t iterations = 1) {
    SceneDescription scene;
    scene.name = "sheet";
    scene.time.frame_count = 2;
    Cloth cloth;
    cloth.name = "sheet";
    cloth.grid = {columns, rows};
    cloth.size = {width, height};
    scene.cloths.push_back(cloth);
    scene.solver.substeps = substeps;
    scene.solver.iterations = iterations;
    return scene;
}

inline Pin pin_box(std::uint32_t c0, std::uint32_t r0, std::uint32_t c1, std::uint32_t r1) {
    Pin pin;
    pin.particles = {{c0, r0}, {c1, r1}};
    return pin;
}

/// The whole of row 0.
inline Pin pin_top(const Cloth& cloth) { return pin_box(0, 0, cloth.grid[0] - 1, 0); }

}  // namespace drape::test
