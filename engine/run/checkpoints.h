// A run keeps checkpoints in its folder, so that it can go on after it was killed (engine/docs/checkpoint.md).
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "drape/simulation.h"
#include "output/journal.h"
#include "output/output_folder.h"
#include "output/section_file.h"

namespace drape {

struct RunCheckpoint {
    std::uint32_t next_frame = 0;         ///< all frames before it are written
    std::uint64_t journal_length = 0;     ///< bytes of the journal that describe these frames
    std::uint64_t validation_count = 0;   ///< validation messages so far
    std::optional<FrameFailure> failure;  ///< the first frame that failed and was kept
    SimulationState state;
};

class Checkpoints {
  public:
    /// `interval` is in seconds; nothing: no checkpoint is written. The folder must outlive this object.
    Checkpoints(OutputFolder& folder, std::string run_key, std::optional<double> interval);

    /// Returns the newest checkpoint of this run for which `usable` says that all earlier frames are there. `say`
    /// receives remarks on the others, and whether none can be used. Throws OutputError, which names the file, when a
    /// checkpoint belongs to another run, or when all are damaged.
    std::optional<RunCheckpoint> newest(const std::function<bool(const RunCheckpoint&)>& usable,
                                        const std::function<void(const std::string&)>& say) const;

    Journal& journal() { return journal_; }
    bool enabled() const { return interval_.has_value(); }
    /// Returns whether it is time for a checkpoint.
    bool due() const;
    /// Writes a checkpoint completely, then removes all but it and the previous one. Throws OutputError.
    void write(RunCheckpoint checkpoint);
    /// Returns the newest checkpoint that can be read.
    std::optional<RunCheckpoint> last() const;
    /// Removes the checkpoints of frames after `next_frame`, with which this run begins.
    void keep_until(std::uint32_t next_frame);
    /// Removes all checkpoints and the journal, because the run is done.
    void remove_all();

  private:
    OutputFolder& folder_;
    std::string run_key_;
    std::optional<double> interval_;
    Journal journal_;
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Returns the parts of a checkpoint file: the run's key, the other members, and the simulation's parts, prefixed
/// "state/".
Sections sections_of(const RunCheckpoint& checkpoint, const std::string& run_key);
/// Throws Error when the parts are no checkpoint. `run_key` receives the key of the run that wrote them.
RunCheckpoint checkpoint_of(const Sections& sections, std::string& run_key);

}  // namespace drape
