#include "picture/strain_scale.h"

#include <algorithm>
#include <cmath>

#include "base/vectors.h"
#include "world/weather.h"

namespace drape {

namespace {

constexpr double smallest_range = 5e-3, largest_range = 1, gathered_weights = 100, gathered_wind = 5;

/// Returns the load, N/m, on an edge that bears the cloth's weight, multiplied as pins and folds concentrate it, or the
/// wind's push.
double edge_force(const Cloth& cloth, const SceneDescription& scene) {
    const double fastest = fastest_wind(scene.wind);
    const double pressure = 0.5 * scene.wind.air_density * scene.wind.drag * fastest * fastest;
    return std::max(gathered_weights * cloth.areal_density * length(strongest_gravity(scene)),
                    gathered_wind * pressure) *
           std::max(cloth.size[0], cloth.size[1]);
}

/// Rounds up to 1, 2 or 5 times a power of ten.
double rounded_up(double value) {
    const double decade = std::pow(10.0, std::floor(std::log10(value)));
    for (const double step : {1.0, 2.0, 5.0})
        if (value <= step * decade * (1 + 1e-9)) return step * decade;
    return 10 * decade;
}

}  // namespace

double default_strain_range(const SceneDescription& scene) {
    double largest = 0;
    for (const Cloth& cloth : scene.cloths)
        if (!cloth.stiffness.rigid && cloth.stiffness.stretch.least() > 0)
            largest = std::max(largest, edge_force(cloth, scene) / cloth.stiffness.stretch.least());
    return rounded_up(std::clamp(largest, smallest_range, largest_range));
}

double StrainScale::place_of(double strain) const {
    if (knee == 0) return (strain - low) / (high - low);
    const double share = std::copysign(std::log1p(std::abs(strain) / knee) / std::log1p(high / knee), strain);
    return low < 0 ? 0.5 + 0.5 * share : share;
}

std::optional<StrainScale> strain_scale(const PictureView& view, const SceneDescription& scene) {
    if (!view.shows_strain()) return std::nullopt;
    const double range = view.range > 0 ? view.range : default_strain_range(scene);
    const double knee = view.range > 0 ? 0 : range / knees_to_end;
    if (view.kind == View::stretch) return StrainScale{"stretch", &viridis, 0, range, knee};
    return StrainScale{view.kind == View::warp ? "warp strain" : "weft strain", &cool_warm, -range, range, knee};
}

}  // namespace drape
