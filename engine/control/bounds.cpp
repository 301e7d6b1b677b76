#include "control/bounds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/vectors.h"
#include "cloth/hang.h"
#include "control/impossible_scene.h"
#include "world/contact_shape.h"
#include "world/overlap.h"
#include "world/weather.h"

namespace drape {

namespace {

/// Where a fold or a wave runs out to a tip or a hem, a hundredth of the mass may take all of the kinetic energy: it
/// then moves ten times as fast as the whole cloth did.
constexpr double whip = 10;
/// m/s: the speed that gravity gives in a coarse substep of 10 ms, before springs or contact take it away again.
constexpr double calm_speed = 0.1;
/// Cloth that is stretched by a strain e beyond what its force explains holds the energy m g d e/2, which counts as a
/// gain only when it is released. A tenth is this energy at e = 0.2, near the largest strain that `no_use_rms` allows.
constexpr double energy_share = 0.1;
/// Where all edges are a quarter too long, areas are wrong by half (1.25^2 = 1.56).
constexpr double no_use_rms = 0.25;
/// At this error a spring is twice as long as its force explains, or its ends coincide.
constexpr double no_use_worst = 1;
/// K iterations in a substep D leave in the worst spring of a sheet, with N edges of length h, an error proportional to
/// Lambda = a D^2 N^2/(h K). A sheet that hangs by an edge has 0.13 Lambda at N = 4, and less with more edges; one that
/// hangs by a corner has 0.4 to 0.5 Lambda (Bounds.TheLawOfStretchIsThatOfSheetsThatHang). This law takes the edge's
/// figure. Where Lambda is small, other solvers and forces leave errors too: they are allowed twice the 1 % that method
/// auto keeps.
constexpr double least_stretch = 0.02, stretch_share = 0.12;
/// This factor raises the law to 0.36 Lambda, near the error of a sheet that hangs by a corner.
constexpr double times_law = 3;
/// The bound for cloth at rest is not raised by `times_law`.
constexpr double resting_worst = no_use_worst / times_law;
constexpr double resting_speed = 0.01;  ///< diagonals a second: cloth would take minutes to cross its own length
constexpr double in_plane = 1e-5;       ///< diagonals: what leaves a plane has gone far beyond it within a second
/// s for which cloth may keep the strain that it starts with: two swings, 2 pi sqrt(l/g) each, of a cloth that hangs
/// 1.5 m.
constexpr double settling_time = 5;
/// Contact may leave the cloth a tenth of a cell deep in what it keeps free: no picture of cells that size shows it.
constexpr double usual_depth = 0.1;
/// Radians in a substep. At this angle an arc departs from its chord by 0.5 % of the radius; beyond it shaders do not
/// know the paths of a collider's points (surface_motion in cloth/frame_inputs.cpp).
constexpr double most_turn = 0.2;
/// Particles' speeds are known at the start and end of a frame alone; between these they are assumed a quarter higher.
constexpr double faster_between = 1.25;
/// Wind that brings a cloth to its own speed more often than this within a frame moves the cloth in jerks: with 20
/// substeps, a jerk in each.
constexpr double most_wind_rate = 20;

constexpr const char* steadier = "more substeps, weaker forces or stiffness may help";

std::size_t who_gained_most(const Seen& s) {
    std::size_t most = 0;
    double largest = -std::numeric_limits<double>::infinity();
    for (std::size_t cloth = 0; cloth < s.all.size(); ++cloth) {
        const double gained = s.causes.energy(cloth, s.all[cloth]).gained;
        if (gained > largest) most = cloth, largest = gained;
    }
    return most;
}

/// Returns whether cloths may give each other energy, by contact or at seams.
bool meets(const Seen& s) { return s.causes.model().self_contact || s.causes.model().sewn_count > 0; }

/// Cloths that meet exchange energy, so only their total is bounded.
Causes::Energy energy_of(const Seen& s) {
    if (!meets(s)) return s.causes.energy(s.cloth, s.now());
    Causes::Energy all;
    for (std::size_t cloth = 0; cloth < s.all.size(); ++cloth) {
        const Causes::Energy one = s.causes.energy(cloth, s.all[cloth]);
        all = {all.gained + one.gained, all.scale + one.scale, all.given + one.given, all.mass + one.mass};
    }
    return all;
}

double energy_bound(const Seen& s) {
    const Causes::Energy energy = energy_of(s);
    return energy_share * (energy.scale + 0.5 * energy.mass * calm_speed * calm_speed) + energy.given;
}

/// The work done by keys of stiffness is known only when frames come in order, which a closed loop's attempts do not.
double energy_gained(const Seen& s) {
    return s.causes.passive() && (s.in_order || !s.causes.stiffens()) ? energy_of(s).gained : 0;
}

/// Particles may be so far apart that a spring's length overflows and its error is a NaN, which counts as infinite.
double known(double error) { return std::isnan(error) ? std::numeric_limits<double>::infinity() : error; }

/// Returns the stretch that the scene itself asks for: its tolerance, for some time the strain that the cloth starts
/// with, and for good the strain between pins.
double stretch_asked(const Seen& s) {
    const bool settles = s.frame <= settling_time * s.scene().time.fps;
    return std::max(s.causes.model().asked_tolerance, settles ? s.start().strain : s.start().held_strain);
}

double bound_of_rms(const Seen& s) { return std::max(no_use_rms, stretch_asked(s)); }
double bound_of_worst(const Seen& s) { return std::max(no_use_worst, stretch_asked(s)); }

/// Returns whether a cloth is at rest and within the bounds of the rows above.
bool rests_in_bounds(const Seen& s) {
    return s.frame > 0 && !(s.now().largest_speed > resting_speed * s.start().diagonal) &&
           known(s.now().stretch_error_rms) <= bound_of_rms(s) && known(s.now().stretch_error_max) <= bound_of_worst(s);
}

/// Returns the seconds for which a cloth has stood at rest in the upright plane in which it starts, where no disturbed
/// run tells whether it would.
double time_upright(const Seen& s) {
    const std::optional<Vec3>& normal = s.start().upright;
    if (!normal || s.causes.model().closed_loop() || !(s.now().largest_speed <= resting_speed * s.start().diagonal))
        return 0;
    const auto& [x, y, z] = s.now().center_of_mass;
    const double away = std::abs(dot(*normal, minus({x, y, z}, s.start().mean)));
    return away <= in_plane * s.start().diagonal ? s.frame / s.scene().time.fps : 0;
}

/// Returns the stretch error that the law allows the springs of a cloth that moves at this speed (m/s).
double stretch_law(const Causes& causes, std::size_t index, double speed) {
    const ClothModel& cloth = causes.model().cloths[index];
    const SceneDescription& scene = causes.model().scene;
    const double step = 1 / (scene.time.fps * scene.solver.substeps);
    const double iterations = causes.model().method().iterates() ? scene.solver.iterations : 1;
    const double acceleration = most_weather_acceleration(scene, scene.cloths[index]) + speed * speed / cloth.reach();
    double most = 0;
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const double edges = (axis == 0 ? cloth.grid.columns() : cloth.grid.rows()) - 1;
        most = std::max(most, acceleration * step * step * edges * edges / (cloth.spacing[axis] * iterations));
    }
    // An edge has two ends, and rounding to single precision moves each of them.
    const double rounded = causes.starts()[index].distance * std::numeric_limits<float>::epsilon() /
                           std::min(cloth.spacing[0], cloth.spacing[1]);
    return least_stretch + stretch_share * most + 2 * rounded;
}

/// Returns the stretch error that the springs of any cloth may have for six frames. `driven`: with the acceleration by
/// what has moved the cloths until then.
double lasting_bound(const Seen& s, bool driven) {
    const SimulationModel& model = s.causes.model();
    double most = model.asked_tolerance;
    // Contact presses layers together by more than the law of stretch accounts for.
    if (model.closed_loop() || model.self_contact) most = std::max(most, times_law * model.stretch_limits().worst);
    for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth) {
        const Causes::Start& start = s.causes.starts()[cloth];
        const double speed = driven ? model.cloths[cloth].start_speed + s.causes.drive(s.frame, cloth).pace : 0;
        const double law =
            model.closed_loop() ? 0 : std::min(times_law * stretch_law(s.causes, cloth, speed), no_use_worst);
        most = std::max({most, law, start.held_strain, driven ? start.strain : 0});
    }
    return most;
}

double depth(const Seen& s) { return s.now().penetration.value_or(0); }

double depth_of_held(const Seen& s) {
    const auto held = held_inside(s.causes.model(), s.cloth, s.frame / s.scene().time.fps);
    return held ? held->depth : 0;
}

double depth_at_start(const Seen& s) {
    double depth = 0;
    for (const StartOverlap& overlap : start_overlaps(s.scene()))
        if (overlap.cloth == s.cloth) depth += overlap.depth;
    return depth;
}

/// Returns the strain of the worst spring without the solver's error, which a row of its own judges.
double true_strain(const Seen& s) {
    const StrainStatistics& stretch = s.now().stretch;
    return stretch.spring_count > 0 ? stretch.largest - s.now().stretch_error_max : 0;
}

double stretched(const Seen& s) { return 1 + std::max(s.now().stretch.largest, 0.0); }

constexpr ClothBound energy_row(const char* sentence, double (*value)(const Seen&),
                                std::size_t (*whose)(const Seen&) = nullptr) {
    return {
        .words = {"energy gained, J", sentence, steadier,
                  "where nothing but keys of its stiffness does work on the cloth: a tenth of m v0^2/2 + m g d, and "
                  "what the strain that it starts with and such keys give back; of cloths that meet or are sewn, all "
                  "together"},
        .beyond = Beyond::again,
        .value = value,
        .bound = energy_bound,
        .whose = whose};
}

using Statistics = ClothStatistics;
constexpr ClothBound cloth_rows[] = {
    {.words = {"speed, m/s", "moves at {value:.3g} m/s, where at most {bound:.3g} m/s are explained", steadier,
               "ten times (tips whip) the sum of what may move it, and 0.1 m/s: its speed at the start, g t (of held "
               "cloth at most 2 sqrt(g d) with its diagonal d), the wind, pins, twice the colliders and the cloths "
               "that it meets or is sewn to, and the speed at which strain by pins, colliders, the start or softer "
               "keys comes back; a collider with a mass has that of its start, of its fall and of actions"},
     .beyond = Beyond::again,
     .place = &Statistics::fastest,
     .value = [](const Seen& s) { return s.now().largest_speed; },
     .bound = [](const Seen& s) { return whip * s.causes.reach(s.frame, s.cloth).speed + calm_speed; }},
    {.words = {"distance from the origin, m",
               "is {value:.3g} m from the origin, where at most {bound:.3g} m are explained", steadier,
               "that of the start, twice the stretched diagonal, the travel of pins and colliders, and for free cloth "
               "twice the way that the speeds above lead to"},
     .beyond = Beyond::again,
     .place = &Statistics::farthest,
     .value = [](const Seen& s) { return s.now().largest_distance; },
     .bound =
         [](const Seen& s) {
             const Causes::Reach reach = s.causes.reach(s.frame, s.cloth);
             const double flown = s.start().held ? 0 : 2 * s.frame / s.scene().time.fps * reach.speed;
             return s.start().distance + 2 * s.start().diagonal * stretched(s) + reach.travel + flown;
         }},
    {.words = {"penetration, m",
               "is {value:.3g} m deep in what colliders keep free, where at most {bound:.3g} m are explained", steadier,
               "the thickness, a stretched cell, twice the way of such speeds in a substep, and how deep the cloth "
               "starts in colliders and pins hold it there"},
     .beyond = Beyond::again,
     .place = &Statistics::deepest,
     .value = depth,
     .bound =
         [](const Seen& s) {
             const Cloth& cloth = s.scene().cloths[s.cloth];
             const double substeps = s.scene().time.fps * s.scene().solver.substeps;
             return cloth.thickness + 2 * covering_radius(cloth) * stretched(s) +
                    2 * s.causes.reach(s.frame, s.cloth).speed / substeps;
         },
     .own = [](const Seen& s) { return depth_at_start(s) + depth_of_held(s); }},
    energy_row("the cloth has gained {value:.3g} J, where at most {bound:.3g} J are explained",
               [](const Seen& s) { return meets(s) ? 0 : energy_gained(s); }),
    {.words = {"stretch error, RMS",
               "begins the worst spring of a stretch error of {value:.3g} RMS (bound {bound:.3g})", steadier,
               "0.25, by which areas are wrong by half; at least the scene's tolerance, for 5 s what the cloth starts "
               "strained by, and for good what pins hold strained"},
     .beyond = Beyond::no_result,
     .place = &Statistics::most_stretched,
     .value = [](const Seen& s) { return known(s.now().stretch_error_rms); },
     .bound = bound_of_rms},
    {.words = {"stretch error of a spring",
               "begins a spring whose stretch error is {value:.3g} of its length (bound {bound:.3g})", steadier,
               "1: it is twice as long as its force explains; at least what the RMS may be by the scene"},
     .beyond = Beyond::no_result,
     .place = &Statistics::most_stretched,
     .value = [](const Seen& s) { return known(s.now().stretch_error_max); },
     .bound = bound_of_worst},
    {.words = {"stretch error of a spring at rest",
               "begins a spring whose stretch error is {value:.3g} of its length (bound {bound:.3g}), though the cloth "
               "rests",
               steadier,
               "1/3 where no particle is faster than a hundredth of the diagonal in a second, since no force keeps it "
               "there; at least what the RMS may be by the scene"},
     .beyond = Beyond::no_result,
     .place = &Statistics::most_stretched,
     .value = [](const Seen& s) { return rests_in_bounds(s) ? s.now().stretch_error_max : 0; },
     .bound = [](const Seen& s) { return std::max(resting_worst, stretch_asked(s)); }},
    energy_row(
        "the cloth has gained {value:.3g} J, where at most {bound:.3g} J are explained",
        [](const Seen& s) { return meets(s) && s.all.size() == 1 ? energy_gained(s) : 0; }, who_gained_most),
    energy_row(
        "it and the cloths that it meets or is sewn to have gained {value:.3g} J, where {bound:.3g} J are explained",
        [](const Seen& s) { return meets(s) && s.all.size() > 1 ? energy_gained(s) : 0; }, who_gained_most),
    {.words = {"stretch error of a spring for six frames",
               "begins the worst of springs whose stretch error is {value:.3g} or more of their length for six frames "
               "(bound {bound:.3g})",
               steadier,
               "three times 0.02 + 0.12 a D^2 N^2/(h K), at most 1, with N edges of length h, substep D, K iterations "
               "and the acceleration a of gravity, wind and, until it was over for 5 s, of what moves the cloth (its "
               "start, too); at least what it starts strained by and, where `auto` chose the substeps or cloths meet, "
               "three times what `auto` keeps"},
     .beyond = Beyond::no_result,
     .place = &Statistics::most_stretched,
     .value = [](const Seen& s) { return s.lasting; },
     .bound = [](const Seen& s) { return lasting_bound(s, s.causes.driven(s.frame, settling_time)); },
     .whose =
         [](const Seen& s) {
             const auto worst = std::ranges::max_element(s.all, {}, &Statistics::stretch_error_max);
             return static_cast<std::size_t>(worst - s.all.begin());
         }},
    {.words = {"usual penetration, m",
               "from frame {first} on cloth '{cloth}' is deeper than {bound:.3g} m in what colliders and its thickness "
               "keep free, up to {value:.3g} m in frame {frame}{place}",
               "more room between colliders, slower ones or more substeps may help",
               "a tenth of a cell or of the thickness, besides how deep the cloth starts and pins hold it", ": "},
     .beyond = Beyond::warning,
     .place = &Statistics::deepest,
     .value = [](const Seen& s) { return s.frame > 0 ? depth(s) : 0; },
     .bound =
         [](const Seen& s) {
             const auto& [column, row] = s.causes.model().cloths[s.cloth].spacing;
             return usual_depth * std::max({column, row, s.scene().cloths[s.cloth].thickness});
         },
     .own = [](const Seen& s) { return s.start_depth + depth_of_held(s); }},
    {.words =
         {"strain of fabric",
          "from frame {first} on springs of cloth '{cloth}' are stretched by more than {bound_percent:.0f} %, up to "
          "{value_percent:.3g} % in frame {frame}, as forces and pins pull them: fabric would have torn",
          "stiffer springs, weaker forces or pins less far apart may help",
          "0.5 without the solver's error, by which weaves have torn; at least what the cloth starts stretched by"},
     .beyond = Beyond::warning,
     .value = true_strain,
     .bound = [](const Seen&) { return springs_mean; },
     .own = [](const Seen& s) { return std::max(s.start().strain - springs_mean, 0.0); }},
    {.words = {"time for which cloth stands upright, s",
               "cloth '{cloth}' stands at rest in its plane until frame {frame}, for {value:.3g} s: cloth falls, and "
               "nothing tells the run which way",
               "a little placement.jitter or wind does; `auto` disturbs such cloth",
               "the time in which something falls by its diagonal; nothing where it hangs, its bending holds it, there "
               "is wind, or `auto` judges it by a disturbed run"},
     .beyond = Beyond::warning,
     .value = time_upright,
     .bound = [](const Seen& s) { return std::sqrt(2 * s.start().diagonal / length(gravity_at(s.scene(), 0))); }},
    {.words = {"stretch error of a spring when the run ends",
               "cloth '{cloth}' has not settled when the run ends, in frame {frame}: in the last frames the stretch "
               "error of a spring comes to {value:.3g} of its length, where cloth that nothing moves keeps {bound:.3g}",
               "a longer scene shows whether it settles", "that for six frames, of cloth that nothing moves"},
     .beyond = Beyond::unsettled,
     .value = [](const Seen& s) { return s.recent; },
     .bound = [](const Seen& s) { return lasting_bound(s, false); }},
};

constexpr PassageBound passage_rows[] = {
    {.words =
         {"way in a substep, m",
          "in a substep one moved by {value:.3g} m at most relative to the other, contact is sure up to {bound:.3g} m",
          "more substeps or a thicker collider may help",
          "half of what a collider with edges measures at its thinnest: edges meet only where a substep ends"},
     .substeps_help = true,
     .value = [](const Passing& p) { return p.by_edges && !p.turns_far ? faster_between * (p.cloth_way + p.way) : 0; },
     .bound = [](const Passing& p) { return p.half; }},
    {.words = {"turn in a substep, radians",
               "in a substep it turned by more than {bound:.3g} radians, up to which contact is sure",
               "more substeps may help", "0.2: an arc is no straight way"},
     .substeps_help = true,
     // Where the paths are not known, the value is beyond the bound at least, since instants in between are not
     // examined.
     .value = [](const Passing& p) { return p.turns_far ? std::max(p.turn, 1.01 * most_turn) : 0; },
     .bound = [](const Passing&) { return most_turn; }},
    {.words = {"radius of a triangle, m",
               "its triangles came to {value:.3g} m about their middles, of which {bound:.3g} m lets it through",
               "a finer grid, less stretch or more thickness may help",
               "half of what a round collider measures at its thinnest, and the thickness; beside a collider with "
               "edges, the radius of a triangle that is stretched by half"},
     .substeps_help = false,
     .value = [](const Passing& p) { return p.hole; },
     .bound = [](const Passing& p) { return p.by_edges ? p.largest_hole : p.half + p.thickness; }},
};

constexpr SceneBound scene_rows[] = {
    {.words = {"pins in colliders, m",
               "pins hold {count} of the particles of cloth '{cloth}' inside {collider}, up to {value:.3g} m deep",
               "pins and colliders that keep apart would do",
               "0: the collider pushes the particles beside the held ones out"},
     .find = held_in_collider},
    {.words = {"strain between pins of rigid cloth",
               "pins hold two particles of cloth '{cloth}', which is rigid, {value_percent:.3g} % farther apart than "
               "at rest",
               "pins that stay nearer to each other, or springs that are not rigid, would do",
               "the largest stretch error of a spring that `auto` keeps"},
     .find = [](const SimulationModel& model, std::size_t cloth,
                std::uint32_t frame) { return held_apart(model, cloth, frame, model.stretch_limits().worst); }},
    {.words = {"room between colliders, m",
               "{collider} and {other} leave {bound:.3g} m between them, where cloth '{cloth}' takes {value:.3g}",
               "colliders that stay farther apart, or thinner cloth, would do",
               "what contact keeps the cloth's particles away from both, twice the thickness among it"},
     .find = pinched},
    {.words = {"times that wind takes cloth along in a frame",
               "wind takes cloth '{cloth}' to its own speed {value:.3g} times over in a frame, where at most "
               "{bound:.3g} are followed",
               "a denser cloth, less wind or more frames a second would do", "20: beyond it the cloth moves in jerks"},
     .find = [](const SimulationModel& model, std::size_t cloth,
                std::uint32_t) { return blown_away(model, cloth, most_wind_rate); }},
};

}  // namespace

std::span<const ClothBound> cloth_bounds() { return cloth_rows; }
std::span<const PassageBound> passage_bounds() { return passage_rows; }
std::span<const SceneBound> scene_bounds() { return scene_rows; }

double spare_energy(const Seen& s) { return energy_bound(s) - energy_of(s).gained; }

std::string sentence(const Words& words, const Finding& found) {
    return fmt::format(fmt::runtime(words.sentence), fmt::arg("value", found.value), fmt::arg("bound", found.bound),
                       fmt::arg("value_percent", 100 * found.value), fmt::arg("bound_percent", 100 * found.bound),
                       fmt::arg("cloth", found.cloth), fmt::arg("place", found.place),
                       fmt::arg("collider", found.collider), fmt::arg("other", found.other),
                       fmt::arg("first", found.first), fmt::arg("frame", found.frame), fmt::arg("count", found.count));
}

std::string told(const Words& words, const Finding& found) {
    return sentence(words, found) + words.joint + words.remedy;
}

}  // namespace drape
