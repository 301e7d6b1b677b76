#include "scene_templates.h"

namespace drape::cli {

namespace {

constexpr std::string_view table =
    R"json(// A tablecloth falls on a table. Lengths in metres, y is up. Every key: `drape schema --markdown`.
{
  "name": "table",
  "time": {"fps": 60, "frames": 121},             // frame 0 is the start, frame 120 two seconds later
  "cloths": [{
    "grid": [61, 61],                             // particles: columns, rows
    "size": [1.6, 1.6],                           // metres along columns, rows
    "placement": {"origin": [-0.8, 0.95, -0.8], "u": [1, 0, 0], "v": [0, 0, 1]},  // first particle; columns, rows
    "fabric": "cotton",                           // or silk, denim, wool ...; "stiffness" and others override it
    "damping": 1.5,                               // 1/s
    "self_collision": true,                       // its folds never pass through each other; costs time
    "thickness": 0.01                             // kept from colliders
  }],
  "colliders": {
    "planes": [{"normal": [0, 1, 0], "offset": 0, "friction": 0.8}],
    "boxes": [{"center": [0, 0.45, 0], "half_extents": [0.5, 0.45, 0.5], "color": [0.5, 0.35, 0.2]}]  // half the edges
  },
  "solver": {"tolerance_motion": 0.1},            // m/s of error that cloth that crumples may have; asking for less costs
  "camera": {"position": [1.8, 1.9, 3.1], "target": [0, 0.5, 0], "fov": 28}
}
)json";

constexpr std::string_view flag =
    R"json(// A flag on its pole in gusty wind. Lengths in metres, y is up. Every key: `drape schema --markdown`.
{
  "name": "flag",
  "time": {"fps": 60, "frames": 121},             // frame 0 is the start, frame 120 two seconds later
  "wind": {
    "velocity": [5, 0, 1.5],                      // m/s
    "gust": {"amplitude": 2, "period": 1.6, "seed": 3}  // another seed, other gusts
  },
  "cloths": [{
    "name": "flag",
    "grid": [46, 31],                             // particles: columns, rows
    "size": [1.5, 1.0],                           // metres along columns, rows
    "placement": {"origin": [-0.75, 2.1, 0], "u": [1, 0, 0], "v": [0, -1, 0]},  // first particle; columns, rows
    "fabric": "silk",                             // or cotton, denim, wool ...; "stiffness" and others override it
    "damping": 0.3,                               // 1/s
    "self_collision": true,                       // its folds never pass through each other; costs time
    "pins": [{"edge": "left"}],                   // "left" is column 0, "top" is row 0
    "appearance": {"front": [0.80, 0.50, 0.12], "back": [0.72, 0.07, 0.10], "pattern": "checker"}
  }],
  "colliders": {"planes": [{"normal": [0, 1, 0], "offset": 0}]},
  "solver": {"tolerance_motion": 0.1},            // m/s of error that a fluttering flag may have; asking for less costs
  "camera": {"position": [0.7, 1.7, 3.0], "target": [-0.02, 1.45, 0.1], "fov": 34}
}
)json";

constexpr std::string_view curtain =
    R"json(// A curtain on five hooks is drawn to the left. Lengths in metres, y is up. Every key: `drape schema --markdown`.
{
  "name": "curtain",
  "time": {"fps": 60, "frames": 121},             // frame 0 is the start, frame 120 two seconds later
  "cloths": [{
    "name": "curtain",
    "grid": [49, 41],                             // particles: columns, rows
    "size": [1.8, 1.5],                           // metres along columns, rows
    "placement": {"origin": [-0.9, 1.75, 0], "u": [1, 0, 0], "v": [0, -1, 0]},  // first particle; columns, rows
    "fabric": "cotton",                           // or silk, denim, wool ...; "stiffness" and others override it
    "damping": 0.6,                               // 1/s
    "self_collision": true,                       // its folds never pass through each other; costs time
    "pins": [                                     // [column, row]; a path moves a pin: t in seconds
      {"at": [0, 0]},
      {"at": [12, 0], "path": [{"t": 0.2}, {"t": 1.6, "translate": [-0.2, 0, 0]}]},
      {"at": [24, 0], "path": [{"t": 0.2}, {"t": 1.6, "translate": [-0.4, 0, 0]}]},
      {"at": [36, 0], "path": [{"t": 0.2}, {"t": 1.6, "translate": [-0.6, 0, 0]}]},
      {"at": [48, 0], "path": [{"t": 0.2}, {"t": 1.6, "translate": [-0.8, 0, 0]}]}
    ],
    "appearance": {"front": [0.56, 0.11, 0.27], "back": [0.62, 0.13, 0.30], "pattern": "checker"}
  }],
  "wind": {"velocity": [0, 0, 0.6]},              // m/s: the draught of a window
  "colliders": {"planes": [{"normal": [0, 1, 0], "offset": 0}]},
  "camera": {"position": [0.35, 1.2, 3.0], "target": [-0.05, 0.96, 0], "fov": 37}
}
)json";

constexpr std::string_view ball =
    R"json(// A ball comes down on a sheet held at its corners. Lengths in metres, y is up. Every key: `drape schema --markdown`.
{
  "name": "ball",
  "time": {"fps": 60, "frames": 121},             // frame 0 is the start, frame 120 two seconds later
  "cloths": [{
    "grid": [49, 49],                             // particles: columns, rows
    "size": [1.6, 1.6],                           // metres along columns, rows
    "placement": {"origin": [-0.8, 1.2, -0.8], "u": [1, 0, 0], "v": [0, 0, 1]},  // first particle; columns, rows
    "fabric": "cotton",                           // or silk, denim, wool ...; "stiffness" and others override it
    "damping": 1.5,                               // 1/s
    "self_collision": true,                       // its folds never pass through each other; costs time
    "thickness": 0.01,                            // kept from colliders
    "pins": [                                     // "release": seconds after which a pin lets go
      {"corner": "top_left"}, {"corner": "top_right"},
      {"corner": "bottom_left", "release": 1.5}, {"corner": "bottom_right", "release": 1.5}
    ]
  }],
  "solver": {"tolerance_motion": 0.1},            // m/s of error that cloth that crumples may have; asking for less costs
  "colliders": {
    "planes": [{"normal": [0, 1, 0], "offset": 0}],
    "spheres": [{
      "center": [0, 1.6, 0], "radius": 0.2, "color": [0.85, 0.62, 0.25],
      "path": [{"t": 0.4}, {"t": 1.2, "translate": [0, -0.7, 0]}]  // colliders move by key frames: t in seconds
    }]
  },
  "camera": {"position": [1.8, 1.9, 3.0], "target": [0, 0.8, 0], "fov": 30}
}
)json";

constexpr std::string_view cut =
    R"json(// A blade cuts a piece off a hanging sheet. Lengths in metres, y is up. Every key: `drape schema --markdown`.
{
  "name": "cut",
  "time": {"fps": 60, "frames": 121},             // frame 0 is the start, frame 120 two seconds later
  "wind": {"velocity": [0, 0, 1]},                // m/s
  "cloths": [{
    "name": "sheet",
    "grid": [49, 41],                             // particles: columns, rows
    "size": [1.2, 1.0],                           // metres along columns, rows
    "placement": {"origin": [-0.6, 1.7, 0], "u": [1, 0, 0], "v": [0, -1, 0]},  // first particle; columns, rows
    "fabric": "cotton",                           // or silk, denim, wool ...; "stiffness" and others override it
    "damping": 0.5,                               // 1/s
    "self_collision": true,                       // its folds never pass through each other; costs time
    "pins": [{"edge": "top"}]                     // "left" is column 0, "top" is row 0
  }],
  "cutters": [{                                   // a triangle that cuts what it sweeps through
    "triangle": [[-0.9, 1.2, -1], [-0.9, 1.2, 1.5], [-0.75, 1.25, 0.2]],
    "active": [0.5, 1.0],                         // seconds
    "path": [{"t": 0.5}, {"t": 1.0, "translate": [1.8, 0, 0]}]
  }],
  "solver": {"tolerance_motion": 0.1},            // m/s of error that a piece that falls may have; asking for less costs
  "colliders": {"planes": [{"normal": [0, 1, 0], "offset": 0, "friction": 0.5}]},
  "camera": {"position": [1.2, 1.6, 3.6], "target": [0, 0.8, 0.1], "fov": 34}
}
)json";

constexpr SceneTemplate templates[] = {
    {"table", "a tablecloth falls on a table", table},
    {"flag", "a flag on its pole in gusty wind", flag},
    {"curtain", "a curtain on hooks that are moved by key frames", curtain},
    {"ball", "a ball comes down on a sheet, and two corners let go", ball},
    {"cut", "a blade cuts a piece off a hanging sheet", cut},
};

}  // namespace

std::span<const SceneTemplate> scene_templates() { return templates; }

}  // namespace drape::cli
