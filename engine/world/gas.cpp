#include "world/gas.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "base/vectors.h"
#include "world/seams.h"
#include "world/start.h"
#include "world/weather.h"

namespace drape {

namespace {

/// Calls `visit` with the particles at the corners of each cell that exists, as they go around its front.
template <class Visit>
void for_cells(const Cloth& cloth, const Visit& visit) {
    const std::vector<bool> missing = missing_cells(cloth);
    const std::uint32_t columns = cloth.grid[0];
    for (std::uint32_t cell = 0; cell < missing.size(); ++cell) {
        if (missing[cell]) continue;
        const std::uint32_t first = cell / (columns - 1) * columns + cell % (columns - 1);
        visit(std::array<std::uint32_t, 4>{first, first + 1, first + columns + 1, first + columns});
    }
}

double triple(const Vec3& a, const Vec3& b, const Vec3& c) { return dot(a, cross(b, c)); }

/// A place on the seams: a station, or a part of the way from one to another.
struct SeamPlace {
    std::size_t from, to;
    double part;  ///< 0 where both are the same
};

/// Where the particles of cloths are sewn.
class SeamPlaces {
  public:
    explicit SeamPlaces(const Sewing& sewing) {
        for (std::size_t k = 0; k < sewing.stations.size(); ++k)
            for (const SewnMember& member : sewing.stations[k].group) places_[member] = {k, k, 0};
        for (const SewnBetween& each : sewing.between) {
            const bool turned = each.stations[0] > each.stations[1];
            for (const SewnMember& member : each.group)
                places_[member] = {each.stations[turned ? 1 : 0], each.stations[turned ? 0 : 1],
                                   each.weights[turned ? 0 : 1]};
        }
    }
    const SeamPlace* find(const SewnMember& member) const {
        const auto found = places_.find(member);
        return found == places_.end() ? nullptr : &found->second;
    }

  private:
    std::map<SewnMember, SeamPlace> places_;
};

/// A straight piece of a seam, from one station to a later one.
using Piece = std::pair<std::size_t, std::size_t>;

/// How far along a piece an edge from one place to another goes, as a part of it; nothing: it is on none.
struct Way {
    Piece piece;
    double part;
};
std::optional<Way> way_between(const SeamPlace& a, const SeamPlace& b) {
    const auto within = [](const SeamPlace& of, std::size_t station) { return of.from == station || of.to == station; };
    const bool a_stands = a.from == a.to, b_stands = b.from == b.to;
    if (a_stands && b_stands)
        return Way{std::minmax(a.from, b.from), a.from < b.from ? 1.0 : a.from > b.from ? -1.0 : 0.0};
    const SeamPlace& lies = a_stands ? b : a;
    const SeamPlace& other = a_stands ? a : b;
    const bool other_stands = other.from == other.to;
    if (other_stands ? !within(lies, other.from) : other.from != lies.from || other.to != lies.to) return std::nullopt;
    const auto part_of = [&](const SeamPlace& place) {
        return place.from != place.to ? place.part : place.from == lies.to ? 1.0 : 0.0;
    };
    return Way{{lies.from, lies.to}, part_of(b) - part_of(a)};
}

/// Returns where an edge of a rim is, as text.
std::string place_on_rim(const Cloth& cloth, std::uint32_t a, std::uint32_t b) {
    const std::uint32_t columns = cloth.grid[0], last = columns * (cloth.grid[1] - 1);
    const auto both = [&](const auto& is) { return is(a) && is(b); };
    if (cloth.panel.empty()) {
        if (both([&](std::uint32_t k) { return k % columns == 0; })) return "edge left";
        if (both([&](std::uint32_t k) { return k % columns == columns - 1; })) return "edge right";
        if (both([&](std::uint32_t k) { return k < columns; })) return "edge top";
        if (both([&](std::uint32_t k) { return k >= last; })) return "edge bottom";
    } else {
        return fmt::format("outline at [{:.6g}, {:.6g}] m from the corner of its box", cloth.panel[a][0],
                           cloth.panel[a][1]);
    }
    return fmt::format("rim at particle [{}, {}]", a % columns, a / columns);
}

/// Follows the rims of cloths around what they close in.
class Closure {
  public:
    Closure(const SceneDescription& scene, std::span<const std::size_t> cloths)
        : scene_(scene), cloths_(cloths), places_(sewing_of(scene)), signs_(cloths.size(), 0) {}

    /// Returns what is not closed; nothing: it is, and `signs` are known.
    std::optional<std::string> close() {
        for (std::size_t k = 0; k < cloths_.size(); ++k)
            if (auto fault = follow(k)) return fault;
        signs_.front() = 1;
        for (bool changed = true; changed;) {
            changed = false;
            for (const auto& [piece, sides] : pieces_)
                if (auto met = meet(sides, changed)) return met;
        }
        for (std::size_t k = 0; k < signs_.size(); ++k)
            if (signs_[k] == 0)
                return fmt::format(
                    "expected cloths that are all sewn together, got \"{}\", which nothing sews to \"{}\"", name(k),
                    name(0));
        return std::nullopt;
    }
    /// 1: the cloth faces as the first one does, -1: it is turned over.
    const std::vector<int>& signs() const { return signs_; }

  private:
    struct Side {
        double parts = 0, length = 0;  ///< along a piece, there and back again, and both ways
        std::uint32_t a = 0, b = 0;
    };
    using Sides = std::map<std::size_t, Side>;  ///< by cloth

    const std::string& name(std::size_t k) const { return scene_.cloths[cloths_[k]].name; }
    std::string open(std::size_t k, std::uint32_t a, std::uint32_t b) const {
        return fmt::format("expected a closed surface, got \"{}\" open along its {}", name(k),
                           place_on_rim(scene_.cloths[cloths_[k]], a, b));
    }
    std::optional<std::string> follow(std::size_t k) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
        for_cells(scene_.cloths[cloths_[k]], [&](const std::array<std::uint32_t, 4>& corners) {
            for (std::size_t i = 0; i < 4; ++i) {
                const std::uint32_t a = corners[i], b = corners[(i + 1) % 4];
                edges[std::minmax(a, b)] += a < b ? 1 : -1;
            }
        });
        for (const auto& [edge, turns] : edges) {
            if (turns == 0) continue;
            const auto [a, b] = turns > 0 ? edge : std::pair{edge.second, edge.first};
            const SeamPlace *from = places_.find({cloths_[k], a}), *to = places_.find({cloths_[k], b});
            if (!from || !to) return open(k, a, b);
            const std::optional<Way> way = way_between(*from, *to);
            if (!way)
                return fmt::format(
                    "expected seams whose coarser side has particles at those of the finer one, got \"{}\" "
                    "across one along its {}",
                    name(k), place_on_rim(scene_.cloths[cloths_[k]], a, b));
            Side& side = pieces_[way->piece][k];
            side.parts += way->part;
            side.length += std::abs(way->part);
            side.a = a, side.b = b;
        }
        return std::nullopt;
    }
    /// Turns a cloth so that the edges of a piece go there and back again.
    std::optional<std::string> meet(const Sides& sides, bool& changed) {
        constexpr double near = 1e-6;
        std::vector<std::pair<std::size_t, Side>> open_sides;
        for (const auto& [k, side] : sides) {
            if (side.length > 2 + near) return crowded(k, side);
            if (std::abs(side.parts) > near)
                open_sides.emplace_back(k, side);
            else if (side.length > near && sides.size() > 1)
                return crowded(k, side);
        }
        if (open_sides.empty()) return std::nullopt;
        if (open_sides.size() > 2) return crowded(open_sides[2].first, open_sides[2].second);
        const auto& [one, own] = open_sides.front();
        if (open_sides.size() == 1) {
            if (std::abs(own.parts) > 1 + near)
                return fmt::format(
                    "expected sides that face one way around, got \"{}\" sewn to itself the other way "
                    "round along its {}",
                    name(one), place_on_rim(scene_.cloths[cloths_[one]], own.a, own.b));
            return open(one, own.a, own.b);
        }
        const auto& [other, others] = open_sides.back();
        if (std::abs(std::abs(own.parts) - std::abs(others.parts)) > near) return open(one, own.a, own.b);
        const int turn = own.parts * others.parts < 0 ? 1 : -1;
        for (const auto& [known, unknown] : {std::pair{one, other}, std::pair{other, one}})
            if (signs_[known] != 0 && signs_[unknown] == 0) {
                signs_[unknown] = turn * signs_[known];
                changed = true;
            }
        if (signs_[one] * signs_[other] == -turn)
            return fmt::format("expected a surface with an inside, got \"{}\" and \"{}\" sewn to a one-sided one",
                               name(one), name(other));
        return std::nullopt;
    }
    std::string crowded(std::size_t k, const Side& side) const {
        return fmt::format(
            "expected two sides of the surface at each place of its seams, got more at \"{}\" along its {}", name(k),
            place_on_rim(scene_.cloths[cloths_[k]], side.a, side.b));
    }

    const SceneDescription& scene_;
    std::span<const std::size_t> cloths_;
    SeamPlaces places_;
    std::map<Piece, Sides> pieces_;
    std::vector<int> signs_;
};

std::vector<Vec3> start_of(const Cloth& cloth) {
    std::vector<Vec3> at;
    for (std::uint32_t row = 0; row < cloth.grid[1]; ++row)
        for (std::uint32_t column = 0; column < cloth.grid[0]; ++column) at.push_back(start_place(cloth, column, row));
    return at;
}

std::vector<std::size_t> cloths_of(const SceneDescription& scene, const Gas& gas) {
    std::vector<std::size_t> cloths;
    for (const std::string& name : gas.cloths) cloths.push_back(*cloth_called(scene, name));
    return cloths;
}

/// Returns the area of the cloths at the start, m^2.
double start_area(const SceneDescription& scene, std::span<const std::size_t> cloths) {
    double area = 0;
    for (const std::size_t cloth : cloths)
        for (const Vec3& each : areas_borne(scene.cloths[cloth], start_of(scene.cloths[cloth]))) area += length(each);
    return area;
}

std::optional<GasFault> fault_of_amount(const Gas& gas) {
    const auto is_amount = [](double value) { return value >= 0 && std::isfinite(value); };
    if (gas.volume.has_value() == !gas.volume_keys.empty()) return GasFault{"", "expected a volume or volume_keys"};
    if (gas.volume && !is_amount(*gas.volume)) return GasFault{"/volume", "expected a volume of 0 or more"};
    for (std::size_t k = 0; k < gas.volume_keys.size(); ++k)
        if (!is_amount(gas.volume_keys[k].value) || !std::isfinite(gas.volume_keys[k].time) ||
            (k > 0 && !(gas.volume_keys[k].time > gas.volume_keys[k - 1].time)))
            return GasFault{fmt::format("/volume_keys/{}", k), "expected a volume of 0 or more, and rising times"};
    if (!(gas.ambient > 0 && std::isfinite(gas.ambient))) return GasFault{"/ambient", "expected a pressure above 0"};
    return std::nullopt;
}

/// Returns a fault where something may open what closes the gas in.
std::optional<GasFault> fault_of_wall(const SceneDescription& scene, const std::string& below,
                                      const std::string& name) {
    const auto cloth = cloth_called(scene, name);
    if (!cloth) return GasFault{below, fmt::format("expected the name of a cloth of the scene, got \"{}\"", name)};
    if (scene.cloths[*cloth].tear)
        return GasFault{below, fmt::format("expected no cloth that tears around gas, got \"{}\"", name)};
    for (const Seam& seam : scene.seams) {
        if (seam.a.cloth != name && seam.b.cloth != name) continue;
        if (seam.rip)
            return GasFault{below, fmt::format("expected no seam that rips around gas, got one of \"{}\"", name)};
        if (seam.close > 0)
            return GasFault{below,
                            fmt::format("expected seams around gas that are closed from the start on, got one of "
                                        "\"{}\" that closes later",
                                        name)};
    }
    return std::nullopt;
}

std::optional<GasFault> fault_of(const SceneDescription& scene, const Gas& gas, std::set<std::string>& used) {
    if (auto fault = fault_of_amount(gas)) return fault;
    if (gas.cloths.empty()) return GasFault{"/cloths", "expected at least 1 cloth"};
    for (std::size_t k = 0; k < gas.cloths.size(); ++k) {
        const std::string below = fmt::format("/cloths/{}", k);
        if (auto fault = fault_of_wall(scene, below, gas.cloths[k])) return fault;
        if (!used.insert(gas.cloths[k]).second)
            return GasFault{
                below, fmt::format("expected a cloth that closes in no other gas, got \"{}\" again", gas.cloths[k])};
    }
    const std::vector<std::size_t> cloths = cloths_of(scene, gas);
    Closure closure(scene, cloths);
    if (auto text = closure.close()) return GasFault{"/cloths", std::move(*text)};
    const double volume = start_volume(scene, gas_walls(scene, gas));
    if (closes_nothing_in(volume, start_area(scene, cloths))) {
        if (gas.outside) return std::nullopt;
        return GasFault{"", "expected outside, front or back, where the cloths start flat and close nothing in"};
    }
    if (volume < 0)
        return GasFault{"/outside",
                        fmt::format("expected the side of \"{}\" that is outside where the cloths start, got "
                                    "that which is inside",
                                    gas.cloths.front())};
    return std::nullopt;
}

/// Returns a fault where cloths of two gases are sewn together: what of their areas is whose would not be known there.
std::optional<GasFault> fault_of_two(const SceneDescription& scene) {
    std::map<std::string, std::size_t> owner;
    for (std::size_t k = 0; k < scene.gas.size(); ++k)
        for (const std::string& name : scene.gas[k].cloths) owner[name] = k;
    for (const SewnStation& station : sewing_of(scene).stations) {
        std::optional<std::size_t> first;
        for (const SewnMember& member : station.group) {
            const auto found = owner.find(scene.cloths[member.cloth].name);
            if (found == owner.end()) continue;
            if (first && *first != found->second)
                return GasFault{
                    fmt::format("/{}/cloths", found->second),
                    fmt::format("expected no seam with a cloth of another gas, got one of \"{}\"", found->first)};
            first = found->second;
        }
    }
    return std::nullopt;
}

}  // namespace

double volume_behind(const Cloth& cloth, std::span<const Vec3> at) {
    double sum = 0;
    for_cells(cloth, [&](const std::array<std::uint32_t, 4>& corners) {
        const auto& [a, b, c, d] = corners;
        sum += triple(at[a], at[b], at[d]) + triple(at[b], at[c], at[a]) + triple(at[c], at[d], at[b]) +
               triple(at[d], at[a], at[c]);
    });
    return sum / 12;
}

std::vector<Vec3> areas_borne(const Cloth& cloth, std::span<const Vec3> at) {
    std::vector<Vec3> areas(at.size(), Vec3{});
    for_cells(cloth, [&](const std::array<std::uint32_t, 4>& corners) {
        for (std::size_t k = 0; k < 4; ++k) {
            const Vec3& own = at[corners[k]];
            const Vec3 next = minus(at[corners[(k + 1) % 4]], own), across = minus(at[corners[(k + 2) % 4]], own),
                       last = minus(at[corners[(k + 3) % 4]], own);
            areas[corners[k]] =
                plus(areas[corners[k]], times(1.0 / 12, plus(cross(next, last), cross(across, minus(last, next)))));
        }
    });
    return areas;
}

std::vector<GasFault> gas_faults(const SceneDescription& scene) {
    if (scene.gas.empty()) return {};
    if (!scene.cutters.empty()) return {{"", "expected no gas beside cutters, which would let it out"}};
    std::vector<GasFault> faults;
    std::set<std::string> used;
    for (std::size_t k = 0; k < scene.gas.size(); ++k)
        if (auto fault = fault_of(scene, scene.gas[k], used)) {
            fault->below = fmt::format("/{}{}", k, fault->below);
            faults.push_back(std::move(*fault));
        }
    if (faults.empty())
        if (auto fault = fault_of_two(scene)) faults.push_back(std::move(*fault));
    return faults;
}

std::vector<GasWall> gas_walls(const SceneDescription& scene, const Gas& gas) {
    const std::vector<std::size_t> cloths = cloths_of(scene, gas);
    Closure closure(scene, cloths);
    if (const auto fault = closure.close()) throw std::invalid_argument("gas: " + *fault);
    std::vector<GasWall> walls;
    for (std::size_t k = 0; k < cloths.size(); ++k) walls.push_back({cloths[k], double(closure.signs()[k])});
    const bool inward = gas.outside ? *gas.outside == ClothSide::back : start_volume(scene, walls) < 0;
    if (inward)
        for (GasWall& wall : walls) wall.sign = -wall.sign;
    return walls;
}

double gas_at(const Gas& gas, double time) { return value_at(gas.volume_keys, gas.volume.value_or(0), time); }

double most_gas(const Gas& gas) {
    double most = gas.volume.value_or(0);
    for (const NumberKey& key : gas.volume_keys) most = std::max(most, key.value);
    return most;
}

double start_volume(const SceneDescription& scene, std::span<const GasWall> walls) {
    double volume = 0;
    for (const auto& [cloth, sign] : walls)
        volume += sign * volume_behind(scene.cloths[cloth], start_of(scene.cloths[cloth]));
    return volume;
}

bool closes_nothing_in(double volume, double area) { return std::abs(volume) <= 1e-6 * std::pow(area, 1.5); }

double gas_pressure(const Gas& gas, double time, double volume, double yielding) {
    // This is gas_root of shaders/include/gas.h in double precision.
    const double amount = gas_at(gas, time), yields = yielding * gas.ambient;
    const double both = volume + yields;
    if (!(both > 0)) return 0;
    const double root = std::sqrt((volume - yields) * (volume - yields) + 4 * yields * amount);
    return 2 * gas.ambient * (amount - volume) / (both + root);
}

}  // namespace drape
