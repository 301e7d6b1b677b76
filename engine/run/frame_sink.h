// Where the finished frames of a run go: the writers of its formats, its statistics, its times.
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

/// Those of these names, each once. Throws UsageError.
std::vector<const OutputFormat*> output_formats(const std::vector<std::string>& names);

class Sink {
  public:
    /// `folder`: nothing for a stream; `kept`: frames whose pictures are there already; `journal`: is told of
    /// everything too. All must outlive this.
    Sink(std::optional<OutputFolder>& folder, const RunRequest& request, const SceneDescription& scene,
         const WrittenRun& run, const std::map<std::uint32_t, KeptFrame>& kept, Journal* journal = nullptr);

    void add(const FinishedFrame& frame);
    void add_cut(const Cut& cut);
    /// What an earlier run told its sink; the pictures of such frames are there.
    void repeat(const JournalRecord& frame);
    void repeat_cut(const JournalRecord& cut);
    /// The files of single frames are whole.
    void flush();

    const std::vector<Manifest::Cut>& cuts() const { return cuts_; }
    /// Of the frames added, and of those that a resumed run keeps.
    std::shared_ptr<const RunStatistics> statistics() const { return statistics_; }
    /// What the progress line says of the frame added last.
    std::string note() const { return statistics_->note(latest_); }

    /// The files of all formats, those kept included; of a run that was stopped only the files of single frames, as
    /// the others would look complete: `dropped` says which.
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
    bool details_;
    std::vector<Writer> writers_;
    std::vector<Manifest::Cut> cuts_;
    std::shared_ptr<RunStatistics> statistics_;
    std::optional<FrameTable> times_;  ///< ms, of the stages and of the whole frame; nothing of a stream
    FrameValues latest_;
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace drape
