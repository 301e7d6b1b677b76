// A graph on the device with a pass that copies an image, and functions that fill and read its images.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <memory>

#include "gpu_test.h"
#include "graph/executor.h"
#include "vulkan/api.h"

namespace drape::graph {

using Plans = std::vector<std::pair<const Graph*, const Plan*>>;

inline constexpr std::uint32_t width = 70, height = 5;
inline constexpr std::size_t float_count = std::size_t{width} * height * 4;

inline VkBufferImageCopy whole_image() {
    VkBufferImageCopy region{};
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.imageExtent = {width, height, 1};
    return region;
}

struct GraphExecution : ::testing::Test {
    vulkan::ComputePipeline canary{test::gpu().device, "canary", {"canary.comp"}, {}};
    Graph graph;

    Handle image(const std::string& name, Lifetime lifetime) {
        return graph.image({.name = name, .width = width, .height = height, .lifetime = lifetime});
    }
    Handle buffer(const std::string& name, Lifetime lifetime) {
        return graph.buffer({.name = name, .byte_count = float_count * sizeof(float), .lifetime = lifetime});
    }

    void dispatch(PassContext& context) const { context.dispatch(canary, {}, width, height); }

    void copy(const std::string& name, const std::string& stage, Handle from, Handle& to) {
        graph.add_pass(
            {name, stage, name},
            [&](PassSetup& setup) {
                setup.read(from, Access::compute_read, "source");
                to = setup.write(to, Access::compute_write, "target");
            },
            [this](PassContext& context) { dispatch(context); });
    }

    void fill_from(Handle input, Handle& target) {
        auto written = std::make_shared<Handle>();
        graph.add_pass(
            {"fill", "input", "fill"},
            [&](PassSetup& setup) {
                setup.read(input, Access::transfer_read);
                *written = target = setup.write(target, Access::transfer_write);
            },
            [input, written](PassContext& context) {
                const VkBufferImageCopy region = whole_image();
                vkCmdCopyBufferToImage(context.commands(), context.buffer(input).handle(),
                                       context.image(*written).handle(), context.layout(*written), 1, &region);
            });
    }

    void read_back(const std::string& name, Handle source, Handle& target) {
        auto written = std::make_shared<Handle>();
        graph.add_pass(
            {name, "readback", name},
            [&](PassSetup& setup) {
                setup.read(source, Access::transfer_read);
                *written = target = setup.write(target, Access::transfer_write);
            },
            [source, written](PassContext& context) {
                const VkBufferImageCopy region = whole_image();
                vkCmdCopyImageToBuffer(context.commands(), context.image(source).handle(), context.layout(source),
                                       context.buffer(*written).handle(), 1, &region);
            });
    }

    static std::vector<float> pattern(int frame) {
        std::vector<float> values(float_count);
        for (std::size_t i = 0; i < values.size(); ++i) {
            values[i] = static_cast<float>(frame * 100000) + static_cast<float>(i);
        }
        return values;
    }
    static std::vector<float> values_of(const vulkan::Buffer& buffer) {
        std::vector<float> values(float_count);
        std::memcpy(values.data(), buffer.mapped().data(), buffer.mapped().size());
        return values;
    }
    static void set_values(const vulkan::Buffer& buffer, const std::vector<float>& values) {
        std::memcpy(buffer.mapped().data(), values.data(), buffer.mapped().size());
    }
    static void run_once(const RecordedPlan& recorded) {
        vulkan::FrameSlots slots(test::gpu().device);
        slots.submit(0, recorded.commands(0));
        slots.wait(0);
    }
};

}  // namespace drape::graph
