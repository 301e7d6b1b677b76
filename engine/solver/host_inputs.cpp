#include "solver/host_inputs.h"

#include <cstring>

#include "solver/attempt_pass.h"
#include "solver/cut_pass.h"
#include "solver/form_pass.h"

namespace drape {

namespace {

template <class T>
void write_buffer(const graph::ResourcePool& pool, std::uint32_t slot, const std::string& name,
                  const std::vector<T>& values) {
    if (!pool.has(name)) return;
    const std::span<const std::byte> bytes = std::as_bytes(std::span(values));
    std::memcpy(pool.buffer(name, slot).mapped().data(), bytes.data(), bytes.size());
}

/// Returns the motion of pins of cloths together, of each substep, cloth by cloth.
std::vector<glsl::PinMotion> joined_pins(const ClothLayout& layout, const Together& together, const FrameInputs& inputs,
                                         std::uint32_t substeps) {
    std::vector<glsl::PinMotion> all;
    for (std::size_t substep = 0; substep < substeps; ++substep)
        for (const std::size_t cloth : together.cloths) {
            const std::vector<glsl::PinMotion>& own = inputs.pins[cloth];
            const auto count = static_cast<std::ptrdiff_t>(layout.model.cloths[cloth].dynamic_pins.size());
            const auto first = own.begin() + static_cast<std::ptrdiff_t>(substep) * count;
            all.insert(all.end(), first, first + count);
        }
    return all;
}

}  // namespace

std::string present_name(const std::string& state) { return state + "/present"; }
std::string present_sizes_name(const std::string& state) { return state + "/sizes of present"; }

void write_inputs(const ClothLayout& layout, const graph::ResourcePool& pool, std::uint32_t slot, std::uint32_t frame,
                  const SimulationModel& run) {
    write_inputs(layout, pool, slot, frame_inputs(run, frame), run.scene.solver.substeps);
    write_constants(layout, pool, slot, run.scene.solver.substeps);
}

void write_inputs(const ClothLayout& layout, const graph::ResourcePool& pool, std::uint32_t slot,
                  const FrameInputs& inputs, std::uint32_t substeps) {
    const SimulationModel& model = layout.model;
    const FieldRow& pins = row_of(Field::pin_motions);
    if (model.windy) write_buffer(pool, slot, "wind", inputs.wind);
    if (!inputs.stiffness.empty()) write_buffer(pool, slot, "stiffness", inputs.stiffness);
    if (!inputs.openings.empty()) write_buffer(pool, slot, "openings", inputs.openings);
    if (!inputs.colliders.empty()) write_buffer(pool, slot, "colliders", inputs.colliders);
    if (!inputs.body_actions.empty()) write_buffer(pool, slot, body_actions_name, inputs.body_actions);
    if (inputs.forms) write_forms(pool, slot, *inputs.forms);
    for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth)
        if (layout.is_alone(cloth) && !inputs.pins[cloth].empty())
            write_buffer(pool, slot, resource_name(model.cloths[cloth], pins), inputs.pins[cloth]);
    for (const Together& together : layout.together)
        if (const std::string name = resource_name(together.name, pins); pool.has(name))
            write_buffer(pool, slot, name, joined_pins(layout, together, inputs, substeps));
}

void write_constants(const ClothLayout& layout, const graph::ResourcePool& pool, std::uint32_t slot,
                     std::uint32_t substeps) {
    for (const Together& together : layout.together)
        for (const auto& [name, bytes] : *together.constants.at(substeps)) write_buffer(pool, slot, name, bytes);
}

void write_present(const ClothLayout& layout, const graph::ResourcePool& pool, std::uint32_t slot,
                   const std::vector<bool>& cloths) {
    for (const Together& together : layout.together) {
        const std::size_t count = together.cloths.size();
        std::vector<glsl::uint> present(2 * count);
        glsl::uint layers = 0;
        for (std::size_t place = 0; place < count; ++place)
            if (cloths[together.cloths[place]]) {
                present[layers++] = static_cast<glsl::uint>(place);
                present[count + place] = 1;
            }
        std::vector<glsl::uvec4> sizes = *together.sizes_of_present;
        for (glsl::uvec4& size : sizes) size.z = layers;
        write_buffer(pool, slot, present_name(together.name), present);
        write_buffer(pool, slot, present_sizes_name(together.name), sizes);
    }
}

void write_changes(const ClothLayout& layout, const graph::ResourcePool& pool, std::uint32_t slot,
                   const std::vector<glsl::SubstepChange>& changes) {
    std::vector<glsl::SubstepChange> all;  // in the order of ClothSolver::for_each_dispatch
    for (const Together& together : layout.together)
        for (const std::size_t cloth : together.cloths) all.push_back(changes[cloth]);
    for (std::size_t cloth = 0; cloth < changes.size(); ++cloth)
        if (layout.is_alone(cloth)) all.push_back(changes[cloth]);
    write_buffer(pool, slot, attempt_name, all);
}

void write_cutters(const SceneDescription& scene, const graph::ResourcePool& pool, std::uint32_t slot,
                   double frame_start, double frame_end) {
    if (!scene.cutters.empty())
        write_buffer(pool, slot, cutters_name, cutter_triangles(scene.cutters, frame_start, frame_end));
}

}  // namespace drape
