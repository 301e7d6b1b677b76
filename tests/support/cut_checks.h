// Invariants of a cut cloth, checked from its images and draw lists alone.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <vector>

#include "cloth/cut_topology.h"
#include "cloth/directions.h"

namespace drape::test {

inline double number(float x) { return static_cast<double>(x); }

inline std::size_t piece_count(const CutTopology& topology) {
    const std::vector<std::size_t> roots = pieces_of(topology);
    return std::set<std::size_t>(roots.begin(), roots.end()).size();
}

inline int cut_edge_count(const CutTopology& topology, const std::uint32_t* corner) {
    int count = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = std::min(corner[k], corner[(k + 1) % 3]), b = std::max(corner[k], corner[(k + 1) % 3]);
        const std::uint32_t columns = topology.cloth().grid.columns();
        const bool in_row = a / columns == b / columns;
        const std::size_t direction = in_row ? 0 : b - a == columns ? 1 : 3;
        count += topology.cut_fraction(a, direction) >= 0;
    }
    return count;
}

inline Vec3 evaluate(const glsl::CutVertex& vertex, const std::vector<glsl::vec4>& position) {
    const auto at = [&](std::uint32_t k) {
        return Vec3{number(position[k].x), number(position[k].y), number(position[k].z)};
    };
    const Vec3 anchor = at(vertex.particles.x), first = at(vertex.particles.y), second = at(vertex.particles.z);
    const double offset[3] = {number(vertex.offset.x), number(vertex.offset.y), number(vertex.offset.z)};
    Vec3 result;
    for (std::size_t k = 0; k < 3; ++k)
        result[k] = anchor[k] + number(vertex.weights.x) * (first[k] - anchor[k]) +
                    number(vertex.weights.y) * (second[k] - anchor[k]) + offset[k];
    return result;
}

/// Expects that no index is out of range; that no drawn triangle spans a cut: the particles that it hangs on are one
/// piece, and a whole triangle has at most one cut edge (a slit's end); that a spring has the uncut one's share or
/// none; that a cut spring has share 0; that no diagonal joins the corners of a cell that the mesh has let go.
inline void expect_consistent(const CutTopology& topology) {
    const std::vector<std::size_t> piece = pieces_of(topology);
    const std::size_t particle_count = topology.cloth().grid.particle_count();
    const std::vector<std::uint32_t>& indices = topology.indices();
    ASSERT_EQ(indices.size() % 3, 0u);
    const auto anchor = [&](std::uint32_t index) {
        return index < particle_count ? index : topology.vertices()[index - particle_count].particles.x;
    };
    for (std::size_t k = 0; k < indices.size(); k += 3) {
        for (std::size_t c = 0; c < 3; ++c) ASSERT_LT(indices[k + c], particle_count + topology.vertices().size());
        ASSERT_EQ(piece[anchor(indices[k])], piece[anchor(indices[k + 1])]);
        ASSERT_EQ(piece[anchor(indices[k])], piece[anchor(indices[k + 2])]);
        const bool whole = indices[k] != indices[k + 1] && indices[k] < particle_count &&
                           indices[k + 1] < particle_count && indices[k + 2] < particle_count;
        if (whole) {
            ASSERT_LE(cut_edge_count(topology, &indices[k]), 1);
        }
    }
    for (const glsl::CutVertex& vertex : topology.vertices()) {
        ASSERT_LT(std::max(vertex.particles.y, vertex.particles.z), particle_count);
        ASSERT_EQ(piece[vertex.particles.x], piece[vertex.particles.y]) << "own side's particles alone";
        ASSERT_EQ(piece[vertex.particles.x], piece[vertex.particles.z]);
    }
    if (!topology.masked()) return;
    for (std::size_t particle = 0; particle < particle_count; ++particle) {
        const Grid& uncut = topology.cloth().grid;
        const auto column = static_cast<std::uint32_t>(particle % uncut.columns());
        const auto row = static_cast<std::uint32_t>(particle / uncut.columns());
        const glsl::vec4 &s = topology.spring_shares()[particle], u = uncut.spring_shares(column, row);
        const float shares[4] = {s.x, s.y, s.z, s.w}, whole[4] = {u.x, u.y, u.z, u.w};
        for (std::size_t k = 0; k < 4; ++k) {
            ASSERT_TRUE(shares[k] == 0 || shares[k] == whole[k]);
            if (topology.cut_fraction(particle, k) >= 0) {
                ASSERT_EQ(shares[k], 0.0f);
            }
        }
    }
}

}  // namespace drape::test
