#include "cloth/kept_turn.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/vectors.h"
#include "cloth/cut_topology.h"

namespace drape {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Particles this near to a line, as a share of the cloth's diagonal, are on it: positions are rounded.
constexpr double line_width = 1e-5;

/// Returns when the pin of every particle lets go, s: infinite if it never does, 0 where none holds it.
std::vector<double> release_times(const ClothGeometry& cloth) {
    std::vector<double> all;
    for (std::size_t i = 0; i < cloth.position.size(); ++i)
        all.push_back(cloth.position[i].w == 0 && cloth.free_weight[i] > 0 ? infinity : 0);
    for (const glsl::PinnedParticle& pin : cloth.pinned)
        all[cloth.grid.particle(static_cast<std::uint32_t>(pin.index.x), static_cast<std::uint32_t>(pin.index.y))] =
            cloth.dynamic_pins[static_cast<std::size_t>(pin.index.z)].release.value_or(infinity);
    return all;
}

Vec3 place_of(const ClothGeometry& cloth, std::size_t particle) {
    const glsl::vec4& at = cloth.position[particle];
    return {double{at.x}, double{at.y}, double{at.z}};
}

double distance_from_line(const Vec3& way, const Vec3& axis) { return length(minus(way, times(dot(way, axis), axis))); }

/// Returns the values that gravity has in a scene, apart from zero.
std::vector<Vec3> gravities(const SceneDescription& scene) {
    std::vector<Vec3> all;
    for (const VectorKey& key : scene.gravity_keys) all.push_back(key.value);
    if (all.empty()) all.push_back(scene.gravity);
    std::erase_if(all, [](const Vec3& each) { return length(each) == 0; });
    return all;
}

/// Sets the axis of a cloth that is held by the particles `held`, if it has one.
void set_axis(const SceneDescription& scene, const ClothGeometry& cloth, const std::vector<std::size_t>& held,
              KeptTurn& turn) {
    const double width = line_width * double{cloth.reach()};
    const Vec3 first = place_of(cloth, held.front());
    const auto way = [&](std::size_t particle) { return minus(place_of(cloth, particle), first); };
    const std::size_t farthest = *std::ranges::max_element(held, {}, [&](std::size_t i) { return length(way(i)); });
    const std::vector<Vec3> pulls = gravities(scene);
    Vec3 axis{};
    if (length(way(farthest)) > width)
        axis = unit_of(way(farthest));
    else if (!pulls.empty())
        axis = unit_of(pulls.front());
    else
        turn.any = true;
    const bool holds_on_line =
        std::ranges::all_of(held, [&](std::size_t i) { return distance_from_line(way(i), axis) <= width; });
    const bool pulls_along =
        std::ranges::all_of(pulls, [&](const Vec3& g) { return distance_from_line(unit_of(g), axis) <= line_width; });
    if (holds_on_line && pulls_along) turn.axis = axis;
}

/// Returns the particle with mass that is nearest to the middle of the grid.
std::size_t middle_particle(const ClothGeometry& cloth) {
    const std::size_t columns = cloth.grid.columns();
    const double middle_x = (double(columns) - 1) / 2, middle_y = (double(cloth.grid.rows()) - 1) / 2;
    std::size_t nearest = 0;
    double least = infinity;
    for (std::size_t i = 0; i < cloth.free_weight.size(); ++i) {
        const std::size_t column = i % columns, row = i / columns;
        const double away = std::hypot(double(column) - middle_x, double(row) - middle_y);
        if (cloth.free_weight[i] > 0 && away < least) least = away, nearest = i;
    }
    return nearest;
}

bool is_one_piece(const ClothGeometry& cloth) {
    if (cloth.grid.whole()) return true;
    const CutTopology topology(cloth);
    const std::vector<std::size_t> pieces = pieces_of(topology);
    const std::size_t own = pieces[middle_particle(cloth)];
    for (std::size_t i = 0; i < pieces.size(); ++i)
        if (cloth.free_weight[i] > 0 && pieces[i] != own) return false;
    return true;
}

glsl::ivec2 texel_of(const ClothGeometry& cloth, std::size_t particle) {
    return {static_cast<int>(particle % cloth.grid.columns()), static_cast<int>(particle / cloth.grid.columns())};
}

}  // namespace

std::optional<KeptTurn> kept_turn(const SceneDescription& scene, const ClothGeometry& cloth) {
    if (scene.comes_apart() || !is_one_piece(cloth)) return std::nullopt;
    const std::vector<double> until = release_times(cloth);
    std::vector<std::size_t> held;
    for (std::size_t i = 0; i < until.size(); ++i)
        if (until[i] > 0) held.push_back(i);
    if (held.empty()) return KeptTurn{.about = texel_of(cloth, middle_particle(cloth))};
    const std::size_t last = *std::ranges::max_element(held, {}, [&](std::size_t i) { return until[i]; });
    KeptTurn turn{.about = texel_of(cloth, last), .until = until[last]};
    if (!cloth.has_motion) set_axis(scene, cloth, held, turn);
    return turn.turns_held() || turn.until < infinity ? std::optional(turn) : std::nullopt;
}

}  // namespace drape
