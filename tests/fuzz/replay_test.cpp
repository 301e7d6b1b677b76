// Every committed input of the fuzz targets, and the empty one, passes all checks of its target.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <ostream>
#include <string>
#include <vector>

extern "C" {
#define DRAPE_FUZZ_TARGET(name) int fuzz_##name(const std::uint8_t* data, std::size_t size);
#include "fuzz_targets.inc"
#undef DRAPE_FUZZ_TARGET
}

namespace drape {
namespace {

struct Target {
    const char* name;
    int (*run)(const std::uint8_t* data, std::size_t size);
};

void PrintTo(const Target& target, std::ostream* stream) { *stream << target.name; }

constexpr Target targets[] = {
#define DRAPE_FUZZ_TARGET(name) {#name, fuzz_##name},
#include "fuzz_targets.inc"
#undef DRAPE_FUZZ_TARGET
};

std::vector<std::filesystem::path> inputs_of(const Target& target) {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(DRAPE_SOURCE_DIR) /
                                                                 "tests/fuzz/corpus" / target.name))
        paths.push_back(entry.path());
    std::ranges::sort(paths);
    return paths;
}

class FuzzReplay : public testing::TestWithParam<Target> {};

TEST_P(FuzzReplay, FindsNothingInTheCorpus) {
    const std::vector<std::filesystem::path> paths = inputs_of(GetParam());
    ASSERT_FALSE(paths.empty());
    GetParam().run(nullptr, 0);
    for (const std::filesystem::path& path : paths) {
        SCOPED_TRACE(path.filename());
        std::ifstream file(path, std::ios::binary);
        const std::vector<char> bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
        // No byte may be read behind the input, so it has a piece of memory of its own size.
        const std::vector<std::uint8_t> input(bytes.begin(), bytes.end());
        EXPECT_NO_THROW(GetParam().run(input.data(), input.size()));
    }
}

INSTANTIATE_TEST_SUITE_P(Targets, FuzzReplay, testing::ValuesIn(targets),
                         [](const auto& about) { return std::string(about.param.name); });

}  // namespace
}  // namespace drape
