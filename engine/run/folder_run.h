// A run of a scene into a folder, or into a stream: what is said before the frames are simulated, what is done with
// them, and what is left behind.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "output/progress.h"
#include "run/checkpoints.h"
#include "run/frame_sink.h"
#include "run/missing_frames.h"
#include "run/run_failure.h"

namespace drape {

class FolderRun {
  public:
    /// Reads the scene, checks all that can be checked up front, and opens the folder. `device`: another run's, which
    /// this one shares; nothing: it opens its own. Throws like run_scene. `request` must outlive it.
    FolderRun(const RunRequest& request, const std::optional<Device>& device = {});
    FolderRun(const FolderRun&) = delete;
    FolderRun& operator=(const FolderRun&) = delete;

    const SceneDescription& scene() const { return planned_.scene.description; }
    const Device& device() const { return *device_; }
    /// Returns the options of the simulation that it needs, whose callbacks tell this run.
    SimulationOptions options();
    /// Is given the simulation, which must live until `finish`.
    void begin(Simulation& simulation);
    /// Simulates what is missing, with checkpoints.
    void simulate();
    /// Returns what a run that goes on together with others asks for; `take_end` is then told how that ended.
    FrameRequest frames();
    void take_end(const RequestEnd& end);
    /// Leaves the files of the frames, and takes from the simulation what the manifest says.
    void finish();
    /// Writes the manifest. Throws what the run failed by.
    RunSummary end();

  private:
    struct Planned {
        LoadedScene scene;
        FrameRange range;
        std::string key;
        MissingFrames missing;
        std::size_t count = 0;  ///< of frames that this run is to write
    };

    void say(const std::string& text) const;
    void warn(const std::string& text);
    bool keeps_checkpoints() const { return checkpoints_ && checkpoints_->enabled(); }
    void go_on();
    void begin_frames();
    void take(const FinishedFrame& frame);
    std::uint32_t last_frame() const;
    std::string consequence() const;
    bool run_with_checkpoints(const FrameRequest& request);
    void write_checkpoint();
    void finish_files();
    void leave_reproducer();
    void end_with_manifest();

    const RunRequest& request_;
    RunSummary summary_;
    Planned planned_;
    std::optional<OutputFolder> folder_;
    std::optional<Device> device_;
    std::optional<Checkpoints> checkpoints_;  ///< nothing for a stream
    std::optional<RunCheckpoint> from_;       ///< it goes on from this
    Manifest manifest_;
    std::optional<RunFailure> failure_;
    Simulation* simulation_ = nullptr;
    std::optional<Sink> sink_;
    std::optional<Progress> progress_;
};

}  // namespace drape
