// In this scene every key of the format occurs, none with its default value.
#pragma once

namespace drape::testing {

inline constexpr const char* full_scene =
    R"json({
  // comments are part of the format
  "$schema": "scene.schema.json",
  "name": "everything",
  "time": {"fps": 30, "frames": 12},
  "up": "z",
  "gravity": [0.5, -1.62, 0.25],
  "gravity_keys": [{"t": 0, "gravity": [0.5, -1.5, 0.25]}, {"t": 1, "gravity": [0, 0, -2]}],
  "wind": {"velocity": [3, 0, 4], "keys": [{"t": 0, "velocity": [1, 2, 2]}, {"t": 0.5, "velocity": [0, 4, 3]}], "gust": {"amplitude": 2, "period": 1.5, "seed": 7},
           "air_density": 1.1, "drag": 0.9, "lift": 0.4},
  "cloths": [
    {"name": "banner", "grid": [96, 64], "size": [1.5, 2.5],
     "placement": {"origin": [0.25, 20, 0], "u": [0, 0, 2], "v": [0, -3, 0], "scale": [1.5, 0.5], "jitter": 0.001, "seed": 3},
     "fabric": "denim", "areal_density": 0.15, "stiffness": {"stretch": {"warp": 2000, "weft": 1500}, "shear": 150, "bend": {"warp": 1e-5, "weft": 2e-5, "twist": 3e-5}},
     "damping": 0.1, "friction": 0.35, "thickness": 0.004, "contact": "particles", "self_collision": {"thickness": 0.006, "friction": 0.25}, "velocity": [1, 2, 3],
     "holes": [[[40, 20], [50, 30]]],
     "pins": [{"edge": "bottom"},
              {"corner": "top_right", "release": 2.5},
              {"at": [10, 3], "pivot": [7, 8, 9],
               "path": [{"t": 0, "translate": [0, 0, 0]}, {"t": 1.5, "translate": [0.2, 0, 0.1], "rotate": [0, 720, 5]}]},
              {"box": [[1, 2], [3, 4]]}],
     "loads": [{"edge": "right", "force": [1, 2, -3]},
               {"force_keys": [{"t": 0, "force": [0, 0, 0]}, {"t": 0.5, "force": [0, 0, 4]}]},
               {"at": [5, 6], "pressure": -2.5},
               {"box": [[1, 2], [3, 4]], "pressure_keys": [{"t": 0, "pressure": 0}, {"t": 1, "pressure": 7}]}],
     "appearance": {"front": [0.1, 0.2, 0.3], "back": [0.4, 0.5, 0.6], "pattern": "stripes", "second": [0.7, 0.8, 0.9],
                    "roughness": 0.5, "sheen": 0.4, "weave": 0.002, "hem": 0.03, "texture": ")json" DRAPE_SOURCE_DIR
    R"json(/tests/scene/given/cells.png"}},
    {"name": "rigid-one", "grid": [3, 5], "placement": {"origin": [9, 9, 9]}, "stiffness": "rigid"},
    {"name": "given", "grid": [3, 5], "tear": {"tension": 300}, "rest": "start", "start": ")json" DRAPE_SOURCE_DIR
    R"json(/tests/scene/given/shape.obj",
     "velocities": ")json" DRAPE_SOURCE_DIR R"json(/tests/scene/given/velocities.npy"},
    {"name": "mapped", "grid": [5, 3], "placement": {"origin": [-9, 9, 9]},
     "tear": {"strain": 0.4}, "stiffness_keys": [{"t": 0.25, "factor": 1}, {"t": 1.5, "factor": 0.125}],
     "maps": {"holes": ")json" DRAPE_SOURCE_DIR R"json(/tests/scene/given/cells.png",
              "stiffness": ")json" DRAPE_SOURCE_DIR R"json(/tests/scene/given/cells.png", "stiffness_range": [0.5, 2],
              "density": ")json" DRAPE_SOURCE_DIR R"json(/tests/scene/given/cells.png", "density_range": [3, 0.5],
              "tear": ")json" DRAPE_SOURCE_DIR R"json(/tests/scene/given/cells.png", "tear_range": [0.25, 1.5],
              "friction": ")json" DRAPE_SOURCE_DIR R"json(/tests/scene/given/cells.png", "friction_range": [0, 2],
              "thickness": ")json" DRAPE_SOURCE_DIR
    R"json(/tests/scene/given/cells.png", "thickness_range": [0.5, 2]},
     "loads": [{"pressure": 3, "map": ")json" DRAPE_SOURCE_DIR R"json(/tests/scene/given/cells.png"}]}],
  "colliders": {
    "planes": [{"normal": [0, 0, 2], "offset": -0.5, "friction": 0.6, "rotate": [1, 2, 3], "color": [0.1, 0.1, 0.2],
                "path": [{"t": 0}]}],
    "spheres": [{"center": [0, 1, 0.5], "radius": 0.3, "friction": 0.1, "rotate": [4, 5, 6], "color": [0.2, 0.1, 0.2],
                 "path": [{"t": 1, "translate": [1, 1, 1]}]}],
    "boxes": [{"center": [0, 0.5, 0], "half_extents": [0.3, 0.1, 0.2], "friction": 0.2, "rotate": [0, 30, 0],
               "color": [0.3, 0.1, 0.2], "path": [{"t": 2, "rotate": [1, 1, 1]}]}],
    "ellipsoids": [{"center": [0, 1, 0], "radii": [0.4, 0.2, 0.1], "friction": 0.4, "rotate": [7, 8, 9],
                    "color": [0.4, 0.1, 0.2], "path": [{"t": 3}]}],
    "capsules": [{"from": [0, 1, 0.25], "to": [1, 2, 3], "radii": [0.2, 0.1], "friction": 0.7, "rotate": [1, 8, 9],
                  "color": [0.5, 0.1, 0.2], "path": [{"t": 4}]},
                 {"radius": 0.125, "mass": 40, "inertia": [3, 1, 3.5], "velocity": [1, 0, -2], "angular_velocity": [0, 0.5, 0]}],
    "meshes": [{"file": ")json" DRAPE_SOURCE_DIR
    R"json(/tests/scene/box.obj", "scale": 0.5, "position": [1, 2, 3], "shell": 0.25, "spacing": 0.125,
                "frames": ")json" DRAPE_SOURCE_DIR
    R"json(/tests/scene/box_pose_#.obj", "frames_per_second": 12.5, "frames_start": 0.25, "loop": true,
                "friction": 0.8, "rotate": [2, 4, 6], "color": [0.6, 0.1, 0.2], "path": [{"t": 5}]},
               {"file": ")json" DRAPE_SOURCE_DIR R"json(/tests/scene/box.obj", "solid": "strict"}]},
  "overlap": "refuse",
  "forces": true,
  "cutters": [{"triangle": [[0, 1, 0], [1, 1, 0], [0, 2, 0.5]], "active": [0.25, 0.5], "path": [{"t": 0.25, "translate": [0, 0, 1]}]}],
  "solver": {"method": "relax", "substeps": 11, "iterations": 3, "collide": "substep", "tolerance": 0.01, "tolerance_worst": 0.2, "tolerance_motion": 0.03, "estimate_error": false, "strain_damping": 0.05, "tethers": true},
  "camera": {"position": [1, 1.5, 2], "target": [0.5, 1, 0], "fov": 55,
             "keys": [{"t": 0, "position": [1, 2, 3], "target": [0, 1, 0]}, {"t": 2, "position": [3, 2, 1], "target": [0, 0, 1]}]},
  "lights": [{"direction": [0, -2, 0], "color": [1, 0.5, 0.25], "intensity": 0.75}, {}],
  "ambient": [0.1, 0.2, 0.3],
  "ambient_ground": [0.3, 0.2, 0.1],
  "image": {"size": [640, 360], "samples": 1, "background": [0, 0.5, 1], "fixtures": false, "blades": false, "alpha": true,
            "motion_blur": 4},
  "oracles": [{"check": "falls", "cloth": 0, "from_row": 1, "until_frame": 10, "error": 1.05}]
}
)json";

// Cloths with outlines do not meet, as those of the full scene do. Here every key of an outline occurs.
inline constexpr const char* outlined_scene =
    R"json({"cloths": [{"outline": {"path": "M0 0H8V8H0Z", "scale": 0.5, "spacing": 0.25}, "pins": [{"point": [0, 4]}]}]})json";

}  // namespace drape::testing
