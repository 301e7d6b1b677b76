// These are the plain values of a scene file: `scene_reader.h` fills them by the rows of `scene_format.cpp`, everything
// else reads them. Units are SI and degrees; every default is the published one, of a world with y up.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "drape/actions.h"
#include "drape/gas.h"
#include "drape/key.h"
#include "drape/look.h"
#include "drape/seam.h"
#include "drape/solid.h"
#include "drape/solver_method.h"
#include "drape/spelling.h"
#include "drape/vec3.h"

namespace drape {

class MeshSequence;
class MeshShape;

/// The axis that points up in a scene's world. Coordinates are the scene's own everywhere (world/up.h). The reader
/// turns defaults that have a direction with it; these structures have those of a world with y up.
enum class Up { y, z };
inline constexpr Spelling<Up> up_spellings[] = {{"y", Up::y}, {"z", Up::z}};

/// One key of a vector that changes, of a wind's velocity or of gravity: world/weather.h gives it between the keys.
struct VectorKey {
    double time = 0.0;  ///< s
    Vec3 value{0, 0, 0};
    bool operator==(const VectorKey&) const = default;
};

/// One key of a factor that changes.
struct FactorKey {
    double time = 0.0;  ///< s
    double factor = 1.0;
    bool operator==(const FactorKey&) const = default;
};

/// One key of a key-framed rigid motion. It turns about x, then y, then z; several turns are allowed, because paths
/// interpolate the angles component by component.
struct MotionKey {
    double time = 0.0;  ///< s
    Vec3 translate{0, 0, 0};
    Vec3 rotate{0, 0, 0};
    bool operator==(const MotionKey&) const = default;
};

/// The path is a smooth curve through the keys that does not leave their range (world/motion.h); it holds its ends, and
/// rests without keys.
struct MotionPath {
    std::vector<MotionKey> keys;  ///< strictly increasing in time
    bool moves() const { return keys.size() > 1; }
    bool operator==(const MotionPath&) const = default;
};

struct TimeSettings {
    double fps = 60.0;
    std::uint32_t frame_count = 121;  ///< frames 0 .. frame_count-1; frame 0 is the initial state
    bool operator==(const TimeSettings&) const = default;
};

/// An extra wind along `velocity`'s direction; the schema gives it as a function of time and seed.
struct Gust {
    double amplitude = 0.0;  ///< m/s
    double period = 1.0;     ///< s
    std::uint32_t seed = 0;
    bool operator==(const Gust&) const = default;
};

struct Wind {
    Vec3 velocity{0, 0, 0};  ///< m/s; of no effect beside keys
    Gust gust;
    double air_density = 1.2;     ///< kg/m^3
    double drag = 1.0;            ///< Cd
    double lift = 0.5;            ///< Cl
    std::vector<VectorKey> keys;  ///< m/s, strictly increasing in time; empty: the velocity is steady
    bool blows() const {
        if (keys.empty()) return velocity != Vec3{};
        return std::ranges::any_of(keys, [](const VectorKey& key) { return key.value != Vec3{}; });
    }
    bool operator==(const Wind&) const = default;
};

/// The flat cloth starts with particle (column 0, row 0) at `origin`; columns grow along unit `u`, rows along `v`.
struct Placement {
    Vec3 origin{0, 0, 0};
    Vec3 u{1, 0, 0};
    Vec3 v{0, -1, 0};
    std::array<double, 2> scale{1, 1};  ///< distances at the start over those at rest, along u and v
    double jitter = 0;                  ///< m, along each axis; moves particles that no pin holds
    std::uint32_t seed = 0;             ///< decides the jitter
    bool operator==(const Placement&) const = default;
};

/// What a fabric has along its warp, the threads along u (growing column), and along its weft, those along v. A single
/// number is both.
struct WarpWeft {
    double warp, weft;
    constexpr WarpWeft(double both = 0) : WarpWeft(both, both) {}
    constexpr WarpWeft(double along_warp, double along_weft) : warp(along_warp), weft(along_weft) {}
    constexpr double along(std::size_t axis) const { return axis == 0 ? warp : weft; }  ///< 0: rows, 1: columns
    constexpr double least() const { return std::min(warp, weft); }
    constexpr double largest() const { return std::max(warp, weft); }
    constexpr WarpWeft& operator*=(double factor) {
        warp *= factor, weft *= factor;
        return *this;
    }
    bool operator==(const WarpWeft&) const = default;
};

/// N m: the rigidities of a sheet that bends along its warp, along its weft, and that twists. A single number is that
/// of a sheet as stiff in every direction.
struct Rigidity : WarpWeft {
    double twist;
    constexpr Rigidity(double all = 0) : Rigidity(all, all, all) {}
    constexpr Rigidity(double along_warp, double along_weft, double of_twist)
        : WarpWeft(along_warp, along_weft), twist(of_twist) {}
    constexpr double largest() const { return std::max(WarpWeft::largest(), twist); }
    constexpr Rigidity& operator*=(double factor) {
        WarpWeft::operator*=(factor);
        twist *= factor;
        return *this;
    }
    bool operator==(const Rigidity&) const = default;
};

struct Stiffness {
    bool rigid = false;         ///< stretch and shear are inextensible, like the springs of the 2004 slides
    WarpWeft stretch = 1000.0;  ///< N/m
    double shear = 100.0;       ///< N/m
    Rigidity bend = 0.0;
    double compression = 1.0;  ///< share of stretch and shear that acts where springs are pushed together
    bool operator==(const Stiffness&) const = default;
};

/// Inclusive box of particle indices (column, row).
struct IndexBox {
    std::array<std::uint32_t, 2> first{};
    std::array<std::uint32_t, 2> last{};
    bool operator==(const IndexBox&) const = default;
};

/// Particles held by the scene. The reader resolves `edge`, `corner` and `at` of the scene file to an IndexBox, so that
/// nothing later needs to know the four spellings.
struct Pin {
    IndexBox particles;
    std::optional<double> release;  ///< s; from then on the particle is free and keeps its velocity
    MotionPath path;
    std::optional<Vec3> pivot;  ///< m; rotation centre; default: centroid of the particles that no later pin holds
    bool operator==(const Pin&) const = default;
};

/// What pulls at particles of a cloth, in a direction that does not turn with it, or presses on one of its sides. One
/// of the two is given, as a number or as keys (world/weather.h).
struct Load {
    IndexBox particles;
    Vec3 force{0, 0, 0};                ///< N: on all of its particles together, which share it by their areas
    std::vector<VectorKey> force_keys;  ///< N, strictly increasing in time
    std::optional<double> pressure;     ///< Pa: pushes towards the front, u x v; below 0 towards the back
    std::vector<NumberKey> pressure_keys;
    /// Factors of every particle of the cloth, row by row, at least 0; empty: 1. A force is shared by area times
    /// factor.
    std::vector<float> factors;
    bool presses() const { return pressure || !pressure_keys.empty(); }
    bool operator==(const Load&) const = default;
};

/// Contact of a cloth with itself keeps a thickness of at least and at most these shares of the grid's smaller spacing.
inline constexpr double least_self_thickness = 0.1, most_self_thickness = 1.0;

struct SelfCollision {
    std::optional<double> thickness;  ///< m between layers; default: the cloth's thickness, within what the grid allows
    std::optional<double> friction;   ///< Coulomb coefficient between layers; default: the cloth's
    bool operator==(const SelfCollision&) const = default;
};

/// Contact keeps either all that is drawn of a cloth out of colliders, or only its particles.
enum class ContactOf { surface, particles };
inline constexpr Spelling<ContactOf> contact_spellings[] = {{"surface", ContactOf::surface},
                                                            {"particles", ContactOf::particles}};

/// In this shape no spring along threads or diagonals is stretched or pushed together.
enum class Rest { flat, start };
inline constexpr Spelling<Rest> rest_spellings[] = {{"flat", Rest::flat}, {"start", Rest::start}};

/// A spring along a row or column ends once it bears more than this (engine/docs/physics.md 8). One of the two is
/// given.
struct Tear {
    std::optional<double> strain;   ///< m/m
    std::optional<double> tension;  ///< N/m: force per width of the cloth
    bool operator==(const Tear&) const = default;
};

struct Cloth {
    std::string name;
    std::array<std::uint32_t, 2> grid{2, 2};  ///< particles: columns, rows
    std::array<double, 2> size{1, 1};         ///< metres along columns, rows
    Placement placement;
    /// m: where every particle starts, row by row. Empty: flat, as placed. Else `placement` has its defaults.
    std::vector<Vec3> start;
    Rest rest = Rest::flat;  ///< `start` needs that
    /// m: where every particle lies on the flat cloth, row by row, from the corner of its box; the cells' shapes decide
    /// masses and constants (engine/docs/physics.md 1). Empty: where the grid has it.
    std::vector<std::array<double, 2>> panel;
    double areal_density = 0.2;  ///< kg/m^2; where cells differ, of one with the factor 1
    Stiffness stiffness;
    /// Factors of all of the stiffness, at most 1, strictly increasing in time; empty: it stays (world/weather.h).
    std::vector<FactorKey> stiffness_keys;
    double damping = 0.0;      ///< 1/s
    double friction = 0.3;     ///< Coulomb coefficient of the cloth's own side
    double thickness = 0.005;  ///< m, distance kept from colliders
    ContactOf contact = ContactOf::surface;
    std::optional<SelfCollision> self_collision;  ///< nothing: the cloth passes through itself
    Vec3 velocity{0, 0, 0};                       ///< m/s
    /// m/s: of every particle at the start, row by row. Empty: all have `velocity`.
    std::vector<Vec3> velocities;
    std::vector<IndexBox> holes;  ///< boxes of particle indices whose inner cells are missing
    /// Factors of every cell, row by row; empty: 1. The stiffness is at most, the density at least what the cloth says.
    std::vector<float> cell_stiffness, cell_density;
    std::optional<Tear> tear;      ///< nothing: it holds whatever pulls at it
    std::vector<float> cell_tear;  ///< factors of what every cell bears, row by row; empty: 1
    /// Factors of every particle, row by row; empty: 1. Those of the thickness, also of that between layers, are at
    /// most 1, and the cloth's friction, also that between layers, is of a particle with the factor 1.
    std::vector<float> particle_friction, particle_thickness;
    std::vector<Pin> pins;
    std::vector<Load> loads;
    Appearance appearance;
    bool operator==(const Cloth&) const = default;
};

/// Returns how far particles of the flat cloth are from each other, m: along columns, along rows.
inline std::array<double, 2> grid_spacing(const Cloth& cloth) {
    return {cloth.size[0] / (cloth.grid[0] - 1), cloth.size[1] / (cloth.grid[1] - 1)};
}
/// Returns the smaller of the two.
inline double least_spacing(const Cloth& cloth) { return std::ranges::min(grid_spacing(cloth)); }

struct Plane {
    Vec3 normal{0, 1, 0};  ///< unit length after reading; outside: normal . x >= offset
    double offset = 0.0;
    bool operator==(const Plane&) const = default;
};
struct Sphere {
    Vec3 center{0, 0, 0};
    double radius = 1.0;
    bool operator==(const Sphere&) const = default;
};
struct Box {
    Vec3 center{0, 0, 0};
    Vec3 half_extents{0.5, 0.5, 0.5};
    bool operator==(const Box&) const = default;
};
struct Ellipsoid {
    Vec3 center{0, 0, 0};
    Vec3 radii{0.5, 0.5, 0.5};
    bool operator==(const Ellipsoid&) const = default;
};

/// A sphere is swept from `from` to `to`, its radius going from the first to the second: two balls and the cone that
/// touches both. If one ball contains the other, the larger is left. It turns about the segment's middle.
struct Capsule {
    Vec3 from{-0.5, 0, 0};
    Vec3 to{0.5, 0, 0};
    std::array<double, 2> radii{0.25, 0.25};  ///< m, at `from` and at `to`
    bool operator==(const Capsule&) const = default;
};

inline constexpr Spelling<Solid> solid_spellings[] = {
    {"mended", Solid::mended}, {"filled", Solid::filled}, {"strict", Solid::strict}};

/// A triangle mesh from a file: a solid body, or a shell, which may deform. The scene reader reads the files; whoever
/// fills this otherwise calls `read_file` (drape/scene_reader.h).
struct Mesh {
    std::string file;             ///< OBJ, PLY, STL or glTF
    double scale = 1;             ///< m per unit of the file
    Vec3 position{0, 0, 0};       ///< m, where the file's origin is
    std::optional<double> shell;  ///< m: the thickness of a surface that is not closed
    /// Distances are known at points so far apart, m; default: half of the least distance of particles, or more where
    /// the field would be too large.
    std::optional<double> spacing;
    /// Where the file's vertices are in a series of poses: PC2, NPY, or the name of one of many OBJ files, with # for
    /// the digits of its number. Empty: it keeps its form.
    std::string frames{};
    double frames_per_second = 24;             ///< poses a second; between two the vertices move along straight lines
    double frames_start = 0;                   ///< s: when the first pose is; before it, that holds
    bool loop = false;                         ///< the first pose follows the last one; else the last one holds
    Solid solid = Solid::mended;               ///< how it becomes a body without `shell`
    std::shared_ptr<const MeshShape> shape{};  ///< what was read; of one that deforms, a box holds all its poses
    std::shared_ptr<const MeshSequence> sequence{};  ///< the poses; null where there are none
    double grown = 0;                                ///< m: contact takes the surface to be so far outside of it
    bool operator==(const Mesh&) const = default;
};

/// The alternatives stand in the order of the collider kinds (shaders/shared/collider_types.h).
using ColliderShape = std::variant<Plane, Sphere, Box, Ellipsoid, Capsule, Mesh>;
/// The scene file has one list per shape, in the same order.
inline constexpr std::string_view collider_lists[] = {"planes", "spheres", "boxes", "ellipsoids", "capsules", "meshes"};
static_assert(std::size(collider_lists) == std::variant_size_v<ColliderShape>);
/// One of each list is called this.
inline constexpr std::string_view collider_names[] = {"plane", "sphere", "box", "ellipsoid", "capsule", "mesh"};
static_assert(std::size(collider_names) == std::variant_size_v<ColliderShape>);

/// `std::visit` calls one of these functions, of which each kind has its own. None of them is a template, so that a
/// kind that somebody adds does not compile until each room that asks has an answer for it.
template <class... Functions>
struct ForEachKind : Functions... {
    using Functions::operator()...;
};
template <class... Functions>
ForEachKind(Functions...) -> ForEachKind<Functions...>;

/// Two kinds are unlike the others: a plane has no end, and a mesh has triangles, poses and a field of distances
/// instead of a formula. Whoever needs one of the two asks here; the pointers go to the shape.
struct SpecialShape {
    const Plane* plane = nullptr;
    const Mesh* mesh = nullptr;
};
inline SpecialShape special(const ColliderShape& shape) {
    return std::visit(
        ForEachKind{[](const Plane& plane) { return SpecialShape{.plane = &plane}; },
                    [](const Sphere&) { return SpecialShape{}; }, [](const Box&) { return SpecialShape{}; },
                    [](const Ellipsoid&) { return SpecialShape{}; }, [](const Capsule&) { return SpecialShape{}; },
                    [](const Mesh& mesh) { return SpecialShape{.mesh = &mesh}; }},
        shape);
}

/// `rotate` and `path` rotate about the collider's own centre (a plane's is the foot point normal * offset, a mesh's
/// the middle of its bounding box); a path is applied on top of the rest pose.
struct Collider {
    ColliderShape shape;
    double friction = 0.3;
    Vec3 rotate{0, 0, 0};  ///< degrees, rest pose
    MotionPath path{};
    Vec3 color{0.55, 0.57, 0.60};  ///< sRGB 0..1
    /// kg: it is a body that gravity, cloth and what it meets move. It has no path then.
    std::optional<double> mass = {};
    std::optional<Vec3> inertia = {};  ///< principal moments, kg m^2; nothing: of one density
    Vec3 velocity{0, 0, 0};            ///< of a body at the start, m/s
    Vec3 angular_velocity{0, 0, 0};    ///< rad/s
    int kind() const { return static_cast<int>(shape.index()); }
    bool deforms() const {
        const Mesh* const mesh = special(shape).mesh;
        return mesh != nullptr && mesh->sequence != nullptr;
    }
    bool moves() const { return path.moves() || deforms() || mass; }
    bool operator==(const Collider&) const = default;
};

/// A triangle that cuts every cloth it meets while active. Between two frames it sweeps the surface of the prism
/// from its last pose to the new one. A path rotates it about its centroid.
struct Cutter {
    std::array<Vec3, 3> triangle{};
    double begin = 0.0, end = 0.0;  ///< s; active from begin to end, both included
    MotionPath path;
    bool crumbs = false;  ///< small pieces that are cut off are drawn, those of all cutters when one has it
    bool operator==(const Cutter&) const = default;
};

enum class CollideWhen { iteration, substep };
inline constexpr Spelling<CollideWhen> collide_spellings[] = {{"iteration", CollideWhen::iteration},
                                                              {"substep", CollideWhen::substep}};

/// Cloth that starts inside a collider is moved out by contact, without speed (resolve), or is an error (refuse).
enum class Overlap { resolve, refuse };
inline constexpr Spelling<Overlap> overlap_spellings[] = {{"resolve", Overlap::resolve}, {"refuse", Overlap::refuse}};

/// `auto` aims at this stretch error where the scene states none.
inline constexpr double default_tolerance = 0.01;
/// A single spring may have this stretch error.
inline constexpr double default_tolerance_worst = 0.1;

struct SolverSettings {
    SolverMethod method = SolverMethod::automatic;  ///< solver_choice.h resolves `auto`
    std::uint32_t substeps = 20;
    std::uint32_t iterations = 1;
    /// Largest RMS stretch error of a frame (cloth_statistics.h); 0 promises nothing. Iterations end once it is met.
    double tolerance = 0;
    /// Method `auto` keeps the largest stretch error of a spring (0: solver_choice.h's limit) and the largest error of
    /// the motion, in m per second of simulated time (0: a share of the cloth's size).
    double tolerance_worst = 0, tolerance_motion = 0;
    /// Whether companion runs estimate the position error. Left out: those of method `auto` do, of named ones not.
    std::optional<bool> estimate_error;
    CollideWhen collide = CollideWhen::iteration;
    bool tethers = false;  ///< no particle gets farther from where the cloth is held than the cloth reaches
    /// Method `explicit`: damping of the strain rate of springs stretched by more than a tenth, over stiffness times h;
    /// a twentieth of that of others.
    double strain_damping = 0.2;
    bool operator==(const SolverSettings&) const = default;
};

/// A check that the scene promises to meet. `drape verify` judges it, the simulation ignores it.
struct Oracle {
    std::string check;
    std::vector<std::pair<std::string, double>> limits;
    bool operator==(const Oracle&) const = default;
};

struct SceneDescription {
    std::string name;
    TimeSettings time;
    Up up = Up::y;
    Vec3 gravity{0, -9.81, 0};            ///< m/s^2; of no effect beside keys
    std::vector<VectorKey> gravity_keys;  ///< m/s^2, strictly increasing in time; empty: gravity is constant
    Wind wind;
    std::vector<Cloth> cloths;
    std::vector<Seam> seams;
    std::vector<Gas> gas;  ///< each closed in by cloths of its own
    std::vector<Collider> colliders;
    Overlap overlap = Overlap::resolve;
    std::vector<Cutter> cutters;
    SolverSettings solver;
    bool forces = false;                                      ///< statistics tell what pulls and pushes each cloth
    bool worst_forces = false;                                ///< and the largest of each in a substep
    bool force_fields = false;                                ///< frames tell what each spring and particle bears
    std::optional<SceneActions> actions;                      ///< what it is told on the way
    std::optional<Camera> camera;                             ///< without one picture/framing.h finds one
    std::vector<DirectionalLight> lights = default_lights();  ///< at most 4
    Vec3 ambient{0.36, 0.40, 0.47};                           ///< light of the sky, linear radiance factor 0..1
    Vec3 ambient_ground{0.20, 0.17, 0.14};                    ///< light of the ground, in the same unit
    ImageSettings image;
    std::vector<Oracle> oracles;
    bool tears() const {
        return std::ranges::any_of(cloths, [](const Cloth& cloth) { return cloth.tear.has_value(); });
    }
    /// Returns whether springs and triangles may end.
    bool comes_apart() const { return !cutters.empty() || tears(); }
    bool operator==(const SceneDescription&) const = default;
};

}  // namespace drape
