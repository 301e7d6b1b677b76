// A simulation that takes over what another one saved goes on to the same bits: positions, statistics, pictures, cuts.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <tuple>

#include "drape/simulation.h"
#include "library_device.h"
#include "simulation/state_checksum.h"

namespace drape {
namespace {

using test::library_device;
using SimulationStateGuard = test::LibraryTest;
using SimulationStateWatch = test::LibraryTest;
/// The parts of a frame that may be compared.
struct Seen {
    std::vector<std::vector<float>> positions;
    std::vector<std::uint8_t> rgba;
    std::vector<double> statistics;
    std::uint32_t substeps, attempts;
    bool asleep;
    bool operator==(const Seen&) const = default;
};

Seen seen(const FinishedFrame& frame) {
    Seen result{{},
                {frame.rgba.begin(), frame.rgba.end()},
                {},
                frame.effort.substeps,
                frame.effort.attempts,
                frame.effort.asleep};
    for (const auto& cloth : frame.positions) result.positions.emplace_back(cloth.begin(), cloth.end());
    for (const ClothStatistics& s : frame.statistics)
        result.statistics.insert(
            result.statistics.end(),
            {s.stretch.rms, s.shear.rms, s.stretch_error_rms, s.stretch_error_max, s.kinetic_energy, s.potential_energy,
             s.elastic_energy, s.momentum[1], s.angular_momentum[2], s.angular_error[0], s.largest_distance,
             s.largest_speed, s.penetration.value_or(0), double(s.iteration_count.value_or(0)),
             double(s.fastest.value_or(0)), s.seams ? s.seams->load : 0, s.seams ? s.seams->ripped : 0.0});
    return result;
}

using Frames = std::map<std::uint32_t, Seen>;
struct Told {
    Frames frames;
    /// At the end, for each cloth that meets itself: first frame not proved, most pairs, motions cut short.
    std::vector<std::tuple<std::optional<std::uint32_t>, std::uint32_t, std::uint64_t>> met;
    std::map<std::uint32_t, std::vector<std::uint32_t>> faces;  // of the last cloth cut, by the frame of the cut
    std::optional<std::string> passage;  // what is said at the end of colliders that may have passed
};

SimulationOptions options_of(Told& told, bool draw) {
    SimulationOptions options;
    options.draw = draw;
    options.keep_promises = false;
    options.on_cut = [&told](const Cut& cut) { told.faces[cut.frame] = cut.faces; };
    return options;
}

/// Runs from the next frame on; keeps the states that could be saved, by their next frame.
void run(Simulation& simulation, Told& told, std::map<std::uint32_t, SimulationState>* states = nullptr) {
    const std::uint32_t last = simulation.scene().time.frame_count - 1;
    std::uint32_t paused = 0;
    const auto pause = [&] { return states && simulation.can_save() && simulation.next_frame() > paused; };
    while (!simulation.run(
        last, [](std::uint32_t) { return true; },
        [&](const FinishedFrame& frame) { told.frames.insert_or_assign(frame.frame, seen(frame)); }, pause)) {
        paused = simulation.next_frame();
        (*states)[paused] = simulation.save();
    }
    if (const auto report = simulation.self_contact())
        told.met.emplace_back(report->first_unproved, report->most_pairs, report->truncated);
    told.passage = simulation.possible_passage();
}

/// Stops every frame that has so many attempts at the one that its number says.
void run_stopped_within(Simulation& simulation, Told& told, std::map<std::uint32_t, SimulationState>& states) {
    std::optional<std::uint32_t> frame, stopped;
    std::uint32_t asked = 0;
    const auto stop = [&] {
        if (!simulation.can_save() || simulation.next_frame() == stopped) return false;
        if (simulation.next_frame() != frame) asked = 0;
        frame = simulation.next_frame();
        if (++asked != 2 + *frame % 4) return false;  // the first is asked before the frame
        stopped = frame;
        return true;
    };
    while (!simulation.run(
        simulation.scene().time.frame_count - 1, [](std::uint32_t) { return true; },
        [&](const FinishedFrame& each) { told.frames.insert_or_assign(each.frame, seen(each)); }, stop))
        states[simulation.next_frame()] = simulation.save();
    if (const auto report = simulation.self_contact())
        told.met.emplace_back(report->first_unproved, report->most_pairs, report->truncated);
    told.passage = simulation.possible_passage();
}

struct Case {
    const char* name;
    const char* scene;
    bool draw = false;
};
void PrintTo(const Case& each, std::ostream* out) { *out << each.name; }

class SimulationStateTest : public test::LibraryTest, public testing::WithParamInterface<Case> {};

TEST_P(SimulationStateTest, GoesOnToTheSameBitsWhereverItWasTaken) {
    const SceneDescription scene = parse_scene(GetParam().scene);
    Told whole, paused;
    {
        Simulation simulation(scene, options_of(whole, GetParam().draw), library_device());
        run(simulation, whole);
    }
    std::map<std::uint32_t, SimulationState> states;
    {
        Simulation simulation(scene, options_of(paused, GetParam().draw), library_device());
        run(simulation, paused, &states);
    }
    EXPECT_EQ(paused.frames, whole.frames) << "saving changes something";
    ASSERT_GE(states.size(), 5u);
    const std::size_t stride = states.size() / 5;
    std::size_t index = 0;
    Told rest;
    Simulation simulation(scene, options_of(rest, GetParam().draw),
                          library_device());  // it has ended each time but one
    for (const auto& [next, state] : states) {
        if (index++ % stride != 0 && next != states.rbegin()->first) continue;
        rest = {};
        simulation.restore(state);
        EXPECT_EQ(simulation.next_frame(), next);
        EXPECT_EQ(simulation.save(), state) << "from frame " << next;
        run(simulation, rest);
        EXPECT_EQ(rest.met, whole.met) << "from frame " << next;
        EXPECT_EQ(rest.passage, whole.passage) << "from frame " << next;
        const auto from = whole.frames.find(next);
        ASSERT_NE(from, whole.frames.end());
        EXPECT_TRUE(rest.frames == Frames(from, whole.frames.end())) << "from frame " << next;
        for (const auto& [frame, faces] : rest.faces) EXPECT_EQ(faces, whole.faces.at(frame)) << "cut in " << frame;
    }
}

TEST_P(SimulationStateTest, IsAsBeforeTheFrameThatIsStoppedWithin) {
    const SceneDescription scene = parse_scene(GetParam().scene);
    Told whole, within;
    std::map<std::uint32_t, SimulationState> before, states;
    {
        Simulation simulation(scene, options_of(whole, GetParam().draw), library_device());
        run(simulation, whole, &before);
    }
    Simulation simulation(scene, options_of(within, GetParam().draw), library_device());
    run_stopped_within(simulation, within, states);
    EXPECT_EQ(within.frames, whole.frames);
    EXPECT_EQ(within.met, whole.met);
    EXPECT_EQ(within.passage, whole.passage);
    EXPECT_EQ(within.faces, whole.faces);
    for (const auto& [next, state] : states) EXPECT_EQ(state, before.at(next)) << "before frame " << next;
    if (scene.solver.method == SolverMethod::automatic)
        EXPECT_GE(states.size(), 5u);
    else
        EXPECT_TRUE(states.empty());
}

// `auto` changes its substeps where the ball hits; pins that let go begin a probe; two cloths, one with a hole.
constexpr const char* closed_loop_scene =
    R"({"time": {"fps": 60, "frames": 41}, "wind": {"velocity": [2, 0, 1], "gust": {"amplitude": 1}},
  "cloths": [{"grid": [17, 14], "size": [0.6, 0.5], "placement": {"origin": [0, 1, 0]}, "areal_density": 0.2,
              "pins": [{"corner": "top_left"}, {"corner": "top_right", "release": 0.3}]},
             {"grid": [9, 11], "size": [0.3, 0.4], "placement": {"origin": [0, 1, 1]}, "areal_density": 0.2,
              "holes": [[[2, 2], [5, 5]]], "pins": [{"edge": "top"}]}],
  "colliders": {"spheres": [{"center": [0.3, 0.7, 0.5], "radius": 0.15,
                             "path": [{"t": 0}, {"t": 0.4, "translate": [0, 0, -0.6]}]}]}})";
// The cloth hangs still after a while, sleeps, and is woken by its edge.
constexpr const char* sleeping_scene =
    R"({"time": {"fps": 20, "frames": 61}, "cloths": [{"grid": [9, 8], "size": [0.4, 0.3], "damping": 8,
  "pins": [{"edge": "top", "path": [{"t": 2.5}, {"t": 2.8, "translate": [0.1, 0, 0]}]}]}]})";
constexpr const char* cut_scene = R"({"time": {"fps": 60, "frames": 31}, "image": {"size": [48, 32], "samples": 1},
  "cloths": [{"grid": [12, 10], "size": [0.5, 0.4], "placement": {"origin": [0, 1, 0]}, "pins": [{"edge": "top"}]},
             {"grid": [8, 9], "size": [0.3, 0.4], "placement": {"origin": [0.1, 1, 0.1]}, "pins": [{"edge": "top"}]}],
  "cutters": [{"triangle": [[-0.1, 0.8, -1], [0.3, 0.75, 1], [-0.1, 0.78, 1]], "active": [0.1, 0.4],
               "path": [{"t": 0.1}, {"t": 0.4, "translate": [0.3, 0, 0]}]}],
  "solver": {"method": %s}})";
std::string with_method(std::string text, const std::string& method) {
    return text.replace(text.find("%s"), 2, method);
}
const std::string cut_by_auto = with_method(cut_scene, "\"auto\"");
const std::string cut_by_line = with_method(cut_scene, "\"line\", \"substeps\": 5");
// The lower edge is drawn away until the cloth rips, from a nick on.
constexpr const char* torn_scene = R"({"time": {"fps": 60, "frames": 41}, "image": {"size": [48, 32], "samples": 1},
  "cloths": [{"grid": [14, 12], "size": [0.5, 0.4], "placement": {"origin": [0, 1, 0]}, "tear": {"tension": 160},
              "holes": [[[0, 5], [2, 6]]],
              "pins": [{"edge": "top"}, {"edge": "bottom", "path": [{"t": 0}, {"t": 0.6, "translate": [0.1, -0.12, 0.1]}]}]},
             {"grid": [8, 9], "size": [0.3, 0.4], "placement": {"origin": [0.1, 1, 0.5]}, "pins": [{"edge": "top"}]}],
  "solver": {"method": %s}})";
const std::string torn_by_auto = with_method(torn_scene, "\"auto\"");
const std::string torn_by_line = with_method(torn_scene, "\"line\", \"substeps\": 5");
constexpr const char* named_scene = R"({"time": {"fps": 60, "frames": 21},
  "cloths": [{"grid": [16, 13], "size": [0.5, 0.4], "placement": {"origin": [0, 1, 0]}, "stiffness": {"stretch": 500, "shear": 50, "bend": 1e-4},
              "pins": [{"corner": "top_left"}, {"corner": "top_right"}]}],
  "colliders": {"spheres": [{"center": [0.2, 0.7, 0], "radius": 0.1}]}, "solver": {"method": %s}})";
const std::string relaxed =
    with_method(named_scene, "\"relax\", \"substeps\": 3, \"iterations\": 8, \"tolerance\": 0.01");
const std::string explicitly = with_method(named_scene, "\"explicit\", \"substeps\": 41");
const std::string by_lines = with_method(named_scene, "\"line\", \"substeps\": 4, \"tethers\": true");
// Wind and gravity change, in one case without any wind; a companion estimates the error.
const std::string weather_by_auto =
    R"({"time": {"fps": 60, "frames": 31}, "gravity_keys": [{"t": 0.1, "gravity": [0, -9.81, 0]}, {"t": 0.4, "gravity": [3, 2, 4]}],
  "wind": {"keys": [{"t": 0, "velocity": [2, 0, 1]}, {"t": 0.3, "velocity": [-1, 0, 4]}], "gust": {"amplitude": 1}},
  "cloths": [{"grid": [17, 14], "size": [0.6, 0.5], "placement": {"origin": [0, 1, 0]}, "pins": [{"edge": "top"}]}]})";
const std::string weather_by_lines =
    R"({"time": {"fps": 60, "frames": 21}, "gravity_keys": [{"t": 0.1, "gravity": [0, -9.81, 0]}, {"t": 0.3, "gravity": [3, 2, 4]}],
  "cloths": [{"grid": [17, 14], "size": [0.6, 0.5], "placement": {"origin": [0, 1, 0]}, "pins": [{"edge": "top"}]}],
  "solver": {"method": "line", "substeps": 4, "estimate_error": true}})";
// Cloths that are alike lie in the same images.
constexpr const char* alike_scene = R"({"time": {"fps": 60, "frames": 13}, "image": {"size": [48, 32], "samples": 1},
  "cloths": [{"grid": [9, 7], "size": [0.5, 0.4], "placement": {"origin": [0, 1, 0]}, "pins": [{"edge": "top"}]},
             {"grid": [8, 7], "size": [0.5, 0.4], "placement": {"origin": [0, 2, 0]}, "pins": [{"edge": "top"}]},
             {"grid": [9, 7], "size": [0.5, 0.4], "placement": {"origin": [1, 1, 0]}, "pins": [{"edge": "top"}],
              "velocity": [0, 0, 1]}],
  "solver": {"method": "line", "substeps": 4}})";

// The cloth falls on its lower edge, onto another one, and folds; a pin carries a corner through it.
constexpr const char* meeting_scene = R"({"time": {"fps": 60, "frames": 41},
  "cloths": [{"grid": [11, 12], "size": [0.4, 0.44], "self_collision": true, "velocity": [0, -2, 0], "thickness": 0.01,
              "placement": {"origin": [0, 0.45, 0], "u": [1, 0, 0.02], "v": [-0.001, -1, 0.05]},
              "pins": [{"corner": "top_left", "path": [{"t": 0.1}, {"t": 0.5, "translate": [0.3, -0.4, 0.1]}]}]},
             {"grid": [6, 5], "size": [0.3, 0.2], "thickness": 0.02,
              "placement": {"origin": [0.05, 0.1, -0.1], "u": [1, 0, 0], "v": [0, 0, 1]}}],
  "colliders": {"planes": [{"normal": [0, 1, 0], "offset": 0}]}})";

// In the middle of the run a thin shelf goes by below the cloth, so fast that a named method is not sure of contact.
constexpr const char* passed_scene = R"({"time": {"fps": 60, "frames": 49},
  "cloths": [{"grid": [11, 9], "size": [0.5, 0.4], "placement": {"origin": [0, 1, 0]}, "pins": [{"edge": "top"}]}],
  "colliders": {"boxes": [{"center": [0.25, 0.3, -1], "half_extents": [0.3, 0.1, 0.002],
                           "path": [{"t": 0.1}, {"t": 0.3, "translate": [0, 0, 2]}]}]},
  "solver": {"method": %s}})";
const std::string passed_by_lines = with_method(passed_scene, "\"line\", \"substeps\": 4");
const std::string passed_by_auto = with_method(passed_scene, "\"auto\"");

// A box becomes twice as high and low again below the cloth, drawn.
const std::string on_what_deforms = R"({"time": {"fps": 60, "frames": 41}, "image": {"size": [48, 32], "samples": 1},
  "cloths": [{"grid": [11, 9], "size": [0.4, 0.4], "placement": {"origin": [-0.2, 0.12, -0.2], "v": [0, 0, 1]}}],
  "colliders": {"meshes": [{"file": ")" DRAPE_SOURCE_DIR "/tests/scene/box.obj\", \"frames\": \"" DRAPE_SOURCE_DIR
                                    R"(/tests/scene/box_pose_#.obj", "frames_per_second": 10, "frames_start": 0.1,
                            "loop": true, "scale": 0.5, "position": [-0.5, 0, 0], "spacing": 0.04}]},
  "solver": {"method": %s}})";
const std::string deforming_by_auto = with_method(on_what_deforms, "\"auto\"");
const std::string deforming_by_lines = with_method(on_what_deforms, "\"line\", \"substeps\": 4");

/// It hangs by a corner.
const std::string resting_as_it_starts = R"({"time": {"frames": 25},
  "cloths": [{"grid": [3, 5], "start": ")" DRAPE_SOURCE_DIR R"(/tests/scene/given/shape.obj", "rest": "start",
              "stiffness": {"stretch": 200, "shear": 50, "bend": 1e-4}, "pins": [{"at": [0, 0]}]}],
  "solver": {"method": "line", "substeps": 4}})";

/// A seam opens from one end on while a corner is pulled.
constexpr const char* ripping_scene = R"({"time": {"frames": 21}, "image": {"size": [48, 32], "samples": 1},
  "cloths": [{"name": "a", "grid": [9, 5], "size": [0.5, 0.2], "placement": {"origin": [0, 1, 0]},
              "stiffness": {"stretch": 500, "shear": 50, "bend": 1e-4}, "pins": [{"edge": "top"}]},
             {"name": "b", "grid": [9, 5], "size": [0.5, 0.2], "placement": {"origin": [0, 0.8, 0]},
              "stiffness": {"stretch": 500, "shear": 50, "bend": 1e-4},
              "loads": [{"box": [[0, 2], [1, 4]], "force": [0, -0.6, 0.4]}]}],
  "seams": [{"a": {"cloth": "a", "edge": "bottom"}, "b": {"cloth": "b", "edge": "top"}, "rip": 4}],
  "solver": {"method": %s}})";
const std::string ripping_by_auto = with_method(ripping_scene, "\"auto\"");
const std::string ripping_by_lines = with_method(ripping_scene, "\"line\", \"substeps\": 8");

/// Gas blows two squares up that start flat.
constexpr const char* blown_scene = R"({"time": {"frames": 21}, "cloths": [
    {"name": "a", "grid": [7, 7], "size": [0.4, 0.4], "placement": {"v": [0, 0.2, 1]}, "stiffness": {"stretch": 500}},
    {"name": "b", "grid": [7, 7], "size": [0.4, 0.4], "placement": {"v": [0, 0.2, 1]}, "stiffness": {"stretch": 500}}],
  "seams": [{"a": {"cloth": "a", "edge": "left"}, "b": {"cloth": "b", "edge": "left"}},
            {"a": {"cloth": "a", "edge": "right"}, "b": {"cloth": "b", "edge": "right"}},
            {"a": {"cloth": "a", "edge": "top"}, "b": {"cloth": "b", "edge": "top"}},
            {"a": {"cloth": "a", "edge": "bottom"}, "b": {"cloth": "b", "edge": "bottom"}}],
  "gas": [{"cloths": ["a", "b"], "outside": "back", "volume_keys": [{"t": 0, "volume": 0}, {"t": 0.3, "volume": 0.01}]}],
  "solver": {"method": %s}})";
const std::string blown_by_auto = with_method(blown_scene, "\"auto\"");
const std::string blown_by_lines = with_method(blown_scene, "\"line\", \"substeps\": 8, \"estimate_error\": true");

INSTANTIATE_TEST_SUITE_P(
    Scenes, SimulationStateTest,
    testing::Values(
        Case{"ClosedLoop", closed_loop_scene}, Case{"MeetsItself", meeting_scene}, Case{"Asleep", sleeping_scene},
        Case{"CutByAuto", cut_by_auto.c_str(), true}, Case{"CutByLine", cut_by_line.c_str(), true},
        Case{"TornByAuto", torn_by_auto.c_str(), true}, Case{"TornByLine", torn_by_line.c_str(), true},
        Case{"Relaxed", relaxed.c_str()}, Case{"Explicit", explicitly.c_str()}, Case{"ByLines", by_lines.c_str()},
        Case{"Alike", alike_scene, true}, Case{"WeatherByAuto", weather_by_auto.c_str()},
        Case{"WeatherByLines", weather_by_lines.c_str()}, Case{"PassedByLines", passed_by_lines.c_str()},
        Case{"PassedByAuto", passed_by_auto.c_str()}, Case{"DeformingByAuto", deforming_by_auto.c_str(), true},
        Case{"DeformingByLines", deforming_by_lines.c_str(), true},
        Case{"RestingAsItStarts", resting_as_it_starts.c_str()}, Case{"RippingByAuto", ripping_by_auto.c_str(), true},
        Case{"RippingByLines", ripping_by_lines.c_str(), true}, Case{"BlownByAuto", blown_by_auto.c_str()},
        Case{"BlownByLines", blown_by_lines.c_str()}),
    [](const auto& each) { return std::string(each.param.name); });

TEST_F(SimulationStateGuard, WhatIsNotOfTheSceneIsRefused) {
    const auto simulation_of = [](const std::string& text) {
        return Simulation(parse_scene(text), {}, library_device());
    };
    Simulation first = simulation_of(cut_by_auto);
    for (int frame = 0; frame < 20; ++frame) first.step();
    while (!first.can_save()) first.step();
    const SimulationState state = first.save();
    ASSERT_TRUE(state.contains("cuts/cloth"));
    EXPECT_THROW(simulation_of(relaxed).restore(state), Error);
    EXPECT_THROW(simulation_of(cut_by_line).restore(state), Error);
    for (const std::string name : {"loop", "watch", "passages", "field/cloth/position", "cuts/cloth"}) {
        const auto& bytes = state.at(name);
        SimulationState without = state, shorter = state, longer = state;
        without.erase(name);
        shorter[name].resize(bytes.size() - 1);
        longer[name].resize(bytes.size() + 1);
        for (SimulationState* const wrong : {&without, &shorter, &longer}) seal(*wrong);
        if (!name.starts_with("cuts/")) {
            EXPECT_THROW(simulation_of(cut_by_auto).restore(without), Error) << name;
        }
        EXPECT_THROW(simulation_of(cut_by_auto).restore(shorter), Error) << name;
        EXPECT_THROW(simulation_of(cut_by_auto).restore(longer), Error) << name;
    }
}

TEST_F(SimulationStateGuard, DamageIsRefusedAndChangesNothing) {
    const auto error_of = [](Simulation& simulation, const SimulationState& state) {
        try {
            simulation.restore(state);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string("taken");
    };
    Simulation simulation(parse_scene(by_lines), {}, library_device());
    for (int frame = 0; frame < 3; ++frame) simulation.step();
    const SimulationState state = simulation.save();
    const char* const damaged = "the saved state is damaged: its checksum does not fit";
    for (const auto& [name, bytes] : state) {
        SimulationState flipped = state, without = state, other_name = state;
        if (!bytes.empty()) flipped[name][bytes.size() / 2] ^= std::byte{1};
        without.erase(name);
        other_name[name + "'"] = bytes;
        if (!bytes.empty()) {
            EXPECT_EQ(error_of(simulation, flipped), damaged) << name;
        }
        EXPECT_EQ(error_of(simulation, without),
                  name == "checksum"
                      ? "the saved state has no checksum: it is damaged, or was saved before states had one"
                      : damaged);
        EXPECT_EQ(error_of(simulation, other_name), damaged) << name;
        EXPECT_EQ(simulation.save(), state) << name;
    }
    EXPECT_EQ(error_of(simulation, state), "taken");
}

/// Returns a state with another number at `place` of the part `loop` (engine/docs/checkpoint.md): 0: next frame, 4:
/// substeps, 8: first frame not simulated.
SimulationState with_number(SimulationState state, std::size_t place, std::uint32_t number) {
    std::memcpy(state.at("loop").data() + place, &number, sizeof number);
    seal(state);
    return state;
}

TEST_F(SimulationStateGuard, NumbersThatNoLoopComesToAreRefused) {
    constexpr std::uint32_t any = 0xffffffffu;
    SimulationOptions options;
    options.keep_promises = false;
    for (const std::string& text : {relaxed, std::string(closed_loop_scene)}) {
        const SceneDescription scene = parse_scene(text);
        const auto restored = [&](const SimulationState& state) {
            Simulation simulation(scene, options, library_device());
            simulation.restore(state);
            return simulation.next_frame();
        };
        Simulation first(scene, options, library_device());
        do first.step();
        while (first.next_frame() < 5 || !first.can_save());
        const SimulationState state = first.save();
        const std::uint32_t next = first.next_frame(), substeps = first.scene().solver.substeps;
        EXPECT_EQ(restored(state), next);
        EXPECT_EQ(restored(with_number(state, 0, 1'000'000)), 1'000'000u) << "a loop may run beyond its scene's frames";
        EXPECT_THROW(restored(with_number(state, 0, 1'000'001)), Error);
        EXPECT_THROW(restored(with_number(state, 0, any)), Error);
        EXPECT_THROW(restored(with_number(state, 4, 0)), Error) << "the next frame divides by it";
        EXPECT_THROW(restored(with_number(state, 4, substeps + 1)), Error);
        EXPECT_THROW(restored(with_number(state, 4, any)), Error);
        EXPECT_THROW(restored(with_number(with_number(state, 0, any), 8, any)), Error);
    }
}

TEST_F(SimulationStateWatch, WhatMayHavePassedIsTold) {
    Told lines, loop;
    Simulation named(parse_scene(passed_by_lines), options_of(lines, false), library_device());
    run(named, lines);
    ASSERT_TRUE(lines.passage);
    EXPECT_NE(lines.passage->find("from frame"), std::string::npos) << *lines.passage;
    // `auto` takes the substeps at which contact is sure, and before and after those that it takes anyway.
    Simulation automatic(parse_scene(passed_by_auto), options_of(loop, false), library_device());
    run(automatic, loop);
    EXPECT_EQ(loop.passage, std::nullopt);
    std::uint32_t most = 0;
    for (const auto& [frame, each] : loop.frames) most = std::max(most, each.substeps);
    EXPECT_GT(most, 4 * loop.frames.at(3).substeps);
    EXPECT_LT(2 * loop.frames.rbegin()->second.substeps, most);
}

/// Explicit steps do not follow inextensible cloth in eight substeps; an error that lasts for six frames is no result.
TEST_F(SimulationStateWatch, TheWatchRemembersWhatWasSeenBefore) {
    const SceneDescription scene = parse_scene(R"({"time": {"frames": 60}, "solver": {"method": "explicit",
  "substeps": 8}, "cloths": [{"name": "cloth", "grid": [17, 17], "size": [1, 1], "stiffness": "rigid",
  "placement": {"u": [1, 0, 0], "v": [0, 0, 1]}, "pins": [{"box": [[0, 0], [16, 0]]}]}]})");
    const auto failing_frame = [](Simulation& simulation) {
        try {
            while (simulation.step()) {
            }
        } catch (const Diverged&) {
        }
        return simulation.next_frame();
    };
    Simulation whole(scene, {}, library_device());
    const std::uint32_t failed = failing_frame(whole);
    ASSERT_GT(failed, 10u);
    ASSERT_LT(failed, 60u);
    for (const std::uint32_t before : {1u, 3u, 5u}) {
        Simulation first(scene, {}, library_device()), second(scene, {}, library_device());
        while (first.next_frame() < failed - before) first.step();
        second.restore(first.save());
        EXPECT_EQ(failing_frame(second), failed) << before;
    }
}

TEST_F(SimulationStateGuard, ASleeperWithoutTheFrameThatItRepeatsIsRefused) {
    const SceneDescription scene = parse_scene(sleeping_scene);
    Simulation first(scene, {}, library_device()), other(scene, {}, library_device());
    do first.step();
    while (!first.frame().effort.asleep);
    const SimulationState state = first.save();
    // The flag that says whether statistics follow may lie anywhere; one at their end may say that nothing does.
    std::size_t refused = 0;
    for (std::size_t place = state.at("loop").size(); place-- > 0;) {
        SimulationState without = state;
        without.at("loop").resize(place + 1);
        without.at("loop")[place] = std::byte{0};
        seal(without);
        try {
            other.restore(without);
        } catch (const Error&) {
            ++refused;
            continue;
        }
        ASSERT_TRUE(other.step()) << place;
        ASSERT_TRUE(other.frame().effort.asleep) << place;
        ASSERT_EQ(other.frame().statistics.size(), 1u) << place;
    }
    EXPECT_GE(refused + 5, state.at("loop").size());
}

}  // namespace
}  // namespace drape
