// Checkpoints of a run in its folder: what it takes to go on after it was killed (engine/docs/checkpoint.md).
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
    std::uint32_t next_frame = 0;         ///< all before it are written
    std::uint64_t journal_length = 0;     ///< bytes that tell of them
    std::uint64_t validation_count = 0;   ///< messages so far
    std::optional<FrameFailure> failure;  ///< of the first frame that failed and was kept
    SimulationState state;
};

class Checkpoints {
  public:
    /// `interval`: seconds; nothing: none is written. The folder must outlive this.
    Checkpoints(OutputFolder& folder, std::string run_key, std::optional<double> interval);

    /// The newest one of this run whose frames before it are all there, as `usable` says of it. What is said of others,
    /// and where none can be used, goes to `say`. Throws OutputError naming the file when one is another run's, or
    /// when there are some and all are damaged.
    std::optional<RunCheckpoint> newest(const std::function<bool(const RunCheckpoint&)>& usable,
                                        const std::function<void(const std::string&)>& say) const;

    Journal& journal() { return journal_; }
    bool enabled() const { return interval_.has_value(); }
    /// Whether it is time for one.
    bool due() const;
    /// Writes one whole, then drops all but it and the one before. Throws OutputError.
    void write(RunCheckpoint checkpoint);
    /// The newest that can be read.
    std::optional<RunCheckpoint> last() const;
    /// Those of later frames than `next_frame` go: this run begins there.
    void keep_until(std::uint32_t next_frame);
    /// Nothing is left of them: the run is done.
    void remove_all();

  private:
    OutputFolder& folder_;
    std::string run_key_;
    std::optional<double> interval_;
    Journal journal_;
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// As parts of a file: the run's key, the rest, and the simulation's parts behind "state/".
Sections sections_of(const RunCheckpoint& checkpoint, const std::string& run_key);
/// Throws Error when they are none. `run_key` gets that of their run.
RunCheckpoint checkpoint_of(const Sections& sections, std::string& run_key);

}  // namespace drape
