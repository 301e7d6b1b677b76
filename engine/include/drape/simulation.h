// The face of the library: a scene on a device, frame by frame. It writes no file, reads none but a scene's, prints
// nothing (but validation messages, where they are asked for), and knows no command line.
#pragma once

#include <cstddef>
#include <cstdint>
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
#include "drape/scene_reader.h"
#include "drape/schedule.h"
#include "drape/view.h"

namespace drape {

/// How finely FinishedFrame::timings tells the device's time. Each bracket costs about 10 us on a CPU.
enum class Timings { none, stages, passes };

/// What method `auto` is about to simulate.
struct FrameAttempt {
    std::uint32_t frame, substeps;
    std::uint32_t number;  ///< from 1: frames that miss a limit are done again
};

struct SimulationOptions {
    bool draw = false;  ///< pictures of the scene's size and samples
    PictureView view;   ///< of them
    bool positions = true;
    bool velocities = false;  ///< at the frames' ends, as the statistics' energies are; implies statistics
    bool normals = false;
    bool statistics = true;
    bool keep_promises =
        true;  ///< with statistics: throw Diverged and ToleranceMissed instead of handing out a frame that failed
    bool skip = true;  ///< false: do the work that is skipped because it changes no bit
    Timings timings = Timings::stages;
    Schedule schedule = Schedule::automatic;  ///< DeviceError where the device has not what it needs
    std::function<void(const Cut&)> on_cut;
    std::function<void(const FrameAttempt&)> on_attempt;  ///< told of before each
};

/// What a scene became.
struct SimulationFacts {
    struct Skipped {
        std::string what, reason;
    };
    std::string method;         ///< in use
    std::string schedule;       ///< in use
    std::string asked_method;   ///< the scene's
    std::string choice_reason;  ///< why that method, where it was chosen
    double tolerance = 0;       ///< of the RMS stretch error, that no frame may miss; 0: none
    /// What `auto` would keep in every frame, or keeps: largest stretch error, RMS and of a single spring.
    double tolerance_rms = 0, tolerance_worst = 0;
    bool limits_are_kept = false;
    std::vector<Skipped> skipped;
    std::vector<Compromise> compromises;
    /// In a frame that is handed out, and in one that is only simulated.
    std::size_t pass_count = 0, barrier_count = 0, simulated_pass_count = 0, simulated_barrier_count = 0;
};

/// What was proved of the cloths of a scene in which one meets itself, and all each other, of all frames simulated so
/// far.
struct SelfContactReport {
    /// Frame in which a held particle first moved so that a crossing could not be ruled out, or cloth touched; 0 where
    /// a cloth started through itself; nothing: no triangle that meets another passed through it in any substep.
    std::optional<std::uint32_t> first_unproved;
    std::uint32_t most_pairs = 0;  ///< most pairs of particle and triangle, or of edges, near each other
    std::uint64_t truncated = 0;   ///< motions cut short because they would have crossed
    /// Cloths that started through each other: these do not meet before they have come apart, and of them nothing is
    /// proved until then.
    std::vector<std::pair<std::size_t, std::size_t>> crossed = {};
    /// Last frame that ended with some of them through each other; nothing: none can tell, because some start on each
    /// other and never meet.
    std::optional<std::uint32_t> last_crossed = {};
};

/// What a kind of pass does in a frame that is handed out, of the substeps that the scene begins with.
struct PassWork {
    std::string name, stage;  ///< as in FinishedFrame::timings: of passes, of stages
    std::size_t count = 0;
    std::uint64_t bytes = 0;  ///< of all of them, when each reads and writes all it declares once
    double flops = 0;         ///< of all of them: + - * / sqrt of what they compute for each element; 0: not known
};

struct ResourceMemory {
    std::string name;
    std::uint64_t bytes = 0;  ///< all copies
};

/// What the frames of a simulation from some frame on depend on, besides its scene: named parts
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

    /// Computes the next frame, the first time frame 0, for `frame`; false, doing nothing, after the scene's last.
    /// Throws Diverged, ToleranceMissed, DeviceError, after any of which this simulation is over.
    bool step();
    /// That of the last step, valid until the next.
    const FinishedFrame& frame() const;

    /// The same for all frames from the next one to `last`, which may be after the scene's: the device computes frames
    /// while `finished` is told of those before, in order; of the frames that are not `wanted` nothing is read back.
    /// What `finished` gets is valid during the call. `stop` is asked before each frame, and under
    /// method `auto` before each attempt at one; true ends after what the device has begun, and the attempt is
    /// forgotten. Returns whether it came to `last`.
    bool run(std::uint32_t last, const std::function<bool(std::uint32_t)>& wanted,
             const std::function<void(const FinishedFrame&)>& finished, const std::function<bool()>& stop = {});

    /// That the next step or run begins with; 0 in the beginning.
    std::uint32_t next_frame() const;
    /// Whether `save` can be called: not while method `auto` has frames that it handed out in part. Within `stop` this
    /// says whether it can be once `run` has returned.
    bool can_save() const;
    /// For a simulation of the same scene, options and device to go on from here to the same bits.
    SimulationState save() const;
    /// Takes over what another one saved. Throws Error, after which this simulation is over, when it was not of such a
    /// scene.
    void restore(const SimulationState& state);

    /// As it runs: a method and substeps that it left to choose are chosen.
    const SceneDescription& scene() const;
    /// Three particles per triangle: those that no cut has split so far.
    std::vector<std::uint32_t> triangles(std::size_t cloth) const;
    SimulationFacts facts() const;
    /// One for each cloth that meets itself.
    std::optional<SelfContactReport> self_contact() const;
    std::vector<PassWork> work() const;          ///< in order of first appearance
    std::vector<ResourceMemory> memory() const;  ///< the largest first
    /// What runs in a frame that is handed out, what was skipped, and why: "text", "json" or "dot"; of two devices
    /// (Device::for_scene) one after the other.
    std::string describe_plan(const std::string& format) const;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace drape
