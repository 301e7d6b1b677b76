#include "world/mass_properties.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>

#include "base/vectors.h"
#include "mesh/mesh_shape.h"
#include "world/collider_pose.h"

namespace drape {

namespace {

std::array<double, 9> diagonal(double x, double y, double z) { return {x, 0, 0, 0, y, 0, 0, 0, z}; }

std::optional<MassProperties> properties(const Plane&) { return std::nullopt; }

MassProperties of_ball(const Vec3& radii) {
    const double volume = 4 * std::numbers::pi / 3 * radii[0] * radii[1] * radii[2];
    const auto about = [&](std::size_t a, std::size_t b) {
        return volume / 5 * (radii[a] * radii[a] + radii[b] * radii[b]);
    };
    return {volume, {}, diagonal(about(1, 2), about(2, 0), about(0, 1))};
}
std::optional<MassProperties> properties(const Sphere& sphere) {
    return of_ball({sphere.radius, sphere.radius, sphere.radius});
}
std::optional<MassProperties> properties(const Ellipsoid& ball) { return of_ball(ball.radii); }

std::optional<MassProperties> properties(const Box& box) {
    const Vec3& half = box.half_extents;
    const double volume = 8 * half[0] * half[1] * half[2];
    const auto about = [&](std::size_t a, std::size_t b) {
        return volume / 3 * (half[a] * half[a] + half[b] * half[b]);
    };
    return MassProperties{volume, {}, diagonal(about(1, 2), about(2, 0), about(0, 1))};
}

/// A solid of revolution about y: sums over slices, whose squared radius is a polynomial of the second degree of y, so
/// that three points of Gauss and Legendre's rule are exact.
class Turned {
  public:
    template <class Squared>
    void add(double from, double to, const Squared& squared) {
        const double half = 0.5 * (to - from), middle = 0.5 * (from + to), off = std::sqrt(0.6);
        if (!(half > 0)) return;
        for (const auto& [at, weight] : {std::pair(-off, 5.0 / 9), std::pair(0.0, 8.0 / 9), std::pair(off, 5.0 / 9)}) {
            const double y = middle + half * at, disc = half * weight * std::numbers::pi * squared(y);
            volume_ += disc;
            first_ += disc * y;
            second_ += disc * y * y;
            around_ += disc * squared(y) / 2;
        }
    }
    MassProperties properties() const {
        const double center = first_ / volume_, across = around_ / 2 + second_ - volume_ * center * center;
        return {volume_, {0, center, 0}, diagonal(across, around_, across)};
    }

  private:
    double volume_ = 0, first_ = 0, second_ = 0;  ///< moments along y
    double around_ = 0;                           ///< of the second order about y
};

std::optional<MassProperties> properties(const Capsule& capsule) {
    const auto [half, lower, upper] = shape_geometry(capsule).size;
    if (2 * half <= std::abs(upper - lower)) {
        MassProperties ball = of_ball({std::max(lower, upper), std::max(lower, upper), std::max(lower, upper)});
        ball.center[1] = upper > lower ? half : -half;
        return ball;
    }
    // The cone touches each ball where its normal, as much along y as the radii differ, leaves it.
    const double slope = (lower - upper) / (2 * half), side = std::sqrt(1 - slope * slope);
    const double from = -half + lower * slope, to = half + upper * slope;
    const auto ball = [](double center, double radius) {
        return [=](double y) { return radius * radius - (y - center) * (y - center); };
    };
    const double first = lower * side, last = upper * side;
    Turned body;
    body.add(-half - lower, from, ball(-half, lower));
    body.add(from, to, [&](double y) {
        const double radius = first + (last - first) * (y - from) / (to - from);
        return radius * radius;
    });
    body.add(to, half + upper, ball(half, upper));
    return body.properties();
}

/// Sums over tetrahedra between the surface and the middle of the mesh's frame.
std::optional<MassProperties> properties(const Mesh& mesh) {
    if (!mesh.shape || mesh.shape->shell() > 0) return std::nullopt;
    double volume = 0;
    Vec3 first{};
    std::array<double, 9> second{};
    for (const auto& [i, j, k] : mesh.shape->triangles()) {
        const std::array corners{mesh.shape->vertices()[i], mesh.shape->vertices()[j], mesh.shape->vertices()[k]};
        const double six = dot(corners[0], cross(corners[1], corners[2]));
        const Vec3 sum = plus(plus(corners[0], corners[1]), corners[2]);
        volume += six / 6;
        first = plus(first, times(six / 24, sum));
        for (std::size_t a = 0; a < 3; ++a)
            for (std::size_t b = 0; b < 3; ++b) {
                double products = sum[a] * sum[b];
                for (const Vec3& corner : corners) products += corner[a] * corner[b];
                second[3 * a + b] += six / 120 * products;
            }
    }
    if (!(volume > 0)) return std::nullopt;
    MassProperties result{volume, times(1 / volume, first), {}};
    for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < 3; ++b) second[3 * a + b] -= volume * result.center[a] * result.center[b];
    const double trace = second[0] + second[4] + second[8];
    for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < 3; ++b) result.inertia[3 * a + b] = (a == b ? trace : 0) - second[3 * a + b];
    return result;
}

double area(const Plane&) { return 0; }
double area(const Sphere& sphere) { return 4 * std::numbers::pi * sphere.radius * sphere.radius; }
double area(const Box& box) {
    const Vec3& half = box.half_extents;
    return 8 * (half[0] * half[1] + half[1] * half[2] + half[2] * half[0]);
}
double area(const Ellipsoid& ball) {
    // Within 1.1 % (Thomsen 2004).
    constexpr double power = 1.6075;
    const auto product = [&](std::size_t a, std::size_t b) { return std::pow(ball.radii[a] * ball.radii[b], power); };
    return 4 * std::numbers::pi * std::pow((product(0, 1) + product(1, 2) + product(2, 0)) / 3, 1 / power);
}
double area(const Capsule& capsule) {
    const auto [half, lower, upper] = shape_geometry(capsule).size;
    const double most = std::max(lower, upper);
    return 4 * std::numbers::pi * most * (most + half);
}
double area(const Mesh& mesh) {
    double sum = 0;
    if (mesh.shape)
        for (const auto& [i, j, k] : mesh.shape->triangles()) {
            const std::vector<Vec3>& at = mesh.shape->vertices();
            sum += 0.5 * length(cross(minus(at[j], at[i]), minus(at[k], at[i])));
        }
    return sum;
}

/// Turns a symmetric tensor and its axes so that its element (p, q) becomes zero.
void rotate_away(std::array<double, 9>& tensor, std::array<double, 9>& axes, std::size_t p, std::size_t q) {
    const double off = tensor[3 * p + q];
    if (off == 0) return;
    const double ratio = (tensor[4 * q] - tensor[4 * p]) / (2 * off);
    const double tangent = (ratio < 0 ? -1 : 1) / (std::abs(ratio) + std::hypot(ratio, 1));
    const double cosine = 1 / std::hypot(tangent, 1), sine = tangent * cosine;
    const auto turn = [&](double& a, double& b) {
        const double first = a;
        a = cosine * first - sine * b;
        b = sine * first + cosine * b;
    };
    for (std::size_t k = 0; k < 3; ++k) turn(tensor[3 * k + p], tensor[3 * k + q]);
    for (std::size_t k = 0; k < 3; ++k) turn(tensor[3 * p + k], tensor[3 * q + k]);
    for (std::size_t k = 0; k < 3; ++k) turn(axes[3 * k + p], axes[3 * k + q]);
    tensor[3 * p + q] = tensor[3 * q + p] = 0;
}

}  // namespace

PrincipalAxes principal_axes(const std::array<double, 9>& tensor) {
    std::array<double, 9> rest = tensor;
    PrincipalAxes found;
    // What rounding left of zero is none of a direction.
    const double least = 1e-14 * (tensor[0] + tensor[4] + tensor[8]);
    for (int sweep = 0; sweep < 16; ++sweep)
        for (const auto& [p, q] : {std::pair(0, 1), std::pair(0, 2), std::pair(1, 2)})
            if (std::abs(rest[static_cast<std::size_t>(3 * p + q)]) > least)
                rotate_away(rest, found.axes, static_cast<std::size_t>(p), static_cast<std::size_t>(q));
    found.moments = {rest[0], rest[4], rest[8]};
    return found;
}

std::vector<Vec3> hull_points(const MeshShape& shape) {
    constexpr std::size_t most = 512;
    for (std::size_t directions : {std::size_t{2048}, most}) {
        std::set<std::size_t> farthest;
        for (std::size_t k = 0; k < directions; ++k) {
            // A spiral from pole to pole, by the golden angle (Swinbank and Purser 2006).
            const double y = 1 - (2 * static_cast<double>(k) + 1) / static_cast<double>(directions);
            const double around = static_cast<double>(k) * std::numbers::pi * (3 - std::sqrt(5.0));
            const double radius = std::sqrt(1 - y * y);
            const Vec3 along{radius * std::cos(around), y, radius * std::sin(around)};
            const auto last =
                std::ranges::max_element(shape.vertices(), {}, [&](const Vec3& v) { return dot(v, along); });
            farthest.insert(static_cast<std::size_t>(last - shape.vertices().begin()));
        }
        if (farthest.size() > most) continue;
        std::vector<Vec3> points;
        for (const std::size_t vertex : farthest) points.push_back(shape.vertices()[vertex]);
        return points;
    }
    throw std::logic_error("more hull points than directions");
}

double surface_area(const ColliderShape& shape) {
    return std::visit([](const auto& each) { return area(each); }, shape);
}

std::optional<MassProperties> mass_properties(const ColliderShape& shape) {
    return std::visit([](const auto& each) { return properties(each); }, shape);
}

double covering_mass(const SceneDescription& scene, const ColliderShape& shape) {
    double heaviest = 0;
    for (const Cloth& cloth : scene.cloths) {
        const std::vector<float>& factors = cloth.cell_density;
        const double most = factors.empty() ? 1 : double{std::ranges::max(factors)};
        heaviest = std::max(heaviest, most * cloth.areal_density);
    }
    return heaviest * surface_area(shape);
}

double light_cover(const SceneDescription& scene, const Collider& body) {
    const double covering = covering_mass(scene, body.shape);
    return *body.mass < light_mass_ratio * covering ? covering : 0;
}

}  // namespace drape
