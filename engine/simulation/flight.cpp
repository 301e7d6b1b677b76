#include "simulation/flight.h"

#include <algorithm>
#include <cstring>

#include "cloth/members.h"
#include "cloth/spring_tension.h"
#include "cloth/substep_change.h"
#include "solver/contact_readback.h"
#include "solver/host_inputs.h"
#include "solver/readback_pass.h"
#include "solver/statistics_pass.h"

namespace drape {

namespace {

/// Fills the inputs of a member that takes no part in the submit to the size that they have with this number of
/// substeps.
void fill(const SimulationModel& model, std::uint32_t substeps, FrameInputs& inputs) {
    inputs.wind.assign(substeps * weather_vectors(model), {});
    std::size_t records = 0;
    for (const std::vector<KeptCollider>& list : model.kept_colliders) records += list.size();
    inputs.colliders.assign(records, {});
    inputs.collider_sets = 1;
    inputs.pins.resize(model.cloths.size());
    for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth)
        inputs.pins[cloth].assign(model.cloths[cloth].dynamic_pins.size() * substeps, {});
}

void keep_last_set(FrameInputs& inputs) {
    const auto count = static_cast<std::ptrdiff_t>(inputs.colliders.size() / inputs.collider_sets);
    inputs.colliders.erase(inputs.colliders.begin(), inputs.colliders.end() - count);
    inputs.collider_sets = 1;
}

bool compares(const std::optional<StateStep>& step) {
    using enum StateStep;
    return step == compare || step == compare_companion || step == compare_disturbed;
}

void write_present(FrameGraphs& graphs, std::uint32_t slot, const Flight& flight) {
    const std::size_t each = graphs.cloths_each();
    std::vector<bool> present(graphs.member_count() * each);
    for (const std::size_t member : flight.members)
        std::fill_n(present.begin() + static_cast<std::ptrdiff_t>(member * each), each, true);
    write_present(graphs.layout(), graphs.pool(), slot, present);
}

void write_changes(FrameGraphs& graphs, std::uint32_t slot, const Flight& flight) {
    const std::size_t each = graphs.cloths_each();
    std::vector<glsl::SubstepChange> all(graphs.member_count() * each);
    for (std::size_t place = 0; place < flight.members.size(); ++place) {
        const Work& work = flight.jobs[place].work;
        const std::size_t member = flight.members[place];
        std::ranges::copy(substep_changes(graphs.member(member), work.history_substeps, work.substeps),
                          all.begin() + static_cast<std::ptrdiff_t>(member * each));
    }
    write_changes(graphs.layout(), graphs.pool(), slot, all);
}

/// What the device read back of all cloths, and the velocities computed from it.
struct Arrays {
    std::vector<std::span<const float>> positions, normals, moved, excess;
};

/// Returns the state of the bodies that lies with a cloth.
std::span<const float> read_bodies(const FrameGraphs& graphs, std::uint32_t slot, std::size_t cloth) {
    const ClothLayout& layout = graphs.layout();
    const std::string name = readback_name(layout.state_name(cloth), bodies_readback);
    const std::span<const std::byte> bytes = layout.part_of(cloth, graphs.pool().buffer(name, slot));
    return {reinterpret_cast<const float*>(bytes.data()), bytes.size() / sizeof(float)};
}

/// What the springs and particles of a member bear in a frame, by cloth.
struct ForceFields {
    std::vector<std::vector<float>> tensions{}, contacts{};
};

ForceFields read_fields(FrameGraphs& graphs, std::uint32_t slot, const FinishedFrame& frame, std::size_t member,
                        const Work& work) {
    const ClothLayout& layout = graphs.layout();
    const std::uint32_t substeps = work.substeps > 0 ? work.substeps : work.history_substeps;
    const SimulationModel& run = graphs.member_at(member, graphs.joint().closed_loop() ? substeps : 0);
    const auto read = [&](std::size_t cloth, std::string_view what) -> std::span<const float> {
        const std::string name = readback_name(layout.state_name(cloth), what);
        if (work.frame == 0 || !graphs.pool().has(name)) return {};
        const std::span<const std::byte> bytes = layout.part_of(cloth, graphs.pool().buffer(name, slot));
        return {reinterpret_cast<const float*>(bytes.data()), bytes.size() / sizeof(float)};
    };
    ForceFields fields;
    for (std::size_t cloth = 0; cloth < graphs.cloths_each(); ++cloth) {
        const std::size_t k = member * graphs.cloths_each() + cloth;
        PerDirection<std::span<const float>> kept;
        for (std::size_t direction = 0; direction < kept.size(); ++direction)
            if (keeps_tension(run.cloths[cloth], direction)) kept[direction] = read(k, tension_readbacks[direction]);
        fields.tensions.push_back(
            spring_tensions(run, cloth, layout.topologies[k], work.frame, frame.positions[cloth], kept));
        fields.contacts.push_back(contact_forces(run, cloth, read(k, contact_readback)));
    }
    return fields;
}

}  // namespace

FrameContents contents_of(const FrameGraphs& graphs, const Job& job) {
    const Work& work = job.work;
    const SceneDescription& scene = graphs.joint().scene;
    const bool is_first = work.hands_out && work.frame == 0, is_run = work.set == StateSet::run;
    FrameContents contents;
    if (is_run) contents = graphs.contents(work.simulates, work.hands_out, is_first);
    contents.set = work.set;
    contents.simulates = work.simulates;
    if (work.simulates && (graphs.joint().closed_loop() || !is_run)) contents.substeps = work.substeps;
    contents.cuts = job.searches && !scene.cutters.empty();
    contents.tears = job.searches && scene.tears() && work.frame > 0;
    return contents;
}

void FlightInputs::write(FrameGraphs& graphs, std::uint32_t slot, const Flight& flight) {
    if (graphs.in_part()) write_present(graphs, slot, flight);
    if (flight.work().changes_substeps()) write_changes(graphs, slot, flight);
    // The initial frame simulates nothing, but its statistics need the places of the colliders.
    if (flight.contents.simulates || flight.contents.counts)
        write_frame(graphs, slot, flight);
    else
        write_constants(graphs.layout(), graphs.pool(), slot, graphs.joint().scene.solver.substeps);
    const double fps = graphs.joint().scene.time.fps;
    const std::uint32_t frame = flight.work().frame;
    if (flight.jobs.front().searches)
        write_cutters(graphs.joint().scene, graphs.pool(), slot, frame == 0 ? 0 : (frame - 1) / fps, frame / fps);
    if (flight.contents.hands_out && graphs.raster()) graphs.raster().write_frame(graphs.pool(), slot, frame / fps);
}

void FlightInputs::write_frame(FrameGraphs& graphs, std::uint32_t slot, const Flight& flight) {
    const std::uint32_t at = flight.contents.substeps;
    const SimulationModel& joint = graphs.joint_at(at);
    if (graphs.member_count() == 1)
        return write_inputs(graphs.layout(), graphs.pool(), slot, flight.work().frame, joint);
    const std::uint32_t substeps = joint.scene.solver.substeps;
    members_.resize(graphs.member_count());
    if (flight.members.size() < members_.size())
        for (std::size_t member = 0; member < members_.size(); ++member)
            fill(graphs.member(member), substeps, members_[member]);
    for (std::size_t place = 0; place < flight.members.size(); ++place) {
        const std::size_t member = flight.members[place];
        FrameInputs& own = members_[member];
        take_frame_inputs(graphs.member_at(member, at), flight.jobs[place].work.frame, own);
        // Each member of a closed loop begins with a number of substeps of its own, so a frame that is not simulated
        // takes the colliders of the last substep.
        if (!flight.contents.simulates) keep_last_set(own);
    }
    join_inputs(joint, members_, joined_);
    write_inputs(graphs.layout(), graphs.pool(), slot, joined_, substeps);
    write_constants(graphs.layout(), graphs.pool(), slot, substeps);
}

std::vector<WorkResult> flight_results(FrameGraphs& graphs, std::uint32_t slot, const Flight& flight) {
    const ClothLayout& layout = graphs.layout();
    const graph::ResourcePool& pool = graphs.pool();
    const bool is_single = graphs.member_count() == 1;
    const std::size_t each = graphs.cloths_each();
    const bool counts = flight.contents.counts, meets = flight.contents.simulates && graphs.joint().self_contact;
    const bool differs = compares(flight.work().before) || compares(flight.work().after);
    std::vector<StatisticsBytes> bytes;
    if (counts && !is_single) bytes = statistics_bytes(layout, pool, slot);
    std::vector<double> differences;
    if (differs) differences = read_differences(layout, pool, slot);
    const double list_use = meets ? self_list_use(layout, self_record(layout, pool, slot)) : 0;
    std::vector<WorkResult> results(flight.members.size());
    for (std::size_t place = 0; place < results.size(); ++place) {
        WorkResult& result = results[place];
        const std::size_t member = flight.members[place];
        const std::uint32_t frame = flight.jobs[place].work.frame;
        const SimulationModel& run = graphs.member_at(member, flight.contents.substeps);
        const auto own = [&](const auto& all) { return std::span(all).subspan(member * each, each); };
        if (counts && is_single) result.statistics = read_statistics(layout, pool, slot, frame, run);
        if (counts && !is_single) result.statistics = statistics_from(own(bytes), frame, run);
        if (differs) result.differences.assign(own(differences).begin(), own(differences).end());
        if (meets) result.contact = self_record_of(layout, pool, slot, member);
        result.list_use = list_use;
    }
    if (is_single) results.front().timings = graphs.timings(flight.contents, slot);
    return results;
}

void hand_out(FrameGraphs& graphs, std::uint32_t slot, const Flight& flight,
              const std::function<void(std::size_t place, const FinishedFrame& frame)>& take) {
    const FrameOptions& options = graphs.options();
    const std::size_t each = graphs.cloths_each();
    const double fps = graphs.joint().scene.time.fps;
    const bool hands_out = flight.contents.hands_out;
    Arrays arrays;
    const auto read = [&](bool wanted, std::string_view what) {
        return hands_out && wanted && !options.arrays_later ? read_back(graphs.layout(), graphs.pool(), slot, what)
                                                            : std::vector<std::span<const float>>();
    };
    arrays.positions = read(options.positions, "position");
    arrays.normals = read(options.normals, "normal");
    arrays.moved = read(options.velocities, "displacement");
    arrays.excess = read(options.velocities, "excess displacement");
    for (std::size_t place = 0; place < flight.jobs.size(); ++place) {
        const Work& work = flight.jobs[place].work;
        const WorkResult& result = flight.results[place];
        FinishedFrame frame;
        frame.frame = work.frame;
        frame.effort = work.known ? work.known->effort : flight.efforts[place];
        frame.statistics = work.known ? work.known->statistics : result.statistics;
        if (work.known) frame.timings = work.known->timings;
        frame.timings.insert(frame.timings.end(), result.timings.begin(), result.timings.end());
        const bool wanted = hands_out && flight.jobs[place].wanted;
        if (wanted && options.draw) graphs.raster().read(graphs.pool(), slot, frame);
        if (wanted && body_count(graphs.joint()) > 0)
            frame.bodies = body_states(graphs.member_at(flight.members[place], flight.contents.substeps),
                                       read_bodies(graphs, slot, flight.members[place] * each), work.frame);
        std::vector<std::vector<float>> velocities;
        for (std::size_t cloth = 0; cloth < each && wanted && !options.arrays_later; ++cloth) {
            const std::size_t k = flight.members[place] * each + cloth;
            if (options.positions) frame.positions.push_back(arrays.positions[k]);
            if (options.normals) frame.normals.push_back(arrays.normals[k]);
            if (!options.velocities) continue;
            // The statistics take the motion of the last substep for the velocity; without a substep it is 0.
            velocities.emplace_back(arrays.moved[k].size());
            if (work.substeps > 0)
                write_velocities(arrays.moved[k], arrays.excess[k], fps * work.substeps, velocities.back());
        }
        for (const std::vector<float>& array : velocities) frame.velocities.emplace_back(array);
        ForceFields fields;
        if (wanted && options.fields) fields = read_fields(graphs, slot, frame, flight.members[place], work);
        for (const std::vector<float>& array : fields.tensions) frame.tensions.emplace_back(array);
        for (const std::vector<float>& array : fields.contacts) frame.contact_forces.emplace_back(array);
        take(place, frame);
    }
}

}  // namespace drape
