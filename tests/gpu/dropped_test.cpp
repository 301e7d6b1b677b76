// What is made and dropped leaves nothing behind: neither threads, nor open files, nor memory of the program's or of
// the device's, however often that is done.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <malloc.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

#include "ensemble_members.h"

namespace drape {
namespace {

using test::scene_of;

// None is validated: the layer keeps 0.4 MB of each ensemble for itself, and its messages are other tests' matter.
constexpr int warm_up = 20, rounds = 100;

struct Held {
    std::size_t threads = 0, files = 0;
    double megabytes = 0;  ///< resident
    std::uint64_t device_bytes = 0;
};

Held held(const Device* device) {
    malloc_trim(0);  // what is free is not held
    Held now;
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
        if (word == "Threads:") status >> now.threads;
        if (word == "VmRSS:") status >> now.megabytes;
    }
    now.megabytes /= 1024;
    const std::filesystem::directory_iterator files("/proc/self/fd");
    now.files = static_cast<std::size_t>(std::distance(begin(files), end(files)));
    if (device) now.device_bytes = device->memory_used();
    return now;
}

/// MB by which a program may grow while something is made and dropped a hundred times: driver and C library move it by
/// one to and fro. So 40 KB that one of them leaves are noticed.
constexpr double most_megabytes = 4;

/// Makes and drops something so often, and expects that after the first few times nothing of it stays.
void expect_nothing_left(const Device* device, const std::function<void(int)>& make_and_drop) {
    for (int k = 0; k < warm_up; ++k) make_and_drop(k);
    const Held before = held(device);
    for (int k = 0; k < rounds; ++k) make_and_drop(warm_up + k);
    const Held after = held(device);
    EXPECT_EQ(after.threads, before.threads);
    EXPECT_EQ(after.files, before.files);
    EXPECT_EQ(after.device_bytes, before.device_bytes);
    EXPECT_LT(after.megabytes - before.megabytes, most_megabytes);
}

/// Returns a scene by one of the methods, which meets itself where the method is `auto`.
SceneDescription scene_by(int k) {
    constexpr const char* methods[] = {"line", "explicit", "relax", "auto"};
    const char* const method = methods[k % 4];
    std::vector<std::string> overrides{fmt::format("/solver/method=\"{}\"", method)};
    if (k % 4 == 3) overrides.emplace_back("/cloths/0/self_collision=true");
    return scene_of(overrides);
}

void step_ensemble(int k, const Device& device) {
    Ensemble ensemble({scene_by(k), scene_by(k), scene_by(k)}, {}, device);
    for (int step = 0; step < 2; ++step) ensemble.step();
    ASSERT_EQ(ensemble.frame(2), 2u);
}

void step_simulation(int k, const Device& device) {
    SceneDescription scene = scene_by(k);
    scene.image.size = {64, 48};
    SimulationOptions options;
    options.draw = k / 4 % 2 == 0;
    Simulation simulation(scene, options, device);
    for (int step = 0; step < 3; ++step) ASSERT_TRUE(simulation.step());
}

TEST(Dropped, EnsemblesOfADeviceLeaveNothing) {
    const Device device("", Validation::off);
    expect_nothing_left(&device, [&](int k) { step_ensemble(k, device); });
}

TEST(Dropped, SimulationsOfADeviceLeaveNothing) {
    const Device device("", Validation::off);
    expect_nothing_left(&device, [&](int k) { step_simulation(k, device); });
}

/// Every device makes its pipelines anew, so the scene is one with few of them.
TEST(Dropped, DevicesLeaveNothing) {
    const SceneDescription scene = scene_of({"/solver/method=\"explicit\"", "/colliders={}"});
    expect_nothing_left(nullptr, [&](int) {
        const Device device("", Validation::off);
        Simulation simulation(scene, {}, device);
        for (int step = 0; step < 2; ++step) ASSERT_TRUE(simulation.step());
    });
}

}  // namespace
}  // namespace drape
