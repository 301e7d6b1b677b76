#include "control/watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drape {

namespace {

/// Returns the row's value and bound. Where it decides, the bound includes how the scene itself holds the cloth. A
/// value that is not above 0 needs no judgement.
std::pair<double, double> measured(const ClothBound& row, const Seen& seen) {
    const double value = row.value(seen);
    if (!(value > 0)) return {0, 1};
    double bound = row.bound(seen);
    if (value > bound && row.own) bound += row.own(seen);
    return {value, bound};
}

Implausible held_against(const ClothBound& row, const Seen& seen) {
    const auto [value, bound] = measured(row, seen);
    // The device squares in single precision: a value that overflowed there is at least this large.
    Implausible found{
        .excess = (std::isinf(value) ? 1e19 : value) / bound, .value = value, .bound = bound, .cloth = seen.cloth};
    if (!(found.excess > 1)) return found;  // nobody needs the words of a finding within its bound
    found.what = sentence(row.words, {.value = value, .bound = bound});
    found.criterion = row.words.name;
    found.remedy = row.words.remedy;
    if (row.place) found.particle = seen.now().*row.place;
    return found;
}

/// Returns ", the particle in column 3, row 4"; empty without a particle.
std::string place_text(const Grid& grid, std::optional<std::uint32_t> particle) {
    if (!particle) return {};
    return fmt::format(", the particle in column {}, row {}", *particle % grid.columns(), *particle / grid.columns());
}

}  // namespace

Watch::Watch(const SimulationModel& model)
    : causes_(model), notes_(std::ranges::count(cloth_bounds(), Beyond::warning, &ClothBound::beyond)) {}

Seen Watch::seen(std::uint32_t frame, std::size_t cloth, std::span<const ClothStatistics> all) const {
    Seen seen{.causes = causes_, .frame = frame, .cloth = cloth, .all = all};
    if (cloth < starts_depth_.size()) seen.start_depth = starts_depth_[cloth];
    if (!recent_.empty()) seen.recent = std::ranges::max(recent_);
    if (recent_.size() == frames_in_a_row) seen.lasting = std::ranges::min(recent_);
    return seen;
}

/// `in_order`: the frame is kept, and all earlier frames were judged; otherwise a closed loop asks whether it may keep
/// it.
Implausible Watch::worst(std::uint32_t frame, const std::vector<ClothStatistics>& cloths, bool in_order) const {
    Implausible worst;
    const auto look = [&](const ClothBound& row, Seen seen) {
        seen.in_order = in_order;
        if (row.beyond > (in_order ? Beyond::no_result : Beyond::again)) return;
        if (row.whose) seen.cloth = row.whose(seen);
        Implausible found = held_against(row, seen);
        if (found.excess > worst.excess) worst = std::move(found);
    };
    for (std::size_t cloth = 0; cloth < cloths.size(); ++cloth) {
        for (const ClothBound& row : cloth_bounds())
            if (!row.whose) look(row, seen(frame, cloth, cloths));
        if (in_order && worst.excess > 1) return worst;
    }
    for (const ClothBound& row : cloth_bounds()) {
        if (row.whose && !cloths.empty()) look(row, seen(frame, 0, cloths));
        if (in_order && worst.excess > 1) return worst;
    }
    return worst;
}

double Watch::excess(std::uint32_t frame, const std::vector<ClothStatistics>& cloths) {
    extend(frame);
    return worst(frame, cloths, false).excess;
}

void Watch::remember(std::uint32_t frame, const std::vector<ClothStatistics>& cloths) {
    const auto keep = [](std::optional<double>& worst, double value) {
        if (std::isfinite(value)) worst = std::max(worst.value_or(value), value);
    };
    if (!cloths.empty()) starts_depth_.resize(cloths.size());
    for (std::size_t cloth = 0; cloth < cloths.size(); ++cloth) {
        const ClothStatistics& now = cloths[cloth];
        if (now.stretch.spring_count > 0)
            keep(worst_rms_, now.stretch_error_rms), keep(worst_max_, now.stretch_error_max);
        if (frame == 0) starts_depth_[cloth] = now.penetration.value_or(0);
        auto note = notes_.begin();
        for (const ClothBound& row : cloth_bounds()) {
            if (row.beyond != Beyond::warning) continue;
            Note& noted = *note++;
            const auto [value, bound] = measured(row, seen(frame, cloth, cloths));
            if (!(value > bound) || !std::isfinite(value)) continue;
            if (noted.value == 0) noted.first = frame;
            if (value <= noted.value) continue;
            noted = {noted.first, frame, static_cast<std::uint32_t>(cloth), value, {}};
            if (row.place) noted.particle = now.*row.place;
        }
    }
    if (frame == 0 || cloths.empty()) return;
    const auto worst = std::ranges::max_element(cloths, {}, &ClothStatistics::stretch_error_max);
    recent_.push_back(worst->stretch_error_max);
    if (recent_.size() > frames_in_a_row) recent_.pop_front();
    last_frame_ = frame, last_cloth_ = static_cast<std::uint32_t>(worst - cloths.begin());
}

std::optional<Implausible> Watch::implausible(std::uint32_t frame, const std::vector<ClothStatistics>& cloths) {
    causes_.begin(frame);
    remember(frame, cloths);
    const Implausible found = worst(frame, cloths, true);
    if (causes_.passive() && causes_.stiffens())
        for (std::size_t cloth = 0; cloth < cloths.size(); ++cloth) {
            // Springs hold no more energy than the cloth has lost or was given: what an error put into them does not
            // justify more work.
            const double spare = spare_energy(seen(frame, cloth, cloths));
            causes_.keep(cloth, std::max(std::min(spare, cloths[cloth].elastic_energy), 0.0));
        }
    if (!(found.excess > 1)) return std::nullopt;
    recent_.clear();  // from here on the message about settling makes no sense
    return found;
}

std::vector<std::string> Watch::warnings() const {
    std::vector<std::string> all;
    auto note = notes_.begin();
    for (const ClothBound& row : cloth_bounds()) {
        if (row.beyond != Beyond::warning && row.beyond != Beyond::unsettled) continue;
        Note told_of{last_frame_, last_frame_, last_cloth_, 0, {}};
        if (row.beyond == Beyond::warning) told_of = *note++;
        const ClothModel& cloth = causes_.model().cloths[told_of.cloth];
        const Seen then = seen(told_of.worst, told_of.cloth, {});
        const double value = row.beyond == Beyond::warning ? told_of.value : row.value(then);
        const double bound = row.bound(then);
        if (!(value > bound)) continue;
        all.push_back(told(row.words, {.value = value,
                                       .bound = bound,
                                       .cloth = cloth.name,
                                       .place = place_text(cloth.grid, told_of.particle),
                                       .first = told_of.first,
                                       .frame = told_of.worst}));
    }
    return all;
}

}  // namespace drape
