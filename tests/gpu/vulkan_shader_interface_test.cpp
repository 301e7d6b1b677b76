// Every kind of difference between a shader and its declaration is found and named.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "gpu_test.h"
#include "vulkan/shader_interface.h"

namespace drape::test {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using vulkan::DescriptorAccess;
using vulkan::DescriptorDeclaration;
using vulkan::DescriptorKind;
using vulkan::MemberLayout;
using vulkan::StructLayout;
using vulkan::VulkanError;

namespace {

/// interface.comp as it is; each test spoils one thing.
struct Declaration {
    std::vector<MemberLayout> element_members = {{"position", 0}, {"mass", 16}, {"age", 20}, {"cell", 24}};
    StructLayout element{"Element", 32, element_members};
    std::vector<MemberLayout> push_members = {{"grid", 0}, {"scale", 8}};
    StructLayout push{"Push", 12, push_members};
    std::vector<DescriptorDeclaration> descriptors = {
        {0, "source", DescriptorKind::storage_image, DescriptorAccess::read, VK_FORMAT_R32G32B32A32_SFLOAT},
        {1, "target", DescriptorKind::storage_image, DescriptorAccess::write, VK_FORMAT_R32_SFLOAT},
        {2, "Elements", DescriptorKind::storage_buffer, DescriptorAccess::read, VK_FORMAT_UNDEFINED, &element},
        {3, "Sums", DescriptorKind::storage_buffer, DescriptorAccess::read_write, VK_FORMAT_UNDEFINED, nullptr, 8},
        {4, "Flags", DescriptorKind::storage_buffer, DescriptorAccess::write, VK_FORMAT_UNDEFINED, nullptr, 4}};
    bool has_push = true;

    Declaration() = default;
    Declaration(const Declaration&) = delete;
    Declaration& operator=(const Declaration&) = delete;

    /// What check_interface says; empty when it is content.
    std::string error(std::string_view shader = "interface.comp") {
        element.members = element_members;
        push.members = push_members;
        try {
            vulkan::check_interface(test_shader(shader), {shader, descriptors, has_push ? &push : nullptr});
        } catch (const VulkanError& error) {
            return error.what();
        }
        return {};
    }
};

}  // namespace

TEST(VulkanShaderInterface, a_true_declaration_is_accepted) {
    // Binding 7 is declared in the GLSL and never used: only what is statically used counts.
    EXPECT_EQ(Declaration().error(), "");
}

TEST(VulkanShaderInterface, the_module_is_named) {
    Declaration declaration;
    declaration.descriptors.pop_back();
    EXPECT_THAT(declaration.error(), testing::StartsWith("shader module interface.comp differs from its declaration:"));
}

TEST(VulkanShaderInterface, an_undeclared_descriptor_is_named) {
    Declaration declaration;
    declaration.descriptors.erase(declaration.descriptors.begin() + 3);
    EXPECT_THAT(declaration.error(), HasSubstr("binding 3 (Sums) is used by the shader as a storage buffer, but not"));
}

TEST(VulkanShaderInterface, a_declared_descriptor_that_is_not_used_is_named) {
    Declaration declaration;
    declaration.descriptors.push_back(
        {7, "never_used", DescriptorKind::storage_image, DescriptorAccess::read, VK_FORMAT_R32G32B32A32_SFLOAT});
    EXPECT_THAT(declaration.error(),
                HasSubstr("binding 7 (never_used) is declared as a storage image, but the shader"));
}

TEST(VulkanShaderInterface, a_binding_declared_twice_is_named) {
    Declaration declaration;
    declaration.descriptors.push_back(declaration.descriptors[0]);
    EXPECT_THAT(declaration.error(), HasSubstr("binding 0 (source) is declared twice"));
}

TEST(VulkanShaderInterface, another_name_is_named) {
    Declaration declaration;
    declaration.descriptors[0].name = "position";
    EXPECT_THAT(declaration.error(),
                HasSubstr("binding 0 (position) name: the shader has source, declared is position"));
}

TEST(VulkanShaderInterface, another_kind_is_named) {
    Declaration declaration;
    declaration.descriptors[1].kind = DescriptorKind::storage_buffer;
    EXPECT_THAT(declaration.error(),
                HasSubstr("binding 1 (target) kind: the shader has storage image, declared is storage buffer"));
}

TEST(VulkanShaderInterface, another_access_is_named_for_images) {
    for (const DescriptorAccess access : {DescriptorAccess::write, DescriptorAccess::read_write}) {
        Declaration declaration;
        declaration.descriptors[0].access = access;
        EXPECT_THAT(declaration.error(), HasSubstr("binding 0 (source) access: the shader has readonly, declared is"));
    }
    Declaration declaration;
    declaration.descriptors[1].access = DescriptorAccess::read;
    EXPECT_THAT(declaration.error(),
                HasSubstr("binding 1 (target) access: the shader has writeonly, declared is readonly"));
}

TEST(VulkanShaderInterface, another_access_is_named_for_buffers) {
    Declaration declaration;
    declaration.descriptors[2].access = DescriptorAccess::read_write;
    declaration.descriptors[3].access = DescriptorAccess::read;
    declaration.descriptors[4].access = DescriptorAccess::read;
    EXPECT_THAT(declaration.error(),
                AllOf(HasSubstr("binding 2 (Elements) access: the shader has readonly, declared is read and write"),
                      HasSubstr("binding 3 (Sums) access: the shader has read and write, declared is readonly"),
                      HasSubstr("binding 4 (Flags) access: the shader has writeonly, declared is readonly")));
}

TEST(VulkanShaderInterface, another_format_is_named) {
    Declaration declaration;
    declaration.descriptors[1].format = VK_FORMAT_R32G32B32A32_SFLOAT;
    EXPECT_THAT(declaration.error(), HasSubstr("binding 1 (target) format: the shader has r32f, declared is rgba32f"));
}

TEST(VulkanShaderInterface, another_stride_is_named) {
    Declaration declaration;
    declaration.descriptors[3].stride = 16;
    declaration.element.size = 48;
    EXPECT_THAT(declaration.error(),
                AllOf(HasSubstr("binding 3 (Sums) array stride: the shader has 8, declared is 16"),
                      HasSubstr("binding 2 (Elements) array stride: the shader has 32, declared is 48")));
}

TEST(VulkanShaderInterface, a_struct_for_a_scalar_is_named_both_ways) {
    Declaration declaration;
    declaration.descriptors[2].element = nullptr;
    declaration.descriptors[3].element = &declaration.element;
    EXPECT_THAT(declaration.error(),
                AllOf(HasSubstr("binding 2 (Elements) element: the shader has struct Element, declared is a scalar"),
                      HasSubstr("binding 3 (Sums) element: the shader has a scalar or vector, declared is struct")));
}

TEST(VulkanShaderInterface, a_member_that_moved_is_named) {
    Declaration declaration;
    declaration.element_members[1].offset = 20;
    declaration.element_members[2].offset = 16;
    EXPECT_THAT(declaration.error(),
                AllOf(HasSubstr("offset of member Element.mass: the shader has 16, declared is 20"),
                      HasSubstr("offset of member Element.age: the shader has 20, declared is 16")));
}

TEST(VulkanShaderInterface, a_member_of_one_side_only_is_named) {
    Declaration declaration;
    declaration.element_members[2].name = "epoch";
    EXPECT_THAT(declaration.error(),
                AllOf(HasSubstr("member Element.epoch: is declared, but the shader does not have it"),
                      HasSubstr("member Element.age: is in the shader, but not declared")));
}

TEST(VulkanShaderInterface, other_push_constants_are_named) {
    Declaration moved;
    moved.push_members[1].offset = 12;
    moved.push.size = 20;
    EXPECT_THAT(moved.error(), AllOf(HasSubstr("push constants size of Push: the shader has 12, declared is 20"),
                                     HasSubstr("offset of member Push.scale: the shader has 8, declared is 12")));
    Declaration missing;
    missing.has_push = false;
    EXPECT_THAT(missing.error(), HasSubstr("push constants are in the shader (Push), but not declared"));
}

TEST(VulkanShaderInterface, push_constants_that_the_shader_lacks_are_named) {
    Declaration declaration;
    declaration.descriptors.clear();
    EXPECT_THAT(declaration.error("triangle.vert"),
                HasSubstr("push constants are declared (Push), but the shader has none"));
}

TEST(VulkanShaderInterface, push_constants_may_be_padded_as_cpp_pads_them) {
    Declaration declaration;
    declaration.push.size = 16;
    EXPECT_EQ(declaration.error(), "");
    declaration.push.size = 8;
    EXPECT_THAT(declaration.error(), HasSubstr("size of Push"));
}

TEST(VulkanShaderInterface, what_drape_does_not_use_is_named) {
    Declaration declaration;
    declaration.has_push = false;
    declaration.descriptors = {
        {0, "Settings", DescriptorKind::storage_buffer, DescriptorAccess::read, VK_FORMAT_UNDEFINED, nullptr, 16},
        {2, "several", DescriptorKind::storage_image, DescriptorAccess::write, VK_FORMAT_R32G32B32A32_SFLOAT},
        {3, "Mixed", DescriptorKind::storage_buffer, DescriptorAccess::read_write, VK_FORMAT_UNDEFINED, nullptr, 4}};
    EXPECT_THAT(declaration.error("refused.comp"),
                AllOf(HasSubstr("binding 0 (Settings) kind: the shader has uniform buffer, declared is storage buffer"),
                      HasSubstr("binding 1 (Elsewhere) is in set 1; only set 0 is used"),
                      HasSubstr("binding 2 (several) is an array of descriptors"),
                      HasSubstr("binding 3 (Mixed) is no block of one runtime array")));
}

TEST(VulkanShaderInterface, local_size_is_read_from_the_module) {
    EXPECT_EQ(vulkan::local_size(test_shader("interface.comp")), (std::array<std::uint32_t, 3>{8, 4, 1}));
    EXPECT_EQ(vulkan::local_size(vulkan::spirv_module("canary.comp")), (std::array<std::uint32_t, 3>{64, 1, 1}));
    EXPECT_THROW(vulkan::local_size(test_shader("triangle.vert")), VulkanError);
}

TEST(VulkanShaderInterface, words_that_are_no_spirv_are_refused) {
    auto words = std::vector<std::uint32_t>(test_shader("interface.comp").begin(), test_shader("interface.comp").end());
    EXPECT_THROW(vulkan::local_size(std::span(words).first(3)), VulkanError);
    words[0] = 0xdeadbeef;
    EXPECT_THROW(vulkan::local_size(words), VulkanError);
}

TEST(VulkanShaderInterface, committed_modules_are_found_by_name) {
    const auto names = vulkan::spirv_module_names();
    EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
    EXPECT_THAT(names, testing::Contains("canary.comp"));
    for (const auto name : names) EXPECT_EQ(vulkan::spirv_module(name).front(), 0x07230203u) << name;
    try {
        vulkan::spirv_module("canry.comp");
        FAIL() << "found a module that does not exist";
    } catch (const VulkanError& error) {
        EXPECT_THAT(error.what(), HasSubstr("\"canry.comp\""));
    }
}

}  // namespace drape::test
