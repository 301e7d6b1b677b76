#include "cloth/momentum_causes.h"

#include <fmt/format.h>

#include <cmath>

#include "base/vectors.h"
#include "world/weather.h"

namespace drape {

namespace {

bool turns_on_pins(const std::optional<KeptTurn>& turn) { return turn && turn->turns_held(); }

std::string point_text(const std::optional<KeptTurn>& turn) {
    if (!turns_on_pins(turn)) return "the centre of mass";
    const std::string pin = fmt::format("particle ({}, {})", turn->about.x, turn->about.y);
    return std::isinf(turn->until) ? pin : fmt::format("{} until {:.6g} s, then the centre of mass", pin, turn->until);
}

bool is_held(const ClothModel& cloth) {
    for (std::size_t i = 0; i < cloth.position.size(); ++i)
        if (cloth.position[i].w == 0 && cloth.free_weight[i] > 0) return true;
    return false;
}

}  // namespace

Momenta momentum_causes(const SimulationModel& model, std::size_t index) {
    const ClothModel& cloth = model.cloths[index];
    const SceneDescription& scene = model.scene;
    Momenta momenta{cloth.name, point_text(cloth.turn), {}, {}};
    const bool weighs = length(strongest_gravity(scene)) > 0, held = is_held(cloth);
    // Gravity goes along the axis of cloth that turns on pins, and through the centre of mass.
    const auto add = [&](const char* cause, bool pulls, bool turns) {
        if (pulls) momenta.momentum_by.push_back(cause);
        if (turns) momenta.angular_momentum_by.push_back(cause);
    };
    add("gravity", weighs, false);
    add("pins", held, held && !turns_on_pins(cloth.turn));
    const bool air = scene.wind.blows() || model.options.air;
    add("air", air, air);
    add("damping", cloth.damping > 0, cloth.damping > 0);
    const bool collides = !scene.colliders.empty(), meets = model.self_contact && scene.cloths.size() > 1;
    add("colliders", collides, collides);
    add("other cloths", meets, meets);
    // Explicit steps pull along the links as they are; lines take back what they make, where the cloth keeps its turn.
    const bool makes =
        scene.solver.method == SolverMethod::relax || (scene.solver.method == SolverMethod::line && !cloth.turn);
    add("solver", false, makes);
    add("changes of the substeps", false, model.closed_loop());
    return momenta;
}

}  // namespace drape
