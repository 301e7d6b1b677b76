// Runs the frames of a scene on the device: graphs for each kind of frame, two frames in flight, results handed out in
// order. With method `auto` the loop is closed: every frame is judged, and done again where it fails. The host never
// reads positions to simulate; it reads them only where an export asks for them.
#pragma once

#include <array>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "cloth/frame_steps.h"
#include "control/drive.h"
#include "control/frame_judgement.h"
#include "control/motion_error.h"
#include "control/sensitivity.h"
#include "control/sleep.h"
#include "control/substep_control.h"
#include "control/watch.h"
#include "drape/simulation.h"
#include "graph/executor.h"
#include "picture/cloth_raster.h"
#include "picture/frame_copy.h"
#include "simulation/loop_lane.h"

namespace drape {

/// A cut found at the end of a frame; it acts from the next frame on.
struct CutEvent {
    std::uint32_t frame;
    std::size_t cloth;
    CutCounts counts;
};

/// A frame that another simulates: what the proof about contact is with it.
struct FrameElsewhere {
    FinishedFrame finished;
    std::optional<SelfContactReport> self_contact;
};

struct FrameLoopOptions : PictureOptions {
    bool draw = true;           ///< colour images are wanted
    bool draws_beside = false;  ///< they are, but another device makes them (pictures.h)
    bool velocities = false;    ///< arrays of velocities are wanted; needs statistics
    bool normals = false;       ///< arrays of normals are wanted
    bool statistics = false;    ///< statistics of every frame handed out are wanted
    Kernels kernels = Kernels::automatic();
    bool keep_promises = true;  ///< a closed loop throws ToleranceMissed where it gives up
    /// Each cut is told here, with the cloth's topology after it.
    std::function<void(const CutEvent&, const CutTopology&)> on_cut;
    std::function<void(const FrameAttempt&)> on_attempt;  ///< told of before each
    /// Each frame that is not wanted is told here, in order with those that are: its statistics and effort, nothing
    /// else.
    std::function<void(const FinishedFrame&)> on_passed_over;
    /// Frames come from here, in order from 0 on, and nothing is simulated.
    std::function<FrameElsewhere()> next_elsewhere;
    /// The loop's device; null: it has one of its own. A loop in a lane draws nothing, and its cloths meet nothing of
    /// cloth and stay whole.
    LoopLane* lane = nullptr;
    bool plans = true;                    ///< false: nobody asks for the plans of a loop in a lane
    std::function<void()> meanwhile;      ///< called whenever the device has got a frame to simulate
    graph::BarrierFilter barrier_filter;  ///< canary tests only
};

/// One of these is submitted at once. Frame 0 is the initial state; frames that nobody asked for are only simulated;
/// those in which a cutter is active are searched for cuts. A closed loop simulates until a frame is good and hands it
/// out after.
enum class FrameKind {
    initial,
    simulate,
    simulate_and_output,
    output,
    initial_cut,
    simulate_cut,
    simulate_and_output_cut,
    output_cut,
    search_cut
};
struct FrameContents {
    bool simulates, hands_out, searches_cuts;
};
inline constexpr std::array<FrameContents, 9> frame_contents{{{false, true, false},
                                                              {true, false, false},
                                                              {true, true, false},
                                                              {false, true, false},
                                                              {false, true, true},
                                                              {true, false, true},
                                                              {true, true, true},
                                                              {false, true, true},
                                                              {false, false, true}}};
constexpr const FrameContents& contents(FrameKind kind) { return frame_contents[static_cast<std::size_t>(kind)]; }

class FrameLoop {
  public:
    /// Builds and plans the graphs of every kind of frame, allocates what they use (VulkanError when over budget,
    /// before anything is allocated), records them, and uploads the initial state. `device` and `model` must outlive
    /// the loop.
    FrameLoop(const vulkan::Device& device, const SimulationModel& model, const FrameLoopOptions& options);
    FrameLoop(const vulkan::Device& device, SimulationModel&& model, const FrameLoopOptions& options) = delete;

    /// Runs frames next_frame() .. last; `wanted(frame)` says which are handed to `finished`, in order. `stop()` is
    /// asked before each submit; true ends the loop after what is in flight, and what a closed loop has of a segment
    /// that is not kept goes. Returns whether it ran to the end.
    bool run(std::uint32_t last, const std::function<bool(std::uint32_t)>& wanted,
             const std::function<void(const FinishedFrame&)>& finished, const std::function<bool()>& stop = {});

    std::uint32_t next_frame() const { return next_frame_; }
    /// Returns whether every frame that was simulated was handed out, or will have been once `stop` has ended the loop.
    bool can_save() const {
        if (!pool_ && !options_.lane) return false;
        // Frame 0 is there before any is simulated.
        return in_segment_ || (withheld_.empty() && (!control_ || std::max(next_frame_, 1u) >= simulated_));
    }
    /// Returns what next_frame() starts from; call it only while can_save().
    SimulationState save() const;
    /// Takes over what another loop of the same model saved. Throws Error when it is not that.
    void restore(const SimulationState& state);
    const std::vector<CutTopology>& topologies() const { return solver_.topologies(); }
    /// Returns three particles per triangle that no cut has split so far.
    std::vector<std::uint32_t> whole_triangles(std::size_t cloth) const;

    /// Returns the report on the frames simulated so far; nothing: no cloth meets itself or another.
    const std::optional<SelfContactReport>& self_contact() const { return self_contact_; }

    const graph::Graph& graph(FrameKind kind) const { return frames_[static_cast<std::size_t>(kind)].graph; }
    const graph::Plan& plan(FrameKind kind) const { return frames_[static_cast<std::size_t>(kind)].plan; }
    const graph::ResourcePool& pool() const { return *pool_; }
    /// In use.
    const Kernels& kernels() const { return solver_.kernels(); }

  private:
    struct Frame {
        graph::Graph graph;
        graph::Plan plan;
        std::unique_ptr<graph::RecordedPlan> recorded;
    };
    /// The results of a closed loop's frame are known before it is drawn.
    struct Judged {
        std::vector<ClothStatistics> statistics;
        FrameEffort effort;
        std::vector<StageTime> timings;
        glsl::SelfRecord self_record = {};
    };
    struct InFlight {
        std::uint32_t frame = 0;
        FrameKind kind = FrameKind::initial;
        bool output = false;
        std::uint32_t substeps = 0;  ///< substeps of the state's history
        std::optional<Judged> judged;
    };
    /// A closed loop's frame at one number of substeps.
    struct Rung {
        std::unique_ptr<SimulationModel> model;
        Frame frame;  ///< nothing in a lane
    };
    /// A slot's submits go through these, on the loop's own device or in its lane (loop_device.cpp).
    void submit_parts(std::uint32_t slot, const LaneWork& work);
    void wait(std::uint32_t slot);
    std::vector<ClothStatistics> statistics_in(std::uint32_t slot, std::uint32_t frame,
                                               const SimulationModel& run) const;
    std::vector<double> differences_in(std::uint32_t slot) const;
    glsl::SelfRecord self_record_in(std::uint32_t slot) const;
    std::vector<std::span<const float>> array_in(std::uint32_t slot, std::string_view what) const;
    SimulationState device_state() const;
    using Finished = std::function<void(const FinishedFrame&)>;

    /// Returns the kinds that this scene and these options ever need.
    std::vector<FrameKind> kinds() const;
    FrameNeeds needs(FrameKind kind) const;
    bool cutters_active_in(std::uint32_t frame) const;
    /// Returns whether the frame ends with a search for what the cutters cut, or for what tears.
    bool searched(std::uint32_t frame) const;
    void build_graphs();
    void allocate_and_record();
    void record();
    void take_cuts(std::uint32_t slot, std::uint32_t frame);
    /// Takes what a search found of a cloth into its topology.
    CutCounts take_findings(std::size_t cloth, const CutFindings& cut, const std::vector<glsl::vec4>& loads);
    /// Fills what the device reads and nothing of it writes.
    void upload();
    void rebuild_resources(const SimulationState& state);
    // These are in loop_state.cpp.
    template <class Archive>
    void transfer(Archive& archive);
    std::vector<std::byte> host_state() const;
    /// Whether it was one.
    bool take_host_state(std::span<const std::byte> bytes);
    void restore_cuts(const SimulationState& state);
    /// Returns whether a loop of this scene can come to the state that was read: the next frame divides by it.
    bool can_be() const;
    Frame build(FrameKind kind, const SimulationModel& run);
    std::unique_ptr<graph::RecordedPlan> recording(const Frame& frame) const;
    static FrameKind kind_of(std::uint32_t frame, bool wanted, bool cutting);
    void submit(std::uint32_t slot, std::uint32_t frame, FrameKind kind, bool output);
    void submit_in_lane(std::uint32_t slot, std::uint32_t frame, FrameKind kind, bool output);
    /// Adds a frame's records to the reports. Throws VulkanError where a list of pairs had no room.
    void note_self_contact(std::uint32_t frame, const glsl::SelfRecord& record);
    /// Does a named method's frame again with longer lists of contact where they were too short.
    void fit_lists(std::uint32_t slot, const Finished& finished);
    /// Goes back to what the frame or segment started from. Nothing may be in flight.
    void restore_kept();
    /// Does the same with new resources.
    void begin_anew();
    void deliver(std::uint32_t slot, const Finished& finished);
    std::vector<std::span<const float>> velocities(std::uint32_t slot, std::uint32_t substeps);
    void deliver_all(const Finished& finished);
    /// Tells of the frames before `end` that were simulated and not wanted.
    void tell_passed_over(std::uint32_t end);
    bool run_elsewhere(std::uint32_t last, const std::function<bool(std::uint32_t)>& wanted, const Finished& finished,
                       const std::function<bool()>& stop);
    /// Returns the slot that is next, free.
    std::uint32_t take_slot(const Finished& finished);
    void take_cuts_of(std::uint32_t slot, std::uint32_t frame, const Finished& finished);

    // These are in closed_loop.cpp.
    bool has_set(StateSet set) const { return drape::has_set(model_, set); }
    void build_attempts();
    Frame& attempt(AttemptStep step, StateSet set = StateSet::run) {
        return attempts_[static_cast<std::size_t>(set)][static_cast<std::size_t>(step)];
    }
    VkCommandBuffer commands(AttemptStep step, std::uint32_t slot, StateSet set = StateSet::run) {
        return attempt(step, set).recorded->commands(slot);
    }
    /// Calls `visit` with the frame of each of them.
    void for_each_attempt(const std::function<void(Frame&)>& visit);
    Rung& rung(std::uint32_t substeps, StateSet set = StateSet::run);
    VkCommandBuffer commands_of(const LanePart& part, std::uint32_t slot);
    struct Asked {
        std::uint32_t last;
        const std::function<bool(std::uint32_t)>& wanted;
        const Finished& finished;
        const std::function<bool()>& stop;
    };
    /// To simulate a segment.
    struct Attempt {
        std::uint32_t frame;   ///< the first
        std::uint32_t number;  ///< from 1
        bool keeps;            ///< what it starts from
    };
    struct Stopped {};  ///< thrown within a segment
    struct Run {
        std::uint32_t frame, substeps;
        std::optional<AttemptStep> before, after;  ///< done before and after the frame
        bool begins;                               ///< it begins a run of the segment: its step may change
    };
    /// Simulates the frames from `frame` on that are judged together until the control keeps them, or throws
    /// ToleranceMissed. Those of a probe are withheld until they are kept, then released.
    void simulate_segment(std::uint32_t frame, const Asked& asked);
    /// Whether it was simulated; else it was stopped, and everything is as before it.
    bool simulate_unless_stopped(std::uint32_t frame, const Asked& asked);
    void sleep_through(std::uint32_t frame, const Asked& asked);
    /// Returns whether the segment's lists of contact were too short and now are longer, at its start.
    bool lengthen_lists();
    void drop_withheld();
    void run_coarse(const Attempt& attempt, Judgement& judgement, const Asked& asked);
    Judged run_fine(const Attempt& attempt, Judgement& judgement, const Asked& asked);
    double motion_of(std::uint32_t slot);
    void submit_run(std::uint32_t slot, const Run& run, const Attempt& attempt, const Asked& asked);
    Judged take_judged(std::uint32_t slot, std::uint32_t frame, std::uint32_t substeps);
    void submit_output(std::uint32_t frame, Judged judged, bool wanted, const Finished& finished);
    void keep_segment(std::uint32_t frame, Judged single, const Asked& asked);
    // These are in companion_run.cpp.
    Frame build_beside(const SimulationModel& run, StateSet set);
    /// Simulates the kept segment's frames in the companion, and in the disturbed run where there is one, and compares.
    void follow_segment(std::uint32_t frame, bool predictable, const Finished& finished);
    /// Simulates frames in a set.
    void follow(StateSet set, std::uint32_t frame, std::uint32_t count, std::uint32_t substeps,
                const Finished& finished);
    /// Returns what a step that compares finds, by cloth, m.
    std::vector<double> compared(AttemptStep step, const Finished& finished);
    void submit_beside(StateSet set, std::uint32_t slot, std::uint32_t frame, std::uint32_t substeps);
    /// Whether the set's frame in the slot had lists of contact that were too short, and has longer ones now.
    bool lengthen_lists_of(StateSet set, std::uint32_t slot, const Finished& finished);
    void give_up(std::uint32_t frame, const Judgement& judgement, const Asked& asked);
    void release_withheld(std::uint32_t frame, bool wanted, const Finished& finished);
    void pass_over(std::uint32_t frame, const std::vector<ClothStatistics>& statistics, const FrameEffort& effort);

    const vulkan::Device& device_;
    const SimulationModel& model_;
    FrameLoopOptions options_;
    ClothSolver solver_;
    ClothRaster raster_;
    std::array<Frame, frame_contents.size()> frames_;
    std::array<std::array<Frame, attempt_step_count>, state_set_count> attempts_;  ///< by set
    std::array<std::map<std::uint32_t, Rung>, state_set_count> rungs_;             ///< by set and substeps
    std::optional<SubstepControl> control_;
    Watch watch_;
    Sleep sleep_;
    Drive drive_;
    std::vector<std::vector<ClothStatistics>> attempt_statistics_;
    std::vector<ClothStatistics> before_;  ///< statistics of what the segment starts from
    std::vector<glsl::SelfRecord>
        attempt_self_records_;    ///< per frame of the last attempt, in order, like the statistics
    glsl::SelfRecord fullest_{};  ///< most entries of every list in the last attempt
    std::optional<SelfContactReport> self_contact_;
    std::uint32_t state_substeps_;  ///< substeps of the state's history
    bool in_segment_ = false;       ///< `stop` is asked within one
    bool kept_ = false;             ///< the device has what the segment started from
    std::uint32_t simulated_ = 1;   ///< the frame after those that a closed loop has simulated
    double motion_error_ = 0;       ///< the last probe's
    MotionError position_error_;
    Sensitivity sensitivity_;
    std::vector<std::uint32_t> beside_substeps_;  ///< by set, of the histories beside the run's
    std::deque<FrameCopy> withheld_;              ///< frames that are simulated and not handed out yet
    std::deque<FinishedFrame> passed_over_;       ///< a closed loop's frames that are not wanted and not told of yet
    Finished withhold_ = [this](const FinishedFrame& frame) { withheld_.emplace_back().keep(frame); };
    std::unique_ptr<graph::ResourcePool> pool_;
    vulkan::FrameSlots slots_;  ///< goes first, as it waits for what is in flight
    std::array<std::optional<InFlight>, vulkan::frame_slot_count> in_flight_;
    std::uint32_t next_frame_ = 0, next_slot_ = 0;
    std::vector<std::vector<float>> velocities_;  ///< the frame's that is handed out
};

}  // namespace drape
