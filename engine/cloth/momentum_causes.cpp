#include "cloth/momentum_causes.h"

#include <fmt/format.h>

#include <cmath>

#include "cloth/forces.h"

namespace drape {

namespace {

bool turns_on_pins(const std::optional<KeptTurn>& turn) { return turn && turn->turns_held(); }

std::string point_text(const std::optional<KeptTurn>& turn) {
    if (!turns_on_pins(turn)) return "the centre of mass";
    const std::string pin = fmt::format("particle ({}, {})", turn->about.x, turn->about.y);
    return std::isinf(turn->until) ? pin : fmt::format("{} until {:.6g} s, then the centre of mass", pin, turn->until);
}

}  // namespace

Momenta momentum_causes(const SimulationModel& model, std::size_t index) {
    const ClothModel& cloth = model.cloths[index];
    const SceneDescription& scene = model.scene;
    Momenta momenta{cloth.name, point_text(cloth.turn), {}, {}};
    for (const ForceSource& source : force_sources(model, index)) {
        const char* cause = name_of(source.cause);
        if (!momenta.momentum_by.empty() && momenta.momentum_by.back() == cause) continue;
        momenta.momentum_by.push_back(cause);
        // Gravity goes along the axis of cloth that turns on pins, and through the centre of mass.
        const bool turns =
            source.cause == ForceCause::pins ? !turns_on_pins(cloth.turn) : source.cause != ForceCause::gravity;
        if (turns) momenta.angular_momentum_by.push_back(cause);
    }
    // Explicit steps pull along the links as they are; others take back what they make, where a substep ends by that.
    if (scene.solver.method != SolverMethod::explicit_steps && cloth.scheme.ended.empty())
        momenta.angular_momentum_by.push_back("solver");
    if (model.closed_loop()) momenta.angular_momentum_by.push_back("changes of the substeps");
    return momenta;
}

}  // namespace drape
