#include "cloth/sewing.h"

#include <algorithm>
#include <functional>
#include <map>

#include "base/vectors.h"
#include "cloth/grid.h"
#include "world/seams.h"
#include "world/start.h"

namespace drape {

namespace {

/// The grids and masses of the cloths that are sewn, made when they are first asked for.
class Masses {
  public:
    explicit Masses(const SceneDescription& scene) : scene_(scene) {}
    /// Returns a particle's own mass, kg.
    double of(const SewnMember& member) {
        const Cloth& cloth = scene_.cloths[member.cloth];
        const Grid& grid = grids_.try_emplace(member.cloth, cloth).first->second;
        return inner(member.cloth) /
               double{grid.relative_inverse_mass(member.particle % grid.columns(), member.particle / grid.columns())};
    }
    double inner(std::size_t index) const {
        const Cloth& cloth = scene_.cloths[index];
        const auto [dx, dy] = grid_spacing(cloth);
        return cloth.areal_density * dx * dy;
    }

  private:
    const SceneDescription& scene_;
    std::map<std::size_t, Grid> grids_;
};

/// Returns the member whose motion is the place's: one that a pin holds, best one that moves it or lets it go, else the
/// leader.
std::size_t leading(const SceneDescription& scene, const SewnGroup& place) {
    std::size_t leads = 0;
    int best = 0;
    for (std::size_t k = 0; k < place.size(); ++k) {
        const auto pin = holding_pin(scene, place[k]);
        if (!pin) continue;
        const Pin& held = scene.cloths[place[k].cloth].pins[*pin];
        const int rank = held.release || !held.path.keys.empty() ? 2 : 1;
        if (rank > best) best = rank, leads = k;
    }
    return leads;
}

/// Whose particles are asked for, and how the method moves them.
struct Asked {
    std::size_t cloth, place;
    bool solves;
};

/// Adds a cloth's particles at a place.
void add_place(const SceneDescription& scene, const SewnGroup& group, const Asked& asked, Masses& masses,
               std::vector<Sewn>& all) {
    double total = 0, of_own = 0;
    Vec3 momentum{};
    for (const SewnMember& member : group) {
        const double mass = masses.of(member);
        total += mass;
        if (member.cloth == asked.cloth) of_own += mass;
        momentum = plus(momentum, times(mass, start_velocity(scene.cloths[member.cloth], member.particle)));
    }
    const bool held =
        std::ranges::any_of(group, [&](const SewnMember& member) { return holding_pin(scene, member).has_value(); });
    const std::size_t leads = leading(scene, group);
    const auto count = static_cast<int>(std::ranges::count(group, asked.cloth, &SewnMember::cloth));
    const std::uint32_t columns = scene.cloths[asked.cloth].grid[0];
    double counted = 0, own_counted = 0;
    for (std::size_t k = 0; k < group.size(); ++k) {
        const double mass = masses.of(group[k]);
        counted += mass;
        if (group[k].cloth != asked.cloth) continue;
        const bool is_first = own_counted == 0;
        own_counted += mass;
        const double share = asked.solves || held ? (k == leads ? 1 : 0) : mass / counted;
        const double carried = asked.solves ? total * mass / of_own : mass;
        glsl::SewnParticle sewn{};
        sewn.at = {static_cast<int>(group[k].particle % columns), static_cast<int>(group[k].particle / columns),
                   static_cast<int>(asked.place), is_first ? count : 0};
        sewn.weights = {static_cast<float>(share), static_cast<float>(masses.inner(asked.cloth) / carried),
                        k == 0 ? 1.0f : 0.0f, 0};
        sewn.parts = {static_cast<float>(mass / own_counted), static_cast<float>(mass / of_own), 0, 0};
        all.push_back(
            {group[k].particle, sewn, sewn_start(scene, group), times(1 / total, momentum), held, carried / total});
    }
}

}  // namespace

std::vector<Sewn> sewn_particles(const SceneDescription& scene, const Cloth& cloth) {
    const Cloth* const first = scene.cloths.data();
    if (scene.seams.empty() || std::less<>()(&cloth, first) || !std::less<>()(&cloth, first + scene.cloths.size()))
        return {};
    const auto own = static_cast<std::size_t>(&cloth - first);
    const bool solves = named(scene.solver.method).iterates();
    Masses masses(scene);
    std::vector<Sewn> all;
    const std::vector<SewnGroup> places = sewn_groups(scene);
    for (std::size_t at = 0; at < places.size(); ++at) {
        const SewnGroup& place = places[at];
        if (std::ranges::find(place, own, &SewnMember::cloth) == place.end()) continue;
        add_place(scene, place, {own, at, solves}, masses, all);
    }
    return all;
}

}  // namespace drape
