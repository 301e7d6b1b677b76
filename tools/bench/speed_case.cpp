#include "bench/speed_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "reference/model_scenes.h"

namespace drape::bench {

namespace {

constexpr SolverMethod speed_methods[] = {SolverMethod::explicit_steps, SolverMethod::line, SolverMethod::relax};
constexpr std::uint32_t short_sizes[] = {32, 64, 128, 256}, long_sizes[] = {512, 1024, 2048};
constexpr std::uint32_t cloth_counts[] = {4, 16, 64}, collider_counts[] = {1, 4, 16, 64};

void add_sizes(std::span<const std::uint32_t> sizes, std::vector<SpeedCase>& cases) {
    for (const std::uint32_t size : sizes)
        for (const SolverMethod method : speed_methods) {
            const std::string group(named(method).name);
            cases.push_back({.name = fmt::format("{}/{}", group, size),
                             .group = group,
                             .variable = size,
                             .method = method,
                             .size = size});
        }
}

void add_cloths(std::vector<SpeedCase>& cases) {
    for (const std::uint32_t count : cloth_counts)
        for (const SolverMethod method : {SolverMethod::explicit_steps, SolverMethod::line}) {
            const std::string group = fmt::format("{}, cloths of 32x32", named(method).name);
            cases.push_back({.name = fmt::format("{}/32/{} cloths", named(method).name, count),
                             .group = group,
                             .variable = count,
                             .method = method,
                             .size = 32,
                             .cloths = count});
        }
}

void add_colliders(std::vector<SpeedCase>& cases) {
    for (const std::uint32_t count : collider_counts)
        cases.push_back({.name = fmt::format("line/128/{} colliders", count),
                         .group = "line, colliders of 128x128",
                         .variable = count,
                         .size = 128,
                         .colliders = count});
}

void add_ensembles(bool is_short, std::vector<SpeedCase>& cases) {
    for (const std::uint32_t count : {1u, 4u, 16u, 64u, 256u, 1024u, 4096u})
        if (!is_short || count <= 256)
            cases.push_back({.name = fmt::format("ensemble/32/{} members", count),
                             .kind = SpeedKind::ensemble,
                             .group = "ensembles of 32x32",
                             .variable = count,
                             .size = 32,
                             .cloths = count});
}

void add_pictures(std::vector<SpeedCase>& cases) {
    for (const std::uint32_t samples : {1u, 4u})
        cases.push_back({.name = fmt::format("picture/64/{} samples", samples),
                         .kind = SpeedKind::picture,
                         .group = "pictures",
                         .variable = samples,
                         .samples = samples,
                         .draw = true});
}

void add_starts(std::vector<SpeedCase>& cases) {
    for (const bool draw : {false, true})
        cases.push_back({.name = draw ? "start/render" : "start/simulate",
                         .kind = SpeedKind::start,
                         .group = "starts",
                         .draw = draw});
}

using Options = SimulationOptions;
void as_it_is(SceneDescription&, Options&, std::uint32_t&) {}
void no_skip(SceneDescription&, Options& options, std::uint32_t&) { options.skip = false; }
void draw(SceneDescription&, Options& options, std::uint32_t&) { options.draw = true; }
void draw_every_tenth(SceneDescription&, Options& options, std::uint32_t& every) {
    options.draw = true;
    every = 10;
}
void read_back(SceneDescription&, Options& options, std::uint32_t&) { options.positions = true; }
void judge(SceneDescription&, Options& options, std::uint32_t&) { options.statistics = true; }
void iterate(SceneDescription& scene, Options&, std::uint32_t&) {
    scene.solver.method = SolverMethod::relax;
    scene.solver.iterations = 16;
    scene.solver.substeps = 10;
}
void iterate_until_met(SceneDescription& scene, Options& options, std::uint32_t& every) {
    iterate(scene, options, every);
    scene.solver.tolerance = 0.05;
}

/// On the floor, beside a ball that it does not touch.
void lie(SceneDescription& scene, bool ball_moves) {
    scene.solver.method = SolverMethod::automatic;
    Cloth& cloth = scene.cloths[0];
    cloth.placement.origin[1] = cloth.thickness;
    std::erase_if(scene.colliders, [](const Collider& each) { return !special(each.shape).plane; });
    scene.colliders.push_back({.shape = Sphere{{0, 3, 0}, 0.2}});
    if (ball_moves) scene.colliders.back().path = {{{0, {0, 0, 0}, {0, 0, 0}}, {1e6, {0, 0, 0}, {0, 90, 0}}}};
}
void lie_still(SceneDescription& scene, Options&, std::uint32_t&) { lie(scene, false); }
void lie_awake(SceneDescription& scene, Options&, std::uint32_t&) { lie(scene, true); }

}  // namespace

std::vector<SpeedCase> speed_cases(bool is_short) {
    std::vector<SpeedCase> cases;
    add_starts(cases);
    add_sizes(short_sizes, cases);
    add_cloths(cases);
    add_colliders(cases);
    add_ensembles(is_short, cases);
    add_pictures(cases);
    for (const SkipCase& skip : skip_cases())
        cases.push_back({.name = skip.name, .kind = SpeedKind::skip, .group = "skips"});
    if (!is_short) add_sizes(long_sizes, cases);
    return cases;
}

std::vector<SpeedCase> kernel_cases(bool is_short) {
    std::vector<SpeedCase> cases;
    add_sizes(short_sizes, cases);
    if (!is_short) add_sizes(long_sizes, cases);
    add_cloths(cases);
    for (SpeedCase& each : cases) {
        each.kind = SpeedKind::kernels;
        each.name.insert(0, "kernels/");
    }
    return cases;
}

SceneDescription scene_of(const SpeedCase& speed_case) {
    SceneDescription scene = model_scenes::sheet(speed_case.size, speed_case.size, 1, 1, speed_case.substeps());
    scene.name = speed_case.name;
    scene.time.frame_count = 1'000'000;  // as many as are asked for
    scene.solver.method = speed_case.method;
    scene.image = {{1280, 720}, speed_case.samples};
    scene.camera = Camera{{1.6, 0.9, 2.4}, {0.5, -0.4, 0.4}};
    scene.lights = {{.direction = {0, -1, 0}}};
    Cloth& first = scene.cloths[0];
    first.placement.v = {0, 0, 1};
    model_scenes::set_wave_speed(first, 100);
    first.pins = {model_scenes::pin_top(first)};
    for (std::uint32_t k = 1; k < speed_case.cloths; ++k) {
        const std::uint32_t column = k % 8, row = k / 8;
        Cloth cloth = scene.cloths[0];
        cloth.name = fmt::format("sheet {}", k);
        cloth.placement.origin = {1.2 * column, 0, 1.2 * row};
        scene.cloths.push_back(cloth);
    }
    for (std::uint32_t k = 0; k < speed_case.colliders; ++k) {
        const std::uint32_t column = k % 8, row = k / 8;
        scene.colliders.push_back({.shape = Sphere{{0.12 * column, 0.3, 0.12 * row}, 0.05}});
    }
    return scene;
}

const std::vector<SkipCase>& skip_cases() {
    static const std::vector<SkipCase> cases{
        {"skip/needless fields", "flag.json", "masks of a whole cloth, tensions of single iterations (--no-skip)",
         as_it_is, no_skip},
        {"skip/colliders out of reach", "four_colliders.json",
         "contact of particles that no collider can reach (--no-skip)", as_it_is, no_skip},
        {"skip/pictures", "cloth_on_sphere.json", "normals, shadow, raster and colour readback of `simulate`", as_it_is,
         draw},
        {"skip/frames", "cloth_on_sphere.json", "pictures of frames nobody asked for (-j 10)", draw_every_tenth, draw},
        {"skip/position readback", "flag.json", "positions that nobody wants", as_it_is, read_back},
        {"skip/statistics", "flag.json", "statistics that nobody wants", as_it_is, judge},
        {"skip/iterations", "hanging_sheet.json",
         "iterations after the tolerance of 0.05 is met, 16 at most (adaptive)", iterate_until_met, iterate},
        {"skip/frames at rest", "cloth_on_sphere.json",
         "cloth that lies on the floor, asleep; without: a ball out of its reach turns (adaptive)", lie_still,
         lie_awake, 100},
    };
    return cases;
}

}  // namespace drape::bench
