#include "scene/scene_keys.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace drape {
namespace {

using Key = std::string_view;

constexpr Key scene_keys[] = {"$schema", "name",   "time",   "gravity", "wind",    "cloths", "colliders",
                              "cutters", "solver", "camera", "lights",  "ambient", "image",  "oracles"};
constexpr Key time_keys[] = {"fps", "frames"};
constexpr Key wind_keys[] = {"velocity", "gust", "air_density", "drag", "lift"};
constexpr Key gust_keys[] = {"amplitude", "period", "seed"};
constexpr Key cloth_keys[] = {"name",     "grid",      "size",     "placement", "areal_density", "stiffness", "damping",
                              "friction", "thickness", "velocity", "holes",     "pins",          "appearance"};
constexpr Key placement_keys[] = {"origin", "u", "v"};
constexpr Key stiffness_keys[] = {"stretch", "shear", "bend"};
constexpr Key pin_keys[] = {"edge", "corner", "at", "box", "release", "path", "pivot"};
constexpr Key motion_key_keys[] = {"t", "translate", "rotate"};
constexpr Key appearance_keys[] = {"front", "back", "pattern"};
constexpr Key collider_keys[] = {"planes", "spheres", "boxes", "ellipsoids"};
constexpr Key plane_keys[] = {"normal", "offset", "friction", "rotate", "path", "color"};
constexpr Key sphere_keys[] = {"center", "radius", "friction", "rotate", "path", "color"};
constexpr Key box_keys[] = {"center", "half_extents", "friction", "rotate", "path", "color"};
constexpr Key ellipsoid_keys[] = {"center", "radii", "friction", "rotate", "path", "color"};
constexpr Key cutter_keys[] = {"triangle", "active", "path"};
constexpr Key solver_keys[] = {"method", "substeps", "iterations", "collide", "tolerance", "strain_damping", "tethers"};
constexpr Key camera_keys[] = {"position", "target", "fov"};
constexpr Key light_keys[] = {"direction", "color", "intensity"};
constexpr Key image_keys[] = {"size", "samples", "background"};
constexpr Key oracle_keys[] = {"check"};

constexpr std::array tables{ObjectKeys{ObjectKind::scene, "scene", scene_keys},
                            ObjectKeys{ObjectKind::time, "time", time_keys},
                            ObjectKeys{ObjectKind::wind, "wind", wind_keys},
                            ObjectKeys{ObjectKind::gust, "gust", gust_keys},
                            ObjectKeys{ObjectKind::cloth, "cloth", cloth_keys},
                            ObjectKeys{ObjectKind::placement, "placement", placement_keys},
                            ObjectKeys{ObjectKind::stiffness, "stiffness", stiffness_keys},
                            ObjectKeys{ObjectKind::pin, "pin", pin_keys},
                            ObjectKeys{ObjectKind::motion_key, "motion_key", motion_key_keys},
                            ObjectKeys{ObjectKind::appearance, "appearance", appearance_keys},
                            ObjectKeys{ObjectKind::colliders, "colliders", collider_keys},
                            ObjectKeys{ObjectKind::plane, "plane", plane_keys},
                            ObjectKeys{ObjectKind::sphere, "sphere", sphere_keys},
                            ObjectKeys{ObjectKind::box, "box", box_keys},
                            ObjectKeys{ObjectKind::ellipsoid, "ellipsoid", ellipsoid_keys},
                            ObjectKeys{ObjectKind::cutter, "cutter", cutter_keys},
                            ObjectKeys{ObjectKind::solver, "solver", solver_keys},
                            ObjectKeys{ObjectKind::camera, "camera", camera_keys},
                            ObjectKeys{ObjectKind::light, "light", light_keys},
                            ObjectKeys{ObjectKind::image, "image", image_keys},
                            ObjectKeys{ObjectKind::oracle, "oracle", oracle_keys, true}};

constexpr bool indexed_by_kind() {
    for (std::size_t i = 0; i < tables.size(); ++i)
        if (static_cast<std::size_t>(tables[i].kind) != i) return false;
    return true;
}
static_assert(indexed_by_kind());

std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t above = row[j];
            row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0u : 1u)});
            diagonal = above;
        }
    }
    return row[b.size()];
}

}  // namespace

std::span<const ObjectKeys> scene_object_keys() { return tables; }

const ObjectKeys& keys_of(ObjectKind kind) { return tables[static_cast<std::size_t>(kind)]; }

bool has_key(const ObjectKeys& object, std::string_view key) {
    return std::find(object.keys.begin(), object.keys.end(), key) != object.keys.end();
}

std::string_view nearest_key(const ObjectKeys& object, std::string_view misspelt) {
    constexpr std::size_t farthest = 2;
    std::string_view nearest;
    std::size_t best = farthest + 1;
    for (const std::string_view key : object.keys) {
        if (misspelt.size() > key.size() + farthest) continue;
        const std::size_t distance = edit_distance(misspelt, key);
        if (distance < best && distance < key.size()) {
            best = distance;
            nearest = key;
        }
    }
    return nearest;
}

}  // namespace drape
