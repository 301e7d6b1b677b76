#include "world/seams.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "base/vectors.h"
#include "world/seam_sides.h"
#include "world/start.h"

namespace drape {

namespace {

Vec3 place_of(const SceneDescription& scene, const SewnMember& member) {
    const Cloth& cloth = scene.cloths[member.cloth];
    return start_place(cloth, member.particle % cloth.grid[0], member.particle / cloth.grid[0]);
}

/// A particle that a seam lays between two.
struct Joint {
    SewnMember follower;
    std::array<SewnMember, 2> leaders;
    std::array<double, 2> weights;
};

/// What a seam joins.
struct Stitches {
    std::vector<std::array<SewnMember, 2>> pairs;
    std::vector<double> lengths;  ///< m: by pair, the seam's length that is its own
    std::vector<Joint> joints;
    double gap = 0;      ///< m: the largest
    double widest = 0;   ///< the largest over what is allowed
    SewnMember where{};  ///< at this particle
    double wide = 0;     ///< m: as far as it is
    double allowed = 0;  ///< m: and may be
};

/// Joins the sides of a seam.
class Stitcher {
  public:
    Stitcher(const SceneDescription& scene, const Seam& seam)
        : scene_(scene), a_(*cloth_called(scene, seam.a.cloth)), b_(*cloth_called(scene, seam.b.cloth)) {
        spacing_ = std::min(least_spacing(scene.cloths[a_]), least_spacing(scene.cloths[b_]));
    }

    Stitches join(const SeamRun& of_a, const SeamRun& of_b) {
        made_ = {};
        const bool b_is_finer = of_b.particles.size() >= of_a.particles.size();
        const SeamRun &coarse = b_is_finer ? of_a : of_b, &fine = b_is_finer ? of_b : of_a;
        leads_ = b_is_finer ? a_ : b_;
        follows_ = b_is_finer ? b_ : a_;
        const std::size_t count = fine.particles.size(), last = coarse.particles.size() - 1;
        for (std::size_t k = 0, at = 0; k < count; ++k) {
            const SewnMember follower{follows_, fine.particles[k]};
            if (count == last + 1) {
                pair({leads_, coarse.particles[k]}, follower);
                made_.lengths.push_back((length_at(coarse, k) + length_at(fine, k)) / 2);
                continue;
            }
            while (at + 1 < last && coarse.ways[at + 1] <= fine.ways[k]) ++at;
            lay(coarse, at, fine.ways[k], follower);
        }
        return made_;
    }

  private:
    /// Returns half of the length between a particle's neighbours on a side.
    static double length_at(const SeamRun& run, std::size_t k) {
        const std::size_t last = run.ways.size() - 1;
        return run.length * (run.ways[std::min(k + 1, last)] - run.ways[k > 0 ? k - 1 : 0]) / 2;
    }
    void pair(const SewnMember& leader, const SewnMember& follower) {
        made_.pairs.push_back({leader, follower});
        measure(leader, place_of(scene_, follower), place_of(scene_, leader), seam_tolerance);
    }
    /// Lays a particle on a piece of the coarser side, or on one of its ends where it is that near.
    void lay(const SeamRun& coarse, std::size_t at, double way, const SewnMember& follower) {
        constexpr double near = 1e-6;
        const double part = (way - coarse.ways[at]) / (coarse.ways[at + 1] - coarse.ways[at]);
        const SewnMember one{leads_, coarse.particles[at]}, other{leads_, coarse.particles[at + 1]};
        if (part < near || part > 1 - near) return pair(part < near ? one : other, follower);
        made_.joints.push_back({follower, {one, other}, {1 - part, part}});
        measure(follower, place_of(scene_, follower),
                plus(times(1 - part, place_of(scene_, one)), times(part, place_of(scene_, other))),
                seam_tolerance_between);
    }
    void measure(const SewnMember& where, const Vec3& from, const Vec3& to, double tolerance) {
        const double gap = length(minus(from, to)), allowed = tolerance * spacing_;
        made_.gap = std::max(made_.gap, gap);
        if (gap / allowed <= made_.widest) return;
        made_.widest = gap / allowed;
        made_.where = where, made_.wide = gap, made_.allowed = allowed;
    }

    const SceneDescription& scene_;
    std::size_t a_, b_, leads_ = 0, follows_ = 0;
    double spacing_;  ///< m
    Stitches made_;
};

Stitches stitches_of(const SceneDescription& scene, const Seam& seam) {
    Stitcher stitcher(scene, seam);
    const SeamRun a = particles_of(scene.cloths[*cloth_called(scene, seam.a.cloth)], seam.a),
                  b = particles_of(scene.cloths[*cloth_called(scene, seam.b.cloth)], seam.b);
    Stitches straight = stitcher.join(a, b), back = stitcher.join(a, reversed(b));
    return back.gap < straight.gap ? back : straight;
}

/// Returns a particle as text.
std::string named_particle(const SceneDescription& scene, const SewnMember& member) {
    const Cloth& cloth = scene.cloths[member.cloth];
    return fmt::format("particle [{}, {}] of \"{}\"", member.particle % cloth.grid[0], member.particle / cloth.grid[0],
                       cloth.name);
}

/// Returns what is wrong with the sides of a seam.
std::optional<SeamFault> fault_of_sides(const SceneDescription& scene, const Seam& seam) {
    for (const auto& [side, key] : {std::pair{&seam.a, "/a"}, std::pair{&seam.b, "/b"}}) {
        const auto cloth = cloth_called(scene, side->cloth);
        if (!cloth)
            return SeamFault{std::string(key) + "/cloth",
                             fmt::format("expected the name of a cloth of the scene, got \"{}\"", side->cloth)};
        if (auto fault = side_fault(scene.cloths[*cloth], *side))
            return SeamFault{key + fault->below, std::move(fault->text)};
    }
    if (seam.a == seam.b) return SeamFault{"/b", "expected another side than a, got the same"};
    if (!(seam.close >= 0 && std::isfinite(seam.close))) return SeamFault{"/close", "expected a time of 0 or more"};
    if (seam.rip && !(*seam.rip > 0 && std::isfinite(*seam.rip))) return SeamFault{"/rip", "expected a load above 0"};
    if (seam.rip && seam.close > 0) return SeamFault{"/rip", "expected no rip of a seam that is closed later"};
    return std::nullopt;
}

std::optional<SeamFault> fault_of(const SceneDescription& scene, const Seam& seam) {
    if (auto fault = fault_of_sides(scene, seam)) return fault;
    const Stitches made = stitches_of(scene, seam);
    if (made.widest <= 1 || seam.close > 0) return std::nullopt;
    return SeamFault{"", fmt::format("expected sides that start together, within {:.3g} m, or close, got a gap of "
                                     "{:.3g} m at {}",
                                     made.allowed, made.wide, named_particle(scene, made.where))};
}

bool has_bodies(const SceneDescription& scene) {
    return std::ranges::any_of(scene.colliders, [](const Collider& collider) { return collider.mass.has_value(); });
}

/// Returns what of a scene does not go with seams. A body gets back what it gives to the mass that a cloth has at a
/// place: all of it where cloths touch it in turn with the mass of all, and none lies between places.
std::string excluded_by(const SceneDescription& scene) {
    const auto meets = [](const Cloth& cloth) { return cloth.self_collision.has_value(); };
    if (scene.forces && std::ranges::any_of(scene.cloths, meets))
        return "expected no seams beside forces where cloths have self_collision: what contact gives to what is sewn "
               "is not told yet";
    const bool gives_back = scene.solver.method == SolverMethod::relax || scene.solver.method == SolverMethod::line;
    if (scene.forces && !scene.colliders.empty() && !gives_back)
        return "expected method line or relax where seams are beside forces and colliders: by others what touches at a "
               "seam is not all told";
    if (!has_bodies(scene)) return {};
    if (!gives_back)
        return "expected method line or relax where seams are beside a body with a mass: by others they do not keep "
               "the momentum of both";
    if (std::ranges::any_of(scene.cloths, meets))
        return "expected no seams beside a body with a mass where cloths have self_collision: all that is sewn touches "
               "it at once, and it would get back the sum";
    return {};
}

/// Returns a fault where particles lie between places and have to bear what touches them: only places do.
std::optional<SeamFault> fault_of_between(const SceneDescription& scene, const Sewing& sewing) {
    if (sewing.between.empty()) return std::nullopt;
    const std::string below = fmt::format("/{}", sewing.between.front().seam);
    if (has_bodies(scene))
        return SeamFault{below,
                         "expected sides of as many particles each beside a body with a mass: what lies between "
                         "others would touch it, and not move"};
    if (scene.forces && !scene.colliders.empty())
        return SeamFault{below,
                         "expected sides of as many particles each beside forces and colliders: what touches "
                         "between others is not all told"};
    return std::nullopt;
}

/// Returns what of a scene does not go with seams that rip: what else moves sewn particles would have to be counted.
std::string excluded_by_rips(const SceneDescription& scene) {
    if (!scene.colliders.empty()) return "expected no colliders beside a seam that rips";
    if (scene.solver.tethers) return "expected no tethers beside a seam that rips";
    if (std::ranges::any_of(scene.cloths, [](const Cloth& cloth) { return cloth.self_collision.has_value(); }))
        return "expected no self_collision beside a seam that rips";
    return {};
}

/// Returns a fault where a seam that rips joins other than two particles at a place, or pins hold one of these.
std::optional<SeamFault> fault_of_rips(const SceneDescription& scene, const Sewing& sewing) {
    const auto first = std::ranges::find_if(scene.seams, [](const Seam& each) { return each.rip.has_value(); });
    if (first == scene.seams.end()) return std::nullopt;
    const auto fault = [](std::size_t seam, std::string text) {
        return SeamFault{fmt::format("/{}/rip", seam), std::move(text)};
    };
    const auto any = static_cast<std::size_t>(first - scene.seams.begin());
    if (std::string text = excluded_by_rips(scene); !text.empty()) return fault(any, std::move(text));
    if (!sewing.between.empty())
        return fault(any, "expected all sides of seams to have as many particles where one rips");
    for (const auto& [group, close, rip] : sewing.stations) {
        if (rip.load == 0) continue;
        if (group.size() != 2)
            return fault(rip.seam,
                         fmt::format("expected two particles at each place of a seam that rips, got {} at the sewn {}",
                                     group.size(), named_particle(scene, group.front())));
        for (const SewnMember& member : group)
            if (holding_pin(scene, member))
                return fault(rip.seam, fmt::format("expected no pin at a seam that rips, got one of {}",
                                                   named_particle(scene, member)));
    }
    return std::nullopt;
}

bool lets_go_or_moves(const Pin& pin) { return pin.release || !pin.path.keys.empty(); }

bool is_held(const SceneDescription& scene, const SewnGroup& group) {
    return std::ranges::any_of(group, [&](const SewnMember& member) { return holding_pin(scene, member).has_value(); });
}

/// Returns a fault where a pin that moves or lets go is not the only one at a sewn place, or pins hold what lies
/// between places that none holds.
std::optional<SeamFault> fault_of_pins(const SceneDescription& scene, const Sewing& sewing) {
    for (const auto& [group, close, rip] : sewing.stations) {
        std::size_t held = 0, changing = 0;
        for (const SewnMember& member : group)
            if (const auto pin = holding_pin(scene, member)) {
                ++held;
                changing += lets_go_or_moves(scene.cloths[member.cloth].pins[*pin]) ? 1 : 0;
            }
        if (changing == 0 || held == 1) continue;
        return SeamFault{"", fmt::format("expected one pin alone where it moves or lets go, got {} at the sewn {}",
                                         held, named_particle(scene, group.front()))};
    }
    for (const SewnBetween& each : sewing.between)
        if (is_held(scene, each.group))
            for (const std::size_t station : each.stations)
                if (!is_held(scene, sewing.stations[station].group))
                    return SeamFault{
                        fmt::format("/{}", each.seam),
                        fmt::format("expected pins of the coarser side where the finer one is held, got none of {} "
                                    "beside {}",
                                    named_particle(scene, sewing.stations[station].group.front()),
                                    named_particle(scene, each.group.front()))};
    return std::nullopt;
}

/// Joins particles into groups.
class Groups {
  public:
    /// Returns the leader of a particle's group, which it alone is at first.
    SewnMember leader_of(SewnMember member) {
        led_.try_emplace(member, member);
        while (led_.at(member) != member) member = led_.at(member);
        return member;
    }
    /// `index`: the seam's, `length`: m, of the seam's that is the pair's.
    void join(const SewnMember& a, const SewnMember& b, std::size_t index, const Seam& seam, double length) {
        const SewnMember one = leader_of(a), other = leader_of(b);
        const double later = std::max({close_[one], close_[other], seam.close});
        SewnRip all = rips_[one];
        if (const SewnRip& more = rips_[other]; one != other && more.length > 0)
            all = {all.load + more.load, all.length + more.length, more.seam};
        if (seam.rip) all = {all.load + *seam.rip * length, all.length + length, index};
        stays_[std::min(one, other)] = stays_[one] || stays_[other] || !seam.rip;
        led_.at(std::max(one, other)) = std::min(one, other);
        close_[std::min(one, other)] = later;
        rips_[std::min(one, other)] = all;
    }
    struct Group {
        SewnGroup members;
        double close = 0;
        SewnRip rip{};
    };
    std::map<SewnMember, Group> all() {
        std::map<SewnMember, Group> groups;
        for (const auto& [member, ignored] : led_) groups[leader_of(member)].members.push_back(member);
        for (auto& [leader, group] : groups) {
            group.close = close_[leader];
            if (!stays_[leader]) group.rip = rips_[leader];
        }
        return groups;
    }

  private:
    std::map<SewnMember, SewnMember> led_;  ///< by particle, one that it is sewn to, in the end its leader
    std::map<SewnMember, double> close_;    ///< by leader
    std::map<SewnMember, SewnRip> rips_;    ///< likewise
    std::map<SewnMember, bool> stays_;      ///< likewise: whether a seam joins it that does not rip
};

/// Makes one sewing of all seams, and says where that cannot be.
class Sewer {
  public:
    explicit Sewer(const SceneDescription& scene) : scene_(scene) {}

    std::optional<SeamFault> sew() {
        std::vector<Stitches> all;
        for (const Seam& seam : scene_.seams) all.push_back(stitches_of(scene_, seam));
        for (std::size_t k = 0; k < all.size(); ++k)
            for (std::size_t pair = 0; pair < all[k].pairs.size(); ++pair)
                if (const auto& [one, other] = all[k].pairs[pair]; has_cell(one) && has_cell(other))
                    groups_.join(one, other, k, scene_.seams[k], all[k].lengths.empty() ? 0 : all[k].lengths[pair]);
        for (std::size_t k = 0; k < all.size(); ++k)
            for (const Joint& joint : all[k].joints)
                if (has_cell(joint.follower) && has_cell(joint.leaders[0]) && has_cell(joint.leaders[1]))
                    if (auto fault = lay(joint, k)) return fault;
        return take_all();
    }
    Sewing take() && { return std::move(sewing_); }

  private:
    bool has_cell(const SewnMember& member) {
        const auto [at, fresh] = has_cell_.try_emplace(member.cloth);
        if (fresh) at->second = particles_of_cells(scene_.cloths[member.cloth]);
        return at->second[member.particle];
    }
    SeamFault fault(std::size_t seam, const SewnMember& member) const {
        return {fmt::format("/{}", seam), fmt::format("expected no particle that other seams lay between others too, "
                                                      "got {}: sew the finer sides to the coarsest",
                                                      named_particle(scene_, member))};
    }
    std::optional<SeamFault> lay(const Joint& joint, std::size_t seam) {
        const SewnMember follower = groups_.leader_of(joint.follower);
        Laid laid{{groups_.leader_of(joint.leaders[0]), groups_.leader_of(joint.leaders[1])}, joint.weights, seam};
        if (laid.leaders[0] == laid.leaders[1] || follower == laid.leaders[0] || follower == laid.leaders[1])
            return fault(seam, joint.follower);
        if (laid.leaders[1] < laid.leaders[0]) {
            std::swap(laid.leaders[0], laid.leaders[1]);
            std::swap(laid.weights[0], laid.weights[1]);
        }
        const auto [before, fresh] = laid_.try_emplace(follower, laid);
        constexpr double same = 1e-9;
        if (fresh ||
            (before->second.leaders == laid.leaders && std::abs(before->second.weights[0] - laid.weights[0]) < same))
            return std::nullopt;
        return fault(seam, joint.follower);
    }
    std::optional<SeamFault> take_all() {
        std::map<SewnMember, bool> leads;
        for (const auto& [follower, laid] : laid_)
            for (const SewnMember& leader : laid.leaders) {
                if (laid_.contains(leader)) return fault(laid.seam, leader);
                leads[leader] = true;
            }
        std::map<SewnMember, std::size_t> stations;
        std::map<SewnMember, Groups::Group> groups = groups_.all();
        for (auto& [leader, group] : groups) {
            if (laid_.contains(leader) || (group.members.size() == 1 && !leads.contains(leader))) continue;
            stations[leader] = sewing_.stations.size();
            sewing_.stations.push_back({group.members, group.close, group.rip});
        }
        for (const auto& [follower, laid] : laid_) {
            const Groups::Group& group = groups.at(follower);
            for (const SewnMember& leader : laid.leaders) {
                double& close = sewing_.stations[stations.at(leader)].close;
                close = std::max(close, scene_.seams[laid.seam].close);
            }
            sewing_.between.push_back({group.members,
                                       {stations.at(laid.leaders[0]), stations.at(laid.leaders[1])},
                                       laid.weights,
                                       std::max(group.close, scene_.seams[laid.seam].close),
                                       laid.seam});
        }
        return std::nullopt;
    }

    struct Laid {
        std::array<SewnMember, 2> leaders;
        std::array<double, 2> weights;
        std::size_t seam;
    };
    const SceneDescription& scene_;
    Groups groups_;
    std::map<SewnMember, Laid> laid_;  ///< by the leader of a group that lies between
    std::map<std::size_t, std::vector<bool>> has_cell_;
    Sewing sewing_;
};

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
    Sewer sewer(scene);
    auto fault = sewer.sew();
    if (!fault) {
        const Sewing sewing = std::move(sewer).take();
        fault = fault_of_pins(scene, sewing);
        if (!fault) fault = fault_of_between(scene, sewing);
        if (!fault) fault = fault_of_rips(scene, sewing);
    }
    if (fault) faults.push_back(std::move(*fault));
    return faults;
}

Sewing sewing_of(const SceneDescription& scene) {
    Sewer sewer(scene);
    if (const auto fault = sewer.sew()) throw std::invalid_argument("seams" + fault->below + ": " + fault->text);
    return std::move(sewer).take();
}

Vec3 unsewn_start(const SceneDescription& scene, const SewnMember& member) {
    const Cloth& cloth = scene.cloths[member.cloth];
    const double jitter = holding_pin(scene, member) ? 0 : start_jitter(cloth);
    const Vec3 at = place_of(scene, member);
    return jitter > 0 ? plus(at, start_offset(cloth.placement, jitter, member.particle)) : at;
}

}  // namespace drape
