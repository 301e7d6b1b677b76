// A plan says what runs, which barriers stand where, and why.
#include "graph/plan.h"

#include <gtest/gtest.h>

#include <chrono>
#include <functional>

#include "hazard_checker.h"
#include "vulkan/error.h"
#include "vulkan/frame_slots.h"

namespace drape::graph {
namespace {

constexpr auto compute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
constexpr auto storage_read = VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
constexpr auto storage_write = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;

struct Planning : ::testing::Test {
    Graph graph;

    Handle image(const std::string& name, Lifetime lifetime = Lifetime::persistent) {
        return graph.image({.name = name, .width = 8, .height = 8, .lifetime = lifetime});
    }
    Handle buffer(const std::string& name, Lifetime lifetime) {
        return graph.buffer({.name = name, .byte_count = 64, .lifetime = lifetime});
    }
    void pass(const std::string& name, const std::function<void(PassSetup&)>& setup) {
        graph.add_pass({name, "simulate", name}, setup, {});
    }
    void write(const std::string& name, Handle& handle, Access access) {
        pass(name, [&](PassSetup& setup) { handle = setup.write(handle, access); });
    }
    /// Adds a pass that is always wanted, so that readers are not culled.
    void keep(const std::string& name, const std::function<void(PassSetup&)>& setup) {
        pass(name, [&](PassSetup& p) {
            setup(p);
            kept_ = p.write(kept_, Access::compute_write);
        });
    }
    static std::vector<Barrier> barriers_of(const Plan& plan, std::size_t pass, Handle handle) {
        std::vector<Barrier> found;
        for (const Barrier& barrier : plan.passes.at(pass).barriers) {
            if (barrier.resource == handle.resource) found.push_back(barrier);
        }
        return found;
    }

  private:
    Handle kept_ = graph.buffer({.name = "kept", .byte_count = 4, .lifetime = Lifetime::host_output});
};

TEST_F(Planning, ReadAfterWriteGetsABarrier) {
    Handle position = image("position");
    write("force", position, Access::compute_write);
    keep("normal", [&](PassSetup& p) { p.read(position, Access::vertex_read); });
    const auto barriers = barriers_of(make_plan(graph), 1, position);
    ASSERT_EQ(barriers.size(), 1u);
    EXPECT_EQ(barriers[0].source_stages, compute);
    EXPECT_EQ(barriers[0].source_accesses, storage_write);
    EXPECT_EQ(barriers[0].destination_stages, VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT);
    EXPECT_EQ(barriers[0].destination_accesses, storage_read);
    EXPECT_EQ(barriers[0].old_layout, barriers[0].new_layout);
    EXPECT_EQ(barriers[0].reason, "position: compute_write by force -> vertex_read by normal");
}

TEST_F(Planning, WriteAfterReadGetsAnExecutionBarrier) {
    Handle position = image("position");
    keep("normal", [&](PassSetup& p) { p.read(position, Access::vertex_read); });
    keep("copy", [&](PassSetup& p) { p.read(position, Access::transfer_read); });
    write("force", position, Access::compute_write);
    const auto barriers = barriers_of(make_plan(graph), 2, position);
    ASSERT_EQ(barriers.size(), 1u);
    EXPECT_EQ(barriers[0].source_stages, VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT);
    EXPECT_EQ(barriers[0].source_accesses, 0u) << "reads have nothing to make available";
    EXPECT_EQ(barriers[0].destination_stages, compute);
}

TEST_F(Planning, WriteAfterWriteGetsAMemoryBarrier) {
    Handle position = image("position");
    write("clear", position, Access::transfer_write);
    write("force", position, Access::compute_write);
    const auto barriers = barriers_of(make_plan(graph), 1, position);
    ASSERT_EQ(barriers.size(), 1u);
    EXPECT_EQ(barriers[0].source_stages, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT);
    EXPECT_EQ(barriers[0].source_accesses, VK_ACCESS_2_TRANSFER_WRITE_BIT);
    EXPECT_EQ(barriers[0].destination_accesses, storage_write);
}

TEST_F(Planning, ReadAfterReadGetsNone) {
    Handle position = image("position");
    write("force", position, Access::compute_write);
    keep("first", [&](PassSetup& p) { p.read(position, Access::compute_read); });
    keep("second", [&](PassSetup& p) { p.read(position, Access::compute_read); });
    const Plan plan = make_plan(graph);
    EXPECT_EQ(barriers_of(plan, 1, position).size(), 1u);
    EXPECT_TRUE(barriers_of(plan, 2, position).empty());
}

TEST_F(Planning, ReadAtAnotherStageGetsItsOwnBarrierFromTheWriter) {
    Handle position = image("position");
    write("force", position, Access::compute_write);
    keep("first", [&](PassSetup& p) { p.read(position, Access::compute_read); });
    keep("raster", [&](PassSetup& p) { p.read(position, Access::vertex_read); });
    const auto barriers = barriers_of(make_plan(graph), 2, position);
    ASSERT_EQ(barriers.size(), 1u);
    EXPECT_EQ(barriers[0].source_stages, compute);
    EXPECT_EQ(barriers[0].source_accesses, 0u) << "the first reader, at the writer's stage, made it available";
    EXPECT_EQ(barriers[0].destination_stages, VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT);
}

TEST_F(Planning, ReadModifyWriteChainGetsOneBarrierEach) {
    Handle position = image("position");
    for (int i = 0; i < 4; ++i) {
        pass("spring", [&](PassSetup& p) {
            p.read(position, Access::compute_read, "in");
            position = p.write(position, Access::compute_write, "out");
        });
    }
    const Plan plan = make_plan(graph);
    for (std::size_t p = 0; p < 4; ++p) {
        ASSERT_EQ(plan.passes[p].barriers.size(), 1u);
        EXPECT_EQ(plan.passes[p].barriers[0].destination_accesses, storage_read | storage_write);
    }
    EXPECT_TRUE(redundant_barriers(graph, plan).empty());
}

TEST_F(Planning, ImageWithABufferViewNeverChangesItsLayoutAndWaitsForAllMemory) {
    for (const Lifetime lifetime : {Lifetime::transient, Lifetime::persistent}) {
        const std::string name = "shared " + std::string(lifetime_name(lifetime));
        Handle shared = graph.image({.name = name, .lifetime = lifetime, .buffer_view = true});
        write("by buffer", shared, Access::compute_write);
        keep("by image of " + name, [&](PassSetup& p) { p.read(shared, Access::compute_read); });
        const Plan plan = make_plan(graph);
        std::size_t count = 0;
        for (const PlannedPass& planned : plan.passes)
            for (const Barrier& barrier : planned.barriers) {
                if (barrier.resource != shared.resource) continue;
                EXPECT_EQ(barrier.old_layout, VK_IMAGE_LAYOUT_GENERAL);
                EXPECT_EQ(barrier.new_layout, VK_IMAGE_LAYOUT_GENERAL) << "else it covers the image alone";
                ++count;
            }
        EXPECT_EQ(count, 2u);
    }
}

TEST_F(Planning, FirstUseWaitsForAllEarlierSubmissionsAtTheStartOfThePlan) {
    Handle position = image("position");
    Handle index = buffer("index", Lifetime::constant);
    write("force", position, Access::compute_write);
    keep("raster", [&](PassSetup& p) { p.read(index, Access::index_read); });
    const Plan plan = make_plan(graph);
    for (const Handle handle : {position, index}) {
        const auto barriers = barriers_of(plan, 0, handle);
        ASSERT_EQ(barriers.size(), 1u);
        EXPECT_EQ(barriers[0].source_stages, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT);
        EXPECT_TRUE(barriers[0].source_accesses & VK_ACCESS_2_MEMORY_WRITE_BIT);
    }
    EXPECT_EQ(barriers_of(plan, 0, index)[0].destination_stages, VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT);
    EXPECT_TRUE(barriers_of(plan, 1, index).empty());
}

TEST_F(Planning, HostInputNeedsNoBarrier) {
    const Handle frame = buffer("frame", Lifetime::host_input);
    keep("first", [&](PassSetup& p) { p.read(frame, Access::compute_read); });
    keep("second", [&](PassSetup& p) { p.read(frame, Access::vertex_read); });
    const Plan plan = make_plan(graph);
    EXPECT_TRUE(barriers_of(plan, 0, frame).empty());
    EXPECT_TRUE(barriers_of(plan, 1, frame).empty());
}

TEST_F(Planning, HostOutputIsMadeVisibleToTheHostAtTheEnd) {
    Handle result = buffer("result", Lifetime::host_output);
    write("readback", result, Access::transfer_write);
    const Plan plan = make_plan(graph);
    ASSERT_EQ(plan.final_barriers.size(), 1u);
    EXPECT_EQ(plan.final_barriers[0].source_accesses, VK_ACCESS_2_TRANSFER_WRITE_BIT);
    EXPECT_EQ(plan.final_barriers[0].destination_stages, VK_PIPELINE_STAGE_2_HOST_BIT);
    EXPECT_EQ(plan.final_barriers[0].destination_accesses, VK_ACCESS_2_HOST_READ_BIT);
}

TEST_F(Planning, AttachmentsAreTakenToTheirLayoutAndBackToGeneralForTheCopy) {
    Handle color = image("color", Lifetime::transient);
    write("raster", color, Access::color_write);
    keep("copy", [&](PassSetup& p) { p.read(color, Access::transfer_read); });
    const Plan plan = make_plan(graph);
    const auto before = barriers_of(plan, 0, color), after = barriers_of(plan, 1, color);
    ASSERT_EQ(before.size(), 1u);
    EXPECT_EQ(before[0].old_layout, VK_IMAGE_LAYOUT_UNDEFINED);
    EXPECT_EQ(before[0].new_layout, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    ASSERT_EQ(after.size(), 1u);
    EXPECT_EQ(after[0].old_layout, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    EXPECT_EQ(after[0].new_layout, VK_IMAGE_LAYOUT_GENERAL);
    EXPECT_EQ(after[0].source_accesses, VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT);
}

TEST_F(Planning, PersistentAttachmentRestsInGeneral) {
    Handle color = image("color");
    write("raster", color, Access::color_write);
    const Plan plan = make_plan(graph);
    EXPECT_EQ(barriers_of(plan, 0, color).at(0).old_layout, VK_IMAGE_LAYOUT_GENERAL);
    ASSERT_EQ(plan.final_barriers.size(), 1u);
    EXPECT_EQ(plan.final_barriers[0].new_layout, VK_IMAGE_LAYOUT_GENERAL);
}

TEST_F(Planning, StorageImagesNeverChangeLayout) {
    Handle position = image("position");
    write("clear", position, Access::transfer_write);
    write("force", position, Access::compute_write);
    keep("raster", [&](PassSetup& p) { p.read(position, Access::vertex_read); });
    keep("copy", [&](PassSetup& p) { p.read(position, Access::transfer_read); });
    for (const PlannedPass& planned : make_plan(graph).passes) {
        for (const Barrier& barrier : planned.barriers) EXPECT_EQ(barrier.old_layout, barrier.new_layout);
    }
}

TEST_F(Planning, CulledPassIsListedWithItsReason) {
    Handle position = image("position");
    Handle normal = image("normal", Lifetime::transient), shade = image("shade", Lifetime::transient);
    write("force", position, Access::compute_write);
    write("normals", normal, Access::compute_write);
    pass("shading", [&](PassSetup& p) {
        p.read(normal, Access::compute_read);
        shade = p.write(shade, Access::compute_write);
    });
    pass("idle", [&](PassSetup& p) { p.read(position, Access::compute_read); });
    graph.skip("wind", "no wind in the scene");
    const Plan plan = make_plan(graph);
    ASSERT_EQ(plan.passes.size(), 1u);
    ASSERT_EQ(plan.skipped.size(), 4u);
    EXPECT_EQ(plan.skipped[0].what, "wind");
    EXPECT_EQ(plan.skipped[1].what, "normals");
    EXPECT_EQ(plan.skipped[1].reason, "normal is read only by 'shading', which is skipped");
    EXPECT_EQ(plan.skipped[2].what, "shading");
    EXPECT_EQ(plan.skipped[2].reason, "nothing reads shade");
    EXPECT_EQ(plan.skipped[3].what, "idle");
    EXPECT_EQ(plan.skipped[3].reason, "writes nothing");
    EXPECT_FALSE(plan.lifespans[normal.resource].used());
    EXPECT_TRUE(plan.lifespans[position.resource].used());
}

TEST_F(Planning, PartialWriteKeepsItsPredecessor) {
    Handle scratch = image("scratch", Lifetime::transient);
    write("background", scratch, Access::compute_write);
    write("foreground", scratch, Access::compute_write);
    keep("copy", [&](PassSetup& p) { p.read(scratch, Access::transfer_read); });
    write("never read", scratch, Access::compute_write);
    const Plan plan = make_plan(graph);
    EXPECT_EQ(plan.passes.size(), 3u);
    ASSERT_EQ(plan.skipped.size(), 1u);
    EXPECT_EQ(plan.skipped[0].what, "never read");
}

TEST_F(Planning, EveryWriterOfPersistentStateAndHostOutputRuns) {
    Handle position = image("position");
    Handle result = buffer("result", Lifetime::host_output);
    write("force", position, Access::compute_write);
    write("spring", position, Access::compute_write);
    write("readback", result, Access::transfer_write);
    EXPECT_EQ(make_plan(graph).passes.size(), 3u);
}

TEST_F(Planning, ReadOfATransientNobodyWroteIsRefusedOnlyWhenWanted) {
    const Handle scratch = image("scratch", Lifetime::transient);
    pass("unwanted", [&](PassSetup& p) { p.read(scratch, Access::compute_read); });
    EXPECT_NO_THROW((void)make_plan(graph));
    keep("wanted", [&](PassSetup& p) { p.read(scratch, Access::compute_read); });
    try {
        (void)make_plan(graph);
        FAIL() << "not refused";
    } catch (const GraphError& error) {
        EXPECT_NE(std::string(error.what()).find("'wanted', resource 'scratch'"), std::string::npos) << error.what();
    }
}

TEST_F(Planning, BytesCountUsedResourcesAndCopiesPerSlot) {
    Handle position = image("position");
    const Handle frame = buffer("frame", Lifetime::host_input);
    (void)image("unused");
    keep("force", [&](PassSetup& p) {
        p.read(frame, Access::compute_read);
        position = p.write(position, Access::compute_write);
    });
    EXPECT_EQ(make_plan(graph).byte_count, 8u * 8 * 16 + (64 + 4) * vulkan::frame_slot_count);
}

TEST_F(Planning, SumPastSixtyFourBitsIsRefused) {
    for (int i = 0; i < 2; ++i) {
        Handle huge = graph.buffer({.name = "huge " + std::to_string(i),
                                    .byte_count = (~0ull >> 1) & ~3ull,
                                    .lifetime = Lifetime::persistent});
        write("fill", huge, Access::compute_write);
    }
    EXPECT_NO_THROW((void)make_plan(graph));
    Handle last = graph.buffer({.name = "last", .byte_count = 64, .lifetime = Lifetime::persistent});
    write("fill", last, Access::compute_write);
    EXPECT_THROW((void)make_plan(graph), vulkan::VulkanError);
}

TEST_F(Planning, TwentyThousandPassesPlanCorrectly) {
    Handle position = image("position"), displacement = image("displacement");
    const Handle frame = buffer("frame", Lifetime::host_input);
    for (int i = 0; i < 10000; ++i) {
        pass("force", [&](PassSetup& p) {
            p.read(frame, Access::compute_read);
            p.read(position, Access::compute_read);
            displacement = p.write(displacement, Access::compute_write);
        });
        pass("spring", [&](PassSetup& p) {
            p.read(displacement, Access::compute_read);
            p.read(position, Access::compute_read);
            position = p.write(position, Access::compute_write);
        });
    }
    const auto begin = std::chrono::steady_clock::now();
    const Plan plan = make_plan(graph);
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - begin;
    RecordProperty("milliseconds", std::to_string(time.count()));
    ASSERT_EQ(plan.passes.size(), 20000u);
    for (std::size_t p = 2; p < plan.passes.size(); ++p) {
        // Either pass reads what the pass before wrote, and writes what the pass before read.
        ASSERT_EQ(plan.passes[p].barriers.size(), 2u) << p;
        EXPECT_EQ(plan.passes[p].barriers[0].source_accesses, storage_write);
        EXPECT_EQ(plan.passes[p].barriers[1].source_accesses, 0u);
    }
    EXPECT_EQ(plan.lifespans[position.resource].last, 19999u);
    EXPECT_EQ(plan.lifespans[displacement.resource].first, 0u);
}

}  // namespace
}  // namespace drape::graph
