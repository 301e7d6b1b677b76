#include "bench/scene_problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

#include "base/vectors.h"
#include "bench/measure.h"
#include "cloth/solver_choice.h"
#include "output/atomic_file.h"
#include "reference/spring_network.h"
#include "run/run.h"

namespace drape::bench {

namespace {

/// The longest side of any cloth, m.
double largest_side(const SceneDescription& scene) {
    double side = 0;
    for (const Cloth& cloth : scene.cloths) side = std::max({side, cloth.size[0], cloth.size[1]});
    return side;
}

/// The most links along a side.
std::uint32_t largest_links(const SceneDescription& scene) {
    std::uint32_t links = 1;
    for (const Cloth& cloth : scene.cloths) links = std::max({links, cloth.grid[0] - 1, cloth.grid[1] - 1});
    return links;
}

/// The networks of all cloths, for their masses and stretch springs: colliders, bending and stiffness do not matter.
std::vector<SpringNetwork> networks_of(SceneDescription scene) {
    std::vector<SpringNetwork> networks;
    for (Cloth& cloth : scene.cloths) cloth.stiffness.rigid = false, cloth.stiffness.bend = 0;
    for (std::size_t k = 0; k < scene.cloths.size(); ++k)
        networks.emplace_back(scene, k, NetworkOptions{.ignore_colliders = true});
    return networks;
}

Vec3 center(const std::vector<SpringNetwork>& networks, std::span<const Vec3> position) {
    Vec3 sum{};
    double all = 0;
    auto at = position.begin();
    for (const SpringNetwork& network : networks)
        for (const double mass : network.mass) {
            for (std::size_t k = 0; k < 3; ++k) sum[k] += mass * (*at)[k];
            all += mass;
            ++at;
        }
    return {sum[0] / all, sum[1] / all, sum[2] / all};
}

/// RMS over the stretch springs.
double strain(const std::vector<SpringNetwork>& networks, std::span<const Vec3> position) {
    double squares = 0, count = 0;
    for (const SpringNetwork& network : networks) {
        const NetworkStrain one = network.strain(position.first(network.mass.size()), SpringFamily::stretch);
        squares += one.rms * one.rms * static_cast<double>(one.count);
        count += static_cast<double>(one.count);
        position = position.subspan(network.mass.size());
    }
    return std::sqrt(squares / std::max(count, 1.0));
}

Metrics scene_errors(const Recording& run, const ReferenceRun& reference) {
    const std::vector<SpringNetwork> networks = networks_of(run.scene);
    const std::size_t agreeing = agreeing_count(reference, agreement_share * largest_side(run.scene));
    const auto frames = static_cast<double>(reference.times.size());
    Metrics m{{"position_rms", 0},  {"worst_position", 0},      {"center_error", 0}, {"stretch_rms", 0},
              {"stretch_error", 0}, {"worst_stretch_error", 0}, {"worst_spring", 0}};
    double true_strain = 0;
    for (std::size_t k = 0; k < reference.times.size(); ++k) {
        const Sample& sample = run.samples.at(k + 1);
        const std::vector<Vec3>& exact = reference.states[k].position;
        if (k < agreeing) {
            const double rms = position_rms(sample.position, exact);
            m["position_rms"] += rms / static_cast<double>(agreeing);
            m["worst_position"] = std::max(m["worst_position"], rms);
            m["position_at_end"] = rms;
            m["stated_at_end"] = sample.effort.position_error;
        }
        const Vec3 apart = minus(center(networks, sample.position), center(networks, exact));
        m["center_error"] += dot(apart, apart) / frames;
        m["stretch_rms"] += sample.statistics.stretch.rms / frames;
        m["stretch_error"] += sample.statistics.stretch_error_rms / frames;
        m["worst_stretch_error"] = std::max(m["worst_stretch_error"], sample.statistics.stretch_error_rms);
        m["worst_spring"] = std::max(m["worst_spring"], sample.statistics.stretch_error_max);
        true_strain += strain(networks, exact) / frames;
    }
    m["center_error"] = std::sqrt(m["center_error"]);
    if (!run.scene.comes_apart()) m["stretch_rms_reference"] = true_strain;
    m["reference_error"] = mean_error(reference, agreeing);
    m["agreement_s"] = agreeing > 0 ? reference.times[agreeing - 1] : 0;
    put_substeps(run.samples, m);
    m["tolerance"] = run.scene.solver.tolerance > 0 ? run.scene.solver.tolerance : default_tolerance;
    if (agreeing == 0) m.erase("position_rms"), m.erase("worst_position"), m.erase("reference_error");
    if (agreeing == 0 || !std::isfinite(m["stated_at_end"])) m.erase("stated_at_end");
    return m;
}

/// Lines on the reference, and on how far it can be trusted.
std::string about_reference(const ReferenceRun& reference, double distance) {
    const std::size_t agreeing = agreeing_count(reference, distance), count = reference.times.size();
    std::string text = fmt::format("Reference: {}\n", reference.method);
    if (agreeing == 0)
        return text + fmt::format(
                          "The finest runs differ by more than {:g} m from the first frame on: no position can be "
                          "compared; strains and centres of mass are those of chaotic runs.\n",
                          distance);
    const auto end = reference.error_estimate.begin() + static_cast<std::ptrdiff_t>(agreeing);
    text += fmt::format("Its own error by Richardson's estimate, until {:.3g} s: mean {:.2g} m, worst frame {:.2g} m\n",
                        reference.times[agreeing - 1], mean_error(reference, agreeing),
                        *std::max_element(reference.error_estimate.begin(), end));
    if (agreeing < count)
        text += fmt::format(
            "Its two finest runs then part by more than {:g} m: positions are compared until there, "
            "strains and centres of mass throughout.\n",
            distance);
    return text;
}

/// A cloth of few links has the same substeps more than once in a sweep that counts them per link.
std::vector<Setting> different(std::vector<Setting> settings) {
    std::vector<Setting> all;
    for (Setting& setting : settings) {
        setting.substeps = std::max(setting.substeps, 1u);
        if (std::ranges::find(all, setting) == all.end()) all.push_back(setting);
    }
    return all;
}

std::string row_name(const std::string& path) {
    std::string name = std::filesystem::path(path).stem().string();
    for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-') c = '_';
    return name.empty() ? "scene" : name;
}

}  // namespace

UserScene read_user_scene(const std::string& path, const std::vector<std::string>& overrides, std::uint32_t frames) {
    SceneResult result = read_scene(path, overrides);
    if (!result.scene) throw SceneFailure(std::move(result));
    UserScene user{path, std::move(*result.scene), {}};
    std::uint32_t& count = user.scene.time.frame_count;
    if (count < 2)
        throw UsageError(fmt::format("{} has no frame after the first: there is no motion to measure", path));
    if (frames > 0 && frames < count) count = frames + 1;
    std::string text = result.text;
    for (const std::string& each : overrides) text += "\n" + each;
    user.identity = xxh3_128_hex(text);
    return user;
}

Problem user_problem(const UserScene& user, const Device& device, const RefinementOptions& options,
                     std::span<const double> errors, bool is_short) {
    const std::uint32_t links = largest_links(user.scene);
    Problem problem{.name = row_name(user.path),
                    .title = user.scene.name.empty() ? row_name(user.path) : user.scene.name,
                    .metric = "position_rms",
                    .unit = "m",
                    .floor = 1e-7 * largest_side(user.scene),
                    .timed = true,
                    .strain_damping = user.scene.solver.strain_damping};
    problem.of_user = true;
    problem.targets = {{"stretch_error", default_tolerance}, {"worst_stretch_error", default_tolerance}};
    for (const double error : errors) problem.targets.push_back({problem.metric, error});
    problem.identity = fmt::format("{} {} {}", user.identity, options.wanted_error, options.most_substeps);
    problem.scene = [scene = user.scene](std::uint32_t, const Setting& setting) {
        SceneDescription result = scene;
        // The settings of a sweep make no promise; what auto promises is the scene's.
        if (setting.method != SolverMethod::automatic) result.solver.tolerance = 0;
        return result;
    };
    const std::string key =
        fmt::format("refined scene 1: {} frames {} on {} {}, {}", problem.identity, user.scene.time.frame_count,
                    device.info().name, device.info().driver_version, shaders_hash());
    problem.evaluate = [scene = user.scene, key, device, options](const Recording& run, References& references) {
        return scene_errors(run, references.refined(key, [&] { return refined_scene(device, scene, options); }));
    };
    problem.about = [scene = user.scene, key, device, options](References& references) {
        return about_reference(references.refined(key, [&] { return refined_scene(device, scene, options); }),
                               agreement_share * largest_side(scene));
    };
    problem.sweeps.push_back({links, {{SolverMethod::automatic, 1, 1}}, 0});
    for (const Method& method : methods())
        problem.sweeps.push_back({links, different(sweep_settings(method, links, is_short)), 1});
    return problem;
}

}  // namespace drape::bench
