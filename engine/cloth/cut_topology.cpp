#include "cloth/cut_topology.h"

#include <algorithm>

#include "cloth/directions.h"

namespace drape {

namespace {

float& channel(glsl::vec4& v, std::size_t k) { return k == 0 ? v.x : k == 1 ? v.y : k == 2 ? v.z : v.w; }
float channel(const glsl::vec4& v, std::size_t k) { return k == 0 ? v.x : k == 1 ? v.y : k == 2 ? v.z : v.w; }

/// Which corners of a cell hang together: a union-find of four.
class Corners {
  public:
    void join(std::size_t a, std::size_t b) { parent_[root(a)] = root(b); }
    bool joined(std::size_t a, std::size_t b) const { return root(a) == root(b); }

  private:
    std::size_t root(std::size_t k) const { return parent_[k] == k ? k : root(parent_[k]); }
    std::array<std::size_t, 4> parent_{0, 1, 2, 3};
};

}  // namespace

CutTopology::CutTopology(const Cloth& cloth, const ClothModel& model)
    : world_u_(cloth.placement.u),
      world_v_(cloth.placement.v),
      columns_(model.grid.columns()),
      rows_(model.grid.rows()),
      original_cells_(model.grid.cells()),
      cuts_(model.grid.particle_count(), {-1, -1, -1, -1}) {
    rebuild_drawing(model);
}

float CutTopology::cut_fraction(std::size_t particle, std::size_t direction) const {
    return channel(cuts_[particle], direction);
}

float CutTopology::edge_cut(std::uint32_t from, std::uint32_t to) const {
    // Mesh edges are row, column and down-left springs, owned by the particle of lower index.
    const std::uint32_t owner = std::min(from, to), step = std::max(from, to) - owner;
    const std::size_t direction = step == 1 ? 0 : step == columns_ ? 1 : 3;
    const float fraction = channel(cuts_[owner], direction);
    return fraction < 0 ? -1 : owner == from ? fraction : 1 - fraction;
}

CutTopology::Triangle CutTopology::triangle(std::size_t cell, std::uint32_t which) const {
    const auto row = static_cast<std::uint32_t>(cell / (columns_ - 1));
    const auto column = static_cast<std::uint32_t>(cell % (columns_ - 1));
    const std::uint32_t a = row * columns_ + column, b = a + 1, c = a + columns_, d = c + 1;
    Triangle result{which == upper_triangle ? std::array{a, b, c} : std::array{b, d, c}, {}};
    for (std::size_t k = 0; k < 3; ++k) result.cut[k] = edge_cut(result.corner[k], result.corner[(k + 1) % 3]);
    return result;
}

bool CutTopology::cut_spring(ClothModel& model, std::size_t particle, std::size_t direction, float fraction) {
    float& share = channel(model.stiffness[particle], direction);
    if (share == 0) return false;
    share = 0;
    channel(cuts_[particle], direction) = fraction;
    return true;
}

bool CutTopology::diagonal_holds(std::size_t cell) const {
    const Triangle upper = triangle(cell, upper_triangle), lower = triangle(cell, lower_triangle);
    Corners corners;  // a b c d = 0 1 2 3
    if (original_cells_[cell] & upper_triangle) {
        if (upper.cut[0] < 0) corners.join(0, 1);
        if (upper.cut[1] < 0) corners.join(1, 2);
        if (upper.cut[2] < 0) corners.join(2, 0);
    }
    if (original_cells_[cell] & lower_triangle) {
        if (lower.cut[0] < 0) corners.join(1, 3);
        if (lower.cut[1] < 0) corners.join(3, 2);
        if (lower.cut[2] < 0) corners.join(2, 1);
    }
    return corners.joined(0, 3);
}

CutCounts CutTopology::take_crossings(ClothModel& model, const CutFindings& findings) {
    CutCounts counts;
    for (std::size_t particle = 0; particle < cuts_.size(); ++particle)
        for (std::size_t direction = 0; direction < spring_directions.size(); ++direction) {
            const float fraction = channel(findings.fractions[particle], direction);
            if (fraction >= 0 && cut_spring(model, particle, direction, std::clamp(fraction, 0.0f, 1.0f)))
                ++counts.springs;
        }
    if (counts.springs == 0) return counts;
    // The down-right diagonal is no edge of the mesh: it must not join what the mesh has let go.
    for (std::size_t cell = 0; cell < original_cells_.size(); ++cell) {
        const std::size_t particle = cell / (columns_ - 1) * columns_ + cell % (columns_ - 1);
        if (original_cells_[cell] != 0 && channel(model.stiffness[particle], 2) != 0 && !diagonal_holds(cell))
            counts.springs += cut_spring(model, particle, 2, 0.5f);
    }
    return counts;
}

std::uint32_t CutTopology::split_triangles(ClothModel& model) {
    std::uint32_t count = 0;
    for (std::size_t cell = 0; cell < original_cells_.size(); ++cell)
        for (const std::uint32_t which : {upper_triangle, lower_triangle}) {
            if (!(model.grid.cells()[cell] & which) || triangle(cell, which).cut_count() < 2) continue;
            model.grid.remove_triangle(cell, which);
            ++count;
        }
    return count;
}

CutCounts CutTopology::apply(ClothModel& model, const CutFindings& findings) {
    model.make_masked();
    CutCounts counts = take_crossings(model, findings);
    if (!counts.any()) return counts;
    model.drop_tethers();
    counts.triangles = split_triangles(model);
    rebuild_drawing(model);
    return counts;
}

void CutTopology::rebuild_drawing(const ClothModel& model) {
    indices_.clear();
    vertices_.clear();
    edge_vertices_.clear();
    std::vector<Triangle> split;
    for (std::size_t cell = 0; cell < original_cells_.size(); ++cell)
        for (const std::uint32_t which : {upper_triangle, lower_triangle}) {
            if (!(original_cells_[cell] & which)) continue;
            const Triangle drawn = triangle(cell, which);
            if (model.grid.cells()[cell] & which) {
                indices_.insert(indices_.end(), drawn.corner.begin(), drawn.corner.end());
            } else {
                indices_.insert(indices_.end(), 3, drawn.corner[0]);
                split.push_back(drawn);
            }
        }
    for (const Triangle& cut : split) add_parts(model, cut);
}

void CutTopology::add_parts(const ClothModel& model, const Triangle& cut) {
    if (cut.cut_count() == 3) return add_isolated_corners(model, cut);
    // One corner is alone: the one between the two cut edges.
    const std::size_t alone = cut.cut[0] < 0 ? 2 : cut.cut[1] < 0 ? 0 : 1;
    const std::uint32_t v = cut.corner[alone], next = cut.corner[(alone + 1) % 3], last = cut.corner[(alone + 2) % 3];
    const float to_next = cut.cut[alone], from_last = cut.cut[(alone + 2) % 3];
    indices_.insert(indices_.end(),
                    {v, edge_vertex(model, v, next, to_next), edge_vertex(model, v, last, 1 - from_last)});
    const std::uint32_t at_next = edge_vertex(model, next, v, 1 - to_next);
    const std::uint32_t at_last = edge_vertex(model, last, v, from_last);
    indices_.insert(indices_.end(), {at_next, next, last, at_next, last, at_last});
}

void CutTopology::add_isolated_corners(const ClothModel& model, const Triangle& cut) {
    // The three crossings' mean is a point that the three corners' parts share at rest.
    std::array<double, 2> middle{};
    for (std::size_t k = 0; k < 3; ++k) {
        const auto from = material(model, cut.corner[k]), to = material(model, cut.corner[(k + 1) % 3]);
        for (std::size_t axis = 0; axis < 2; ++axis)
            middle[axis] += (from[axis] + static_cast<double>(cut.cut[k]) * (to[axis] - from[axis])) / 3;
    }
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t before = (k + 2) % 3;
        const std::uint32_t v = cut.corner[k];
        const std::uint32_t out = edge_vertex(model, v, cut.corner[(k + 1) % 3], cut.cut[k]);
        const std::uint32_t in = edge_vertex(model, v, cut.corner[before], 1 - cut.cut[before]);
        const std::uint32_t centre = add_vertex(model, v, middle);
        indices_.insert(indices_.end(), {v, out, centre, v, centre, in});
    }
}

std::array<double, 2> CutTopology::material(const ClothModel& model, std::uint32_t vertex) const {
    if (vertex >= model.grid.particle_count()) {
        const glsl::vec4& at = vertices_[vertex - model.grid.particle_count()].material;
        return {static_cast<double>(at.x), static_cast<double>(at.y)};
    }
    return {vertex % columns_ * model.spacing[0], vertex / columns_ * model.spacing[1]};
}

std::uint32_t CutTopology::edge_vertex(const ClothModel& model, std::uint32_t anchor, std::uint32_t other,
                                       float fraction) {
    const auto [place, fresh] = edge_vertices_.try_emplace(std::uint64_t{anchor} << 32 | other);
    if (fresh) {
        const auto from = material(model, anchor), to = material(model, other);
        const auto f = static_cast<double>(fraction);
        place->second = add_vertex(model, anchor, {from[0] + f * (to[0] - from[0]), from[1] + f * (to[1] - from[1])});
    }
    return place->second;
}

std::uint32_t CutTopology::add_vertex(const ClothModel& model, std::uint32_t anchor, std::array<double, 2> at) {
    // Own neighbours along the row and along the column span the surface around the anchor.
    const auto row_share = [&](std::uint32_t owner) { return model.stiffness[owner].x; };
    const auto column_share = [&](std::uint32_t owner) { return model.stiffness[owner].y; };
    const auto base = material(model, anchor);
    double rest_u = at[0] - base[0], rest_v = at[1] - base[1];
    glsl::CutVertex vertex{
        {anchor, anchor, anchor, 0}, {}, {}, {static_cast<float>(at[0]), static_cast<float>(at[1]), 0, 0}};
    const std::uint32_t column = anchor % columns_, row = anchor / columns_;
    const bool right = column + 1 < columns_ && row_share(anchor) != 0, left = column > 0 && row_share(anchor - 1) != 0;
    if (right || left) {
        vertex.particles.y = right ? anchor + 1 : anchor - 1;
        vertex.weights.x = static_cast<float>(rest_u / (right ? model.spacing[0] : -model.spacing[0]));
        rest_u = 0;
    }
    const bool below = row + 1 < rows_ && column_share(anchor) != 0;
    const bool above = row > 0 && column_share(anchor - columns_) != 0;
    if (below || above) {
        vertex.particles.z = below ? anchor + columns_ : anchor - columns_;
        vertex.weights.y = static_cast<float>(rest_v / (below ? model.spacing[1] : -model.spacing[1]));
        rest_v = 0;
    }
    // What no own neighbour spans keeps its direction of the rest pose (the piece may be a single particle).
    const auto component = [&](std::size_t k) {
        return static_cast<float>(rest_u * world_u_[k] + rest_v * world_v_[k]);
    };
    vertex.offset = {component(0), component(1), component(2), 0};
    vertices_.push_back(vertex);
    return static_cast<std::uint32_t>(model.grid.particle_count() + vertices_.size() - 1);
}

std::vector<std::uint32_t> CutTopology::whole_triangles(const ClothModel& model) const {
    return model.grid.triangle_indices();
}

double CutTopology::drawn_rest_area(const ClothModel& model) const {
    double doubled = 0;
    for (std::size_t k = 0; k < indices_.size(); k += 3) {
        const auto a = material(model, indices_[k]), b = material(model, indices_[k + 1]),
                   c = material(model, indices_[k + 2]);
        doubled += (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
    }
    return doubled / 2;
}

}  // namespace drape
