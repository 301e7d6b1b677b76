// What contact between cloths makes of seams. Pure.
#pragma once

#include <cstdint>
#include <vector>

#include "drape/scene.h"
#include "world/seams.h"

namespace drape {

/// Corners that are one, and triangles that meet nothing: those with a corner between two others, which lie on edges of
/// the other side, and those of which two corners are one; those of seams that close, until they have.
struct SeamCover {
    explicit SeamCover(const SceneDescription& scene);

    struct OfCloth {
        std::vector<SewnMember> leaders;     ///< by particle: the one that it follows, itself where it follows none
        std::vector<bool> sewn;              ///< by particle
        std::vector<std::uint32_t> never;    ///< by cell: upper_triangle and lower_triangle, where left out for good
        std::vector<std::uint32_t> closing;  ///< by cell: the same, where left out until
        std::vector<double> until;           ///< by cell, s
        std::size_t body = 0;                ///< the first of the cloths that it is sewn to, or itself
        std::size_t never_count = 0, closing_count = 0;  ///< triangles
    };
    std::vector<OfCloth> cloths;  ///< by cloth; empty: the scene has no seams
    Sewing sewing;

    bool are_sewn(std::size_t one, std::size_t other) const {
        return !cloths.empty() && cloths[one].body == cloths[other].body;
    }
    /// Returns, by point of all these cloths in turn, the first one that is the same.
    std::vector<std::uint32_t> joined(const std::vector<std::size_t>& which) const;
    /// Returns those of a cloth's triangles, of three particles each, of which contact proves that none crosses
    /// another: without those that are left out, and those of seams that close, since they may cross before they meet.
    std::vector<std::uint32_t> covered(std::size_t cloth, const std::vector<std::uint32_t>& triangles) const;

  private:
    void lead(const SceneDescription& scene);
    void leave_out(const SceneDescription& scene);
    void join(std::size_t one, std::size_t other);
};

}  // namespace drape
