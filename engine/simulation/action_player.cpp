#include "simulation/action_player.h"

#include <fmt/format.h>

#include <algorithm>

#include "drape/scene_reader.h"
#include "simulation/member_actions.h"
#include "world/gust.h"
#include "world/motion.h"
#include "world/weather.h"

namespace drape {

namespace {

/// A frame's actions as those of a step of one member.
class OneMember {
  public:
    explicit OneMember(const FrameActions& told) {
        const auto put = [](const auto& list, std::vector<double>& numbers) {
            for (const auto& each : list) numbers.insert(numbers.end(), each.begin(), each.end());
        };
        if (told.wind) wind_.assign(told.wind->begin(), told.wind->end());
        if (told.gravity) gravity_.assign(told.gravity->begin(), told.gravity->end());
        put(told.pins, pins_), put(told.colliders, colliders_), put(told.hands, hands_), put(told.loads, loads_);
        put(told.body_forces, forces_), put(told.body_impulses, impulses_), put(told.body_velocities, velocities_);
        holds_.assign(told.holds.begin(), told.holds.end());
        sets_.assign(told.body_sets.begin(), told.body_sets.end());
        for (const auto& grasp : told.grasps) grasps_.insert(grasps_.end(), grasp.begin(), grasp.end());
    }

    EnsembleActions actions() const {
        return {.wind = wind_,
                .pins = pins_,
                .colliders = colliders_,
                .holds = holds_,
                .gravity = gravity_,
                .hands = hands_,
                .grasps = grasps_,
                .loads = loads_,
                .body_forces = forces_,
                .body_impulses = impulses_,
                .body_velocities = velocities_,
                .body_sets = sets_};
    }

  private:
    std::vector<double> wind_, gravity_, pins_, colliders_, hands_, loads_, forces_, impulses_, velocities_;
    std::vector<std::uint8_t> holds_, sets_;
    std::vector<std::int32_t> grasps_;
};

template <class Each, class Number>
std::vector<Each> part(std::span<const Number> all, std::size_t number, std::size_t count) {
    std::vector<Each> own(all.empty() ? 0 : count);
    for (std::size_t k = 0; k < own.size(); ++k)
        for (std::size_t i = 0; i < own[k].size(); ++i) own[k][i] = all[(number * count + k) * own[k].size() + i];
    return own;
}

std::vector<bool> part(std::span<const std::uint8_t> all, std::size_t number, std::size_t count) {
    std::vector<bool> own;
    for (std::size_t k = 0; k < count && !all.empty(); ++k) own.push_back(all[number * count + k] != 0);
    return own;
}

/// Returns actions with what is told in addition, which counts where both tell the same.
FrameActions with(FrameActions actions, const FrameActions& more) {
    if (more.wind) actions.wind = more.wind;
    if (more.gravity) actions.gravity = more.gravity;
    const auto take = [](auto& list, const auto& told) {
        if (!told.empty()) list = told;
    };
    take(actions.pins, more.pins), take(actions.colliders, more.colliders), take(actions.hands, more.hands);
    take(actions.holds, more.holds), take(actions.grasps, more.grasps), take(actions.loads, more.loads);
    take(actions.body_forces, more.body_forces), take(actions.body_impulses, more.body_impulses);
    take(actions.body_velocities, more.body_velocities), take(actions.body_sets, more.body_sets);
    return actions;
}

}  // namespace

EnsembleControls controls_of(const SceneDescription& scene) {
    return scene.actions ? scene.actions->controls : EnsembleControls{};
}

FrameActions part_of(const EnsembleActions& actions, std::size_t number, const SimulationModel& model,
                     std::uint32_t frame) {
    const std::size_t pins = pin_count(model), hands = model.options.hands.size(), bodies = body_count(model);
    const auto vector = [&](std::span<const double> all) {
        return all.empty() ? std::nullopt : std::optional(part<Vec3>(all, number, 1)[0]);
    };
    const auto keys = [&](std::span<const double> all, std::size_t count) {
        return part<SixNumbers>(all, number, count);
    };
    return {.frame = frame,
            .wind = vector(actions.wind),
            .gravity = vector(actions.gravity),
            .pins = keys(actions.pins, pins),
            .colliders = keys(actions.colliders, model.scene.colliders.size()),
            .hands = keys(actions.hands, hands),
            .holds = part(actions.holds, number, pins),
            .grasps = part<std::array<std::int32_t, 4>>(actions.grasps, number, hands),
            .loads = part<Vec3>(actions.loads, number, load_count(model)),
            .body_forces = keys(actions.body_forces, bodies),
            .body_impulses = keys(actions.body_impulses, bodies),
            .body_velocities = keys(actions.body_velocities, bodies),
            .body_sets = part(actions.body_sets, number, bodies)};
}

bool is_any(const FrameActions& actions) { return actions != FrameActions{.frame = actions.frame}; }

ActionPlayer::ActionPlayer(SimulationModel& model, bool is_told)
    : model_(model), is_told_(is_told), start_(model), shown_(model.scene) {
    show(0);
    if (!is_told) play_all();
    put(0);
}

/// Plays all actions of the scene, to show them, and to find those that cannot be followed.
void ActionPlayer::play_all() {
    const std::vector<FrameActions>& steps = this->steps();
    const std::uint32_t last = std::max(model_.scene.time.frame_count, steps.empty() ? 1 : steps.back().frame + 1) - 1;
    std::size_t step = 0;
    try {
        for (std::uint32_t frame = 1; frame <= last; ++frame) {
            while (step + 1 < steps.size() && steps[step].frame < frame) ++step;
            play(frame);
        }
    } catch (const ActionError& error) {
        SceneResult result;
        result.errors.push_back({"scene", 0, 0, fmt::format("/actions/steps/{}", step),
                                 fmt::format("frame {}: {}", steps[step].frame, error.what())});
        throw SceneFailure(std::move(result));
    }
}

void ActionPlayer::tell(const EnsembleActions& actions, std::uint32_t frame) {
    std::vector<FrameActions>& steps = model_.scene.actions->steps;
    const EnsembleControls& controls = model_.scene.actions->controls;
    if (frame_ + 1 != frame) put(frame - 1);
    check_lists(actions, controls, model_, 1);
    const bool again = !steps.empty() && steps.back().frame == frame;
    const FrameActions all =
        with(again ? steps.back() : FrameActions{.frame = frame}, part_of(actions, 0, model_, frame));
    check_actions(OneMember(all).actions(), controls, model_, frame - 1);
    if (!is_any(all)) return;
    if (again) steps.pop_back();
    steps.push_back(all);
    if (again) shown_.actions->steps.pop_back();
    shown_.actions->steps.push_back(all);
}

void ActionPlayer::take(std::vector<FrameActions> steps) {
    shown_.actions->steps = model_.scene.actions->steps = std::move(steps);
    put(0);
    shown_until_ = 0;
    show(0);
}

const FrameActions* ActionPlayer::told(std::uint32_t frame) const {
    const auto found = std::ranges::lower_bound(steps(), frame, {}, &FrameActions::frame);
    return found == steps().end() || found->frame != frame ? nullptr : &*found;
}

void ActionPlayer::play(std::uint32_t frame) {
    const FrameActions* const own = told(frame);
    const OneMember member(own ? *own : FrameActions{});
    const EnsembleActions actions = member.actions();
    if (own) check_actions(actions, model_.scene.actions->controls, model_, frame - 1);
    act(actions, 0, frame - 1, model_, acted_);
    frame_ = frame;
    if (frame <= shown_until_) return;
    show(frame);
    shown_until_ = frame;
}

bool ActionPlayer::put(std::uint32_t frame) {
    if (frame <= frame_) {
        start_.put_into(model_);
        acted_ = {};
        frame_ = 0;
    }
    while (frame_ < frame) play(frame_ + 1);
    const FrameActions* const own = told(frame);
    return own != nullptr && is_any(*own);
}

void ActionPlayer::show(std::uint32_t frame) {
    const SceneDescription& scene = model_.scene;
    const EnsembleControls& controls = scene.actions->controls;
    const double time = frame / scene.time.fps;
    const auto add = [&](auto& keys, const auto& key) {
        if (frame == 0) keys.clear();
        keys.push_back(key);
    };
    const auto add_path = [&](MotionPath& path, const MotionPath& now) {
        MotionKey key = key_at(now, time);
        key.time = time;
        add(path.keys, key);
    };
    if (controls.wind) {
        add(shown_.wind.keys, VectorKey{time, wind_velocity(scene.wind, time)});
        shown_.wind.gust.amplitude = 0;
    }
    if (controls.gravity) add(shown_.gravity_keys, VectorKey{time, gravity_at(scene, time)});
    for (std::size_t k = 0; k < scene.colliders.size(); ++k)
        if (controls.colliders && !scene.colliders[k].mass) add_path(shown_.colliders[k].path, scene.colliders[k].path);
    for (std::size_t cloth = 0; cloth < scene.cloths.size(); ++cloth) {
        const Cloth& from = scene.cloths[cloth];
        Cloth& to = shown_.cloths[cloth];
        for (std::size_t k = 0; k < from.pins.size() && (controls.pins || controls.holds); ++k)
            add_path(to.pins[k].path, from.pins[k].path);
        for (std::size_t k = 0; k < from.loads.size() && controls.loads; ++k)
            if (from.loads[k].presses())
                add(to.loads[k].pressure_keys, NumberKey{time, pressure_at(from.loads[k], time)});
            else
                add(to.loads[k].force_keys, VectorKey{time, force_at(from.loads[k], time)});
    }
}

}  // namespace drape
