#include "device_run.h"

#include <fmt/format.h>

#include <algorithm>

#include "solver/host_inputs.h"
#include "solver/kernel_choice.h"
#include "solver/state_transfer.h"
#include "vulkan/api.h"
#include "vulkan/error.h"

namespace drape::test {

namespace {

std::string normal_buffer(const ClothModel& cloth) { return cloth.name + "/normals on the host"; }

void add_normal_readback(graph::Graph& graph, const ClothState& state) {
    const Grid& grid = state.model->grid;
    const graph::Handle empty =
        graph.buffer({normal_buffer(*state.model), grid.particle_count() * 16, graph::Lifetime::host_output});
    const auto target = std::make_shared<graph::Handle>();  // set by set-up, used when recorded
    graph.add_pass(
        state.pass_name("normal readback", "readback"),
        [&](graph::PassSetup& setup) {
            setup.read(state[Field::normal], graph::Access::transfer_read);
            *target = setup.write(empty, graph::Access::transfer_write);
        },
        [normal = state[Field::normal], target, &grid](graph::PassContext& context) {
            const VkBufferImageCopy region{
                0, 0, 0, {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1}, {}, {grid.columns(), grid.rows(), 1}};
            vkCmdCopyImageToBuffer(context.commands(), context.image(normal).handle(), VK_IMAGE_LAYOUT_GENERAL,
                                   context.buffer(*target).handle(), 1, &region);
        });
}

}  // namespace

DeviceRun::DeviceRun(const vulkan::Device& device, const SimulationModel& model, const graph::BarrierFilter& keep,
                     const Kernels& kernels, const FrameNeeds& needs)
    : device_(device), model_(model), solver_(device, model, kernels), slots_(device) {
    solver_.declare(graph_, needs);
    solver_.add_simulation(graph_);
    solver_.add_normals(graph_);
    for (const ClothState& state : solver_.cloths()) add_normal_readback(graph_, state);
    plan_ = graph::make_plan(graph_);
    const std::pair<const graph::Graph*, const graph::Plan*> plans[] = {{&graph_, &plan_}};
    pool_ = std::make_unique<graph::ResourcePool>(device, plans);
    recorded_ = std::make_unique<graph::RecordedPlan>(graph_, plan_, *pool_, graph::TimestampMode::none, keep);
    upload_start(solver_.layout(), *pool_);
}

void DeviceRun::run_frame(std::uint32_t frame) {
    write_inputs(solver_.layout(), *pool_, 0, frame, model_);
    slots_.submit(0, recorded_->commands(0));
    slots_.wait(0);
    state_.clear();
}

std::vector<std::byte> DeviceRun::bytes(std::size_t cloth, Field field) const {
    const ClothModel& model = model_.cloths[cloth];
    if (field == Field::normal) {
        const std::span<const std::byte> host = pool_->buffer(normal_buffer(model), 0).mapped();
        return {host.begin(), host.end()};
    }
    if (row_of(field).life == FieldLife::state) {
        if (state_.empty()) state_ = download_state(solver_.layout(), *pool_);
        return state_.at(resource_name(model, row_of(field)));
    }
    const vulkan::Image& image = pool_->image(resource_name(model, row_of(field)));
    const vulkan::ImageDescription& about = image.description();
    std::vector<std::byte> bytes(std::size_t{about.width} * about.height * row_of(field).element.size);
    vulkan::download(device_, image, bytes);
    return bytes;
}

std::vector<Kernels> kernel_sets(const vulkan::Device& device, const SimulationModel& model) {
    std::vector<Kernels> sets{{}};
    for (const Kernels& kernels : {Kernels{Kernel::buffer_store}, stream_kernels}) {
        try {
            const Kernels possible = possible_kernels(device, model, kernels);
            if (used_kernels(model, possible) != used_kernels(model, sets.back())) sets.push_back(possible);
        } catch (const vulkan::VulkanError&) {  // the device has not what they need
        }
    }
    return sets;
}

bool same_bits(const std::vector<glsl::vec4>& a, const std::vector<glsl::vec4>& b, std::string& where) {
    if (a.size() != b.size()) {
        where = fmt::format("{} against {} texels", a.size(), b.size());
        return false;
    }
    for (std::size_t i = 0; i < a.size(); ++i)
        if (std::memcmp(&a[i], &b[i], sizeof(glsl::vec4)) != 0) {
            where = fmt::format("texel {}: ({:.9g} {:.9g} {:.9g} {:.9g}) against ({:.9g} {:.9g} {:.9g} {:.9g})", i,
                                a[i].x, a[i].y, a[i].z, a[i].w, b[i].x, b[i].y, b[i].z, b[i].w);
            return false;
        }
    return true;
}

}  // namespace drape::test
