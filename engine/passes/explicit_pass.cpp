#include "passes/explicit_pass.h"

#include <array>

#include "passes/declare.h"
#include "passes/struct_layouts.h"

namespace drape {

namespace {

constexpr vulkan::DescriptorDeclaration state_images[] = {
    image_read(0, "position_in"),          image_write(1, "position_out"),          image_read(2, "displacement_in"),
    image_write(3, "displacement_out"),    image_read(4, "position_rest_in"),       image_write(5, "position_rest_out"),
    image_read(6, "displacement_rest_in"), image_write(7, "displacement_rest_out"),
};
constexpr vulkan::DescriptorDeclaration wind_force = image_read(8, "wind_force"),
                                        stiffness = image_read(9, "stiffness_image");

/// The state images and `more`.
template <class... More>
constexpr auto with(More... more) {
    std::array<vulkan::DescriptorDeclaration, std::size(state_images) + sizeof...(more)> all{};
    std::size_t count = 0;
    for (const vulkan::DescriptorDeclaration& image : state_images) all[count++] = image;
    ((all[count++] = more), ...);
    return all;
}
constexpr auto plain = with();
constexpr auto windy = with(wind_force);
constexpr auto masked = with(stiffness);
constexpr auto masked_windy = with(wind_force, stiffness);

/// By [masked][windy].
const vulkan::ShaderInterface interfaces[2][2] = {
    {{"explicit.comp", plain, &layouts::explicit_push}, {"explicit_wind.comp", windy, &layouts::explicit_push}},
    {{"explicit_masked.comp", masked, &layouts::explicit_push},
     {"explicit_masked_wind.comp", masked_windy, &layouts::explicit_push}}};

}  // namespace

void add_explicit_step(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step) {
    const ClothModel& model = *state.model;
    const bool wind = state.wind_force.valid();
    const glsl::ExplicitPush& constants = model.explicit_step;
    const std::uint32_t advances = step.substep > 0 ? 1 : 0, has_shear = constants.stiffness.z > 0 ? 1 : 0,
                        has_bend = constants.twist > 0 ? 1 : 0;
    const vulkan::ComputePipeline& pipeline =
        pipelines.get(interfaces[model.masked][wind], {{0, advances}, {1, has_shear}, {2, has_bend}});
    graph.add_pass(
        state.step_name("explicit step", step),
        [&](graph::PassSetup& setup) {
            setup.read(state.position, graph::Access::compute_read, 0);
            state.position_spare = setup.write(state.position_spare, graph::Access::compute_write, 1);
            setup.read(state.displacement, graph::Access::compute_read, 2);
            state.displacement_spare = setup.write(state.displacement_spare, graph::Access::compute_write, 3);
            update(setup, state.position_rest, 4, 5);
            update(setup, state.displacement_rest, 6, 7);
            if (wind) setup.read(state.wind_force, graph::Access::compute_read, 8);
            if (model.masked) setup.read(state.stiffness, graph::Access::compute_read, 9);
        },
        [&pipeline, push = model.explicit_step](graph::PassContext& context) {
            context.dispatch(pipeline, push, static_cast<std::uint32_t>(push.grid.x),
                             static_cast<std::uint32_t>(push.grid.y));
        });
    state.turn();
}

}  // namespace drape
