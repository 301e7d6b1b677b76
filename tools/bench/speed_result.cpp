#include "bench/speed_result.h"

#include <algorithm>

#include "bench/fit.h"

namespace drape::bench {

const SpeedTime* SpeedResult::find(const std::string& name) const {
    const auto found = std::ranges::find(times, name, &SpeedTime::name);
    return found == times.end() ? nullptr : &*found;
}

double SpeedResult::ratio(const std::string& name, const std::string& to) const {
    const SpeedTime *above = find(name), *below = find(to);
    return above && below && below->statistics.median > 0 ? above->statistics.median / below->statistics.median : 0;
}

std::vector<ScalingFit> fit_scaling(const std::vector<SpeedResult>& results) {
    constexpr std::uint32_t least_size = 64;  // smaller cloths pay for dispatches
    std::vector<ScalingFit> fits;
    for (const SpeedResult& result : results) {
        const SpeedCase& about = result.about;
        if (about.kind != SpeedKind::solve || about.colliders > 0) continue;
        const bool of_cloths = about.cloths > 1;
        if (!of_cloths && about.size < least_size) continue;
        for (const SpeedTime& time : result.times) {
            const auto same = [&](const ScalingFit& fit) { return fit.group == about.group && fit.time == time.name; };
            auto fit = std::ranges::find_if(fits, same);
            if (fit == fits.end())
                fit = fits.insert(fits.end(), {about.group, time.name, of_cloths ? "cloths" : "particles", {}});
            fit->points.push_back(
                {of_cloths ? about.cloths : about.particles(), time.statistics.median / about.substeps()});
        }
    }
    std::erase_if(fits, [](ScalingFit& fit) {
        const std::optional<double> slope = log_slope(fit.points);
        fit.exponent = slope.value_or(0);
        return fit.points.size() < 3 || !slope;
    });
    return fits;
}

}  // namespace drape::bench
