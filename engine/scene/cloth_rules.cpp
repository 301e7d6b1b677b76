#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "base/vectors.h"
#include "drape/scene_reader.h"
#include "scene/scene_rules.h"
#include "world/overlap.h"
#include "world/start.h"
#include "world/start_crossings.h"
#include "world/weather.h"

namespace drape {
namespace {

using Particle = std::array<std::uint32_t, 2>;
constexpr const char* name_letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-";

bool read_particle(const SceneNode& node, const Particle& grid, Particle& particle) {
    if (!node.open_array("a particle [column, row]", 2, 2)) return false;
    const bool has_column = node.element(0).read(particle[0], 0, grid[0] - 1);
    return node.element(1).read(particle[1], 0, grid[1] - 1) && has_column;
}

bool check_particle(const SceneNode& node, const Particle& particle, const Particle& grid) {
    bool fits = true;
    for (std::size_t axis = 0; axis < 2; ++axis)
        if (particle[axis] >= grid[axis])
            fits = node.element(axis).fail_expected(fmt::format("an integer from 0 to {}", grid[axis] - 1));
    return fits;
}

bool check_box(const SceneNode& node, const IndexBox& box, const Particle& grid) {
    if (box == IndexBox{}) return true;  // fits every grid, or was reported already and may be no box
    const bool has_first = check_particle(node.element(0), box.first, grid);
    if (!check_particle(node.element(1), box.last, grid) || !has_first) return false;
    return (box.first[0] <= box.last[0] && box.first[1] <= box.last[1]) ||
           node.fail_expected("the first particle of a box not beyond its last");
}

bool find_particles(const SceneNode& node, const Particle& grid, const Cloth& cloth, const std::array<double, 2>& low,
                    IndexBox& particles) {
    if (const SceneNode point = node.member("point")) return find_point(point, cloth, low, particles);
    if (const SceneNode at = node.member("at")) return check_particle(at, particles.first, grid);
    if (const SceneNode box = node.member("box")) return check_box(box, particles, grid);
    for (std::size_t axis = 0; axis < 2; ++axis) {
        particles.first[axis] *= grid[axis] - 1;
        particles.last[axis] *= grid[axis] - 1;
    }
    return true;
}

// Single precision must resolve a quarter of an edge where the cloth starts, or the springs see only rounding.
bool check_resolution(const SceneNode& cloth_node, const Cloth& cloth) {
    double farthest = 0.0;
    const StartBox box = start_box(cloth);
    for (const Vec3& corner : {box.low, box.high})
        for (const double x : corner) farthest = std::max(farthest, std::abs(x) + cloth.placement.jitter);
    const double edge = least_spacing(cloth);
    const auto single = static_cast<float>(farthest);
    const double ulp = static_cast<double>(std::nextafter(single, std::numeric_limits<float>::infinity())) - single;
    if (ulp <= 0.25 * edge) return true;
    return cloth_node.fail(
        fmt::format("expected a cloth that single precision resolves: at {:.6g} m from the origin it is exact to "
                    "{:.3g} m, more than a quarter of the edge length {:.3g} m",
                    farthest, ulp, edge));
}

// The thickness must be one that the grid can keep, and the device's dispatches must reach all particles.
bool check_self_collision(const SceneNode& node, const Cloth& cloth) {
    if (!cloth.self_collision) return true;
    constexpr std::uint64_t most_particles = 4'000'000;
    if (std::uint64_t{cloth.grid[0]} * cloth.grid[1] > most_particles)
        return node.fail(fmt::format("expected at most {} particles in a cloth that meets itself, got {}",
                                     most_particles, std::uint64_t{cloth.grid[0]} * cloth.grid[1]));
    if (!cloth.self_collision->thickness) return true;
    const double spacing = least_spacing(cloth);
    const double least = least_self_thickness * spacing, most = most_self_thickness * spacing;
    const double thickness = *cloth.self_collision->thickness;
    constexpr double rounding = 1e-9;  // allows for dividing the cloth's size by its edges
    if (thickness >= least * (1 - rounding) && thickness <= most * (1 + rounding)) return true;
    return node.member("thickness")
        .fail(fmt::format(
            "expected {:.4g} to {:.4g} m, {:.3g} to {:.3g} times the grid's smaller spacing, got {:.6g}; {}", least,
            most, least_self_thickness, most_self_thickness, thickness,
            thickness < least ? "a finer grid allows less" : "a coarser grid allows more"));
}

// Counts the particles that a grid asks for, also where an axis is beyond its limit: the message should name the count.
std::uint64_t requested_particle_count(const SceneNode& grid, const Cloth& cloth) {
    std::uint64_t count = 1;
    for (std::size_t axis = 0; axis < 2; ++axis) {
        std::uint32_t requested = cloth.grid[axis];
        if (grid && grid.value()->isArray() && grid.size() == 2) {
            const Json::Value& written = *grid.element(axis).value();
            if (written.isUInt()) requested = written.asUInt();
        }
        count *= requested;  // two factors below 2^32 do not overflow
    }
    return count;
}

// Adds to `total`, saturating, and reports the cloth that takes it over the limit.
void count_particles(const SceneNode& grid, const Cloth& cloth, std::uint64_t& total) {
    const std::uint64_t before = total;
    const std::uint64_t count = requested_particle_count(grid, cloth);
    const std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
    total = count > most - total ? most : total + count;
    if (before <= scene_particle_limit && total > scene_particle_limit)
        grid.fail(
            fmt::format("expected at most {} particles in all cloths together, got {}", scene_particle_limit, total));
}

/// Returns how many edge lengths gravity moves a free particle by in a substep, with the most substeps: g D^2 / h.
double fall_per_substep(const SceneDescription& scene, const Cloth& cloth, double gravity, double fps) {
    const bool is_automatic = scene.solver.method == SolverMethod::automatic;
    const double step = 1 / (fps * (is_automatic ? most_solver_substeps : scene.solver.substeps));
    const double edge = least_spacing(cloth);
    return gravity * step * step / edge;
}

/// Steps in which cloth falls by ten thousand of its edges are beyond any use. The error blames the value that would
/// set it right if it were ordinary: gravity, the frame rate, or else the cloth.
bool check_fall(const Members& members, const SceneDescription& scene) {
    constexpr double most = 1e4, ordinary_gravity = 9.81, ordinary_fps = 60;
    const Vec3 strongest = strongest_gravity(scene);
    const double gravity = std::hypot(strongest[0], strongest[1], strongest[2]), fps = scene.time.fps;
    for (std::size_t i = 0; i < scene.cloths.size(); ++i) {
        const Cloth& cloth = scene.cloths[i];
        const double fall = fall_per_substep(scene, cloth, gravity, fps);
        if (!(fall > most)) continue;
        const std::string why = fmt::format(
            "cloth \"{}\" would fall {:.3g} of its edge lengths in a substep (gravity {:.3g} m/s^2, {:.6g} frames/s), "
            "and at most {:.0e} can be simulated",
            cloth.name, fall, gravity, fps, most);
        if (fall_per_substep(scene, cloth, std::min(gravity, ordinary_gravity), fps) <= most)
            return members[scene.gravity_keys.empty() ? "gravity" : "gravity_keys"].fail("expected less gravity: " +
                                                                                         why);
        if (fall_per_substep(scene, cloth, gravity, std::max(fps, ordinary_fps)) <= most)
            return members["time"].member("fps").fail("expected more frames per second: " + why);
        return members["cloths"].element(i).fail("expected a larger cloth, more frames per second or less gravity: " +
                                                 why);
    }
    return true;
}

bool start_boxes_meet(const Cloth& a, const Cloth& b) {
    const StartBox one = start_box(a), other = start_box(b);
    for (std::size_t i = 0; i < 3; ++i)
        if (one.high[i] < other.low[i] || other.high[i] < one.low[i]) return false;
    return true;
}

bool are_sewn(const SceneDescription& scene, const Cloth& one, const Cloth& other) {
    return std::ranges::any_of(scene.seams, [&](const Seam& seam) {
        return (seam.a.cloth == one.name && seam.b.cloth == other.name) ||
               (seam.a.cloth == other.name && seam.b.cloth == one.name);
    });
}

// Warns once per cloth, naming the first of the earlier ones that it meets.
void warn_of_touching(const SceneNode& node, const SceneDescription& scene) {
    const std::vector<Cloth>& cloths = scene.cloths;
    for (std::size_t i = 1; i < cloths.size(); ++i) {
        const auto meets = [&](const Cloth& earlier) {
            return start_boxes_meet(earlier, cloths[i]) && !are_sewn(scene, earlier, cloths[i]);
        };
        const auto other = std::find_if(cloths.begin(), cloths.begin() + static_cast<std::ptrdiff_t>(i), meets);
        if (other - cloths.begin() == static_cast<std::ptrdiff_t>(i)) continue;
        node.element(i).warn(
            fmt::format("cloths \"{}\" and \"{}\" are set to touch, but will pass through each other: "
                        "only with self_collision in one of a scene's cloths do they meet",
                        other->name, cloths[i].name));
    }
}

/// Says what becomes of the crossing, and what would help.
std::string crossing_fate(const SceneDescription& scene, const StartCrossing& crossing) {
    if (crossing.untied > 0) return "";
    if (crossing.first == crossing.second)
        return fmt::format(": no frame is proved; {} would help", scene.cloths[crossing.first].start.empty()
                                                                      ? "less jitter"
                                                                      : "a shape that does not cross itself");
    const std::string elsewhere = "; place one of them elsewhere";
    if (is_led_apart(scene, crossing))
        return fmt::format(": they are led apart at {} m/s and meet from then on{}", parting_speed, elsewhere);
    if (is_worked_apart(crossing))
        return ": held as both are, they are not led apart, and meet only once they have come apart" + elsewhere;
    return ": the two will not meet, and no frame is proved" + elsewhere;
}

/// Returns what says where a cloth starts.
SceneNode start_node(const SceneNode& cloth) {
    for (const char* key : {"placement", "start"})
        if (SceneNode node = cloth.member(key)) return node;
    return cloth;
}

/// Warns of cloths that start through each other or themselves, where cloths meet. It is an error where the scene
/// refuses that, or contact would hold all of a cloth in one place.
void check_crossings(const SceneNode& cloths, const SceneDescription& scene) {
    for (const StartCrossing& crossing : start_crossings(scene)) {
        const SceneNode blamed = start_node(cloths.element(crossing.second));
        const std::string text = crossing_text(scene, crossing);
        if (is_refused(scene, crossing))
            blamed.fail((crossing.gathered ? "expected a cloth with room between its particles: "
                                           : "expected cloths that start apart (/overlap is \"refuse\"): ") +
                        text);
        else
            blamed.warn(text + crossing_fate(scene, crossing));
    }
}

/// Warns of each cloth that starts inside a collider, which is an error where the scene refuses that.
void check_overlaps(const SceneNode& cloths, const SceneDescription& scene) {
    for (const StartOverlap& overlap : start_overlaps(scene)) {
        const SceneNode blamed = start_node(cloths.element(overlap.cloth));
        const std::string text = overlap_text(scene, overlap);
        if (scene.overlap == Overlap::refuse)
            blamed.fail("expected a start outside all colliders (/overlap is \"refuse\"): " + text);
        else
            blamed.warn(text + ": contact moves free particles out at 0.1 m/s, and held ones stay");
    }
}

constexpr std::initializer_list<const char*> particle_words{"edge", "corner", "at", "box", "point"};

int count_of(const Members& members, std::initializer_list<const char*> keys) {
    int count = 0;
    for (const char* key : keys) count += members[key] ? 1 : 0;
    return count;
}

/// Finds the particles of a cloth's loads, and their maps.
bool take_loads(const SceneNode& node, const std::array<double, 2>& low, Cloth& cloth) {
    bool fits = true;
    for (std::size_t i = 0; i < cloth.loads.size(); ++i) {
        const SceneNode element = node.element(i);
        Load& load = cloth.loads[i];
        if (!find_particles(element, cloth.grid, cloth, low, load.particles) || !take_load_map(element, cloth, load)) {
            fits = false;
        } else if (!is_loaded(cloth, load)) {
            fits = element.fail("expected a particle that has a cell, where the map is above 0, got none");
        }
    }
    return fits;
}

/// A particle that a load moves by ten thousand edges in a substep is beyond any use, too.
bool check_loads(const SceneNode& cloths, const SceneDescription& scene) {
    constexpr double most = 1e4;
    bool fits = true;
    for (std::size_t i = 0; i < scene.cloths.size(); ++i) {
        const Cloth& cloth = scene.cloths[i];
        const auto [dx, dy] = grid_spacing(cloth);
        for (std::size_t k = 0; k < cloth.loads.size(); ++k) {
            const Load& load = cloth.loads[k];
            const auto& [first, last] = load.particles;
            const double count = (last[0] - first[0] + 1.0) * (last[1] - first[1] + 1.0);
            const double area = load.presses() ? 1.0 : 0.25 * dx * dy * count;
            const double pulled =
                fall_per_substep(scene, cloth, strongest(load) / (cloth.areal_density * area), scene.time.fps);
            if (pulled > most)
                fits = cloths.element(i).member("loads").element(k).fail(fmt::format(
                    "expected a weaker load, more particles or more frames per second: it would move "
                    "particles by {:.3g} of the cloth's edge lengths in a substep, and at most {:.0e} can be "
                    "simulated",
                    pulled, most));
        }
    }
    return fits;
}

constexpr std::size_t most_force_pins = 1000;

/// What holds a cloth is told apart among its pins by what its springs bear, which rigid ones do not say.
void check_forces(const SceneNode& node, const SceneDescription& scene) {
    if (!scene.forces) return;
    for (std::size_t i = 0; i < scene.cloths.size(); ++i) {
        const Cloth& cloth = scene.cloths[i];
        if (cloth.stiffness.rigid && cloth.pins.size() > 1)
            node.element(i)
                .member("stiffness")
                .fail(
                    "expected springs with a stiffness, by which forces are told apart among several pins, got "
                    "\"rigid\"");
        if (cloth.pins.size() > most_force_pins)
            node.element(i).member("pins").fail(
                fmt::format("expected at most {} pins where the scene tells forces", most_force_pins));
    }
}

}  // namespace

Value<std::string> file_name() {
    return {{"\"type\": \"string\", \"pattern\": \"^[A-Za-z0-9_-]{1,64}$\"", "1 to 64 letters, digits, `_` and `-`"},
            [](const SceneNode& node, std::string& name) {
                std::string written = name;
                if (!node) return true;
                if (!node.read(written)) return false;
                if (written.empty() || written.size() > 64 || written.find_first_not_of(name_letters) != written.npos)
                    return node.fail_expected("a name of 1 to 64 letters, digits, _ and - (it becomes a file name)");
                name = written;
                return true;
            }};
}

Value<IndexBox> particle() {
    Value<IndexBox> value;
    value.text = two_integers(0, grid_axis_limit - 1).text;
    value.read = [](const SceneNode& node, IndexBox& box) {
        Particle read{};
        if (!node) return true;
        if (!read_particle(node, {grid_axis_limit, grid_axis_limit}, read)) return false;
        box = {read, read};
        return true;
    };
    return value;
}

Value<IndexBox> particle_box(const Value<IndexBox>& particle) {
    return {{"\"type\": \"array\", \"items\": {" + particle.text.schema + "}, \"minItems\": 2, \"maxItems\": 2",
             "array of 2 of " + particle.text.words, particle.text.uses},
            [particle](const SceneNode& node, IndexBox& box) {
                if (!node.open_array("a box [[column, row], [column, row]]", 2, 2)) return !node;
                IndexBox first, last;
                const bool has_first = particle.read(node.element(0), first);
                if (!particle.read(node.element(1), last) || !has_first) return false;
                box = {first.first, last.last};
                return true;
            }};
}

bool check_placement(const Members& members, Placement& placement) {
    const double cosine = dot(placement.u, placement.v);
    if (!members.all_fit() || std::abs(cosine) <= 1e-6) return true;
    return members.object().fail(fmt::format("expected u and v at right angles, got a cosine of {:.6g}", cosine));
}

bool check_load(const Members& members, Load& load) {
    const int places = count_of(members, particle_words);
    if (places == 0) load.particles = {{0, 0}, {1, 1}};  // of a grid whose last column and row are 1
    if (places > 1)
        return members.object().fail(
            fmt::format("expected at most one of edge, corner, at, box and point, got {} of them", places));
    const int kinds = count_of(members, {"force", "force_keys", "pressure", "pressure_keys"});
    if (kinds == 1) return true;
    return members.object().fail(
        fmt::format("expected exactly one of force, force_keys, pressure and pressure_keys, got {} of them", kinds));
}

bool check_pin(const Members& members, Pin&) {
    const int count = count_of(members, particle_words);
    if (count == 1) return true;
    return members.object().fail(
        fmt::format("expected exactly one of edge, corner, at, box and point, got {} of them", count));
}

bool check_cloth(const Members& members, Cloth& cloth) {
    // Without a valid grid the indices are held against the largest one, so that a mistake in the grid is not
    // reported once more for every pin.
    const std::size_t written_holes = cloth.holes.size();
    std::array<double, 2> low{};
    if (!take_outline(members, cloth, low)) return false;
    const Particle grid = members.fit({"grid"}) ? cloth.grid : Particle{grid_axis_limit, grid_axis_limit};
    bool fits = true;
    note_fabric(members.object());
    for (std::size_t i = 0; i < written_holes; ++i)
        fits = check_box(members["holes"].element(i), cloth.holes[i], grid) && fits;
    if (members.fit({"stiffness", "tear"})) fits = check_torn_cloth(members, cloth) && fits;
    if (members.fit({"stiffness", "stiffness_keys", "tear"})) fits = check_stiffness_keys(members, cloth) && fits;
    if (members.fit({"grid", "size", "self_collision"}))
        fits = check_self_collision(members["self_collision"], cloth) && fits;
    if (members.fit({"grid", "maps", "stiffness", "tear"})) fits = take_maps(members, cloth) && fits;
    if (fits && members.fit({"grid", "holes", "maps"}) && !leaves_a_cell(cloth))
        fits = members[members["holes"] ? "holes" : "maps"].fail(
            "expected holes that leave a cell of the cloth, got none left");
    for (std::size_t i = 0; i < cloth.pins.size(); ++i)
        fits = find_particles(members["pins"].element(i), grid, cloth, low, cloth.pins[i].particles) && fits;
    if (fits && members.fit({"grid", "size", "holes", "maps", "loads"}))
        fits = take_loads(members["loads"], low, cloth);
    if (members.fit({"grid", "size", "holes", "maps", "start"})) fits = take_start(members, cloth) && fits;
    if (members.fit({"grid", "size", "appearance"})) fits = check_hem(members, cloth) && fits;
    if (members.fit({"grid", "velocity", "velocities"})) fits = take_velocities(members, cloth) && fits;
    if (members.fit({"grid", "size", "placement"})) {
        fits = check_resolution(members.object(), cloth) && fits;
        if (const double jitter = start_jitter(cloth); fits && jitter > cloth.placement.jitter)
            members["placement"].warn(fmt::format(
                "the cloth starts on a {}, which no force would part: its particles are moved by up to {:.2g} m",
                cloth.placement.scale == std::array<double, 2>{} ? "point" : "line", jitter));
    }
    return fits;
}

bool check_scene(const Members& members, SceneDescription& scene) {
    const SceneNode node = members["cloths"];
    std::vector<Cloth>& cloths = scene.cloths;
    std::set<std::string_view> names;
    std::uint64_t particle_total = 0;
    for (std::size_t i = 0; i < cloths.size(); ++i) {
        const SceneNode name = node.element(i).member("name");
        if (!name) cloths[i].name = i == 0 ? "cloth" : fmt::format("cloth{}", i + 1);
        if (!cloths[i].name.empty() && !names.insert(cloths[i].name).second)
            name.fail(fmt::format("expected a name no other cloth has, got \"{}\"", cloths[i].name));
        count_particles(node.element(i).member("grid"), cloths[i], particle_total);
    }
    if (members["gravity"] && members["gravity_keys"])
        members["gravity"].warn("gravity is ignored beside gravity_keys, which have it");
    if (!cloths_meet(scene)) warn_of_touching(node, scene);
    if (members.fit({"cloths", "seams", "colliders", "gravity_keys", "forces"}) &&
        check_seams(node, members["seams"], scene) && members.fit({"gas", "cutters"}))
        check_gas(members["gas"], scene);
    check_oracles(members["oracles"], scene);
    if (members.fit({"cloths", "colliders"})) check_fields(members["colliders"], scene);
    if (members.fit({"cloths", "colliders", "solver"})) check_bodies(members, scene);
    if (members.fit({"cloths", "colliders", "overlap"})) check_overlaps(node, scene);
    if (members.fit({"cloths", "overlap"}) && cloths_meet(scene)) check_crossings(node, scene);
    if (members.fit({"cloths", "forces"})) check_forces(node, scene);
    if (members.fit({"cloths", "solver"})) check_tear_limits(node, scene);
    warn_of_doubts(members, scene);
    if (members.fit({"time", "cloths", "colliders", "seams", "actions"}) && !check_actions(members, scene))
        return false;
    if (members.fit({"time", "cloths", "solver"}) && !check_loads(node, scene)) return false;
    return !members.fit({"time", "gravity", "gravity_keys", "cloths", "solver"}) || check_fall(members, scene);
}

}  // namespace drape
