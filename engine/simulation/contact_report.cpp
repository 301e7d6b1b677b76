#include "simulation/contact_report.h"

#include <algorithm>
#include <bit>

#include "control/frame_judgement.h"

namespace drape {

std::optional<SelfContactReport> starting_report(const SimulationModel& model) {
    if (!model.self_contact) return std::nullopt;
    SelfContactReport report;
    report.lag_limit = lag_limit(model);
    for (const StartCrossing& each : model.self_contact->crossed)
        if (each.first != each.second)
            report.crossed.emplace_back(each.first, each.second);
        else if (!(each.untied > 0))
            report.first_unproved = 0;
    if (!report.crossed.empty() && model.self_contact->to_part.size() == report.crossed.size()) report.last_crossed = 0;
    return report;
}

void note_contact(SelfContactReport& report, const SimulationModel& model, std::uint32_t frame,
                  const glsl::SelfRecord& record) {
    report.most_pairs = std::max(report.most_pairs, record.most_pairs);
    report.truncated += record.truncated;
    report.longest_lag = std::max(report.longest_lag, double{std::bit_cast<float>(record.most_lag)});
    if (lag_judgement(model, record) > 1 && report.lagging_frames++ == 0) report.first_lagging = frame;
    if (record.crossing_count > 0 && report.last_crossed) report.last_crossed = frame;
    if (record.unproved > 0 && !report.first_unproved) report.first_unproved = frame;
}

}  // namespace drape
