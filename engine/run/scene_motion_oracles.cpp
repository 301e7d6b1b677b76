// The checks about how the cloth moves: free fall, energy, torque of the wind, mirror symmetry, carrying by friction.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "run/scene_oracles.h"
#include "shared/collider_types.h"
#include "world/body_pose.h"
#include "world/gust.h"
#include "world/mass_properties.h"
#include "world/motion.h"
#include "world/start.h"
#include "world/surface_distance.h"
#include "world/up.h"
#include "world/weather.h"

namespace drape::verify {

namespace {

constexpr double degrees = 180 / std::numbers::pi;

/// Returns the displacement in damped ballistic flight: v t + (v0 - v)(1 - e^(-c t))/c with v = g/c.
Vec3 flown(const SceneDescription& scene, const Cloth& cloth, std::size_t particle, double t) {
    const double c = cloth.damping;
    const double gone = c > 0 ? -std::expm1(-c * t) / c : t;     // displacement for a unit start velocity
    const double fallen = c > 0 ? (t - gone) / c : 0.5 * t * t;  // displacement for unit gravity
    return plus(times(gone, start_velocity(cloth, particle)), times(fallen, gravity_at(scene, 0)));
}

/// Until something holds or touches them, the particles from row `from_row` on fall freely, to within `error` metres.
Verdict falls(const SceneRun& run, const Limits& limits) {
    const std::size_t index = limits.index("cloth"), last = std::min(limits.index("until_frame"), run.last_frame());
    const Cloth& cloth = run.scene.cloths.at(index);
    const std::vector<bool> has_cell = particles_of_cells(cloth);  // others stay where they are
    double worst = 0;
    if (last == 0 || limits.index("from_row") >= cloth.grid[1]) return {false, "there is no such frame or row"};
    for (std::size_t frame = 1; frame <= last; ++frame)
        for (std::size_t particle = limits.index("from_row") * cloth.grid[0];
             particle < run.frames[frame][index].size(); ++particle) {
            if (!has_cell[particle]) continue;
            const Vec3 moved = minus(run.at(frame, index, particle), run.at(0, index, particle));
            worst = std::max(worst, length(minus(moved, flown(run.scene, cloth, particle, run.time(frame)))));
        }
    return {worst <= limits["error"],
            fmt::format("{} off by {:.2e} m after falling {:.3f} m, allowed {:.2e} m", cloth.name, worst,
                        length(flown(run.scene, cloth, limits.index("from_row") * cloth.grid[0], run.time(last))),
                        limits["error"])};
}

struct Energy {
    double kinetic, potential;  ///< J, means over the time to the next frame
};

/// Returns the energies from mean velocities; this kinetic energy is at most the mean kinetic energy.
Energy energy_after(const SceneRun& run, const ClothMeasure& measure, std::size_t frame, std::size_t cloth) {
    Energy energy{0, 0};
    for (std::size_t particle = 0; particle < measure.mass.size(); ++particle) {
        const Vec3 v = run.velocity_after(frame, cloth, particle);
        const Vec3 x = times(0.5, plus(run.at(frame, cloth, particle), run.at(frame + 1, cloth, particle)));
        energy.kinetic += 0.5 * measure.mass[particle] * dot(v, v);
        energy.potential -= measure.mass[particle] * dot(gravity_at(run.scene, 0), x);
    }
    return energy;
}

/// All energy that gravity gives from `from_frame` on, less what damping takes (2 c times the kinetic energy per
/// second), becomes motion: at the fastest moment until `until_frame`, the kinetic energy is `least` to `most` of it.
/// The scene has no wind and no contact; the rest is strain and what the relaxation loses.
Verdict swing(const SceneRun& run, const Limits& limits) {
    const std::size_t cloth = limits.index("cloth"), first = limits.index("from_frame");
    const std::size_t last = std::min(limits.index("until_frame"), run.last_frame());
    if (first >= last) return {false, "there are no such frames"};
    const ClothMeasure measure(run.scene, cloth);
    double start = 0, lost = 0, fastest = 0, share = 0, when = 0;
    for (std::size_t frame = first; frame < last; ++frame) {
        const Energy energy = energy_after(run, measure, frame, cloth);
        const double step = energy.kinetic * 2 * run.scene.cloths[cloth].damping / run.scene.time.fps;
        if (frame == first) start = energy.kinetic + energy.potential;
        if (energy.kinetic > fastest) {
            fastest = energy.kinetic;
            share = energy.kinetic / (start - energy.potential - lost - 0.5 * step);
            when = run.time(frame) + 0.5 / run.scene.time.fps;
        }
        lost += step;
    }
    return {share >= limits["least"] && share <= limits["most"],
            fmt::format("{:.4f} of the work is motion at {:.3f} s ({:.3f} J), allowed {} to {}", share, when, fastest,
                        limits["least"], limits["most"])};
}

/// Returns the component of a vector along the vertical.
double about_up(const SceneRun& run, const Vec3& v) { return v[up_axis(run.scene.up)]; }

/// Returns a particle's velocity at a frame, m/s, from two frames before to two after it: to the fourth order of a
/// frame's length, since a flag flutters within few frames.
Vec3 velocity_at(const SceneRun& run, std::size_t frame, std::uint32_t particle) {
    const auto moved = [&](std::size_t by) {
        return minus(run.at(frame + by, 0, particle), run.at(frame - by, 0, particle));
    };
    return times(run.scene.time.fps / 12, minus(times(8, moved(1)), moved(2)));
}

/// Returns the torque of the wind about the vertical through `pole`, N m, by the scene format's force law.
double wind_torque(const SceneRun& run, const Grid& grid, std::size_t frame, const Vec3& pole) {
    const Wind& wind = run.scene.wind;
    const Vec3 air = wind_velocity(wind, run.time(frame));
    double torque = 0;
    const auto add_quarter = [&](std::uint32_t particle, std::uint32_t in_row, std::uint32_t in_column) {
        const Vec3 x = run.at(frame, 0, particle),
                   normal = cross(minus(run.at(frame, 0, in_row), x), minus(run.at(frame, 0, in_column), x));
        const double area = length(normal) / 4;
        if (area == 0) return;
        const Vec3 relative = minus(air, velocity_at(run, frame, particle));
        const Vec3 unit = times((dot(normal, relative) < 0 ? -0.25 : 0.25) / area, normal);
        const Vec3 force =
            times(0.5 * wind.air_density * area, plus(times((wind.drag - wind.lift) * dot(relative, unit), relative),
                                                      times(wind.lift * dot(relative, relative), unit)));
        torque += about_up(run, cross(minus(x, pole), force));
    };
    for (std::uint32_t row = 0; row + 1 < grid.rows(); ++row)
        for (std::uint32_t column = 0; column + 1 < grid.columns(); ++column) {
            if (grid.cell(static_cast<int>(column), static_cast<int>(row)) == 0) continue;
            const std::uint32_t a = grid.particle(column, row), b = a + 1, c = a + grid.columns(), d = c + 1;
            add_quarter(a, b, c), add_quarter(b, a, d), add_quarter(c, d, a), add_quarter(d, c, b);
        }
    return torque;
}

/// Returns the mean angular momentum about the vertical through `pole`, kg m^2/s, from a frame to the next.
double angular_momentum(const SceneRun& run, const ClothMeasure& measure, std::size_t frame, const Vec3& pole) {
    double sum = 0;
    for (std::size_t particle = 0; particle < measure.mass.size(); ++particle) {
        const Vec3 x = times(0.5, plus(run.at(frame, 0, particle), run.at(frame + 1, 0, particle)));
        sum += measure.mass[particle] * about_up(run, cross(minus(x, pole), run.velocity_after(frame, 0, particle)));
    }
    return sum;
}

/// A flag that is pinned along a vertical pole turns about the pole as the wind alone makes it: pins, springs and
/// gravity have no torque about the pole, so dL/dt = torque - c L. Integrated from `from_frame` to `until_frame`, the
/// difference between the two sides is at most `relative_error` of the integral of |torque|.
Verdict torque(const SceneRun& run, const Limits& limits) {
    const ClothMeasure measure(run.scene, 0);
    const Vec3 pole = run.at(0, 0, 0);
    const double dt = 1 / run.scene.time.fps, c = run.scene.cloths[0].damping;
    const std::size_t first = std::max<std::size_t>(limits.index("from_frame"), 2),
                      last = std::min(limits.index("until_frame"), std::max<std::size_t>(run.last_frame(), 1) - 1);
    if (first >= last) return {false, "there are no such frames"};
    double before = angular_momentum(run, measure, first - 1, pole), expected = before, impulse = 0, worst = 0;
    for (std::size_t frame = first; frame < last; ++frame) {
        const double now = angular_momentum(run, measure, frame, pole),
                     wind = wind_torque(run, measure.grid, frame, pole);
        expected += dt * (wind - 0.5 * c * (before + now));
        impulse += dt * std::abs(wind);
        worst = std::max(worst, std::abs(now - expected));
        before = now;
    }
    return {worst <= limits["relative_error"] * impulse && impulse > 0,
            fmt::format("off by {:.2f} % of an impulse of {:.4f} kg m^2/s, allowed {:.2f} %", 100 * worst / impulse,
                        impulse, 100 * limits["relative_error"])};
}

/// From `from_frame` on the flag streams along the wind: seen from the pole, its centre lies, averaged over time,
/// within `degrees` of the wind's direction. It also flutters: the middle of the free edge swings sideways with a
/// standard deviation of at least `flutter` metres.
Verdict blown(const SceneRun& run, const Limits& limits) {
    const ClothMeasure measure(run.scene, 0);
    const Vec3 pole = run.at(0, 0, 0), up = in_world(run.scene.up, {0, 1, 0}), blows = run.scene.wind.velocity;
    const Vec3 wind = minus(blows, times(dot(blows, up), up)), beside = cross(wind, up);
    const double speed = length(wind);
    const std::size_t edge = measure.grid.particle(measure.grid.columns() - 1, measure.grid.rows() / 2);
    double along = 0, across = 0;
    std::vector<double> sideways;
    for (std::size_t frame = limits.index("from_frame"); frame < run.frames.size(); ++frame) {
        for (std::size_t particle = 0; particle < measure.mass.size(); ++particle) {
            const Vec3 r = minus(run.at(frame, 0, particle), pole);
            along += measure.mass[particle] * dot(r, wind);
            across += measure.mass[particle] * dot(r, beside);
        }
        const Vec3 r = minus(run.at(frame, 0, edge), pole);
        sideways.push_back(dot(r, beside) / speed);
    }
    if (sideways.empty()) return {false, "no frames"};
    const double angle = std::atan2(across, along) * degrees, center = mean(sideways);
    for (double& value : sideways) value -= center;
    const double flutter = root_mean_square(sideways);
    return {std::abs(angle) <= limits["degrees"] && flutter >= limits["flutter"],
            fmt::format("{:+.2f} degrees beside the wind, allowed {}; edge swings {:.4f} m, at least {}", angle,
                        limits["degrees"], flutter, limits["flutter"])};
}

/// A cloth that is symmetric about the plane x = 0 stays so until `until_frame`, by the RMS distance of a particle from
/// its partner's mirror image, metres. (The order in which springs are relaxed is not symmetric; the difference is an
/// error of the relaxation.)
Verdict mirror(const SceneRun& run, const Limits& limits) {
    const ClothMeasure measure(run.scene, 0);
    const Grid& grid = measure.grid;
    const std::size_t last = std::min(limits.index("until_frame"), run.last_frame());
    if (last == 0) return {false, "there is no such frame"};
    double worst = 0;
    for (std::size_t frame = 1; frame <= last; ++frame) {
        std::vector<double> gaps;
        for (std::uint32_t row = 0; row < grid.rows(); ++row)
            for (std::uint32_t column = 0; column < grid.columns(); ++column) {
                Vec3 image = run.at(frame, 0, grid.particle(grid.columns() - 1 - column, row));
                image[0] = -image[0];
                gaps.push_back(length(minus(run.at(frame, 0, grid.particle(column, row)), image)));
            }
        worst = std::max(worst, root_mean_square(gaps));
    }
    return {worst <= limits["error"], fmt::format("RMS asymmetry {:.2e} m, allowed {:.2e} m", worst, limits["error"])};
}

/// The cap of cloth on top of the first sphere (rest distance from its middle under `radius` metres) turns with the
/// sphere: it is never more than `lag` degrees behind or ahead.
Verdict carried(const SceneRun& run, const Limits& limits) {
    const Collider& collider = *std::ranges::find(run.scene.colliders, glsl::kind_sphere, &Collider::kind);
    const Sphere& sphere = std::get<Sphere>(collider.shape);
    const auto heading = [&](std::size_t frame) {
        const auto turn = collider_pose(collider, run.time(frame)).rotation;
        const Vec3 x = with_y_up(run.scene.up, {turn[0], turn[3], turn[6]});
        return std::atan2(-x[2], x[0]);
    };
    double cloth_turn = 0, sphere_turn = 0, worst = 0;
    for (std::size_t frame = 0; frame + 1 < run.frames.size(); ++frame) {
        double swept = 0, weight = 0;
        for (std::size_t particle = 0; particle < run.frames[frame][0].size(); ++particle) {
            const auto from_center = [&](std::size_t then) {
                return with_y_up(run.scene.up, minus(run.at(then, 0, particle), sphere.center));
            };
            const Vec3 rest = from_center(0), a = from_center(frame), b = from_center(frame + 1);
            if (std::hypot(rest[0], rest[2]) > limits["radius"]) continue;
            swept += a[2] * b[0] - a[0] * b[2];
            weight += a[0] * b[0] + a[2] * b[2];
        }
        cloth_turn += std::atan2(swept, weight) * degrees;
        sphere_turn += std::remainder(heading(frame + 1) - heading(frame), 2 * std::numbers::pi) * degrees;
        worst = std::max(worst, std::abs(cloth_turn - sphere_turn));
    }
    return {worst <= limits["lag"] && sphere_turn > 10,
            fmt::format("cloth turned {:.2f}, sphere {:.2f} degrees, apart by {:.2f} at most, allowed {}", cloth_turn,
                        sphere_turn, worst, limits["lag"])};
}

/// Returns where the centre of mass of a body is in a frame, m.
Vec3 center_of_mass(const SceneRun& run, std::size_t frame, std::size_t number) {
    const BodyState& body = run.bodies[frame][number];
    const Vec3 own = mass_properties(run.scene.colliders[body.collider].shape)->center;
    return plus(body.position, rotate(rotation_of(body.turn), own));
}

bool has_body(const SceneRun& run, std::size_t number) {
    return !run.bodies.empty() && number < run.bodies.front().size();
}

/// Until `until_frame`, when something may touch it, a body is on its parabola, to within `error` metres.
Verdict body_flies(const SceneRun& run, const Limits& limits) {
    const std::size_t number = limits.index("body"), last = std::min(limits.index("until_frame"), run.last_frame());
    if (last == 0 || !has_body(run, number)) return {false, "there is no such frame or body"};
    const Collider& body = run.scene.colliders[run.bodies[0][number].collider];
    double worst = 0, fallen = 0;
    for (std::size_t frame = 1; frame <= last; ++frame) {
        const double t = run.time(frame);
        const Vec3 way = plus(times(t, body.velocity), times(0.5 * t * t, gravity_at(run.scene, 0)));
        const Vec3 moved = minus(center_of_mass(run, frame, number), center_of_mass(run, 0, number));
        worst = std::max(worst, length(minus(moved, way)));
        fallen = length(way);
    }
    return {worst <= limits["error"],
            fmt::format("off by {:.2e} m after a way of {:.3f} m, allowed {:.2e} m", worst, fallen, limits["error"])};
}

/// After its lowest point a body rises to `least` to `most` of the height that it had fallen from its start.
Verdict rebounds(const SceneRun& run, const Limits& limits) {
    const std::size_t number = limits.index("body");
    if (!has_body(run, number)) return {false, "there is no such body"};
    std::vector<double> heights;
    for (std::size_t frame = 0; frame < run.frames.size(); ++frame)
        heights.push_back(about_up(run, center_of_mass(run, frame, number)));
    // The first low point of those at which it turns, so that a second fall does not count.
    std::size_t low = 0;
    while (low + 1 < heights.size() && heights[low + 1] <= heights[low]) ++low;
    const double fallen = heights.front() - heights[low];
    const double risen =
        *std::max_element(heights.begin() + static_cast<std::ptrdiff_t>(low), heights.end()) - heights[low];
    const double share = fallen > 0 ? risen / fallen : 0;
    return {share >= limits["least"] && share <= limits["most"],
            fmt::format("falls {:.3f} m, is thrown up {:.4f} of that, allowed {} to {}", fallen, share, limits["least"],
                        limits["most"])};
}

/// In no frame is a ball with a mass deeper in another collider than `depth`.
Verdict bodies_apart(const SceneRun& run, const Limits& limits) {
    double deepest = -std::numeric_limits<double>::infinity();
    std::string told = "there is no such ball";
    for (std::size_t frame = 0; frame < run.bodies.size(); ++frame) {
        const std::vector<Collider> colliders = placed(run.scene.colliders, run.bodies[frame]);
        for (const BodyState& body : run.bodies[frame]) {
            const Sphere* const ball = std::get_if<Sphere>(&run.scene.colliders[body.collider].shape);
            for (std::size_t other = 0; ball && other < colliders.size(); ++other) {
                if (other == body.collider) continue;
                const double depth =
                    ball->radius - exact::surface_distance(colliders[other], run.time(frame), body.position);
                if (depth <= deepest) continue;
                deepest = depth;
                told = fmt::format("in frame {} a ball is {:.2g} m inside collider {}", frame, depth, other);
            }
        }
    }
    return {std::isfinite(deepest) && deepest <= limits["depth"], fmt::format("{}, allowed {}", told, limits["depth"])};
}

}  // namespace

std::span<const SceneCheck> motion_checks() {
    static constexpr SceneCheck checks[] = {
        {"falls", falls},           {"swing", swing},       {"torque", torque},
        {"blown", blown},           {"mirror", mirror},     {"carried", carried},
        {"body_flies", body_flies}, {"rebounds", rebounds}, {"bodies_apart", bodies_apart}};
    return checks;
}

}  // namespace drape::verify
