#include "bench/stability_case.h"

#include <fmt/format.h>

#include <algorithm>

#include "bench/random_scenes.h"
#include "solver/kernel_choice.h"
#include "world/random.h"

namespace drape::bench {

namespace {

constexpr Tier A = Tier::accurate, B = Tier::bounded, C = Tier::refused;

/// With D the substep, h an edge of 0.05 m, N = 12 edges and K sweeps: G = g D^2/h, Lambda = g D^2 N^2/(h K),
/// C = |v| D/h, U = ulp(max |x|)/h. The base has G = 1.4e-4 and Lambda = 0.02.
const std::vector<Extreme> table{
    {"base", "base", A, {}},
    {"gravity", "gravity none", A, {"/gravity=[0,0,0]"}},
    {"gravity", "gravity G 0.14", B, {"/gravity=[0,-9810,0]"}},
    {"gravity", "gravity G 14", B, {"/gravity=[0,-981000,0]"}},
    {"gravity", "gravity 3e38", C, {"/gravity=[0,-3e38,0]"}},
    {"gravity", "gravity infinite", C, {"/gravity=[0,-1e999,0]"}},
    {"time", "fps 1000", A, {"/time/fps=1000"}},
    {"time", "fps 1, G 0.5", B, {"/time/fps=1"}},
    {"time", "fps 0.03, G 545", B, {"/time/fps=0.03"}},
    {"time", "fps 1e-10", C, {"/time/fps=1e-10"}},
    {"speed", "speed C 0.5", A, {"/cloths/0/velocity=[0,0,30]"}},
    {"speed", "speed C 1", B, {"/cloths/0/velocity=[0,0,60]"}},
    {"speed", "speed C 10", B, {"/cloths/0/velocity=[0,0,600]"}},
    {"speed", "speed C 1000", B, {"/cloths/0/velocity=[0,0,60000]"}},
    {"origin", "origin U 6e-4", A, {"/cloths/0/placement/origin=[300,1,0]"}},
    {"origin", "origin U 5e-3", B, {"/cloths/0/placement/origin=[4000,1,0]"}},
    {"origin", "origin U 0.08", B, {"/cloths/0/placement/origin=[50000,1,0]"}},
    {"origin", "origin U 1.2", C, {"/cloths/0/placement/origin=[1e6,1,0]"}},
    {"mass", "mass 1e-4", B, {"/cloths/0/areal_density=1e-4"}},
    {"mass", "mass 1e4", B, {"/cloths/0/areal_density=1e4"}},
    {"mass", "mass 0", C, {"/cloths/0/areal_density=0"}},
    {"steps", "substeps 64", A, {"/solver/substeps=64"}},
    {"steps", "substeps 1", B, {"/solver/substeps=1"}},
    {"steps", "substeps 1024", B, {"/solver/substeps=1024"}},
    {"steps", "substeps 0", C, {"/solver/substeps=0"}},
    {"steps", "substeps 5000", C, {"/solver/substeps=5000"}},
    {"sweeps", "sweeps 64", A, {"/solver/iterations=64"}},
    {"stiffness", "rigid", B, {"/cloths/0/stiffness=\"rigid\""}},
    {"stiffness", "stretch 100", A, {"/cloths/0/stiffness/stretch=100"}},
    {"stiffness", "stretch 0.01", B, {"/cloths/0/stiffness/stretch=0.01"}},
    {"stiffness", "stretch 1e-38", B, {"/cloths/0/stiffness/stretch=1e-38"}},
    {"stiffness", "stretch 1e8", B, {"/cloths/0/stiffness/stretch=1e8"}},
    {"stiffness", "stretch 1e30", B, {"/cloths/0/stiffness/stretch=1e30"}},
    {"stiffness", "stretch -1", C, {"/cloths/0/stiffness/stretch=-1"}},
    {"shear", "shear none", A, {"/cloths/0/stiffness/shear=0"}},
    {"shear", "shear 1e6", B, {"/cloths/0/stiffness/shear=1e6"}},
    {"bend", "bend 1e-3", A, {"/cloths/0/stiffness/bend=1e-3"}},
    {"bend", "bend 100", B, {"/cloths/0/stiffness/bend=100"}},
    {"compression", "compression 0.1", A, {"/cloths/0/stiffness/compression=0.1"}},
    {"compression", "compression 0.001", A, {"/cloths/0/stiffness/compression=0.001"}},
    {"contact", "self collision", A, {"/cloths/0/self_collision=true"}},
    {"contact", "self collision 0.1 edge", A, {R"(/cloths/0/self_collision={"thickness":0.005})"}},
    {"contact", "self collision 1 edge", A, {R"(/cloths/0/self_collision={"thickness":0.05})"}},
    {"damping", "damping none", A, {"/cloths/0/damping=0"}},
    {"damping", "damping 1e6", B, {"/cloths/0/damping=1e6"}},
    {"damping", "damping -1", C, {"/cloths/0/damping=-1"}},
    {"grid", "grid 33 x 17", A, {"/cloths/0/grid=[33,17]"}},
    {"grid", "grid 2 x 2", B, {"/cloths/0/grid=[2,2]"}},
    {"grid", "grid 256 x 2", B, {"/cloths/0/grid=[256,2]"}},
    {"grid", "grid 1 x 5", C, {"/cloths/0/grid=[1,5]"}},
    {"grid", "grid 1e5 x 1e5", C, {"/cloths/0/grid=[100000,100000]"}},
    {"start", "start point", B, {"/cloths/0/placement/scale=[0,0]", R"(/cloths/0/pins=[{"corner":"top_left"}])"}},
    {"start", "start line", B, {"/cloths/0/placement/scale=[1,0]"}},
    {"start",
     "start flattened",
     B,
     {"/cloths/0/placement/scale=[0.001,0.001]", R"(/cloths/0/pins=[{"corner":"top_left"}])"}},
    {"start", "start turned over", B, {"/cloths/0/placement/scale=[1,-1]"}},
    {"start", "start stretched 10", B, {"/cloths/0/placement/scale=[1,10]"}},
    {"start", "start stretched 100", B, {"/cloths/0/placement/scale=[1,100]"}},
    {"start", "start random", B, {"/cloths/0/placement/jitter=0.3"}},
    {"pins", "pins none", A, {"/cloths/0/pins=[]"}},
    {"pins", "pins corner", A, {R"(/cloths/0/pins=[{"corner":"top_left"}])"}},
    {"pins", "pins two corners", A, {R"(/cloths/0/pins=[{"corner":"top_left"},{"corner":"top_right"}])"}},
    {"pins",
     "pins all around",
     A,
     {R"(/cloths/0/pins=[{"edge":"top"},{"edge":"left"},{"edge":"right"},{"edge":"bottom"}])"}},
    {"pins", "pins released", A, {R"(/cloths/0/pins=[{"edge":"top","release":0.3}])"}},
    {"pins",
     "pins teleport",
     B,
     {R"(/cloths/0/pins=[{"edge":"top","path":[{"t":0.2},{"t":0.2001,"translate":[5,3,-2]}]}])"}},
    {"pins",
     "pins 100 turns",
     B,
     {R"(/cloths/0/pins=[{"edge":"top"},{"edge":"bottom","path":[{"t":0},{"t":1,"rotate":[0,36000,0]}]}])"}},
    {"wind", "wind 5", A, {"/wind/velocity=[0,0,5]"}},
    {"wind", "wind 50", B, {"/wind/velocity=[0,0,50]"}},
    {"wind", "wind 300", B, {"/wind/velocity=[200,0,224]"}},
    {"collider", "floor", A, {R"(/colliders/planes=[{"normal":[0,1,0],"offset":0.5}])"}},
    {"collider", "ball below", A, {R"(/colliders/spheres=[{"center":[0,0.8,-0.3],"radius":0.25}])"}},
    {"collider", "ball inside", B, {R"(/colliders/spheres=[{"center":[0,0.78,0.12],"radius":0.15}])"}},
    {"collider",
     "ball 20 thicknesses",
     B,
     {R"(/colliders/spheres=[{"center":[0,0.8,-6],"radius":0.1,"path":[{"t":0.2},{"t":0.35,"translate":[0,0,12]}]}])"}},
    {"collider", "ball radius 1e-6", B, {R"(/colliders/spheres=[{"center":[0.01,0.8,0],"radius":1e-6}])"}},
    {"collider", "ball radius 1e6", B, {R"(/colliders/spheres=[{"center":[0,-999999.5,0],"radius":1e6}])"}},
    {"collider",
     "two boxes pinch",
     B,
     {R"(/colliders/boxes=[{"center":[0,0.7,-0.5],"half_extents":[0.2,0.1,0.2],"path":[{"t":0},{"t":0.4,"translate":[0,0,0.29]}]},{"center":[0,0.7,0.5],"half_extents":[0.2,0.1,0.2],"path":[{"t":0},{"t":0.4,"translate":[0,0,-0.29]}]}])"}},
    {"collider", "ball radius -1", C, {R"(/colliders/spheres=[{"radius":-1}])"}},
    {"cut", "cut a line", A, {R"(/cutters=[{"triangle":[[0.01,2,-2],[0.01,2,2],[0.01,-2,0]],"active":[0.1,0.1]}])"}},
    {"cut", "cut in frame 0", B, {R"(/cutters=[{"triangle":[[0.01,2,-2],[0.01,2,2],[0.01,-2,0]],"active":[0,0]}])"}},
    {"cut", "cut through pins", B, {R"(/cutters=[{"triangle":[[-2,1,-2],[2,1,-2],[0,1,4]],"active":[0.1,0.1]}])"}},
    {"cut", "cut through vertices", B, {R"(/cutters=[{"triangle":[[0,2,-2],[0,2,2],[0,-2,0]],"active":[0,0.1]}])"}},
    {"cut",
     "cut all edges",
     B,
     {R"(/cutters=[{"triangle":[[-3,-3,0],[3,-3,0],[0,6,0]],"active":[0,0.5],"path":[{"t":0,"translate":[0,0,-1]},{"t":0.5,"translate":[0,0,1]}]},{"triangle":[[-1,0,-1],[-1,0,1],[-1,2,0]],"active":[0,0.5],"path":[{"t":0},{"t":0.5,"translate":[2,0,0]}]},{"triangle":[[-2,0,-2],[2,0,-2],[0,0,4]],"active":[0,0.5],"path":[{"t":0},{"t":0.5,"translate":[0,1.5,0]}]}])"}},
};

constexpr std::uint32_t single_frames = 60, soak_frames = 20000, short_soak_frames = 1200;

Tier worse(Tier a, Tier b) { return std::max(a, b); }

StabilityCase case_of(const std::string& kind, std::vector<std::size_t> chosen, SolverMethod method) {
    StabilityCase each;
    each.tier = chosen.size() > 1 ? Tier::bounded : Tier::accurate;
    std::string names;
    for (const std::size_t index : chosen) {
        each.tier = worse(each.tier, table[index].tier);
        names += (names.empty() ? "" : " + ") + std::string(table[index].name);
    }
    each.name = fmt::format("{}/{}/{}", kind, names, named(method).name);
    each.extremes = std::move(chosen);
    each.method = method;
    each.frames = single_frames;
    return each;
}

void add_singles(const StabilityPlan& plan, std::vector<StabilityCase>& cases) {
    for (std::size_t index = 0; index < table.size(); ++index)
        for (const SolverMethodName& method : solver_method_names) {
            cases.push_back(case_of("single", {index}, method.method));
            if (plan.is_short || table[index].tier == Tier::refused) continue;
            for (const KernelSet& set : all_kernel_sets) {
                if (method.method == SolverMethod::automatic || !concerns(set, method.method)) continue;
                cases.push_back(case_of("single", {index}, method.method));
                cases.back().name += fmt::format("/{}", set.name);
                cases.back().kernels = set.kernels;
            }
        }
}

bool together(std::size_t a, std::size_t b) {
    return table[a].axis != std::string_view(table[b].axis) && table[a].tier != C && table[b].tier != C;
}

void add_pairs(std::vector<StabilityCase>& cases) {
    for (std::size_t a = 1; a < table.size(); ++a)
        for (std::size_t b = a + 1; b < table.size(); ++b)
            if (together(a, b))
                for (const SolverMethodName& method : solver_method_names)
                    cases.push_back(case_of("pair", {a, b}, method.method));
}

/// 3 to 6 extremes of different axes.
std::vector<std::size_t> mix(std::uint32_t seed, std::uint32_t index) {
    std::uint64_t state = splitmix64(seed) + index * 1000 * splitmix64_step;
    const auto below = [&state](std::size_t count) {
        state += splitmix64_step;
        return static_cast<std::size_t>(unit_interval_of(splitmix64(state)) * static_cast<double>(count));
    };
    const std::size_t count = 3 + below(4);
    std::vector<std::size_t> chosen;
    while (chosen.size() < count) {
        const std::size_t next = 1 + below(table.size() - 1);
        if (table[next].tier != C && std::ranges::all_of(chosen, [&](std::size_t one) { return together(one, next); }))
            chosen.push_back(next);
    }
    std::ranges::sort(chosen);
    return chosen;
}

void add_drawn(const StabilityPlan& plan, std::vector<StabilityCase>& cases) {
    for (std::uint32_t index = 0; index < plan.mixes; ++index) {
        const SolverMethodName& method = solver_method_names[index % solver_method_names.size()];
        cases.push_back(case_of(fmt::format("mix/{}", index), mix(plan.seed, index), method.method));
    }
    for (std::uint32_t index = 0; index < plan.randoms; ++index) {
        StabilityCase each;
        each.name = fmt::format("random/{}/{}", plan.seed, index);
        each.seed = plan.seed;
        each.index = index;
        each.random = true;
        cases.push_back(each);
    }
}

/// One of the generator's scenes, small, half of them by a method and settings that somebody may ask for.
SceneDescription random_scene_of(const StabilityCase& each) {
    constexpr std::uint32_t largest_side = 24;
    SceneDescription scene = wild_scene(each.seed, each.index);
    std::uint64_t state = splitmix64(each.seed ^ (std::uint64_t{each.index} << 32));
    const auto unit = [&state] { return unit_interval_of(splitmix64(state += splitmix64_step)); };
    for (Cloth& cloth : scene.cloths) {
        const std::array<std::uint32_t, 2> wanted = cloth.grid;
        for (std::size_t k = 0; k < 2; ++k) cloth.grid[k] = std::min(cloth.grid[k], largest_side);
        for (Pin& pin : cloth.pins)
            for (std::size_t k = 0; k < 2; ++k)
                for (std::uint32_t* side : {&pin.particles.first[k], &pin.particles.last[k]})
                    *side = static_cast<std::uint32_t>(std::uint64_t{*side} * (cloth.grid[k] - 1) / (wanted[k] - 1));
    }
    if (unit() < 0.5) return scene;
    constexpr SolverMethod methods[] = {SolverMethod::explicit_steps, SolverMethod::line, SolverMethod::relax};
    scene.solver.method = methods[static_cast<std::size_t>(3 * unit())];
    scene.solver.substeps = static_cast<std::uint32_t>(std::exp2(7 * unit()));
    scene.solver.iterations = unit() < 0.7 ? 1 : 1 + static_cast<std::uint32_t>(8 * unit());
    return scene;
}

}  // namespace

std::span<const Extreme> extremes() { return table; }

std::string base_scene() {
    return R"({"name": "stability", "time": {"fps": 60},
 "cloths": [{"grid": [13, 9], "size": [0.6, 0.4], "placement": {"origin": [-0.3, 1, 0], "u": [1, 0, 0], "v": [0, -4, 3]},
   "areal_density": 0.2, "stiffness": {"stretch": 1000, "shear": 100, "bend": 0}, "damping": 1, "pins": [{"edge": "top"}]}],
 "solver": {"method": "auto", "substeps": 20, "iterations": 1}}
)";
}

std::vector<std::string> overrides_of(const StabilityCase& each) {
    std::vector<std::string> all{fmt::format("/solver/method=\"{}\"", named(each.method).name)};
    for (const std::size_t index : each.extremes)
        for (const char* override_text : table[index].overrides) all.emplace_back(override_text);
    all.push_back(fmt::format("/time/frames={}", each.frames + each.recovery + 1));
    return all;
}

std::vector<StabilityCase> stability_cases(const StabilityPlan& plan) {
    std::vector<StabilityCase> cases;
    add_singles(plan, cases);
    add_drawn(plan, cases);
    if (!plan.is_short) add_pairs(cases);
    for (const SolverMethodName& method : solver_method_names) {
        if (plan.is_short && method.method != SolverMethod::automatic) continue;
        cases.push_back(case_of("soak", {0}, method.method));
        cases.back().frames = plan.is_short ? short_soak_frames : soak_frames;
    }
    if (plan.is_short)
        for (StabilityCase& each : cases) each.recovery = short_recovery_frames;
    return cases;
}

SceneResult scene_of(const StabilityCase& each) {
    if (!each.random) return read_scene_text(base_scene(), "stability", overrides_of(each));
    SceneResult result;
    result.scene = random_scene_of(each);
    return result;
}

}  // namespace drape::bench
