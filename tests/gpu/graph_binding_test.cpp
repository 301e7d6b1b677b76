// Everything that a pass binds, pushes and shares with its shader must fit, and every mistake is refused by name.
#include <gmock/gmock.h>

#include "graph_execution.h"

namespace drape::graph {
namespace {

using test::gpu;
using testing::AllOf;
using testing::HasSubstr;

struct BindingMistake {
    std::string name;
    std::function<void(PassSetup&, Handle good, Handle& target, Handle wrong_format, Handle buffer)> setup;
    std::vector<std::string> words;
};

class GraphBinding : public GraphExecution, public ::testing::WithParamInterface<BindingMistake> {};

TEST_P(GraphBinding, MistakeIsRefusedByName) {
    const Handle good = image("good", Lifetime::constant);
    Handle target = image("target", Lifetime::persistent);
    const Handle wrong_format = graph.image({.name = "wrong format",
                                             .format = VK_FORMAT_R32_SFLOAT,
                                             .width = width,
                                             .height = height,
                                             .lifetime = Lifetime::constant});
    const Handle some_buffer = buffer("buffer", Lifetime::constant);
    graph.add_pass(
        {"bad pass", "s", "bad"},
        [&](PassSetup& setup) { GetParam().setup(setup, good, target, wrong_format, some_buffer); },
        [this](PassContext& context) { dispatch(context); });
    const Plan plan = make_plan(graph);
    const ResourcePool pool(gpu().device, Plans{{&graph, &plan}});
    try {
        const RecordedPlan recorded(graph, plan, pool, TimestampMode::none);
        FAIL() << "not refused";
    } catch (const GraphError& error) {
        EXPECT_THAT(error.what(), AllOf(HasSubstr("'bad pass'"), HasSubstr("'canary'")));
        for (const std::string& word : GetParam().words) EXPECT_THAT(error.what(), HasSubstr(word));
    }
}

INSTANTIATE_TEST_SUITE_P(
    Mistakes, GraphBinding,
    ::testing::Values(BindingMistake{"VariableNotDeclared",
                                     [](PassSetup& setup, Handle, Handle& target, Handle, Handle) {
                                         target = setup.write(target, Access::compute_write, "target");
                                     },
                                     {"'source'", "nothing is bound"}},
                      BindingMistake{"VariableThePipelineLacks",
                                     [](PassSetup& setup, Handle good, Handle& target, Handle wrong_format, Handle) {
                                         setup.read(good, Access::compute_read, "source");
                                         target = setup.write(target, Access::compute_write, "target");
                                         setup.read(wrong_format, Access::compute_read, "mask");
                                     },
                                     {"'wrong format'", "'mask'", "no such variable"}},
                      BindingMistake{"ReadDeclaredWhereTheShaderWrites",
                                     [](PassSetup& setup, Handle good, Handle& target, Handle, Handle) {
                                         setup.read(good, Access::compute_read, "target");
                                         target = setup.write(target, Access::compute_write, "source");
                                     },
                                     {"'good'", "'target'", "writes"}},
                      BindingMistake{"WrongFormat",
                                     [](PassSetup& setup, Handle, Handle& target, Handle wrong_format, Handle) {
                                         setup.read(wrong_format, Access::compute_read, "source");
                                         target = setup.write(target, Access::compute_write, "target");
                                     },
                                     {"'wrong format'", "r32f", "rgba32f"}},
                      BindingMistake{"BufferForAnImage",
                                     [](PassSetup& setup, Handle, Handle& target, Handle, Handle some_buffer) {
                                         setup.read(some_buffer, Access::compute_read, "source");
                                         target = setup.write(target, Access::compute_write, "target");
                                     },
                                     {"'buffer'", "not an image"}}),
    [](const auto& parameter) { return parameter.param.name; });

TEST_F(GraphExecution, PushConstantsThatTheShaderLacksAreRefused) {
    const Handle a = image("a", Lifetime::constant);
    Handle b = image("b", Lifetime::persistent);
    graph.add_pass(
        {"pushes", "s", "pushes"},
        [&](PassSetup& setup) {
            setup.read(a, Access::compute_read, "source");
            b = setup.write(b, Access::compute_write, "target");
        },
        [this](PassContext& context) {
            context.dispatch(canary, glsl::vec2{1, 1}, width, height);
        });
    const Plan plan = make_plan(graph);
    const ResourcePool pool(gpu().device, Plans{{&graph, &plan}});
    EXPECT_THAT([&] { const RecordedPlan recorded(graph, plan, pool, TimestampMode::none); },
                testing::ThrowsMessage<GraphError>(AllOf(HasSubstr("'pushes'"), HasSubstr("'canary'"),
                                                         HasSubstr("vec2 in C++, but the shader has none"))));
}

/// Element of tests/gpu/shaders/interface.comp.
struct Element {
    glsl::vec4 position;
    float mass, age;
    glsl::ivec2 cell;
};
struct Push {
    glsl::ivec2 grid;
    float scale;
};
namespace wrong {
struct Element {
    glsl::vec4 position;
    float age;
    glsl::ivec2 cell;
    float mass;
};
struct Push {
    float scale;
    glsl::ivec2 grid;
};
}  // namespace wrong

struct GraphLayouts : GraphExecution {
    vulkan::ComputePipeline pipeline{
        gpu().device, "interface", {"interface.comp", test::test_shader("interface.comp")}, {}};

    /// Returns the error at recording a pass with these elements and push constants, empty when there is none.
    template <class Constants>
    std::string error(Handle elements, const Constants& push, bool texels = true) {
        Handle sums = graph.buffer<glsl::vec2>("sums", width * height, Lifetime::persistent);
        Handle flags = graph.buffer<glsl::uint>("flags", width * height, Lifetime::persistent);
        Handle target =
            graph.image({"target", VK_FORMAT_R32_SFLOAT, width, height, VK_SAMPLE_COUNT_1_BIT, Lifetime::persistent});
        const Handle source = image("source", Lifetime::constant);
        const Handle boxes = graph.buffer({.name = "boxes",
                                           .byte_count = width * height * sizeof(glsl::vec4),
                                           .lifetime = Lifetime::constant,
                                           .element = &glsl::layout_of<glsl::vec4>(),
                                           .texels = texels});
        graph.add_pass(
            {"pass", "s", "pass"},
            [&](PassSetup& setup) {
                setup.read(source, Access::compute_read, "source");
                target = setup.write(target, Access::compute_write, "target");
                setup.read(elements, Access::compute_read, "elements");
                setup.read(boxes, Access::compute_read, "boxes");
                setup.read(sums, Access::compute_read);
                sums = setup.write(sums, Access::compute_write, "sums");
                flags = setup.write(flags, Access::compute_write, "flags");
            },
            [this, push](PassContext& context) { context.dispatch(pipeline, push, width, height); });
        const Plan plan = make_plan(graph);
        const ResourcePool pool(gpu().device, Plans{{&graph, &plan}});
        try {
            const RecordedPlan recorded(graph, plan, pool, TimestampMode::none);
        } catch (const GraphError& refusal) {
            return refusal.what();
        }
        return {};
    }
    template <class T>
    Handle elements() {
        return graph.buffer<T>("elements", width * height, Lifetime::constant);
    }
};

TEST_F(GraphLayouts, SharedStructsAreAccepted) { EXPECT_EQ(error(elements<Element>(), Push{{1, 1}, 1}), ""); }

TEST_F(GraphLayouts, AnElementOfAnotherLayoutIsRefused) {
    EXPECT_THAT(error(elements<wrong::Element>(), Push{}),
                AllOf(HasSubstr("'pass'"), HasSubstr("'elements' of pipeline 'interface'"),
                      HasSubstr("the offset of Element.cell is 24 in the shader, 28 in C++")));
}

TEST_F(GraphLayouts, AnElementOfNoDeclaredTypeIsRefused) {
    EXPECT_THAT(error(buffer("elements", Lifetime::constant), Push{}), HasSubstr("without the type of its elements"));
}

TEST_F(GraphLayouts, TexelsOfABufferThatHasNoneAreRefused) {
    EXPECT_THAT(error(elements<Element>(), Push{}, false), HasSubstr("'boxes' is no buffer of texels"));
}

TEST_F(GraphLayouts, PushConstantsOfAnotherLayoutAreRefused) {
    EXPECT_THAT(error(elements<Element>(), wrong::Push{}),
                AllOf(HasSubstr("'push constants' of pipeline 'interface'"), HasSubstr("the offset of Push.scale")));
}

}  // namespace
}  // namespace drape::graph
