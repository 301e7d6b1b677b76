// The table of steps: how each kind of step of a frame (cloth/step.h) is done as a compute pass. A row says what its
// shader cannot say of itself; the uses come from the shader (solver/compute_pass.h).
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "solver/compute_pass.h"

namespace drape {

/// A step and where it is taken, which the functions of a row look at.
struct StepPlace {
    const Step& step;
    const ClothState* cloth;        ///< null where contact is of all cloths at once
    const ContactHandles* contact;  ///< null where the scene has no contact between cloths
    const SimulationModel& model;
    const Pipelines& device;
    const MethodScheme& scheme() const { return cloth->model->scheme; }
};

/// A shader that does a step's work.
struct KernelRow {
    Kernel kernel;
    std::string_view shader;  ///< "spring.comp"
    /// Invocations; the pipeline is the chosen one, specialised.
    DispatchSize (*size)(const StepPlace&, const vulkan::ComputePipeline&);
};

/// The images that a step writes instead of those that it reads: they then are the state, and the others spare.
enum class Turn { nothing, displacement, state };

/// The name of a step's pass: a text, or a function of the step.
class StepLabel {
  public:
    StepLabel(const char* text) : text_(text) {}                          // NOLINT(google-explicit-constructor)
    StepLabel(std::string (*text)(const StepPlace&)) : text_of_(text) {}  // NOLINT(google-explicit-constructor)
    std::string operator()(const StepPlace& place) const { return text_of_ ? text_of_(place) : text_; }

  private:
    const char* text_ = nullptr;
    std::string (*text_of_)(const StepPlace&) = nullptr;
};

struct StepRow {
    StepKind kind;
    StepLabel label;
    std::vector<KernelRow> kernels;
    /// Push constants; null: the step's own.
    graph::PushConstants (*push)(const StepPlace&) = nullptr;
    /// Null: the step updates its images in place.
    Turn (*turn)(const StepPlace&) = nullptr;
    /// Returns the name of the resource that a name means in this step; empty: itself.
    std::string (*alias)(const StepPlace&, std::string_view name, bool written) = nullptr;
};

/// By StepKind.
std::span<const StepRow> step_rows();
/// The rows of contact between cloths; the last of `step_rows`.
std::vector<StepRow> contact_step_rows();

/// The value of a specialization constant of a step's shader, which has one for all that it is with or without. Throws
/// std::logic_error for a name that it does not know.
std::uint32_t step_constant(const StepPlace& place, std::string_view name);
/// Those that follow from the scene alone: where each kind of collider ends in the list, `leaves_out`, `round_count`.
std::optional<std::uint32_t> scene_constant(const SimulationModel& model, std::string_view name);

/// The alias of steps that read or write the displacement of a frame's substep before the last: micro-steps that go to
/// and fro have it in the spare image.
std::string before_alias(const StepPlace& place, std::string_view name, bool written);

/// Adds the pass of a step. `cloth` is null where contact is of all cloths at once.
void add_step_pass(graph::Graph& graph, Pipelines& pipelines, ClothState* cloth, ContactHandles* contact,
                   SceneInputs& inputs, const SimulationModel& model, const Step& step);

/// A document of the table: which resources the shaders of every step read and write, from the modules themselves.
std::string step_document();

}  // namespace drape
