#include "cloth/cloth_model.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "fmt/format.h"

namespace drape {

namespace {

glsl::vec4 texel(const Vec3& v, float w) {
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]), w};
}

/// phi = (1 - e^(-c h)) / (c h): the mean of the damping factor over a substep.
double damping_mean(double damping, double h) { return damping > 0 ? -std::expm1(-damping * h) / (damping * h) : 1.0; }

/// Displacement of the substep before the start that makes damped ballistic flight exact (docs/physics.md 3):
/// d0 = v_inf h + (v0 - v_inf)(e^(c h) - 1)/c with v_inf = g/c; for small c h by its series.
double start_displacement(double velocity, double acceleration, double damping, double h) {
    const double ch = damping * h;
    if (ch < 1e-5) return velocity * h * (1 + ch / 2) - acceleration * h * h * (0.5 + ch / 6);
    const double growth = std::expm1(ch) / damping;
    return velocity * growth + acceleration / damping * (h - growth);
}

/// What one sweep over the three colours adds to the compliance of a smoothly bent cloth: an element is relaxed before
/// its neighbours, whose corrections take 6, 3 and 0 lambda of its own away again; 3 on average. Measured on the
/// cantilever: 2.2 at 16 elements, 2.7 at 32.
constexpr double bend_sweep_compliance = 3;
/// Likewise of one sweep over the four colours of a smoothly twisted cloth: later neighbours take 4, 0, 4 and 0 lambda
/// away; 2 on average, half of a cell's own inverse mass as the 3 is half of an element's. Measured
/// on a saddle: 2.2 at m/(t h^2) = 30, 2.4 at 10.
constexpr double twist_sweep_compliance = 2;

double length(const Vec3& v) { return std::hypot(v[0], v[1], v[2]); }

glsl::vec4 texel(const std::array<double, 4>& v) {
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]), static_cast<float>(v[3])};
}

}  // namespace

ClothModel::ClothModel(const SceneDescription& scene, std::size_t cloth_index, const ModelOptions& options)
    : name(scene.cloths[cloth_index].name),
      grid(scene.cloths[cloth_index].grid[0], scene.cloths[cloth_index].grid[1], scene.cloths[cloth_index].holes) {
    const Cloth& cloth = scene.cloths[cloth_index];
    spacing[0] = cloth.size[0] / (grid.columns() - 1);
    spacing[1] = cloth.size[1] / (grid.rows() - 1);
    inner_mass = cloth.areal_density * spacing[0] * spacing[1];
    substep_length = 1.0 / (scene.time.fps * scene.solver.substeps);
    masked = !grid.whole() || !options.skip;
    const bool is_line = scene.solver.method == SolverMethod::line;
    second_order = is_line && scene.colliders.empty();
    place(cloth, scene.gravity);
    hold_pins(cloth);
    stiffness_constant = stiffness_constants(cloth.stiffness, spacing);
    used_stiffness = stiffness_constant.spring;
    if (cloth.stiffness.rigid) used_stiffness.fill(std::numeric_limits<double>::infinity());
    // An axis of two particles has no elements; explicit steps need not mind them.
    if (grid.columns() < 3) stiffness_constant.bend[0] = 0;
    if (grid.rows() < 3) stiffness_constant.bend[1] = 0;
    used_bend = cloth.stiffness.bend;
    if (used_bend == 0) skipped.push_back({name + "/bending", "zero rigidity"});
    gathers = scene.solver.method == SolverMethod::explicit_steps;
    if (!gathers) add_bends(scene.solver.substeps, line_settings(cloth));
    if (!gathers && !is_line) add_springs(cloth, scene.solver.iterations, options);
    set_constants(scene, cloth);
    if (gathers) set_explicit(scene, cloth);
    if (is_line) set_lines(scene, cloth, options);
    if (scene.solver.tethers) set_tethers(scene, cloth);
}

void ClothModel::set_tethers(const SceneDescription& scene, const Cloth& cloth) {
    if (cloth.pins.empty()) return skipped.push_back({name + "/tethers", "no pins to hold on to"});
    tethers = find_tethers(grid, spacing, cloth.pins, tether_give(cloth, scene.gravity));
    if (!scene.cutters.empty())
        skipped.push_back(
            {name + "/tethers after a cut", "what was cut off hangs on nothing: the first cut ends them"});
}

void ClothModel::drop_tethers() { std::ranges::fill(tethers, glsl::ParticleTethers{-1, -1, 0, 0}); }

void ClothModel::place(const Cloth& cloth, const Vec3& gravity) {
    Vec3 start;
    for (std::size_t k = 0; k < 3; ++k)
        start[k] = second_order ? cloth.velocity[k] * substep_length
                                : start_displacement(cloth.velocity[k], gravity[k], cloth.damping, substep_length);
    for (std::uint32_t row = 0; row < grid.rows(); ++row)
        for (std::uint32_t column = 0; column < grid.columns(); ++column) {
            Vec3 at = cloth.placement.origin;
            for (std::size_t k = 0; k < 3; ++k)
                at[k] += column * spacing[0] * cloth.placement.u[k] + row * spacing[1] * cloth.placement.v[k];
            const float weight = grid.relative_inverse_mass(column, row);
            free_weight.push_back(weight);
            position.push_back(texel(at, weight));
            displacement.push_back(weight > 0 ? texel(start, 0) : glsl::vec4{});
            if (masked) stiffness.push_back(grid.spring_shares(column, row));
        }
    if (!masked) skipped.push_back({name + "/stiffness", "no holes or cuts: the grid's extent gives every stiffness"});
}

void ClothModel::make_masked() {
    if (masked) return;
    masked = true;
    for (std::uint32_t row = 0; row < grid.rows(); ++row)
        for (std::uint32_t column = 0; column < grid.columns(); ++column)
            stiffness.push_back(grid.spring_shares(column, row));
}

void ClothModel::hold_pins(const Cloth& cloth) {
    // A later pin overrides an earlier one on the particles that they share.
    std::vector<int> owner(grid.particle_count(), -1);
    for (std::size_t pin = 0; pin < cloth.pins.size(); ++pin) {
        const IndexBox& box = cloth.pins[pin].particles;
        for (std::uint32_t row = box.first[1]; row <= box.last[1]; ++row)
            for (std::uint32_t column = box.first[0]; column <= box.last[0]; ++column)
                owner[grid.particle(column, row)] = static_cast<int>(pin);
    }
    std::vector<int> dynamic_index(cloth.pins.size(), -1);
    std::vector<std::vector<std::uint32_t>> held(cloth.pins.size());
    for (std::uint32_t particle = 0; particle < owner.size(); ++particle) {
        if (owner[particle] < 0) continue;
        position[particle].w = 0;
        displacement[particle] = {};
        held[static_cast<std::size_t>(owner[particle])].push_back(particle);
    }
    for (std::size_t index = 0; index < cloth.pins.size(); ++index) {
        const Pin& pin = cloth.pins[index];
        const bool moves = !pin.path.keys.empty();
        if ((!moves && !pin.release) || held[index].empty()) continue;
        has_motion = has_motion || moves;
        has_release = has_release || pin.release.has_value();
        Vec3 centroid{};
        for (const std::uint32_t particle : held[index]) {
            centroid[0] += static_cast<double>(position[particle].x) / static_cast<double>(held[index].size());
            centroid[1] += static_cast<double>(position[particle].y) / static_cast<double>(held[index].size());
            centroid[2] += static_cast<double>(position[particle].z) / static_cast<double>(held[index].size());
        }
        for (const std::uint32_t particle : held[index]) {
            const glsl::vec4 at = position[particle];
            pinned.push_back({{at.x, at.y, at.z, free_weight[particle]},
                              {static_cast<int>(particle % grid.columns()), static_cast<int>(particle / grid.columns()),
                               static_cast<int>(dynamic_pins.size()), 0}});
        }
        dynamic_pins.push_back({pin.path, pin.pivot.value_or(centroid), pin.release});
    }
    if (!has_motion) skipped.push_back({name + "/pin motion", "no pin has a path"});
    if (!has_release) skipped.push_back({name + "/pin release", "no pin is released"});
}

void ClothModel::add_springs(const Cloth& cloth, std::uint32_t iterations, const ModelOptions& options) {
    const double h2 = substep_length * substep_length;
    for (const SpringPass& pass : spring_passes(grid.size())) {
        const SpringDirection& direction = spring_directions[static_cast<std::size_t>(pass.direction)];
        const auto index = static_cast<std::size_t>(pass.direction);
        const double constant = stiffness_constant.spring[index], rest = stiffness_constant.rest_length[index];
        const std::string what =
            fmt::format("{}/spring {} {}", name, direction.name, pass.parity == 0 ? "even" : "odd");
        if (constant == 0) {
            skipped.push_back({what, "zero stiffness"});
            continue;
        }
        if (pass.empty()) {
            skipped.push_back({what, "the grid has no such spring"});
            continue;
        }
        const bool compliant = !cloth.stiffness.rigid;
        carries_tension[pass.direction] = compliant && (iterations > 1 || !options.skip);
        const float compliance = compliant ? static_cast<float>(inner_mass / (constant * h2)) : 0.0f;
        springs.push_back({pass,
                           {grid.size(), pass.pair_count, direction.offset, direction.parity_axis, pass.parity,
                            static_cast<float>(rest), compliance, pass.direction, 1}});
    }
    note_tension(cloth);
}

void ClothModel::note_tension(const Cloth& cloth) {
    if (std::ranges::none_of(carries_tension, std::identity()))
        skipped.push_back({name + "/tension between iterations",
                           cloth.stiffness.rigid ? "rigid springs need none" : "one iteration per substep needs none"});
}

LineSettings ClothModel::line_settings(const Cloth& cloth) const {
    return {grid.size(), inner_mass, substep_length, cloth.damping, cloth.stiffness.rigid, second_order};
}

void ClothModel::set_lines(const SceneDescription& scene, const Cloth& cloth, const ModelOptions& options) {
    const LineSettings settings = line_settings(cloth);
    lines = line_passes(stiffness_constant, settings);
    if (second_order) {
        predict = predict_constants(force, settings, scene.gravity);
    } else {
        skipped.push_back({name + "/second order", "colliders: contact is backward Euler throughout"});
    }
    if (stiffness_constant.spring[2] == 0) skipped.push_back({name + "/shear springs", "zero stiffness"});
    bool softened = false;
    for (std::size_t direction = 0; direction < used_stiffness.size(); ++direction) {
        used_stiffness[direction] = line_stiffness(stiffness_constant.spring[direction], settings);
        softened = softened || used_stiffness[direction] < stiffness_constant.spring[direction];
    }
    for (const LineWork& line : lines)
        carries_tension[line.direction] = line.compliant && (scene.solver.iterations > 1 || !options.skip);
    note_tension(cloth);
    if (softened)
        skipped.push_back(
            {name + "/full stiffness",
             fmt::format("line solves follow {:.3g} N/m along columns, {:.3g} along rows and {:.3g} on "
                         "diagonals at {} substeps",
                         used_stiffness[0], used_stiffness[1], used_stiffness[2], scene.solver.substeps)});
}

void ClothModel::add_bends(std::uint32_t substeps, const LineSettings& settings) {
    if (used_bend == 0) return;
    const double twist = method_compliance(stiffness_constant.twist, settings);
    double share = std::min(1.0, twist / twist_sweep_compliance);
    for (const double constant : stiffness_constant.bend)
        if (constant > 0) share = std::min(share, method_compliance(constant, settings) / bend_sweep_compliance);
    // All elements are softened alike, so that the cloth stays as stiff in every direction.
    const auto compliance = [share](double wanted, double sweep) {
        return static_cast<float>(std::max(wanted / share - sweep, 1e-20));
    };
    for (const BendPass& pass : bend_passes(grid.size())) {
        const double constant = stiffness_constant.bend[static_cast<std::size_t>(pass.axis)];
        if (constant == 0 || pass.empty()) continue;
        bends.push_back(
            {pass,
             {grid.size(), pass.element_count, bend_axes[static_cast<std::size_t>(pass.axis)].offset, pass.colour,
              pass.axis, compliance(method_compliance(constant, settings), bend_sweep_compliance)}});
    }
    for (const TwistPass& pass : twist_passes(grid.size()))
        if (!pass.empty())
            twists.push_back({pass, {pass.element_count, pass.first, compliance(twist, twist_sweep_compliance)}});
    if (share == 1) return;
    used_bend *= share;
    skipped.push_back({name + "/full bending",
                       fmt::format("one sweep per substep follows {:.3g} N m at {} substeps; {:.0f} substeps would "
                                   "follow all of it",
                                   used_bend, substeps, std::ceil(substeps / std::sqrt(share)))});
}

void ClothModel::set_explicit(const SceneDescription& scene, const Cloth& cloth) {
    explicit_stiffness =
        drape::explicit_stiffness(stiffness_constant, spacing, inner_mass, substep_length, scene.solver.strain_damping);
    const ExplicitStiffness& used = explicit_stiffness;
    used_stiffness = {used.columns_share * stiffness_constant.spring[0], used.rows_share * stiffness_constant.spring[1],
                      used.shear_share * stiffness_constant.spring[2], used.shear_share * stiffness_constant.spring[3]};
    std::array<double, 4> scaled = used.spring;
    const double mean = damping_mean(cloth.damping, substep_length);
    for (double& value : scaled) value *= mean;
    used_bend = used.bend_share * cloth.stiffness.bend;
    explicit_step = {grid.size(),
                     force.damping_loss,
                     force.force_step,
                     force.gravity_step,
                     texel(stiffness_constant.rest_length),
                     texel(scaled),
                     {static_cast<float>(mean * used.bend[0]), static_cast<float>(mean * used.bend[1])},
                     static_cast<float>(scene.solver.strain_damping),
                     static_cast<float>(mean * used.twist)};
    tension = {
        grid.size(),
        {static_cast<float>(stiffness_constant.rest_length[0]), static_cast<float>(stiffness_constant.rest_length[1])},
        {static_cast<float>(used.columns_share), static_cast<float>(used.rows_share)},
        explicit_step.strain_damping,
        0};
    if (stiffness_constant.spring[2] == 0) skipped.push_back({name + "/shear springs", "zero stiffness"});
    if (!used.softened()) return;
    const std::uint32_t substeps = scene.solver.substeps;
    const std::string remedy = cloth.stiffness.rigid ? std::string("rigid springs are as stiff as the substeps allow")
                                                     : fmt::format("{:.0f} substeps would follow all of it",
                                                                   std::ceil(used.full_substeps_factor * substeps));
    skipped.push_back(
        {name + "/full stiffness",
         fmt::format("explicit steps follow {:.3g} N/m along columns, {:.3g} along rows, {:.3g} on "
                     "diagonals and {:.3g} N m of bending at {} substeps; {}",
                     used_stiffness[0], used_stiffness[1], used_stiffness[2], used_bend, substeps, remedy)});
}

void ClothModel::set_constants(const SceneDescription& scene, const Cloth& cloth) {
    const double h = substep_length;
    const double step = damping_mean(cloth.damping, h) * h * h;
    const Vec3 gravity_step{step * scene.gravity[0], step * scene.gravity[1], step * scene.gravity[2]};
    force = {grid.size(), static_cast<float>(-std::expm1(-cloth.damping * h)), static_cast<float>(step / inner_mass),
             texel(gravity_step, 0)};
    const auto rest_length = [&](std::size_t direction) {
        return static_cast<float>(stiffness_constant.spring[direction] > 0 ? stiffness_constant.rest_length[direction]
                                                                           : 0);
    };
    residual = {grid.size(), {rest_length(0), rest_length(1)}};
    const Wind& w = scene.wind;
    wind = {grid.size(), 0, static_cast<float>(1.0 / h), static_cast<float>(0.5 * w.air_density * (w.drag - w.lift)),
            static_cast<float>(0.5 * w.air_density * w.lift)};
    // Contacts shallower than a few roundings of the coordinates cannot be improved by another round.
    double extent = length(cloth.placement.origin) + std::hypot(cloth.size[0], cloth.size[1]);
    const auto count = [](const auto& list) { return static_cast<int>(list.size()); };
    const Colliders& c = scene.colliders;
    collision = {{0, 0, 0, 0},
                 {count(c.planes), count(c.spheres), count(c.boxes), count(c.ellipsoids)},
                 {static_cast<float>(cloth.thickness), static_cast<float>(std::sqrt(cloth.friction)),
                  static_cast<float>(2.4e-7 * extent), 0},
                 {grid.size().x, grid.size().y, 0, 0}};
}

}  // namespace drape
