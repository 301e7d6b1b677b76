// Dumps are for people: they fold substeps, list resources, and give reasons.
#include <gtest/gtest.h>
#include <json/json.h>

#include <memory>

#include "graph/plan.h"

namespace drape::graph {
namespace {

struct Dumping : ::testing::Test {
    Graph graph;
    Plan plan;

    void SetUp() override {
        Handle position =
            graph.image({.name = "banner/position", .width = 96, .height = 64, .lifetime = Lifetime::persistent});
        Handle normal = graph.image({.name = "banner/normal", .width = 96, .height = 64});
        const Handle frame = graph.buffer({.name = "frame", .byte_count = 256, .lifetime = Lifetime::host_input});
        for (int substep = 0; substep < 20; ++substep) {
            const std::string number = " (substep " + std::to_string(substep) + ")";
            for (const std::string label : {"force", "spring row even", "spring row odd"}) {
                graph.add_pass({label + number, "simulate", label},
                               [&](PassSetup& p) {
                                   p.read(frame, Access::compute_read, "frame");
                                   p.read(position, Access::compute_read, "position_in");
                                   position = p.write(position, Access::compute_write, "position_out");
                               },
                               {});
            }
            graph.add_pass({"normal" + number, "simulate", "normal"},
                           [&](PassSetup& p) { normal = p.write(normal, Access::compute_write, "normal"); }, {});
        }
        graph.skip("wind \"gust\"", "the scene has none");
        graph.compromise("banner/stiffness", "half of it");
        plan = make_plan(graph);
    }
    std::size_t count(const std::string& text, const std::string& word) const {
        std::size_t found = 0;
        for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++found;
        return found;
    }
};

TEST_F(Dumping, TextFoldsSubstepsAndGivesReasons) {
    const std::string text = dump(graph, plan, "text");
    EXPECT_EQ(count(text, "x 20 {"), 1u) << text;
    EXPECT_EQ(count(text, "spring row even"), 1u) << text;
    EXPECT_EQ(count(text, "passes: 60 of 80"), 1u) << text;
    EXPECT_EQ(count(text, "image rgba32f 96x64"), 2u) << text;
    EXPECT_EQ(count(text, "x 2 slots"), 1u) << text;
    EXPECT_EQ(count(text, "not made:\n  banner/normal"), 1u) << text;
    EXPECT_EQ(count(text, "  normal x 20: nothing reads banner/normal\n"), 1u) << text;
    EXPECT_EQ(count(text, "  wind \"gust\": the scene has none\n"), 1u) << text;
    EXPECT_EQ(count(text, "compromised:\n  banner/stiffness: half of it\n"), 1u) << text;
}

TEST_F(Dumping, JsonListsEverythingUnfolded) {
    Json::Value root;
    std::string errors;
    const std::string text = dump(graph, plan, "json");
    const std::unique_ptr<Json::CharReader> reader(Json::CharReaderBuilder().newCharReader());
    ASSERT_TRUE(reader->parse(text.data(), text.data() + text.size(), &root, &errors)) << errors;
    EXPECT_EQ(root["passes"].size(), 60u);
    EXPECT_EQ(root["skipped"].size(), 21u);
    ASSERT_EQ(root["compromises"].size(), 1u);
    EXPECT_EQ(root["compromises"][0]["reason"], "half of it");
    EXPECT_EQ(root["byte_count"].asUInt64(), plan.byte_count);
    EXPECT_EQ(root["passes"][1]["uses"][2]["access"], "compute_write");
    EXPECT_EQ(root["passes"][1]["uses"][2]["version"], 2);
    EXPECT_EQ(root["passes"][1]["barriers"][0]["source_stages"][0], "compute_shader");
    EXPECT_TRUE(root["resources"][0]["exists"].asBool());
    EXPECT_FALSE(root["resources"][1]["exists"].asBool());
}

TEST_F(Dumping, DotFoldsAndQuotes) {
    const std::string text = dump(graph, plan, "dot");
    EXPECT_EQ(count(text, "label=\"x 20\""), 1u) << text;
    EXPECT_EQ(count(text, "label=\"spring row even\""), 1u) << text;
    EXPECT_EQ(count(text, "pass0 -> pass1 [label=\"banner/position\"]"), 1u) << text;
    EXPECT_EQ(count(text, "pass2 -> pass0 [label=\"banner/position\", style=dashed"), 1u) << text;
    EXPECT_EQ(count(text, "wind \\\"gust\\\""), 1u) << text;
    EXPECT_EQ(count(text, "half of it"), 1u) << text;
    EXPECT_EQ(count(text, "  skipped ["), 1u) << "one note, below each other: " << text;
    EXPECT_EQ(count(text, "\\l"), 5u) << text;
    EXPECT_EQ(count(text, "{"), count(text, "}"));
}

TEST_F(Dumping, DumpsAreDeterministic) {
    for (const std::string format : {"text", "json", "dot"}) {
        EXPECT_EQ(dump(graph, plan, format), dump(graph, make_plan(graph), format)) << format;
    }
}

TEST_F(Dumping, BufferViewsAreTold) {
    const Handle shared = graph.image({.name = "shared", .lifetime = Lifetime::persistent, .buffer_view = true});
    graph.add_pass({"fill", "s", "fill"}, [&](PassSetup& p) { (void)p.write(shared, Access::compute_write); }, {});
    plan = make_plan(graph);
    EXPECT_EQ(count(dump(graph, plan, "text"), "image rgba32f 1x1, buffer view"), 1u);
    EXPECT_EQ(count(dump(graph, plan, "json"), "\"buffer_view\" : true"), 1u);
}

TEST_F(Dumping, UnknownFormatIsRefused) { EXPECT_THROW((void)dump(graph, plan, "xml"), GraphError); }

}  // namespace
}  // namespace drape::graph
