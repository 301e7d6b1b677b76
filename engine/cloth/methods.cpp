#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <type_traits>

#include "cloth/cloth_state.h"
#include "cloth/method_explicit.h"
#include "cloth/method_line.h"
#include "cloth/method_relax.h"
#include "cloth/texels.h"

namespace drape {

namespace {

// With 2.61 or more micro-steps per link nothing is softened, at a wave speed of 100 m/s and 60 frames/s.
constexpr double explicit_sweep[] = {0.5, 0.707, 1, 1.414, 2, 2.61, 3.2}, explicit_quick[] = {0.5, 1, 2.61};
constexpr double line_sweep[] = {4, 8, 12, 16, 20, 30, 40, 80, 160}, line_quick[] = {4, 8, 20};
constexpr double relax_sweep[] = {1, 2, 5, 10, 20, 40, 80, 160, 320}, relax_quick[] = {5, 20, 80};

constexpr Method rows[] = {
    {SolverMethod::line,
     line_scheme,
     line_substeps,
     Method::Trust::probed,
     4096,
     1,
     16,
     {false, line_sweep, line_quick}},
    {SolverMethod::explicit_steps,
     explicit_scheme,
     explicit_substeps,
     Method::Trust::resolves,
     4096,
     3,
     0,
     {true, explicit_sweep, explicit_quick}},
    {SolverMethod::relax,
     relax_scheme,
     relax_substeps,
     Method::Trust::none,
     4096,
     1,
     8,
     {false, relax_sweep, relax_quick}},
};

/// Returns c h, limited so that a substep leaves at least this share of a velocity: the displacement before the start
/// is larger than the next one by the inverse of that share, and has only so many digits.
double damped(double damping, double h) {
    constexpr double least_left = 1.0 / 128;
    static const double most = -std::log(least_left);
    return std::min(damping * h, most);
}

/// Returns the displacement of the substep before the start that makes damped ballistic flight exact (docs/physics.md
/// 3): d0 = v_inf h + (v0 - v_inf)(e^(c h) - 1)/c with v_inf = g/c; for small c h by its series.
double start_displacement(double velocity, double acceleration, double damping, double h) {
    const double ch = damping * h;
    if (ch < 1e-5) return velocity * h * (1 + ch / 2) - acceleration * h * h * (0.5 + ch / 6);
    const double growth = std::expm1(damped(damping, h)) / damping;
    return velocity * growth + acceleration / damping * (h - growth);
}

/// Collects bytes. Push structures have no padding: every member is of four bytes or a vector of them.
struct ByteList {
    std::vector<std::byte> bytes;

    template <class T>
    void add(const T& value) {
        const std::span<const std::byte> more = std::as_bytes(std::span(&value, 1));
        bytes.insert(bytes.end(), more.begin(), more.end());
    }
    void add(const std::vector<MethodStep>& steps) {
        add(steps.size());
        for (const auto& [kind, constants] : steps) {
            add(kind);
            std::visit(
                [this]<class T>(const T& push) {
                    if constexpr (!std::is_empty_v<T>) add(push);  // an empty structure's byte is undefined
                },
                constants);
        }
    }
};

}  // namespace

std::uint32_t whole_substeps(double substeps) { return static_cast<std::uint32_t>(std::min(std::ceil(substeps), 1e9)); }

std::vector<std::byte> bytes_of(const MethodScheme& scheme) {
    // The binding names every member, so a new member does not compile until it is added here.
    const auto& [prediction, once, iterated, ended, start, starts, spare_state, spare_displacement, spare_tension,
                 second_order, line_scratch, nested_table, carries_tension, release_stiffness, gathered_tension,
                 used_stiffness, used_bend, used_twist, following_substeps, skipped, compromises] = scheme;
    ByteList list;
    const auto add = [&list](const auto&... members) { (list.add(members), ...); };
    add(prediction, once, iterated, ended, start, spare_state, spare_displacement, spare_tension, second_order,
        line_scratch, carries_tension, release_stiffness, gathered_tension.value_or(glsl::TensionPush{}),
        used_stiffness, used_bend, used_twist, following_substeps);
    for (const glsl::ivec4& entry : nested_table) list.add(entry);
    for (const glsl::vec4& each : starts) list.add(each);
    static_cast<void>(skipped), static_cast<void>(compromises);  // these are texts
    return list.bytes;
}

std::span<const Method> methods() { return rows; }

const Method& row_of(SolverMethod method) {
    const auto row = std::ranges::find(rows, method, &Method::method);
    if (row == std::end(rows)) throw std::logic_error("method auto is chosen before it is asked for its row");
    return *row;
}

double damping_mean(double damping, double h) {
    return damping > 0 ? -std::expm1(-damped(damping, h)) / (damping * h) : 1.0;
}

glsl::ForcePush force_constants(const ClothGeometry& cloth, const MethodSettings& settings) {
    const double h = settings.substep_length, step = damping_mean(cloth.damping, h) * h * h;
    const Vec3& gravity = settings.gravity;
    return {cloth.grid.size(), static_cast<float>(-std::expm1(-damped(cloth.damping, h))),
            static_cast<float>(step / cloth.inner_mass),
            texel(Vec3{step * gravity[0], step * gravity[1], step * gravity[2]}, 0)};
}

void add_rotation(const ClothGeometry& cloth, const MethodSettings& settings, float drag_ratio, MethodScheme& scheme) {
    if (!settings.turn) return;
    const KeptTurn& turn = *settings.turn;
    const glsl::ForcePush force = force_constants(cloth, settings);
    const glsl::RotationPush push{cloth.grid.size(),
                                  turn.about,
                                  texel(turn.axis, turn.any ? 1.0 : 0.0),
                                  force.gravity_step,
                                  force.damping_loss,
                                  force.force_step,
                                  drag_ratio,
                                  static_cast<int>(torque_count(cloth.grid))};
    scheme.ended = {{StepKind::torque, push}, {StepKind::rotate, push}};
}

glsl::vec4 verlet_start(const ClothGeometry& cloth, const MethodSettings& settings, const Vec3& velocity) {
    Vec3 start;
    for (std::size_t k = 0; k < 3; ++k)
        start[k] = start_displacement(velocity[k], settings.gravity[k], cloth.damping, settings.substep_length);
    return texel(start, 0);
}

void set_start(const ClothGeometry& cloth, const std::function<glsl::vec4(const Vec3&)>& displacement,
               MethodScheme& scheme) {
    scheme.start = displacement(cloth.velocity);
    scheme.starts.clear();
    for (const Vec3& velocity : cloth.velocities) scheme.starts.push_back(displacement(velocity));
}

void set_verlet_start(const ClothGeometry& cloth, const MethodSettings& settings, MethodScheme& scheme) {
    set_start(
        cloth, [&](const Vec3& velocity) { return verlet_start(cloth, settings, velocity); }, scheme);
}

void note_compromise(const ClothGeometry& cloth, const MethodSettings& settings, const std::string& what,
                     const std::string& followed, double enough_substeps, MethodScheme& scheme) {
    const std::string remedy = enough_substeps > 0
                                   ? fmt::format("{:.0f} substeps would follow all of it", enough_substeps)
                                   : "rigid springs are as stiff as the substeps allow";
    scheme.compromises.push_back({cloth.name + "/" + what,
                                  fmt::format("{} at {} substeps; {}", followed, settings.substeps, remedy),
                                  static_cast<std::uint32_t>(std::min(enough_substeps, 4294967295.0))});
}

void carry_tension_to_release(const ClothGeometry& cloth, const MethodSettings& settings, MethodScheme& scheme) {
    const PerDirection<double>& constant = cloth.stiffness_constant.spring;
    if (!cloth.has_release || (constant[0] == 0 && constant[1] == 0)) return;
    scheme.carries_tension.fill(true);
    const double scale = damping_mean(cloth.damping, settings.substep_length) * settings.substep_length *
                         settings.substep_length / cloth.inner_mass;
    PerDirection<double> scaled = constant;
    for (double& value : scaled) value *= scale;
    scheme.release_stiffness = texel(scaled);
}

void note_tension(const ClothGeometry& cloth, MethodScheme& scheme) {
    if (std::ranges::none_of(scheme.carries_tension, std::identity()))
        scheme.skipped.push_back({cloth.name + "/tension between iterations",
                                  cloth.rigid ? "rigid springs need none" : "one iteration per substep needs none"});
}

}  // namespace drape
