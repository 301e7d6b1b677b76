#include "simulation/frame_server.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "solver/contact_readback.h"
#include "solver/state_transfer.h"

namespace drape {

namespace {

template <class List>
bool is_any(const List& list) {
    return std::ranges::any_of(list, [](const auto& each) { return each.has_value(); });
}

}  // namespace

FrameServer::FrameServer(const vulkan::Device& device, const std::vector<const SimulationModel*>& members,
                         const FrameOptions& options, const std::vector<RunListener>& listeners)
    : graphs_(device, members, options), failures_(members.size()), waiting_(members.size()), slots_(device) {
    for (std::size_t k = 0; k < members.size(); ++k)
        runs_.push_back(std::make_unique<MemberRun>(*members[k], listeners.empty() ? RunListener{} : listeners[k]));
}

FrameServer::FrameServer(const vulkan::Device& device, const SimulationModel& model, const FrameOptions& options,
                         const RunListener& listener)
    : FrameServer(device, std::vector{&model}, options, {listener}) {
    graphs_.allocate();
}

void FrameServer::ask(std::size_t member, const FrameRequest& request) {
    failures_[member] = nullptr;
    runs_[member]->ask(request);
}

std::unique_ptr<MemberRun> FrameServer::fresh_run(std::size_t number) const {
    return std::make_unique<MemberRun>(graphs_.member(number), runs_[number]->listener());
}

void FrameServer::put_run(std::size_t number, std::unique_ptr<MemberRun> run) {
    failures_[number] = nullptr;
    waiting_[number].reset();
    runs_[number] = std::move(run);
}

bool FrameServer::run(std::uint32_t last, const std::function<bool(std::uint32_t)>& wanted,
                      const std::function<void(const FinishedFrame&)>& finished, const std::function<bool()>& stop) {
    ask(0, {last, wanted, finished, stop});
    serve();
    return runs_.front()->complete();
}

template <class Act>
void FrameServer::guarded(std::size_t member, const Act& act) {
    if (is_single()) return act();
    if (failures_[member]) return;
    try {
        act();
    } catch (const vulkan::VulkanError&) {  // a failure of the device concerns every member
        throw;
    } catch (...) {
        failures_[member] = std::current_exception();
    }
}

void FrameServer::take_jobs() {
    for (std::size_t member = 0; member < runs_.size(); ++member)
        if (!waiting_[member] && !failures_[member])
            guarded(member, [&] { waiting_[member] = runs_[member]->next_job(); });
}

/// Returns the flight with the most members that wait for the same kind of job.
Flight FrameServer::largest_flight() {
    using Alike = std::tuple<FrameContents, std::optional<StateStep>, std::optional<StateStep>, bool, std::uint32_t>;
    std::map<Alike, std::vector<std::size_t>> groups;
    for (std::size_t member = 0; member < waiting_.size(); ++member) {
        if (!waiting_[member]) continue;
        const Work& work = waiting_[member]->work;
        groups[{contents_of(graphs_, *waiting_[member]), work.before, work.after, work.changes_substeps(),
                work.simulates ? work.substeps : 0}]
            .push_back(member);
    }
    const auto largest = std::ranges::max_element(groups, {}, [](const auto& group) { return group.second.size(); });
    Flight flight{.contents = std::get<FrameContents>(largest->first), .members = largest->second};
    for (const std::size_t member : flight.members) {
        flight.jobs.push_back(std::move(*waiting_[member]));
        waiting_[member].reset();
    }
    return flight;
}

void FrameServer::serve() {
    for (;;) {
        // With several members, all are asked for jobs before those that share a submit are chosen.
        if (!is_single() && flights_[0]) {
            deliver(0);
            continue;
        }
        take_jobs();
        if (is_any(waiting_)) {
            deliver(next_slot_);
            submit(next_slot_, largest_flight());
            if (is_single()) next_slot_ = (next_slot_ + 1) % vulkan::frame_slot_count;
        } else if (is_any(flights_)) {
            serve_one();
        } else {
            break;
        }
    }
    for (std::size_t member = 0; member < runs_.size(); ++member) guarded(member, [&] { runs_[member]->conclude(); });
}

/// Hands out the previous frame while the device simulates one, then waits for the latter.
void FrameServer::serve_one() {
    const std::uint32_t older = next_slot_, newer = (next_slot_ + 1) % vulkan::frame_slot_count;
    if (flights_[older]) return deliver(older);
    if (!flights_[newer]->settled && flights_[newer]->jobs.front().until != Job::Until::delivered)
        settle(newer);
    else
        deliver(newer);
}

void FrameServer::submit(std::uint32_t slot, Flight flight) {
    const Work& work = flight.work();
    std::vector<VkCommandBuffer> commands;
    const auto add = [&](StateStep step) { commands.push_back(graphs_.commands(step, work.set, slot)); };
    if (work.before) add(*work.before);
    if (work.changes_substeps()) add(StateStep::change_substep);
    if (!flight.contents.nothing()) commands.push_back(graphs_.commands(flight.contents, slot));
    if (work.after) add(*work.after);
    inputs_.write(graphs_, slot, flight);
    slots_.submit(slot, commands);
    flights_[slot] = std::move(flight);
    if (flights_[slot]->contents.simulates && graphs_.options().meanwhile) graphs_.options().meanwhile();
}

/// Returns whether lists of contact were too short and have been made longer. The work was begun again, or a pilot that
/// goes back to an earlier frame asks for it again.
bool FrameServer::lengthened_lists(std::uint32_t slot) {
    Flight& flight = *flights_[slot];
    ClothLayout& layout = graphs_.layout();
    if (!flight.contents.simulates || !graphs_.joint().self_contact) return false;
    const glsl::SelfRecord record = self_record(layout, graphs_.pool(), slot);
    if (self_list_use(layout, record) <= 1 || !grow_lists(layout.lists, record)) return false;
    deliver((slot + 1) % vulkan::frame_slot_count);
    Flight again = std::move(flight);
    flights_[slot].reset();
    slots_.submit(slot, graphs_.commands(StateStep::restore, again.contents.set, slot));
    slots_.wait(slot);
    graphs_.rebuild(download_state(layout, graphs_.pool()));
    if (again.work().attempt > 0)
        runs_.front()->attempt_anew(again.jobs.front());
    else
        submit(slot, std::move(again));
    return true;
}

void FrameServer::settle(std::uint32_t slot) {
    slots_.wait(slot);
    while (lengthened_lists(slot)) {
        if (!flights_[slot]) return;
        slots_.wait(slot);
    }
    Flight& flight = *flights_[slot];
    flight.settled = true;
    flight.results = flight_results(graphs_, slot, flight);
    flight.efforts.resize(flight.members.size());
    milliseconds_ = 0;
    for (const StageTime& timing : graphs_.timings(flight.contents, slot)) milliseconds_ += timing.milliseconds;
    for (std::size_t place = 0; place < flight.members.size(); ++place)
        guarded(flight.members[place], [&] {
            flight.efforts[place] = runs_[flight.members[place]]->settle(flight.jobs[place], flight.results[place]);
        });
}

void FrameServer::deliver(std::uint32_t slot) {
    if (!flights_[slot]) return;
    if (!flights_[slot]->settled) settle(slot);
    if (!flights_[slot]) return;  // the pilot asks for this work again
    const Flight flight = std::move(*flights_[slot]);
    flights_[slot].reset();
    hand_out(graphs_, slot, flight, [&](std::size_t place, const FinishedFrame& frame) {
        const std::size_t member = flight.members[place];
        guarded(member, [&] { runs_[member]->deliver(flight.jobs[place], frame); });
    });
    if (!flight.jobs.front().searches) return;
    // A cut always takes effect in the next frame, which therefore waits for the findings of this one.
    MemberRun& run = *runs_.front();
    if (take_cuts(graphs_, slot, flight.work().frame, run.listener().on_cut)) run.pilot().wake();
}

}  // namespace drape
