// Plays a scene's actions (SceneDescription::actions), as an ensemble's steps would tell them: those that it has, or
// those that it is told while it runs.
#pragma once

#include "simulation/member.h"

namespace drape {

/// Returns the controls that a scene's actions need.
EnsembleControls controls_of(const SceneDescription& scene);
/// Returns a member's part of the actions, for the step to a frame.
FrameActions part_of(const EnsembleActions& actions, std::size_t number, const SimulationModel& model,
                     std::uint32_t frame);
/// Returns whether a frame's actions tell anything.
bool is_any(const FrameActions& actions);

/// The recorded actions of a member in its saved state.
template <class Archive>
void transfer_actions(Archive& archive, std::vector<FrameActions>& steps) {
    auto count = static_cast<std::uint64_t>(steps.size());
    archive(count);
    steps.resize(count < MemberMotion::most_keys ? count : 0);
    const auto all = [&](auto& list, const auto& each) {
        auto size = static_cast<std::uint64_t>(list.size());
        archive(size);
        list.resize(size < MemberMotion::most_keys ? size : 0);
        for (auto& one : list) each(one);
    };
    const auto numbers = [&](auto& array) {
        for (auto& number : array) archive(number);
    };
    const auto vector = [&](std::optional<Vec3>& told) {
        bool is = told.has_value();
        archive(is);
        Vec3 value = told.value_or(Vec3{});
        numbers(value);
        told = is ? std::optional(value) : std::nullopt;
    };
    const auto flags = [&](std::vector<bool>& list) {
        std::vector<std::uint8_t> bytes(list.begin(), list.end());
        archive(bytes);
        list.assign(bytes.begin(), bytes.end());
    };
    for (FrameActions& step : steps) {
        archive(step.frame);
        vector(step.wind), vector(step.gravity);
        flags(step.holds), flags(step.body_sets);
        for (auto* const list :
             {&step.pins, &step.colliders, &step.hands, &step.body_forces, &step.body_impulses, &step.body_velocities})
            all(*list, numbers);
        all(step.grasps, numbers);
        all(step.loads, numbers);
    }
}

class ActionPlayer {
  public:
    /// `model` is of a scene with actions, which has taken none, and outlives the player. `is_told`: more will be told
    /// (`tell`). Throws SceneFailure for actions that cannot be followed.
    ActionPlayer(SimulationModel& model, bool is_told);

    /// Puts into the model what holds in the step to a frame. Returns whether something new is told for it.
    bool put(std::uint32_t frame);
    /// Tells what holds in the step to a frame, whose step before is put; it is added to what was told for that frame.
    /// Throws ActionError, and nothing has changed.
    void tell(const EnsembleActions& actions, std::uint32_t frame);
    bool is_told() const { return is_told_; }
    const std::vector<FrameActions>& steps() const { return model_.scene.actions->steps; }
    /// Replaces all that was told; what was put is forgotten.
    void take(std::vector<FrameActions> steps);
    /// Returns the scene with keys, at the times of its frames, of all that the actions move, for those who ask where
    /// things are in any frame; of a scene that is told while it runs, in any frame so far.
    const SceneDescription& shown() const { return shown_; }

  private:
    const FrameActions* told(std::uint32_t frame) const;
    void play(std::uint32_t frame);
    void play_all();
    void show(std::uint32_t frame);

    SimulationModel& model_;
    bool is_told_;
    MemberMotion start_;
    Acted acted_;
    std::uint32_t frame_ = 0;        ///< what the model has is for the step to this one
    std::uint32_t shown_until_ = 0;  ///< the last frame of which `shown_` has keys
    SceneDescription shown_;
};

}  // namespace drape
