// What the host passes to the device before each frame: wind, collider poses and pin motions, by substep. The values
// are computed in double precision and rounded once. The C++ twin reads the same values.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "cloth/simulation_model.h"
#include "shared/collider_types.h"
#include "shared/seam_types.h"
#include "world/motion.h"

namespace drape {

/// Returns the motion of a pin at a time: x = R (rest - pivot) + pivot + translation, about its pivot.
RigidTransform pin_transform(const DynamicPin& pin, double time);

/// Returns the number of vectors that FrameInputs::wind has for a substep of one scene.
std::size_t weather_vectors(const SimulationModel& model);
/// Returns where in it a substep of a member begins.
std::size_t first_weather(const SimulationModel& model, std::size_t member, std::uint32_t substep);
/// Returns the number of collider records in a frame: one for each entry of every list
/// (SimulationModel::kept_colliders), or one for each substep if any collider is key-framed.
std::size_t collider_record_count(const SimulationModel& model);
/// Returns the first record of a cloth in a substep.
int first_collider(const SimulationModel& model, const ClothModel& cloth, std::uint32_t substep);
/// Returns where each kind of collider ends in the sorted list: the number of colliders of this kind or an earlier one.
std::array<std::uint32_t, glsl::collider_kind_count> kind_ends(const std::vector<Collider>& colliders);

/// Returns the device's record of a collider at the time `now`, with its motion since `before`, s. `field`: a mesh's
/// first texel (MeshFields). Its deformation is not included.
glsl::ColliderRecord collider_record(const Collider& collider, double before, double now, const Vec3& way_out = {},
                                     std::size_t field = 0);

/// Adds a mesh's deformation to its record: the share of the frame that is over when the substep ends, and how much
/// farther, m, its surface moves in the substep.
void add_deformation(glsl::ColliderRecord& record, double share, double way);

struct FrameInputs {
    /// By member and substep, the wind, m/s; where gravity changes, the difference of gravity from the start, m/s^2; of
    /// each load of the member's cloths the force, N, and beside it the pressure, Pa; of each gas the volume at ambient
    /// pressure, m^3. Empty without any of it.
    std::vector<glsl::vec4> wind;
    std::vector<glsl::SeamOpening> openings;      ///< by substep, of each time of SimulationModel::closings
    std::vector<float> stiffness;                 ///< by cloth, the factor of its stiffness; empty: none changes
    std::vector<glsl::ColliderRecord> colliders;  ///< by substep, and within it list by list, in the scene's order
    std::uint32_t collider_sets = 1;         ///< number of substeps that have their own records; 1: all share one set
    std::shared_ptr<const FormLists> forms;  ///< for meshes that deform; null: there are none
    std::vector<glsl::BodyAction> body_actions;      ///< by member and body; empty: no action pushes bodies
    std::vector<std::vector<glsl::PinMotion>> pins;  ///< by cloth: substep by substep, pin by pin
};

/// Returns the inputs for simulating from frame-1 to `frame` (1 .. frame_count-1). For frame 0, which is not simulated,
/// the last substep ends at time 0, so its colliders are where they start.
FrameInputs frame_inputs(const SimulationModel& model, std::uint32_t frame);
/// Replaces the contents of `inputs` by those of a frame.
void take_frame_inputs(const SimulationModel& model, std::uint32_t frame, FrameInputs& inputs);

}  // namespace drape
