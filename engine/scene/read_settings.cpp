#include <fmt/format.h>

#include "scene/scene_sections.h"

namespace drape {

void read_time(SceneNode node, TimeSettings& time) {
    if (!node.open_object(ObjectKind::time)) return;
    node.member("fps").read(time.fps, {0.0, 10000.0, true});
    node.member("frames").read(time.frame_count, 1, 1'000'000);
}

void read_wind(SceneNode node, Wind& wind) {
    if (!node.open_object(ObjectKind::wind)) return;
    const bool has_velocity = node.member("velocity").read(wind.velocity);
    node.member("air_density").read(wind.air_density, not_negative);
    node.member("drag").read(wind.drag, not_negative);
    node.member("lift").read(wind.lift, not_negative);
    SceneNode gust = node.member("gust");
    if (!gust.open_object(ObjectKind::gust)) return;
    gust.member("amplitude").read(wind.gust.amplitude, not_negative);
    gust.member("period").read(wind.gust.period, positive);
    gust.member("seed").read(wind.gust.seed, 0, 0xFFFFFFFFu);
    if (has_velocity && !wind.blows() && wind.gust.amplitude > 0.0)
        gust.warn("the gust does nothing: it blows along the wind's velocity, which is zero");
}

void read_solver(SceneNode node, SolverSettings& solver) {
    if (!node.open_object(ObjectKind::solver)) return;
    const SceneNode method = node.member("method");
    constexpr std::pair<std::string_view, SolverMethod> methods[] = {{"relax", SolverMethod::relax},
                                                                     {"explicit", SolverMethod::explicit_steps},
                                                                     {"line", SolverMethod::line},
                                                                     {"auto", SolverMethod::automatic}};
    method.read_choice<SolverMethod>(solver.method, methods);
    const bool is_automatic = solver.method == SolverMethod::automatic;
    const bool is_explicit = solver.method == SolverMethod::explicit_steps;
    const SceneNode substeps = node.member("substeps"), iterations = node.member("iterations");
    if (substeps.read(solver.substeps, 1, 4096) && substeps && is_automatic)
        substeps.warn("substeps is ignored by method auto, which chooses: name a method to set it");
    if (iterations.read(solver.iterations, 1, 1024) && iterations) {
        if (is_automatic)
            iterations.warn("iterations is ignored by method auto, which chooses: name a method to set it");
        if (is_explicit && solver.iterations > 1)
            iterations.warn("iterations is ignored by method explicit: a micro-step solves nothing");
    }
    constexpr std::pair<std::string_view, CollideWhen> moments[] = {{"iteration", CollideWhen::iteration},
                                                                    {"substep", CollideWhen::substep}};
    node.member("collide").read_choice<CollideWhen>(solver.collide, moments);
    node.member("tolerance").read(solver.tolerance, not_negative);
    const std::string_view name = solver.method == SolverMethod::line ? "line" : "relax";
    node.member("tethers").read(solver.tethers);
    const SceneNode strain_damping = node.member("strain_damping");
    if (strain_damping.read(solver.strain_damping, unit_interval) && strain_damping && !is_explicit && !is_automatic)
        strain_damping.warn(fmt::format("strain_damping is ignored by method {}", name));
}

void read_camera(SceneNode node, Camera& camera) {
    if (!node.open_object(ObjectKind::camera)) return;
    const bool has_position = node.member("position").read(camera.position);
    const bool has_target = node.member("target").read(camera.target);
    node.member("fov").read(camera.fov, {0.0, 170.0, true});
    if (has_position && has_target && camera.position == camera.target)
        node.fail("expected a target away from the camera's position, got the same point");
}

void read_lights(SceneNode node, std::vector<DirectionalLight>& lights) {
    if (!node.open_array("an array of at most 4 lights", 0, 4)) return;
    lights.assign(node.value()->size(), {});
    for (std::size_t i = 0; i < lights.size(); ++i) {
        SceneNode light = node.element(i);
        if (!light.open_object(ObjectKind::light)) continue;
        light.member("direction").read_direction(lights[i].direction);
        light.member("color").read_color(lights[i].color);
        light.member("intensity").read(lights[i].intensity, not_negative);
    }
}

void read_image(SceneNode node, ImageSettings& image) {
    if (!node.open_object(ObjectKind::image)) return;
    const SceneNode size = node.member("size");
    if (size.open_array("an array of 2 integers", 2, 2))
        for (std::size_t i = 0; i < 2; ++i) size.element(i).read(image.size[i], 1, 16384);
    const SceneNode samples = node.member("samples");
    std::uint32_t count = image.samples;
    if (samples && samples.value()->isNumeric() && samples.value()->asDouble() != 1 &&
        samples.value()->asDouble() != 4) {
        samples.fail_expected("1 or 4");
    } else if (samples.read(count, 1, 4)) {
        image.samples = count;
    }
    node.member("background").read_color(image.background);
}

void read_oracles(SceneNode node, std::vector<Oracle>& oracles) {
    if (!node) return;
    if (!node.open_array("an array of checks", 0, 1024)) return;
    oracles.assign(node.value()->size(), {});
    for (std::size_t i = 0; i < oracles.size(); ++i) {
        SceneNode oracle = node.element(i);
        if (!oracle.open_object(ObjectKind::oracle)) continue;
        const SceneNode check = oracle.member("check");
        if (!check || (check.value()->isString() && check.value()->asString().empty())) {
            check.fail_expected("the name of a check");
        } else {
            check.read(oracles[i].check);
        }
        for (const std::string& key : oracle.value()->getMemberNames()) {
            double limit = 0.0;
            if (key != "check" && oracle.open_member(key).read(limit, any_number))
                oracles[i].limits.emplace_back(key, limit);
        }
    }
}

void read_path(SceneNode node, MotionPath& path) {
    if (!node.open_array("an array of at least 1 key", 1, 1'000'000)) return;
    path.keys.assign(node.value()->size(), {});
    bool has_previous = false;
    for (std::size_t i = 0; i < path.keys.size(); ++i) {
        SceneNode key = node.element(i);
        MotionKey& field = path.keys[i];
        const bool is_object = key.open_object(ObjectKind::motion_key);
        if (is_object) {
            key.member("translate").read(field.translate);
            key.member("rotate").read(field.rotate);
        }
        const SceneNode time = key.member("t");
        if (is_object && !time) time.fail_expected("a time in seconds");
        const bool has_time = time && time.read(field.time, any_number);
        if (has_time && has_previous && field.time <= path.keys[i - 1].time)
            time.fail_expected(fmt::format("a time after the previous key's {}", path.keys[i - 1].time));
        has_previous = has_time;
    }
}

}  // namespace drape
