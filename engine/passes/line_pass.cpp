#include "passes/line_pass.h"

#include <algorithm>
#include <string>

#include "passes/declare.h"
#include "passes/step_dispatch.h"
#include "passes/struct_layouts.h"

namespace drape {

namespace {

using vulkan::DescriptorAccess;
using vulkan::DescriptorDeclaration;
using vulkan::DescriptorKind;

constexpr VkFormat integer = VK_FORMAT_R32_UINT;

constexpr DescriptorDeclaration control_descriptors[] = {image_read(0, "control_in", integer),
                                                         image_write(1, "control_out", integer)};
const vulkan::ShaderInterface control_shader{"line_control.comp", control_descriptors, nullptr};

constexpr DescriptorDeclaration predict_calm[] = {
    image_read(0, "position_in"),
    image_write(1, "position_out"),
    image_read(2, "displacement_in"),
    image_write(3, "displacement_out"),
    image_read(4, "position_rest_in"),
    image_write(5, "position_rest_out"),
    image_read(6, "displacement_rest_in"),
    image_write(7, "displacement_rest_out"),
    image_read(9, "displacement_before_in"),
    image_write(10, "displacement_before_out"),
    image_read(11, "velocity_excess_in"),
    image_write(12, "velocity_excess_out"),
    image_read(13, "control", integer),
    image_read(8, "wind_force"),  // the windy variant only
};
const vulkan::ShaderInterface calm{"predict.comp", std::span(predict_calm).first(13), &layouts::predict_push};
const vulkan::ShaderInterface windy{"predict_wind.comp", predict_calm, &layouts::predict_push};

constexpr DescriptorDeclaration
    position = image_read(0, "position"),
    displacement_in = image_read(1, "displacement_in"), displacement_out = image_write(2, "displacement_out"),
    scratch{
        3,       "Scratch",         DescriptorKind::storage_buffer, DescriptorAccess::read_write, VK_FORMAT_UNDEFINED,
        nullptr, sizeof(glsl::vec2)},
    stiffness = image_read(4, "stiffness_image"), tension_in = image_read(5, "tension_in", VK_FORMAT_R32_SFLOAT),
    tension_out = image_write(6, "tension_out", VK_FORMAT_R32_SFLOAT),
    control{7, "control", DescriptorKind::storage_image, DescriptorAccess::read_write, integer};

/// What every variant binds, and `more`.
template <class... More>
constexpr auto with(More... more) {
    return std::array<DescriptorDeclaration, 4 + sizeof...(more)>{position, displacement_in, displacement_out, scratch,
                                                                  more...};
}
constexpr auto plain = with();
constexpr auto masked = with(stiffness);
constexpr auto stored = with(tension_in, tension_out);
constexpr auto masked_stored = with(stiffness, tension_in, tension_out);
constexpr auto second_order = with(control);
constexpr auto second_order_masked = with(stiffness, control);
constexpr auto second_order_stored = with(tension_in, tension_out, control);
constexpr auto second_order_both = with(stiffness, tension_in, tension_out, control);

/// By [second order][masked][stores tension].
const vulkan::ShaderInterface interfaces[2][2][2] = {
    {{{"line.comp", plain, &layouts::line_push}, {"line_tension.comp", stored, &layouts::line_push}},
     {{"line_masked.comp", masked, &layouts::line_push},
      {"line_masked_tension.comp", masked_stored, &layouts::line_push}}},
    {{{"line_second_order.comp", second_order, &layouts::line_push},
      {"line_second_order_tension.comp", second_order_stored, &layouts::line_push}},
     {{"line_second_order_masked.comp", second_order_masked, &layouts::line_push},
      {"line_second_order_masked_tension.comp", second_order_both, &layouts::line_push}}}};

/// A descriptor that a pass reads and writes through one view.
void update_in_place(graph::PassSetup& setup, graph::Handle& handle, std::uint32_t binding) {
    setup.read(handle, graph::Access::compute_read);
    handle = setup.write(handle, graph::Access::compute_write, binding);
}

}  // namespace

void declare_line(graph::Graph& graph, ClothState& state) {
    const ClothModel& model = *state.model;
    const auto image = [&](const std::string& part, VkFormat format, std::uint32_t width, std::uint32_t height) {
        return graph.image(
            {model.name + "/" + part, format, width, height, VK_SAMPLE_COUNT_1_BIT, graph::Lifetime::persistent});
    };
    std::size_t springs = 0;
    for (const LineWork& line : model.lines)
        springs = std::max(springs, static_cast<std::size_t>(line.push.line_count) *
                                        static_cast<std::size_t>(line.push.particle_count - 1));
    // Persistent only because an invocation reads what it wrote itself: nothing in it outlives a pass.
    if (springs > 0)
        state.line_scratch =
            graph.buffer({model.name + "/line scratch", springs * sizeof(glsl::vec2), graph::Lifetime::persistent});
    if (!model.second_order) return;
    constexpr VkFormat vec4 = VK_FORMAT_R32G32B32A32_SFLOAT;
    state.displacement_before = image("displacement before", vec4, model.grid.columns(), model.grid.rows());
    state.velocity_excess = image("velocity excess", vec4, model.grid.columns(), model.grid.rows());
    state.line_control = image("line control", integer, glsl::control_texel_count, 1);
}

void add_line_control(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step) {
    const vulkan::ComputePipeline& pipeline = pipelines.get(control_shader);
    graph.add_pass(
        state.step_name("line control", step),
        [&](graph::PassSetup& setup) { update(setup, state.line_control, 0, 1); },
        [&pipeline](graph::PassContext& context) { context.dispatch(pipeline, 1, 1); });
}

void add_predict(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step) {
    const bool wind = state.wind_force.valid();
    const std::uint32_t advances = step.substep > 0 ? 1 : 0;
    const vulkan::ComputePipeline& pipeline = pipelines.get(wind ? windy : calm, {{0, advances}});
    graph.add_pass(
        state.step_name("predict", step),
        [&](graph::PassSetup& setup) {
            update(setup, state.position, 0, 1);
            update(setup, state.displacement, 2, 3);
            update(setup, state.position_rest, 4, 5);
            update(setup, state.displacement_rest, 6, 7);
            if (wind) setup.read(state.wind_force, graph::Access::compute_read, 8);
            update(setup, state.displacement_before, 9, 10);
            update(setup, state.velocity_excess, 11, 12);
            setup.read(state.line_control, graph::Access::compute_read, 13);
        },
        [&pipeline, push = state.model->predict](graph::PassContext& context) {
            context.dispatch(pipeline, push, static_cast<std::uint32_t>(push.grid.x),
                             static_cast<std::uint32_t>(push.grid.y));
        });
}

void add_line(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step) {
    const ClothModel& model = *state.model;
    const LineWork& work = model.lines[step.work];
    const auto direction = static_cast<std::size_t>(work.direction);
    const bool stores_tension =
        state.tension[direction].valid() && (model.carries_tension[direction] || (step.last && work.compliant));
    const vulkan::ComputePipeline& pipeline =
        pipelines.get(interfaces[model.second_order][model.masked][stores_tension]);
    glsl::LinePush push = work.push;
    push.first_iteration = step.iteration == 0 ? 1 : 0;
    const StepDispatch dispatch(state, step, pipeline, static_cast<std::uint32_t>(push.line_count), 1);
    graph.add_pass(
        state.step_name("line " + std::string(spring_directions[direction].name), step),
        [&](graph::PassSetup& setup) {
            setup.read(state.position, graph::Access::compute_read, 0);
            update(setup, state.displacement, 1, 2);
            update_in_place(setup, state.line_scratch, 3);
            if (model.masked) setup.read(state.stiffness, graph::Access::compute_read, 4);
            if (stores_tension) update(setup, state.tension[direction], 5, 6);
            if (model.second_order) update_in_place(setup, state.line_control, 7);
            dispatch.declare(setup);
        },
        [dispatch, push](graph::PassContext& context) { dispatch.record(context, push); });
}

}  // namespace drape
