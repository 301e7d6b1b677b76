// A graph is built with versioned handles, and mistakes are refused by name.
#include "graph/graph.h"

#include <gtest/gtest.h>

#include <functional>

#include "vulkan/error.h"

namespace drape::graph {
namespace {

struct GraphBuilding : ::testing::Test {
    Graph graph;
    Handle image = graph.image({.name = "cloth/position", .lifetime = Lifetime::persistent});
    Handle buffer = graph.buffer({.name = "flags", .byte_count = 16});

    void pass(const std::string& name, const std::function<void(PassSetup&)>& setup) {
        graph.add_pass({name, "simulate", name}, setup, {});
    }

    /// Requires that the pass is refused with a text that contains every word.
    void expect_refused(const std::function<void(PassSetup&)>& setup, const std::vector<std::string>& words) {
        try {
            pass("bad pass", setup);
        } catch (const GraphError& error) {
            for (const std::string& word : words) {
                EXPECT_NE(std::string(error.what()).find(word), std::string::npos)
                    << "'" << word << "' is missing in: " << error.what();
            }
            return;
        }
        FAIL() << "not refused; expected: " << words.back();
    }
};

TEST_F(GraphBuilding, WritingReturnsTheNextVersion) {
    Handle written;
    pass("force", [&](PassSetup& setup) { written = setup.write(image, Access::compute_write, "position"); });
    EXPECT_EQ(written, (Handle{image.resource, 1}));
    EXPECT_EQ(graph.resources()[image.resource].version, 1u);
    ASSERT_EQ(graph.passes().size(), 1u);
    EXPECT_EQ(graph.passes()[0].uses.at(0).handle, written);
}

TEST_F(GraphBuilding, ReadingThenWritingOneResourceIsAReadModifyWrite) {
    pass("spring", [&](PassSetup& setup) {
        setup.read(image, Access::compute_read, "in");
        image = setup.write(image, Access::compute_write, "out");
    });
    EXPECT_EQ(graph.passes()[0].uses.size(), 2u);
    EXPECT_EQ(image.version, 1u);
}

TEST_F(GraphBuilding, StaleHandleIsRefusedNamingPassAndResource) {
    const Handle stale = image;
    pass("force", [&](PassSetup& setup) { image = setup.write(image, Access::compute_write); });
    expect_refused([&](PassSetup& setup) { setup.read(stale, Access::compute_read); },
                   {"bad pass", "cloth/position", "read of a stale handle", "version 0", "newest is 1"});
    expect_refused([&](PassSetup& setup) { (void)setup.write(stale, Access::compute_write); },
                   {"bad pass", "cloth/position", "write of a stale handle"});
}

TEST_F(GraphBuilding, ReadAfterOwnWriteIsRefused) {
    expect_refused(
        [&](PassSetup& setup) {
            (void)setup.write(image, Access::compute_write);
            setup.read(image, Access::compute_read);
        },
        {"bad pass", "cloth/position", "read after this pass wrote it"});
    expect_refused(
        [&](PassSetup& setup) { setup.read(setup.write(image, Access::compute_write), Access::compute_read); },
        {"bad pass", "cloth/position", "read after this pass wrote it"});
}

TEST_F(GraphBuilding, SecondWriteInOnePassIsRefused) {
    expect_refused(
        [&](PassSetup& setup) { (void)setup.write(setup.write(image, Access::compute_write), Access::transfer_write); },
        {"bad pass", "cloth/position", "written twice"});
    expect_refused(
        [&](PassSetup& setup) {
            (void)setup.write(image, Access::compute_write);
            (void)setup.write(image, Access::compute_write);
        },
        {"bad pass", "cloth/position", "written twice"});
}

TEST_F(GraphBuilding, WriteToConstantOrHostInputIsRefused) {
    const Handle mask = graph.image({.name = "mask", .lifetime = Lifetime::constant});
    const Handle frame = graph.buffer({.name = "frame", .byte_count = 64, .lifetime = Lifetime::host_input});
    expect_refused([&](PassSetup& setup) { (void)setup.write(mask, Access::compute_write); },
                   {"bad pass", "mask", "constant"});
    expect_refused([&](PassSetup& setup) { (void)setup.write(frame, Access::transfer_write); },
                   {"bad pass", "frame", "host_input"});
}

TEST_F(GraphBuilding, AccessThatDoesNotFitTheKindIsRefused) {
    const Handle depth = graph.image({.name = "depth", .format = VK_FORMAT_D32_SFLOAT});
    const Handle samples = graph.image({.name = "samples", .samples = VK_SAMPLE_COUNT_4_BIT});
    expect_refused([&](PassSetup& setup) { (void)setup.write(buffer, Access::color_write); },
                   {"bad pass", "flags", "color_write"});
    expect_refused([&](PassSetup& setup) { setup.read(image, Access::index_read); },
                   {"bad pass", "cloth/position", "index_read"});
    expect_refused([&](PassSetup& setup) { setup.read(image, Access::indirect_read); },
                   {"bad pass", "cloth/position", "indirect_read"});
    expect_refused([&](PassSetup& setup) { setup.read(image, Access::host_read); },
                   {"bad pass", "cloth/position", "host_read"});
    expect_refused([&](PassSetup& setup) { setup.read(buffer, Access::host_read); }, {"flags", "host_output"});
    expect_refused([&](PassSetup& setup) { (void)setup.write(image, Access::depth_write); },
                   {"cloth/position", "no depth format"});
    expect_refused([&](PassSetup& setup) { setup.read(depth, Access::compute_read); }, {"depth", "depth format"});
    expect_refused([&](PassSetup& setup) { (void)setup.write(samples, Access::compute_write); },
                   {"samples", "written as an attachment"});
    expect_refused([&](PassSetup& setup) { (void)setup.write(samples, Access::resolve_write); },
                   {"samples", "one sample"});
}

TEST_F(GraphBuilding, ReadWithAWritingAccessAndTheReverseAreRefused) {
    expect_refused([&](PassSetup& setup) { setup.read(image, Access::compute_write); },
                   {"bad pass", "cloth/position", "which writes"});
    expect_refused([&](PassSetup& setup) { (void)setup.write(image, Access::compute_read); },
                   {"bad pass", "cloth/position", "which only reads"});
}

TEST_F(GraphBuilding, UnknownHandleIsRefused) {
    expect_refused([&](PassSetup& setup) { setup.read(Handle{}, Access::compute_read); },
                   {"bad pass", "names no resource"});
    expect_refused(
        [&](PassSetup& setup) {
            setup.read(Handle{99, 0}, Access::compute_read);
        },
        {"bad pass", "unknown handle"});
    expect_refused(
        [&](PassSetup& setup) {
            setup.read(Handle{image.resource, 5}, Access::compute_read);
        },
        {"bad pass", "cloth/position", "unknown version 5"});
}

TEST_F(GraphBuilding, VariableUsedTwiceIsRefusedNamingBothResources) {
    expect_refused(
        [&](PassSetup& setup) {
            setup.read(image, Access::compute_read, "in");
            setup.read(buffer, Access::compute_read, "in");
        },
        {"bad pass", "flags", "variable 'in'", "cloth/position"});
    expect_refused(
        [&](PassSetup& setup) {
            setup.read(image, Access::compute_read, "in");
            (void)setup.write(image, Access::compute_write, "in");
        },
        {"bad pass", "cloth/position", "variable 'in'"});
}

TEST_F(GraphBuilding, OneVersionMayBeReadByTwoVariables) {
    pass("collision", [&](PassSetup& setup) {
        setup.read(buffer, Access::compute_read, "spheres");
        setup.read(buffer, Access::compute_read, "boxes");
    });
    EXPECT_EQ(graph.passes()[0].uses.size(), 2u);
}

TEST_F(GraphBuilding, VariableOfADrawOrTransferIsRefused) {
    expect_refused([&](PassSetup& setup) { setup.read(image, Access::transfer_read, "source"); },
                   {"bad pass", "cloth/position", "transfer_read takes no variable", "'source'"});
    expect_refused([&](PassSetup& setup) { setup.read(image, Access::vertex_read, "position"); },
                   {"bad pass", "cloth/position", "vertex_read takes no variable"});
}

TEST_F(GraphBuilding, TwoLayoutsInOnePassAreRefused) {
    expect_refused(
        [&](PassSetup& setup) {
            setup.read(image, Access::fragment_read);
            (void)setup.write(image, Access::color_write);
        },
        {"bad pass", "cloth/position", "two layouts"});
}

TEST_F(GraphBuilding, RefusedPassLeavesTheGraphAsItWas) {
    expect_refused(
        [&](PassSetup& setup) {
            (void)setup.write(image, Access::compute_write);
            setup.read(Handle{99, 0}, Access::compute_read);
        },
        {"unknown handle"});
    EXPECT_TRUE(graph.passes().empty());
    EXPECT_EQ(graph.resources()[image.resource].version, 0u);
    pass("good", [&](PassSetup& setup) { setup.read(image, Access::compute_read); });
    EXPECT_EQ(graph.passes().size(), 1u);
}

TEST_F(GraphBuilding, DuplicateNameIsRefused) {
    try {
        graph.buffer({.name = "cloth/position", .byte_count = 4});
        FAIL() << "not refused";
    } catch (const GraphError& error) {
        EXPECT_NE(std::string(error.what()).find("cloth/position"), std::string::npos);
    }
}

TEST_F(GraphBuilding, DeclarationsThatDoNotFitAreRefused) {
    EXPECT_THROW(graph.image({.name = "empty", .width = 0}), GraphError);
    EXPECT_THROW(graph.image({.name = "in", .lifetime = Lifetime::host_input}), GraphError);
    EXPECT_THROW(graph.image({.name = "out", .lifetime = Lifetime::host_output}), GraphError);
    EXPECT_THROW(graph.buffer({.name = "none", .byte_count = 0}), GraphError);
    EXPECT_THROW(graph.buffer({.name = "odd", .byte_count = 6}), GraphError);
    EXPECT_THROW(graph.buffer({.name = "", .byte_count = 4}), GraphError);
    EXPECT_THROW(graph.buffer<glsl::vec4>("no elements", 0, Lifetime::persistent), GraphError);
}

TEST_F(GraphBuilding, ABufferViewNeedsAPlainImageThatIsNoAttachment) {
    EXPECT_THROW(graph.image({.name = "depth", .format = VK_FORMAT_D32_SFLOAT, .buffer_view = true}), GraphError);
    EXPECT_THROW(graph.image({.name = "samples", .samples = VK_SAMPLE_COUNT_4_BIT, .buffer_view = true}), GraphError);
    const Handle shared = graph.image({.name = "shared", .buffer_view = true});
    expect_refused([&](PassSetup& setup) { (void)setup.write(shared, Access::color_write); },
                   {"bad pass", "shared", "stays in GENERAL"});
    pass("good", [&](PassSetup& setup) { (void)setup.write(shared, Access::compute_write, "texels"); });
}

TEST_F(GraphBuilding, ASliceIsABandOfRowsAndAUseOfTheWhole) {
    const Handle whole = graph.image(
        {.name = "two", .width = 5, .height = 6, .buffer_view = true, .slices = {"one/position", "other/position"}});
    Handle other{whole.resource, whole.version, 1};
    const Resource& resource = graph.resources()[whole.resource];
    EXPECT_EQ(resource.seen(other).name, "other/position");
    EXPECT_EQ(resource.seen(other).height, 3u);
    EXPECT_EQ(resource.byte_count(other), 5u * 3 * 16);
    EXPECT_EQ(resource.byte_count(whole), 5u * 6 * 16);
    pass("good", [&](PassSetup& setup) { other = setup.write(other, Access::compute_write, "texels"); });
    EXPECT_EQ(other, (Handle{whole.resource, 1, 1}));
    expect_refused([&](PassSetup& setup) { setup.read(whole, Access::compute_read); }, {"two", "stale"});
    expect_refused(
        [&](PassSetup& setup) {
            setup.read({whole.resource, 1, 2}, Access::compute_read);
        },
        {"bad pass", "two", "slice 2, it has 2"});
}

TEST_F(GraphBuilding, SlicesThatDoNotFitAreRefused) {
    const auto slices = [&](std::uint32_t height, std::vector<std::string> names) {
        graph.image({.name = "sliced", .height = height, .slices = std::move(names)});
    };
    EXPECT_THROW(slices(5, {"a", "b"}), GraphError);
    EXPECT_THROW(slices(6, {"a", "flags"}), GraphError) << "there is a resource of this name";
    EXPECT_NO_THROW(slices(6, {"a", "b"}));
}

TEST_F(GraphBuilding, SizesAreCheckedIn64Bits) {
    const Handle large = graph.image({.name = "large", .width = 1u << 20, .height = 1u << 20});
    EXPECT_EQ(graph.resources()[large.resource].byte_count(), std::uint64_t{1} << 44);
    const Handle huge = graph.image({.name = "huge", .width = UINT32_MAX, .height = UINT32_MAX});
    EXPECT_THROW((void)graph.resources()[huge.resource].byte_count(), vulkan::VulkanError);
}

}  // namespace
}  // namespace drape::graph
