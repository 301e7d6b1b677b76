#include "cloth/cloth_model.h"

#include <cmath>

#include "base/vectors.h"
#include "cloth/loads.h"
#include "world/contact_shape.h"
#include "world/weather.h"

namespace drape {

double largest_coordinate(const Cloth& cloth) {
    const Vec3& o = cloth.start.empty() ? cloth.placement.origin : cloth.start.front();
    return std::hypot(o[0], o[1], o[2]) + std::hypot(cloth.size[0], cloth.size[1]);
}

namespace {

ClothActions actions_on(std::size_t cloth, const ModelOptions& options) {
    ClothActions actions{.holds = options.holds};
    for (std::size_t hand = 0; hand < options.hands.size(); ++hand)
        if (options.hands[hand] == cloth) actions.hands.push_back(hand);
    return actions;
}

/// Whoever may let go, take or turn gravity leaves nothing that is known of how the cloth turns.
std::optional<KeptTurn> turn_of(const SceneDescription& scene, const ClothGeometry& cloth,
                                const ModelOptions& options) {
    const bool known = cloth.sewn.empty() && !options.holds && !options.weight && options.hands.empty();
    return known ? kept_turn(scene, cloth) : std::nullopt;
}

MethodSettings settings_of(const SceneDescription& scene, double substep_length, const std::optional<KeptTurn>& turn,
                           const ModelOptions& options) {
    // Contact in an earlier iteration gives the cloth impulses that are no torque of its own forces.
    const bool touches_between = !scene.colliders.empty() && scene.solver.collide == CollideWhen::iteration &&
                                 scene.solver.iterations > 1 && named(scene.solver.method).iterates();
    return {scene.solver.substeps,
            scene.solver.iterations,
            substep_length,
            gravity_at(scene, 0),
            scene.solver.strain_damping,
            !scene.colliders.empty(),
            touches_between ? std::nullopt : turn,
            options.skip,
            options.device};
}

}  // namespace

ClothModel::ClothModel(const SceneDescription& scene, std::size_t cloth_index, const ModelOptions& options)
    : ClothGeometry(scene, scene.cloths[cloth_index], !options.skip, actions_on(cloth_index, options)),
      substep_length(1.0 / (scene.time.fps * scene.solver.substeps)),
      turn(turn_of(scene, *this, options)),
      scheme(row_of(scene.solver.method).scheme(*this, settings_of(scene, substep_length, turn, options))) {
    // Loads act from the start on, as gravity does.
    if (const Cloth& cloth = scene.cloths[cloth_index]; !cloth.loads.empty())
        kick(load_forces(cloth, grid, start_places(), 0));
    set_constants(scene, scene.cloths[cloth_index], options.air || scene.wind.blows());
}

std::vector<Vec3> ClothModel::start_places() const {
    std::vector<Vec3> at;
    at.reserve(position.size());
    for (const glsl::vec4& place : position) at.push_back({double{place.x}, double{place.y}, double{place.z}});
    return at;
}

void ClothModel::kick(std::span<const Vec3> force) {
    // Such damping leaves nothing of a kick (method_line.cpp).
    if (scheme.second_order && damping * substep_length > 1) return;
    scheme.starts.resize(force.size(), scheme.start);
    const auto kicked = [&](const glsl::vec4& start, std::size_t particle) {
        MethodSettings pulled{.substep_length = substep_length};
        pulled.gravity = times(double{free_weight[particle]} / inner_mass, force[particle]);
        const glsl::vec4 more = verlet_start(*this, pulled, {});
        return glsl::vec4{start.x + more.x, start.y + more.y, start.z + more.z, start.w};
    };
    for (std::size_t k = 0; k < force.size(); ++k) scheme.starts[k] = kicked(scheme.starts[k], k);
    for (Sewn& each : sewn) each.kick = kicked(each.kick, each.particle);
}

std::vector<glsl::vec4> ClothModel::start_displacement() const {
    std::vector<glsl::vec4> texels;
    texels.reserve(position.size());
    for (std::size_t i = 0; i < position.size(); ++i) texels.push_back(position[i].w > 0 ? start_of(i) : glsl::vec4{});
    return texels;
}

std::vector<glsl::vec4> ClothModel::start_excess() const {
    std::vector<glsl::vec4> texels;
    texels.reserve(position.size());
    for (std::size_t i = 0; i < position.size(); ++i) {
        const Vec3& v = velocities.empty() ? velocity : velocities[i];
        const auto excess = [&](std::size_t k, float displacement) {
            return static_cast<float>(v[k] * substep_length - displacement);
        };
        const glsl::vec4& start = start_of(i);
        texels.push_back(position[i].w > 0 ? glsl::vec4{excess(0, start.x), excess(1, start.y), excess(2, start.z), 0}
                                           : glsl::vec4{});
    }
    return texels;
}

void ClothModel::set_constants(const SceneDescription& scene, const Cloth& cloth, bool air) {
    const double h = substep_length;
    const auto rest_length = [&](std::size_t direction) {
        return static_cast<float>(stiffness_constant.spring[direction] > 0 ? stiffness_constant.rest_length[direction]
                                                                           : 0);
    };
    residual = {grid.size(), {rest_length(0), rest_length(1)}, compression};
    const Wind& w = scene.wind;
    const double half_density = air ? 0.5 * w.air_density : 0;  // without air, the pass only adds the change of gravity
    wind = {grid.size(),
            0,
            static_cast<float>(1.0 / h),
            static_cast<float>(half_density * (w.drag - w.lift)),
            static_cast<float>(half_density * w.lift),
            {static_cast<float>(spacing[0]), static_cast<float>(spacing[1])},
            0,
            static_cast<float>(inner_mass),
            0,
            0};
    for (const Cloth& each : scene.cloths) {
        if (&each == &cloth) break;
        wind.first_load += static_cast<int>(each.loads.size());
    }
    // Another round cannot improve contacts that are shallower than a few roundings of the coordinates.
    collision = {{static_cast<float>(cloth.thickness), static_cast<float>(std::sqrt(cloth.friction)),
                  static_cast<float>(2.4e-7 * largest_coordinate(cloth)), static_cast<float>(recovery_speed * h)},
                 grid.size(),
                 0,
                 0};
    if (meets_edges(cloth, scene.colliders)) edge_reach = static_cast<float>(drape::edge_reach(cloth));
}

glsl::CollisionPush ClothModel::collider_edges() const {
    glsl::CollisionPush push = collision;
    push.contact.z = push.contact.x;
    push.contact.x = edge_reach;
    return push;
}

}  // namespace drape
