// Pilots fly a made-up cloth whose error is known: no device and no twin is needed to see what they ask for.
#include "control/pilot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <vector>

#include "cloth/rungs.h"
#include "control/frame_judgement.h"
#include "support/sheets.h"

namespace drape {
namespace {

constexpr std::uint32_t frames_per_second = 60;

SceneDescription hanging_sheet(SolverMethod method) {
    SceneDescription scene = test::sheet(65, 65, 1, 1, 4);
    scene.cloths[0].pins = {test::pin_top(scene.cloths[0])};
    scene.time.frame_count = 200;
    scene.time.fps = frames_per_second;
    scene.solver = {};
    scene.solver.method = method;
    if (method != SolverMethod::automatic) scene.solver.substeps = 6;
    return scene;
}

/// A state is how far it is from the exact motion, m: with n substeps a frame adds `rate(frame)`/n^2 a second.
class MadeUpCloth {
  public:
    explicit MadeUpCloth(std::function<double(std::uint32_t)> rate) : rate_(std::move(rate)) {}

    WorkResult done(const Work& work) {
        WorkResult result;
        ++works;
        if (work.before) step(*work.before, work, result);
        if (work.changes_substeps()) {
            EXPECT_EQ(work.history_substeps, at(work.set).substeps) << "frame " << work.frame;
        }
        if (work.simulates) {
            State& state = at(work.set);
            EXPECT_EQ(state.frame + 1, work.frame) << "a frame is simulated from the end of the one before";
            if (!work.changes_substeps() && work.set == StateSet::run && work.before) {
                EXPECT_EQ(state.substeps, work.substeps) << "frame " << work.frame;
            }
            state.frame = work.frame;
            state.substeps = work.substeps;
            state.error += rate_(work.frame) / (frames_per_second * std::pow(work.substeps, 2));
            ClothStatistics statistics;
            statistics.largest_speed = 1;  // it never sleeps
            statistics.largest_distance = 1;
            result.statistics = {statistics};
        }
        if (work.after) step(*work.after, work, result);
        return result;
    }

    double error() { return at(StateSet::run).error; }
    std::uint32_t frame() { return at(StateSet::run).frame; }
    std::size_t works = 0;

  private:
    struct State {
        double error = 0;
        std::uint32_t frame = 0, substeps = 0;
    };
    State& at(StateSet set) { return states_[static_cast<std::size_t>(set)]; }

    void step(StateStep step, const Work& work, WorkResult& result) {
        const auto apart = [&](const State& a, const State& b) {
            EXPECT_EQ(a.frame, b.frame) << "states of unlike frames are compared";
            result.differences = {std::abs(a.error - b.error)};
        };
        switch (step) {
            case StateStep::keep:
                kept_[work.set] = at(work.set);
                break;
            case StateStep::restore:
                at(work.set) = kept_.at(work.set);
                break;
            case StateStep::change_substep:
                ADD_FAILURE() << "changes are told by the work's substeps";
                break;
            case StateStep::remember:
                remembered_ = at(work.set);
                break;
            case StateStep::compare:
                apart(at(work.set), remembered_);
                break;
            case StateStep::compare_companion:
                apart(at(StateSet::run), at(StateSet::companion));
                break;
            case StateStep::disturb:
                at(StateSet::disturbed) = at(StateSet::companion);
                break;
            case StateStep::compare_disturbed:
                apart(at(StateSet::companion), at(StateSet::disturbed));
                break;
        }
    }

    std::function<double(std::uint32_t)> rate_;
    std::array<State, state_set_count> states_;
    std::map<StateSet, State> kept_;
    State remembered_;

  public:
    void begin_with(std::uint32_t substeps) {
        for (State& state : states_) state.substeps = substeps;
    }
};

struct Flight {
    std::vector<std::uint32_t> frames, substeps;  ///< handed out and kept
    std::vector<FrameEffort> efforts;
};

/// Flies to a frame; `stops(work)` abandons the frames that work is for, once.
Flight fly(
    Pilot& pilot, MadeUpCloth& cloth, std::uint32_t last,
    const std::function<bool(const Work&)>& stops = [](const Work&) { return false; }) {
    Flight flight;
    while (pilot.simulated() <= last) {
        const std::uint32_t first = pilot.simulated();
        std::vector<std::uint32_t> held;
        pilot.begin();
        bool abandoned = false;
        while (std::optional<Work> work = pilot.next_work()) {
            if (cloth.works > 100'000) throw std::runtime_error("a pilot that never decides");
            if (!abandoned && stops(*work)) {
                pilot.abandon(*work);
                held.clear();
                abandoned = true;
                continue;
            }
            if (work->attempt > 0 && work->before) held.clear();
            const FrameEffort effort =
                work->simulates || work->before ? pilot.take(*work, cloth.done(*work)) : FrameEffort{};
            if (!work->hands_out) continue;
            EXPECT_EQ(cloth.frame(), work->frame) << "the state is not the frame's";
            held.push_back(work->frame);
            if (!pilot.kept()) flight.efforts.push_back(effort);
        }
        if (abandoned) {
            EXPECT_EQ(pilot.simulated(), first);
            continue;
        }
        for (const std::uint32_t frame : held) {
            flight.frames.push_back(frame);
            flight.substeps.push_back(pilot.state_substeps());
            if (pilot.kept()) flight.efforts.push_back(pilot.kept()->effort);
        }
        EXPECT_EQ(cloth.frame() + 1, pilot.simulated());
    }
    return flight;
}

void expect_each_once(const std::vector<std::uint32_t>& frames, std::uint32_t last) {
    ASSERT_GE(frames.size(), last);
    for (std::uint32_t k = 0; k < last; ++k) EXPECT_EQ(frames[k], k + 1);
}

/// Returns the substeps per frame at which the error per second is its limit.
double enough(const SimulationModel& model, double rate) { return std::sqrt(rate / motion_limit(model, 0)); }

TEST(Pilot, OfANamedMethodNeverChangesItsMind) {
    const SimulationModel model(hanging_sheet(SolverMethod::line));
    const auto pilot = make_pilot(model);
    MadeUpCloth cloth([](std::uint32_t) { return 1e9; });
    cloth.begin_with(6);
    const Flight flight = fly(*pilot, cloth, 30);
    expect_each_once(flight.frames, 30);
    EXPECT_EQ(cloth.works, 30u) << "each frame is simulated once";
    for (const FrameEffort& effort : flight.efforts) EXPECT_EQ(effort.substeps, 6u);
}

TEST(Pilot, OfANamedMethodSendsACompanionAhead) {
    SceneDescription scene = hanging_sheet(SolverMethod::line);
    scene.solver.estimate_error = true;
    const SimulationModel model(scene);
    const auto pilot = make_pilot(model);
    constexpr double rate = 0.01;
    MadeUpCloth cloth([](std::uint32_t) { return rate; });
    cloth.begin_with(6);
    const Flight flight = fly(*pilot, cloth, 60);
    EXPECT_EQ(cloth.works, 120u);
    const double stated = flight.efforts.back().position_error, truth = cloth.error();
    EXPECT_GT(stated, 0.5 * truth);
    EXPECT_LT(stated, 3 * truth);
}

TEST(Pilot, OfAutoFindsTheSubstepsThatTheErrorAsksFor) {
    const SimulationModel model(hanging_sheet(SolverMethod::automatic));
    ASSERT_TRUE(model.closed_loop());
    for (const double rate : {0.3, 3.0, 30.0}) {
        const auto pilot = make_pilot(model);
        MadeUpCloth cloth([&](std::uint32_t) { return rate; });
        cloth.begin_with(model.scene.solver.substeps);
        const Flight flight = fly(*pilot, cloth, 150);
        expect_each_once(flight.frames, 150);
        const double needed = enough(model, rate);
        for (const std::uint32_t substeps : flight.substeps) EXPECT_GE(1.5 * substeps, 0.75 * needed) << rate;
        EXPECT_LE(flight.substeps.back(), std::max(4 * needed, 2.0 * model.scene.solver.substeps)) << rate;
        for (const FrameEffort& effort : flight.efforts) EXPECT_TRUE(effort.within_limits);
    }
}

TEST(Pilot, OfAutoDoesAFrameAgainWhereItsErrorRises) {
    const SimulationModel model(hanging_sheet(SolverMethod::automatic));
    ASSERT_EQ(row_of(model.scene.solver.method).trust, Method::Trust::probed);
    const auto pilot = make_pilot(model);
    MadeUpCloth cloth([](std::uint32_t frame) { return frame < 80 ? 0.01 : 100; });
    cloth.begin_with(model.scene.solver.substeps);
    const Flight flight = fly(*pilot, cloth, 190);
    expect_each_once(flight.frames, 190);
    EXPECT_TRUE(std::ranges::any_of(flight.efforts, [](const FrameEffort& each) { return each.attempts > 1; }));
    for (const FrameEffort& each : flight.efforts) {
        ASSERT_EQ(each.failed.size() + 1, std::max(each.attempts, 1u));
        for (const FailedAttempt& failed : each.failed) {
            EXPECT_EQ(failed.criterion, Criterion::motion);
            EXPECT_GT(failed.times, 1);
            EXPECT_LT(failed.substeps, each.substeps);
        }
    }
    EXPECT_GT(flight.substeps[189], flight.substeps[70]);
    // The rise goes unnoticed until the next probe. An error that is already k times what is allowed, 3 at most, may
    // grow k times as fast as the limit says.
    double share = 0;
    std::size_t after = 0;
    for (const FrameEffort& each : flight.efforts) {
        if (!std::isnan(each.motion_error)) {
            EXPECT_LE(each.motion_error, 1.01 * std::clamp(share, 1.0, 3.0) * motion_limit(model, 0));
            after += each.motion_error > 0.1 * motion_limit(model, 0);
        }
        share = each.position_error / each.position_allowed;
    }
    EXPECT_GT(after, 0u);
}

TEST(Pilot, OfAutoRefusesWhatNoSubstepsReach) {
    const SimulationModel model(hanging_sheet(SolverMethod::automatic));
    const auto pilot = make_pilot(model);
    MadeUpCloth cloth([](std::uint32_t) { return 1e12; });
    cloth.begin_with(model.scene.solver.substeps);
    const Flight flight = fly(*pilot, cloth, 1);
    ASSERT_TRUE(pilot->refusal());
    EXPECT_EQ(pilot->refusal()->kind, FrameFailure::Kind::tolerance);
    EXPECT_EQ(flight.substeps.front(), substep_rungs(row_of(model.scene.solver.method)).back());
    EXPECT_FALSE(flight.efforts.front().within_limits);
}

TEST(Pilot, OfAutoTakesLongerSubstepsThanASwingNeedsWhereTheErrorIsSmall) {
    const SimulationModel model(hanging_sheet(SolverMethod::automatic));
    const auto last = [&](double rate) {
        const auto pilot = make_pilot(model);
        MadeUpCloth cloth([&](std::uint32_t frame) { return frame < 120 ? rate : 3.0; });
        cloth.begin_with(model.scene.solver.substeps);
        const std::uint32_t calm = fly(*pilot, cloth, 119).substeps.back();
        EXPECT_LT(cloth.error(), 0.3 * 2 * motion_limit(model, 0));
        EXPECT_GE(fly(*pilot, cloth, 190).substeps.back(), model.choice.calm_substeps) << "until the error rises";
        return calm;
    };
    EXPECT_LT(last(1e-4), model.choice.calm_substeps);
    EXPECT_LE(last(1e-4), last(1e-2));
}

TEST(Pilot, OfAutoForgetsFramesThatAreAbandoned) {
    const SimulationModel model(hanging_sheet(SolverMethod::automatic));
    const auto rate = [](std::uint32_t frame) { return 0.3 + 0.1 * (frame % 7); };
    const auto straight = make_pilot(model), stopped = make_pilot(model);
    MadeUpCloth one(rate), other(rate);
    one.begin_with(model.scene.solver.substeps);
    other.begin_with(model.scene.solver.substeps);
    const Flight expected = fly(*straight, one, 120);
    std::size_t works = 0;
    const Flight found = fly(*stopped, other, 120,
                             [&](const Work& work) { return work.attempt > 0 && ++works % 17 == 0 && works < 400; });
    EXPECT_EQ(found.frames, expected.frames);
    EXPECT_EQ(found.substeps, expected.substeps);
    EXPECT_EQ(other.error(), one.error());
}

TEST(Pilot, OfAutoGoesOnFromWhatItWrote) {
    const SimulationModel model(hanging_sheet(SolverMethod::automatic));
    const auto rate = [](std::uint32_t frame) { return frame < 60 ? 0.1 : 10.0; };
    const auto first = make_pilot(model);
    MadeUpCloth cloth(rate);
    cloth.begin_with(model.scene.solver.substeps);
    fly(*first, cloth, 50);
    ByteWriter writer;
    first->write(writer);
    const std::vector<std::byte> bytes = writer.take();
    const auto second = make_pilot(model);
    ByteReader reader(bytes);
    second->read(reader);
    EXPECT_EQ(reader.left(), 0u);
    MadeUpCloth copy = cloth;
    const Flight expected = fly(*first, cloth, 120), found = fly(*second, copy, 120);
    EXPECT_EQ(found.frames, expected.frames);
    EXPECT_EQ(found.substeps, expected.substeps);
    EXPECT_EQ(copy.error(), cloth.error());
    std::vector<std::byte> wrong = bytes;
    wrong[0] = std::byte{0xff};  // no such substeps
    ByteReader of_wrong(wrong);
    EXPECT_THROW(make_pilot(model)->read(of_wrong), Error);
}

}  // namespace
}  // namespace drape
