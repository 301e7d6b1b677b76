// Passes the finished frames of a run to the writers of its formats, and to its statistics and times.
#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drape/simulation.h"
#include "output/frame_writer.h"
#include "output/journal.h"
#include "output/manifest.h"
#include "run/run.h"
#include "run/run_statistics.h"

namespace drape {

/// Returns the formats with these names, each once. Throws UsageError.
std::vector<const OutputFormat*> output_formats(const std::vector<std::string>& names);

class Sink {
  public:
    /// `folder` is nothing for a stream; `kept` are the frames whose pictures exist already; `journal` receives
    /// everything too. All must outlive this object.
    Sink(std::optional<OutputFolder>& folder, const RunRequest& request, const SceneDescription& scene,
         const WrittenRun& run, const std::map<std::uint32_t, KeptFrame>& kept, Journal* journal = nullptr);

    void add(const FinishedFrame& frame);
    void add_cut(const Cut& cut);
    /// Repeats what an earlier run passed to its sink; the pictures of these frames exist.
    void repeat(const JournalRecord& frame);
    void repeat_cut(const JournalRecord& cut);
    /// Waits until the files of single frames are complete.
    void flush();

    const std::vector<Manifest::Cut>& cuts() const { return cuts_; }
    /// Returns the statistics of the frames added, and of those that a resumed run keeps.
    std::shared_ptr<const RunStatistics> statistics() const { return statistics_; }
    /// Returns the progress line's remark on the frame that was added last.
    std::string note() const { return statistics_->note(latest_); }

    /// Returns the files of all formats, the kept ones included. A run that was stopped has only files of single
    /// frames, since the others would look complete; `dropped` receives the formats left out.
    std::vector<FileRecord> finish(bool complete, std::vector<std::string>& dropped);
    void add_timings(Manifest& manifest) const;

  private:
    void write(const WrittenFrame& frame);
    using Contacts = std::vector<std::vector<std::int16_t>>;
    Contacts touched(std::uint32_t frame, const std::vector<std::span<const float>>& positions) const;

    struct Writer {
        const OutputFormat* format;
        std::unique_ptr<FrameWriter> files;
    };

    const SceneDescription& scene_;
    const std::map<std::uint32_t, KeptFrame>& kept_;
    Journal* journal_;
    std::shared_ptr<BodyTracks> bodies_;
    bool details_;
    std::vector<Writer> writers_;
    std::vector<Manifest::Cut> cuts_;
    std::shared_ptr<RunStatistics> statistics_;
    std::optional<FrameTable> times_;  ///< ms, of the stages and the whole frame; nothing for a stream
    FrameValues latest_;
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace drape
