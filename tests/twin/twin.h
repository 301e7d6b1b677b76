// The C++ twin runs every plain simulation pass in plain C++, with the shaders' own functions, in the shaders' order of
// operations. On a device with IEEE arithmetic (lavapipe) its images equal the device's bit for bit. That the passes
// are *right* is shown elsewhere, against closed forms in double precision.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "cloth/cloth_state.h"
#include "cloth/cut_topology.h"
#include "cloth/frame_inputs.h"
#include "cloth/frame_steps.h"
#include "shared/collider_types.h"

namespace drape {

/// The fields of one cloth that the passes compute, row by row, and its topology after cuts. A field that the cloth
/// does not need, or that holds something else, is empty.
struct TwinCloth {
    TwinCloth(const SimulationModel& model, std::size_t cloth);

    std::vector<glsl::vec4>& operator[](Field field) { return vectors[static_cast<std::size_t>(field)]; }
    const std::vector<glsl::vec4>& operator[](Field field) const { return vectors[static_cast<std::size_t>(field)]; }
    /// Returns the extension (m) by which the tension applied in the last substep would stretch each spring, by first
    /// particle.
    std::vector<float>& tension(std::size_t direction) {
        return scalars[static_cast<std::size_t>(tension_of(direction))];
    }
    const std::vector<float>& tension(std::size_t direction) const {
        return scalars[static_cast<std::size_t>(tension_of(direction))];
    }
    std::vector<glsl::uint>& integers(Field field) { return integer_fields[static_cast<std::size_t>(field)]; }
    const std::vector<glsl::uint>& integers(Field field) const {
        return integer_fields[static_cast<std::size_t>(field)];
    }
    /// Returns the wind's force on a particle (N) and, in w, its drag (N/m).
    glsl::vec4 force_on(std::size_t particle) const;
    /// Writes displacement + increment, less the share `loss` that drag takes, and the rounding that the sum lost.
    void step_displacement(std::size_t particle, glsl::vec3 displacement, glsl::vec3 increment, float loss);
    /// Returns the inverse mass that springs and bending feel.
    float dragged_weight_of(std::size_t particle) const;
    /// Writes a displacement and keeps the mark that the prediction left beside it.
    void move_to(std::size_t particle, glsl::vec3 displacement);
    /// Returns a part of what bending elements are at rest, m (shaders/shared/bend_types.h).
    glsl::vec3 bend_target(glsl::ivec2 owner, int part) const;
    /// Returns what a particle feels of the elements in whose tangents it is (shaders/include/bend_pull.h).
    glsl::vec3 bend_pull(glsl::ivec2 particle) const;
    std::span<const std::byte> bytes(Field field) const;

    std::array<std::vector<glsl::vec4>, field_count> vectors;
    std::array<std::vector<float>, field_count> scalars;
    std::array<std::vector<glsl::uint>, field_count> integer_fields;
    CutTopology topology;
    std::shared_ptr<std::vector<glsl::SewnPlace>> sewn;   ///< of all cloths
    std::shared_ptr<std::vector<glsl::GasSum>> gas_sums;  ///< of all cloths that close gas in
    glsl::ResidualRecord residual{};                      ///< result of the last residual step
    bool iterates = true;                                 ///< last decision: whether conditional steps run
    std::uint32_t iteration_count = 0;                    ///< iterations of the frame, when adaptive
};

/// Returns the squared distance, m^2, of each body that lies with a cloth from where another run has it.
std::vector<float> body_distances(const TwinCloth& fine, const TwinCloth& coarse);

/// A pair of primitives that may meet.
struct TwinPair {
    bool edges;  ///< whether it is two edges, else a particle and a triangle
    glsl::uvec4 corners;
};

/// A pair that touches.
struct TwinTouch {
    bool edges;
    glsl::SelfTouch touch;
};

/// Sums of impulses at a place, by round; the last of them leads pairs apart.
struct TwinSums {
    std::array<std::array<std::int64_t, 3>, glsl::self_sum_count> units{};
    glsl::uint weight = 0;
};

/// Returns what a sum of impulses, or of couples, came to; `largest` as in SelfCloth.
glsl::vec3 summed(const TwinSums& sums, std::size_t which, float largest);

/// The passes of contact hand each other these lists, by place on the sheet of all cloths, as on the device.
struct TwinContact {
    explicit TwinContact(const SelfContact& contact);

    const SelfContact* model;
    std::vector<int> owners;
    std::vector<glsl::vec4> positions, displacements, last_motions;
    std::vector<glsl::SelfBox> boxes;
    std::vector<TwinPair> pairs;
    std::vector<TwinTouch> touching;
    std::map<std::array<glsl::uint, 5>, glsl::vec3> borne;  ///< force of pairs that pressed, by corners and kind
    std::vector<TwinSums> sums;                             ///< by place
    std::vector<glsl::vec4> velocities, made_good, led_ways;
    std::vector<glsl::Support> supports;
    std::vector<glsl::SelfCrossings> crossings;  ///< by pair of cloths that started through each other
    std::vector<glsl::vec3> led;                 ///< displacement that leads each cloth apart from others, m
    std::vector<glsl::vec4> before;
    std::vector<float> shares;  ///< shares of their motions that the particles may make, after the last round
    /// By cloth: whether all of its particles make the least of their shares, and that share in the last round.
    std::vector<std::pair<bool, float>> cloth_shares;
    glsl::SelfRecord record{};
};

/// A step of one cloth, as its function in the twin gets it.
struct TwinPlace {
    const SimulationModel& scene;
    const ClothModel& model;
    TwinCloth& state;
    const Step& step;
    const FrameInputs& inputs;
    const std::vector<glsl::PinMotion>& motions;
    TwinContact* contact;  ///< null where no cloths meet

    /// Displacements of the substep before this one, as `before_alias` (solver/step_row.h) finds them.
    std::vector<glsl::vec4>& before() const {
        return state[model.scheme.spare_state ? Field::displacement_spare : Field::displacement_before];
    }
};

/// Returns where a cloth's particle lies on the sheet.
std::size_t place_on_sheet(const glsl::SelfClothPush& push, std::size_t particle);

/// Cuts short the motions of a cloth's particles that would go farther than was proved to cross nothing. With the last
/// cloth it also counts what the substep's lists held.
void cut_short(TwinContact& contact, std::size_t cloth);

/// A kind of step and its function. Every file of such functions gives their rows.
struct TwinRow {
    StepKind kind;
    void (*run)(const TwinPlace&);
};
std::vector<TwinRow> twin_release_rows(), twin_explicit_rows(), twin_line_rows(), twin_nested_rows(), twin_bend_rows(),
    twin_contact_rows(), twin_check_rows(), twin_sheet_rows(), twin_rotation_rows(), twin_impulse_rows(),
    twin_seam_rows(), twin_gas_rows();

class Twin {
  public:
    /// Takes the kernels of cyclic reduction where `kernels` has them, as they round otherwise, and plain steps else:
    /// all other kernels give the bits of the plain ones.
    explicit Twin(const SimulationModel& model, const Kernels& kernels = {});

    /// Returns the steps of a frame.
    std::vector<Step> steps() const;
    /// Simulates from frame - 1 to `frame`, step by step.
    void run_frame(std::uint32_t frame);
    /// Goes on with the substeps of `run`, a model of the same scene, which must outlive this.
    void change_substep(const SimulationModel& run);
    /// Displaces every cloth's particles by next to nothing (control/sensitivity.h).
    void disturb();
    /// Takes one step, of one cloth or of all of them.
    /// A step of bodies moves them in the inputs.
    void run_step(const Step& step, FrameInputs& inputs);
    void run_step(const Step& step, FrameInputs&& inputs) { run_step(step, inputs); }
    void normals(std::size_t cloth);
    /// Makes the normals of all cloths, once these have theirs, one at seams.
    void sew_normals();
    /// Computes the tension at a frame's end, for the statistics of an explicit method.
    void tension(std::size_t cloth);

    const TwinCloth& cloth(std::size_t index) const { return cloths_[index]; }
    TwinCloth& cloth(std::size_t index) { return cloths_[index]; }
    /// The scene must have contact between cloths.
    const TwinContact& contact() const { return *contact_; }
    /// A cut of this topology acts from the next step on.
    CutTopology& topology(std::size_t index) { return cloths_[index].topology; }

  private:
    /// Takes a step of contact, of all cloths at once.
    void run_contact(const Step& step);
    void meet_bodies(const Step& step, const FrameInputs& inputs);
    void move_bodies(const Step& step, FrameInputs& inputs);
    void strike_bodies(const Step& step);
    /// Returns the cloth with which the state of the bodies of a cloth's member lies.
    std::size_t bearer_of(std::size_t cloth) const {
        return cloth - cloth % (model_->cloths.size() / model_->member_count);
    }

    const SimulationModel* model_;
    Kernels kernels_;
    std::vector<TwinCloth> cloths_;
    std::optional<TwinContact> contact_;
};

}  // namespace drape
