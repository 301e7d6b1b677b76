#include "cloth/frame_steps.h"

#include <algorithm>
#include <set>
#include <utility>
#include <variant>

#include "cloth/cloth_state.h"
#include "cloth/forces.h"
#include "cloth/frame_inputs.h"
#include "cloth/texels.h"

namespace drape {

namespace {

/// Adds the steps of one cloth's substep to a frame.
class Substep {
  public:
    Substep(const SimulationModel& model, std::size_t cloth, std::uint32_t substep, std::vector<Step>& steps)
        : model_(model), cloth_(model.cloths[cloth]), index_(cloth), substep_(substep), steps_(steps) {}

    void add() {
        release();
        wind();
        predict();
        once();
        for (std::uint32_t iteration = 0; iteration < iteration_count(); ++iteration) {
            solve(iteration);
            touch(iteration);
            check(iteration);
        }
        add_tethers();
    }

    // The parts of a substep, in their order.
    void release() {
        if (cloth_.has_release) add(StepKind::release);
    }
    void wind() {
        if (model_.windy) add(StepKind::wind);
    }
    /// `joint`: of the line method, as in PredictPush.
    void predict(int joint = -1) {
        add(cloth_.scheme.prediction);
        if (joint >= 0) std::get<glsl::PredictPush>(steps_.back().constants).joint = joint;
        if (cloth_.has_motion) add(StepKind::pin);
    }
    /// Bending is relaxed once per substep: it has no multiplier, so a second pass would make the cloth stiffer.
    void once() { add(cloth_.scheme.once); }
    std::uint32_t iteration_count() const { return model_.method().iterates() ? model_.scene.solver.iterations : 1; }
    void solve(std::uint32_t iteration) {
        for (const MethodStep& step : cloth_.scheme.iterated)
            steps_.push_back({step.kind, index_, substep_, iteration, step.constants,
                              is_last(iteration) && ends_frame(), 1, is_conditional(iteration)});
        if (is_last(iteration)) add(cloth_.scheme.ended);
    }
    bool touches(std::uint32_t iteration) const {
        const SolverSettings& solver = model_.scene.solver;
        return !model_.scene.colliders.empty() && (solver.collide == CollideWhen::iteration || is_last(iteration));
    }
    void touch(std::uint32_t iteration) {
        if (touches(iteration))
            collide(iteration, is_last(iteration) && !collides_again()).conditional =
                is_conditional(iteration) && model_.scene.solver.collide == CollideWhen::iteration;
    }
    void check(std::uint32_t iteration) {
        if (model_.adaptive() && !is_last(iteration))
            for (const StepKind kind : {StepKind::residual, StepKind::decide})
                add(kind, iteration).conditional = is_conditional(iteration);
    }
    bool has_tethers() const {
        return !cloth_.tethers.empty() || (!model_.scene.colliders.empty() && collides_again());
    }
    /// Ends a substep: adds tethers, and once more the contacts into which they may have pulled particles.
    void add_tethers() {
        if (!cloth_.tethers.empty()) add(StepKind::tether);
        if (!model_.scene.colliders.empty() && collides_again()) collide(model_.scene.solver.iterations, true);
    }

  private:
    Step& add(StepKind kind, std::uint32_t iteration = 0) {
        return steps_.emplace_back(Step{kind, index_, substep_, iteration});
    }
    void add(const std::vector<MethodStep>& planned) {
        for (const MethodStep& step : planned) {
            Step& added = add(step.kind);
            added.constants = step.constants;
            added.last = ends_frame();
        }
    }
    bool ends_frame() const { return substep_ + 1 == model_.scene.solver.substeps; }
    bool is_last(std::uint32_t iteration) const { return iteration + 1 == iteration_count(); }
    bool is_conditional(std::uint32_t iteration) const { return model_.adaptive() && iteration > 0; }
    /// Returns whether contact comes once more after the iterations: after tethers, or where the device may skip the
    /// last iteration, in which the edges of boxes would be handled.
    bool collides_again() const { return !cloth_.tethers.empty() || (cloth_.edge_reach > 0 && model_.adaptive()); }
    /// `ends`: nothing moves the particles afterwards in this substep.
    Step& collide(std::uint32_t iteration, bool ends) {
        const bool edges = ends && cloth_.edge_reach > 0;
        if (edges) add(StepKind::collider_edges, iteration);
        // A corner that was led off one triangle may have passed a neighbouring one.
        if (edges) add(StepKind::collider_edges, iteration).after_edges = true;
        Step& step = add(StepKind::collide, iteration);
        step.after_edges = edges;
        step.supporting = model_.self_contact.has_value();
        // Where cloths can touch each other, only motions that contact between cloths checks may lead a particle
        // (ContactSteps::collide).
        step.leading = !std::exchange(collided_, true) && !model_.self_contact;
        return step;
    }

    const SimulationModel& model_;
    const ClothModel& cloth_;
    std::size_t index_;
    std::uint32_t substep_;
    std::vector<Step>& steps_;
    bool collided_ = false;
};

/// A step by which a cloth gives or takes what is at its seams.
struct SeamStep {
    StepKind kind;
    std::size_t cloth;
    int stage;
};

/// Returns the forces that move an inner particle of a cloth by a metre in a substep, N: backward Euler and BDF2.
glsl::vec2 forces_of(const ClothModel& cloth) {
    for (const MethodStep& step : cloth.scheme.prediction) {
        if (const auto* both = std::get_if<glsl::PredictPush>(&step.constants))
            return {1 / both->force_step.x, 1 / both->force_step.y};
        if (const auto* force = std::get_if<glsl::ForcePush>(&step.constants)) return {1 / force->force_step, 0};
        if (const auto* force = std::get_if<glsl::ExplicitPush>(&step.constants)) return {1 / force->force_step, 0};
    }
    return {};
}

/// Returns whether a stage is the frame's first that adds to the loads on seams.
bool begins_loads(const SimulationModel& model, std::uint32_t substep, int stage) {
    const bool by_air = model.windy && model.method().iterates();
    return substep == 0 && stage == (by_air ? glsl::seam_forces : glsl::seam_predicted);
}

void add_seam(const SimulationModel& model, std::uint32_t substep, const SeamStep& step, std::vector<Step>& steps) {
    const auto count = static_cast<int>(model.cloths[step.cloth].sewn.size());
    if (count == 0) return;
    const std::size_t weather = first_weather(model, model.cloths[step.cloth].member, substep);
    const auto opening = static_cast<int>(substep * model.closings.size());
    const int first = begins_loads(model, substep, step.stage) ? 1 : 0;
    const float share = 1.0f / static_cast<float>(model.scene.solver.substeps);
    steps.push_back({step.kind, step.cloth, substep, 0,
                     glsl::SeamPush{count, step.stage, opening, static_cast<int>(weather) + 1,
                                    forces_of(model.cloths[step.cloth]), -1, 0, 0, first, share, 0}});
}

/// Lets all cloths give, and then take.
void hand_on(const SimulationModel& model, std::uint32_t substep, int stage, std::vector<Step>& steps) {
    for (const StepKind kind : {StepKind::seam_give, StepKind::seam_take})
        for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth)
            add_seam(model, substep, {kind, cloth, stage}, steps);
}

/// Lets cloths that are sewn together hand on which order of step they may take, so that all take the same.
void join_orders(const SimulationModel& model, std::uint32_t substep, const std::vector<int>& joints,
                 std::vector<Step>& steps) {
    std::set<int> begun;
    for (std::size_t cloth = 0; cloth < joints.size(); ++cloth) {
        if (joints[cloth] < 0) continue;
        const auto& predicts = std::get<glsl::PredictPush>(model.cloths[cloth].scheme.prediction.front().constants);
        const int begins = begun.insert(joints[cloth]).second ? 1 : 0;
        const glsl::SeamPush push{1, glsl::seam_orders, 0, 0, {}, joints[cloth], begins, predicts.most_wrong, 0, 0, 0};
        steps.push_back({StepKind::seam_give, cloth, substep, 0, push});
    }
}

/// Finds the pressures of gas in a substep or, where it `ends` a frame, the volumes there.
void add_gas(const SimulationModel& model, const std::vector<int>& joints, std::uint32_t substep, bool ends,
             std::vector<Step>& steps) {
    if (model.scene.gas.empty()) return;
    const auto& cloths = model.cloths;
    for (std::size_t k = 0; k < cloths.size(); ++k)
        if (cloths[k].gas || !cloths[k].sewn.empty())
            steps.push_back({StepKind::gas_area, k, substep, 0, gas_area_push(cloths[k])});
    hand_on(model, substep, glsl::seam_areas, steps);
    for (std::size_t k = 0; k < cloths.size(); ++k)
        if (cloths[k].gas) steps.push_back({StepKind::gas_sum, k, substep, 0, gas_sum_push(cloths[k])});
    for (std::size_t k = 0; k < cloths.size(); ++k)
        if (cloths[k].gas)
            steps.push_back(
                {StepKind::gas_pressure, k, substep, 0, gas_push(model, cloths[k], substep, joints[k], ends)});
}

/// Adds a substep of cloths that are sewn: they take turns, and what one does to a seam the others get before theirs.
class SewnSubstep {
  public:
    /// `joints`: sewn_joints of the model's cloths.
    SewnSubstep(const SimulationModel& model, const std::vector<int>& joints, std::uint32_t substep,
                std::vector<Step>& steps)
        : model_(model), joints_(joints), substep_(substep), steps_(steps) {
        for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth)
            parts_.emplace_back(model, cloth, substep, steps);
        taken_.resize(parts_.size());
    }

    void add() {
        for (Substep& part : parts_) part.release();
        if (std::ranges::any_of(model_.cloths, &ClothModel::has_release)) hand_on(glsl::seam_released);
        const bool has_orders = model_.cloths.front().scheme.second_order;
        if (has_orders) join_orders(model_, substep_, joints_, steps_);
        add_gas(model_, joints_, substep_, false, steps_);
        for (Substep& part : parts_) part.wind();
        if (model_.windy && model_.method().iterates()) hand_on(glsl::seam_forces);
        // Explicit steps count by what they change, so each has to know where it begins.
        if (!model_.method().iterates() &&
            std::ranges::any_of(model_.cloths, [](const ClothModel& cloth) { return lies_between(cloth.sewn); }))
            hand_on(glsl::seam_begun);
        for (std::size_t cloth = 0; cloth < parts_.size(); ++cloth)
            parts_[cloth].predict(has_orders ? joints_[cloth] : -1);
        hand_on(glsl::seam_predicted);
        for (std::uint32_t iteration = 0; iteration < parts_.front().iteration_count(); ++iteration)
            for (std::size_t cloth = 0; cloth < parts_.size(); ++cloth) iterate(cloth, iteration);
        for (std::size_t cloth = 0; cloth < parts_.size(); ++cloth)
            if (parts_[cloth].has_tethers()) {
                take(cloth);
                parts_[cloth].add_tethers();
                give(cloth, glsl::seam_touched);
            }
        for (std::size_t cloth = 0; cloth < parts_.size(); ++cloth) take(cloth);
    }

  private:
    void add(StepKind kind, std::size_t cloth, int stage) { add_seam(model_, substep_, {kind, cloth, stage}, steps_); }
    void hand_on(int stage) { drape::hand_on(model_, substep_, stage, steps_); }
    /// Returns whether no two of a cloth's own particles are sewn to each other and none lies between places, so that
    /// it has what it gives.
    bool is_alone(std::size_t cloth) const {
        return std::ranges::all_of(model_.cloths[cloth].sewn,
                                   [](const Sewn& each) { return each.sewn.at.w == 1 && each.sewn.between.x < 0; });
    }
    void give(std::size_t cloth, int stage) {
        if (model_.cloths[cloth].sewn.empty()) return;
        add(StepKind::seam_give, cloth, stage);
        ++given_;
        if (is_alone(cloth)) taken_[cloth] = given_;
    }
    /// Gives a cloth what others have given since it last took or gave.
    void take(std::size_t cloth) {
        if (taken_[cloth] == given_) return;
        add(StepKind::seam_take, cloth, glsl::seam_touched);
        taken_[cloth] = given_;
    }
    void iterate(std::size_t cloth, std::uint32_t iteration) {
        Substep& part = parts_[cloth];
        const MethodScheme& scheme = model_.cloths[cloth].scheme;
        const bool touches = part.touches(iteration);
        if (!scheme.iterated.empty() || !scheme.once.empty()) {
            take(cloth);
            if (iteration == 0) part.once();
            part.solve(iteration);
            if (!touches || !is_alone(cloth)) give(cloth, glsl::seam_solved);
        }
        if (touches) {
            take(cloth);
            part.touch(iteration);
            give(cloth, glsl::seam_touched);
        }
        part.check(iteration);
    }

    const SimulationModel& model_;
    const std::vector<int>& joints_;
    std::uint32_t substep_;
    std::vector<Step>& steps_;
    std::vector<Substep> parts_;
    std::size_t given_ = 0;           ///< how often a cloth has handed on what springs or contact did
    std::vector<std::size_t> taken_;  ///< by cloth: what of it the cloth has
};

/// Adds the steps of contact between cloths at the end of a substep, so that nothing moves a particle after its motion
/// was found to cross nothing.
class ContactSteps {
  public:
    ContactSteps(const SimulationModel& model, std::uint32_t substep, std::vector<Step>& steps)
        : model_(model), contact_(*model.self_contact), substep_(substep), steps_(steps) {}

    void add() {
        add_for_cloths(StepKind::self_gather);
        sew(false);
        for (const StepKind kind :
             {StepKind::self_boxes, StepKind::self_tree, StepKind::self_blocks, StepKind::self_near})
            add_one(kind);
        if (!contact_.to_part.empty())
            for (const StepKind kind : {StepKind::self_crossings, StepKind::self_apart}) add_one(kind);
        for (const StepKind kind : {StepKind::self_primitives, StepKind::self_pairs, StepKind::self_begin})
            add_one(kind);
        add_impulses(false);
        if (model_.scene.force_fields || (model_.scene.forces && model_.cloths.size() > 1))
            add_for_cloths(StepKind::self_impulses);
        if (is_last()) add_impulses(true);
        if (!model_.scene.colliders.empty()) collide();
        sew(true);
        for (int round = 0; round < glsl::self_rounds; ++round) add_one(StepKind::self_limit, round);
        add_for_cloths(StepKind::self_return);
        // What lies between two places follows them.
        if (contact_.is_sewn()) hand_on(model_, substep_, glsl::seam_met, steps_);
        for (std::size_t cloth = 0; cloth < model_.cloths.size(); ++cloth)
            if (model_.cloths[cloth].turn) give_back(cloth);
    }

  private:
    bool is_last() const { return substep_ + 1 == model_.scene.solver.substeps; }
    Step& add_one(StepKind kind, int round = 0) {
        glsl::SelfContactPush push = contact_.push;
        push.round = round;
        return steps_.emplace_back(Step{kind, between_cloths, substep_, 0, push, is_last()});
    }
    /// Makes particles that are one alike, where each cloth has met colliders by itself.
    void sew(bool after_impulses) {
        if (contact_.push.sewn_count > 0 && !model_.scene.colliders.empty())
            add_one(StepKind::self_sew).after_impulses = after_impulses;
    }
    void add_impulses(bool looks_back) {
        for (int round = 0; round < glsl::self_iterations; ++round)
            add_one(StepKind::self_contact, round).looks_back = looks_back;
        add_one(StepKind::self_push).looks_back = looks_back;
    }
    void add_for_cloths(StepKind kind) {
        for (std::size_t cloth = 0; cloth < model_.cloths.size(); ++cloth)
            steps_.push_back(
                {kind, cloth, substep_, 0, contact_.cloth_push(cloth, substep_, model_.closings.size()), is_last()});
    }
    /// Gives a cloth that may turn the angular momentum back that contact has made.
    void give_back(std::size_t cloth) {
        for (const StepKind kind : {StepKind::self_couples, StepKind::self_turn})
            steps_.push_back({kind, cloth, substep_, 0, turn_push(cloth), is_last()});
    }
    glsl::ContactTurnPush turn_push(std::size_t cloth) const {
        const ClothModel& model = model_.cloths[cloth];
        const glsl::SelfCloth& laid = contact_.cloths[cloth];
        return {model.grid.size(),
                model.turn->about,
                texel(model.turn->axis, model.turn->any ? 1.0 : 0.0),
                laid.first,
                contact_.push.grid,
                laid.largest,
                laid.lightness,
                static_cast<int>(torque_count(model.grid)),
                static_cast<int>(substep_ % 2)};
    }
    void collide() {
        for (std::size_t cloth = 0; cloth < model_.cloths.size(); ++cloth)
            steps_.push_back({.kind = StepKind::collide,
                              .cloth = cloth,
                              .substep = substep_,
                              .iteration = model_.scene.solver.iterations + 1,
                              .constants = contact_.cloth_push(cloth, substep_, model_.closings.size()),
                              .supporting = true,
                              .leading = true,
                              .after_impulses = true});
    }

    const SimulationModel& model_;
    const SelfContact& contact_;
    std::uint32_t substep_;
    std::vector<Step>& steps_;
};

/// Adds each cloth's momentum to the frame's impulses, or takes it from them (`sign`).
void add_momenta(const SimulationModel& model, float sign, std::vector<Step>& steps) {
    if (!model.scene.forces) return;
    const std::uint32_t substep = sign < 0 ? 0 : model.scene.solver.substeps;
    for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth)
        steps.push_back({StepKind::momentum, cloth, substep, 0, momentum_push(model, model.cloths[cloth], sign)});
}

void add_begin_of_impulses(const SimulationModel& model, std::vector<Step>& steps) {
    if (!sums_impulses(model.scene)) return;
    const glsl::ClearImpulsesPush push{static_cast<int>(impulse_row_count(model.scene)), impulse_units(model)};
    for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth)
        steps.push_back({StepKind::clear_impulses, cloth, 0, 0, push});
    add_momenta(model, -1, steps);
}

/// Moves the bodies of every member, before anything of a substep.
void add_motion_of_bodies(const SimulationModel& model, std::uint32_t substep, std::vector<Step>& steps) {
    for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth)
        if (has_bodies(model, cloth)) {
            const glsl::BodyMovePush push = body_move_push(model, model.cloths[cloth].member, substep);
            if (bodies_meet(model)) steps.push_back({StepKind::body_meet, cloth, substep, 0, push});
            steps.push_back({StepKind::body_move, cloth, substep, 0, push});
        }
}

/// Gives them what the cloths gave, after all else of a substep.
void add_strikes(const SimulationModel& model, std::uint32_t substep, std::vector<Step>& steps) {
    if (body_count(model) == 0) return;
    for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth)
        steps.push_back(
            {StepKind::body_strike, cloth, substep, 0, body_strike_push(model, model.cloths[cloth], substep)});
}

/// Lets seams come apart that do not bear what they bore in the frame.
void add_rips(const SimulationModel& model, std::vector<Step>& steps) {
    for (const StepKind kind : {StepKind::seam_give, StepKind::seam_take})
        for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth)
            if (rips(model.cloths[cloth].sewn))
                add_seam(model, model.scene.solver.substeps, {kind, cloth, glsl::seam_ripped}, steps);
}

/// Looks for the largest impulse, after all of a substep has added its own.
void add_worst_impulses(const SimulationModel& model, std::uint32_t substep, std::vector<Step>& steps) {
    if (!model.scene.worst_forces) return;
    const glsl::WorstImpulsesPush push{static_cast<int>(impulse_sum_count(model.scene))};
    for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth)
        steps.push_back({StepKind::worst_impulses, cloth, substep, 0, push});
}

}  // namespace

std::vector<Step> frame_steps(const SimulationModel& model) {
    std::vector<Step> steps;
    add_begin_of_impulses(model, steps);
    for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth)
        if (model.cloths[cloth].stiffens) steps.push_back({StepKind::stiffness, cloth, 0});
    const std::vector<int> joints = sewn_joints(model);
    for (std::uint32_t substep = 0; substep < model.scene.solver.substeps; ++substep) {
        add_motion_of_bodies(model, substep, steps);
        if (model.sewn_count > 0)
            SewnSubstep(model, joints, substep, steps).add();
        else
            for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth)
                Substep(model, cloth, substep, steps).add();
        if (model.self_contact) ContactSteps(model, substep, steps).add();
        add_strikes(model, substep, steps);
        add_worst_impulses(model, substep, steps);
    }
    steps.push_back({StepKind::advance, all_cloths, model.scene.solver.substeps});
    add_rips(model, steps);
    add_momenta(model, 1, steps);
    add_gas(model, joints, model.scene.solver.substeps, true, steps);
    return steps;
}

std::vector<Step> normal_steps(const SimulationModel& model) {
    std::vector<Step> steps;
    for (const StepKind kind : {StepKind::seam_give, StepKind::seam_take})
        for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth)
            if (const auto count = static_cast<int>(model.cloths[cloth].sewn.size()); count > 0)
                steps.push_back(
                    {kind, cloth, 0, 0, glsl::SeamPush{count, glsl::seam_normals, 0, 0, {}, -1, 0, 0, 0, 0, 0}});
    return steps;
}

}  // namespace drape
