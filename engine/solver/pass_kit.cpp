#include "solver/pass_kit.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "cloth/cyclic_lines.h"
#include "fmt/format.h"
#include "shared/cyclic_types.h"
#include "shared/stream_types.h"

namespace drape {

namespace {

/// So many invocations, counted workgroup by workgroup, row by row, as a dispatch's width and height. No more than the
/// 65,535 workgroups that every device takes, down, make up the largest images.
std::array<std::uint32_t, 2> folded(std::uint64_t invocations) {
    constexpr std::uint32_t width = glsl::workgroup_width, most_across = 64;
    const auto groups = static_cast<std::uint32_t>((invocations - 1) / width + 1);
    const std::uint32_t across = std::min(groups, most_across);
    return {across * width, (groups - 1) / across + 1};
}

}  // namespace

const vulkan::ComputePipeline& Pipelines::get(const std::string& module,
                                              const std::vector<vulkan::SpecializationConstant>& constants) {
    const vulkan::ComputePipeline& pipeline = device_.compute_pipeline(module, constants);
    asked_for_.insert(&pipeline);
    return pipeline;
}

bool Pipelines::wide_atomics() const { return device_.wide_atomics(); }
std::uint32_t Pipelines::entries_each() const { return device_.info().type == "cpu" ? 8 : 1; }
std::uint32_t Pipelines::strip_rows(std::size_t rounds_each) const {
    const std::size_t most = device_.info().type == "cpu" ? 32 : 1;
    return static_cast<std::uint32_t>(std::clamp<std::size_t>(most_loop_rounds / rounds_each, 1, most));
}
std::uint32_t Pipelines::strip_columns() const { return device_.info().type == "cpu" ? 2 : 1; }
std::uint32_t Pipelines::strips_of(std::size_t rows) const {
    return static_cast<std::uint32_t>((rows - 1) / strip_rows() + 1);
}
std::uint32_t Pipelines::strip_length() const { return device_.info().type == "cpu" ? 16 : 1; }
std::array<std::uint32_t, 2> Pipelines::over_strips(glsl::ivec2 grid) const {
    return folded((static_cast<std::uint64_t>(grid.x) * static_cast<std::uint64_t>(grid.y) - 1) / strip_length() + 1);
}
std::array<std::uint32_t, 2> Pipelines::over_parts(glsl::ivec2 grid) const {
    const std::uint64_t columns = (static_cast<std::uint32_t>(grid.x) - 1) / strip_columns() + 1;
    return folded(columns * strips_of(static_cast<std::size_t>(grid.y)));
}

std::string buffered_obstacle(const vulkan::Device& device, const Grid& grid, std::uint32_t count) {
    if (!device.wide_integers()) return "the device's shaders have no integers of 64 bits";
    const auto width = static_cast<std::uint64_t>(grid.columns()), height = static_cast<std::uint64_t>(grid.rows());
    std::vector<std::pair<VkFormat, FieldExtent>> images = {{VK_FORMAT_R32G32B32A32_SFLOAT, {width, height}},
                                                            {VK_FORMAT_R32_SFLOAT, {width, height}},
                                                            {VK_FORMAT_R32G32B32A32_SFLOAT, line_scratch_extent(grid)}};
    // Cells, line controls: integers, which no pass writes through a buffer view of a single cloth's.
    if (count > 1) images.push_back({VK_FORMAT_R32_UINT, {width, height}});
    std::vector<std::string> slices;
    for (std::uint32_t k = 0; k < count && count > 1; ++k) slices.push_back(fmt::format("state {}", k));
    for (const auto& [format, extent] : images) {
        const std::uint32_t step = glsl::state_row_alignment / vulkan::texel_size(format);
        const auto columns = static_cast<std::uint32_t>(extent.width), rows = static_cast<std::uint32_t>(extent.height);
        std::string why = graph::buffer_view_obstacle(
            device, {.name = "state", .format = format, .width = columns, .height = rows * count, .slices = slices},
            (columns + step - 1) / step * step);
        if (!why.empty()) return why;
    }
    return {};
}

std::string sheet_obstacle(const vulkan::Device& device, glsl::ivec2 size) {
    constexpr std::uint32_t step = glsl::state_row_alignment / 16;
    const auto columns = static_cast<std::uint32_t>(size.x);
    return graph::buffer_view_obstacle(device,
                                       {.name = "the cloths' sheet",
                                        .format = VK_FORMAT_R32G32B32A32_SFLOAT,
                                        .width = columns,
                                        .height = static_cast<std::uint32_t>(size.y)},
                                       (columns + step - 1) / step * step);
}

std::string streamed_obstacle(const vulkan::Device& device, const Grid& grid) {
    constexpr auto lanes = static_cast<std::uint32_t>(glsl::stream_lanes);
    if (!device.shuffles(lanes)) return fmt::format("the device has no subgroups of {} that shuffle", lanes);
    return buffered_obstacle(device, grid);
}

std::string large_group_obstacle(const vulkan::Device& device) {
    constexpr std::uint32_t most = glsl::cyclic_most_particles;
    const VkPhysicalDeviceLimits& limits = device.limits();
    if (limits.maxComputeWorkGroupInvocations < most || limits.maxComputeWorkGroupSize[0] < most)
        return fmt::format("the device has no workgroups of {} invocations", most);
    if (limits.maxComputeSharedMemorySize < cyclic_shared_bytes(most))
        return fmt::format("the device's workgroups share less than {} bytes", cyclic_shared_bytes(most));
    return {};
}

std::uint32_t stream_invocations(int columns, int width, int halo) {
    const int new_columns = width - 2 * halo;
    const int strips = columns <= width ? 1 : (columns - 2 * halo + new_columns - 1) / new_columns;
    return static_cast<std::uint32_t>(strips * glsl::stream_lanes);
}

std::uint32_t stream_bands(int rows) { return static_cast<std::uint32_t>(std::max(1, rows / glsl::stream_band)); }

std::string resource_name(const ClothModel& cloth, const FieldRow& row) {
    return cloth.name + "/" + std::string(row.name);
}

void ClothState::turn() {
    for (const auto& [field, spare, variable] : spare_fields) std::swap((*this)[field], (*this)[spare]);
    away = !away;
}

void ClothState::turn_displacement() { std::swap((*this)[Field::displacement], (*this)[Field::displacement_spare]); }

graph::PassName ClothState::pass_name(const std::string& pass, const std::string& stage) const {
    const std::string label = name + "/" + pass;
    return {label, stage, label};
}

graph::PassName ClothState::step_name(const std::string& pass, const Step& step) const {
    const std::string label = name + "/" + pass;
    return {fmt::format("{} (substep {}, iteration {})", label, step.substep, step.iteration), "simulate", label};
}

std::vector<vulkan::SpecializationConstant> collider_constants(const SceneDescription& scene) {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const std::string_view list : collider_lists) all.push_back(std::string(list) + "_end");
        return all;
    }();
    const auto ends = kind_ends(scene.colliders);
    std::vector<vulkan::SpecializationConstant> constants;
    for (std::size_t kind = 0; kind < ends.size(); ++kind) constants.push_back({names[kind], ends[kind]});
    return constants;
}

void update(graph::PassSetup& setup, graph::Handle& handle, const std::string& name) {
    setup.read(handle, graph::Access::compute_read, name + "_in");
    handle = setup.write(handle, graph::Access::compute_write, name + "_out");
}

void write_prediction(graph::PassSetup& setup, ClothState& state, const Step& step) {
    graph::Handle& written = state[step.turns ? Field::displacement_spare : Field::displacement];
    setup.read(state[Field::displacement], graph::Access::compute_read, "displacement_in");
    written = setup.write(written, graph::Access::compute_write, "displacement_out");
}

void write_spare(graph::PassSetup& setup, ClothState& state) {
    for (const auto& [field, spare, variable] : spare_fields) {
        setup.read(state[field], graph::Access::compute_read, fmt::format("{}_in", variable));
        state[spare] = setup.write(state[spare], graph::Access::compute_write, fmt::format("{}_out", variable));
    }
}

void update_in_place(graph::PassSetup& setup, graph::Handle& handle, const std::string& name) {
    setup.read(handle, graph::Access::compute_read);
    handle = setup.write(handle, graph::Access::compute_write, name);
}

}  // namespace drape
