// An image and a buffer share memory: a read by one view sees a write by the other, the plan knows hazards across the
// views, and without its barriers the layer sees them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gpu_test.h"
#include "graph/executor.h"

namespace drape::graph {
namespace {

using test::gpu;
using testing::Contains;
using testing::HasSubstr;
using Plans = std::vector<std::pair<const Graph*, const Plan*>>;

constexpr std::uint32_t image_width = 70, image_height = 5;  // so that a row is no multiple of the device's pitch

struct RowsPush {
    glsl::ivec2 size;
    std::int32_t row_pitch;
};

struct BufferView : ::testing::Test {
    vulkan::ComputePipeline copy{gpu().device, "copy", {"canary.comp"}, {}};
    vulkan::ComputePipeline to_buffer{
        gpu().device, "to buffer", {"to_buffer.comp", test::test_shader("to_buffer.comp")}, {}};
    vulkan::ComputePipeline from_buffer{
        gpu().device, "from buffer", {"from_buffer.comp", test::test_shader("from_buffer.comp")}, {}};
    Graph graph;
    Handle source = image("source", Lifetime::persistent), result = image("result", Lifetime::persistent);

    void SetUp() override {
        const std::string obstacle =
            buffer_view_obstacle(gpu().device, {.name = "shared", .width = image_width, .height = image_height});
        if (!obstacle.empty()) GTEST_SKIP() << obstacle;
    }
    Handle image(const std::string& name, Lifetime lifetime, bool buffer_view = false) {
        return graph.image({.name = name,
                            .width = image_width,
                            .height = image_height,
                            .lifetime = lifetime,
                            .buffer_view = buffer_view});
    }
    /// Adds a pass that reads `from` as "source" and writes `to` as "target"; whichever has a buffer view is a buffer
    /// where the pipeline has one.
    void add(const vulkan::ComputePipeline& pipeline, Handle from, Handle& to, Handle shared) {
        graph.add_pass(
            {pipeline.name(), "s", pipeline.name()},
            [&](PassSetup& setup) {
                setup.read(from, Access::compute_read, "source");
                to = setup.write(to, Access::compute_write, "target");
            },
            [&pipeline, from, shared, written = to.resource](PassContext& context) {
                if (!pipeline.push_constants()) return context.dispatch(pipeline, {}, image_width, image_height);
                // The handle is the one that the pass declared: a write makes the next version.
                const Handle view = shared.resource == written ? Handle{shared.resource, shared.version + 1} : shared;
                const RowsPush push{{image_width, image_height}, static_cast<std::int32_t>(context.row_pitch(view))};
                context.dispatch(pipeline, push, image_width, image_height);
            });
    }
    static std::vector<float> texels() {
        std::vector<float> values(std::size_t{image_width} * image_height * 4);
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i) + 0.25f;
        return values;
    }
    /// Returns the result of one run, when `source` holds `texels`.
    std::vector<float> run() const {
        const Plan plan = make_plan(graph);
        const ResourcePool pool(gpu().device, Plans{{&graph, &plan}});
        const std::vector<float> start = texels();
        vulkan::upload(gpu().device, pool.image("source"), std::as_bytes(std::span(start)));
        const RecordedPlan recorded(graph, plan, pool, TimestampMode::none);
        vulkan::FrameSlots slots(gpu().device);
        for (int frame = 0; frame < 2; ++frame) {
            slots.submit(0, recorded.commands(0));
            slots.wait(0);
        }
        std::vector<float> received(texels().size());
        vulkan::download(gpu().device, pool.image("result"), std::as_writable_bytes(std::span(received)));
        return received;
    }
    /// Returns the layer's messages when the barriers before the last pass are left out.
    std::vector<std::string> messages_without_barrier() const {
        const Plan plan = make_plan(graph);
        const ResourcePool pool(gpu().device, Plans{{&graph, &plan}});
        { const RecordedPlan whole(graph, plan, pool, TimestampMode::none); }
        EXPECT_EQ(gpu().instance.validation_log().count(), 0u);
        const test::ExpectValidationMessages expected;
        const auto last = static_cast<std::uint32_t>(graph.passes().size() - 1);
        const RecordedPlan broken(graph, plan, pool, TimestampMode::none,
                                  [&](const PlannedPass& planned, const Barrier&) { return planned.pass != last; });
        return expected.messages();
    }
    void write_by_buffer_read_by_image(Lifetime lifetime) {
        Handle shared = image("shared", lifetime, true);
        add(to_buffer, source, shared, shared);
        add(copy, shared, result, {});
    }
    void write_by_image_read_by_buffer(Lifetime lifetime) {
        Handle shared = image("shared", lifetime, true);
        add(copy, source, shared, {});
        add(from_buffer, shared, result, shared);
    }
};

TEST_F(BufferView, WhatTheBufferWroteTheImageReads) {
    write_by_buffer_read_by_image(Lifetime::transient);
    std::vector<float> expected = texels();
    for (float& value : expected) value += 1;
    EXPECT_EQ(run(), expected);
}

TEST_F(BufferView, WhatTheImageWroteTheBufferReads) {
    write_by_image_read_by_buffer(Lifetime::persistent);
    EXPECT_EQ(run(), texels());
}

TEST_F(BufferView, OnePassReadsByTheImageAndWritesByTheBuffer) {
    Handle shared = image("shared", Lifetime::transient, true);
    add(copy, source, shared, {});
    for (int i = 0; i < 3; ++i) add(to_buffer, shared, shared, shared);
    add(copy, shared, result, {});
    std::vector<float> expected = texels();
    for (float& value : expected) value += 3;
    EXPECT_EQ(run(), expected);
}

TEST_F(BufferView, AMissingBarrierBetweenTheViewsIsReported) {
    if (!test::layer_sees_shared_memory()) GTEST_SKIP() << "the layer does not see hazards across views";
    write_by_buffer_read_by_image(Lifetime::persistent);
    EXPECT_THAT(messages_without_barrier(), Contains(HasSubstr("SYNC-HAZARD-READ-AFTER-WRITE")));
}

TEST_F(BufferView, AMissingBarrierTheOtherWayRoundIsReported) {
    if (!test::layer_sees_shared_memory()) GTEST_SKIP() << "the layer does not see hazards across views";
    write_by_image_read_by_buffer(Lifetime::transient);
    EXPECT_THAT(messages_without_barrier(), Contains(HasSubstr("SYNC-HAZARD-READ-AFTER-WRITE")));
}

TEST_F(BufferView, BytesAreThoseOfTheImageWithItsRowsApart) {
    const vulkan::Image shared(gpu().device, {.name = "shared",
                                              .width = image_width,
                                              .height = image_height,
                                              .usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                                              .buffer_view = true});
    EXPECT_GE(shared.row_pitch(), image_width);
    EXPECT_GE(shared.byte_count(), std::uint64_t{shared.row_pitch()} * image_height * 16);
    EXPECT_NE(shared.buffer(), VkBuffer{VK_NULL_HANDLE});
}

TEST_F(BufferView, AVariableOfOtherElementsIsRefused) {
    Handle shared = graph.image({.name = "narrow",
                                 .format = VK_FORMAT_R32_SFLOAT,
                                 .width = image_width,
                                 .height = image_height,
                                 .lifetime = Lifetime::persistent,
                                 .buffer_view = true});
    add(to_buffer, source, shared, shared);
    const Plan plan = make_plan(graph);
    const ResourcePool pool(gpu().device, Plans{{&graph, &plan}});
    EXPECT_THAT([&] { const RecordedPlan recorded(graph, plan, pool, TimestampMode::none); },
                testing::ThrowsMessage<GraphError>(HasSubstr("'narrow' is a buffer of r32f texels")));
}

TEST(BufferViewObstacle, SaysWhatTheDeviceLacks) {
    const std::uint32_t beyond = gpu().device.limits().maxImageDimension2D + 1;
    EXPECT_THAT(buffer_view_obstacle(gpu().device, {.name = "wide", .width = beyond}),
                HasSubstr("image wide (" + std::to_string(beyond) + " x 1): the device's limit is"));
    EXPECT_THAT(buffer_view_obstacle(gpu().device, {.name = "narrow", .width = 3, .height = 2}, 3),
                HasSubstr("texels apart, not 3"));
    EXPECT_THAT(buffer_view_obstacle(gpu().device, {.name = "samples", .samples = VK_SAMPLE_COUNT_4_BIT}),
                HasSubstr("samples"));
    EXPECT_THAT(buffer_view_obstacle(gpu().device, {.name = "srgb", .format = VK_FORMAT_R8G8B8A8_SRGB}),
                HasSubstr("LINEAR images of VkFormat"));
}

}  // namespace
}  // namespace drape::graph
