// make_plan is tested against the brute-force checker, and the checker against planted faults.
#include <gtest/gtest.h>

#include "hazard_checker.h"
#include "random_graph.h"

namespace drape::graph {
namespace {

constexpr std::uint32_t graph_count = 400;

std::string report(const std::vector<Hazard>& hazards) {
    std::string text;
    for (const Hazard& hazard : hazards) text += hazard.text() + "\n";
    return text;
}

bool clean_when_run_twice(const Graph& graph, const Plan& plan, const std::string& only = {}) {
    const Execution executions[] = {{&graph, &plan}, {&graph, &plan}};
    return find_hazards(executions, only).empty();
}

TEST(RandomPlans, HaveNoHazardInThreeConsecutiveExecutions) {
    std::size_t barriers = 0, culled = 0;
    for (std::uint32_t seed = 0; seed < graph_count; ++seed) {
        const Graph graph = RandomGraphs(seed).make(1 + seed % 25);
        const Plan plan = make_plan(graph);
        const Execution executions[] = {{&graph, &plan}, {&graph, &plan}, {&graph, &plan}};
        const auto hazards = find_hazards(executions);
        ASSERT_TRUE(hazards.empty()) << "seed " << seed << "\n" << report(hazards) << dump(graph, plan, "text");
        barriers += barrier_places(plan).size();
        culled += plan.skipped.size();
    }
    // Simpler graphs would prove nothing.
    EXPECT_GT(barriers, 10u * graph_count);
    EXPECT_GT(culled, graph_count);
}

TEST(RandomPlans, HaveNoHazardWhenTwoPlansOfTheSameResourcesAlternate) {
    for (std::uint32_t seed = 0; seed < graph_count; ++seed) {
        RandomGraphs graphs(seed);
        const Graph one = graphs.make(1 + seed % 12), other = graphs.make(1 + seed % 7);
        const Plan first = make_plan(one), second = make_plan(other);
        const Execution executions[] = {{&one, &first}, {&other, &second}, {&one, &first}, {&one, &first}};
        const auto hazards = find_hazards(executions);
        ASSERT_TRUE(hazards.empty()) << "seed " << seed << "\n" << report(hazards);
    }
}

TEST(RandomPlans, NeedEveryBarrierTheyHave) {
    for (std::uint32_t seed = 0; seed < graph_count; ++seed) {
        const Graph graph = RandomGraphs(seed).make(1 + seed % 25);
        Plan plan = make_plan(graph);
        for (const BarrierPlace place : redundant_barriers(graph, plan)) {
            ADD_FAILURE() << "seed " << seed << ": " << barrier_at(plan, place).reason;
        }
    }
}

/// Takes away every single flag, but for two at the source of entry barriers: MEMORY_READ, which orders nothing, and
/// MEMORY_WRITE for resources that live within a plan, which this very plan may need or not (another might).
std::vector<std::function<void(Barrier&)>> weakenings(const Barrier& barrier, Lifetime lifetime) {
    VkAccessFlags2 unneeded = VK_ACCESS_2_MEMORY_READ_BIT;
    if (lifetime != Lifetime::persistent && lifetime != Lifetime::constant) {
        unneeded |= VK_ACCESS_2_MEMORY_WRITE_BIT;
    }
    std::vector<std::function<void(Barrier&)>> list;
    const auto each = [&](VkFlags64 flags, VkFlags64 Barrier::*member) {
        for (; flags != 0; flags &= flags - 1) {
            const VkFlags64 flag = flags & (~flags + 1);
            list.push_back([=](Barrier& b) { b.*member &= ~flag; });
        }
    };
    each(barrier.source_stages, &Barrier::source_stages);
    each(barrier.destination_stages, &Barrier::destination_stages);
    each(barrier.source_accesses & ~unneeded, &Barrier::source_accesses);
    each(barrier.destination_accesses, &Barrier::destination_accesses);
    return list;
}

TEST(RandomPlans, NeedEveryFlagOfEveryBarrier) {
    std::size_t checked = 0;
    for (std::uint32_t seed = 0; seed < graph_count; seed += 2) {
        const Graph graph = RandomGraphs(seed).make(1 + seed % 17);
        const Plan plan = make_plan(graph);
        Plan weaker = plan;
        for (const BarrierPlace place : barrier_places(plan)) {
            const Barrier whole = barrier_at(weaker, place);
            const Resource& resource = graph.resources()[whole.resource];
            for (const auto& weaken : weakenings(whole, resource.lifetime)) {
                weaken(barrier_at(weaker, place));
                const Barrier weak = barrier_at(weaker, place);
                EXPECT_FALSE(clean_when_run_twice(graph, weaker, resource.name))
                    << "seed " << seed << ": " << whole.reason << std::hex << "\n source stages " << whole.source_stages
                    << " -> " << weak.source_stages << ", accesses " << whole.source_accesses << " -> "
                    << weak.source_accesses << "\n destination stages " << whole.destination_stages << " -> "
                    << weak.destination_stages << ", accesses " << whole.destination_accesses << " -> "
                    << weak.destination_accesses;
                barrier_at(weaker, place) = whole;
                ++checked;
            }
        }
    }
    EXPECT_GT(checked, 5000u);
}

TEST(RandomPlans, NeedEveryLayoutChange) {
    std::size_t checked = 0;
    for (std::uint32_t seed = 0; seed < graph_count; ++seed) {
        const Graph graph = RandomGraphs(seed).make(1 + seed % 17);
        const Plan plan = make_plan(graph);
        for (const BarrierPlace place : barrier_places(plan)) {
            Plan weaker = plan;
            Barrier& barrier = barrier_at(weaker, place);
            if (barrier.old_layout == barrier.new_layout) continue;
            barrier.new_layout = barrier.old_layout;
            EXPECT_FALSE(clean_when_run_twice(graph, weaker)) << "seed " << seed << ": " << barrier.reason;
            ++checked;
        }
    }
    EXPECT_GT(checked, graph_count);
}

/// The checker's own claims are tested on plans written by hand.
struct HazardChecker : ::testing::Test {
    Graph graph;
    Handle color = graph.image({.name = "color", .lifetime = Lifetime::persistent});

    void pass(const std::string& name, Access access) {
        graph.add_pass({name, "stage", name},
                       [&](PassSetup& setup) {
                           if (is_write(access)) {
                               color = setup.write(color, access);
                           } else {
                               setup.read(color, access);
                           }
                       },
                       {});
    }
    Plan bare_plan() const {
        Plan plan;
        for (std::uint32_t p = 0; p < graph.passes().size(); ++p) plan.passes.push_back({p, {}});
        return plan;
    }
    Barrier barrier(Access earlier, Access later) const {
        const AccessScope source = access_scope(earlier), destination = access_scope(later);
        return {color.resource,       source.stages,           destination.stages,      source.accesses,
                destination.accesses, VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_LAYOUT_GENERAL, "by hand"};
    }
    std::vector<Hazard> check(const Plan& plan) const {
        const Execution executions[] = {{&graph, &plan}};
        return find_hazards(executions);
    }
};

TEST_F(HazardChecker, NamesResourceAndBothPasses) {
    pass("fill", Access::transfer_write);
    pass("use", Access::compute_read);
    Plan plan = bare_plan();
    plan.passes[0].barriers = {barrier(Access::transfer_write, Access::transfer_write)};
    const auto hazards = check(plan);
    ASSERT_EQ(hazards.size(), 2u) << report(hazards);
    EXPECT_EQ(hazards[0].text(), "color: set-up -> use: no execution dependency");
    EXPECT_EQ(hazards[1].text(), "color: fill -> use: no execution dependency");
}

TEST_F(HazardChecker, DistinguishesExecutionFromVisibility) {
    pass("use", Access::compute_read);
    Plan plan = bare_plan();
    plan.passes[0].barriers = {barrier(Access::transfer_write, Access::compute_read)};
    EXPECT_TRUE(check(plan).empty()) << report(check(plan));
    plan.passes[0].barriers[0].source_accesses = 0;
    ASSERT_EQ(check(plan).size(), 1u);
    EXPECT_EQ(check(plan)[0].problem, "not made visible");
}

TEST_F(HazardChecker, FollowsChainsOfBarriers) {
    pass("vertex", Access::vertex_read);
    pass("fragment", Access::fragment_read);
    Plan plan = bare_plan();
    plan.passes[0].barriers = {barrier(Access::transfer_write, Access::vertex_read)};
    plan.passes[1].barriers = {barrier(Access::vertex_read, Access::fragment_read)};
    EXPECT_TRUE(check(plan).empty()) << report(check(plan));
    plan.passes[1].barriers[0].source_stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    EXPECT_EQ(check(plan).size(), 1u) << "the chain is broken";
}

TEST_F(HazardChecker, ReportsWrongLayoutsAndLostContents) {
    pass("draw", Access::color_write);
    Plan plan = make_plan(graph);
    EXPECT_TRUE(check(plan).empty()) << report(check(plan));
    Plan discarded = plan;
    discarded.passes[0].barriers[0].old_layout = VK_IMAGE_LAYOUT_UNDEFINED;
    ASSERT_EQ(check(discarded).size(), 1u);
    EXPECT_EQ(check(discarded)[0].problem, "changed from a layout it is not in");
    Plan unrested = plan;
    unrested.final_barriers.clear();
    ASSERT_EQ(check(unrested).size(), 1u);
    EXPECT_EQ(check(unrested)[0].problem, "does not rest in GENERAL");
}

TEST_F(HazardChecker, ReportsALayoutChangeUnderABufferView) {
    color = graph.image({.name = "shared", .lifetime = Lifetime::persistent, .buffer_view = true});
    pass("fill", Access::compute_write);
    Plan plan = make_plan(graph);
    EXPECT_TRUE(check(plan).empty()) << report(check(plan));
    plan.passes[0].barriers[0].old_layout = VK_IMAGE_LAYOUT_UNDEFINED;
    ASSERT_FALSE(check(plan).empty());
    EXPECT_EQ(check(plan).back().problem, "changed under a buffer view");
}

TEST_F(HazardChecker, CountsARepeatedDependencyAsRedundant) {
    pass("force", Access::compute_write);
    Plan plan = make_plan(graph);
    EXPECT_TRUE(redundant_barriers(graph, plan).empty());
    plan.passes[0].barriers.push_back(plan.passes[0].barriers[0]);
    EXPECT_EQ(redundant_barriers(graph, plan).size(), 2u) << "either of the two can go";
}

TEST_F(HazardChecker, AcceptsAHostReadDeclaredByAPass) {
    Handle result = graph.buffer({.name = "result", .byte_count = 4, .lifetime = Lifetime::host_output});
    graph.add_pass({"reduce", "s", "reduce"},
                   [&](PassSetup& setup) { result = setup.write(result, Access::compute_write); }, {});
    graph.add_pass({"report", "s", "report"}, [&](PassSetup& setup) { setup.read(result, Access::host_read); }, {});
    const Plan plan = make_plan(graph);
    EXPECT_EQ(plan.passes.size(), 2u) << "the host's read is wanted";
    EXPECT_TRUE(plan.final_barriers.empty()) << "already visible to the host";
    EXPECT_TRUE(clean_when_run_twice(graph, plan)) << report(check(plan));
}

}  // namespace
}  // namespace drape::graph
