// Whatever values its constants have, a specialised module is valid and has none of what they leave out.
#include "vulkan/specialisation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <spirv-tools/libspirv.hpp>

#include "spirv_modules.h"
#include "vulkan/device_requirements.h"
#include "vulkan/texel_storage.h"

namespace drape {
namespace {

using vulkan::SpecializationConstant;

constexpr int drawn_values = 6;  // sets of them a module

/// Sizes keep the values that the shader gives them.
bool is_size(std::string_view name) {
    return name.starts_with("local_size") || name.starts_with("strip_") || name == "halo" || name == "steps" ||
           name == vulkan::subgroup_constant || name.ends_with("_each") || name.ends_with("_count");
}

struct Counts {
    std::uint32_t images = 0, texels = 0, buffers = 0, writable = 0;
};

Counts counted(const vulkan::ReflectedModule& module) {
    Counts counts;
    for (const vulkan::ReflectedDescriptor& each : module.descriptors) {
        counts.images += each.kind == vulkan::DescriptorKind::storage_image;
        counts.texels += each.kind == vulkan::DescriptorKind::texel_buffer;
        counts.buffers += each.kind == vulkan::DescriptorKind::storage_buffer;
        counts.writable += each.writable;
    }
    return counts;
}

/// Nothing but texel buffers is another kind then, and there are no more descriptors than the table of requirements
/// says.
void expect_stored(const std::string& name, const Counts& made, const Counts& stored) {
    EXPECT_EQ(stored.texels, 0u) << name;
    EXPECT_EQ(stored.buffers, made.buffers + made.texels) << name;
    EXPECT_EQ(stored.images, made.images) << name;
    EXPECT_EQ(stored.writable, made.writable) << name;
    EXPECT_LE(made.images + made.texels, vulkan::most_storage_images) << name;
    EXPECT_LE(made.buffers, vulkan::most_storage_buffers) << name;
    EXPECT_LE(stored.buffers, vulkan::most_buffers_for_texels) << name;
}

TEST(Specialisation, IsValidWhateverTheConstants) {
    spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_3);
    std::string trouble;
    tools.SetMessageConsumer([&](auto, auto, auto&, const char* message) { trouble = message; });
    std::mt19937 random(1);
    for (const SpirvModule& module : spirv_modules()) {
        const std::string name(module.name);
        for (int draw = 0; draw < drawn_values; ++draw) {
            std::vector<SpecializationConstant> constants;
            for (const auto& [constant, id] : vulkan::module_interface(name).constants)
                if (!is_size(constant))  // at first everything at once, which needs most
                    constants.push_back({constant, draw == 0 ? 1 : static_cast<std::uint32_t>(random() % 3)});
            const vulkan::SpecialisedModule& made = vulkan::specialised_module(name, constants);
            EXPECT_TRUE(tools.Validate(made.words)) << name << ": " << trouble;
            const std::vector<std::uint32_t> stored = vulkan::texels_as_storage(made.words);
            EXPECT_TRUE(tools.Validate(stored)) << name << ", its texels as storage: " << trouble;
            expect_stored(name, counted(made.reflected), counted(vulkan::reflect(stored, name)));
        }
    }
}

std::set<std::string> names_in(const std::string& module, std::vector<SpecializationConstant> constants) {
    std::set<std::string> names;
    for (const auto& each : vulkan::specialised_module(module, constants).reflected.descriptors)
        names.insert(each.name);
    return names;
}

TEST(Specialisation, LeavesOutWhatConstantsDo) {
    using testing::Contains;
    using testing::Not;
    const std::string collision = "collision.comp";
    EXPECT_THAT(names_in(collision, {}), Not(Contains("lifted")));
    EXPECT_THAT(names_in(collision, {{"after_edges", 1}}), Contains("lifted"));
    EXPECT_THAT(names_in(collision, {{"planes_end", 1}, {"meshes_end", 1}}), Contains("position_out"));
    EXPECT_THAT(names_in(collision, {{"after_impulses", 1}}), Not(Contains("position_out")));
    EXPECT_THAT(names_in(collision, {{"capsules_end", 1}, {"meshes_end", 1}}), Not(Contains("mesh_fields")))
        << "the last collider is no mesh";
    EXPECT_THAT(names_in(collision, {{"meshes_end", 1}}), Contains("mesh_fields"));
    EXPECT_TRUE(vulkan::specialised_module(collision, {}).reflected.constants.empty());
}

TEST(Specialisation, AsksForIntegersOf64BitsOnlyWhereTheyAreUsed) {
    const auto asks = [](std::uint32_t wide) {
        const SpecializationConstant constants[] = {{"wide", wide}};
        const std::vector<std::uint32_t>& words = vulkan::specialised_module("self_begin.comp", constants).words;
        constexpr std::uint32_t capability = 2u << 16 | 17u, int64 = 11;
        return std::ranges::search(words, std::array{capability, int64}).begin() != words.end();
    };
    EXPECT_TRUE(asks(1));
    EXPECT_FALSE(asks(0));
}

}  // namespace
}  // namespace drape
