// A submit that does alike jobs of some members: what the host writes for it, and what it leaves on the host.
#pragma once

#include <span>
#include <vector>

#include "simulation/frame_graphs.h"
#include "simulation/member_run.h"

namespace drape {

struct Flight {
    FrameContents contents;
    std::vector<std::size_t> members;
    std::vector<Job> jobs;             ///< by place in `members`
    std::vector<WorkResult> results;   ///< likewise, once it is settled
    std::vector<FrameEffort> efforts;  ///< likewise
    bool settled = false;
    const Work& work() const { return jobs.front().work; }  ///< the jobs are alike but for their frames
};

/// Returns what the graph of a job does.
FrameContents contents_of(const FrameGraphs& graphs, const Job& job);

class FlightInputs {
  public:
    /// Writes what the device reads of the host in a flight.
    void write(FrameGraphs& graphs, std::uint32_t slot, const Flight& flight);

  private:
    void write_frame(FrameGraphs& graphs, std::uint32_t slot, const Flight& flight);

    std::vector<FrameInputs> members_;
    FrameInputs joined_;
};

/// Returns by place what a flight that is done has told.
std::vector<WorkResult> flight_results(FrameGraphs& graphs, std::uint32_t slot, const Flight& flight);

/// Calls `take(place, frame)` with the frame of each job, handed out or not; it is valid during the call.
void hand_out(FrameGraphs& graphs, std::uint32_t slot, const Flight& flight,
              const std::function<void(std::size_t place, const FinishedFrame& frame)>& take);

}  // namespace drape
