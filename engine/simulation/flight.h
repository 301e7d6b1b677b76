// A flight is one submit, which does the same kind of job for some of the members: what the host writes for it, and
// what it reads back afterwards.
#pragma once

#include <span>
#include <vector>

#include "simulation/frame_graphs.h"
#include "simulation/member_run.h"

namespace drape {

struct Flight {
    FrameContents contents;
    std::vector<std::size_t> members;
    std::vector<Job> jobs;             ///< one for each entry of `members`
    std::vector<WorkResult> results;   ///< likewise, once the flight is settled
    std::vector<FrameEffort> efforts;  ///< likewise
    bool settled = false;
    const Work& work() const { return jobs.front().work; }  ///< the jobs differ in their frames alone
};

/// Returns the contents of the graph that does a job.
FrameContents contents_of(const FrameGraphs& graphs, const Job& job);

class FlightInputs {
  public:
    /// Writes the data of the host that the device reads in a flight.
    void write(FrameGraphs& graphs, std::uint32_t slot, const Flight& flight);

  private:
    void write_frame(FrameGraphs& graphs, std::uint32_t slot, const Flight& flight);

    std::vector<FrameInputs> members_;
    FrameInputs joined_;
};

/// Returns the results of a flight that the device has finished, one for each entry of `members`.
std::vector<WorkResult> flight_results(FrameGraphs& graphs, std::uint32_t slot, const Flight& flight);

/// Calls `take(place, frame)` with the frame of each job, whether the job hands it out or not; `frame` is valid during
/// the call.
void hand_out(FrameGraphs& graphs, std::uint32_t slot, const Flight& flight,
              const std::function<void(std::size_t place, const FinishedFrame& frame)>& take);

}  // namespace drape
