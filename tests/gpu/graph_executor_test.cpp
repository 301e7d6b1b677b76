// Plans run on a device: contents, layouts, slots, timings, refusals, and the planted hazard that must be seen.
#include <gmock/gmock.h>

#include <array>

#include "graph_execution.h"
#include "vulkan/structure.h"

namespace drape::graph {
namespace {

using test::gpu;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

TEST_F(GraphExecution, CarriesContentsThroughPassesFramesAndSlots) {
    Handle state = image("state", Lifetime::persistent), previous = image("previous", Lifetime::persistent);
    Handle staged = image("staged", Lifetime::transient), between = image("between", Lifetime::transient);
    const Handle input = buffer("input", Lifetime::host_input);
    Handle now = buffer("now", Lifetime::host_output), before = buffer("before", Lifetime::host_output);
    copy("keep the previous", "simulate", state, previous);
    fill_from(input, staged);
    copy("first copy", "simulate", staged, between);
    copy("second copy", "simulate", between, staged);
    copy("third copy", "simulate", staged, state);
    read_back("read now", state, now);
    read_back("read before", previous, before);
    const Plan plan = make_plan(graph);
    const ResourcePool pool(gpu().device, Plans{{&graph, &plan}});
    const RecordedPlan recorded(graph, plan, pool, TimestampMode::stages);
    vulkan::FrameSlots slots(gpu().device);
    constexpr int frame_count = 5;
    const auto check_frame = [&](int frame) {
        const auto slot = static_cast<std::uint32_t>(frame % 2);
        EXPECT_EQ(values_of(pool.buffer("now", slot)), pattern(frame)) << "frame " << frame;
        EXPECT_EQ(values_of(pool.buffer("before", slot)),
                  frame > 1 ? pattern(frame - 1) : std::vector<float>(float_count))
            << "frame " << frame << " (persistent images start zeroed)";
    };
    for (int frame = 1; frame <= frame_count; ++frame) {
        const auto slot = static_cast<std::uint32_t>(frame % 2);
        slots.wait(slot);
        if (frame > 2) check_frame(frame - 2);
        set_values(pool.buffer("input", slot), pattern(frame));
        slots.submit(slot, recorded.commands(slot));
    }
    for (int frame = frame_count - 1; frame <= frame_count; ++frame) {
        slots.wait(static_cast<std::uint32_t>(frame % 2));
        check_frame(frame);
    }
    std::vector<float> downloaded(float_count);
    vulkan::download(gpu().device, pool.image("state"), std::as_writable_bytes(std::span(downloaded)));
    EXPECT_EQ(downloaded, pattern(frame_count));
    EXPECT_EQ(gpu().instance.validation_log().count(), 0u);
}

TEST_F(GraphExecution, EveryMissingBarrierOfAChainIsReported) {
    Handle a = image("a", Lifetime::persistent), b = image("b", Lifetime::persistent);
    Handle c = image("c", Lifetime::persistent);
    copy("a to b", "s", a, b);
    copy("b to c", "s", b, c);
    copy("c to a", "s", c, a);
    const Plan plan = make_plan(graph);
    const ResourcePool pool(gpu().device, Plans{{&graph, &plan}});
    { const RecordedPlan whole(graph, plan, pool, TimestampMode::none); }
    ASSERT_EQ(gpu().instance.validation_log().count(), 0u);
    // The third pass has two barriers, c just written and a read by the first pass, merged into one memory barrier, so
    // each is planted by dropping all of its pass.
    for (const std::uint32_t pass : {1u, 2u}) {
        const test::ExpectValidationMessages expected;
        const RecordedPlan broken(graph, plan, pool, TimestampMode::none,
                                  [&](const PlannedPass& planned, const Barrier&) { return planned.pass != pass; });
        EXPECT_THAT(expected.messages(), Contains(HasSubstr("SYNC-HAZARD-READ-AFTER-WRITE"))) << pass;
    }
}

TEST_F(GraphExecution, MissingWriteAfterReadBarrierIsReported) {
    Handle a = image("a", Lifetime::persistent), b = image("b", Lifetime::persistent);
    const Handle c = image("c", Lifetime::constant);
    copy("a to b", "s", a, b);
    copy("c to a", "s", c, a);
    const Plan plan = make_plan(graph);
    const ResourcePool pool(gpu().device, Plans{{&graph, &plan}});
    const test::ExpectValidationMessages expected;
    const RecordedPlan broken(graph, plan, pool, TimestampMode::none,
                              [&](const PlannedPass& planned, const Barrier&) { return planned.pass != 1; });
    EXPECT_THAT(expected.messages(), Contains(HasSubstr("SYNC-HAZARD-WRITE-AFTER-READ")));
}

TEST_F(GraphExecution, AttachmentsKeepTheirContentsBetweenPlansAndComeBackToGeneral) {
    Handle color = image("color", Lifetime::persistent);
    Handle result = buffer("result", Lifetime::host_output);
    read_back("read old", color, result);
    auto drawn = std::make_shared<Handle>();
    graph.add_pass(
        {"clear", "raster", "clear"},
        [&](PassSetup& setup) { *drawn = color = setup.write(color, Access::color_write); },
        [drawn](PassContext& context) {
            auto attachment = vulkan::structure<VkRenderingAttachmentInfo>(VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO);
            attachment.imageView = context.image(*drawn).view();
            attachment.imageLayout = context.layout(*drawn);
            attachment.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
            attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
            attachment.clearValue.color = {{7, 7, 7, 7}};
            auto rendering = vulkan::structure<VkRenderingInfo>(VK_STRUCTURE_TYPE_RENDERING_INFO);
            rendering.renderArea.extent = {width, height};
            rendering.layerCount = 1;
            rendering.colorAttachmentCount = 1;
            rendering.pColorAttachments = &attachment;
            vkCmdBeginRendering(context.commands(), &rendering);
            vkCmdEndRendering(context.commands());
        });
    const Plan plan = make_plan(graph);
    const ResourcePool pool(gpu().device, Plans{{&graph, &plan}});
    const RecordedPlan recorded(graph, plan, pool, TimestampMode::none);
    run_once(recorded);
    EXPECT_EQ(values_of(pool.buffer("result")), std::vector<float>(float_count, 0.0f));
    run_once(recorded);
    EXPECT_EQ(values_of(pool.buffer("result")), std::vector<float>(float_count, 7.0f));
    std::vector<float> rested(float_count);
    vulkan::download(gpu().device, pool.image("color"), std::as_writable_bytes(std::span(rested)));
    EXPECT_EQ(rested, std::vector<float>(float_count, 7.0f));
    EXPECT_EQ(gpu().instance.validation_log().count(), 0u);
}

TEST_F(GraphExecution, TwoPlansShareTheirResources) {
    const Handle input = buffer("input", Lifetime::host_input);
    Handle state = image("state", Lifetime::persistent);
    Handle staged = image("staged", Lifetime::transient);
    fill_from(input, staged);
    copy("to state", "simulate", staged, state);
    const Graph simulation = std::exchange(graph, {});
    const Handle same_state = image("state", Lifetime::persistent);
    Handle result = buffer("result", Lifetime::host_output);
    read_back("read", same_state, result);
    const Plan simulate = make_plan(simulation), show = make_plan(graph);
    const ResourcePool pool(gpu().device, Plans{{&simulation, &simulate}, {&graph, &show}});
    const RecordedPlan first(simulation, simulate, pool, TimestampMode::none);
    const RecordedPlan second(graph, show, pool, TimestampMode::none);
    for (int frame = 1; frame <= 2; ++frame) {
        set_values(pool.buffer("input"), pattern(frame));
        run_once(first);
        run_once(second);
        EXPECT_EQ(values_of(pool.buffer("result")), pattern(frame));
    }
}

TEST_F(GraphExecution, UndeclaredAccessIsRefusedNamingPassAndResource) {
    Handle a = image("a", Lifetime::persistent), b = image("b", Lifetime::persistent);
    const Handle old = a;
    copy("b to a", "s", b, a);
    const auto record_with = [&](Handle handle) {
        Graph other = graph;
        other.add_pass(
            {"sly pass", "s", "sly"},
            [&](PassSetup& setup) {
                b = setup.write(Handle{b.resource, 0}, Access::compute_write);
            },
            [handle](PassContext& context) { (void)context.image(handle); });
        const Plan plan = make_plan(other);
        const ResourcePool pool(gpu().device, Plans{{&other, &plan}});
        const RecordedPlan recorded(other, plan, pool, TimestampMode::none);
    };
    EXPECT_THAT([&] { record_with(a); },
                testing::ThrowsMessage<GraphError>(AllOf(HasSubstr("'sly pass'"), HasSubstr("'a'"))));
    EXPECT_THAT([&] { record_with(old); },
                testing::ThrowsMessage<GraphError>(AllOf(HasSubstr("'a'"), HasSubstr("version 0"))));
    EXPECT_THAT([&] { record_with(Handle{}); }, testing::ThrowsMessage<GraphError>(HasSubstr("'sly pass'")));
    EXPECT_NO_THROW(record_with(Handle{b.resource, 1}));
}

TEST_F(GraphExecution, TimingsAreSummedByStageOrByLabel) {
    Handle a = image("a", Lifetime::persistent), b = image("b", Lifetime::persistent);
    copy("forth", "simulate", a, b);
    copy("back", "collide", b, a);
    copy("forth", "simulate", a, b);
    const Plan plan = make_plan(graph);
    const ResourcePool pool(gpu().device, Plans{{&graph, &plan}});
    const auto names_of = [&](TimestampMode mode) {
        const RecordedPlan recorded(graph, plan, pool, mode);
        EXPECT_TRUE(recorded.timings(0).empty()) << "before the first submit";
        run_once(recorded);
        std::vector<std::string> names;
        for (const Timing& timing : recorded.timings(0)) {
            names.push_back(timing.name);
            EXPECT_GT(timing.milliseconds, 0) << timing.name;
            EXPECT_LT(timing.milliseconds, 10000) << timing.name;
        }
        EXPECT_TRUE(recorded.timings(1).empty()) << "slot 1 was never submitted";
        return names;
    };
    if (gpu().device.capabilities().timestamp_valid_bits == 0) GTEST_SKIP() << "the device has no timestamps";
    EXPECT_THAT(names_of(TimestampMode::stages), testing::ElementsAre("simulate", "collide"));
    EXPECT_THAT(names_of(TimestampMode::passes), testing::ElementsAre("forth", "back"));
    EXPECT_THAT(names_of(TimestampMode::none), testing::IsEmpty());
}

TEST_F(GraphExecution, ResourceThatNoPlanUsesDoesNotExist) {
    Handle used = image("used", Lifetime::persistent), unread = image("unread", Lifetime::transient);
    (void)image("untouched", Lifetime::persistent);
    const Handle source = image("source", Lifetime::constant);
    copy("to used", "s", source, used);
    copy("to unread", "s", source, unread);
    const Plan plan = make_plan(graph);
    const std::uint64_t before = gpu().device.budget().used();
    const ResourcePool pool(gpu().device, Plans{{&graph, &plan}});
    EXPECT_TRUE(pool.has("used"));
    EXPECT_TRUE(pool.has("source"));
    for (const char* name : {"unread", "untouched"}) {
        EXPECT_FALSE(pool.has(name));
        EXPECT_THAT([&] { (void)pool.image(name); }, testing::ThrowsMessage<GraphError>(HasSubstr(name)));
    }
    EXPECT_GE(gpu().device.budget().used() - before, plan.byte_count);
    EXPECT_LT(gpu().device.budget().used() - before, 2 * plan.byte_count);
}

TEST_F(GraphExecution, DifferentDeclarationsOfOneNameAreRefused) {
    Handle one = image("shared", Lifetime::persistent);
    const Handle source = image("source", Lifetime::constant);
    copy("copy", "s", source, one);
    Graph other;
    (void)other.image({.name = "shared", .width = width + 1, .height = height, .lifetime = Lifetime::persistent});
    const Plan plan = make_plan(graph), other_plan = make_plan(other);
    const Plans plans{{&graph, &plan}, {&other, &other_plan}};
    EXPECT_THAT([&] { const ResourcePool pool(gpu().device, plans); },
                testing::ThrowsMessage<GraphError>(HasSubstr("'shared'")));
}

TEST_F(GraphExecution, BudgetIsCheckedForAllTogetherBeforeAnythingIsMade) {
    const std::uint64_t half = gpu().device.budget().limit() / 2 & ~std::uint64_t{3};
    Handle first = graph.buffer({.name = "first", .byte_count = half, .lifetime = Lifetime::persistent});
    Handle second = graph.buffer({.name = "second", .byte_count = half + 64, .lifetime = Lifetime::persistent});
    graph.add_pass({"fill", "s", "fill"},
                   [&](PassSetup& setup) {
                       first = setup.write(first, Access::transfer_write);
                       second = setup.write(second, Access::transfer_write);
                   },
                   {});
    const Plan plan = make_plan(graph);
    const std::uint64_t before = gpu().device.budget().used();
    EXPECT_THAT(
        [&] {
            const ResourcePool pool(gpu().device, Plans{{&graph, &plan}});
        },
        testing::ThrowsMessage<vulkan::VulkanError>(HasSubstr("the 2 images and buffers")));
    EXPECT_EQ(gpu().device.budget().used(), before);
}

}  // namespace
}  // namespace drape::graph
