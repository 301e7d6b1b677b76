#include "scene/scene_guesses.h"

#include <algorithm>
#include <iterator>

#include "drape/scene.h"

namespace drape {
namespace {

struct Guess {
    std::string_view objects;  ///< names of objects, each between spaces
    std::string_view keys;     ///< keys in lower case, each between spaces
    std::string_view meant;
};

/// Returns whether the list has the word between spaces.
constexpr bool lists(std::string_view list, std::string_view word) {
    for (std::size_t at = list.find(word); at != std::string_view::npos; at = list.find(word, at + 1))
        if (list[at - 1] == ' ' && list[at + word.size()] == ' ') return true;
    return false;
}

constexpr std::string_view solids = " plane sphere box ellipsoid capsule ", without_guesses = " mesh ";
static_assert(std::ranges::all_of(collider_names,
                                  [](auto name) { return lists(solids, name) || lists(without_guesses, name); }));

// The first row that fits counts.
constexpr Guess guesses[] = {
    {" box ", " size extents extent dimensions scale width height depth edges ",
     "\"half_extents\" (half the edge lengths in metres, [x, y, z])"},
    {" sphere ", " size diameter ", "\"radius\" (metres)"},
    {" ellipsoid ", " size radius half_extents scale semi_axes ", "\"radii\" (half axes in metres, [x, y, z])"},
    {" capsule ", " center position height length p0 p1 start end ",
     "\"from\" and \"to\" (centres of both ends, metres)"},
    {" plane ", " position point origin center height y d distance ",
     "\"offset\" (metres from the origin along the normal)"},
    {solids, " position pos location translate translation origin ", "\"center\" (metres)"},
    {solids, " velocity speed linear_velocity angular_velocity motion animation keyframes keys moves ",
     "\"path\" (key frames: [{\"t\": 0}, {\"t\": 1, \"translate\": [0, -1, 0]}])"},
    {solids, " rotation orientation euler angles quaternion ", "\"rotate\" (degrees about x, y, z)"},
    {solids, " colour material appearance diffuse albedo ", "\"color\" (sRGB, 0 to 1)"},
    {solids, " mu friction_coefficient static_friction dynamic_friction ", "\"friction\" (Coulomb coefficient)"},
    {solids, " thickness margin collision_margin ", "the cloth's \"thickness\" (metres kept from colliders)"},
    {" cloth ", " resolution particles vertices dimensions segments subdivisions nodes ",
     "\"grid\" (particles: [columns, rows])"},
    {" cloth ", " width height length scale extent extents ", "\"size\" (metres: [along columns, along rows])"},
    {" cloth ", " position pos origin center rotation rotate transform translate ",
     "\"placement\" ({\"origin\": [x, y, z], \"u\": ..., \"v\": ...})"},
    {" cloth ", " mass density surface_density weight gsm ", "\"areal_density\" (kg/m^2)"},
    {" cloth ", " material preset cloth_type ", "\"fabric\" (\"cotton\" and others) or \"stiffness\""},
    {" cloth ",
     " stretch shear bend bending stretch_stiffness bend_stiffness bending_stiffness shear_stiffness springs ",
     "\"stiffness\" ({\"stretch\": ..., \"shear\": ..., \"bend\": ...})"},
    {" cloth ", " pinned fixed anchors attachments constraints handles pin_corners fixed_corners ",
     "\"pins\" ([{\"corner\": \"top_left\"}, ...])"},
    {" cloth ", " drag air_drag air_damping viscosity ", "\"damping\" (1/s), or \"drag\" of the scene's \"wind\""},
    {" cloth ", " margin collision_margin collision_distance ", "\"thickness\" (metres kept from colliders)"},
    {" cloth ", " color colour texture pattern ", "\"appearance\" ({\"front\": [r, g, b], ...})"},
    {" cloth ", " solver substeps iterations ", "the scene's \"solver\""},
    {" cloth ", " wind ", "the scene's \"wind\""},
    {" pin ", " index particle vertex ", "\"at\" ([column, row])"},
    {" pin ", " until end time release_time ", "\"release\" (seconds)"},
    {" pin ", " velocity motion keyframes animation move ",
     "\"path\" (key frames: [{\"t\": 0}, {\"t\": 1, \"translate\": [0, -1, 0]}])"},
    {" motion_key ", " time ", "\"t\" (seconds)"},
    {" motion_key ", " position pos translation location ", "\"translate\" (metres from where it starts)"},
    {" motion_key ", " rotation euler angles ", "\"rotate\" (degrees about x, y, z)"},
    {" stiffness ", " bending flexural ", "\"bend\" (N m)"},
    {" stiffness ", " stretching tension structural tensile youngs_modulus ", "\"stretch\" (N/m)"},
    {" stiffness ", " shearing diagonal ", "\"shear\" (N/m)"},
    {" time ", " duration seconds length end t_end end_time ", "\"frames\" (seconds times fps, plus one)"},
    {" time ", " dt timestep time_step step delta_t ",
     "\"fps\" (frames a second); steps within a frame are solver.substeps"},
    {" solver ", " dt timestep time_step steps sub_steps ", "\"substeps\" (per frame; time.fps sets the frames)"},
    {" solver ", " type name algorithm integrator ", "\"method\""},
    {" wind ", " speed direction strength force vector ", "\"velocity\" (m/s, [x, y, z])"},
    {" wind ", " turbulence noise variation ", "\"gust\" ({\"amplitude\": m/s, \"period\": s, \"seed\": n})"},
    {" appearance ", " gloss shininess specular smoothness ", "\"roughness\" (1 is without a highlight)"},
    {" appearance ", " image map picture albedo file ", "\"texture\" (a PNG file)"},
    {" appearance ", " color colour base_color ", "\"front\" (sRGB, [r, g, b])"},
    {" camera ", " path animation keyframes motion ",
     "\"keys\" ([{\"t\": s, \"position\": ..., \"target\": ...}, ...])"},
    {" camera ", " eye from origin location pos ", "\"position\" (metres)"},
    {" camera ", " look_at lookat to center at direction ", "\"target\" (metres: the point in the middle)"},
    {" camera ", " fovy angle field_of_view focal_length ", "\"fov\" (vertical, degrees)"},
    {" image ", " resolution width height ", "\"size\" (pixels: [width, height])"},
    {" image ", " transparent transparency ", "\"alpha\" (true or false)"},
    {" image ", " msaa antialiasing aa spp ", "\"samples\" (1 or 4)"},
    {" light ", " dir position ", "\"direction\" (the way the light travels)"},
    {" scene ", " cloth sheet fabric ", "\"cloths\" (an array)"},
    {" scene ", " obstacles objects bodies spheres boxes planes ground floor ",
     "\"colliders\" ({\"planes\": [...], \"spheres\": [...], ...})"},
    {" scene ", " fps frames duration dt ", "\"time\" ({\"fps\": 60, \"frames\": 121})"},
    {" scene ", " up_axis z_up world_up axis ", "\"up\" (\"y\" or \"z\")"},
    {" scene ", " gravity_path gravity_keyframes ", "\"gravity_keys\" ([{\"t\": s, \"gravity\": [x, y, z]}, ...])"},
    {" wind ", " path keyframes velocity_keys ", "\"keys\" ([{\"t\": s, \"velocity\": [x, y, z]}, ...])"},
    {" scene ", " g ", "\"gravity\" (m/s^2, [x, y, z])"},
    {" scene ", " light sun ", "\"lights\" (an array)"},
    {" scene ", " knife blade cuts cut ", "\"cutters\" (an array)"},
};

}  // namespace

std::string_view guessed_key(std::string_view object, std::string_view key) {
    if (key.empty() || key.find(' ') != std::string_view::npos) return {};
    const auto* found = std::ranges::find_if(
        guesses, [&](const Guess& guess) { return lists(guess.objects, object) && lists(guess.keys, key); });
    return found == std::end(guesses) ? std::string_view() : found->meant;
}

}  // namespace drape
