#include "run/scene_run.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <map>

#include "world/start.h"
#include "world/surface_distance.h"
#include "world/weather.h"

namespace drape::verify {

Vec3 SceneRun::at(std::size_t frame, std::size_t cloth, std::size_t particle) const {
    const glsl::vec4& x = frames.at(frame).at(cloth).at(particle);
    return {x.x, x.y, x.z};
}

Vec3 SceneRun::velocity_after(std::size_t frame, std::size_t cloth, std::size_t particle) const {
    const Vec3 moved = minus(at(frame + 1, cloth, particle), at(frame, cloth, particle));
    return {moved[0] * scene.time.fps, moved[1] * scene.time.fps, moved[2] * scene.time.fps};
}

SceneRun SceneRun::until(std::size_t last) const {
    const auto end = std::min(last + 1, frames.size());
    SceneRun part{scene, {frames.begin(), frames.begin() + static_cast<std::ptrdiff_t>(end)}, {}};
    part.bodies.assign(bodies.begin(), bodies.begin() + static_cast<std::ptrdiff_t>(std::min(last + 1, bodies.size())));
    std::ranges::copy_if(cuts, std::back_inserter(part.cuts), [&](const CutRecord& cut) { return cut.frame < end; });
    part.forces.assign(forces.begin(), forces.begin() + static_cast<std::ptrdiff_t>(std::min(end, forces.size())));
    return part;
}

namespace {

CutRecord cut_record(std::size_t frame, std::size_t index, std::size_t springs, const CutTopology& topology) {
    std::map<std::size_t, std::size_t> sizes;
    const std::vector<std::size_t> piece_of = pieces_of(topology);
    for (const std::size_t piece : piece_of) ++sizes[piece];
    CutRecord record{frame, index, springs, 0, 0, topology.rest_area(), topology.grid().triangle_indices()};
    for (const auto& [piece, size] : sizes) ++(100 * size >= piece_of.size() ? record.pieces : record.crumbs);
    return record;
}

}  // namespace

SceneRun run_frames(const vulkan::Device& device, const SceneDescription& scene, const SimulationModel& model,
                    const RunOptions& wanted) {
    SceneRun run{scene, {}, {}};
    FrameOptions options;
    RunListener listener;
    options.draw = false;
    options.positions = wanted.positions;
    options.statistics = options.judges = wanted.frame != nullptr || scene.forces;
    options.timestamps = graph::TimestampMode::none;
    listener.keep_promises = false;  // frames that miss a limit are judged later
    listener.on_cut = [&](const CutEvent& event, const CutTopology& topology) {
        run.cuts.push_back(cut_record(event.frame, event.cloth, event.counts.springs, topology));
    };
    for (std::size_t cloth = 0; cloth < model.cloths.size() && scene.comes_apart(); ++cloth) {
        run.cuts.push_back(cut_record(0, cloth, 0, CutTopology(model.cloths[cloth])));
    }
    FrameServer server(device, model, options, listener);
    const auto keep = [&](const FinishedFrame& frame) {
        if (wanted.frame) wanted.frame(frame);
        if (!wanted.positions) return;
        run.bodies.push_back(frame.bodies);
        auto& forces = run.forces.emplace_back();
        for (const ClothStatistics& cloth : frame.statistics) forces.push_back(cloth.forces);
        auto& cloths = run.frames.emplace_back();
        for (const std::span<const float> values : frame.positions) {
            auto& texels = cloths.emplace_back(values.size() / 4);
            std::memcpy(texels.data(), values.data(), values.size_bytes());
        }
    };
    server.run(
        wanted.last, [](std::uint32_t) { return true; }, keep, wanted.stop);
    return run;
}

ClothMeasure::ClothMeasure(const SceneDescription& scene, std::size_t index)
    : grid(scene.cloths[index]),
      spacing(grid_spacing(scene.cloths[index])),
      rest_ratios(drape::rest_ratios(scene.cloths[index])) {
    const Cloth& cloth = scene.cloths[index];
    mass.assign(grid.particle_count(), 0);
    // Each triangle adds to its corners so that a whole cell gives a quarter of its mass to each corner.
    for (std::uint32_t row = 0; row + 1 < grid.rows(); ++row)
        for (std::uint32_t column = 0; column + 1 < grid.columns(); ++column) {
            const double factor = grid.cell_density(static_cast<int>(column), static_cast<int>(row));
            const double share = 0.25 * factor * cloth.areal_density * spacing[0] * spacing[1];
            for (const std::uint32_t below : {0u, 1u})
                for (const std::uint32_t right : {0u, 1u}) mass[grid.particle(column + right, row + below)] += share;
        }
}

std::vector<double> spring_strains(const SceneRun& run, std::size_t frame, std::size_t cloth, bool down) {
    const ClothMeasure measure(run.scene, cloth);
    const Grid& grid = measure.grid;
    std::vector<double> strains;
    for (std::uint32_t row = 0; row + (down ? 1 : 0) < grid.rows(); ++row)
        for (std::uint32_t column = 0; column + (down ? 0 : 1) < grid.columns(); ++column) {
            const glsl::vec4 shares = grid.spring_shares(column, row);
            if ((down ? shares.y : shares.x) == 0) continue;
            const std::size_t owner = grid.particle(column, row);
            const double rest = measure.spacing[down ? 1 : 0] * measure.rest_ratios[owner][down ? 1 : 0];
            const Vec3 first = run.at(frame, cloth, owner);
            const Vec3 second = run.at(frame, cloth, grid.particle(column + (down ? 0 : 1), row + (down ? 1 : 0)));
            strains.push_back(length(minus(second, first)) / rest - 1);
        }
    return strains;
}

double mean(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

double root_mean_square(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value * value;
    return std::sqrt(sum / static_cast<double>(values.size()));
}

double stretch_law(const SceneDescription& scene, std::size_t cloth) {
    const double links = scene.cloths[cloth].grid[1] - 1.0;
    const double h = 1.0 / (scene.time.fps * scene.solver.substeps);
    return links * links * length(gravity_at(scene, 0)) * h * h /
           (2.0 * scene.solver.iterations * scene.cloths[cloth].size[1]);
}

}  // namespace drape::verify
