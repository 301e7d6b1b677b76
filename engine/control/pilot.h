// A pilot flies a run: it says what is to be simulated next, from which state and with how many substeps, and learns
// from what came of it. It is pure: whoever has the states (a device, or the tests' twin) does the work. A pilot of a
// named method never changes its mind; that of method `auto` (auto_pilot.h) judges frames and has them done again.
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

/// The facts of a frame that was simulated before it is handed out.
struct KnownFrame {
    std::vector<ClothStatistics> statistics;
    FrameEffort effort;
    std::vector<StageTime> timings;
    bool withheld = false;  ///< it is kept or forgotten with others
};

/// A piece of work. Its parts are done in this order: the step before, the change of substeps where they differ from
/// those of the state's history, the frame, the step after, the handing out.
struct Work {
    std::uint32_t frame = 0;
    StateSet set = StateSet::run;
    std::optional<StateStep> before, after;
    bool simulates = false;
    std::uint32_t substeps = 0;  ///< of the frame that is simulated, or that the state has been through; 0: none
    std::uint32_t history_substeps = 0;  ///< those of the state's history
    bool hands_out = false;              ///< the state is the frame's
    std::optional<KnownFrame> known;     ///< of a frame that is handed out after it was simulated
    std::uint32_t attempt = 0;           ///< number of the attempt at frames of the run, from 1; 0: it is none
    bool awaited = false;                ///< the pilot has to know what came of it before it says what is next

    bool changes_substeps() const { return simulates && substeps != history_substeps; }
};

/// What came of it.
struct WorkResult {
    std::vector<ClothStatistics> statistics = {};  ///< by cloth, of a frame that was simulated in the run
    std::vector<double> differences = {};          ///< by cloth, m, where a step compared
    glsl::SelfRecord contact = {};                 ///< of a frame that was simulated
    double list_use = 0;  ///< how full contact's lists were; above 1 they could not be made long enough
    std::vector<StageTime> timings = {};
};

/// Frames that were kept together.
struct KeptFrames {
    std::uint32_t first = 0;
    FrameEffort effort = {};  ///< of each of them
    std::vector<std::vector<ClothStatistics>> statistics = {};
    std::vector<glsl::SelfRecord> contacts = {};
    double list_use = 0;  ///< how full contact's lists were at most
};

/// The substeps that a state of each set has been through in its history.
using Histories = std::array<std::uint32_t, state_set_count>;

class Pilot {
  public:
    virtual ~Pilot() = default;

    /// Returns the first frame that was not simulated and kept. Frame 0 is there in the beginning.
    virtual std::uint32_t simulated() const = 0;
    /// Begins with the frame `simulated()`.
    virtual void begin() = 0;
    /// Returns what is to be done next; nothing: the frames from the one that was begun to `simulated()` are done.
    /// Awaited work must be taken back before.
    virtual std::optional<Work> next_work() = 0;
    /// Learns from work that simulated or compared, in the order in which it was given. Returns the effort of a frame
    /// that was handed out as it was simulated.
    virtual FrameEffort take(const Work& work, const WorkResult& result) = 0;
    /// Forgets what was done since `begin`, and `refused`, which was not begun; `next_work` then takes the state back,
    /// where that is needed.
    virtual void abandon(const Work& refused) = 0;
    /// Begins the attempt at the frames again, from a state that was restored: what did it had no room.
    virtual void attempt_anew() = 0;
    /// Returns the frames that are done once `next_work` says nothing; those of a named method are told in `take`.
    virtual const KeptFrames* kept() const = 0;
    /// Returns why the frames are kept although they miss a limit that is promised; nothing: they do not.
    virtual const std::optional<FrameFailure>& refusal() const = 0;
    /// Is told that a cloth tore in the last frame, so that the next one is simulated.
    virtual void wake() = 0;
    /// Returns the substeps that the run's state has been through.
    virtual std::uint32_t state_substeps() const = 0;

    /// Writes what the next frame depends on, between frames.
    virtual void write(ByteWriter& writer) const = 0;
    /// Reads it. Throws Error where it is nothing that a pilot of this model can come to.
    virtual void read(ByteReader& reader) = 0;
};

/// Returns the pilot of a model, which must outlive it.
std::unique_ptr<Pilot> make_pilot(const SimulationModel& model);

}  // namespace drape
