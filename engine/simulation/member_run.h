// A member's run: asks its pilot (control/pilot.h) what to do for the frames that were requested, and hands them out in
// order. It knows no device: the frame server does its jobs.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "control/pilot.h"
#include "drape/simulation.h"
#include "picture/frame_copy.h"
#include "simulation/found_cuts.h"

namespace drape {

/// The callbacks of somebody who listens to a member's run.
struct RunListener {
    bool keep_promises = true;  ///< a closed loop that gives up throws ToleranceMissed
    CutListener on_cut = {};
    std::function<void(const FrameAttempt&)> on_attempt = {};  ///< called before each attempt
    /// Called before the pilot begins a frame, after all earlier ones were handed out, with what is told for it.
    std::function<void(std::uint32_t)> on_begin = {};
    /// Receives the statistics and effort, nothing else, of each frame that was not requested, in order with the
    /// others.
    std::function<void(const FinishedFrame&)> on_passed_over = {};
};

/// Work for the device.
struct Job {
    Work work;
    bool wanted = false;    ///< the frame is handed to whoever requested it
    bool searches = false;  ///< its frame ends with a search for cuts or tears
    /// The member asks for no other job until this one has come so far.
    enum class Until : std::uint8_t { submitted, settled, delivered } until = Until::submitted;
};

class MemberRun {
  public:
    /// `model` must outlive the run.
    MemberRun(const SimulationModel& model, const RunListener& listener);

    /// Begins a request, with the frames from `next_frame` on.
    void ask(const FrameRequest& request);
    /// Returns the next job; nothing: the run waits for another job, or has none.
    std::optional<Job> next_job();
    /// Begins the pilot's attempt that asked for this job again; the caller has restored the state at its start.
    void attempt_anew(const Job& job);
    /// Learns from the result of a job, before its frame is delivered. Throws VulkanError where a list of pairs
    /// overflowed.
    FrameEffort settle(const Job& job, const WorkResult& result);
    /// Hands out a job's frame.
    void deliver(const Job& job, const FinishedFrame& frame);
    /// Ends the request, once none of its jobs is in flight: reports the frames that were passed over.
    void conclude();
    /// Returns whether all requested frames are done, and the request was not stopped.
    bool complete() const { return complete_; }

    std::uint32_t next_frame() const { return next_frame_; }
    /// Returns whether every simulated frame was handed out, or will have been once `stop` has ended the run.
    bool can_save() const;
    /// The report on the frames simulated so far; nothing: no cloth can touch itself or another.
    const std::optional<SelfContactReport>& self_contact() const { return self_contact_; }
    const RunListener& listener() const { return listener_; }
    Pilot& pilot() { return *pilot_; }

    void write(ByteWriter& writer) const;
    /// Throws Error where a run of this model cannot have written what is read.
    void read(ByteReader& reader);
    /// Notes that frame 0 was handed out.
    void skip_start() { next_frame_ = 1; }

  private:
    struct Jobs {
        int unfinished = 0, undelivered = 0;  ///< those that it waits for, and whose frames were not delivered
    };
    struct Frames {
        std::deque<FrameCopy> withheld;         ///< those that are simulated and not handed out yet
        std::deque<FinishedFrame> passed_over;  ///< those of a closed loop that are not wanted and not told of yet
    };

    bool stopped() const { return request_.stop && request_.stop(); }
    std::optional<Job> first_job();
    std::optional<Job> job_of(Work work);
    bool cutters_active_in(std::uint32_t frame) const;
    bool searched(std::uint32_t frame) const;
    void end_frames();
    void note_contact(std::uint32_t frame, const glsl::SelfRecord& record, double list_use);
    void give(const FinishedFrame& frame);
    void release_withheld();
    void pass_over(std::uint32_t frame, const std::vector<ClothStatistics>& statistics, const FrameEffort& effort);
    void tell_passed_over(std::uint32_t end);

    const SimulationModel& model_;
    RunListener listener_;
    std::unique_ptr<Pilot> pilot_;
    std::optional<SelfContactReport> self_contact_;
    FrameRequest request_;
    std::uint32_t next_frame_ = 0;
    bool begun_ = false;    ///< the pilot is asked for the work of frames that it has begun
    bool complete_ = true;  ///< nothing is asked for, or all of it is done
    bool over_ = true;      ///< nothing more is to be asked for
    bool forgets_ = false;  ///< frames that are withheld and in flight were abandoned
    Jobs jobs_;
    Frames waiting_;
};

}  // namespace drape
