#include "cloth/sewing.h"

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <utility>

#include "base/vectors.h"
#include "cloth/grid.h"
#include "cloth/simulation_model.h"
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

/// A particle at a station, or between two, as one of these sees it.
struct Entry {
    SewnMember member;
    double weight = 1;
    const SewnBetween* between = nullptr;  ///< null: it is at the station
    bool operator<(const Entry& other) const { return member < other.member; }
};

/// What is known of a station beside its group.
struct Station {
    std::vector<Entry> entries;  ///< ascending
    double mass = 0;             ///< kg
    std::map<std::size_t, double> mass_by_cloth;
    Vec3 start{}, velocity{};  ///< m, all gaps being closed; m/s
    bool held = false;
    SewnRip rip;
    std::size_t leads = 0;  ///< the entry whose motion is the station's
};

/// Returns the entry whose motion is the station's: of its group one that a pin holds, best one that moves it or lets
/// it go, else the first.
std::size_t leading(const SceneDescription& scene, const std::vector<Entry>& entries) {
    std::size_t leads = entries.size();
    int best = -1;
    for (std::size_t k = 0; k < entries.size(); ++k) {
        if (entries[k].between) continue;
        const auto pin = holding_pin(scene, entries[k].member);
        int rank = 0;
        if (pin) {
            const Pin& held = scene.cloths[entries[k].member.cloth].pins[*pin];
            rank = held.release || !held.path.keys.empty() ? 2 : 1;
        }
        if (rank > best) best = rank, leads = k;
    }
    return leads;
}

/// All stations of a scene.
class Stations {
  public:
    explicit Stations(const SceneDescription& scene)
        : scene_(scene), sewing_(sewing_of(scene)), closings_(closing_times(scene)), masses_(scene) {
        for (const SewnStation& each : sewing_.stations)
            for (const SewnMember& member : each.group) stations_[index_of(each)].entries.push_back({member});
        for (const SewnBetween& each : sewing_.between)
            for (std::size_t k = 0; k < 2; ++k)
                for (const SewnMember& member : each.group)
                    stations_[each.stations[k]].entries.push_back({member, each.weights[k], &each});
        for (auto& [index, station] : stations_) measure(sewing_.stations[index], station);
    }

    /// Adds a cloth's particles at each station.
    void add(std::size_t cloth, bool solves, std::vector<Sewn>& all) {
        for (const auto& [index, station] : stations_)
            if (station.mass_by_cloth.contains(cloth)) add_station(index, {cloth, solves}, all);
    }

    std::vector<double> masses() const {
        std::vector<double> all(sewing_.stations.size());
        for (const auto& [index, station] : stations_) all[index] = station.mass;
        return all;
    }

  private:
    /// Whose particles are asked for, and how the method moves them.
    struct Asked {
        std::size_t cloth;
        bool solves;
    };
    std::size_t index_of(const SewnStation& station) const {
        return static_cast<std::size_t>(&station - sewing_.stations.data());
    }
    void measure(const SewnStation& sewn, Station& station);
    void add_station(std::size_t index, const Asked& asked, std::vector<Sewn>& all);
    Sewn sewn_of(const Entry& entry, std::size_t index, const Asked& asked);
    /// Returns the mass, kg, that a cloth's particle has while its cloth alone is moved.
    double carried(const Entry& entry, std::size_t station);
    int opening_of(double close) const {
        return close > 0 ? static_cast<int>(std::ranges::find(closings_, close) - closings_.begin()) : -1;
    }

    const SceneDescription& scene_;
    Sewing sewing_;
    std::vector<double> closings_;
    Masses masses_;
    std::map<std::size_t, Station> stations_;
};

void Stations::measure(const SewnStation& sewn, Station& station) {
    std::ranges::sort(station.entries, [](const Entry& a, const Entry& b) { return a < b; });
    Vec3 momentum{}, moment{};
    for (const Entry& entry : station.entries) {
        const double mass = entry.weight * masses_.of(entry.member);
        station.mass += mass;
        station.mass_by_cloth[entry.member.cloth] += mass;
        momentum =
            plus(momentum, times(mass, start_velocity(scene_.cloths[entry.member.cloth], entry.member.particle)));
        moment = plus(moment, times(mass, unsewn_start(scene_, entry.member)));
        station.held = station.held || (!entry.between && holding_pin(scene_, entry.member));
    }
    station.leads = leading(scene_, station.entries);
    station.rip = sewn.rip;
    station.velocity = times(1 / station.mass, momentum);
    // What closes keeps its centre of mass.
    station.start = !station.held && sewn.close > 0 ? times(1 / station.mass, moment)
                                                    : unsewn_start(scene_, station.entries[station.leads].member);
}

double Stations::carried(const Entry& entry, std::size_t index) {
    const double mass = masses_.of(entry.member);
    const auto share = [&](std::size_t at) {
        const Station& station = stations_.at(at);
        return station.mass * mass / station.mass_by_cloth.at(entry.member.cloth);
    };
    if (!entry.between) return share(index);
    const auto& [group, stations, weights, close, seam] = *entry.between;
    return weights[0] * share(stations[0]) + weights[1] * share(stations[1]);
}

Sewn Stations::sewn_of(const Entry& entry, std::size_t index, const Asked& asked) {
    const Station& station = stations_.at(index);
    const std::uint32_t columns = scene_.cloths[asked.cloth].grid[0], particle = entry.member.particle;
    const double own = masses_.of(entry.member), all = asked.solves ? carried(entry, index) : own;
    const auto single = [](double value) { return static_cast<float>(value); };
    Sewn made{particle, {}, station.start, station.velocity, station.held, entry.weight * all / station.mass};
    glsl::SewnParticle& sewn = made.sewn;
    sewn.at = {static_cast<int>(particle % columns), static_cast<int>(particle / columns), static_cast<int>(index), 0};
    sewn.between = {-1, 1, opening_of(sewing_.stations[index].close), 0};
    sewn.weights = {0, single(masses_.inner(asked.cloth) / all), 0, single(entry.weight)};
    sewn.parts = {0, single(own / station.mass_by_cloth.at(asked.cloth)), 0, 0};
    sewn.carried = {single(all - own), 0, 0, 0};
    if (const SewnRip& rip = station.rip; rip.load > 0) {
        // Two are sewn there, whose forces T part them with (m_b T_a - m_a T_b)/(m_a + m_b).
        const double sign = entry.member == station.entries.front().member ? 1 : -1;
        made.seam = rip.length;
        sewn.carried.y = single(rip.load);
        sewn.carried.z = single(sign * (station.mass - own) / station.mass);
        sewn.carried.w = single(masses_.inner(asked.cloth) / own);
    }
    if (entry.between) {
        const auto& [group, stations, weights, close, seam] = *entry.between;
        const std::size_t own_side = stations[0] == index ? 0 : 1;
        const Station& other = stations_.at(stations[1 - own_side]);
        const bool takes =
            weights[own_side] > weights[1 - own_side] || (weights[own_side] == weights[1 - own_side] && own_side == 0);
        sewn.between = {static_cast<int>(stations[1 - own_side]), takes ? 1 : 0, opening_of(close), 0};
        sewn.parts.y = single(made.part);
        sewn.parts.z = single(weights[1 - own_side] * all / other.mass);
        made.start = plus(times(entry.weight, station.start), times(weights[1 - own_side], other.start));
        made.velocity = plus(times(entry.weight, station.velocity), times(weights[1 - own_side], other.velocity));
        made.held = station.held && other.held;
        sewn.gap.w = single(weights[1 - own_side]);
    }
    if (sewn.between.z >= 0) {
        const Vec3 start = unsewn_start(scene_, entry.member), gap = minus(start, made.start);
        sewn.gap = {single(gap[0]), single(gap[1]), single(gap[2]), sewn.gap.w};
        made.start = start;
    }
    return made;
}

void Stations::add_station(std::size_t index, const Asked& asked, std::vector<Sewn>& all) {
    const Station& station = stations_.at(index);
    const auto is_own = [&](const Entry& entry) { return entry.member.cloth == asked.cloth; };
    const auto count = static_cast<int>(std::ranges::count_if(station.entries, is_own));
    const bool some_between = std::ranges::any_of(
        station.entries, [&](const Entry& entry) { return is_own(entry) && entry.between != nullptr; });
    const bool by_one = asked.solves || station.held;
    double counted = 0, own_counted = 0;
    for (std::size_t k = 0; k < station.entries.size(); ++k) {
        const Entry& entry = station.entries[k];
        const double mass = entry.weight * masses_.of(entry.member);
        counted += mass;
        if (!is_own(entry)) continue;
        Sewn made = sewn_of(entry, index, asked);
        if (own_counted == 0) made.sewn.at.w = count;
        own_counted += mass;
        made.sewn.between.w = k == station.leads ? 1 : 0;
        made.sewn.weights.x = static_cast<float>(by_one ? (k == station.leads ? 1 : 0) : mass / counted);
        made.sewn.weights.z = k == 0 ? 1.0f : 0.0f;
        made.sewn.parts.x = static_cast<float>(mass / own_counted);
        made.sewn.parts.w = some_between ? 1.0f : 0.0f;
        all.push_back(made);
    }
}

}  // namespace

bool lies_between(const std::vector<Sewn>& sewn) {
    return std::ranges::any_of(sewn, [](const Sewn& each) { return each.sewn.between.x >= 0; });
}

bool rips(const std::vector<Sewn>& sewn) {
    return std::ranges::any_of(sewn, [](const Sewn& each) { return each.seam > 0; });
}

std::vector<double> closing_times(const SceneDescription& scene) {
    std::set<double> times;
    for (const Seam& seam : scene.seams)
        if (seam.close > 0) times.insert(seam.close);
    return {times.begin(), times.end()};
}

double opening_at(double time, double closed) {
    const double part = std::clamp(time / closed, 0.0, 1.0);
    return 1 - part * part * (3 - 2 * part);
}

std::vector<Sewn> sewn_particles(const SceneDescription& scene, const Cloth& cloth) {
    const Cloth* const first = scene.cloths.data();
    if (scene.seams.empty() || std::less<>()(&cloth, first) || !std::less<>()(&cloth, first + scene.cloths.size()))
        return {};
    std::vector<Sewn> all;
    Stations(scene).add(static_cast<std::size_t>(&cloth - first), named(scene.solver.method).iterates(), all);
    return all;
}

std::vector<int> sewn_joints(const SimulationModel& model) {
    const std::vector<ClothModel>& cloths = model.cloths;
    std::map<int, std::set<std::size_t>> at_place;
    for (std::size_t cloth = 0; cloth < cloths.size(); ++cloth)
        for (const Sewn& each : cloths[cloth].sewn) at_place[each.sewn.at.z].insert(cloth);
    std::vector<int> joints(cloths.size(), -1);
    const auto join = [&](int place, const std::set<std::size_t>& here) {
        int first = place;
        for (const std::size_t cloth : here)
            if (joints[cloth] >= 0) first = std::min(first, joints[cloth]);
        bool changed = false;
        for (const std::size_t cloth : here) changed = std::exchange(joints[cloth], first) != first || changed;
        return changed;
    };
    for (bool changed = true; changed;) {
        changed = false;
        for (const auto& [place, here] : at_place)
            if (here.size() > 1) changed = join(place, here) || changed;
    }
    return joints;
}

std::vector<double> sewn_masses(const SceneDescription& scene) { return Stations(scene).masses(); }

}  // namespace drape
