// Serves the frames of 1 to N members of one shape from one device, in a plain loop: it asks their runs for the next
// jobs (member_run.h), submits those that are alike together, waits, and hands the results back. Which members go
// together changes no bit of any. A scene is an ensemble of one, of which two jobs are in flight at a time.
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
    /// Plans what is known to be needed. The models must outlive it. `listeners` may be empty: nobody listens.
    FrameServer(const vulkan::Device& device, const std::vector<const SimulationModel*>& members,
                const FrameOptions& options, const std::vector<RunListener>& listeners = {});
    /// Plans and allocates for one member.
    FrameServer(const vulkan::Device& device, const SimulationModel& model, const FrameOptions& options,
                const RunListener& listener = {});

    /// Wants frames of a member, from its next one on, in the next `serve`.
    void ask(std::size_t member, const FrameRequest& request);
    /// Serves all requests to their ends. What a request's functions throw ends that one alone, where there are several
    /// members; of a single one it is thrown.
    void serve();
    /// What ended a member's request; null: nothing did.
    std::exception_ptr failure(std::size_t member) const { return failures_[member]; }
    /// Asks the only member for frames and serves them; as Simulation::run.
    bool run(std::uint32_t last, const std::function<bool(std::uint32_t)>& wanted,
             const std::function<void(const FinishedFrame&)>& finished, const std::function<bool()>& stop = {});

    std::size_t size() const { return runs_.size(); }
    MemberRun& member(std::size_t number) { return *runs_[number]; }
    const MemberRun& member(std::size_t number) const { return *runs_[number]; }
    /// Returns a run of a member from its start, with the listener that it has; and puts one in the place of its run.
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
    /// Calls `act` for a member, whose own failure does not end others.
    template <class Act>
    void guarded(std::size_t member, const Act& act);

    FrameGraphs graphs_;
    std::vector<std::unique_ptr<MemberRun>> runs_;
    std::vector<std::exception_ptr> failures_;
    std::vector<std::optional<Job>> waiting_;  ///< by member
    FlightInputs inputs_;
    double milliseconds_ = 0;
    std::uint32_t next_slot_ = 0;
    vulkan::FrameSlots slots_;  ///< waits, when it goes, for what is in flight
    std::array<std::optional<Flight>, vulkan::frame_slot_count> flights_;
};

}  // namespace drape
