// These rules are what a row cannot say: values of a special shape, and what concerns several keys of an object.
#pragma once

#include "scene/scene_value.h"

namespace drape {

inline constexpr std::uint32_t grid_axis_limit = 16384;
inline constexpr std::uint32_t most_solver_substeps = 4096;

Value<std::string> file_name();
/// [column, row] within the largest grid; `check_cloth` holds it against the cloth's own.
Value<IndexBox> particle();
Value<IndexBox> particle_box(const Value<IndexBox>& particle);
/// The keys of what changes, of any kind with a time, in the order of their times.
template <class Key>
Value<std::vector<Key>> keys_in_time(const Value<Key>& key);
Value<MotionPath> motion_path(const Value<MotionKey>& key);
Value<Stiffness> rigid_or(const Value<Stiffness>& springs);
/// A number for both directions, or an object that tells them apart, of a cloth's stretch or its bending.
template <class Each>
Value<Each> number_or(const Value<Each>& apart);
/// The value true means all defaults, false means nothing.
Value<std::optional<SelfCollision>> true_or(const Value<SelfCollision>& object);
Value<std::array<Vec3, 3>> triangle(const Value<Vec3>& point);
Value<std::string> check_name();
/// JSON: a number where all directions are alike, else an object.
std::string directions_text(const WarpWeft& each);
std::string directions_text(const Rigidity& each);
// The name of a fabric sets several fields.
ValueText fabric_text();
std::string_view fabric_help();
bool read_fabric(const SceneNode& node, Cloth& cloth);
/// Notes the fabric's values as the defaults of the keys that it sets.
void note_fabric(const SceneNode& cloth);

/// A map scales by factors of this range.
inline constexpr Range map_factor{1e-3, 1e3, false};
/// A map of friction may make parts of a cloth slip.
inline constexpr Range map_friction_factor{0, 1e3, false};

/// The files that a cloth's maps are in, and their ranges; an empty name: there is none.
struct MapFiles {
    std::string holes, stiffness, density, tear, friction, thickness;
    /// Factors where a map is dark, and light.
    std::array<double, 2> stiffness_range{0.1, 1}, density_range{0.1, 1}, tear_range{0.1, 1}, friction_range{0.1, 1},
        thickness_range{0.1, 1};
};
/// A cloth's outline as it is written.
struct OutlineText {
    std::string path, file, element;  ///< path data; or an SVG file, and the id of what counts in it
    std::optional<double> scale;      ///< m of a unit; nothing: 1, or what the file says
    double spacing = 0.01;            ///< m: of the cells
};
/// Gives a cloth the grid, the holes and the places that its outline asks for, and tells the corner of the outline's
/// box in its coordinates, m.
bool take_outline(const Members& members, Cloth& cloth, std::array<double, 2>& low);
/// Returns the lowest u and v of the points of an outline that was read before, m, where the panel's box begins;
/// nothing written: 0.
std::array<double, 2> outline_corner(const SceneNode& outline);
/// Finds the particle of a cloth with an outline that is nearest to a point in its coordinates, m.
bool find_point(const SceneNode& node, const Cloth& cloth, const std::array<double, 2>& low, IndexBox& particles);
/// Adds missing cells as boxes: runs of a row, each as far down as the same cells are missing below.
void add_holes(std::vector<bool> missing, Cloth& cloth);
/// Reads the start of a cloth whose grid and size are known, from the file that it names.
bool take_start(const Members& members, Cloth& cloth);
/// Reads likewise the velocities with which it starts.
bool take_velocities(const Members& members, Cloth& cloth);
/// Reads the maps of a cloth whose grid is known: holes become boxes, the others factors of cells or particles.
bool take_maps(const Members& members, Cloth& cloth);

// The borders and corners belong to a grid whose last column and row are 1.
inline constexpr Spelling<IndexBox> edge_spellings[] = {
    {"left", {{0, 0}, {0, 1}}}, {"right", {{1, 0}, {1, 1}}}, {"top", {{0, 0}, {1, 0}}}, {"bottom", {{0, 1}, {1, 1}}}};
inline constexpr Spelling<IndexBox> corner_spellings[] = {{"top_left", {{0, 0}, {0, 0}}},
                                                          {"top_right", {{1, 0}, {1, 0}}},
                                                          {"bottom_left", {{0, 1}, {0, 1}}},
                                                          {"bottom_right", {{1, 1}, {1, 1}}}};

/// Bodies have no path, and what bodies alone have needs a mass.
bool check_body(const Members& members, Collider& collider);
/// They weigh enough beside the cloth that may touch them.
bool check_bodies(const Members& members, const SceneDescription& scene);
bool check_capsule(const Members& members, Collider& collider);
/// Reads the mesh's files.
bool check_mesh(const Members& members, Collider& collider);
bool check_wind(const Members& members, Wind& wind);
bool check_placement(const Members& members, Placement& placement);
bool check_pin(const Members& members, Pin& pin);
bool check_load(const Members& members, Load& load);
/// Takes the map of a load of a cloth whose grid is known.
bool take_load_map(const SceneNode& load, const Cloth& cloth, Load& to);
/// Checks a cloth, and finds the particles of its pins' and loads' edges and corners.
bool check_cloth(const Members& members, Cloth& cloth);
bool check_tear(const Members& members, Tear& tear);
/// Checks that a cloth that tears has springs that bear something.
bool check_torn_cloth(const Members& members, const Cloth& cloth);
/// Checks that what changes the stiffness goes with the rest of a cloth.
bool check_stiffness_keys(const Members& members, const Cloth& cloth);
/// Checks that no cloth tears by the error that the solver may make: one whose limit is below the stretch error is an
/// error of the scene, one whose limit is below that of a single spring a warning.
void check_tear_limits(const SceneNode& cloths, const SceneDescription& scene);
/// Checks that there is room for the distances to all meshes.
bool check_fields(const SceneNode& colliders, const SceneDescription& scene);
/// Gives a rigidity that does not say how it twists the root of those along warp and weft.
bool set_twist(const Members& members, Rigidity& rigidity);
/// Checks a scene, and names the nameless cloths.
bool check_scene(const Members& members, SceneDescription& scene);
/// Checks that the cloths can be sewn as the scene wants, and finds out what its points are from.
bool check_seams(const SceneNode& cloths, const SceneNode& seams, SceneDescription& scene);
/// Checks that gas is closed in.
bool check_gas(const SceneNode& gas, const SceneDescription& scene);
/// Warns of what a scene may have, but hardly means.
void warn_of_doubts(const Members& members, const SceneDescription& scene);
/// They are what a pin, hand, collider or body is told: three in m, N and so on, then three in degrees, N m and so on,
/// which are 0 where only three are given.
Value<SixNumbers> three_or_six_numbers();
/// The particles that a hand holds: first column and row, last column and row.
using Grasp = std::array<std::int32_t, 4>;
Value<Grasp> grasp();
Value<std::vector<bool>> flags();
Value<EnsembleControls> controls();
inline constexpr std::string_view hand_list = "an array of at most 1024 names of cloths";
inline constexpr std::size_t most_hands = 1024;
/// Reads the hands' cloths, which `check_actions` finds.
bool read_hands(const SceneNode& node, SceneActions& actions);
/// Checks that frames increase.
bool check_steps(const Members& members, SceneActions& actions);
/// Checks what the scene is told against its cloths and colliders.
bool check_actions(const Members& members, SceneDescription& scene);
/// Whether a scene tells forces, the worst of them, and what springs and particles bear.
ValueText how_much_of_forces();
bool read_forces(const SceneNode& node, SceneDescription& scene);
bool check_cutter_times(const SceneNode& node, Cutter& cutter);
bool check_solver(const Members& members, SolverSettings& solver);
bool check_camera(const Members& members, Camera& camera);
bool check_camera_key(const Members& members, CameraKey& key);
/// Reads the texture.
bool check_appearance(const Members& members, Appearance& appearance);
/// Checks that a hem fits the cloth.
bool check_hem(const Members& members, const Cloth& cloth);
/// Reads the limits of an oracle's check: all of them, and no others.
bool read_oracle_limits(const Members& members, Oracle& oracle);
/// Checks oracles against the whole scene: naming a missing cloth is an error, what makes a check empty a warning.
void check_oracles(const SceneNode& oracles, const SceneDescription& scene);

}  // namespace drape
