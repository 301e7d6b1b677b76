// A path becomes finite closed curves, which a grid is fitted to, or an error says why not.
#include "input/svg_path.h"

#include <cmath>
#include <stdexcept>

#include "fuzz.h"
#include "world/panel.h"

extern "C" int DRAPE_FUZZ_ENTRY(svg_path)(const std::uint8_t* data, std::size_t size) {
    using namespace drape;
    std::vector<OutlineCurve> curves;
    try {
        for (input::PathCurve& curve : input::read_path(fuzz::text_of(data, size), 1e-2)) {
            fuzz::require(curve.points.size() > 2, "a curve goes around something");
            for (const auto& at : curve.points)
                fuzz::require(std::isfinite(at[0]) && std::isfinite(at[1]), "a point is finite");
            curves.push_back({std::move(curve.points), std::move(curve.corners)});
        }
        if (curves.empty()) return 0;
        const FittedPanel panel = fit_panel(curves, 1, 10'000);
        fuzz::require(panel.places.size() == std::size_t{panel.grid[0]} * panel.grid[1], "each particle has a place");
        for (const PanelPoint& at : panel.places)
            fuzz::require(at[0] >= -1e-6 * panel.size[0] && at[0] <= panel.size[0] * (1 + 1e-6) &&
                              at[1] >= -1e-6 * panel.size[1] && at[1] <= panel.size[1] * (1 + 1e-6),
                          "a place is in the outline's box");
    } catch (const std::invalid_argument&) {
    }
    return 0;
}
