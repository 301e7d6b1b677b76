// A pilot steers a run: it says what is to be simulated next, from which state and with how many substeps, and learns
// from the results. It is pure logic: the caller, a device or the tests' twin, holds the states and does the work. The
// pilot of a named method simulates every frame once; that of method `auto` (auto_pilot.h) judges frames and has them
// done again.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/byte_stream.h"
#include "cloth/state_sets.h"
#include "drape/frame.h"
#include "shared/self_contact_types.h"

namespace drape {

/// What is known about a frame that was simulated before it is handed out.
struct KnownFrame {
    std::vector<ClothStatistics> statistics;
    FrameEffort effort;
    std::vector<StageTime> timings;
    bool withheld = false;  ///< it is kept or dropped together with other frames
};

/// A piece of work. Its parts are done in this order: `before`; the change of substeps, where they differ from those of
/// the state's history; the simulation of the frame; `after`; handing the frame out.
struct Work {
    std::uint32_t frame = 0;
    StateSet set = StateSet::run;
    std::optional<StateStep> before, after;
    bool simulates = false;
    std::uint32_t substeps = 0;          ///< of the frame that is simulated, or else of the state's history; 0: none
    std::uint32_t history_substeps = 0;  ///< the substeps of the state's history
    bool hands_out = false;              ///< the state is handed out as the frame's
    std::optional<KnownFrame> known;     ///< of a frame that is handed out after it was simulated
    std::uint32_t attempt = 0;           ///< number of the attempt at the run's frames, from 1; 0: this is no attempt
    bool awaited = false;                ///< the pilot needs the result before it says what is next

    bool changes_substeps() const { return simulates && substeps != history_substeps; }
};

/// The result of a piece of work.
struct WorkResult {
    std::vector<ClothStatistics> statistics = {};  ///< by cloth, of a frame that was simulated in the run
    std::vector<double> differences = {};          ///< by cloth, m, where a step compared two states
    glsl::SelfRecord contact = {};                 ///< of a frame that was simulated
    double list_use = 0;  ///< how full contact's lists were; above 1 they overflowed and could not be made longer
    std::vector<StageTime> timings = {};
};

/// Frames that were kept together.
struct KeptFrames {
    std::uint32_t first = 0;
    FrameEffort effort = {};  ///< the effort of each of these frames
    std::vector<std::vector<ClothStatistics>> statistics = {};
    std::vector<glsl::SelfRecord> contacts = {};
    double list_use = 0;  ///< the largest fill of contact's lists
};

/// For each state set, the number of substeps of the frames that its state went through.
using Histories = std::array<std::uint32_t, state_set_count>;

class Pilot {
  public:
    virtual ~Pilot() = default;

    /// Returns the first frame that has not been simulated and kept. Frame 0 exists from the beginning.
    virtual std::uint32_t simulated() const = 0;
    /// Begins the work on the frame `simulated()`.
    virtual void begin() = 0;
    /// Returns what is to be done next. Nothing: all frames from the one that was begun up to `simulated()` are done.
    /// The result of awaited work must be given to `take` before the next call.
    virtual std::optional<Work> next_work() = 0;
    /// Learns from work that simulated or compared, in the order in which it was given. Returns the effort of the
    /// frame, if this work simulated it and handed it out at once.
    virtual FrameEffort take(const Work& work, const WorkResult& result) = 0;
    /// Drops what was done since `begin`, and `refused`, which was not submitted. Where needed, `next_work` then
    /// restores the state.
    virtual void abandon(const Work& refused) = 0;
    /// Begins the attempt at the frames again, after the state was restored, because contact's lists overflowed.
    virtual void attempt_anew() = 0;
    /// Returns the frames that were kept, once `next_work` returns nothing; null for a named method, which reports its
    /// frames in `take`.
    virtual const KeptFrames* kept() const = 0;
    /// Returns why frames are kept although they miss a promised limit; nothing: they miss none.
    virtual const std::optional<FrameFailure>& refusal() const = 0;
    /// The caller reports that a cloth tore in the last frame, so the next one must be simulated.
    virtual void wake() = 0;
    /// Returns the substeps of the frames that the run's state went through.
    virtual std::uint32_t state_substeps() const = 0;

    /// Writes what the next frame depends on. Call it only between frames.
    virtual void write(ByteWriter& writer) const = 0;
    /// Reads what `write` wrote. Throws Error where a pilot of this model cannot have written it.
    virtual void read(ByteReader& reader) = 0;
};

/// Returns the pilot for a model, which must outlive the pilot.
std::unique_ptr<Pilot> make_pilot(const SimulationModel& model);

}  // namespace drape
