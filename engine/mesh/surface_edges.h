// How the triangles of a surface meet at its edges.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "mesh/triangle_tree.h"

namespace drape {

class SurfaceEdges {
  public:
    using Edge = std::pair<std::uint32_t, std::uint32_t>;
    struct Use {
        Edge edge;  ///< its vertices, the lower number first
        std::uint32_t triangle;
        bool forward;  ///< the triangle goes from the lower number to the other one
    };

    explicit SurfaceEdges(std::span<const Triangle> triangles) {
        uses_.reserve(3 * triangles.size());
        for (std::uint32_t k = 0; k < triangles.size(); ++k)
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const std::uint32_t a = triangles[k][corner], b = triangles[k][(corner + 1) % 3];
                uses_.push_back({{std::min(a, b), std::max(a, b)}, k, a < b});
            }
        std::ranges::sort(uses_, {}, [](const Use& use) { return std::pair(use.edge, use.triangle); });
    }

    /// Calls `see(uses)` for every edge with the triangles that have it.
    template <class See>
    void each(const See& see) const {
        for (std::size_t first = 0; first < uses_.size();) {
            std::size_t end = first;
            while (end < uses_.size() && uses_[end].edge == uses_[first].edge) ++end;
            see(std::span(uses_).subspan(first, end - first));
            first = end;
        }
    }

    /// Returns how many more of the triangles go forward than backward.
    static int net(std::span<const Use> uses) {
        int sum = 0;
        for (const Use& use : uses) sum += use.forward ? 1 : -1;
        return sum;
    }

  private:
    std::vector<Use> uses_;
};

}  // namespace drape
