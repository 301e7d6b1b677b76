// Runs a scene into a folder of pictures, arrays and meshes, or shows the graph of its work.
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

/// Thrown when the command line asks for something impossible: exit code 2.
class UsageError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The scene that is requested, with changes. Unset values are those of the scene file.
struct SceneRequest {
    std::string path;
    std::vector<std::string> overrides;  ///< "/json/pointer=value"
    std::optional<std::array<std::uint32_t, 2>> image_size;
    std::optional<std::uint32_t> samples;
    std::optional<std::uint32_t> motion_blur;
    /// Pictures of half the width and height, of one sample, without motion blur, where nothing else is said.
    bool draft = false;
    PictureView view;
    std::string device;     ///< a selector of Device; may be empty
    bool validate = false;  ///< core and synchronization validation
    bool skip = true;       ///< false: do the work of the exact skips, to prove that they change nothing
    Kernels kernels = Kernels::automatic();
};

struct RunRequest {
    SceneRequest scene;
    std::string output;  ///< folder
    /// The only format, which must support streams, passes its bytes to this function instead of a folder. There is no
    /// manifest.
    std::function<void(std::span<const std::byte>)> stream;
    ExistingFiles existing = ExistingFiles::refuse;
    std::vector<std::string> formats{"png"};  ///< names in output/frame_writer.h's table
    bool deflates = false;                    ///< archives are compressed; some format must be an archive
    std::optional<std::uint32_t> start, end;
    std::uint32_t step = 1;
    /// Seconds between checkpoints; a run that is stopped writes one too. Nothing: no checkpoint is written at all.
    std::optional<double> checkpoint_interval = 60;
    bool keep_failed =
        false;             ///< go on after a frame that is no result; one that is not finite ends the run in any case
    bool quiet = false;    ///< do not show progress
    bool verbose = false;  ///< pass notes on device, plan and memory to `message`
    std::vector<std::string> command_line;
    std::function<void(const std::string&)> message;  ///< receives warnings and notes, one line each, as they arise
    std::function<bool()> stop;    ///< asked before each attempt at a frame; true: finish submitted work and end
    std::function<void()> saving;  ///< called before a checkpoint is written

    bool draws() const;    ///< some format needs pictures
    bool layers() const;   ///< some format needs layers of pictures
    bool details() const;  ///< some format needs velocities and contacts
};

struct RunSummary {
    std::uint64_t frame_count = 0;            ///< frames written by this run
    std::uint64_t kept_count = 0;             ///< frames of an earlier run, kept by ExistingFiles::resume
    std::uint64_t validation_count = 0;       ///< validation messages
    bool complete = true;                     ///< false: stopped before the last frame; no manifest was written
    std::optional<std::uint32_t> checkpoint;  ///< the next frame, if a stopped run can go on
    std::vector<std::string> dropped;         ///< formats of which a stopped run leaves no file
    std::vector<std::string> warnings;
};

/// Reads, simulates, draws and writes, the manifest last. Throws SceneFailure, UsageError, OutputError, Diverged,
/// ToleranceMissed (after the last frame, where failed frames are kept), DeviceError. It checks everything that can be
/// checked in advance before it writes anything.
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
    bool complete = false;            ///< false: the run was stopped, or failed
    std::exception_ptr failure = {};  ///< what run_scene would have thrown
};
/// Simulates several scenes of one shape, for which method `auto` makes the same choice, together on the first one's
/// device: they share dispatches. No format may draw, and there are no checkpoints. The files of each run equal, to the
/// byte, those of run_scene. Calls `ended` for each run that ended. Throws DeviceError where the device fails, or
/// cannot simulate them together; the runs that were not reported by then have not ended.
void run_scenes_together(std::span<const RunRequest> requests, const std::function<void(const RunEnd&)>& ended);

/// Returns the scene with the requested changes. Throws SceneFailure.
SceneDescription asked_scene(const SceneRequest& request);

/// Returns the plan of one frame as text, json or dot. `draw` adds the picture's passes; without it, the plan is that
/// of `simulate`.
std::string describe_graph(const SceneRequest& request, bool draw, const std::string& format);

const char* program_version();
/// Returns the hash of the commit that this was built from, with "-modified" where the sources had been changed, or
/// "unknown" where neither a history nor an archive's mark told.
const char* program_commit();

struct LoadedScene {
    SceneDescription description;
    std::string text;  ///< text of the file
    std::string hash;  ///< hash of the text, the overrides and the files that they name: these decide the result
    std::vector<std::string> warnings;
};

/// Throws SceneFailure.
LoadedScene load(const SceneRequest& request);
/// Loads a scene from a text that was read before.
LoadedScene load_text(const SceneRequest& request, std::string text);

/// Two runs with equal keys give the same bytes for the same frame.
std::string key_of(const RunRequest& request, const LoadedScene& scene, const DeviceInfo& device);

SimulationOptions simulation_options(const SceneRequest& request, bool draw, bool positions, bool velocities);
/// Opens the device on which the scene is simulated.
Device device_of(const SceneRequest& request, const SceneDescription& scene, bool draws);

}  // namespace drape
