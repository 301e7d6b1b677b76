// Judges oracles, and defines the checks about where the cloth is: strain, pins, contact.
#include "run/scene_oracles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "scene/oracle_kinds.h"
#include "world/body_pose.h"
#include "world/contact_shape.h"
#include "world/motion.h"
#include "world/seam_cover.h"
#include "world/start_crossings.h"
#include "world/surface_distance.h"
#include "world/triangle_crossings.h"
#include "world/up.h"
#include "world/weather.h"

namespace drape::verify {

using exact::surface_distance;

double Limits::operator[](const std::string& name) const {
    for (const auto& [key, value] : oracle_.limits)
        if (key == name) return value;
    throw std::invalid_argument(fmt::format("oracle {}: no limit {}", oracle_.check, name));
}

Verdict judge(const SceneRun& run, const Oracle& oracle) {
    const OracleKind* kind = find_oracle_kind(oracle.check);
    const std::string_view lack = kind ? kind->obstacle(run.scene) : "";
    if (!lack.empty()) return {false, fmt::format("says nothing here: {}", lack)};
    for (const std::span<const SceneCheck> checks : {shape_checks(), motion_checks()})
        for (const SceneCheck& check : checks)
            if (check.name == oracle.check) return check.judge(run, Limits(oracle));
    throw std::invalid_argument("unknown check " + oracle.check);
}

namespace {

/// Calls visit(cloth, pin, particle) for all pinned particles; the later of two pins that share a particle holds it.
template <class Visit>
void for_each_pinned(const SceneDescription& scene, const Visit& visit) {
    for (std::size_t index = 0; index < scene.cloths.size(); ++index) {
        const Cloth& cloth = scene.cloths[index];
        std::vector<const Pin*> owner(std::size_t{cloth.grid[0]} * cloth.grid[1], nullptr);
        for (const Pin& pin : cloth.pins)
            for (std::uint32_t row = pin.particles.first[1]; row <= pin.particles.last[1]; ++row)
                for (std::uint32_t column = pin.particles.first[0]; column <= pin.particles.last[0]; ++column)
                    owner[row * cloth.grid[0] + column] = &pin;
        for (std::size_t particle = 0; particle < owner.size(); ++particle)
            if (owner[particle]) visit(index, *owner[particle], particle);
    }
}

bool same_place(const SceneRun& run, std::size_t frame, std::size_t cloth, std::size_t particle) {
    return std::memcmp(&run.frames[frame][cloth][particle], &run.frames[0][cloth][particle], 3 * sizeof(float)) == 0;
}

/// Once the sheet hangs still, its mean strain is 0.65 and its RMS strain 0.83 of the stretch law (all eight passes).
Verdict stretch_law_holds(const SceneRun& run, const Limits& limits) {
    const std::vector<double> strains = spring_strains(run, run.last_frame(), 0, true);
    const double law = stretch_law(run.scene, 0);
    const double average = mean(strains) / (0.65 * law) - 1, spread = root_mean_square(strains) / (0.83 * law) - 1;
    const double allowed = limits["relative_error"];
    return {std::abs(average) <= allowed && std::abs(spread) <= allowed,
            fmt::format("law {:.4e}, mean off by {:.2f} %, RMS by {:.2f} %, allowed {:.2f} %", law, 100 * average,
                        100 * spread, 100 * allowed)};
}

/// In every frame, the RMS strain of all row and column springs of every cloth stays below a limit, whether the strain
/// is real or an error.
Verdict stretch_limited(const SceneRun& run, const Limits& limits) {
    Verdict verdict{true, fmt::format("allowed {}", limits["strain"])};
    for (std::size_t cloth = 0; cloth < run.scene.cloths.size(); ++cloth) {
        double worst = 0;
        for (std::size_t frame = 1; frame < run.frames.size(); ++frame) {
            std::vector<double> strains = spring_strains(run, frame, cloth, true);
            std::ranges::copy(spring_strains(run, frame, cloth, false), std::back_inserter(strains));
            worst = std::max(worst, root_mean_square(strains));
        }
        verdict.met = verdict.met && worst <= limits["strain"];
        verdict.text += fmt::format("; {}: strain {:.4f}", run.scene.cloths[cloth].name, worst);
    }
    return verdict;
}

/// Pins without motion and release do not move by a bit.
Verdict pins_hold(const SceneRun& run, const Limits&) {
    std::size_t pinned = 0, moved = 0;
    for_each_pinned(run.scene, [&](std::size_t cloth, const Pin& pin, std::size_t particle) {
        if (pin.release || !pin.path.keys.empty()) return;
        ++pinned;
        for (std::size_t frame = 1; frame < run.frames.size(); ++frame)
            if (!same_place(run, frame, cloth, particle)) {
                ++moved;
                break;
            }
    });
    return {pinned > 0 && moved == 0, fmt::format("{} of {} pins moved", moved, pinned)};
}

/// Returns where a pin's path takes a point at a time, m: R (rest - pivot) + pivot + translation.
Vec3 followed(const SceneRun& run, std::size_t cloth, const Pin& pin, const Vec3& rest, double time) {
    Vec3 pivot{};
    if (pin.pivot) {
        pivot = *pin.pivot;
    } else {
        const IndexBox& box = pin.particles;
        double count = 0;
        for (std::uint32_t row = box.first[1]; row <= box.last[1]; ++row)
            for (std::uint32_t column = box.first[0]; column <= box.last[0]; ++column, ++count) {
                const Vec3 at = run.at(0, cloth, row * run.scene.cloths[cloth].grid[0] + column);
                for (std::size_t k = 0; k < 3; ++k) pivot[k] += at[k];
            }
        for (double& x : pivot) x /= count;
    }
    const RigidTransform motion = motion_at(pin.path, time);
    const Vec3 turned = rotate(motion.rotation, minus(rest, pivot));
    return {turned[0] + pivot[0] + motion.translation[0], turned[1] + pivot[1] + motion.translation[1],
            turned[2] + pivot[2] + motion.translation[2]};
}

/// In every frame until their release, particles of key-framed pins are where the pin's path takes their rest position.
Verdict pins_follow(const SceneRun& run, const Limits& limits) {
    double worst = 0, farthest = 0;
    for_each_pinned(run.scene, [&](std::size_t cloth, const Pin& pin, std::size_t particle) {
        if (!pin.path.moves()) return;
        const Vec3 rest = run.at(0, cloth, particle);
        for (std::size_t frame = 1; frame < run.frames.size(); ++frame) {
            if (pin.release && run.time(frame) > *pin.release) break;
            const Vec3 wanted = followed(run, cloth, pin, rest, run.time(frame));
            worst = std::max(worst, length(minus(run.at(frame, cloth, particle), wanted)));
            farthest = std::max(farthest, length(minus(wanted, rest)));
        }
    });
    return {worst <= limits["error"] && farthest > 0,
            fmt::format("off by {:.2e} m at most over paths of {:.2f} m, allowed {:.2e} m", worst, farthest,
                        limits["error"])};
}

/// A cloth on hooks hangs below them: horizontally its centre is theirs to within `offset` metres in the last
/// frame, and its hem is no wider than `width` times the row of hooks.
Verdict drawn(const SceneRun& run, const Limits& limits) {
    const ClothMeasure measure(run.scene, 0);
    const std::size_t last = run.last_frame();
    double hooks = 0, hook_count = 0, left = 1e300, right = -1e300;
    for_each_pinned(run.scene, [&](std::size_t cloth, const Pin& pin, std::size_t particle) {
        if (cloth != 0) return;
        const double x = run.at(0, 0, particle)[0] + motion_at(pin.path, run.time(last)).translation[0];
        hooks += x;
        hook_count += 1;
        left = std::min(left, x);
        right = std::max(right, x);
    });
    double mass = 0, moment = 0, hem_left = 1e300, hem_right = -1e300;
    for (std::size_t particle = 0; particle < measure.mass.size(); ++particle) {
        const double x = run.at(last, 0, particle)[0];
        mass += measure.mass[particle];
        moment += measure.mass[particle] * x;
        if (particle / measure.grid.columns() + 1 < measure.grid.rows()) continue;
        hem_left = std::min(hem_left, x);
        hem_right = std::max(hem_right, x);
    }
    const double offset = moment / mass - hooks / hook_count, width = (hem_right - hem_left) / (right - left);
    return {std::abs(offset) <= limits["offset"] && width <= limits["width"],
            fmt::format("centre {:+.4f} m beside the hooks', allowed {}; hem {:.3f} of the hooks' width, allowed {}",
                        offset, limits["offset"], width, limits["width"])};
}

/// A pin holds to the bit until its release, and then its particle falls: `least` to `most` times what it would fall
/// freely in `seconds`.
Verdict released(const SceneRun& run, const Limits& limits) {
    const std::size_t up = up_axis(run.scene.up);
    std::size_t count = 0, early = 0;
    double slowest = 1e300, fastest = -1e300;
    for_each_pinned(run.scene, [&](std::size_t cloth, const Pin& pin, std::size_t particle) {
        if (!pin.release) return;
        ++count;
        for (std::size_t frame = 1; frame < run.frames.size() && run.time(frame) <= *pin.release + 1e-9; ++frame)
            early += same_place(run, frame, cloth, particle) ? 0 : 1;
        const auto then =
            static_cast<std::size_t>(std::lround((*pin.release + limits["seconds"]) * run.scene.time.fps));
        const double dropped =
            run.at(0, cloth, particle)[up] - run.at(std::min(then, run.last_frame()), cloth, particle)[up];
        const double ratio = dropped / (0.5 * length(gravity_at(run.scene, 0)) * limits["seconds"] * limits["seconds"]);
        slowest = std::min(slowest, ratio);
        fastest = std::max(fastest, ratio);
    });
    return {count > 0 && early == 0 && slowest >= limits["least"] && fastest <= limits["most"],
            fmt::format("{} pins, {} times early, {:.3f} to {:.3f} of free fall after {} s, allowed {} to {}", count,
                        early, slowest, fastest, limits["seconds"], limits["least"], limits["most"])};
}

/// Something was cut, and the given number of pieces is left in the end.
Verdict cut_pieces(const SceneRun& run, const Limits& limits) {
    if (run.cuts.empty()) return {false, "nothing of the scene is cut or torn"};
    std::size_t springs = 0;
    for (const CutRecord& cut : run.cuts) springs += cut.springs;
    return {springs > 0 && run.cuts.back().pieces == limits.index("pieces"),
            fmt::format("{} springs cut, {} pieces, promised {}; {} crumbs", springs, run.cuts.back().pieces,
                        limits["pieces"], run.cuts.back().crumbs)};
}

/// In the last frame the particles that are not pinned have, by their inverse masses on the device, the masses that the
/// uncut sheet gives them, and as much cloth is drawn after every cut as before.
Verdict mass_kept(const SceneRun& run, const Limits& limits) {
    double worst = 0;
    for (std::size_t cloth = 0; cloth < run.scene.cloths.size(); ++cloth) {
        const ClothMeasure measure(run.scene, cloth);
        const double inner = run.scene.cloths[cloth].areal_density * measure.spacing[0] * measure.spacing[1];
        double expected = 0, found = 0;
        for (std::size_t particle = 0; particle < measure.mass.size(); ++particle) {
            const float weight = run.frames.back()[cloth][particle].w;
            if (weight == 0) continue;
            expected += measure.mass[particle];
            found += inner / static_cast<double>(weight);
        }
        worst = std::max(worst, std::abs(found / expected - 1));
        double area = 0;
        for (const CutRecord& cut : run.cuts) {
            if (cut.cloth != cloth) continue;
            if (cut.frame == 0 && area == 0) area = cut.drawn_area;
            worst = std::max(worst, std::abs(cut.drawn_area / area - 1));
        }
    }
    return {worst <= limits["relative_error"] && !run.cuts.empty(),
            fmt::format("mass and drawn area off by {:.2e}, allowed {:.2e}", worst, limits["relative_error"])};
}

/// Returns where a collider is in a frame, in the shape that contact keeps cloth from.
ColliderPose pose_in(const SceneRun& run, std::size_t frame, std::size_t number, const Collider& kept) {
    if (kept.mass && frame < run.bodies.size())
        for (const BodyState& body : run.bodies[frame])
            if (body.collider == number) return collider_pose(placed(kept, body), 0);
    return collider_pose(kept, run.time(frame));
}

/// Returns how far the deepest particle is below the surface that contact keeps (world/contact_shape.h), offset by the
/// cloth's thickness. The unit is half of the collider's least width; for a plane, the metre.
double deepest(const SceneRun& run, std::size_t number) {
    const Collider& collider = run.scene.colliders[number];
    const double size = special(collider.shape).plane ? 1 : shape_geometry(collider.shape).half_width;
    double depth = -std::numeric_limits<double>::infinity();
    for (std::size_t cloth = 0; cloth < run.scene.cloths.size(); ++cloth) {
        const Collider kept = contact_shape(run.scene.cloths[cloth], collider);
        const double thickness = run.scene.cloths[cloth].thickness, reach = shape_geometry(kept.shape).reach;
        for (std::size_t frame = 1; frame < run.frames.size(); ++frame) {
            const double time = run.time(frame);
            const ColliderPose pose = pose_in(run, frame, number, kept);
            const Collider now = formed(kept, time);
            for (std::size_t particle = 0; particle < run.frames[frame][cloth].size(); ++particle) {
                if (run.frames[frame][cloth][particle].w == 0) continue;
                const Vec3 x = run.at(frame, cloth, particle);
                if (length(minus(x, pose.center)) > reach + thickness) continue;  // spares the costly distance
                const double own = thickness * double{thickness_factor(run.scene.cloths[cloth], particle)};
                depth = std::max(depth, (own - surface_distance(now, pose, x)) / size);
            }
        }
    }
    return depth;
}

Verdict penetration(const SceneRun& run, const Limits& limits) {
    double worst = -std::numeric_limits<double>::infinity();
    std::string depths;
    for (std::size_t number = 0; number < run.scene.colliders.size(); ++number) {
        const Collider& collider = run.scene.colliders[number];
        const double depth = deepest(run, number);
        worst = std::max(worst, depth);
        depths +=
            fmt::format("{}{:.2e} (of {})", depths.empty() ? "" : ", ", depth, collider_lists[collider.shape.index()]);
    }
    // Something must touch, otherwise the statement would be empty.
    return {worst <= limits["depth"] && worst > -1e-3,
            fmt::format("deepest {}, allowed {:.2e}", depths, limits["depth"])};
}

/// The top of the cloth lies where the collider below puts it. `height` is the top of the collider plus the cloth's
/// thickness; the cloth is at most `above` higher (rounding, or a fold that stands up) and at most `below` lower (no
/// particle lies on the very top).
Verdict supported(const SceneRun& run, const Limits& limits) {
    double top = -1e300;
    for (const glsl::vec4& x : run.frames.back().at(limits.index("cloth")))
        if (x.w != 0) top = std::max(top, Vec3{x.x, x.y, x.z}[up_axis(run.scene.up)]);
    const double above = top - limits["height"];
    return {above <= limits["above"] && above >= -limits["below"],
            fmt::format("top at {:.6f} m, {:+.2e} m from {}, allowed -{:.1e} to +{:.1e}", top, above, limits["height"],
                        limits["below"], limits["above"])};
}

/// What holds a cloth and what it lies on bear its weight and its loads, as it hardly moves any more.
Verdict borne(const SceneRun& run, const Limits& limits) {
    const double middle = run.time(run.last_frame()) - 0.5 / run.scene.time.fps;
    double worst = 0;
    std::string told;
    for (std::size_t index = 0; index < run.scene.cloths.size(); ++index) {
        const ClothMeasure measure(run.scene, index);
        const double mass = std::accumulate(measure.mass.begin(), measure.mass.end(), 0.0);
        Vec3 expected = times(-mass, gravity_at(run.scene, middle)), found{};
        for (const Load& load : run.scene.cloths[index].loads) expected = minus(expected, force_at(load, middle));
        for (const ForceOnCloth& force : run.forces.back().at(index))
            if (force.by.starts_with("pins_") || force.by.starts_with("collider_")) found = plus(found, force.force);
        worst = std::max(worst, length(minus(found, expected)) / length(expected));
        told += fmt::format("{} of {:.6g} N; ", run.scene.cloths[index].name, length(expected));
    }
    return {worst <= limits["relative_error"],
            fmt::format("{}off by {:.1e} at most, allowed {:.1e}", told, worst, limits["relative_error"])};
}

/// No triangle crosses another one, except within a cloth without self-contact that may touch other cloths. A triangle
/// that was split touches nothing, and neither do those that seams leave out.
Verdict uncrossed(const SceneRun& run, const Limits&) {
    const std::vector<Cloth>& cloths = run.scene.cloths;
    const bool asked = cloths_meet(run.scene);
    const auto counts = [&](std::size_t one, std::size_t other) {
        return one != other || !asked || cloths[one].self_collision;
    };
    const SeamCover seams(run.scene);
    std::vector<std::size_t> all(cloths.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    const std::vector<std::uint32_t> same = seams.cloths.empty() ? std::vector<std::uint32_t>() : seams.joined(all);
    std::vector<TriangleCrossings::Mesh> meshes(cloths.size());
    std::vector<std::vector<std::uint32_t>> whole;
    for (std::size_t cloth = 0; cloth < cloths.size(); ++cloth)
        whole.push_back(ClothMeasure(run.scene, cloth).grid.triangle_indices());
    std::size_t worst = 0, worst_frame = 0, split = 0;
    auto cut = run.cuts.begin();
    for (std::size_t frame = 0; frame < run.frames.size(); ++frame) {
        // A cut takes effect in the next frame; the records without a cut describe the start.
        for (; cut != run.cuts.end() && (cut->frame < frame || cut->springs == 0); ++cut) {
            split += (whole[cut->cloth].size() - cut->whole.size()) / 3;
            whole[cut->cloth] = cut->whole;
        }
        for (std::size_t cloth = 0; cloth < cloths.size(); ++cloth) {
            meshes[cloth].indices = seams.covered(cloth, whole[cloth]);
            meshes[cloth].points.clear();
            for (std::size_t i = 0; i < run.frames[frame][cloth].size(); ++i)
                meshes[cloth].points.push_back(run.at(frame, cloth, i));
        }
        const std::size_t crossings = TriangleCrossings(meshes, same).count(counts);
        if (crossings > worst) worst = crossings, worst_frame = frame;
    }
    const std::string exception = split > 0 ? fmt::format("; {} that were split do not count", split) : "";
    return {worst == 0, fmt::format("{} pairs of triangles cross, most in frame {}{}", worst, worst_frame, exception)};
}

}  // namespace

std::span<const SceneCheck> shape_checks() {
    static constexpr SceneCheck checks[] = {{"stretch_law", stretch_law_holds},
                                            {"stretch", stretch_limited},
                                            {"pins_hold", pins_hold},
                                            {"pins_follow", pins_follow},
                                            {"drawn", drawn},
                                            {"released", released},
                                            {"cut_pieces", cut_pieces},
                                            {"mass_kept", mass_kept},
                                            {"penetration", penetration},
                                            {"uncrossed", uncrossed},
                                            {"supported", supported},
                                            {"borne", borne}};
    return checks;
}

}  // namespace drape::verify
