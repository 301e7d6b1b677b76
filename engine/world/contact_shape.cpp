#include "world/contact_shape.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "mesh/mesh_shape.h"
#include "world/start.h"

namespace drape {

namespace {

/// Returns how much a ball's radius must grow to keep triangles out.
double lift(double radius, double covering) { return std::hypot(radius, covering) - radius; }

double most_growth(const std::array<double, 3>& radii, const std::array<double, 3>& lifted) {
    double most = 0;
    for (std::size_t k = 0; k < 3; ++k) most = std::max(most, lifted[k] - radii[k]);
    return most;
}

/// Returns the radii of an ellipsoid that keeps triangles out of the ellipsoid with radii r. Two kinds do. One is
/// scaled by sqrt(1 + c^2/e^2), where e is the smallest radius. The other contains all points within c of it, as a
/// triangle's corner is that near to any point of the triangle: its support function is h + c, and because 2 c h <= c
/// (h^2/t + t), the squared radii r^2 (1 + c/t) + c^2 + c t suffice for any t. The one with the smallest growth
/// anywhere is taken, since a flat body would reach metres beside itself when scaled.
std::array<double, 3> lifted_radii(const std::array<double, 3>& radii, double c) {
    const double smallest = std::ranges::min(radii), scale = std::hypot(1, c / smallest);
    std::array<double, 3> best = radii;
    for (double& radius : best) radius *= scale;
    constexpr int tries = 60;
    for (int k = 0; k <= tries && c > 0; ++k) {
        const double t = c * std::pow(1000, static_cast<double>(k) / tries);
        std::array<double, 3> around = radii;
        for (double& radius : around) radius = std::sqrt(radius * radius * (1 + c / t) + c * (c + t));
        if (most_growth(radii, around) < most_growth(radii, best)) best = around;
    }
    return best;
}

double grown(double radius, double by, double thickness) { return radius + std::max(0.0, by - thickness); }

struct Grow {
    double covering, thickness;

    void operator()(Plane&) const {}
    void operator()(Box&) const {}
    void operator()(Sphere& sphere) const {
        sphere.radius = grown(sphere.radius, lift(sphere.radius, covering), thickness);
    }
    void operator()(Capsule& capsule) const {
        for (double& radius : capsule.radii) radius = grown(radius, lift(radius, covering), thickness);
    }
    void operator()(Mesh& mesh) const { mesh.grown = grown(0, lift(mesh.shape->inner_radius(), covering), thickness); }
    void operator()(Ellipsoid& ellipsoid) const {
        const std::array<double, 3> lifted = lifted_radii(ellipsoid.radii, covering);
        for (std::size_t k = 0; k < 3; ++k)
            ellipsoid.radii[k] = grown(ellipsoid.radii[k], lifted[k] - ellipsoid.radii[k], thickness);
    }
};

/// Returns whether shaders/collider_edges.comp keeps a shape's edges out of the cloth's triangles. A shell consists of
/// balls, by which it grows instead.
bool has_edges(const Plane&) { return false; }
bool has_edges(const Sphere&) { return false; }
bool has_edges(const Box&) { return true; }
bool has_edges(const Ellipsoid&) { return false; }
bool has_edges(const Capsule&) { return false; }
bool has_edges(const Mesh& mesh) { return !mesh.shell; }

}  // namespace

double covering_radius(const Cloth& cloth) {
    double squared = 0;
    for (std::size_t axis = 0; axis < 2; ++axis) {
        // A given shape may be as uneven as moving cloth, unless it is the rest shape, which may then stretch in
        // addition.
        const double stretch = cloth.rest == Rest::start || cloth.start.empty() ? 1 : 1 + contact_stretch;
        const double scale = cloth.start.empty() && cloth.panel.empty() ? cloth.placement.scale[axis]
                                                                        : start_ratios(cloth, axis).largest / stretch;
        const double spacing = grid_spacing(cloth)[axis] * std::max(1.0, scale);
        squared += spacing * spacing;
    }
    return 0.5 * (1 + contact_stretch) * std::sqrt(squared);
}

double least_thickness(const Cloth& cloth) {
    const std::vector<float>& factors = cloth.particle_thickness;
    return factors.empty() ? cloth.thickness : cloth.thickness * static_cast<double>(std::ranges::min(factors));
}

double edge_reach(const Cloth& cloth) { return 2 * covering_radius(cloth); }

bool meets_edges(const Cloth& cloth, const std::vector<Collider>& colliders) {
    const auto any_edges = [](const Collider& each) {
        return std::visit([](const auto& shape) { return has_edges(shape); }, each.shape);
    };
    return cloth.contact == ContactOf::surface && least_thickness(cloth) < covering_radius(cloth) &&
           std::ranges::any_of(colliders, any_edges);
}

Collider contact_shape(const Cloth& cloth, const Collider& collider) {
    Collider kept = collider;
    if (cloth.contact == ContactOf::surface)
        std::visit(Grow{covering_radius(cloth), least_thickness(cloth)}, kept.shape);
    return kept;
}

}  // namespace drape
