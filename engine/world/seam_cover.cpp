#include "world/seam_cover.h"

#include <algorithm>
#include <array>
#include <map>

#include "world/panel.h"

namespace drape {

namespace {

/// Returns whether contact proves nothing of a triangle, whose corners are in the order of cell_triangles.
bool is_left_out(const SeamCover::OfCloth& cloth, const std::array<std::uint32_t, 3>& corners) {
    const bool is_upper = corners[1] == corners[0] + 1;
    const std::uint32_t columns = is_upper ? corners[2] - corners[0] : corners[1] - corners[0];
    const std::uint32_t first = is_upper ? corners[0] : corners[0] - 1;
    const std::size_t cell = std::size_t{first / columns} * (columns - 1) + first % columns;
    const std::uint32_t which = is_upper ? upper_triangle : lower_triangle;
    return ((cloth.never[cell] | cloth.closing[cell]) & which) != 0;
}

}  // namespace

SeamCover::SeamCover(const SceneDescription& scene) {
    if (scene.seams.empty()) return;
    sewing = sewing_of(scene);
    lead(scene);
    leave_out(scene);
}

void SeamCover::join(std::size_t one, std::size_t other) {
    const std::size_t first = std::min(cloths[one].body, cloths[other].body),
                      last = std::max(cloths[one].body, cloths[other].body);
    for (OfCloth& each : cloths)
        if (each.body == last) each.body = first;
}

void SeamCover::lead(const SceneDescription& scene) {
    for (std::size_t cloth = 0; cloth < scene.cloths.size(); ++cloth) {
        const std::uint32_t count = scene.cloths[cloth].grid[0] * scene.cloths[cloth].grid[1];
        OfCloth& own = cloths.emplace_back();
        own.body = cloth;
        own.sewn.resize(count);
        for (std::uint32_t particle = 0; particle < count; ++particle) own.leaders.push_back({cloth, particle});
    }
    const auto follow = [&](const SewnGroup& group) {
        for (const SewnMember& member : group) {
            cloths[member.cloth].leaders[member.particle] = group.front();
            cloths[member.cloth].sewn[member.particle] = true;
            join(group.front().cloth, member.cloth);
        }
    };
    for (const SewnStation& station : sewing.stations) follow(station.group);
    for (const SewnBetween& each : sewing.between) {
        follow(each.group);
        for (const std::size_t station : each.stations)
            join(sewing.stations[station].group.front().cloth, each.group.front().cloth);
    }
}

void SeamCover::leave_out(const SceneDescription& scene) {
    std::map<SewnMember, double> closed;
    std::map<SewnMember, bool> between;
    for (const auto& [group, close, rip] : sewing.stations)
        for (const SewnMember& member : group) closed[member] = close;
    for (const SewnBetween& each : sewing.between)
        for (const SewnMember& member : each.group) between[member] = true;
    for (std::size_t cloth = 0; cloth < cloths.size(); ++cloth) {
        OfCloth& own = cloths[cloth];
        const std::vector<std::uint32_t> triangles = cell_triangles(scene.cloths[cloth]);
        own.never.resize(triangles.size()), own.closing.resize(triangles.size()), own.until.resize(triangles.size());
        const std::uint32_t columns = scene.cloths[cloth].grid[0];
        const auto judge = [&](std::size_t cell, std::uint32_t which, const std::array<std::uint32_t, 3>& corners) {
            if ((triangles[cell] & which) == 0) return;
            double until = 0;
            bool never = false;
            for (std::size_t k = 0; k < 3; ++k) {
                const SewnMember corner{cloth, corners[k]};
                never =
                    never || between.contains(corner) || own.leaders[corners[k]] == own.leaders[corners[(k + 1) % 3]];
                if (const auto found = closed.find(corner); found != closed.end())
                    until = std::max(until, found->second);
            }
            if (never) own.never[cell] |= which, ++own.never_count;
            if (never || until == 0) return;
            own.closing[cell] |= which, ++own.closing_count;
            own.until[cell] = std::max(own.until[cell], until);
        };
        for (std::size_t cell = 0; cell < triangles.size(); ++cell) {
            const auto first = static_cast<std::uint32_t>(cell / (columns - 1) * columns + cell % (columns - 1));
            const std::uint32_t below = first + columns;
            judge(cell, upper_triangle, {first, first + 1, below});
            judge(cell, lower_triangle, {first + 1, below + 1, below});
        }
    }
}

std::vector<std::uint32_t> SeamCover::joined(const std::vector<std::size_t>& which) const {
    std::map<std::size_t, std::uint32_t> first;
    std::uint32_t count = 0;
    for (const std::size_t cloth : which) {
        first.emplace(cloth, count);
        count += static_cast<std::uint32_t>(cloths[cloth].leaders.size());
    }
    std::vector<std::uint32_t> same(count);
    std::map<SewnMember, std::uint32_t> found;
    for (const std::size_t cloth : which)
        for (std::uint32_t particle = 0; particle < cloths[cloth].leaders.size(); ++particle) {
            const std::uint32_t own = first.at(cloth) + particle;
            same[own] = found.try_emplace(cloths[cloth].leaders[particle], own).first->second;
        }
    return same;
}

std::vector<std::uint32_t> SeamCover::covered(std::size_t cloth, const std::vector<std::uint32_t>& triangles) const {
    if (cloths.empty()) return triangles;
    const OfCloth& own = cloths[cloth];
    std::vector<std::uint32_t> left;
    for (std::size_t k = 0; k + 2 < triangles.size(); k += 3) {
        const std::array<std::uint32_t, 3> corners{triangles[k], triangles[k + 1], triangles[k + 2]};
        if (!is_left_out(own, corners)) left.insert(left.end(), corners.begin(), corners.end());
    }
    return left;
}

}  // namespace drape
