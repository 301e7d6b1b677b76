// What changes a cloth's momentum, and by which forces. The device sums the impulses of a frame
// (shared/impulse_types.h); here they become forces. Pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "cloth/simulation_model.h"
#include "drape/statistics.h"

namespace drape {

enum class ForceCause : std::uint8_t { gravity, pins, hands, air, loads, damping, colliders, other_cloths, seams };

/// In the order of ForceCause, as manifests name them.
inline constexpr const char* force_causes[] = {"gravity", "pins",      "hands",        "air",  "loads",
                                               "damping", "colliders", "other cloths", "seams"};
inline const char* name_of(ForceCause cause) { return force_causes[static_cast<std::size_t>(cause)]; }

/// One thing that gives a cloth momentum.
struct ForceSource {
    ForceCause cause;
    std::size_t number;  ///< of the cloth's pins and, after these, its hands, or of the model's colliders
    std::string name;    ///< "pins_0", "collider_2_sphere": in the names of the frames' numbers
};

/// Returns what may change a cloth's momentum, by cause; nothing else does.
std::vector<ForceSource> force_sources(const SimulationModel& model, std::size_t cloth);

/// Returns whether a scene's impulses are summed: it wants forces, or has bodies, which get the opposite.
bool sums_impulses(const SceneDescription& scene);
/// Returns the number of rows of each cloth's sums: the same for all cloths of a scene, since some share images.
std::uint32_t impulse_sum_count(const SceneDescription& scene);
/// Returns the number of these rows and of those that keep the worst of each.
std::uint32_t impulse_row_count(const SceneDescription& scene);
/// Returns the row of a cloth's first pin.
std::uint32_t first_pin_row(const SceneDescription& scene);
/// Returns the units of impulses to a metre of an inner particle's motion in a substep: 2^20 to a change of its
/// velocity that 1 m/s^2 makes in a substep. So 2^29 m/s^2 of a particle fit, and gravity's own rounding is 1e-7.
float impulse_units(const SimulationModel& model);

/// Returns whether several pins may hold a cloth, or pins and hands, or pins several cloths that are sewn together, so
/// that what holds them has to be split among them.
bool splits_pins(const SimulationModel& model);
/// Returns for each particle 1 and the number of the pin that holds it, or 0.
std::vector<glsl::uint> pin_numbers(const SimulationModel& model, std::size_t cloth);
/// Returns the constants of the step that adds the momentum; `sign`: -1 as a frame begins, 1 as it ends.
glsl::MomentumPush momentum_push(const SimulationModel& model, const ClothModel& cloth, float sign);

/// Returns the forces of a frame, averaged over it, from the sums that it left. `mass`: the cloth's, kg. Of a cloth
/// that is sewn and that pins hold, those of seams are not known yet.
std::vector<ForceOnCloth> cloth_forces(const SimulationModel& model, std::size_t cloth,
                                       std::span<const std::byte> impulses, double mass, std::uint32_t frame);
/// Finds what seams give to the cloths that pins hold, by what they give to others: what one gets the others lose.
/// `impulses`: the sums of each cloth.
void settle_seams(const SimulationModel& model, std::span<const std::span<const std::byte>> impulses,
                  std::uint32_t frame, std::vector<ClothStatistics>& statistics);

}  // namespace drape
