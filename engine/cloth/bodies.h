// Bodies that cloth moves: colliders that have a mass. The device has their state; here is what it starts from, the
// constants of its passes, and what comes of the state. Pure.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "drape/frame.h"
#include "drape/scene.h"
#include "shared/body_types.h"

namespace drape {

struct SimulationModel;
struct ClothModel;

/// What actions do to a body in a frame.
struct BodyActions {
    Vec3 force{}, moment{};      ///< N and, about the centre of mass, N m, in every substep
    Vec3 impulse{}, twist{};     ///< N s and N m s, as the frame begins
    bool sets = false;           ///< the frame begins with these:
    Vec3 velocity{}, turning{};  ///< m/s, rad/s
    double given = 0;            ///< m/s, the most that actions have so far added to the speed of any point of it

    /// Writes or reads them, by a ByteWriter or a ByteReader.
    template <class Archive>
    void transfer(Archive& archive) {
        for (Vec3* const each : {&force, &moment, &impulse, &twist, &velocity, &turning})
            archive((*each)[0], (*each)[1], (*each)[2]);
        archive(sets, given);
    }
};

/// The frame of a body, which has its principal axes.
struct BodyFrame {
    Vec3 moments{};  ///< kg m^2
    Vec3 center{};   ///< m: the centre of mass in this frame, from the shape's centre
    /// Its axes in the shape's frame as columns, row major; nothing: the two are one.
    std::optional<std::array<double, 9>> axes = {};
};

/// A collider with a mass.
struct Body {
    std::size_t number;  ///< among the model's colliders
    Collider collider;   ///< its true shape
    BodyFrame frame;
    double cover = 0;  ///< kg: cloth that covers a light body (world/mass_properties.h); 0: it is none
    BodyActions acts = {};
};

/// The bodies of a member (ClothModel::member), and what its passes need of its scene.
struct MemberBodies {
    std::vector<Body> bodies;
    /// Numbers of the colliders without a mass that bodies meet in contact of their own (StepKind::body_meet). Without
    /// it, because there is one body that is no mesh, and no collider but planes, this is empty.
    std::vector<std::size_t> obstacles;
    bool meet = false;            ///< bodies have that contact
    bool obstacles_move = false;  ///< some of them, or deform
    /// Then: the hull points of all solid meshes in the frames of their shapes, m, and the number of each
    /// body's and obstacle's.
    std::vector<glsl::vec4> hull_points = {};
    std::vector<std::size_t> hull_counts = {};
    Vec3 gravity{};                              ///< at time 0, m/s^2
    std::size_t first_list = 0, list_count = 0;  ///< of SimulationModel::kept_colliders
};

/// Returns those of a scene whose colliders are sorted by kind; `list_count`: lists of kept colliders.
MemberBodies bodies_of(const SceneDescription& scene, std::size_t list_count);

/// Returns whether a cloth is the one with which the state of its member's bodies lies, and there are any.
bool has_bodies(const SimulationModel& model, std::size_t cloth);
/// Returns the number of bodies of a scene or, with several members, of each.
std::size_t body_count(const SimulationModel& model);

/// Returns the number of obstacles of each member, and whether its bodies meet, two boxes among them.
std::size_t obstacle_count(const SimulationModel& model);
bool bodies_meet(const SimulationModel& model);
bool boxes_meet(const SimulationModel& model);
/// Returns whether something moves or deforms an obstacle of some member.
bool obstacles_move(const SimulationModel& model);
/// Returns whether a body of some member is light.
bool has_light_bodies(const SimulationModel& model);
/// Returns those of the bodies, then of the obstacles.
std::vector<glsl::BodyConstants> body_constants(const SimulationModel& model, std::size_t member);
/// Returns the state at time 0, body by body.
std::vector<glsl::vec4> bodies_at_start(const SimulationModel& model, std::size_t member);

/// Returns the most that actions can add to the speed of a point of a body in a frame of so many seconds, m/s.
double most_given(const Body& body, double seconds);
/// Returns what actions do in a frame, body by body.
std::vector<glsl::BodyAction> body_actions(const SimulationModel& model);

glsl::BodyMovePush body_move_push(const SimulationModel& model, std::size_t member, std::uint32_t substep);
glsl::BodyStrikePush body_strike_push(const SimulationModel& model, const ClothModel& cloth, std::uint32_t substep);

/// Returns the bodies of a scene at a frame's end from the device's state.
std::vector<BodyState> body_states(const SimulationModel& model, std::span<const float> state, std::uint32_t frame);

}  // namespace drape
