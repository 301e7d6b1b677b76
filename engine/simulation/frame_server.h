// Serves the frames of 1 to N members of one shape on one device, in a plain loop: it asks the members' runs for their
// next jobs (member_run.h), submits equal kinds of job together, waits, and hands the results back. Which members share
// a submit changes no bit of any of them. A scene is an ensemble of one member, of which two jobs are in flight at a
// time.
#pragma once

#include <array>
#include <exception>
#include <memory>
#include <optional>
#include <vector>

#include "simulation/flight.h"

namespace drape {

class FrameServer {
  public:
    /// Plans the graphs that are known to be needed. The models must outlive the server. `listeners` may be empty.
    FrameServer(const vulkan::Device& device, const std::vector<const SimulationModel*>& members,
                const FrameOptions& options, const std::vector<RunListener>& listeners = {});
    /// Plans and allocates for one member.
    FrameServer(const vulkan::Device& device, const SimulationModel& model, const FrameOptions& options,
                const RunListener& listener = {});

    /// Asks for frames of a member, from its next one on; the next `serve` simulates them.
    void ask(std::size_t member, const FrameRequest& request);
    /// Serves all requests to their ends. With several members, an exception from a request's functions ends that
    /// request alone; with a single member it is thrown.
    void serve();
    /// The exception that ended a member's request; null: none did.
    std::exception_ptr failure(std::size_t member) const { return failures_[member]; }
    /// Asks the only member for frames and serves them, as Simulation::run does.
    bool run(std::uint32_t last, const std::function<bool(std::uint32_t)>& wanted,
             const std::function<void(const FinishedFrame&)>& finished, const std::function<bool()>& stop = {});

    std::size_t size() const { return runs_.size(); }
    MemberRun& member(std::size_t number) { return *runs_[number]; }
    const MemberRun& member(std::size_t number) const { return *runs_[number]; }
    /// `fresh_run` returns a new run of a member from its start, with the same listener; `put_run` replaces the
    /// member's run.
    std::unique_ptr<MemberRun> fresh_run(std::size_t number) const;
    void put_run(std::size_t number, std::unique_ptr<MemberRun> run);
    FrameGraphs& graphs() { return graphs_; }
    const FrameGraphs& graphs() const { return graphs_; }
    /// Returns the milliseconds that the device spent on the last submit; 0 without timestamps.
    double device_milliseconds() const { return milliseconds_; }

  private:
    bool is_single() const { return runs_.size() == 1; }
    void take_jobs();
    Flight largest_flight();
    void submit(std::uint32_t slot, Flight flight);
    void settle(std::uint32_t slot);
    bool lengthened_lists(std::uint32_t slot);
    void deliver(std::uint32_t slot);
    void serve_one();
    /// Calls `act` for a member. Its failure does not end the other members.
    template <class Act>
    void guarded(std::size_t member, const Act& act);

    FrameGraphs graphs_;
    std::vector<std::unique_ptr<MemberRun>> runs_;
    std::vector<std::exception_ptr> failures_;
    std::vector<std::optional<Job>> waiting_;  ///< by member
    FlightInputs inputs_;
    double milliseconds_ = 0;
    std::uint32_t next_slot_ = 0;
    vulkan::FrameSlots slots_;  ///< its destructor waits for submits in flight
    std::array<std::optional<Flight>, vulkan::frame_slot_count> flights_;
};

}  // namespace drape
