// Compares every state image of the device with the C++ twin, frame by frame, on scenes that use everything at once.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "device_run.h"
#include "gpu_test.h"
#include "support/every_kind.h"
#include "support/sheets.h"
#include "support/twin_fields.h"
#include "twin/twin.h"

namespace drape::test {

inline constexpr std::uint32_t frame_count = 18, substep_count = 12;  // 216 substeps

/// Every kind but meshes, in no order, all but two moving.
inline std::vector<Collider> every_collider() {
    const MotionPath path{{{0, {0, 0, 0}, {0, 0, 0}}, {0.3, {0.05, 0.1, 0}, {20, 90, 10}}}};
    std::vector<Collider> all;
    for (const ColliderShape& shape : of_every_kind<Mesh>(
             Box{{0.3, -0.2, -0.1}, {0.1, 0.15, 0.2}}, Sphere{{-0.2, -0.25, 0.1}, 0.2}, Sphere{{0.1, -0.3, 0.3}, 0.2},
             Capsule{{-0.4, -0.2, -0.3}, {-0.2, -0.15, 0.3}, {0.08, 0.15}},
             Capsule{{0.3, -0.3, 0.3}, {0.32, -0.3, 0.3}, {0.15, 0.1}}, Ellipsoid{{0, -0.2, -0.3}, {0.3, 0.15, 0.1}},
             Plane{{0, 1, 0}, -0.4}))
        all.push_back({shape, 0.3, {}, path});
    all[0].rotate = {10, 20, 30};
    all[2].path = all[4].path = {};
    all[3].rotate = {5, 0, 15};
    all[5].rotate = {0, 40, 0};
    return all;
}

/// Everything at once: pins of all sorts, wind with gusts, all colliders moving, friction, damping.
inline SceneDescription everything() {
    SceneDescription scene = sheet(37, 30, 1.1, 0.9, substep_count, 1);
    scene.time.frame_count = frame_count + 1;
    scene.wind.velocity = {2, 0.5, -1};
    scene.wind.gust = {1.5, 0.2, 7};
    scene.colliders = every_collider();
    Cloth& cloth = scene.cloths[0];
    cloth.placement = {{-0.55, 0.0, -0.45}, {1, 0, 0}, {0, 0, 1}};
    cloth.stiffness = {false, 800, 60, 0};
    cloth.damping = 0.7;
    cloth.velocity = {0.3, -1.5, 0.2};
    Pin moving = pin_box(0, 0, 4, 0);
    moving.path.keys = {{0, {0, 0, 0}, {}}, {0.2, {0.1, 0.05, 0}, {0, 30, 10}}};
    Pin released = pin_box(36, 0, 36, 3);
    released.release = 0.11;
    cloth.pins = {moving, released, pin_box(18, 0, 18, 0)};
    return scene;
}

/// Makes a sheet of so many columns and rows, held in a corner and along an edge, on which nothing but springs acts.
inline SceneDescription thrown_sheet(std::pair<std::uint32_t, std::uint32_t> grid, std::uint32_t substeps) {
    const auto [columns, rows] = grid;
    SceneDescription scene = sheet(columns, rows, 1.1, 0.9, substeps, 1);
    Cloth& cloth = scene.cloths[0];
    cloth.placement = {{-0.55, 0.0, -0.45}, {1, 0, 0}, {0, 0.6, 0.8}};
    cloth.stiffness = {false, 800, 60, 0};
    cloth.damping = 0.7;
    cloth.velocity = {0.3, -1.5, 0.2};
    cloth.pins = {pin_box(0, 0, 0, 0), pin_box(columns - 1, 0, columns - 1, rows - 1)};
    return scene;
}

inline SceneDescription everything_in_lines() {
    SceneDescription scene = everything();
    scene.solver.method = SolverMethod::line;
    return scene;
}

/// Without colliders: second order.
inline SceneDescription free_lines() {
    SceneDescription scene = everything_in_lines();
    scene.colliders = {};
    return scene;
}

inline void add_second_cloth(SceneDescription& scene) {
    Cloth second = scene.cloths[0];
    second.name = "second";
    second.grid = {24, 41};
    second.holes.clear();
    second.pins = {pin_top(second)};
    second.placement.origin = {-0.4, 0.3, -0.2};
    scene.cloths.push_back(second);
}

/// Held at both upper corners, in the middle, whose box shares particles with theirs, and, until it lets go, at a third
/// corner, whose column is that of another.
inline SceneDescription lone_pins() {
    SceneDescription scene = sheet(97, 97, 1.0, 1.0, substep_count);
    scene.solver.method = SolverMethod::line;
    scene.cloths[0].velocity = {0.5, 0, 1};
    Pin moved = pin_box(96, 0, 96, 0), released = pin_box(0, 96, 0, 96);
    moved.path.keys = {{0, {0, 0, 0}, {}}, {0.2, {-0.1, 0.05, 0.1}, {}}};
    released.release = 0.11;
    scene.cloths[0].pins = {pin_box(0, 0, 0, 0), moved, released, pin_box(48, 44, 48, 44)};
    return scene;
}

/// Every bit of a field.
inline void expect_same(const FieldRow& row, std::span<const std::byte> device, std::span<const std::byte> twin,
                        std::uint32_t frame) {
    std::string where = "not the same";
    const bool same = &row.element == &glsl::layout_of<glsl::vec4>()
                          ? same_bits(texels_of<glsl::vec4>(device), texels_of<glsl::vec4>(twin), where)
                          : std::ranges::equal(device, twin);
    EXPECT_TRUE(same) << row.name << " after frame " << frame << ": " << where;
    EXPECT_FALSE(device.empty()) << row.name;
}

/// Compares a field of two runs' first cloths.
inline void expect_same(Field field, const DeviceRun& one, const DeviceRun& other, std::uint32_t frame) {
    expect_same(row_of(field), one.bytes(0, field), other.bytes(0, field), frame);
}

/// By every set of kernels that the default device may take, or by one alone. Returns the record of the last frame's
/// contact between cloths, if they meet, with the most pairs of any frame. `act` changes the model before each frame.
inline glsl::SelfRecord compare(const SceneDescription& scene, const ModelOptions& options = {},
                                const vulkan::Device& on = gpu().device, const FrameNeeds& needs = {.drawing = true},
                                std::optional<Kernels> only = {},
                                const std::function<void(SimulationModel&, std::uint32_t)>& act = {}) {
    SimulationModel model(scene, options);
    Twin twin(model, only.value_or(Kernels()));
    std::vector<std::unique_ptr<DeviceRun>> devices;
    for (const Kernels& kernels : only ? std::vector{*only} : kernel_sets(on, model))
        devices.push_back(std::make_unique<DeviceRun>(on, model, graph::BarrierFilter{}, kernels, needs));
    std::uint32_t most_pairs = 0;
    for (std::uint32_t frame = 1; frame <= frame_count; ++frame) {
        if (act) act(model, frame);
        twin.run_frame(frame);
        if (model.self_contact) most_pairs = std::max(most_pairs, twin.contact().record.most_pairs);
        for (const auto& device : devices) device->run_frame(frame);
        const auto same = [&](std::size_t cloth, const FieldRow& row, const auto& expected) {
            for (const auto& device : devices) expect_same(row, device->bytes(cloth, row.field), expected, frame);
        };
        for_compared_fields(model, twin, same, needs);
        if (::testing::Test::HasFailure()) return {};
    }
    // The comparison means something only if the cloth moved and stayed finite.
    double moved = 0;
    for (std::size_t i = 0; i < model.cloths[0].grid.particle_count(); ++i) {
        const glsl::vec4 a = model.cloths[0].position[i], b = twin.cloth(0)[Field::position][i];
        EXPECT_TRUE(std::isfinite(b.x) && std::isfinite(b.y) && std::isfinite(b.z));
        moved = std::max(moved, std::abs(double(b.y) - double(a.y)));
    }
    EXPECT_GT(moved, 0.01);
    glsl::SelfRecord last = model.self_contact ? twin.contact().record : glsl::SelfRecord{};
    last.most_pairs = most_pairs;
    return last;
}

}  // namespace drape::test
