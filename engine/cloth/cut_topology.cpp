#include "cloth/cut_topology.h"

#include <algorithm>
#include <numeric>

#include "cloth/directions.h"
#include "cloth/texels.h"

namespace drape {

namespace {

/// A union-find of four tells which corners of a cell hang together.
class Corners {
  public:
    void join(std::size_t a, std::size_t b) { parent_[root(a)] = root(b); }
    bool joined(std::size_t a, std::size_t b) const { return root(a) == root(b); }

  private:
    std::size_t root(std::size_t k) const { return parent_[k] == k ? k : root(parent_[k]); }
    std::array<std::size_t, 4> parent_{0, 1, 2, 3};
};

/// Returns the fraction from one corner to the other where the edge between them is cut, -1: whole.
float edge_cut(const CutTopology& topology, std::uint32_t from, std::uint32_t to) {
    const std::uint32_t columns = topology.grid().columns();
    // Mesh edges are row, column and down-left springs, owned by the particle of lower index.
    const std::uint32_t owner = std::min(from, to), step = std::max(from, to) - owner;
    const bool in_row = step == 1 && owner % columns + 1 < columns;  // in two columns down-left is one on, too
    const std::size_t direction = in_row ? 0 : step == columns ? 1 : 3;
    const float fraction = topology.cut_fraction(owner, direction);
    return fraction < 0 ? -1 : owner == from ? fraction : 1 - fraction;
}

/// Returns how many pieces there are; particles without a cell are none.
std::uint32_t piece_count(const CutTopology& topology) {
    const std::vector<std::size_t> piece = pieces_of(topology);
    std::uint32_t count = 0;
    for (std::size_t k = 0; k < piece.size(); ++k) count += piece[k] == k && topology.cloth().free_weight[k] > 0;
    return count;
}

/// Returns, by particle, whether it stands for a piece (pieces_of) that a cut spring ends at.
std::vector<bool> beside_cuts(const CutTopology& topology, const std::vector<std::size_t>& piece) {
    std::vector<bool> beside(piece.size());
    for (std::size_t particle = 0; particle < piece.size(); ++particle)
        for (std::size_t k = 0; k < spring_directions.size(); ++k) {
            if (topology.cut_fraction(particle, k) < 0) continue;
            const glsl::ivec2 offset = spring_directions[k].offset;
            beside[piece[particle]] = true;
            beside[piece[particle + static_cast<std::size_t>(offset.y * topology.grid().size().x + offset.x)]] = true;
        }
    return beside;
}

}  // namespace

struct CutTopology::Triangle {
    std::array<std::uint32_t, 3> corner;
    std::array<float, 3> cut;  ///< fraction from corner k where the edge from corner k to k+1 is cut, -1 = whole
    int cut_count() const { return (cut[0] >= 0) + (cut[1] >= 0) + (cut[2] >= 0); }
};

CutTopology::CutTopology(const ClothGeometry& cloth)
    : cloth_(&cloth), grid_(cloth.grid), tethers_(cloth.tethers), cuts_(grid_.particle_count(), {-1, -1, -1, -1}) {
    if (cloth.starts_masked) make_masked();
    rebuild_drawing();
}

void CutTopology::make_masked() {
    if (masked()) return;
    for (std::uint32_t row = 0; row < grid_.rows(); ++row)
        for (std::uint32_t column = 0; column < grid_.columns(); ++column)
            spring_shares_.push_back(cloth_->grid.spring_shares(column, row));
    set_stiffness(cloth_->start_stiffness);
}

void CutTopology::set_stiffness(float factor) {
    if (!cloth_->stiffens) return;
    acting_shares_.clear();
    for (const glsl::vec4& share : spring_shares_)
        acting_shares_.push_back({share.x * factor, share.y * factor, share.z * factor, share.w * factor});
}

float CutTopology::cut_fraction(std::size_t particle, std::size_t direction) const {
    return component(cuts_[particle], direction);
}

CutTopology::Triangle CutTopology::triangle(std::size_t cell, std::uint32_t which) const {
    const auto row = static_cast<std::uint32_t>(cell / (grid_.columns() - 1));
    const auto column = static_cast<std::uint32_t>(cell % (grid_.columns() - 1));
    const std::uint32_t a = row * grid_.columns() + column, b = a + 1, c = a + grid_.columns(), d = c + 1;
    Triangle result{which == upper_triangle ? std::array{a, b, c} : std::array{b, d, c}, {}};
    for (std::size_t k = 0; k < 3; ++k) result.cut[k] = edge_cut(*this, result.corner[k], result.corner[(k + 1) % 3]);
    return result;
}

bool CutTopology::cut_spring(std::size_t particle, std::size_t direction, float fraction) {
    make_masked();
    float& share = component(spring_shares_[particle], direction);
    if (share == 0) return false;
    share = 0;
    if (cloth_->stiffens) component(acting_shares_[particle], direction) = 0;
    component(cuts_[particle], direction) = fraction;
    return true;
}

bool CutTopology::diagonal_holds(std::size_t cell) const {
    const Triangle upper = triangle(cell, upper_triangle), lower = triangle(cell, lower_triangle);
    Corners corners;  // a b c d are 0 1 2 3
    if (cloth_->grid.cells()[cell] & upper_triangle) {
        if (upper.cut[0] < 0) corners.join(0, 1);
        if (upper.cut[1] < 0) corners.join(1, 2);
        if (upper.cut[2] < 0) corners.join(2, 0);
    }
    if (cloth_->grid.cells()[cell] & lower_triangle) {
        if (lower.cut[0] < 0) corners.join(1, 3);
        if (lower.cut[1] < 0) corners.join(3, 2);
        if (lower.cut[2] < 0) corners.join(2, 1);
    }
    return corners.joined(0, 3);
}

CutCounts CutTopology::take_crossings(const CutFindings& findings) {
    CutCounts counts;
    for (std::size_t particle = 0; particle < cuts_.size(); ++particle)
        for (std::size_t direction = 0; direction < spring_directions.size(); ++direction) {
            const float fraction = component(findings.fractions[particle], direction);
            if (fraction >= 0 && cut_spring(particle, direction, std::clamp(fraction, 0.0f, 1.0f))) ++counts.springs;
        }
    if (counts.springs == 0) return counts;
    // The down-right diagonal is no edge of the mesh: it must not join what the mesh has let go.
    for (std::size_t cell = 0; cell < cloth_->grid.cells().size(); ++cell) {
        const std::size_t particle = cell / (grid_.columns() - 1) * grid_.columns() + cell % (grid_.columns() - 1);
        if (cloth_->grid.cells()[cell] != 0 && component(spring_shares_[particle], 2) != 0 && !diagonal_holds(cell))
            counts.springs += cut_spring(particle, 2, 0.5f);
    }
    return counts;
}

std::uint32_t CutTopology::split_triangles() {
    std::uint32_t count = 0;
    for (std::size_t cell = 0; cell < cloth_->grid.cells().size(); ++cell)
        for (const std::uint32_t which : {upper_triangle, lower_triangle}) {
            if (!(grid_.cells()[cell] & which) || triangle(cell, which).cut_count() < 2) continue;
            grid_.remove_triangle(cell, which);
            ++count;
        }
    return count;
}

CutCounts CutTopology::apply(const CutFindings& findings) {
    make_masked();
    CutCounts counts = take_crossings(findings);
    if (!counts.any()) return counts;
    std::ranges::fill(tethers_, glsl::ParticleTethers{-1, -1, 0, 0});
    counts.triangles = split_triangles();
    rebuild_drawing();
    counts.pieces = piece_count(*this);
    counts.crumbs = crumb_count_;
    return counts;
}

void CutTopology::rebuild_drawing() {
    indices_.clear();
    vertices_.clear();
    edge_vertices_.clear();
    std::vector<Triangle> split;
    for (std::size_t cell = 0; cell < cloth_->grid.cells().size(); ++cell)
        for (const std::uint32_t which : {upper_triangle, lower_triangle}) {
            if (!(cloth_->grid.cells()[cell] & which)) continue;
            const Triangle drawn = triangle(cell, which);
            if (grid_.cells()[cell] & which) {
                indices_.insert(indices_.end(), drawn.corner.begin(), drawn.corner.end());
            } else {
                indices_.insert(indices_.end(), 3, drawn.corner[0]);
                split.push_back(drawn);
            }
        }
    grid_triangle_count_ = indices_.size() / 3;
    for (const Triangle& cut : split) add_parts(cut);
    crumb_count_ = 0;
    left_out_area_ = 0;
    if (!split.empty()) find_crumbs();  // a piece that is cut off has split triangles around it
}

void CutTopology::add_parts(const Triangle& cut) {
    if (cut.cut_count() == 3) return add_isolated_corners(cut);
    // One corner is alone: the one between the two cut edges.
    const std::size_t alone = cut.cut[0] < 0 ? 2 : cut.cut[1] < 0 ? 0 : 1;
    const std::uint32_t v = cut.corner[alone], next = cut.corner[(alone + 1) % 3], last = cut.corner[(alone + 2) % 3];
    const float to_next = cut.cut[alone], from_last = cut.cut[(alone + 2) % 3];
    indices_.insert(indices_.end(), {v, edge_vertex(v, next, to_next), edge_vertex(v, last, 1 - from_last)});
    const std::uint32_t at_next = edge_vertex(next, v, 1 - to_next);
    const std::uint32_t at_last = edge_vertex(last, v, from_last);
    indices_.insert(indices_.end(), {at_next, next, last, at_next, last, at_last});
}

void CutTopology::add_isolated_corners(const Triangle& cut) {
    // The three crossings' mean is a point that the three corners' parts share at rest.
    std::array<double, 2> middle{};
    for (std::size_t k = 0; k < 3; ++k) {
        const auto from = material(cut.corner[k]), to = material(cut.corner[(k + 1) % 3]);
        for (std::size_t axis = 0; axis < 2; ++axis)
            middle[axis] += (from[axis] + static_cast<double>(cut.cut[k]) * (to[axis] - from[axis])) / 3;
    }
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t before = (k + 2) % 3;
        const std::uint32_t v = cut.corner[k];
        const std::uint32_t out = edge_vertex(v, cut.corner[(k + 1) % 3], cut.cut[k]);
        const std::uint32_t in = edge_vertex(v, cut.corner[before], 1 - cut.cut[before]);
        const std::uint32_t centre = add_vertex(v, middle);
        indices_.insert(indices_.end(), {v, out, centre, v, centre, in});
    }
}

std::array<double, 2> CutTopology::material(std::uint32_t vertex) const {
    if (vertex >= grid_.particle_count()) {
        const glsl::vec4& at = vertices_[vertex - grid_.particle_count()].material;
        return {static_cast<double>(at.x), static_cast<double>(at.y)};
    }
    const auto column = vertex % grid_.columns(), row = vertex / grid_.columns();
    return {column * cloth_->spacing[0], row * cloth_->spacing[1]};
}

std::uint32_t CutTopology::edge_vertex(std::uint32_t anchor, std::uint32_t other, float fraction) {
    const auto [place, fresh] = edge_vertices_.try_emplace(std::uint64_t{anchor} << 32 | other);
    if (fresh) {
        const auto from = material(anchor), to = material(other);
        const auto f = static_cast<double>(fraction);
        place->second = add_vertex(anchor, {from[0] + f * (to[0] - from[0]), from[1] + f * (to[1] - from[1])});
    }
    return place->second;
}

std::uint32_t CutTopology::add_vertex(std::uint32_t anchor, std::array<double, 2> at) {
    // Own neighbours along the row and along the column span the surface around the anchor.
    const auto row_share = [&](std::uint32_t owner) { return spring_shares_[owner].x; };
    const auto column_share = [&](std::uint32_t owner) { return spring_shares_[owner].y; };
    const auto base = material(anchor);
    double rest_u = at[0] - base[0], rest_v = at[1] - base[1];
    glsl::CutVertex vertex{
        {anchor, anchor, anchor, 0}, {}, {}, {static_cast<float>(at[0]), static_cast<float>(at[1]), 0, 0}};
    const std::uint32_t column = anchor % grid_.columns(), row = anchor / grid_.columns();
    const bool right = column + 1 < grid_.columns() && row_share(anchor) != 0;
    const bool left = column > 0 && row_share(anchor - 1) != 0;
    if (right || left) {
        vertex.particles.y = right ? anchor + 1 : anchor - 1;
        vertex.weights.x = static_cast<float>(rest_u / (right ? cloth_->spacing[0] : -cloth_->spacing[0]));
        rest_u = 0;
    }
    const bool below = row + 1 < grid_.rows() && column_share(anchor) != 0;
    const bool above = row > 0 && column_share(anchor - grid_.columns()) != 0;
    if (below || above) {
        vertex.particles.z = below ? anchor + grid_.columns() : anchor - grid_.columns();
        vertex.weights.y = static_cast<float>(rest_v / (below ? cloth_->spacing[1] : -cloth_->spacing[1]));
        rest_v = 0;
    }
    // Directions that no own neighbour spans stay those of the start (the piece may be a single particle).
    const Vec3 u = cloth_->start_direction(anchor, 0), v = cloth_->start_direction(anchor, 1);
    const auto component = [&](std::size_t k) { return static_cast<float>(rest_u * u[k] + rest_v * v[k]); };
    vertex.offset = {component(0), component(1), component(2), 0};
    vertices_.push_back(vertex);
    return static_cast<std::uint32_t>(grid_.particle_count() + vertices_.size() - 1);
}

std::vector<std::uint32_t> CutTopology::whole_triangles() const {
    std::vector<std::uint32_t> whole;
    for (std::size_t k = 0; k < 3 * grid_triangle_count_; k += 3)
        if (indices_[k] != indices_[k + 1]) whole.insert(whole.end(), &indices_[k], &indices_[k] + 3);
    return whole;
}

double CutTopology::rest_area_of(std::size_t drawn) const {
    const auto a = material(indices_[drawn]), b = material(indices_[drawn + 1]), c = material(indices_[drawn + 2]);
    return ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])) / 2;
}

double CutTopology::rest_area() const {
    double sum = left_out_area_;
    for (std::size_t k = 0; k < indices_.size(); k += 3) sum += rest_area_of(k);
    return sum;
}

void CutTopology::find_crumbs() {
    const std::vector<std::size_t> piece = pieces_of(*this);
    const auto piece_of = [&](std::size_t drawn) {
        const std::uint32_t first = indices_[drawn];
        const std::size_t count = grid_.particle_count();
        return piece[first < count ? first : vertices_[first - count].particles.x];
    };
    std::vector<double> areas(piece.size());
    for (std::size_t k = 0; k < indices_.size(); k += 3) areas[piece_of(k)] += rest_area_of(k);
    const double largest = *std::ranges::max_element(areas);
    // The bound is a hair less: four triangles cut along their edges are no crumb, however their sum was rounded.
    const double least = (1 - 1e-9) * crumb_triangles * cloth_->spacing[0] * cloth_->spacing[1] / 2;
    std::vector<bool> crumb = beside_cuts(*this, piece);
    for (std::size_t k = 0; k < piece.size(); ++k) crumb[k] = crumb[k] && areas[k] < std::min(least, largest);
    crumb_count_ = static_cast<std::uint32_t>(std::ranges::count(crumb, true));
    if (crumb_count_ == 0 || cloth_->shows_crumbs) return;
    std::size_t kept = 0;
    for (std::size_t k = 0; k < indices_.size(); k += 3) {
        const bool in_place = k < 3 * grid_triangle_count_;
        if (crumb[piece_of(k)]) {
            left_out_area_ += rest_area_of(k);
            if (!in_place) continue;
            std::fill_n(&indices_[k], 3, indices_[k]);
        }
        std::copy_n(&indices_[k], 3, &indices_[kept]);
        kept += 3;
    }
    indices_.resize(kept);
}

std::vector<glsl::vec4> spring_texels(const CutTopology& topology) {
    const std::vector<glsl::vec4>&scales = topology.cloth().rest_scales, &shares = topology.spring_shares();
    if (scales.empty()) return shares;
    const std::uint32_t columns = topology.grid().columns();
    std::vector<glsl::vec4> texels;
    for (std::size_t first = 0; first < shares.size(); first += columns)
        for (const std::vector<glsl::vec4>* values : {&shares, &scales})
            for (std::size_t i = first; i < first + columns; ++i) texels.push_back((*values)[i]);
    return texels;
}

std::vector<std::size_t> pieces_of(const CutTopology& topology) {
    const Grid& grid = topology.grid();
    std::vector<std::size_t> parent(grid.particle_count());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](std::size_t k) {
        while (parent[k] != k) k = parent[k] = parent[parent[k]];
        return k;
    };
    for (std::uint32_t row = 0; row < grid.rows(); ++row)
        for (std::uint32_t column = 0; column < grid.columns(); ++column) {
            const std::size_t here = grid.particle(column, row);
            const glsl::vec4 share = topology.masked() ? topology.whole_spring_shares()[here]
                                                       : topology.cloth().grid.spring_shares(column, row);
            for (std::size_t k = 0; k < spring_directions.size(); ++k) {
                const glsl::ivec2 offset = spring_directions[k].offset;
                const int x = static_cast<int>(column) + offset.x, y = static_cast<int>(row) + offset.y;
                if (component(share, k) == 0 || x < 0 || x >= grid.size().x || y >= grid.size().y) continue;
                parent[root(here)] = root(grid.particle(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)));
            }
        }
    for (std::size_t k = 0; k < parent.size(); ++k) parent[k] = root(k);
    return parent;
}

}  // namespace drape
