// In a small scene of everything on the C++ twin pins hold exactly, and every particle is finite or counted as one that
// is not.
#include "twin/twin.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "cloth/frame_inputs.h"
#include "control/watch.h"
#include "drape/scene_reader.h"
#include "small_scene.h"
#include "support/twin_with_cuts.h"
#include "twin/statistics.h"
#include "world/motion.h"

namespace drape {
namespace {

using fuzz::require;

constexpr double exact = 1e-5;  ///< relative to the numbers that its coordinates are computed from

double size_of(const Vec3& v) { return std::abs(v[0]) + std::abs(v[1]) + std::abs(v[2]); }

Vec3 place(const glsl::vec4& at) {
    return {static_cast<double>(at.x), static_cast<double>(at.y), static_cast<double>(at.z)};
}

bool is_finite(const glsl::vec4& at) { return std::isfinite(at.x) && std::isfinite(at.y) && std::isfinite(at.z); }

/// Checks that a moved pin's particle is where the pin has it.
void check_moved(const DynamicPin& pin, const glsl::vec4& rest_texel, double time, const Vec3& is) {
    const RigidTransform motion = motion_at(pin.path, time);
    const Vec3 rest = place(rest_texel);
    double scale = size_of(rest) + size_of(pin.pivot) + size_of(motion.translation);
    for (const MotionKey& key : pin.path.keys) scale += size_of(key.translate);
    for (std::size_t row = 0; row < 3; ++row) {
        double wanted = pin.pivot[row] + motion.translation[row];
        for (std::size_t k = 0; k < 3; ++k) wanted += motion.rotation[3 * row + k] * (rest[k] - pin.pivot[k]);
        require(std::abs(is[row] - wanted) <= exact * scale,
                fmt::format("a pin's particle is at {:.9g}, not at {:.9g}", is[row], wanted));
    }
}

void check_pins(const ClothModel& cloth, const std::vector<glsl::vec4>& position, double start, double end) {
    std::vector<bool> dynamic(position.size());
    for (const glsl::PinnedParticle& pinned : cloth.pinned) {
        const std::size_t particle =
            cloth.grid.particle(static_cast<std::uint32_t>(pinned.index.x), static_cast<std::uint32_t>(pinned.index.y));
        dynamic[particle] = true;
        const DynamicPin& pin = cloth.dynamic_pins[static_cast<std::size_t>(pinned.index.z)];
        const bool held = position[particle].w == 0;
        if (pin.release && *pin.release < start) require(!held || pinned.rest.w == 0, "a released pin holds");
        if (!pin.release || *pin.release > end) {
            require(held, "a pin let go too early");
            check_moved(pin, pinned.rest, end, place(position[particle]));
        }
    }
    for (std::size_t particle = 0; particle < position.size(); ++particle) {
        const glsl::vec4 &from = cloth.position[particle], &to = position[particle];
        if (from.w != 0 || dynamic[particle]) continue;
        require(to.w == 0 && place(from) == place(to), "a pin at rest moved its particle");
    }
}

/// The watch that refuses a frame sees every particle that is not finite.
void check_finite(const SimulationModel& model, Twin& twin, Watch& watch, std::uint32_t frame) {
    const FrameInputs inputs = frame_inputs(model, frame);
    std::vector<ClothStatistics> all;
    for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth) {
        if (model.cloths[cloth].scheme.gathered_tension) twin.tension(cloth);
        const TwinCloth& state = twin.cloth(cloth);
        all.push_back(cloth_statistics(model, model.cloths[cloth], twin_statistics(model, cloth, state, inputs)));
        std::uint32_t count = 0;
        for (std::size_t i = 0; i < state[Field::position].size(); ++i)
            count += !is_finite(state[Field::position][i]) || !is_finite(state[Field::displacement][i]);
        require(all.back().non_finite_count == count, "not so many particles are counted as are not finite");
    }
    static_cast<void>(watch.implausible(frame, all));
}

}  // namespace
}  // namespace drape

extern "C" int DRAPE_FUZZ_ENTRY(twin)(const std::uint8_t* data, std::size_t size) {
    using namespace drape;
    fuzz::Dice dice({data, size});
    const std::string text = fuzz::small_scene(dice, {});
    if (std::getenv("DRAPE_FUZZ_PRINT")) fmt::print(stderr, "{}\n", text);
    const SceneResult result = read_scene_text(text, "small scene");
    if (!result.scene) return 0;
    test::TwinWithCuts run(*result.scene);
    const SimulationModel& model = run.model();
    Watch watch(model);
    const double fps = model.scene.time.fps;
    run.run_frame(0);
    for (std::uint32_t frame = 1; frame < model.scene.time.frame_count; ++frame) {
        run.run_frame(frame);
        for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth)
            check_pins(model.cloths[cloth], run.position(cloth), (frame - 1) / fps, frame / fps);
        check_finite(model, run.twin(), watch, frame);
    }
    return 0;
}
