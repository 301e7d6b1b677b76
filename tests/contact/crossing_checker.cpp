#include "crossing_checker.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace drape::test {

namespace {

/// A sum of doubles that is never rounded: its parts do not overlap, the smallest comes first (Shewchuk 1997, "Adaptive
/// Precision Floating-Point Arithmetic", grow-expansion).
class ExactSum {
  public:
    void add(double value) {
        for (std::size_t i = 0; i < count_; ++i) {
            const double sum = parts_[i] + value, back = sum - parts_[i];
            parts_[i] = (parts_[i] - (sum - back)) + (value - back);
            value = sum;
        }
        parts_[count_++] = value;
    }
    /// Adds a b c of single-precision numbers: a b is exact, and its product with c comes in two parts.
    void add_product(float a, float b, double c) {
        const double ab = double{a} * double{b}, high = ab * c;
        add(std::fma(ab, c, -high));
        add(high);
    }
    int sign() const {
        for (std::size_t i = count_; i-- > 0;)
            if (parts_[i] != 0) return parts_[i] > 0 ? 1 : -1;
        return 0;
    }

  private:
    std::array<double, 48> parts_{};
    std::size_t count_ = 0;
};

/// Adds sign times the determinant of three rows.
void add_determinant(ExactSum& sum, const FloatPoint& p, const FloatPoint& q, const FloatPoint& r, double sign) {
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
        sum.add_product(p[k], q[l], sign * double{r[m]});
        sum.add_product(p[k], q[m], -sign * double{r[l]});
    }
}

int exact_side(const FloatPoint& a, const FloatPoint& b, const FloatPoint& c, const FloatPoint& d) {
    ExactSum sum;
    add_determinant(sum, b, c, d, -1);
    add_determinant(sum, a, c, d, 1);
    add_determinant(sum, a, b, d, -1);
    add_determinant(sum, a, b, c, 1);
    return sum.sign();
}

struct Box {
    FloatPoint lower{INFINITY, INFINITY, INFINITY}, upper{-INFINITY, -INFINITY, -INFINITY};
    void add(const FloatPoint& p) {
        for (std::size_t k = 0; k < 3; ++k) {
            lower[k] = std::min(lower[k], p[k]);
            upper[k] = std::max(upper[k], p[k]);
        }
    }
    void add(const Box& box) { add(box.lower), add(box.upper); }
    bool meets(const Box& other) const {
        for (std::size_t k = 0; k < 3; ++k)
            if (lower[k] > other.upper[k] || other.lower[k] > upper[k]) return false;
        return true;
    }
};

/// A triangle with the data that its pairs need.
struct Face {
    std::uint32_t mesh, number;
    std::array<std::uint32_t, 3> corners;
    std::array<FloatPoint, 3> at;
    Box box;
};

enum class Meeting { apart, touch, cross };

/// Returns how an edge meets a triangle.
Meeting pierces(const FloatPoint& p, const FloatPoint& q, const Face& wall) {
    const auto& [a, b, c] = wall.at;
    const int above = side_of(a, b, c, p), below = side_of(a, b, c, q);
    if (above == below) return Meeting::apart;  // both ends are on one side, or in the plane, which other edges tell
    const int ab = side_of(p, q, a, b), bc = side_of(p, q, b, c), ca = side_of(p, q, c, a);
    if (std::max({ab, bc, ca}) > 0 && std::min({ab, bc, ca}) < 0) return Meeting::apart;
    const bool inside = ab != 0 && bc != 0 && ca != 0;
    return inside && above * below < 0 ? Meeting::cross : Meeting::touch;
}

Meeting edges_with(const Face& edges, const Face& wall, bool one_mesh) {
    Meeting worst = Meeting::apart;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = (k + 1) % 3;
        const auto shared = [&](std::size_t corner) {
            return one_mesh && std::ranges::find(wall.corners, edges.corners[corner]) != wall.corners.end();
        };
        if (!shared(k) && !shared(next)) worst = std::max(worst, pierces(edges.at[k], edges.at[next], wall));
    }
    return worst;
}

Meeting meeting(const Face& one, const Face& other) {
    const bool one_mesh = one.mesh == other.mesh;
    const auto common = std::ranges::count_if(
        one.corners, [&](std::uint32_t at) { return std::ranges::find(other.corners, at) != other.corners.end(); });
    if (one_mesh && common > 1) return Meeting::apart;
    return std::max(edges_with(one, other, one_mesh), edges_with(other, one, one_mesh));
}

/// Pairs of faces are found by descending this tree against itself.
class FaceTree {
  public:
    explicit FaceTree(std::vector<Face> faces) : faces_(std::move(faces)) {
        if (!faces_.empty()) build(0, faces_.size());
    }
    Crossings crossings() const {
        Crossings found;
        if (!nodes_.empty()) within(0, found);
        return found;
    }

  private:
    struct Node {
        Box box;
        std::size_t begin, end, left = 0, right = 0;  ///< left 0: a leaf
    };
    static constexpr std::size_t leaf_size = 6;

    std::size_t build(std::size_t begin, std::size_t end) {
        const std::size_t place = nodes_.size();
        nodes_.push_back({{}, begin, end});
        Box box;
        for (std::size_t i = begin; i < end; ++i) box.add(faces_[i].box);
        nodes_[place].box = box;
        if (end - begin <= leaf_size) return place;
        std::size_t axis = 0;
        for (std::size_t k = 1; k < 3; ++k)
            if (box.upper[k] - box.lower[k] > box.upper[axis] - box.lower[axis]) axis = k;
        const auto at = [&](std::size_t i) { return faces_.begin() + static_cast<std::ptrdiff_t>(i); };
        const std::size_t middle = std::midpoint(begin, end);
        std::nth_element(at(begin), at(middle), at(end), [axis](const Face& a, const Face& b) {
            return a.box.lower[axis] + a.box.upper[axis] < b.box.lower[axis] + b.box.upper[axis];
        });
        const std::size_t left = build(begin, middle), right = build(middle, end);
        nodes_[place].left = left;
        nodes_[place].right = right;
        return place;
    }

    void try_pair(const Face& one, const Face& other, Crossings& found) const {
        if (!one.box.meets(other.box)) return;
        const Meeting how = meeting(one, other);
        if (how == Meeting::touch) ++found.touching;
        if (how == Meeting::cross) found.pairs.push_back({{one.mesh, other.mesh}, {one.number, other.number}});
    }

    void within(std::size_t place, Crossings& found) const {
        const Node& node = nodes_[place];
        if (node.left != 0) {
            within(node.left, found);
            within(node.right, found);
            return between(node.left, node.right, found);
        }
        for (std::size_t i = node.begin; i < node.end; ++i)
            for (std::size_t k = i + 1; k < node.end; ++k) try_pair(faces_[i], faces_[k], found);
    }

    void between(std::size_t one, std::size_t other, Crossings& found) const {
        const Node &a = nodes_[one], &b = nodes_[other];
        if (!a.box.meets(b.box)) return;
        if (a.left == 0 && b.left == 0) {
            for (std::size_t i = a.begin; i < a.end; ++i)
                for (std::size_t k = b.begin; k < b.end; ++k) try_pair(faces_[i], faces_[k], found);
            return;
        }
        const bool open_first = a.left != 0 && (b.left == 0 || a.end - a.begin >= b.end - b.begin);
        const Node& opened = open_first ? a : b;
        const std::size_t kept = open_first ? other : one;
        between(opened.left, kept, found);
        between(opened.right, kept, found);
    }

    std::vector<Face> faces_;
    std::vector<Node> nodes_;
};

}  // namespace

int side_of(const FloatPoint& a, const FloatPoint& b, const FloatPoint& c, const FloatPoint& d) {
    std::array<double, 3> u{}, v{}, w{};
    for (std::size_t k = 0; k < 3; ++k) {
        u[k] = double{a[k]} - double{d[k]};
        v[k] = double{b[k]} - double{d[k]};
        w[k] = double{c[k]} - double{d[k]};
    }
    double volume = 0, size = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
        volume += u[k] * (v[l] * w[m] - v[m] * w[l]);
        size += std::abs(u[k]) * (std::abs(v[l] * w[m]) + std::abs(v[m] * w[l]));
    }
    // Shewchuk's bound is 7.8e-16.
    if (std::abs(volume) > 1e-15 * size) return volume > 0 ? 1 : -1;
    return exact_side(a, b, c, d);
}

Crossings find_crossings(const std::vector<FloatMesh>& meshes) {
    std::vector<Face> faces;
    for (std::uint32_t mesh = 0; mesh < meshes.size(); ++mesh)
        for (std::uint32_t number = 0; number < meshes[mesh].triangles.size(); ++number) {
            const auto& corners = meshes[mesh].triangles[number];
            Face face{mesh, number, corners, {}, {}};
            for (std::size_t k = 0; k < 3; ++k) {
                face.at[k] = meshes[mesh].points[corners[k]];
                face.box.add(face.at[k]);
            }
            faces.push_back(face);
        }
    return FaceTree(std::move(faces)).crossings();
}

}  // namespace drape::test
