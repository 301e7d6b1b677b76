// Fits a cloth's grid to its outline.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/output_error.h"
#include "drape/scene_reader.h"
#include "input/svg_file.h"
#include "scene/scene_rules.h"
#include "world/panel.h"
#include "world/start.h"

namespace drape {

namespace {

/// The pieces of curves are off by at most this share of a cell.
constexpr double curve_tolerance = 1e-3;

std::vector<input::PathCurve> path_curves(const OutlineText& text) {
    const double scale = text.scale.value_or(1);
    std::vector<input::PathCurve> curves = input::read_path(text.path, curve_tolerance * text.spacing / scale);
    for (input::PathCurve& curve : curves)
        for (PanelPoint& point : curve.points)
            for (double& x : point) x *= scale;
    return curves;
}

std::vector<OutlineCurve> curves_of(const SceneNode& node, const OutlineText& text) {
    const double tolerance = curve_tolerance * text.spacing;
    std::vector<OutlineCurve> curves;
    for (input::PathCurve& curve : text.file.empty()
                                       ? path_curves(text)
                                       : input::read_svg(node.file(text.file), {text.element, text.scale, tolerance}))
        curves.push_back({std::move(curve.points), std::move(curve.corners)});
    if (curves.empty()) throw std::invalid_argument("a path that goes around something, got no curve of three points");
    return curves;
}

OutlineText text_of(const SceneNode& node) {
    OutlineText text;
    (void)node.member("path").read(text.path);
    (void)node.member("file").read(text.file);
    (void)node.member("element").read(text.element);
    if (const SceneNode scale = node.member("scale")) (void)scale.read(text.scale.emplace(), positive);
    (void)node.member("spacing").read(text.spacing, positive);
    return text;
}

/// Makes the stiffness that of the stiffest spring, and the density that of the lightest cell, as maps do: no factor of
/// a stiffness is above 1 then, and none of a density below.
void scale_to_shapes(Cloth& cloth) {
    const std::vector<double> areas = cell_areas(cloth);
    const double stiffest = stiffest_shape(cloth), lightest = std::ranges::min(areas);
    if (!cloth.stiffness.rigid) {
        cloth.cell_stiffness.assign(areas.size(), static_cast<float>(1 / stiffest));
        cloth.stiffness.stretch *= stiffest;
        cloth.stiffness.shear *= stiffest;
        cloth.stiffness.bend *= stiffest;
    }
    cloth.cell_density.assign(areas.size(), static_cast<float>(1 / lightest));
    cloth.areal_density *= lightest;
}

}  // namespace

bool take_outline(const Members& members, Cloth& cloth, PanelPoint& low) {
    const SceneNode node = members["outline"];
    if (!node) return true;
    for (const char* key : {"grid", "size", "rest"})
        if (const SceneNode other = members[key])
            return other.fail(fmt::format("expected {} or outline, got both", key));
    if (!members.all_fit()) return false;
    const OutlineText text = text_of(node);
    if (text.path.empty() == text.file.empty()) return node.fail("expected exactly one of path and file");
    if (!text.element.empty() && text.file.empty())
        return node.member("element").fail("expected a file, whose element this is");
    try {
        const FittedPanel fitted = fit_panel(curves_of(node, text), text.spacing, scene_particle_limit);
        cloth.grid = fitted.grid;
        cloth.size = fitted.size;
        cloth.panel = fitted.places;
        low = fitted.low;
        add_holes(fitted.missing, cloth);
        for (std::size_t axis = 0; axis < 2; ++axis)
            for (std::size_t k = 0; k < 3; ++k)
                cloth.placement.origin[k] += fitted.low[axis] * cloth.placement.scale[axis] *
                                             (axis == 0 ? cloth.placement.u : cloth.placement.v)[k];
    } catch (const std::invalid_argument& error) {
        return node.fail(fmt::format("expected {}", error.what()));
    } catch (const OutputError& error) {
        return node.member("file").fail(error.what());
    }
    if (const std::string fault = panel_fault(cloth); !fault.empty()) return node.fail("expected " + fault);
    scale_to_shapes(cloth);
    return true;
}

PanelPoint outline_corner(const SceneNode& node) {
    if (!node) return {};
    PanelPoint low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    for (const OutlineCurve& curve : curves_of(node, text_of(node)))
        for (const PanelPoint& point : curve.points)
            for (std::size_t k = 0; k < 2; ++k) low[k] = std::min(low[k], point[k]);
    return low;
}

bool find_point(const SceneNode& node, const Cloth& cloth, const PanelPoint& low, IndexBox& particles) {
    std::array<double, 2> point{};
    if (!node.read(std::span<double>(point), "a point [x, y] of the outline", any_number)) return false;
    if (cloth.panel.empty()) return node.fail("expected a cloth with an outline, whose points these are");
    const std::vector<bool> has_cell = particles_of_cells(cloth);
    double nearest = std::numeric_limits<double>::infinity();
    for (std::uint32_t particle = 0; particle < cloth.panel.size(); ++particle) {
        const PanelPoint& at = cloth.panel[particle];
        const double away = std::hypot(at[0] + low[0] - point[0], at[1] + low[1] - point[1]);
        if (!has_cell[particle] || away >= nearest) continue;
        nearest = away;
        particles.first = particles.last = {particle % cloth.grid[0], particle / cloth.grid[0]};
    }
    return true;
}

}  // namespace drape
