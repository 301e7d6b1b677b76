// A run of a scene into a folder or a stream: what is reported before frames are simulated, what is done with the
// frames, and which files remain.
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
    /// Reads the scene, checks everything that can be checked in advance, and opens the folder. `device`: one that
    /// another run shares with this one; nothing: this run opens its own. Throws like run_scene. `request` must outlive
    /// this object.
    FolderRun(const RunRequest& request, const std::optional<Device>& device = {});
    FolderRun(const FolderRun&) = delete;
    FolderRun& operator=(const FolderRun&) = delete;

    const SceneDescription& scene() const { return planned_.scene.description; }
    const Device& device() const { return *device_; }
    /// Returns the options of the simulation that this run needs; their callbacks report to this run.
    SimulationOptions options();
    /// Makes this run's simulation. Throws SceneFailure with places in the scene's file.
    Simulation simulation();
    /// Receives the simulation, which must live until `finish`.
    void begin(Simulation& simulation);
    /// Simulates the missing frames, with checkpoints.
    void simulate();
    /// Returns the request of a run that proceeds together with others; `take_end` is then told how it ended.
    FrameRequest frames();
    void take_end(const RequestEnd& end);
    /// Completes the files of the frames, and takes from the simulation what the manifest says.
    void finish();
    /// Writes the manifest. Throws the exception by which the run failed.
    RunSummary end();

  private:
    struct Planned {
        LoadedScene scene;
        FrameRange range;
        std::string key;
        MissingFrames missing;
        std::size_t count = 0;  ///< number of frames that this run is to write
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
    std::optional<RunCheckpoint> from_;       ///< the checkpoint from which the run goes on
    Manifest manifest_;
    std::optional<RunFailure> failure_;
    Simulation* simulation_ = nullptr;
    std::optional<Sink> sink_;
    std::optional<Progress> progress_;
};

}  // namespace drape
