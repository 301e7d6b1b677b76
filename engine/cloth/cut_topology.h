// Cuts change these things of a cloth, and nothing else: which springs, triangles and tethers there are, and how the
// cut triangles are drawn. The device finds the crossings, this keeps both sides consistent.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "cloth/cloth_geometry.h"
#include "shared/cut_types.h"

namespace drape {

/// The cut pass found this at the end of a frame.
struct CutFindings {
    std::vector<std::uint32_t> triangle_flags;  ///< 2 per cell, row by row: upper, lower; 1 = intersects a cutter
    std::vector<glsl::vec4> fractions;          ///< per particle: fraction along each owned spring, -1 = not crossed
};

struct CutCounts {
    std::uint32_t springs = 0;    ///< cut now
    std::uint32_t triangles = 0;  ///< split now: gone from the whole ones
    std::uint32_t torn = 0;       ///< of the springs, those that were torn
    std::uint32_t pieces = 0;     ///< pieces that there are now, crumbs among them
    std::uint32_t crumbs = 0;     ///< crumbs that there are now
    bool any() const { return springs > 0; }
};

/// A piece that was cut off and has less than so many triangles of the grid is a crumb; a cloth's largest is none.
constexpr double crumb_triangles = 4;

class CutTopology {
  public:
    /// Makes the topology of uncut cloth. `cloth` must outlive it.
    explicit CutTopology(const ClothGeometry& cloth);

    /// Cuts the springs that were crossed (their shares become 0), and the cell's other diagonal where its corners no
    /// longer hang together; triangles with two or three cut edges leave the cells and are split for drawing. A
    /// triangle with one cut edge is the end of a slit: it stays whole. Masses stay; tethers end: what was cut off no
    /// longer hangs on what holds the rest. From the first findings on the cloth is masked, whether they cut or not.
    CutCounts apply(const CutFindings& findings);
    /// Cuts one spring, nothing else. Returns false when there is none.
    bool cut_spring(std::size_t particle, std::size_t direction, float fraction);

    const ClothGeometry& cloth() const { return *cloth_; }
    /// Returns whether spring shares and cells need images.
    bool masked() const { return !spring_shares_.empty(); }
    /// Returns the share of the stiffness per direction, by first particle; empty unless masked.
    const std::vector<glsl::vec4>& spring_shares() const { return cloth_->stiffens ? acting_shares_ : spring_shares_; }
    /// Returns them as they are where the factor of a stiffness that changes is 1.
    const std::vector<glsl::vec4>& whole_spring_shares() const { return spring_shares_; }
    /// Takes the factor of a stiffness that changes.
    void set_stiffness(float factor);
    /// Returns the cells that are there now.
    const Grid& grid() const { return grid_; }
    const std::vector<glsl::ParticleTethers>& tethers() const { return tethers_; }

    /// Returns three indices per triangle: each triangle of the uncut grid at its own place (its first index three
    /// times once it is split), then the parts of split triangles. Indices from particle_count on are `vertices()`.
    /// Triangles of crumbs are left out too, unless the scene shows them.
    const std::vector<std::uint32_t>& indices() const { return indices_; }
    const std::vector<glsl::CutVertex>& vertices() const { return vertices_; }
    /// Returns the drawn whole triangles alone, as exported: particle indices.
    std::vector<std::uint32_t> whole_triangles() const;
    /// Returns the area at rest, m^2, of whole triangles and parts, crumbs and all; cutting does not change it.
    double rest_area() const;
    std::uint32_t crumb_count() const { return crumb_count_; }
    /// Returns the fraction along an owned spring where it was cut; -1 when it was not.
    float cut_fraction(std::size_t particle, std::size_t direction) const;

  private:
    struct Triangle;

    Triangle triangle(std::size_t cell, std::uint32_t which) const;
    void make_masked();
    bool diagonal_holds(std::size_t cell) const;
    CutCounts take_crossings(const CutFindings& findings);
    std::uint32_t split_triangles();
    void rebuild_drawing();
    double rest_area_of(std::size_t drawn) const;
    /// Counts crumbs, and leaves them out of what is drawn where they are not to be seen.
    void find_crumbs();
    void add_parts(const Triangle& triangle);
    void add_isolated_corners(const Triangle& triangle);
    std::uint32_t edge_vertex(std::uint32_t anchor, std::uint32_t other, float fraction);
    std::uint32_t add_vertex(std::uint32_t anchor, std::array<double, 2> material);
    std::array<double, 2> material(std::uint32_t vertex) const;

    const ClothGeometry* cloth_;
    Grid grid_;
    std::vector<glsl::vec4> spring_shares_;
    std::vector<glsl::vec4> acting_shares_;  ///< of a cloth that stiffens: with the factor of the frame
    std::vector<glsl::ParticleTethers> tethers_;
    std::vector<glsl::vec4> cuts_;  ///< per particle and direction: fraction, -1 = not cut
    std::vector<std::uint32_t> indices_;
    std::vector<glsl::CutVertex> vertices_;
    std::unordered_map<std::uint64_t, std::uint32_t> edge_vertices_;  ///< (anchor, other) -> vertex
    std::uint32_t crumb_count_ = 0;
    double left_out_area_ = 0;             ///< m^2 of crumbs, at rest
    std::size_t grid_triangle_count_ = 0;  ///< triangles in `indices_` that have a place of their own
};

/// Returns the rows of the image of spring shares: the shares of a row and, where the cloth has a shape of rest, the
/// scales of its springs' lengths behind them (shaders/include/rest_length.h).
std::vector<glsl::vec4> spring_texels(const CutTopology& topology);
/// Returns for each particle the number of one particle of its piece, the same for all that springs hold together.
std::vector<std::size_t> pieces_of(const CutTopology& topology);

/// Returns cutters' triangles for the frame that ends at `frame_end` and began at `frame_start` (s), room for
/// cutter_triangle_count per cutter, those that cut first; the others have a.w = 0. At frame 0 both times are 0.
std::vector<glsl::CutterTriangle> cutter_triangles(const std::vector<Cutter>& cutters, double frame_start,
                                                   double frame_end);
/// Returns whether any cutter is active between the two times.
bool cutters_active(const std::vector<Cutter>& cutters, double frame_start, double frame_end);

}  // namespace drape
