// These rows are the scene format. A new key is its field in drape/scene.h and its row here.
#include <fmt/format.h>

#include <algorithm>

#include "scene/action_rows.h"
#include "scene/collider_rows.h"
#include "scene/gas_rows.h"
#include "scene/look_rows.h"
#include "scene/outline_rows.h"
#include "scene/particle_rows.h"
#include "scene/scene_rules.h"
#include "world/frame_limit.h"

namespace drape {
namespace {

using namespace rows;

constexpr std::string_view cloth_count = "an array of 1 to 1024 cloths";

const Object<TimeSettings> time_settings{
    "time",
    "Frame n shows time n / fps.",
    {
        {"fps", &TimeSettings::fps, number({0.0, 10000.0, true}), "Frames per second."},
        {"frames", &TimeSettings::frame_count, integer(1, scene_frame_limit),
         "Number of frames, 0 .. frames-1; frame 0 is the initial state. The default is two seconds at 60 a second."},
    }};

const Object<Gust> gust{
    "gust",
    "Extra speed along the unit wind velocity at time t: g(t) = amplitude * (sin(2 pi t / period + p1) + 0.5 sin(2 pi "
    "2.3 t / period + p2) + 0.25 sin(2 pi 5.1 t / period + p3)) / 1.75. The phase p_k (k = 1, 2, 3) is 2 pi / 2^53 "
    "times the top 53 bits of splitmix64(seed + k), where splitmix64(x) is, modulo 2^64: x = x + 0x9e3779b97f4a7c15; x "
    "= (x xor (x >> 30)) * 0xbf58476d1ce4e5b9; x = (x xor (x >> 27)) * 0x94d049bb133111eb; x xor (x >> 31). Has no "
    "effect while the velocity is zero.",
    {
        {"amplitude", &Gust::amplitude, number(not_negative), "m/s; |g| never exceeds it."},
        {"period", &Gust::period, number(positive), "Seconds, of the slowest sine."},
        {"seed", &Gust::seed, integer(0, 0xFFFFFFFFu), "Picks the phases."},
    }};

const Object<VectorKey> wind_key{"wind_key",
                                 "One key of a wind that changes.",
                                 {
                                     {"t", &VectorKey::time, number(any_number), key_time_help, key_time_text},
                                     {"velocity", &VectorKey::value, vec3, "m/s.", "a velocity of 3 numbers"},
                                 }};

const Object<VectorKey> gravity_key{"gravity_key",
                                    "One key of gravity that changes.",
                                    {
                                        {"t", &VectorKey::time, number(any_number), key_time_help, key_time_text},
                                        {"gravity", &VectorKey::value, vec3, "m/s^2.", "a gravity of 3 numbers"},
                                    }};

const Object<FactorKey> stiffness_key{"stiffness_key",
                                      "One key of a stiffness that changes.",
                                      {
                                          {"t", &FactorKey::time, number(any_number), key_time_help, key_time_text},
                                          {"factor", &FactorKey::factor, number({0.001, 1.0, false}),
                                           "Share of the cloth's stiffness.", "a factor from 0.001 to 1"},
                                      }};

const Object<Wind> wind{
    "wind",
    "Aerodynamic force on a particle from each quarter of a cell that is its, of area A, with relative wind v and unit "
    "normal n turned so that n.v > 0: F = 1/2 air_density A [(drag - lift) (v.n) v + lift |v|^2 n]. Edges to the "
    "particle's neighbours span the quarter. A counts to twice its value at rest. Where no wind ever blows there is no "
    "air, which costs nothing; a velocity of 1e-9 makes still air, which slows cloth down.",
    {
        {"velocity", &Wind::velocity, vec3, "m/s, steady wind. Ignored (with a warning) beside keys."},
        {"keys", &Wind::keys, keys_in_time<VectorKey>(wind_key),
         "Wind that changes: from key to key by a straight line, component by component; before "
         "the first and after the last key, that key holds. A substep has the wind at its middle."},
        {"gust", &Wind::gust, gust, "Extra wind along the velocity's direction, as a function of time."},
        {"air_density", &Wind::air_density, number(not_negative), "kg/m^3."},
        {"drag", &Wind::drag, number(not_negative), "Drag coefficient Cd."},
        {"lift", &Wind::lift, number(not_negative), "Lift coefficient Cl."},
    },
    check_wind};

const Object<Placement> placement{
    "placement",
    "Where the flat cloth starts.",
    {
        {"origin", &Placement::origin, vec3, "Metres: particle (column 0, row 0)."},
        {"u", &Placement::u, direction, "Direction of growing column."},
        {"v", &Placement::v, turned(direction),
         "Direction of growing row; at right angles to u within 1e-6. Where z is up, the default is [0, 0, -1]."},
        {"scale", &Placement::scale, two_numbers(any_number),
         "Distances at the start over those at rest, along u and v: above 1 the cloth starts stretched, below "
         "compressed, below 0 turned over; 0 gathers it on a line, [0, 0] on a point. What starts on a line or a point "
         "gets, with a warning, a jitter that single precision just resolves: nothing else would part it."},
        {"jitter", &Placement::jitter, number(not_negative),
         "Metres: every particle that no pin holds starts up to so far from its place along x, y and z. Particle p = "
         "row * columns + column along axis k (0, 1, 2) by jitter * (2 r - 1), r being the top 53 bits of "
         "splitmix64(splitmix64(seed) + 3 p + k) over 2^53 (splitmix64: see gust). Where that would have a cloth that "
         "meets itself start through itself, the particles of triangles that cross start, with a warning, half as far "
         "from their places, and so on until none cross."},
        {"seed", &Placement::seed, integer(0, 0xFFFFFFFFu), "Picks the jitter."},
    },
    check_placement};

const Object<WarpWeft> warp_weft{
    "warp_weft",
    "Warp and weft apart. Where one is missing, that of the fabric or of the default holds.",
    {
        {"warp", &WarpWeft::warp, without_default(number(not_negative)), "N/m along u, the rows; 0 = none."},
        {"weft", &WarpWeft::weft, without_default(number(not_negative)), "N/m along v, the columns; 0 = none."},
    }};

const Object<Rigidity> rigidity{
    "rigidity",
    "Warp, weft and twist apart; where warp or weft is missing, that of the fabric or of the default holds. A strip "
    "cut at the angle a to the warp bends with the rigidity warp cos^4 a + weft sin^4 a + 2 twist sin^2 a cos^2 a.",
    {
        {"warp", &Rigidity::warp, without_default(number(not_negative)), "N m along u, the rows."},
        {"weft", &Rigidity::weft, without_default(number(not_negative)), "N m along v, the columns."},
        {"twist", &Rigidity::twist, without_default(number(not_negative)),
         "N m. Of a strip B45 that is cut at 45 degrees: 2 B45 - (warp + weft) / 2. Absent: the root of warp times "
         "weft."},
    },
    set_twist};

const Object<Stiffness> stiffness{
    "stiffness",
    "With cells dx by dy, a spring along a row has the constant stretch.warp dy/dx, along a column stretch.weft dx/dy, "
    "each diagonal shear (dx^2 + dy^2) / (2 dx dy). Consequences for square cells: the modulus along the warp is warp "
    "+ weft shear / (weft + shear), along the weft likewise; wave speed sqrt(stretch / areal_density) apart from "
    "shear.",
    {
        {"stretch", &Stiffness::stretch, number_or<WarpWeft>(warp_weft),
         "N/m; 0 = none. A number is that of warp and weft."},
        {"shear", &Stiffness::shear, number(not_negative), "N/m; 0 = none."},
        {"bend", &Stiffness::bend, number_or<Rigidity>(rigidity),
         "N m, bending rigidity B; a number is the same in every direction: a strip hangs like the elastica of that "
         "rigidity per width, and a sheet bends and twists like the plate of Poisson's ratio 0. Fabrics: 1e-6 to 1e-3. "
         "0: none."},
        {"compression", &Stiffness::compression, number({1e-3, 1.0, false}),
         "Share of stretch and shear that acts where springs are pushed together. 1: cloth gives way by the folds that "
         "the grid resolves. Less: by finer ones too, as fabrics buckle long before their threads give way (Choi and "
         "Ko "
         "2002); 0.02 to 0.2 lets a coarse grid collapse. Sheared cloth, whose diagonals one way are pushed together, "
         "keeps (1 + compression)/2 of its shear stiffness."},
    }};

const Object<SelfCollision> self_collision{
    "self_collision",
    "Contact of a cloth with itself, and with the scene's other cloths.",
    {
        {"thickness", &SelfCollision::thickness, optional(number(positive)),
         "Metres kept between layers: 0.1 to 1 times the grid's smaller spacing. Absent: the cloth's thickness, within "
         "these. Two cloths keep the mean of theirs."},
        {"friction", &SelfCollision::friction, optional(number(not_negative)),
         "Coulomb coefficient between layers. Absent: the cloth's. Two cloths have the geometric mean."},
    }};

const Object<MapFiles> maps{
    "maps",
    "Pictures by which the cloth's cells and particles differ: grey .png of up to 16 bits, or .npy [rows, columns] of "
    "uint8, uint16 "
    "or bool, or of float32 or float64 from 0 to 1. The first row is row 0. A map with a pixel for each cell ((columns "
    "- 1) x (rows - 1)) has their values; any other is sampled at their middles, bilinearly. Maps of friction and "
    "thickness are of particles: one with a pixel for each has their values, any other spans the cloth. Names are as "
    "of start.",
    {
        {"holes", &MapFiles::holes, without_default(text()), "File. Cells are missing where it is below one half."},
        {"stiffness", &MapFiles::stiffness, without_default(text()),
         "File. It scales stretch, shear and bend of each cell; a spring between two cells has half of each."},
        {"stiffness_range", &MapFiles::stiffness_range, two_numbers(map_factor),
         "Factors where the stiffness map is 0 and where it is 1; between, in proportion."},
        {"density", &MapFiles::density, without_default(text()), "File. It scales the areal density of each cell."},
        {"density_range", &MapFiles::density_range, two_numbers(map_factor),
         "Factors where the density map is 0 and where it is 1; between, in proportion."},
        {"tear", &MapFiles::tear, without_default(text()),
         "File. It scales the limit of tear; of a spring's two cells the weaker counts. A dark line is a seam that "
         "rips."},
        {"tear_range", &MapFiles::tear_range, two_numbers(map_factor),
         "Factors where the tear map is 0 and where it is 1; between, in proportion."},
        {"friction", &MapFiles::friction, without_default(text()),
         "File. It scales the friction of each particle, on colliders and between layers."},
        {"friction_range", &MapFiles::friction_range, two_numbers(map_friction_factor),
         "Factors where the friction map is 0 and where it is 1; between, in proportion."},
        {"thickness", &MapFiles::thickness, without_default(text()),
         "File. It scales the thickness of each particle, and of self_collision: there each keeps 0.1 to 1 times the "
         "grid's smaller spacing, and two layers the mean of theirs where they are nearest."},
        {"thickness_range", &MapFiles::thickness_range, two_numbers(map_factor),
         "Factors where the thickness map is 0 and where it is 1; between, in proportion."},
    }};

/// Reads the maps' names; the rule of the cloth, which knows the grid, reads the files.
bool read_maps(const SceneNode& node, Cloth&) {
    MapFiles ignored;
    return maps.read(node, ignored);
}

const Object<Tear> tear{
    "tear",
    "Threads end, those along rows and those along columns, once the end of a frame finds them stretched too far or "
    "pulled too hard; that acts from the next frame on. Exactly one of strain and tension says what they bear.",
    {
        {"strain", &Tear::strain, optional(number(positive)), "Change of a spring's length over its length at rest."},
        {"tension", &Tear::tension, optional(number(positive)),
         "N/m: what the springs of the model transmit through a line across the threads, diagonals too, over its "
         "length. It does not depend on the grid."},
    },
    check_tear,
    R"("oneOf": [{"required": ["strain"]}, {"required": ["tension"]}])"};

const Object<Cloth> cloth{
    "cloth",
    "A grid of particles, rectangular or cut by an outline. At most 16000000 particles in all cloths together. Single "
    "precision must resolve a quarter of an edge where the cloth starts, so a fine cloth must not be far from the "
    "origin.",
    {
        {"name", &Cloth::name, file_name(),
         "Unique in the scene; becomes a file name. Default: \"cloth\" for the first cloth, \"cloth2\" for the second, "
         "and so on."},
        {"grid", &Cloth::grid, two_integers(2, grid_axis_limit), "Particles: columns, rows."},
        {"size", &Cloth::size, two_numbers(positive),
         "Metres along the columns' direction u and the rows' direction v."},
        {"outline", Value<OutlineText>(outline).text, read_outline,
         "Instead of grid and size: the cloth is what a path goes around. Absent: a rectangle."},
        {"placement", &Cloth::placement, turned(placement), "Where the flat cloth starts."},
        {"start", text().text, read_text<Cloth>,
         "File that says where every particle starts, in metres, instead of placement: .npy ([rows, columns, 3] or "
         "[frames, rows, columns, 3], float32 or float64), .npz (its array positions, as drape writes it), .obj (a "
         "vertex for each particle, row by row) or .pc2, both with or without the particles that holes leave without a "
         "cell; of several frames the last. At rest the cloth is still flat and of its size, unless rest says "
         "otherwise. It starts without speed, or with velocity or velocities. A relative name is looked for beside the "
         "scene file; where a scene is none (a pipe, a text, a dict), in the working directory."},
        {"rest", &Cloth::rest, choice<Rest>(rest_spellings),
         "The shape in which the cloth is at rest. flat: the flat cloth of this size. start: that of the file start, "
         "its lengths and its curvature; springs are 1/4 to 4 times as long as the flat cloth's. Their constants, mass "
         "and rigidity are those of flat cloth either way."},
        {"fabric", fabric_text(), read_fabric, fabric_help()},  // stands before the keys that it sets
        {"areal_density", &Cloth::areal_density, number(positive),
         "kg/m^2. Each cell gives a quarter of its mass to each of its corners."},
        {"stiffness", &Cloth::stiffness, rigid_or(stiffness),
         "Spring constants, or \"rigid\": stretch and shear inextensible."},
        {"stiffness_keys", &Cloth::stiffness_keys, keys_in_time<FactorKey>(stiffness_key),
         "Stretch, shear and bend become so much of what stiffness says; between, before and after its keys as a wind "
         "does. A frame has the factor at its middle."},
        {"damping", &Cloth::damping, number(not_negative), "1/s: velocities decay as exp(-damping t)."},
        {"friction", &Cloth::friction, number(not_negative),
         "Coulomb coefficient of the cloth's side; a pair of surfaces uses the geometric mean."},
        {"thickness", &Cloth::thickness, number(not_negative), "Metres kept from colliders."},
        {"contact", &Cloth::contact, choice<ContactOf>(contact_spellings),
         "What stays outside colliders. surface: all that is drawn; particles then lie at sqrt(R^2 + 3 (dx^2 + "
         "dy^2) / 8) from the centre of a ball of radius R where the thickness asks for less, over other round shapes "
         "likewise, over meshes as over a ball of the radius of the largest one inside, over shells of half their "
         "thickness. particles: these alone; the cells between them dip in where the thickness does not hide it."},
        {"self_collision", &Cloth::self_collision, true_or(self_collision),
         "Whether the cloth meets itself. Once one of a scene's cloths does, all of them meet each other, those "
         "without it as with its defaults. No triangle then passes through one that it meets in any substep; the "
         "manifest says whether that was proved. Triangles that are split meet nothing. A cloth that meets "
         "itself may not start gathered on a line or in a point."},
        {"velocity", &Cloth::velocity, vec3, "m/s, of all particles at the start."},
        {"velocities", text().text, read_text<Cloth>,
         "File that says how fast every particle starts, in m/s, instead of velocity: .npy (shaped as that of start) "
         "or .npz (its array velocities, as drape writes it); of several frames the last. With start from the same "
         "archive a run goes on where another ended: all but what a method knows of the substeps before."},
        {"tear", &Cloth::tear, optional<Tear>(tear),
         "What the cloth bears before it tears. Absent: whatever pulls at it. A tear is a line: it goes on from where "
         "the cloth is torn or cut, and only in a piece where none goes on a new one begins."},
        {"maps", Value<MapFiles>(maps).text, read_maps,
         "Holes, stiffness, density, strength, friction and thickness from pictures. Absent: none."},
        {"holes", &Cloth::holes, list<IndexBox>(particles, "an array of boxes", 0, 1'000'000),
         "Boxes of particles whose inner cells are missing; particles left without a cell are fixed and not drawn."},
        {"pins", &Cloth::pins, list<Pin>(pin, "an array of pins", 0, 1'000'000),
         "What holds the cloth. Of several pins of a particle only the last one counts."},
        {"loads", &Cloth::loads, list<Load>(load, "an array of loads", 0, 1024),
         "What pulls at the cloth or presses on it. Several loads of a particle add up."},
        {"appearance", &Cloth::appearance, appearance, "For pictures only."},
    },
    check_cloth};

const Object<SeamSide> seam_side{
    "seam_side",
    "A border of a cloth's grid, or a piece of the rim of its outline, its holes or its grid.",
    {
        {"cloth", &SeamSide::cloth, text(), "Name of the cloth.", "the name of a cloth"},
        {"edge", &SeamSide::edge, optional(choice<SeamEdge>(seam_edge_spellings)),
         "All particles of a border: left is column 0, top is row 0. Either this or from and to."},
        {"from", &SeamSide::from, optional(two_numbers(any_number)),
         "Metres, on the flat cloth: where the piece of the rim begins, as points of the outline have it, or from the "
         "grid's corner. The nearest particle counts, which must be within half a cell."},
        {"to", &SeamSide::to, optional(two_numbers(any_number)), "Where it ends."},
        {"way", &SeamSide::way, choice<SeamWay>(seam_way_spellings), "The way round the rim from one to the other."},
    }};

const Object<Seam> seam{
    "seam",
    "Two sides that are one, of two cloths or of one, which then is a tube. Their particles start in pairs within a "
    "thousandth of a cell of each other, in the order of both sides or against one, unless they are closed later. Each "
    "pair is one particle with the mass of both; where a pin holds one of them, it holds both. Of sides with unlike "
    "numbers of particles the coarser one leads: the other's lie on the straight pieces between its particles, by "
    "length along each side, and start within a fiftieth of a cell of these. Several seams may meet at a place. Sewn "
    "cloth turns about a seam freely: it bends within its cloths only.",
    {
        {"a", &Seam::a, seam_side, "One side.", "a side of a seam"},
        {"b", &Seam::b, seam_side, "The other side.", "a side of a seam"},
        {"close", &Seam::close, number(not_negative),
         "Seconds from the start in which sides that start apart are drawn together, smoothly, about the centre of "
         "mass of what meets, or towards what a pin holds; 0: they start together."},
        {"rip", &Seam::rip, optional(number(positive)),
         "N/m: what a metre of the seam bears, on the flat cloth. Places whose load, averaged over a frame, is more "
         "come apart at its end, for good. Sides of as many particles, not closed later; without pins on it, and in a "
         "scene without colliders, self_collision and tethers. Absent: it bears anything."},
    }};

const Object<Cutter> cutter{
    "cutter",
    "A triangle that cuts every cloth it meets while it is active. A cut found at the end of a frame acts from the "
    "next frame on. Between two frames the surface of the prism that the triangle sweeps counts.",
    {
        {"triangle", &Cutter::triangle, triangle(vec3), "Three corners, metres; not on one line.", "three points"},
        {"active", two_numbers(not_negative).text, check_cutter_times, "First and last moment, seconds.",
         "[begin, end] in seconds"},
        {"path", &Cutter::path, path,
         "Rigid motion on top of the given triangle; absent: at rest; rotations are about the triangle's centroid."},
        {"crumbs", &Cutter::crumbs, boolean(),
         "Whether crumbs are drawn and exported: pieces cut off of less than four triangles of the grid. They are "
         "simulated and counted in the manifest either way. One cutter that asks for them shows those of all."},
    }};

constexpr auto method_spellings = [] {
    std::array<Spelling<SolverMethod>, solver_method_names.size()> spellings{};
    std::ranges::transform(solver_method_names, spellings.begin(), [](const SolverMethodName& row) {
        return Spelling<SolverMethod>{row.name, row.method};
    });
    return spellings;
}();
const std::string method_help = [] {
    std::string text;
    for (const SolverMethodName& row : solver_method_names)
        text += fmt::format("{}{}: {}", text.empty() ? "" : " ", row.name, row.help);
    return text;
}();

const Object<SolverSettings> solver{
    "solver",
    "How the cloth is moved from frame to frame.",
    {
        {"method", &SolverSettings::method, choice<SolverMethod>(method_spellings), method_help},
        {"substeps", &SolverSettings::substeps, integer(1, most_solver_substeps),
         "Time steps per frame. Ignored (with a warning) by method auto."},
        {"iterations", &SolverSettings::iterations, integer(1, 1024),
         "Solves of every spring per substep. Ignored (with a warning above 1) by methods that solve nothing."},
        {"collide", &SolverSettings::collide, choice<CollideWhen>(collide_spellings),
         "Collision after the springs of every iteration, or once per substep."},
        {"tolerance", &SolverSettings::tolerance, number(not_negative),
         "Largest stretch error: RMS over the stretch springs of strain - tension/(stiffness length), of springs "
         "pushed together compression times the strain, tension being "
         "the force that the solver applied. 0: no promise, by method auto 0.01. A substep's iterations end once it is "
         "met (so `iterations` "
         "is then the most that may be needed); a frame that misses it ends the run with exit code 8."},
        {"tolerance_worst", &SolverSettings::tolerance_worst, number(not_negative),
         "Method auto: largest stretch error of a single spring in a frame. 0: 0.1."},
        {"tolerance_motion", &SolverSettings::tolerance_motion, number(not_negative),
         "Method auto: largest error of the motion, RMS over the cloth in metres per second of simulated time, as "
         "estimated by running some frames with half the substeps too. 0: 0.02 of the cloth's longer side a second, "
         "and for cloth of less than a metre 0.02 m/s times the root of its "
         "side in metres."},
        {"estimate_error", &SolverSettings::estimate_error, optional(boolean()),
         "Whether the position error is estimated, by a companion run with a quarter of the substeps (explicit: half "
         "as many more): position_error_m in the manifest. Left out: method auto does, methods that "
         "are named do not. false with auto: limits are kept all the same, at less cost, but no error of positions is "
         "stated, and chaos is not told from error."},
        {"tethers", &SolverSettings::tethers, boolean(),
         "Whether every particle is kept within the cloth's reach of the nearest particle of each of the two nearest "
         "pins (long-range attachments), once per substep. It keeps cloth that hangs from few points in shape at few "
         "substeps, and biases its motion a little. A cloth's first cut ends its tethers."},
        {"strain_damping", &SolverSettings::strain_damping, number(unit_interval),
         "Explicit micro-steps: damping of the strain rate of springs that are stretched by more than a tenth, in "
         "units of their stiffness times the substep, and a twentieth of that of others, as in fabric, whose motion it "
         "hardly changes. Below 0.2 cloth that is tangled up may not calm down. Ignored (with a warning) by other "
         "methods."},
    },
    check_solver};

const Object<Oracle> oracle{
    "oracle",
    "A check the scene promises to meet: `drape verify` judges it, the simulation ignores it.",
    {
        {"check", &Oracle::check, check_name(), "Which check; its limits are the other keys.", "the name of a check"},
    },
    read_oracle_limits,
    "",
    R"("type": "number", "description": "A limit of the check.")"};

const Object<SceneDescription> scene{
    "scene",
    "A cloth scene. JSON with // comments; SI units, degrees. Unknown keys are errors. Numbers are at most "
    "3.4e38 in magnitude (single precision). At most 16 MiB, 500000 values and 1000 keys in an object. In a substep "
    "no "
    "cloth may fall by more than 10000 of its edge lengths: gravity / (fps substeps)^2 (method auto: of 4096 substeps) "
    "over the edge length.",
    {
        {"$schema", text().text, read_text<SceneDescription>, "Address of this schema, for editors. Ignored."},
        {"name", &SceneDescription::name, text(), "Name of the scene."},
        {"time", &SceneDescription::time, time_settings, "Frames and their rate."},
        {"up", &SceneDescription::up, choice<Up>(up_spellings),
         "The axis that points up. All coordinates of the scene, and all that come out of it, are those of its world. "
         "Defaults that have a direction turn with it about x: what is y becomes z, what is z becomes -y."},
        {"gravity", &SceneDescription::gravity, turned(vec3),
         "m/s^2. Where z is up, the default is [0, 0, -9.81]. Ignored (with a warning) beside gravity_keys."},
        {"gravity_keys", &SceneDescription::gravity_keys, keys_in_time<VectorKey>(gravity_key),
         "Gravity that changes; between, before and after its keys as a wind does."},
        {"wind", &SceneDescription::wind, wind, "Wind; none by default."},
        {"cloths", &SceneDescription::cloths, list<Cloth>(cloth, cloth_count, 1, 1024),
         "The cloths. Where one has self_collision they meet each other; else they pass through each other and "
         "themselves.",
         cloth_count},
        {"seams", &SceneDescription::seams, list<Seam>(seam, "an array of at most 4096 seams", 0, 4096),
         "What sews the cloths together. Beside bodies with a mass, and beside colliders where forces are told, only "
         "by "
         "line or relax, with sides of as many particles each, and without self_collision, beside which no forces are "
         "told of sewn cloths."},
        {"gas", &SceneDescription::gas, list<Gas>(gas, "an array of at most 1024 gases", 0, 1024),
         "What cloths that are sewn to closed surfaces close in."},
        {"colliders", &SceneDescription::colliders, colliders, "Solid bodies."},
        {"overlap", &SceneDescription::overlap, choice<Overlap>(overlap_spellings),
         "Cloth that starts inside a collider, or through another cloth that it would meet, which is warned of: "
         "`resolve` moves it out of the collider by contact, at no more than 0.1 m/s, and leads the two cloths apart, "
         "at 1 m/s, which meet from then on; `refuse` makes it an error of the scene."},
        {"cutters", &SceneDescription::cutters, list<Cutter>(cutter, "an array of at most 1024 cutters", 0, 1024),
         "Triangles that cut the cloth."},
        {"solver", &SceneDescription::solver, solver, "How the cloth is moved."},
        {"forces", how_much_of_forces(), read_forces,
         "Whether the numbers of each frame tell the forces on each cloth: at each of its pins, of each collider, of "
         "gravity, air, damping and other cloths. \"worst\": also the largest force of a substep, of colliders, other "
         "cloths, air and loads. \"fields\": all this and, beside exported positions, what each spring bears and what "
         "contact does to each particle. Absent: false."},
        {"actions", &SceneDescription::actions, optional<SceneActions>(actions),
         "What it is told on the way: what an ensemble was told. Absent: nothing."},
        {"camera", &SceneDescription::camera, optional<Camera>(camera),
         "The camera. Absent: one that holds the cloths where they start, hang and land, and the colliders."},
        {"lights", &SceneDescription::lights,
         turned(list<DirectionalLight>(light, "an array of at most 4 lights", 0, 4)),
         "Directional lights; the first casts shadows. Absent: a warm key from the left and a cool fill from the "
         "right."},
        {"ambient", &SceneDescription::ambient, color,
         "Linear radiance factor of the sky's light, which comes from above all around."},
        {"ambient_ground", &SceneDescription::ambient_ground, color,
         "Linear radiance factor of the ground's light, from below; surfaces between get a part of both."},
        {"image", &SceneDescription::image, image, "The pictures."},
        {"oracles", &SceneDescription::oracles, list<Oracle>(oracle, "an array of checks", 0, 1024),
         "Checks the scene promises to meet, for drape verify."},
    },
    check_scene};

}  // namespace

bool read_scene_object(const SceneNode& root, SceneDescription& description) { return scene.read(root, description); }

std::vector<const Definition*> scene_definitions() {
    std::vector<const Definition*> found{&scene.definition()};
    for (std::size_t i = 0; i < found.size(); ++i)
        for (const Definition* used : found[i]->uses)
            if (std::ranges::find(found, used) == found.end()) found.push_back(used);
    return found;
}

}  // namespace drape
