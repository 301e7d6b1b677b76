#include "run/run_statistics.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/vectors.h"
#include "run/given_values.h"

namespace drape {

namespace {

void add_strain(FrameValues& values, const std::string& name, const StrainStatistics& strain) {
    if (strain.spring_count == 0) return;
    values[name + "_rms"] = strain.rms;
    values[name + "_max"] = strain.largest;
    values[name + "_min"] = strain.smallest;
}

void add_force(FrameValues& values, const std::string& cloth, const ForceOnCloth& of) {
    for (std::size_t k = 0; k < 3; ++k) {
        const char axis = "xyz"[k];
        values[fmt::format("{}/force_{}_{}_n", cloth, of.by, axis)] = of.force[k];
        if (of.moment) values[fmt::format("{}/moment_{}_{}_n_m", cloth, of.by, axis)] = (*of.moment)[k];
        if (of.worst) values[fmt::format("{}/worst_force_{}_{}_n", cloth, of.by, axis)] = (*of.worst)[k];
        if (of.worst_moment)
            values[fmt::format("{}/worst_moment_{}_{}_n_m", cloth, of.by, axis)] = (*of.worst_moment)[k];
    }
}

void add_cloth(FrameValues& values, const std::string& cloth, const ClothStatistics& statistics) {
    add_strain(values, cloth + "/stretch", statistics.stretch);
    add_strain(values, cloth + "/shear", statistics.shear);
    if (statistics.stretch.spring_count > 0) {
        values[cloth + "/stretch_error_rms"] = statistics.stretch_error_rms;
        values[cloth + "/stretch_error_max"] = statistics.stretch_error_max;
    }
    values[cloth + "/kinetic_energy_j"] = statistics.kinetic_energy;
    values[cloth + "/potential_energy_j"] = statistics.potential_energy;
    values[cloth + "/elastic_energy_j"] = statistics.elastic_energy;
    values[cloth + "/center_of_mass_x_m"] = statistics.center_of_mass[0];
    values[cloth + "/center_of_mass_y_m"] = statistics.center_of_mass[1];
    values[cloth + "/center_of_mass_z_m"] = statistics.center_of_mass[2];
    for (std::size_t k = 0; k < 3; ++k) {
        const char axis = "xyz"[k];
        values[fmt::format("{}/momentum_{}_kg_m_s", cloth, axis)] = statistics.momentum[k];
        values[fmt::format("{}/angular_momentum_{}_kg_m2_s", cloth, axis)] = statistics.angular_momentum[k];
    }
    for (const ForceOnCloth& each : statistics.forces) add_force(values, cloth, each);
    if (statistics.seams) {
        values[cloth + "/seam_load_n_per_m"] = statistics.seams->load;
        values[cloth + "/seam_ripped"] = statistics.seams->ripped;
    }
    if (statistics.gas) {
        values[cloth + "/gas_pressure_pa"] = statistics.gas->pressure;
        values[cloth + "/gas_volume_m3"] = statistics.gas->volume;
    }
    values[cloth + "/angular_error_kg_m2_s"] = length(statistics.angular_error);
    values[cloth + "/distance_max_m"] = statistics.largest_distance;
    values[cloth + "/speed_max_m_s"] = statistics.largest_speed;
    if (statistics.iteration_count) values[cloth + "/iterations"] = *statistics.iteration_count;
    if (statistics.penetration) values[cloth + "/penetration_m"] = *statistics.penetration;
}

/// Calls `visit` with the name and the place of each number of a body.
template <class State, class Visit>
void for_each_number(const SceneDescription& scene, State& body, const Visit& visit) {
    const std::string before =
        fmt::format("body_{}_{}", body.collider, collider_names[scene.colliders[body.collider].shape.index()]);
    const auto visit_all = [&](const char* what, const char* unit, auto& numbers) {
        for (std::size_t k = 0; k < numbers.size(); ++k)
            visit(fmt::format("{}_{}_{}{}", before, what, "xyzw"[k], unit), numbers[k]);
    };
    visit_all("position", "_m", body.position);
    visit_all("turn", "", body.turn);
    visit_all("velocity", "_m_s", body.velocity);
    visit_all("angular_velocity", "_rad_s", body.angular_velocity);
    visit_all("momentum", "_kg_m_s", body.momentum);
    visit_all("angular_momentum", "_kg_m2_s", body.angular_momentum);
    visit(before + "_kinetic_energy_j", body.kinetic_energy);
    visit(before + "_potential_energy_j", body.potential_energy);
}

/// Adds the momentum of cloths and bodies together.
void add_momentum(FrameValues& values, const FinishedFrame& frame) {
    Vec3 momentum{};
    for (const ClothStatistics& cloth : frame.statistics) momentum = plus(momentum, cloth.momentum);
    for (const BodyState& body : frame.bodies) momentum = plus(momentum, body.momentum);
    for (std::size_t k = 0; k < 3; ++k) values[fmt::format("momentum_{}_kg_m_s", "xyz"[k])] = momentum[k];
}

std::optional<double> energy(const FrameValues& values) {
    const auto found = values.find("energy_j");
    return found == values.end() ? std::nullopt : std::optional(found->second);
}

double value_of(const FrameValues& values, const std::string& name) {
    const auto found = values.find(name);
    return found == values.end() ? 0 : found->second;
}

std::string penetration_text(double metres) {
    const double millimetres = 1000 * metres;
    if (millimetres == 0) return "no penetration";
    return millimetres < 0.001 ? "penetration below 0.001 mm" : fmt::format("penetration {:.3g} mm", millimetres);
}

}  // namespace

FrameValues frame_values(const SceneDescription& scene, const FinishedFrame& frame) {
    const std::vector<ClothStatistics>& cloths = frame.statistics;
    FrameValues values = given_values(scene, frame.frame);
    if (frame.effort.substeps > 0) {
        values["substeps"] = frame.effort.substeps;
        values["attempts"] = frame.effort.attempts;
        values["motion_error_m_s"] = frame.effort.motion_error;
        values["motion_allowed_m_s"] = frame.effort.motion_allowed;
    }
    for (const FailedAttempt& failed : frame.effort.failed) {
        double& worst = values[fmt::format("failed_{}", criterion_names[static_cast<std::size_t>(failed.criterion)])];
        worst = std::max(worst, failed.times);
    }
    values["position_error_m"] = frame.effort.position_error;
    values["position_error_at_end_m"] = frame.effort.position_error_at_end;
    values["position_allowed_m"] = frame.effort.position_allowed;
    values["parted_m"] = frame.effort.parted;
    if (frame.effort.sensitive) values["sensitive"] = 1;
    if (frame.effort.asleep) values["asleep"] = 1;
    double kinetic = 0, potential = 0, elastic = 0;
    for (std::size_t cloth = 0; cloth < cloths.size(); ++cloth) {
        add_cloth(values, scene.cloths[cloth].name, cloths[cloth]);
        kinetic += cloths[cloth].kinetic_energy;
        potential += cloths[cloth].potential_energy;
        elastic += cloths[cloth].elastic_energy;
    }
    for (const BodyState& body : frame.bodies) {
        for_each_number(scene, body, [&](const std::string& name, double value) { values[name] = value; });
        kinetic += body.kinetic_energy;
        potential += body.potential_energy;
    }
    if (!frame.bodies.empty()) add_momentum(values, frame);
    for (const ClothStatistics& cloth : cloths) {
        if (!cloth.penetration) continue;
        double& deepest = values.try_emplace("penetration_m", *cloth.penetration).first->second;
        deepest = std::max(deepest, *cloth.penetration);
    }
    values["kinetic_energy_j"] = kinetic;
    values["potential_energy_j"] = potential;
    values["elastic_energy_j"] = elastic;
    values["energy_j"] = kinetic + potential + elastic;
    std::erase_if(values, [](const auto& entry) { return !std::isfinite(entry.second); });
    return values;
}

std::vector<BodyState> bodies_of(const SceneDescription& scene, const FrameValues& values) {
    std::vector<BodyState> bodies;
    for (std::size_t k = 0; k < scene.colliders.size(); ++k) {
        if (!scene.colliders[k].mass) continue;
        BodyState body{.collider = k};
        for_each_number(scene, body, [&](const std::string& name, double& value) { value = value_of(values, name); });
        bodies.push_back(body);
    }
    return bodies;
}

RunStatistics::RunStatistics(OutputFolder* folder) {
    if (folder) frames_.emplace(*folder);
}

void RunStatistics::add(std::uint32_t frame, const FrameValues& values) {
    if (!first_ || frame <= first_->first) first_ = {frame, energy(values)};
    ++count_;
    for (const auto& [name, value] : values) {
        double& largest = largest_.try_emplace(name, value).first->second;
        largest = std::max(largest, value);
    }
    if (frames_) frames_->add(frame, values);
}

/// Returns the worst value over the cloths.
std::optional<double> RunStatistics::worst(const FrameValues& values, std::string_view name) {
    std::optional<double> largest;
    for (const auto& [key, value] : values)
        if (key.ends_with(name)) largest = std::max(largest.value_or(value), value);
    return largest;
}

std::optional<double> RunStatistics::energy_drift(const FrameValues& values) const {
    const auto now = energy(values);
    return now && first_ && first_->second ? std::optional(*now - *first_->second) : std::nullopt;
}

std::string RunStatistics::note(const FrameValues& values) const {
    std::vector<std::string> parts;
    if (const auto rms = worst(values, "/stretch_rms"), max = worst(values, "/stretch_max"); rms && max)
        parts.push_back(fmt::format("stretch {:.3g} % RMS, {:.3g} % max", 100 * *rms, 100 * *max));
    if (const auto error = worst(values, "/stretch_error_rms"))
        parts.push_back(fmt::format("stretch error {:.3g} % RMS", 100 * *error));
    if (const auto error = values.find("motion_error_m_s"); error != values.end())
        parts.push_back(fmt::format("motion error {:.3g} mm/s", 1000 * error->second));
    if (const auto error = values.find("position_error_m"); error != values.end()) {
        const double end = value_of(values, "position_error_at_end_m");
        parts.push_back(fmt::format("position error {:.2g} mm", 1000 * error->second) +
                        (end > error->second ? fmt::format(" ({:.2g} by the end)", 1000 * end) : ""));
    }
    if (const auto substeps = values.find("substeps"); substeps != values.end())
        parts.push_back(fmt::format("{:.0f} substeps", substeps->second));
    if (const auto ripped = worst(values, "/seam_ripped"); ripped && *ripped > 0)
        parts.push_back(fmt::format("{:.0f} particles of a cloth at ripped seams", *ripped));
    if (values.contains("asleep")) parts.push_back("asleep");
    if (const auto drift = energy_drift(values))
        parts.push_back(fmt::format("energy {:+.3g} J since frame {}", *drift, first_->first));
    if (const auto depth = worst(values, "/penetration_m")) parts.push_back(penetration_text(*depth));
    return fmt::format("{}", fmt::join(parts, ", "));
}

void RunStatistics::for_each_frame(const Manifest::FrameVisitor& take) const {
    if (!frames_) return;
    frames_->for_each([&](std::uint32_t frame, const FrameValues& values) {
        Manifest::FrameStatistics each{frame, values};
        if (const auto drift = energy_drift(values)) each.values["energy_drift_j"] = *drift;
        take(each);
    });
}

}  // namespace drape
