// Reflection reads a module whole, and every kind of difference from a C++ struct is found and named.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "gpu_test.h"
#include "shared/raster_types.h"
#include "spirv_modules.h"
#include "vulkan/pipeline.h"
#include "vulkan/reflection.h"

namespace drape::test {

using glsl::layout_of;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using vulkan::DescriptorKind;
using vulkan::ReflectedDescriptor;
using vulkan::ReflectedModule;
using vulkan::VulkanError;

namespace {

/// Element of interface.comp.
struct Element {
    glsl::vec4 position;
    float mass, age;
    glsl::ivec2 cell;
};
struct Push {
    glsl::ivec2 grid;
    float scale;
};

namespace moved {
struct Element {
    glsl::vec4 position;
    glsl::ivec2 cell;
    float mass, age;
};
struct Push {
    glsl::ivec2 grid;
    glsl::vec2 unused;
    float scale;
};
}  // namespace moved

namespace shifted {
struct Element {
    glsl::vec4 position;
    glsl::vec2 mass;
    float age;
    std::int32_t cell;
};
struct Push {
    float scale;
    glsl::ivec2 grid;
};
}  // namespace shifted

namespace other {
struct Element {
    glsl::vec4 position;
    float mass, age;
    std::int32_t column, row;
};
struct alignas(16) Push {
    glsl::ivec2 grid;
    float scale;
};
}  // namespace other

struct Particle {
    glsl::vec4 position;
    float mass, age;
    glsl::ivec2 cell;
};

const ReflectedModule& interface_module() {
    static const ReflectedModule module = vulkan::reflect(test_shader("interface.comp"), "interface.comp");
    return module;
}

const ReflectedDescriptor& descriptor(std::string_view name) {
    const auto found = std::ranges::find(interface_module().descriptors, name, &ReflectedDescriptor::name);
    if (found == interface_module().descriptors.end()) throw std::logic_error("no such descriptor");
    return *found;
}

template <class T>
std::string element_difference(std::string_view name) {
    return vulkan::element_difference(descriptor(name), layout_of<T>());
}

template <class T>
std::string push_difference() {
    return vulkan::push_constant_difference(interface_module().push_constants, &layout_of<T>());
}

}  // namespace

TEST(VulkanReflection, reads_every_descriptor_that_is_used) {
    // Binding 7 is declared in the GLSL and never used; only statically used ones count.
    EXPECT_EQ(interface_module().descriptors.size(), 6u);
    const auto image = [](std::string_view name, std::uint32_t binding, bool readable, bool writable, VkFormat format,
                          DescriptorKind kind = DescriptorKind::storage_image) {
        const ReflectedDescriptor& it = descriptor(name);
        EXPECT_EQ(it.binding, binding) << name;
        EXPECT_EQ(it.kind, kind) << name;
        EXPECT_EQ(it.readable, readable) << name;
        EXPECT_EQ(it.writable, writable) << name;
        EXPECT_EQ(it.format, format) << name;
        EXPECT_EQ(it.stages, VkShaderStageFlags{VK_SHADER_STAGE_COMPUTE_BIT}) << name;
    };
    image("source", 0, true, false, VK_FORMAT_R32G32B32A32_SFLOAT);
    image("target", 1, false, true, VK_FORMAT_R32_SFLOAT);
    image("boxes", 5, true, false, VK_FORMAT_R32G32B32A32_SFLOAT, DescriptorKind::texel_buffer);
    const auto buffer = [](std::string_view name, std::uint32_t binding, bool readable, bool writable,
                           std::uint32_t stride) {
        const ReflectedDescriptor& it = descriptor(name);
        EXPECT_EQ(it.binding, binding) << name;
        EXPECT_EQ(it.kind, DescriptorKind::storage_buffer) << name;
        EXPECT_TRUE(it.is_runtime_array) << name;
        EXPECT_EQ(it.readable, readable) << name;
        EXPECT_EQ(it.writable, writable) << name;
        EXPECT_EQ(it.stride, stride) << name;
    };
    buffer("elements", 2, true, false, 32);
    buffer("sums", 3, true, true, 8);
    buffer("flags", 4, false, true, 4);
}

TEST(VulkanReflection, reads_constants_by_name_and_the_workgroups_size) {
    EXPECT_EQ(interface_module().local_size, (std::array<std::uint32_t, 3>{8, 4, 1}));
    const ReflectedModule scale = vulkan::reflect(test_shader("scale.comp"), "scale.comp");
    EXPECT_THAT(scale.constants,
                testing::UnorderedElementsAre(testing::Pair("factor", 5u), testing::Pair("local_size_x", 3u)));
}

TEST(VulkanReflection, counts_locations_from_vertices_to_fragments) {
    EXPECT_EQ(vulkan::reflect(test_shader("varyings.vert"), "varyings.vert").varying_locations, 69u);
    EXPECT_EQ(vulkan::reflect(test_shader("triangle.vert"), "triangle.vert").varying_locations, 0u);
    const ReflectedModule cloth = vulkan::reflect(vulkan::spirv_module("cloth.frag"), "cloth.frag");
    EXPECT_EQ(cloth.varying_locations, 14u + 2 * glsl::light_limit);
    EXPECT_EQ(interface_module().varying_locations, 0u);
}

TEST(VulkanReflection, a_struct_is_known_by_its_type_alone) {
    EXPECT_EQ(layout_of<Element>().name, "Element");
    EXPECT_EQ(layout_of<Element>().size, 32u);
    EXPECT_THAT(layout_of<Element>().offsets, ElementsAre(0, 16, 20, 24));
    EXPECT_THAT(layout_of<glsl::FrameConstants>().offsets,
                ElementsAre(0, 64, 112, 128, 144, 160, 176, 192, 256, 320, 336))
        << "arrays";
    EXPECT_THAT(layout_of<glsl::vec4>().offsets, ElementsAre());
    EXPECT_THAT(layout_of<std::uint32_t>().offsets, ElementsAre());
}

TEST(VulkanReflection, equal_layouts_are_accepted) {
    EXPECT_EQ(element_difference<Element>("elements"), "");
    EXPECT_EQ(element_difference<glsl::vec2>("sums"), "");
    EXPECT_EQ(element_difference<glsl::uint>("flags"), "");
    EXPECT_EQ(push_difference<Push>(), "");
}

TEST(VulkanReflection, a_member_that_moved_is_named) {
    EXPECT_EQ(element_difference<shifted::Element>("elements"),
              "the offset of Element.age is 20 in the shader, 24 in C++");
    EXPECT_EQ(element_difference<moved::Element>("elements"),
              "the offset of Element.age is 20 in the shader, 24 in C++");
    EXPECT_EQ(push_difference<shifted::Push>(), "the offset of Push.scale is 8 in the shader, 4 in C++");
}

TEST(VulkanReflection, another_name_or_number_of_members_is_named) {
    EXPECT_EQ(element_difference<Particle>("elements"), "struct Element in the shader, Particle in C++");
    EXPECT_EQ(element_difference<other::Element>("elements"), "Element has 4 members in the shader, 5 in C++");
}

TEST(VulkanReflection, another_stride_is_named) {
    EXPECT_EQ(element_difference<glsl::vec4>("sums"), "the array's stride is 8 in the shader, 16 in C++");
    EXPECT_EQ(element_difference<Push>("elements"), "the array's stride is 32 in the shader, 12 in C++");
}

TEST(VulkanReflection, a_struct_for_a_scalar_is_named_both_ways) {
    EXPECT_EQ(element_difference<glsl::vec4>("elements"), "struct Element in the shader, vec4 in C++");
    EXPECT_EQ(element_difference<Element>("sums"), "a scalar or vector in the shader, Element in C++");
}

TEST(VulkanReflection, other_push_constants_are_named) {
    EXPECT_EQ(push_difference<moved::Push>(), "12 bytes in the shader, 20 in C++");
    EXPECT_EQ(vulkan::push_constant_difference(interface_module().push_constants, nullptr),
              "Push in the shader, none in C++");
    EXPECT_EQ(vulkan::push_constant_difference({}, &layout_of<Push>()), "Push in C++, but the shader has none");
    EXPECT_EQ(vulkan::push_constant_difference({}, nullptr), "");
}

TEST(VulkanReflection, push_constants_may_be_padded_as_cpp_pads_them) {
    EXPECT_EQ(layout_of<other::Push>().size, 16u);
    EXPECT_EQ(push_difference<other::Push>(), "");
}

TEST(VulkanReflection, what_drape_does_not_use_is_refused_by_name) {
    try {
        const vulkan::ComputePipeline pipeline(gpu().device, "broken", {"refused.comp", test_shader("refused.comp")},
                                               {});
        FAIL() << "not refused";
    } catch (const VulkanError& error) {
        EXPECT_THAT(error.what(), AllOf(HasSubstr("pipeline broken: shader module refused.comp"),
                                        HasSubstr("'Settings' (binding 0) is a uniform buffer"),
                                        HasSubstr("'elsewhere' (binding 1) is in set 1; only set 0 is used"),
                                        HasSubstr("'several' (binding 2) is an array of descriptors"),
                                        HasSubstr("'Mixed' (binding 3) is no block of one runtime array")));
    }
}

TEST(VulkanReflection, words_that_are_no_spirv_are_refused) {
    auto words = std::vector<std::uint32_t>(test_shader("interface.comp").begin(), test_shader("interface.comp").end());
    EXPECT_THROW(vulkan::reflect(std::span(words).first(3), "short"), VulkanError);
    words[0] = 0xdeadbeef;
    EXPECT_THROW(vulkan::reflect(words, "magic"), VulkanError);
}

TEST(VulkanReflection, committed_modules_are_found_by_name) {
    EXPECT_TRUE(std::ranges::is_sorted(spirv_modules(), {}, &SpirvModule::name));
    for (const SpirvModule& module : spirv_modules())
        EXPECT_EQ(vulkan::spirv_module(module.name).front(), 0x07230203u) << module.name;
    try {
        vulkan::spirv_module("canry.comp");
        FAIL() << "found a module that does not exist";
    } catch (const VulkanError& error) {
        EXPECT_THAT(error.what(), HasSubstr("\"canry.comp\""));
    }
}

}  // namespace drape::test
