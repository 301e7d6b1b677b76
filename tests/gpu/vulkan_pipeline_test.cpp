// Pipelines are specialised, get push constants and rasterise, and a wrong one is refused when it is made.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <string>
#include <vector>

#include "gpu_test.h"
#include "vulkan/api.h"
#include "vulkan/descriptors.h"
#include "vulkan/pipeline.h"
#include "vulkan/resources.h"
#include "vulkan/structure.h"
#include "vulkan_error.h"

namespace drape::test {

using testing::AllOf;
using testing::HasSubstr;
using vulkan::Buffer;
using vulkan::ComputePipeline;
using vulkan::Descriptors;
using vulkan::GraphicsPipeline;
using vulkan::Image;
using vulkan::Shader;
using vulkan::SpecializationConstant;
using vulkan::structure;

namespace {

struct ScalePush {
    std::uint32_t count;
    float term;
};
Shader scale_shader() { return {"scale.comp", test_shader("scale.comp")}; }

std::string compute_error(const Shader& shader, std::vector<SpecializationConstant> constants = {}) {
    return error_of([&] { ComputePipeline(gpu().device, "broken", shader, constants); });
}

vulkan::GraphicsState triangle_state() {
    vulkan::GraphicsState state;
    state.vertex = {"triangle.vert", test_shader("triangle.vert")};
    state.fragment = {"triangle.frag", test_shader("triangle.frag")};
    state.constants = {{"red", std::bit_cast<std::uint32_t>(1.0f)}};
    return state;
}

/// A frame of 4 x 4 texels with one triangle over its left half, drawn by `pipeline`.
class TriangleFrame {
  public:
    static constexpr std::uint32_t side = 4;

    std::vector<std::uint32_t> draw(const GraphicsPipeline& pipeline) {
        // The triangle goes from far above to far below along x = -1, with a tip at x = 0: all of the left half within
        // the frame.
        constexpr std::array<float, 12> corners = {-1, -20, 0.5f, 0, -1, 20, 0.5f, 0, 0, 0, 0.5f, 0};
        upload(gpu().device, corners_, std::as_bytes(std::span(corners)));
        gpu().device.run_once([&](VkCommandBuffer commands) { record(commands, pipeline); });
        std::vector<std::uint32_t> texels(side * side);
        download(gpu().device, color_, std::as_writable_bytes(std::span(texels)));
        return texels;
    }

  private:
    void to_general(VkCommandBuffer commands, const Image& image) const {
        auto barrier = structure<VkImageMemoryBarrier2>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2);
        barrier.srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
        barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
        barrier.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
        barrier.newLayout = VK_IMAGE_LAYOUT_GENERAL;
        barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        barrier.image = image.handle();
        barrier.subresourceRange = {image.aspect(), 0, 1, 0, 1};
        auto dependency = structure<VkDependencyInfo>(VK_STRUCTURE_TYPE_DEPENDENCY_INFO);
        dependency.imageMemoryBarrierCount = 1;
        dependency.pImageMemoryBarriers = &barrier;
        vkCmdPipelineBarrier2(commands, &dependency);
    }

    static VkRenderingAttachmentInfo attachment(const Image& image, VkClearValue clear) {
        auto info = structure<VkRenderingAttachmentInfo>(VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO);
        info.imageView = image.view();
        info.imageLayout = VK_IMAGE_LAYOUT_GENERAL;
        info.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        info.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
        info.clearValue = clear;
        return info;
    }

    void record(VkCommandBuffer commands, const GraphicsPipeline& pipeline) const {
        to_general(commands, color_);
        to_general(commands, depth_);
        const VkRenderingAttachmentInfo color = attachment(color_, {.color = {{0, 0, 0, 1}}});
        const VkRenderingAttachmentInfo depth = attachment(depth_, {.depthStencil = {1, 0}});
        auto rendering = structure<VkRenderingInfo>(VK_STRUCTURE_TYPE_RENDERING_INFO);
        rendering.renderArea = {{0, 0}, {side, side}};
        rendering.layerCount = 1;
        rendering.colorAttachmentCount = 1;
        rendering.pColorAttachments = &color;
        rendering.pDepthAttachment = &depth;
        vkCmdBeginRendering(commands, &rendering);
        vkCmdBindPipeline(commands, pipeline.bind_point(), pipeline.handle());
        const VkViewport viewport{0, 0, side, side, 0, 1};
        vkCmdSetViewport(commands, 0, 1, &viewport);
        vkCmdSetScissor(commands, 0, 1, &rendering.renderArea);
        const VkDescriptorImageInfo image{VK_NULL_HANDLE, corners_.view(), VK_IMAGE_LAYOUT_GENERAL};
        auto write = structure<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
        write.descriptorCount = 1;
        write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
        write.pImageInfo = &image;
        descriptors_.bind(commands, pipeline, std::span(&write, 1));
        constexpr std::array<float, 4> tint = {0, 1, 0, 0};
        vkCmdPushConstants(commands, pipeline.layout(), pipeline.push_constant_stages(), 0,
                           pipeline.push_constants()->size, tint.data());
        vkCmdDraw(commands, 3, 1, 0, 0);
        vkCmdEndRendering(commands);
    }

    mutable Descriptors descriptors_{gpu().device};
    Image corners_{
        gpu().device,
        {"corners", VK_FORMAT_R32G32B32A32_SFLOAT, 3, 1, VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT}};
    Image color_{gpu().device,
                 {"color", VK_FORMAT_R8G8B8A8_SRGB, side, side,
                  VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT}};
    Image depth_{gpu().device,
                 {"depth", VK_FORMAT_D32_SFLOAT, side, side, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT}};
};

/// Returns the values that scale.comp makes of `source`.
std::vector<float> run_scale(const ComputePipeline& pipeline, const std::vector<float>& source, float term) {
    const vulkan::Device& device = gpu().device;
    constexpr VkBufferUsageFlags usage =
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    const std::uint64_t bytes = source.size() * sizeof(float);
    const Buffer from(device, {"from", bytes, usage}), to(device, {"to", bytes, usage});
    upload(device, from, std::as_bytes(std::span(source)));
    Descriptors descriptors(device);
    device.run_once([&](VkCommandBuffer commands) {
        vkCmdBindPipeline(commands, pipeline.bind_point(), pipeline.handle());
        const VkDescriptorBufferInfo buffers[] = {{from.handle(), 0, VK_WHOLE_SIZE}, {to.handle(), 0, VK_WHOLE_SIZE}};
        auto write = structure<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
        write.descriptorCount = 2;  // runs on from binding 0 into binding 1
        write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        write.pBufferInfo = buffers;
        descriptors.bind(commands, pipeline, std::span(&write, 1));
        const ScalePush push{static_cast<std::uint32_t>(source.size()), term};
        vkCmdPushConstants(commands, pipeline.layout(), pipeline.push_constant_stages(), 0, sizeof(push), &push);
        const std::uint32_t x = pipeline.local_size()[0];
        vkCmdDispatch(commands, (push.count + x - 1) / x, 1, 1);
    });
    std::vector<float> result(source.size());
    download(device, to, std::as_writable_bytes(std::span(result)));
    return result;
}

}  // namespace

TEST(VulkanComputePipeline, of_the_device_is_made_once_per_module_and_constants) {
    const vulkan::Device& device = gpu().device;
    const SpecializationConstant each[] = {{"strip_length", 16}}, others[] = {{"strip_length", 1}};
    const ComputePipeline& first = device.compute_pipeline("encode.comp", each);
    EXPECT_EQ(&device.compute_pipeline("encode.comp", each), &first);
    EXPECT_NE(device.compute_pipeline("encode.comp", others).handle(), first.handle());
    EXPECT_NE(device.compute_pipeline("encode.comp").handle(), first.handle());
    for (int attempt = 0; attempt < 2; ++attempt)
        EXPECT_THAT(error_of([&] { device.compute_pipeline("nowhere.comp"); }), HasSubstr("nowhere.comp"));
}

TEST(VulkanComputePipeline, specialises_constants_and_workgroup_size) {
    const SpecializationConstant constants[] = {{"factor", std::bit_cast<std::uint32_t>(2.5f)}, {"local_size_x", 16}};
    const ComputePipeline pipeline(gpu().device, "scale", scale_shader(), constants);
    EXPECT_EQ(pipeline.local_size(), (std::array<std::uint32_t, 3>{16, 1, 1}));
    EXPECT_EQ(run_scale(pipeline, {1, -2, 4, 0.5f, 8}, 0.25f),
              (std::vector<float>{16002.75f, 15995.25f, 16010.25f, 16001.5f, 16020.25f}));
}

TEST(VulkanComputePipeline, has_its_descriptors_sorted_and_its_push_constants) {
    const ComputePipeline pipeline(gpu().device, "scale", scale_shader(), {});
    ASSERT_EQ(pipeline.descriptors().size(), 2u);
    EXPECT_EQ(pipeline.descriptors()[0].name, "source");
    EXPECT_EQ(pipeline.descriptors()[1].name, "target");
    ASSERT_TRUE(pipeline.push_constants());
    EXPECT_EQ(pipeline.push_constants()->size, sizeof(ScalePush));
    EXPECT_EQ(pipeline.push_constant_stages(), VkShaderStageFlags{VK_SHADER_STAGE_COMPUTE_BIT});
    EXPECT_EQ(pipeline.name(), "scale");
    EXPECT_EQ(run_scale(pipeline, {3}, 1), (std::vector<float>{1004})) << "the shader's own defaults";
}

TEST(VulkanComputePipeline, has_no_descriptor_of_what_its_constants_leave_out) {
    const auto names = [](const ComputePipeline& pipeline) {
        std::vector<std::string> all;
        for (const vulkan::ReflectedDescriptor& each : pipeline.descriptors()) all.push_back(each.name);
        return all;
    };
    const vulkan::Device& device = gpu().device;
    const std::vector<SpecializationConstant> used{{"has_constants", 1}, {"has_present", 1}},
        idle{{"has_constants", 0}};
    for (const ComputePipeline* each :
         {&device.compute_pipeline("bend.comp"), &device.compute_pipeline("bend.comp", idle)})
        EXPECT_THAT(names(*each), testing::ElementsAre("position", "displacement_in", "displacement_out"));
    EXPECT_THAT(names(device.compute_pipeline("bend.comp", used)), testing::IsSupersetOf({"constants", "present"}));
}

TEST(VulkanComputePipeline, refuses_a_constant_that_the_shader_lacks) {
    EXPECT_THAT(compute_error(scale_shader(), {{"facter", 0}}),
                HasSubstr("pipeline broken: no shader has the specialization constant 'facter'"));
}

TEST(VulkanComputePipeline, refuses_a_workgroup_that_the_device_cannot_have) {
    EXPECT_THAT(compute_error(scale_shader(), {{"local_size_x", 1u << 20}}),
                HasSubstr("cannot have workgroups of 1048576 x 1 x 1"));
    EXPECT_THAT(compute_error(scale_shader(), {{"local_size_x", 0}}), HasSubstr("cannot have workgroups of 0 x 1 x 1"));
}

TEST(VulkanComputePipeline, refuses_another_stages_shader_and_unknown_modules) {
    EXPECT_THAT(compute_error(triangle_state().vertex),
                HasSubstr("shader module triangle.vert is a vertex shader, not a compute shader"));
    EXPECT_THAT(compute_error({"no such module"}), HasSubstr("there is no shader module \"no such module\""));
}

TEST(VulkanGraphicsPipeline, draws_what_the_vertex_image_says) {
    TriangleFrame frame;
    const GraphicsPipeline pipeline(gpu().device, "triangle", triangle_state());
    EXPECT_EQ(pipeline.push_constant_stages(), VkShaderStageFlags{VK_SHADER_STAGE_FRAGMENT_BIT});
    const std::vector<std::uint32_t> texels = frame.draw(pipeline);
    constexpr std::uint32_t yellow = 0xff00ffff, black = 0xff000000;  // red specialised, green pushed
    for (std::uint32_t i = 0; i < texels.size(); ++i) {
        EXPECT_EQ(texels[i], i % TriangleFrame::side < 2 ? yellow : black) << "texel " << i;
    }
}

TEST(VulkanGraphicsPipeline, can_have_no_fragment_stage_and_no_colour) {
    vulkan::GraphicsState state = triangle_state();
    state.fragment = {};
    state.constants = {};
    state.color_format = VK_FORMAT_UNDEFINED;
    const GraphicsPipeline pipeline(gpu().device, "shadow", state);
    EXPECT_NE(pipeline.handle(), VkPipeline{VK_NULL_HANDLE});
    EXPECT_FALSE(pipeline.push_constants());
}

TEST(VulkanGraphicsPipeline, refuses_constants_of_neither_stage_and_swapped_stages) {
    vulkan::GraphicsState state = triangle_state();
    state.constants.push_back({"blue", 1});
    EXPECT_THAT(error_of([&] { GraphicsPipeline(gpu().device, "triangle", state); }),
                HasSubstr("no shader has the specialization constant 'blue'"));
    state = triangle_state();
    std::swap(state.vertex, state.fragment);
    EXPECT_THAT(error_of([&] { GraphicsPipeline(gpu().device, "triangle", state); }),
                HasSubstr("triangle.frag is a fragment shader, not a vertex shader"));
}

TEST(VulkanGraphicsPipeline, refuses_more_between_its_stages_than_the_device_takes) {
    vulkan::GraphicsState state = triangle_state();
    state.vertex = {"varyings.vert", test_shader("varyings.vert")};
    EXPECT_THAT(
        error_of([&] { GraphicsPipeline(gpu().device, "triangle", state); }),
        HasSubstr("pipeline triangle: varyings.vert takes 276 components from vertices to fragments, the device"));
}

TEST(VulkanGraphicsPipeline, refuses_stages_that_contradict_each_other) {
    vulkan::GraphicsState state = triangle_state();
    state.fragment = {"contradiction.frag", test_shader("contradiction.frag")};
    state.constants = {};
    EXPECT_THAT(error_of([&] { GraphicsPipeline(gpu().device, "triangle", state); }),
                AllOf(HasSubstr("pipeline triangle: 'tints' at binding 0 of contradiction.frag is not the 'corners'")));
}

}  // namespace drape::test
