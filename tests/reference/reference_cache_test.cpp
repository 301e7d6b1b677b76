// The cache of reference runs gives back every run that it stored, and refuses any other file.
#include "reference/reference_cache.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "network_scenes.h"
#include "output/temporary_folder.h"
#include "reference/implicit_reference.h"
#include "reference/symplectic_reference.h"

namespace drape {
namespace {

void expect_equal(const ReferenceRun& a, const ReferenceRun& b) {
    EXPECT_EQ(a.method, b.method);
    EXPECT_EQ(a.step, b.step);
    EXPECT_EQ(a.times, b.times);
    EXPECT_EQ(a.error_estimate, b.error_estimate);
    EXPECT_EQ(a.observed_order, b.observed_order);
    ASSERT_EQ(a.states.size(), b.states.size());
    for (std::size_t k = 0; k < a.states.size(); ++k) {
        EXPECT_EQ(a.states[k].position, b.states[k].position);
        EXPECT_EQ(a.states[k].velocity, b.states[k].velocity);
    }
}

std::string contents(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void overwrite(const std::filesystem::path& path, const std::string& data) {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << data;
}

class ReferenceCacheTest : public testing::Test {
  protected:
    CachedRun get() {
        return cache.get(key, [this] {
            ++computed;
            return run_symplectic(network, times);
        });
    }

    TemporaryFolder folder;
    ReferenceCache cache{folder.path() / "below" / "references"};
    SpringNetwork network{test::swing(3, 5, 30), 0};
    std::vector<double> times{0.0, 0.05, 0.1};
    std::string key = symplectic_key(network, times);
    int computed = 0;
};

TEST_F(ReferenceCacheTest, GivesBackEveryBit) {
    const CachedRun first = get(), second = get();
    EXPECT_EQ(computed, 1);
    EXPECT_FALSE(first.from_cache);
    EXPECT_EQ(first.store_error, "");
    EXPECT_TRUE(second.from_cache);
    expect_equal(first.run, second.run);
    for (const auto& entry : std::filesystem::directory_iterator(cache.file_of(key).parent_path()))
        EXPECT_EQ(entry.path(), cache.file_of(key));  // nothing is left beside it
}

TEST_F(ReferenceCacheTest, ComputesAgainWhenAnyByteChangedOrIsMissing) {
    const ReferenceRun run = get().run;
    const std::filesystem::path file = cache.file_of(key);
    const std::string good = contents(file);
    for (std::size_t place = 0; place < good.size(); place += 41) {
        std::string bad = good;
        bad[place] = static_cast<char>(bad[place] ^ 0x10);
        overwrite(file, bad);
        EXPECT_FALSE(cache.load(key)) << "byte " << place;
    }
    for (const std::size_t size : {std::size_t{0}, std::size_t{7}, std::size_t{20}, good.size() / 2, good.size() - 1}) {
        overwrite(file, good.substr(0, size));
        EXPECT_FALSE(cache.load(key)) << size << " bytes";
    }
    overwrite(file, good + "x");
    EXPECT_FALSE(cache.load(key));
    expect_equal(get().run, run);
    EXPECT_EQ(computed, 2);
    EXPECT_EQ(contents(file), good);
    EXPECT_TRUE(get().from_cache);
}

TEST_F(ReferenceCacheTest, RefusesTheFileOfAnotherKey) {
    get();
    const std::string other = symplectic_key(network, times, {.cfl = 0.05});
    ASSERT_NE(cache.file_of(other), cache.file_of(key));
    std::filesystem::copy_file(cache.file_of(key), cache.file_of(other));  // as if the hashes were the same
    EXPECT_FALSE(cache.load(other));
    EXPECT_TRUE(cache.load(key));
}

TEST_F(ReferenceCacheTest, AFailureToStoreKeepsTheRun) {
    std::filesystem::create_directory(cache.file_of(key));  // cannot be replaced by a file
    const CachedRun got = get();
    EXPECT_FALSE(got.from_cache);
    EXPECT_NE(got.store_error, "");
    EXPECT_EQ(got.run.states.size(), 3u);
}

TEST_F(ReferenceCacheTest, KeysTellRunsApart) {
    EXPECT_EQ(symplectic_key(network, times), key);
    EXPECT_NE(symplectic_key(network, std::vector<double>{0.0, 0.05}), key);
    EXPECT_NE(implicit_key(network, times), key);
    SpringNetwork other = network;
    other.damping = 1e-9;
    EXPECT_NE(symplectic_key(other, times), key);
}

}  // namespace
}  // namespace drape
