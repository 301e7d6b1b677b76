#include "scene/oracle_kinds.h"

#include <algorithm>
#include <iterator>
#include <map>

#include "world/weather.h"

namespace drape {
namespace {

std::string_view nothing(const SceneDescription&) { return {}; }

template <class Wanted>
bool some_pin(const SceneDescription& scene, const Wanted& wanted) {
    return std::ranges::any_of(scene.cloths,
                               [&](const Cloth& cloth) { return std::ranges::any_of(cloth.pins, wanted); });
}

std::string_view no_still_pin(const SceneDescription& scene) {
    const bool is_there = some_pin(scene, [](const Pin& pin) { return !pin.release && pin.path.keys.empty(); });
    return is_there ? "" : "no pin stays where it is";
}

std::string_view no_moved_pin(const SceneDescription& scene) {
    return some_pin(scene, [](const Pin& pin) { return pin.path.moves(); }) ? "" : "no pin has a path";
}

std::string_view no_pin(const SceneDescription& scene) {
    return scene.cloths.empty() || scene.cloths[0].pins.empty() ? "the first cloth has no pin" : "";
}

std::string_view no_steady_gravity(const SceneDescription& scene) {
    return gravity_changes(scene) ? "gravity changes" : "";
}

std::string_view no_release(const SceneDescription& scene) {
    if (gravity_changes(scene)) return no_steady_gravity(scene);
    return some_pin(scene, [](const Pin& pin) { return pin.release.has_value(); }) ? "" : "no pin is released";
}

std::string_view no_cut(const SceneDescription& scene) {
    return scene.comes_apart() ? "" : "nothing of the scene is cut or torn";
}

std::string_view no_collider(const SceneDescription& scene) {
    return scene.colliders.empty() ? "the scene has no collider" : "";
}

std::string_view no_sphere(const SceneDescription& scene) {
    const auto is_sphere = [](const Collider& collider) { return std::holds_alternative<Sphere>(collider.shape); };
    return std::ranges::any_of(scene.colliders, is_sphere) ? "" : "the scene has no sphere";
}

std::string_view no_body(const SceneDescription& scene) {
    const auto has_mass = [](const Collider& collider) { return collider.mass.has_value(); };
    return std::ranges::any_of(scene.colliders, has_mass) ? "" : "no collider has a mass";
}

std::string_view no_ball(const SceneDescription& scene) {
    const auto is_ball = [](const Collider& each) { return each.mass && std::holds_alternative<Sphere>(each.shape); };
    return std::ranges::any_of(scene.colliders, is_ball) ? "" : "no sphere has a mass";
}

std::string_view no_flying_body(const SceneDescription& scene) {
    return gravity_changes(scene) ? no_steady_gravity(scene) : no_body(scene);
}

std::string_view no_wind(const SceneDescription& scene) { return scene.wind.blows() ? "" : "no wind blows"; }

std::string_view no_steady_wind(const SceneDescription& scene) {
    return scene.wind.keys.empty() ? no_wind(scene) : "the wind changes";
}

std::string_view no_relaxation(const SceneDescription& scene) {
    if (gravity_changes(scene)) return no_steady_gravity(scene);
    return scene.solver.method == SolverMethod::relax ? "" : "the law is that of method relax";
}

std::string_view no_forces(const SceneDescription& scene) {
    const auto presses = [](const Cloth& cloth) { return std::ranges::any_of(cloth.loads, &Load::presses); };
    if (!scene.forces) return "the scene does not ask for forces";
    return std::ranges::any_of(scene.cloths, presses) ? "a load presses" : "";
}

KeyText key(std::string_view name, std::string_view help) { return {name, help, {}, {}, {}, false}; }

constexpr OracleLimit which_cloth{"cloth", "number of the cloth, from 0", true};
constexpr OracleLimit which_body{"body", "number of the collider among those with a mass, from 0", true};
constexpr OracleLimit from_frame{"from_frame", "first frame that counts", true};
constexpr OracleLimit until_frame{"until_frame", "last frame that counts", true};

/// These checks judge how the cloth lies and is held.
std::vector<OracleKind> kinds_of_shape() {
    return {
        {"stretch",
         "In every frame the RMS strain of the row and column springs of each cloth is small.",
         {{"strain", "largest RMS strain"}},
         nothing},
        {"penetration",
         "No particle is deep in a collider and the cloth's thickness on it, and something touches.",
         {{"depth", "largest depth, in units of the collider's radius or least half extent, of a plane in metres"}},
         no_collider},
        {"uncrossed",
         "In no frame does a triangle cross another one of its cloth or of another; where some cloths have "
         "self_collision, those that have not may cross themselves. Triangles that are split do not count.",
         {},
         nothing},
        {"supported",
         "In the last frame the top of the cloth lies at a height.",
         {which_cloth,
          {"height", "metres"},
          {"above", "how much higher it may be, metres"},
          {"below", "how much lower it may be, metres"}},
         nothing},
        {"borne",
         "In the last frame pins and colliders bear the weight of each cloth and the forces of its loads.",
         {{"relative_error", "largest error, in units of what is borne"}},
         no_forces},
        {"pins_hold", "Pins without path and release never move by a bit.", {}, no_still_pin},
        {"pins_follow",
         "Pins with a path are where it takes them in every frame.",
         {{"error", "largest distance, metres"}},
         no_moved_pin},
        {"released",
         "Pins with a release hold to the bit until then, and fall after.",
         {{"seconds", "when after the release the fall is measured"},
          {"least", "smallest fall, in units of free fall"},
          {"most", "largest"}},
         no_release},
        {"drawn",
         "In the last frame the first cloth hangs below its pins, drawn together as they are.",
         {{"offset", "largest distance of its centre of mass from the pins' centre along x, metres"},
          {"width", "largest width of its hem along x, in units of the pins'"}},
         no_pin},
    };
}

/// These checks judge how the cloth moves, and what cuts and methods do to it.
std::vector<OracleKind> kinds_of_motion() {
    return {
        {"falls",
         "Until something holds or touches them, particles fly as gravity and damping make them.",
         {which_cloth,
          {"from_row", "first row of the particles", true},
          until_frame,
          {"error", "largest distance from the closed form, metres"}},
         no_steady_gravity},
        {"body_flies",
         "Until something touches it, a body flies as gravity makes it.",
         {which_body, until_frame, {"error", "largest distance of its centre of mass from the parabola, metres"}},
         no_flying_body},
        {"rebounds",
         "A body that falls is thrown up again.",
         {which_body,
          {"least", "smallest height to which it then rises from its lowest point, in units of what it had fallen"},
          {"most", "largest"}},
         no_body},
        {"bodies_apart",
         "Balls with a mass are inside no collider and no other body.",
         {{"depth", "largest depth, metres"}},
         no_ball},
        {"swing",
         "What gravity gives and damping leaves is there as motion at the fastest moment; without wind and contact.",
         {which_cloth,
          from_frame,
          until_frame,
          {"least", "smallest share of the work that is kinetic energy"},
          {"most", "largest"}},
         no_steady_gravity},
        {"torque",
         "The first cloth, pinned along a vertical pole through its first particle, turns about it as the wind alone "
         "makes it.",
         {from_frame, until_frame, {"relative_error", "largest error, in units of the impulse at stake"}},
         no_wind},
        {"blown",
         "The first cloth streams along the wind from its first particle, and flutters.",
         {from_frame,
          {"degrees", "largest angle of its mean direction with the wind"},
          {"flutter", "smallest standard deviation of the free edge's middle, sideways, metres"}},
         no_steady_wind},
        {"mirror",
         "What is mirrored in the plane x = 0 stays so.",
         {until_frame, {"error", "largest RMS distance of a particle from its partner's image, metres"}},
         nothing},
        {"carried",
         "Cloth on top of the first sphere turns with it.",
         {{"radius", "of the cap of cloth, metres from the sphere's middle, seen from above"},
          {"lag", "largest difference of their turns, degrees"}},
         no_sphere},
        {"cut_pieces",
         "Something was cut or torn, and so many pieces are left.",
         {{"pieces", "of at least 1 % of the particles", true}},
         no_cut},
        {"mass_kept",
         "Cutting and tearing change neither mass nor area drawn.",
         {{"relative_error", "largest share that is lost or gained"}},
         no_cut},
        {"stretch_law",
         "A sheet that hangs still by method relax has the strain of the law of docs/physics.md, section 2.",
         {{"relative_error", "largest error of mean and RMS strain"}},
         no_relaxation},
    };
}

}  // namespace

const OracleLimit* OracleKind::find_limit(std::string_view limit) const {
    const auto found = std::ranges::find(limits, limit, &OracleLimit::name);
    return found == limits.end() ? nullptr : &*found;
}

std::span<const OracleKind> oracle_kinds() {
    static const std::vector<OracleKind> kinds = [] {
        std::vector<OracleKind> all = kinds_of_shape();
        std::ranges::move(kinds_of_motion(), std::back_inserter(all));
        return all;
    }();
    return kinds;
}

const OracleKind* find_oracle_kind(std::string_view name) {
    const auto found = std::ranges::find(oracle_kinds(), name, &OracleKind::name);
    return found == oracle_kinds().end() ? nullptr : &*found;
}

const Definition& oracle_definition(const OracleKind& kind) {
    static const std::map<std::string_view, Definition> definitions = [] {
        std::map<std::string_view, Definition> made;
        for (const OracleKind& each : oracle_kinds()) {
            Definition& definition = made[each.name];
            definition.name = each.name;
            definition.keys.push_back(key("check", each.name));
            for (const OracleLimit& limit : each.limits) definition.keys.push_back(key(limit.name, limit.help));
        }
        return made;
    }();
    return definitions.at(kind.name);
}

const Definition& oracle_names() {
    static const Definition names = [] {
        Definition all;
        for (const OracleKind& kind : oracle_kinds()) all.keys.push_back(key(kind.name, kind.help));
        return all;
    }();
    return names;
}

}  // namespace drape
