// Keeps the proof about contact between cloths, frame by frame, from what the device counts.
#pragma once

#include <optional>

#include "cloth/simulation_model.h"
#include "drape/simulation.h"
#include "shared/self_contact_types.h"

namespace drape {

/// Returns the report before any frame is simulated; nothing: no cloth can touch itself or another.
std::optional<SelfContactReport> starting_report(const SimulationModel& model);

/// Adds what the device counted in a frame.
void note_contact(SelfContactReport& report, const SimulationModel& model, std::uint32_t frame,
                  const glsl::SelfRecord& record);

/// Writes or reads what frames change of the report, by a ByteWriter or a ByteReader.
template <class Archive>
void transfer_report(Archive& archive, SelfContactReport& report) {
    archive(report.first_unproved, report.most_pairs, report.truncated, report.longest_lag, report.first_lagging,
            report.lagging_frames, report.last_crossed);
}

}  // namespace drape
