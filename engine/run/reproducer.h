// A failed run writes a reproducer, so that anybody can see it fail again: its scene, settings and device, its last
// checkpoint and its messages (engine/docs/checkpoint.md).
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>

#include "output/manifest.h"
#include "run/checkpoints.h"
#include "run/run.h"

namespace drape {

struct Reproducer {
    SceneRequest scene;  ///< its path serves as a name only
    std::string scene_text;
    bool keep_failed = false;
    std::uint32_t start = 0, end = 0, step = 1;  ///< frames that were handed out
    std::string program_version, run_key;
    Manifest::Device device;
    std::string status, reason;          ///< from the manifest
    std::optional<FrameFailure> failed;  ///< the frame that was no result
    /// The last frame that was handed out before the failure, with its numbers.
    std::optional<Manifest::FrameStatistics> last_frame;
    std::optional<RunCheckpoint> checkpoint;
};

/// Writes the reproducer into the folder, as reproducer_file_name. Throws OutputError.
void write_reproducer(OutputFolder& folder, const Reproducer& reproducer);
/// Throws OutputError, which names the file, when it is no reproducer.
Reproducer read_reproducer(const std::string& path);
/// Decodes a file's bytes. Throws OutputError with the problem, without the file's name.
Reproducer decode_reproducer(std::span<const std::byte> file);

struct ReplayRequest {
    std::string path;
    std::string device;  ///< selects the device; empty: the reproducer's if it exists, else the default
    bool validate = false;
    std::function<void(const std::string&)> message;
    std::function<bool()> stop;
};

struct Replay {
    bool reached = false;      ///< the same failure, to the bit; otherwise `text` says what differed
    bool stopped = false;      ///< `stop` ended the replay
    std::string text;          ///< a message about the outcome
    std::exception_ptr error;  ///< the exception of the failure, if one was thrown
};

/// Simulates from the reproducer's checkpoint to its failure. Throws OutputError, SceneFailure, DeviceError.
Replay replay_reproducer(const ReplayRequest& request);

}  // namespace drape
