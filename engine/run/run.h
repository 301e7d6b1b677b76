// Runs a scene into a folder of pictures, arrays and meshes, or shows the graph that would run.
#pragma once

#include <array>
#include <cstdint>
#include <exception>
#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "drape/error.h"
#include "drape/kernels.h"
#include "drape/scene_reader.h"
#include "drape/simulation.h"
#include "drape/view.h"
#include "output/output_folder.h"
#include "run/exit_code.h"

namespace drape {

/// Thrown when the command line asks for something that cannot be: exit code 2.
class UsageError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A scene is asked to become this. Unset values are the scene's own.
struct SceneRequest {
    std::string path;
    std::vector<std::string> overrides;  ///< "/json/pointer=value"
    std::optional<std::array<std::uint32_t, 2>> image_size;
    std::optional<std::uint32_t> samples;
    PictureView view;
    std::string device;     ///< a selector of Device; may be empty
    bool validate = false;  ///< core and synchronization validation
    bool skip = true;       ///< false: keep the work of the exact skips (proof that they change nothing)
    Kernels kernels = Kernels::automatic();
};

struct RunRequest {
    SceneRequest scene;
    std::string output;  ///< folder
    /// The one format, which must be able to be a stream, gives its bytes to this instead of a folder. No manifest.
    std::function<void(std::span<const std::byte>)> stream;
    ExistingFiles existing = ExistingFiles::refuse;
    std::vector<std::string> formats{"png"};  ///< names in output/frame_writer.h's table
    bool deflates = false;                    ///< archives are packed; some format must be one
    std::optional<std::uint32_t> start, end;
    std::uint32_t step = 1;
    /// Seconds between checkpoints; a run that is stopped writes one too. Nothing: it writes none at all.
    std::optional<double> checkpoint_interval = 60;
    bool keep_failed = false;  ///< go on after a frame that is no result; one that is not finite ends the run anyway
    bool quiet = false;        ///< no progress
    bool verbose = false;      ///< notes on device, plan and memory through `message`
    std::vector<std::string> command_line;
    std::function<void(const std::string&)> message;  ///< warnings and notes, one line each, as they arise
    std::function<bool()> stop;    ///< asked before each attempt at a frame; true: finish what is in flight and end
    std::function<void()> saving;  ///< told before a checkpoint is written

    bool draws() const;    ///< some format needs pictures
    bool details() const;  ///< some format needs velocities and contacts
};

struct RunSummary {
    std::uint64_t frame_count = 0;            ///< frames written by this run
    std::uint64_t kept_count = 0;             ///< frames of an earlier run, kept by ExistingFiles::resume
    std::uint64_t validation_count = 0;       ///< messages
    bool complete = true;                     ///< false: stopped before the last frame; no manifest was written
    std::optional<std::uint32_t> checkpoint;  ///< next frame, where a stopped run can go on
    std::vector<std::string> dropped;         ///< formats that a stopped run leaves nothing of
    std::vector<std::string> warnings;
};

/// Reads, simulates, draws and writes, the manifest last. Throws SceneFailure, UsageError, OutputError, Diverged,
/// ToleranceMissed (where failed frames are kept, after the last), DeviceError; nothing is written before everything
/// that can be checked up front has been.
/// ExistingFiles::resume goes on with an earlier run of the same scene, size, samples, view, program, device and
/// driver: from its newest checkpoint (engine/docs/checkpoint.md), or, where there is none that serves, from frame 0,
/// keeping the pictures. The folder then holds the bytes of an undisturbed run, but for the manifest's "run". Pictures
/// and checkpoints of any other run are an OutputError. Files of several frames appear only when complete, or, with the
/// frames before it, when the simulation diverged or missed its tolerance. Whether it did is seen at the frames that
/// are written.
RunSummary run_scene(const RunRequest& request);

/// How one of several runs ended.
struct RunEnd {
    std::size_t number = 0;           ///< of its request
    bool complete = false;            ///< false: it was stopped, or it failed
    std::exception_ptr failure = {};  ///< what run_scene would have thrown
};
/// Makes the runs of scenes of one shape, for which method `auto` chooses the same, together on the first one's device:
/// they share dispatches. No format draws, and there are no checkpoints. Each gets the bytes that run_scene makes of
/// it. Tells of each run that ended. Throws DeviceError where the device fails, or cannot take them together; the runs
/// that were not told of then have not ended.
void run_scenes_together(std::span<const RunRequest> requests, const std::function<void(const RunEnd&)>& ended);

/// Returns the scene as it is asked for. Throws SceneFailure.
SceneDescription asked_scene(const SceneRequest& request);

/// Returns the plan of one frame as text, json or dot. `draw` adds the picture's passes; else it is as `simulate` runs.
std::string describe_graph(const SceneRequest& request, bool draw, const std::string& format);

const char* program_version();

struct LoadedScene {
    SceneDescription description;
    std::string text;  ///< text of the file
    std::string hash;  ///< hash of the text, the overrides and what they take from files: they decide the result
    std::vector<std::string> warnings;
};

/// Throws SceneFailure.
LoadedScene load(const SceneRequest& request);
/// Loads a text that was read before.
LoadedScene load_text(const SceneRequest& request, std::string text);

/// Two runs with the same key give the same bytes for the same frame.
std::string key_of(const RunRequest& request, const LoadedScene& scene, const DeviceInfo& device);

SimulationOptions simulation_options(const SceneRequest& request, bool draw, bool positions, bool velocities);
/// Opens the device to run the scene with.
Device device_of(const SceneRequest& request, const SceneDescription& scene, bool draws);

}  // namespace drape
