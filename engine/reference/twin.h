// The C++ twin: every plain simulation pass in plain C++, with the shaders' own functions, in the shaders'
// order of operations. On a device with IEEE arithmetic (lavapipe) its images equal the device's bit for bit;
// that the passes are *right* is shown elsewhere, against closed forms in double precision.
#pragma once

#include <array>
#include <vector>

#include "cloth/cut_topology.h"
#include "cloth/frame_inputs.h"
#include "cloth/schedule.h"

namespace drape {

/// The images of one cloth, one texel per particle, row by row (units: metres, newtons).
struct TwinCloth {
    explicit TwinCloth(const ClothGeometry& cloth) : topology(cloth) {}

    std::vector<glsl::vec4> position, displacement, position_rest, displacement_rest, wind_force, normal;
    std::vector<glsl::vec4> position_spare, displacement_spare;    ///< explicit: where the next micro-step writes
    std::vector<glsl::vec4> displacement_before, velocity_excess;  ///< line in second order
    std::array<std::uint32_t, glsl::control_texel_count> line_control{};  ///< likewise
    /// m, per spring direction, by first particle: what the tension applied in the last substep would stretch it by.
    std::array<std::vector<float>, 4> tension;
    CutTopology topology;
    bool iterates = true;               ///< what the last check found: conditional steps run
    std::uint32_t iteration_count = 0;  ///< of the frame, when adaptive
};

class Twin {
  public:
    explicit Twin(const SimulationModel& model);

    /// Simulates from frame-1 to `frame`, step by step of the schedule.
    void run_frame(std::uint32_t frame);
    /// One step, of one cloth or all of them.
    void run_step(const Step& step, const FrameInputs& inputs);
    void normals(std::size_t cloth);
    /// explicit: the tension at a frame's end, for the statistics.
    void tension(std::size_t cloth);

    const TwinCloth& cloth(std::size_t index) const { return cloths_[index]; }
    TwinCloth& cloth(std::size_t index) { return cloths_[index]; }
    /// What cuts made of a cloth; cutting it acts from the next step on.
    CutTopology& topology(std::size_t index) { return cloths_[index].topology; }

  private:
    void run_step(std::size_t cloth, const Step& step, const FrameInputs& inputs);
    void release(const ClothModel& model, TwinCloth& state, const std::vector<glsl::PinMotion>& motions,
                 std::uint32_t substep);
    void wind(const ClothModel& model, TwinCloth& state, const FrameInputs& inputs, std::uint32_t substep);
    void force(TwinCloth& state, const Step& step);
    void explicit_step(TwinCloth& state, const Step& step);
    void control(TwinCloth& state);
    void predict(TwinCloth& state, const Step& step);
    void line(const ClothModel& model, TwinCloth& state, const Step& step);
    void tether(TwinCloth& state);
    void pin(const ClothModel& model, TwinCloth& state, const std::vector<glsl::PinMotion>& motions,
             std::uint32_t substep);
    void spring(const ClothModel& model, TwinCloth& state, const Step& step);
    void bend(TwinCloth& state, const Step& step);
    void twist(TwinCloth& state, const Step& step);
    void collide(const ClothModel& model, TwinCloth& state, const FrameInputs& inputs, std::uint32_t substep);
    void check(const ClothModel& model, TwinCloth& state, const Step& step);
    void advance(TwinCloth& state);

    const SimulationModel& model_;
    std::vector<TwinCloth> cloths_;
};

}  // namespace drape
