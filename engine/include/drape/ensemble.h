// Many scenes of one shape are simulated together: one dispatch for all, each with numbers of its own. A member's
// result is that of its scene alone on the same device, to the bit (cyclic reduction of lines on GPUs included).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "drape/simulation.h"

namespace drape {

struct EnsembleOptions {
    bool normals = false;
    EnsembleControls controls;
    Kernels kernels = Kernels::automatic();
    PictureView view;     ///< of pictures
    bool record = false;  ///< keep what each member is told (`recorded`), of which saved states have theirs
};

/// Members are to do this in a step, all of them, in order. An empty list leaves that as it is: as the scene has it, or
/// where the last action put it. Numbers are finite, and what holds cloth goes no farther in a step than the cloth's
/// diagonal.
struct EnsembleActions {
    std::span<const double> wind;  ///< [member, 3], m/s during the step; its gusts are over
    /// [member, pin, 6]: where the pins of all cloths, in order, are at the step's end, on the way there at constant
    /// speed: m and degrees, as a key of a pin's path has them (MotionKey).
    std::span<const double> pins;
    /// [member, collider, 6]: the same of the colliders, those of SceneDescription::colliders sorted by kind.
    std::span<const double> colliders;
    /// [member, pin], not 0: the pin holds during the step; 0: it does not, and its particles go on with the velocity
    /// that they have, as from a scene's `release`. A pin that takes its particles again holds them where they are,
    /// from the start of the step on, and moves them with it from there. A scene's `release` is over.
    std::span<const std::uint8_t> holds;
    std::span<const double> gravity;  ///< [member, 3], m/s^2 during the step; the scene's keys of it are over
    /// [member, hand, 6]: where the hands are at the step's end, as `pins`, but from the origin. A hand is at the first
    /// place that it is given for all of that step.
    std::span<const double> hands;
    /// [member, hand, 4]: first column and row, last column and row of the particles that the hand holds during the
    /// step; all -1: none. It takes them as `holds` says, from the start of the step on. A hand lets go before it takes
    /// others, and takes none that a pin or another hand holds, or lets go in this step.
    std::span<const std::int32_t> grasps;
    /// [member, load, 3]: what the loads of all cloths, in order, give during the step: N; of one that presses Pa and
    /// two zeros. The scene's keys of them are over.
    std::span<const double> loads;
    /// [member, body, 6]: N and, about the centre of mass, N m on the bodies (colliders with a mass, in the order of
    /// the colliders) during the step.
    std::span<const double> body_forces;
    /// [member, body, 6]: N s and, about the centre of mass, N m s on the bodies at the step's start, in this step
    /// alone.
    std::span<const double> body_impulses;
    /// [member, body, 6]: m/s and rad/s that bodies have at the step's start, before impulses; in this step alone.
    std::span<const double> body_velocities;
    /// [member, body], not 0: those that get their `body_velocities`; empty: all do.
    std::span<const std::uint8_t> body_sets;
};

/// Thrown for actions that cannot be taken, before any member goes on.
class ActionError : public Error {
  public:
    ActionError(const std::string& text, std::size_t member) : Error(text), member_(member) {}
    std::size_t member() const { return member_; }

  private:
    std::size_t member_;
};

/// Four floats per particle of one cloth of every member, in the library's memory: they lie there as long as the
/// ensemble does, and each step, reset and restore changes them.
struct MemberArray {
    const float* data = nullptr;
    std::size_t members = 0, rows = 0, columns = 0;
    std::size_t member_stride = 0;  ///< floats from one member's to the next's
};

class Ensemble {
  public:
    /// All members are at frame 0, their start. Throws SceneFailure for what no scene may have, Error for scenes with
    /// `actions` of their own and for members of unlike shape, saying which differs and in what, and DeviceError, which
    /// tells how many fit, when they are too many, before anything is allocated for them.
    explicit Ensemble(const std::vector<SceneDescription>& members, const EnsembleOptions& options = {},
                      const Device& device = Device());
    ~Ensemble();
    Ensemble(Ensemble&&) noexcept;

    std::size_t size() const;
    /// Returns the scene of a member as it runs.
    const SceneDescription& scene(std::size_t member) const;
    /// Returns why members do not share dispatches; nothing: they do.
    const std::optional<std::string>& sharing_obstacle() const;
    /// Returns the number of passes in a step of all members together.
    std::size_t pass_count() const;
    /// Returns the milliseconds that the device spent on the last step; 0 without timestamps.
    double device_milliseconds() const;

    /// Simulates the next frame of every member. One that fails says so (`failure`), and the others go on. Throws
    /// ActionError before anything is done, and DeviceError, after which this ensemble is over.
    void step(const EnsembleActions& actions = {});
    /// Takes members back to their starts, at frame 0, and forgets their failures and actions.
    void reset(std::span<const std::size_t> members);

    /// Returns the frame that a member is at.
    std::uint32_t frame(std::size_t member) const;
    /// Returns why a member's results are none since it failed; nothing: it has not.
    const std::optional<FrameFailure>& failure(std::size_t member) const;
    /// Returns the statistics of a member's cloths.
    const std::vector<ClothStatistics>& statistics(std::size_t member) const;
    /// Returns where a member's bodies are and how they move; empty where no collider has a mass.
    const std::vector<BodyState>& bodies(std::size_t member) const;
    /// Returns the work that a member's frame took; by methods with fixed substeps that share dispatches its substeps
    /// alone.
    const FrameEffort& effort(std::size_t member) const;
    /// Returns what was proved of contact in a member's frames so far; nothing when none of its cloths meets itself.
    const std::optional<SelfContactReport>& self_contact(std::size_t member) const;
    MemberArray positions(std::size_t cloth) const;   ///< x y z, m, and w: relative inverse mass, 0: held
    MemberArray velocities(std::size_t cloth) const;  ///< x y z, m/s, at the frames' ends
    MemberArray normals(std::size_t cloth) const;     ///< unit x y z of the front; only with EnsembleOptions::normals
    /// N, as FinishedFrame::tensions and contact_forces; only of scenes with `force_fields`. Throws Error without.
    MemberArray tensions(std::size_t cloth) const;
    MemberArray contact_forces(std::size_t cloth) const;
    /// Returns a picture of a member by its scene's camera and size: rows from the top, sRGB, four bytes a pixel. It is
    /// valid until the next.
    std::span<const std::uint8_t> picture(std::size_t member);

    /// Returns what a member was told since its start, of all its frames so far; a scene that has it as its `actions`
    /// gives the same bits (`scene_with_actions`). Throws Error without EnsembleOptions::record.
    SceneActions recorded(std::size_t member) const;

    /// Returns what a member needs to go on from here to the same bits.
    SimulationState save(std::size_t member) const;
    /// Takes members to saved states, one for each, of any member of an ensemble of the same scenes' shape and options.
    /// Throws Error where one is not such a state; members that share dispatches are then as they were.
    void restore(std::span<const std::size_t> members, std::span<const SimulationState> states);

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace drape
