// A member's run: asks its pilot (control/pilot.h) what to do for the frames that somebody wants, and hands them out in
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

/// Somebody listens to a member's run.
struct RunListener {
    bool keep_promises = true;  ///< ToleranceMissed is thrown where a closed loop gives up
    CutListener on_cut = {};
    std::function<void(const FrameAttempt&)> on_attempt = {};  ///< is told of before each
    /// Is told each frame that is not wanted, in order with those that are: its statistics and effort, nothing else.
    std::function<void(const FinishedFrame&)> on_passed_over = {};
};

/// Work for the device.
struct Job {
    Work work;
    bool wanted = false;    ///< its frame is handed to the one who asked
    bool searches = false;  ///< its frame ends with a search for cuts or tears
    /// The member asks for nothing more until then.
    enum class Until : std::uint8_t { submitted, settled, delivered } until = Until::submitted;
};

class MemberRun {
  public:
    /// `model` must outlive it.
    MemberRun(const SimulationModel& model, const RunListener& listener);

    /// Begins with the frames of a request, from `next_frame` on.
    void ask(const FrameRequest& request);
    /// Returns the next job; nothing: it waits for one, or there is none.
    std::optional<Job> next_job();
    /// Begins the pilot's attempt anew, which asked for this job: the state is at its start again.
    void attempt_anew(const Job& job);
    /// Learns what came of a job, before its frame is delivered. Throws VulkanError where a list of pairs had no room.
    FrameEffort settle(const Job& job, const WorkResult& result);
    /// Hands out a job's frame.
    void deliver(const Job& job, const FinishedFrame& frame);
    /// Ends the request, once nothing of it is in flight: tells of the frames that were passed over.
    void conclude();
    /// Returns whether the frames that were asked for are done, and the request was not stopped.
    bool complete() const { return complete_; }

    std::uint32_t next_frame() const { return next_frame_; }
    /// Returns whether every frame that was simulated was handed out, or will have been once `stop` has ended the run.
    bool can_save() const;
    /// The report on the frames simulated so far; nothing: no cloth meets itself or another.
    const std::optional<SelfContactReport>& self_contact() const { return self_contact_; }
    const RunListener& listener() const { return listener_; }
    Pilot& pilot() { return *pilot_; }

    void write(ByteWriter& writer) const;
    /// Throws Error where what is read is nothing that a run of this model can come to.
    void read(ByteReader& reader);
    /// Says that frame 0 was handed out.
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
