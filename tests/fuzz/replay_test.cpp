// Every committed input of the fuzz targets, and the empty one, passes all checks of its target. So do mutants of them,
// in time and memory: as many as targets.tsv says, or DRAPE_FUZZ_MUTANTS, drawn from DRAPE_FUZZ_SEED.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <ostream>
#include <string>
#include <vector>

#include "mutant.h"

extern "C" {
#define DRAPE_FUZZ_TARGET(name, mutants) int fuzz_##name(const std::uint8_t* data, std::size_t size);
#include "fuzz_targets.inc"
#undef DRAPE_FUZZ_TARGET
}

namespace drape {
namespace {

struct Target {
    const char* name;
    int (*run)(const std::uint8_t* data, std::size_t size);
    std::uint64_t mutants;
};

void PrintTo(const Target& target, std::ostream* stream) { *stream << target.name; }

constexpr Target targets[] = {
#define DRAPE_FUZZ_TARGET(name, mutants) {#name, fuzz_##name, mutants},
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

std::vector<std::uint8_t> read_input(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    // No byte may be read behind the input, so it has a piece of memory of its own size.
    return {bytes.begin(), bytes.end()};
}

class FuzzReplay : public testing::TestWithParam<Target> {};

TEST_P(FuzzReplay, FindsNothingInTheCorpus) {
    const std::vector<std::filesystem::path> paths = inputs_of(GetParam());
    ASSERT_FALSE(paths.empty());
    GetParam().run(nullptr, 0);
    for (const std::filesystem::path& path : paths) {
        SCOPED_TRACE(path.filename());
        const std::vector<std::uint8_t> input = read_input(path);
        EXPECT_NO_THROW(GetParam().run(input.data(), input.size()));
    }
}

INSTANTIATE_TEST_SUITE_P(Targets, FuzzReplay, testing::ValuesIn(targets),
                         [](const auto& about) { return std::string(about.param.name); });

/// The mutant under way. Where it ends the process, or never ends, it is in this file.
std::vector<std::uint8_t> mutant;
std::string finding;

void write_finding() {
    const int file = open(finding.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    static_cast<void>(!write(file, mutant.data(), mutant.size()));
    close(file);
}

void on_signal(int number) {
    write_finding();
    std::signal(number, SIG_DFL);
    std::raise(number);
}

std::uint64_t from_environment(const char* name, std::uint64_t otherwise) {
    const char* const text = std::getenv(name);
    return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

/// What the process has used: seconds of a processor, and the most bytes at once.
struct Use {
    double seconds;
    std::int64_t bytes;
};
Use use() {
    rusage all{};
    getrusage(RUSAGE_SELF, &all);
    const auto seconds = [](const timeval& time) {
        return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    return {seconds(all.ru_utime) + seconds(all.ru_stime), std::int64_t{1024} * all.ru_maxrss};
}

/// The inputs of the others are numbers that are drawn: a mutant is no other than an input.
std::vector<Target> with_mutants() {
    std::vector<Target> some;
    std::ranges::copy_if(targets, std::back_inserter(some), [](const Target& target) { return target.mutants > 0; });
    return some;
}

class FuzzMutants : public testing::TestWithParam<Target> {};

TEST_P(FuzzMutants, AreTakenOrRefusedInTimeAndMemory) {
    constexpr double most_seconds = 2;
    constexpr std::int64_t most_bytes = std::int64_t{256} << 20;
    constexpr unsigned never_ends = 60;  // seconds
    const Target& target = GetParam();
    std::vector<std::vector<std::uint8_t>> inputs;
    for (const std::filesystem::path& path : inputs_of(target)) inputs.push_back(read_input(path));
    finding = testing::TempDir() + "finding." + target.name;
    for (const int number : {SIGSEGV, SIGBUS, SIGFPE, SIGABRT, SIGALRM}) std::signal(number, on_signal);
    fuzz::Mutator mutator(inputs, from_environment("DRAPE_FUZZ_SEED", 1));
    target.run(inputs[0].data(), inputs[0].size());  // what the first call alone takes
    const std::uint64_t count = from_environment("DRAPE_FUZZ_MUTANTS", target.mutants);
    Use before = use();
    for (std::uint64_t k = 0; k < count; ++k) {
        mutant = mutator.next();
        alarm(never_ends);
        std::string failure;
        try {
            target.run(mutant.data(), mutant.size());
        } catch (const std::exception& error) {
            failure = error.what();
        }
        const Use after = use();
        if (failure.empty() && after.seconds - before.seconds > most_seconds)
            failure = "it takes " + std::to_string(after.seconds - before.seconds) + " s";
        if (failure.empty() && after.bytes - before.bytes > most_bytes)
            failure = "it takes " + std::to_string(after.bytes - before.bytes) + " bytes";
        before = after;
        if (failure.empty()) continue;
        write_finding();
        ADD_FAILURE() << target.name << ", mutant " << k << ": " << failure << "; it is in " << finding;
        break;
    }
    alarm(0);
    for (const int number : {SIGSEGV, SIGBUS, SIGFPE, SIGABRT, SIGALRM}) std::signal(number, SIG_DFL);
}

INSTANTIATE_TEST_SUITE_P(Targets, FuzzMutants, testing::ValuesIn(with_mutants()),
                         [](const auto& about) { return std::string(about.param.name); });

}  // namespace
}  // namespace drape
