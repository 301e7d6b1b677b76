// The simulation's modules use one arithmetic: + - * / sqrt, never contracted, nothing that a driver may round its own
// way. This makes the C++ twin an exact oracle and results repeatable.
#include <gtest/gtest.h>
#include <spirv-tools/libspirv.h>
#include <spirv_cross/GLSL.std.450.h>
#include <spirv_cross/spirv.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "spirv_modules.h"

namespace drape {
namespace {

/// Arithmetic of a module.
struct Arithmetic {
    std::set<std::uint32_t> exact;                                 ///< ids decorated NoContraction
    std::vector<std::pair<std::uint32_t, std::uint32_t>> rounded;  ///< id, opcode of + - * on floats
    std::vector<std::string> forbidden;
};

bool is_sum_or_product(std::uint32_t opcode) {
    return opcode == SpvOpFAdd || opcode == SpvOpFSub || opcode == SpvOpFMul || opcode == SpvOpVectorTimesScalar;
}

bool is_driver_rounded(std::uint32_t opcode) {
    return opcode == SpvOpDot || opcode == SpvOpFMod || opcode == SpvOpFRem || opcode == SpvOpMatrixTimesVector ||
           opcode == SpvOpVectorTimesMatrix || opcode == SpvOpMatrixTimesMatrix || opcode == SpvOpOuterProduct;
}

/// Functions of GLSL.std.450 are exact if they are IEEE roots and signs, whole parts, which Vulkan has correctly
/// rounded (appendix "Precision and Operation of SPIR-V Instructions"), or functions of integers.
bool is_exact(std::uint32_t function) {
    constexpr GLSLstd450 exact[] = {GLSLstd450Sqrt, GLSLstd450FAbs, GLSLstd450Floor, GLSLstd450UMin,
                                    GLSLstd450SMin, GLSLstd450UMax, GLSLstd450SMax,  GLSLstd450FindILsb};
    return std::ranges::find(exact, function) != std::end(exact);
}

spv_result_t collect(void* user, const spv_parsed_instruction_t* instruction) {
    auto& found = *static_cast<Arithmetic*>(user);
    const std::uint32_t opcode = instruction->opcode;
    if (opcode == SpvOpDecorate && instruction->words[2] == SpvDecorationNoContraction)
        found.exact.insert(instruction->words[1]);
    if (is_sum_or_product(opcode)) found.rounded.emplace_back(instruction->result_id, opcode);
    if (is_driver_rounded(opcode)) found.forbidden.push_back("opcode " + std::to_string(opcode));
    if (opcode == SpvOpExtInst) {
        const std::uint32_t function = instruction->words[4];
        if (!is_exact(function)) found.forbidden.push_back("GLSL.std.450 function " + std::to_string(function));
    }
    return SPV_SUCCESS;
}

Arithmetic arithmetic_of(const SpirvModule& module) {
    Arithmetic found;
    const spv_context context = spvContextCreate(SPV_ENV_VULKAN_1_3);
    const spv_result_t result =
        spvBinaryParse(context, &found, module.words.data(), module.words.size(), nullptr, collect, nullptr);
    spvContextDestroy(context);
    EXPECT_EQ(result, SPV_SUCCESS) << module.name;
    return found;
}

/// Compute modules are the simulation; vertex and fragment modules only draw, and so do those of some passes.
bool simulates(const SpirvModule& module) {
    return module.name.ends_with(".comp") && !module.name.starts_with("encode") &&
           !module.name.starts_with("cloth_tiles") && !module.name.starts_with("ground_");
}

TEST(ArithmeticTest, NoSumOrProductOfTheSimulationMayBeContracted) {
    std::size_t checked = 0;
    for (const SpirvModule& module : spirv_modules()) {
        if (!simulates(module)) continue;
        const Arithmetic found = arithmetic_of(module);
        std::size_t loose = 0;
        for (const auto& [id, opcode] : found.rounded) loose += !found.exact.contains(id);
        EXPECT_EQ(loose, 0u) << module.name << ": of " << found.rounded.size() << " float operations";
        checked += found.rounded.size();
    }
    EXPECT_GT(checked, 100u) << "the modules must have been looked at";
}

TEST(ArithmeticTest, TheSimulationUsesNothingThatADriverRoundsItsOwnWay) {
    for (const SpirvModule& module : spirv_modules())
        if (simulates(module))
            for (const std::string& what : arithmetic_of(module).forbidden)
                ADD_FAILURE() << module.name << ": " << what;
}

}  // namespace
}  // namespace drape
