#include "world/seams.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/vectors.h"
#include "world/start.h"
#include "world/start_crossings.h"

namespace drape {

namespace {

/// Returns the particles of a border, by rising row or column.
std::vector<std::uint32_t> particles_of(const Cloth& cloth, SeamEdge edge) {
    const auto [columns, rows] = cloth.grid;
    const bool upright = edge == SeamEdge::left || edge == SeamEdge::right;
    std::vector<std::uint32_t> particles;
    for (std::uint32_t k = 0; k < (upright ? rows : columns); ++k) switch (edge) {
            case SeamEdge::left:
                particles.push_back(k * columns);
                break;
            case SeamEdge::right:
                particles.push_back(k * columns + columns - 1);
                break;
            case SeamEdge::top:
                particles.push_back(k);
                break;
            case SeamEdge::bottom:
                particles.push_back((rows - 1) * columns + k);
                break;
        }
    return particles;
}

Vec3 place_of(const SceneDescription& scene, const SewnMember& member) {
    const Cloth& cloth = scene.cloths[member.cloth];
    return start_place(cloth, member.particle % cloth.grid[0], member.particle / cloth.grid[0]);
}

/// The pairs of a seam.
struct Stitches {
    std::vector<std::array<SewnMember, 2>> pairs;
    double gap = 0;  ///< m: the largest between the two of a pair
    std::size_t widest = 0;
};

Stitches stitches_in(const SceneDescription& scene, const Seam& seam, bool reversed) {
    const std::size_t a = *cloth_called(scene, seam.a.cloth), b = *cloth_called(scene, seam.b.cloth);
    const std::vector<std::uint32_t> of_a = particles_of(scene.cloths[a], seam.a.edge);
    std::vector<std::uint32_t> of_b = particles_of(scene.cloths[b], seam.b.edge);
    if (reversed) std::ranges::reverse(of_b);
    Stitches made;
    for (std::size_t k = 0; k < of_a.size(); ++k) {
        made.pairs.push_back({SewnMember{a, of_a[k]}, SewnMember{b, of_b[k]}});
        const double gap = length(minus(place_of(scene, made.pairs[k][0]), place_of(scene, made.pairs[k][1])));
        if (gap > made.gap) made.gap = gap, made.widest = k;
    }
    return made;
}

Stitches stitches_of(const SceneDescription& scene, const Seam& seam) {
    Stitches straight = stitches_in(scene, seam, false), reversed = stitches_in(scene, seam, true);
    return reversed.gap < straight.gap ? reversed : straight;
}

/// Returns what is wrong with the names and counts of a seam's sides.
std::optional<SeamFault> fault_of_sides(const SceneDescription& scene, const Seam& seam) {
    for (const auto& [side, key] : {std::pair{&seam.a, "/a/cloth"}, std::pair{&seam.b, "/b/cloth"}})
        if (!cloth_called(scene, side->cloth))
            return SeamFault{key, fmt::format("expected the name of a cloth of the scene, got \"{}\"", side->cloth)};
    if (seam.a == seam.b) return SeamFault{"/b", "expected another edge than that of a, got the same"};
    const auto count = [&](const SeamSide& side) {
        return particles_of(scene.cloths[*cloth_called(scene, side.cloth)], side.edge).size();
    };
    if (count(seam.a) == count(seam.b)) return std::nullopt;
    return SeamFault{"",
                     fmt::format("expected edges of as many particles, got {} and {}", count(seam.a), count(seam.b))};
}

std::optional<SeamFault> fault_of(const SceneDescription& scene, const Seam& seam) {
    if (auto fault = fault_of_sides(scene, seam)) return fault;
    const Stitches made = stitches_of(scene, seam);
    const auto& [a, b] = made.pairs[made.widest];
    const Cloth &one = scene.cloths[a.cloth], &other = scene.cloths[b.cloth];
    const double most = seam_tolerance * std::min(least_spacing(one), least_spacing(other));
    if (made.gap <= most) return std::nullopt;
    return SeamFault{"", fmt::format("expected edges that start together, within {:.3g} m (a thousandth of a cell), "
                                     "got a gap of {:.3g} m at particle [{}, {}] of \"{}\"",
                                     most, made.gap, a.particle % one.grid[0], a.particle / one.grid[0], one.name)};
}

/// Returns what of a scene does not go with seams.
std::string excluded_by(const SceneDescription& scene) {
    if (cloths_meet(scene)) return "expected no seams where cloths have self_collision: contact does not know them yet";
    if (!scene.gravity_keys.empty())
        return "expected no seams beside gravity_keys: a sewn particle would weigh twice as much more";
    if (std::ranges::any_of(scene.colliders, [](const Collider& collider) { return collider.mass.has_value(); }))
        return "expected no seams beside a body with a mass: what a seam evens out, the body would not get back";
    if (scene.forces) return "expected no seams beside forces: what a seam transmits is not told yet";
    return {};
}

bool lets_go_or_moves(const Pin& pin) { return pin.release || !pin.path.keys.empty(); }

/// Returns a fault where a pin that moves or lets go is not the only one at a sewn place.
std::optional<SeamFault> fault_of_pins(const SceneDescription& scene) {
    for (const SewnGroup& place : sewn_groups(scene)) {
        std::size_t held = 0, changing = 0;
        for (const SewnMember& member : place)
            if (const auto pin = holding_pin(scene, member)) {
                ++held;
                changing += lets_go_or_moves(scene.cloths[member.cloth].pins[*pin]) ? 1 : 0;
            }
        if (changing == 0 || held == 1) continue;
        const Cloth& cloth = scene.cloths[place.front().cloth];
        const std::uint32_t particle = place.front().particle;
        return SeamFault{"", fmt::format("expected one pin alone where it moves or lets go, got {} at the sewn "
                                         "particle [{}, {}] of \"{}\"",
                                         held, particle % cloth.grid[0], particle / cloth.grid[0], cloth.name)};
    }
    return std::nullopt;
}

}  // namespace

std::optional<std::size_t> cloth_called(const SceneDescription& scene, const std::string& name) {
    const auto found = std::ranges::find(scene.cloths, name, &Cloth::name);
    if (found == scene.cloths.end()) return std::nullopt;
    return static_cast<std::size_t>(found - scene.cloths.begin());
}

std::optional<std::size_t> holding_pin(const SceneDescription& scene, const SewnMember& member) {
    const Cloth& cloth = scene.cloths[member.cloth];
    const std::uint32_t column = member.particle % cloth.grid[0], row = member.particle / cloth.grid[0];
    for (std::size_t k = cloth.pins.size(); k-- > 0;) {
        const auto& [first, last] = cloth.pins[k].particles;
        if (column >= first[0] && column <= last[0] && row >= first[1] && row <= last[1]) return k;
    }
    return std::nullopt;
}

std::vector<SeamFault> seam_faults(const SceneDescription& scene) {
    if (scene.seams.empty()) return {};
    if (std::string text = excluded_by(scene); !text.empty()) return {{"", std::move(text)}};
    std::vector<SeamFault> faults;
    for (std::size_t k = 0; k < scene.seams.size(); ++k)
        if (auto fault = fault_of(scene, scene.seams[k])) {
            fault->below = fmt::format("/{}{}", k, fault->below);
            faults.push_back(std::move(*fault));
        }
    if (!faults.empty()) return faults;
    if (auto fault = fault_of_pins(scene)) faults.push_back(std::move(*fault));
    return faults;
}

std::vector<SewnGroup> sewn_groups(const SceneDescription& scene) {
    std::map<SewnMember, SewnMember> led;  // by particle, one that it is sewn to, in the end its leader
    const auto leader_of = [&](SewnMember member) {
        while (led.at(member) != member) member = led.at(member);
        return member;
    };
    std::map<std::size_t, std::vector<bool>> has_cell;
    for (const Seam& seam : scene.seams)
        for (const auto& pair : stitches_of(scene, seam).pairs) {
            bool joined = true;
            for (const SewnMember& each : pair) {
                const auto [at, fresh] = has_cell.try_emplace(each.cloth);
                if (fresh) at->second = particles_of_cells(scene.cloths[each.cloth]);
                joined = joined && at->second[each.particle];
            }
            if (!joined) continue;
            for (const SewnMember& each : pair) led.try_emplace(each, each);
            const SewnMember one = leader_of(pair[0]), other = leader_of(pair[1]);
            led.at(std::max(one, other)) = std::min(one, other);
        }
    std::map<SewnMember, SewnGroup> by_leader;
    for (const auto& [member, ignored] : led) by_leader[leader_of(member)].push_back(member);
    std::vector<SewnGroup> places;
    for (auto& [leader, place] : by_leader)
        if (place.size() > 1) places.push_back(std::move(place));
    return places;
}

Vec3 sewn_start(const SceneDescription& scene, const SewnGroup& place) {
    for (const SewnMember& member : place)
        if (holding_pin(scene, member)) return place_of(scene, member);
    const SewnMember& leader = place.front();
    const Cloth& cloth = scene.cloths[leader.cloth];
    const double jitter = start_jitter(cloth);
    const Vec3 at = place_of(scene, leader);
    return jitter > 0 ? plus(at, start_offset(cloth.placement, jitter, leader.particle)) : at;
}

}  // namespace drape
