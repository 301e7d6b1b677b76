// A run keeps checkpoints in its folder to go on after it was killed (engine/docs/checkpoint.md).
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
    std::uint64_t journal_length = 0;     ///< journal bytes that tell of them
    std::uint64_t validation_count = 0;   ///< messages so far
    std::optional<FrameFailure> failure;  ///< the first frame that failed and was kept
    SimulationState state;
};

class Checkpoints {
  public:
    /// `interval` is in seconds; nothing: no checkpoint is written. The folder must outlive this.
    Checkpoints(OutputFolder& folder, std::string run_key, std::optional<double> interval);

    /// Returns the newest one of this run whose frames before it are all there, as `usable` says of it. `say` gets what
    /// is said of others, and where none can be used. Throws OutputError naming the file when one is another run's, or
    /// when there are some and all are damaged.
    std::optional<RunCheckpoint> newest(const std::function<bool(const RunCheckpoint&)>& usable,
                                        const std::function<void(const std::string&)>& say) const;

    Journal& journal() { return journal_; }
    bool enabled() const { return interval_.has_value(); }
    /// Returns whether it is time for one.
    bool due() const;
    /// Writes one whole, then drops all but it and the one before. Throws OutputError.
    void write(RunCheckpoint checkpoint);
    /// Returns the newest that can be read.
    std::optional<RunCheckpoint> last() const;
    /// Removes those of later frames than `next_frame`, where this run begins.
    void keep_until(std::uint32_t next_frame);
    /// Removes all of them and the journal, as the run is done.
    void remove_all();

  private:
    OutputFolder& folder_;
    std::string run_key_;
    std::optional<double> interval_;
    Journal journal_;
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Returns parts of a file: the run's key, the rest, and the simulation's parts behind "state/".
Sections sections_of(const RunCheckpoint& checkpoint, const std::string& run_key);
/// Throws Error when the parts are no checkpoint. `run_key` gets the key of their run.
RunCheckpoint checkpoint_of(const Sections& sections, std::string& run_key);

}  // namespace drape
