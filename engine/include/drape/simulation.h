// The face of the library runs a scene on a device, frame by frame. It writes no file, reads none but a scene's, prints
// nothing (but validation messages, where they are asked for), and knows no command line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "drape/compromise.h"
#include "drape/device.h"
#include "drape/error.h"
#include "drape/frame.h"
#include "drape/kernels.h"
#include "drape/momenta.h"
#include "drape/scene_reader.h"
#include "drape/view.h"

namespace drape {

/// FinishedFrame::timings tells the device's time this finely. Each bracket costs about 10 us on a CPU.
enum class Timings { none, stages, passes };

/// An attempt at a frame that method `auto` is about to simulate.
struct FrameAttempt {
    std::uint32_t frame, substeps;
    std::uint32_t number;  ///< from 1: frames that miss a limit are done again
};

/// Frames that are asked for, as Simulation::run says.
struct FrameRequest {
    std::uint32_t last = 0;
    std::function<bool(std::uint32_t)> wanted;
    std::function<void(const FinishedFrame&)> finished;
    std::function<bool()> stop = {};
};
/// How that ended.
struct RequestEnd {
    bool complete = false;            ///< it came to the last frame
    std::exception_ptr failure = {};  ///< what Simulation::run would have thrown; null: nothing
};

struct SimulationOptions {
    bool draw = false;    ///< make pictures of the scene's size and samples
    PictureView view;     ///< the pictures' view
    bool layers = false;  ///< make layers of that size: what is seen where, as numbers
    bool positions = true;
    bool velocities = false;  ///< at the frames' ends, like the statistics' energies; implies statistics
    bool normals = false;
    bool statistics = true;
    /// With statistics: throws Diverged and ToleranceMissed at a frame that failed, wanted or not.
    bool keep_promises = true;
    EnsembleControls controls;  ///< what `act` may tell; Error beside actions of the scene's own
    bool skip = true;           ///< false: do the work that is skipped because it changes no bit
    Timings timings = Timings::stages;
    Kernels kernels = Kernels::automatic();  ///< DeviceError where the device has not what it needs
    std::function<void(const Cut&)> on_cut;
    std::function<void(const FrameAttempt&)> on_attempt;  ///< told of before each
};

/// These facts tell how a simulation runs its scene.
struct SimulationFacts {
    struct Skipped {
        std::string what, reason;
    };
    std::string method;         ///< the method in use
    std::string kernels;        ///< those in use, beside the plain ones
    std::string asked_method;   ///< the method that the scene asks for
    std::string choice_reason;  ///< the reason for that method, if it was chosen
    double tolerance = 0;       ///< RMS stretch error that no frame may miss; 0: none
    /// Largest stretch error, RMS and of a single spring, that `auto` keeps in every frame or, without
    /// `limits_are_kept`, would.
    double tolerance_rms = 0, tolerance_worst = 0;
    bool limits_are_kept = false;
    std::vector<Skipped> skipped;
    std::vector<Compromise> compromises;
    std::vector<Momenta> momenta;  ///< by cloth
    /// Counts in a frame that is handed out, and in one that is only simulated.
    std::size_t pass_count = 0, barrier_count = 0, simulated_pass_count = 0, simulated_barrier_count = 0;
};

/// The proof about all frames simulated so far, of a scene in which a cloth meets itself, and all meet each other.
struct SelfContactReport {
    /// The frame in which a held particle first moved so that a crossing could not be ruled out, or cloth touched; 0
    /// where a cloth started through itself. Nothing: no triangle that meets another passed through it in any substep.
    /// Those that cutters split meet none (SimulationOptions::on_cut tells of them).
    std::optional<std::uint32_t> first_unproved;
    std::uint32_t most_pairs = 0;  ///< most pairs of particle and triangle, or of edges, that were near each other
    std::uint64_t truncated = 0;   ///< motions that were cut short because they would have crossed
    double longest_lag = 0;        ///< m, the farthest that one was held back in a substep; its velocity stays
    double lag_limit = 0;          ///< m; `auto` keeps it as far as more substeps help
    /// The first frame in which one was held back farther than that, and how many there were.
    std::optional<std::uint32_t> first_lagging = {};
    std::uint32_t lagging_frames = 0;
    /// Cloths that started through each other. They do not meet before they have come apart, and until then nothing is
    /// proved of them.
    std::vector<std::pair<std::size_t, std::size_t>> crossed = {};
    /// The last frame that ended with some of them through each other. Nothing: it cannot be told, because some start
    /// on each other and never meet.
    std::optional<std::uint32_t> last_crossed = {};
};

/// The result of judging all frames simulated so far, handed out or not. It is empty without statistics.
struct RunVerdict {
    /// The first that failed (without keep_promises); one that is not finite counts before any other.
    std::optional<FrameFailure> failure;
    /// The worst of any frame and cloth. Nothing: no frame was judged.
    std::optional<double> stretch_error_rms, stretch_error_max;
    std::vector<std::string> warnings;  ///< what is no failure, but nothing to keep silent about
    std::vector<std::string> notes;     ///< what holds of the motion itself, however it is computed
};

/// The work of one kind of pass in a frame that is handed out, with the substeps that the scene begins with.
struct PassWork {
    std::string name, stage;  ///< the names in FinishedFrame::timings of passes and of stages
    std::size_t count = 0;
    std::uint64_t bytes = 0;  ///< all passes together, when each reads and writes all it declares once
    double flops = 0;         ///< + - * / sqrt that all passes compute, counted for each element; 0: not known
};

struct ResourceMemory {
    std::string name;
    std::uint64_t bytes = 0;  ///< all copies together
};

struct EnsembleActions;  // drape/ensemble.h

/// The named parts that a simulation's frames from some frame on depend on, besides its scene
/// (engine/docs/checkpoint.md).
using SimulationState = std::map<std::string, std::vector<std::byte>>;

class Simulation {
  public:
    /// Throws DeviceError when the scene does not fit the device, before anything is allocated, and SceneFailure for
    /// what no scene may have. Beyond that a scene built in code should keep to the ranges of the scene format.
    explicit Simulation(const SceneDescription& scene, const SimulationOptions& options = {},
                        const Device& device = Device());
    ~Simulation();
    Simulation(Simulation&&) noexcept;

    /// Makes simulations of scenes of one shape, for which method `auto` chooses the same, that share dispatches; each
    /// has options of its own, of which callbacks alone may differ. They draw nothing, cannot be saved, and go on by
    /// `run_together` alone. Throws like the constructor, and Error where they cannot share dispatches.
    static std::vector<Simulation> together(const std::vector<SceneDescription>& scenes,
                                            const std::vector<SimulationOptions>& options, const Device& device);
    /// Computes what is asked of each of the simulations that were made together, once. Throws DeviceError, after
    /// which all are over.
    static std::vector<RequestEnd> run_together(std::span<Simulation> simulations,
                                                std::span<const FrameRequest> requests);

    /// Computes the next frame, the first time frame 0, for `frame`; returns false and does nothing after the scene's
    /// last. Throws Diverged, ToleranceMissed or DeviceError, after which this simulation is over.
    bool step();
    /// Returns the frame of the last step, which is valid until the next.
    const FinishedFrame& frame() const;

    /// Computes all frames from the next one to `last`, which may be after the scene's, and throws like `step`. The
    /// device computes frames while `finished` is told of those before, in order; of frames that are not `wanted` the
    /// statistics alone are read back, to be judged. What `finished` gets is valid during the call. `stop` is asked
    /// before each frame, and under method `auto` before each attempt at one; true ends after what the device has
    /// begun, and the attempt is forgotten. Returns whether it came to `last`.
    bool run(std::uint32_t last, const std::function<bool(std::uint32_t)>& wanted,
             const std::function<void(const FinishedFrame&)>& finished, const std::function<bool()>& stop = {});

    /// Tells what holds from the next frame on, frame 1 at the earliest: the actions of an ensemble's only member. What
    /// is told twice for a frame counts as it was told last. Throws ActionError, and nothing has changed.
    void act(const EnsembleActions& actions);
    /// Returns what it was told so far, by `act` or by its scene; a scene that has it as its `actions` gives the same
    /// bits (`scene_with_actions`).
    SceneActions recorded() const;

    /// Returns the frame that the next step or run begins with; 0 in the beginning.
    std::uint32_t next_frame() const;
    /// Returns whether `save` can be called: it cannot while method `auto` has frames that it handed out in part.
    /// Within `stop` this says whether it can once `run` has returned.
    bool can_save() const;
    /// Returns what a simulation of the same scene, options and device needs to go on from here to the same bits.
    SimulationState save() const;
    /// Takes over what another simulation saved. Throws Error where it is damaged, and nothing has changed; and where
    /// it was not of such a scene, after which this simulation is over.
    void restore(const SimulationState& state);

    /// Returns the scene as it runs, with the method and substeps that it left to choose.
    const SceneDescription& scene() const;
    /// Returns three particles per triangle, for those that no cut has split so far.
    std::vector<std::uint32_t> triangles(std::size_t cloth) const;
    /// Returns by particle which of the springs that it is the first of are there now, uncut and untorn: bits 1, 2, 4
    /// and 8 for those to the right (column + 1), down (row + 1), down right and down left.
    std::vector<std::uint8_t> spring_bits(std::size_t cloth) const;
    SimulationFacts facts() const;
    /// Returns what was proved of contact between cloths; nothing when no cloth meets itself.
    std::optional<SelfContactReport> self_contact() const;
    RunVerdict verdict() const;
    /// Returns in which of the frames computed a collider may have passed between a cloth's particles, which one, and
    /// what would help; nothing where contact kept it out.
    std::optional<std::string> possible_passage() const;
    std::vector<PassWork> work() const;          ///< in order of first appearance
    std::vector<ResourceMemory> memory() const;  ///< the largest first
    /// Describes what runs in a frame that is handed out, what was skipped, and why, as "text", "json" or "dot"; two
    /// devices (Device::for_scene) follow one after the other.
    std::string describe_plan(const std::string& format) const;

  private:
    struct Parts;
    explicit Simulation(std::unique_ptr<Parts> parts);
    std::unique_ptr<Parts> parts_;
};

}  // namespace drape
