#pragma once

#include <algorithm>

#include "cloth/tear.h"
#include "twin/cut_twin.h"
#include "twin/tear_twin.h"
#include "twin/twin.h"

namespace drape::test {

/// Runs the whole chain again on the CPU: simulate, search, cut.
class TwinWithCuts {
  public:
    explicit TwinWithCuts(const SceneDescription& scene, const Kernels& kernels = {})
        : model_(scene), twin_(model_, kernels) {}
    /// Frame 0 simulates nothing, but cutters may be active in it.
    CutCounts run_frame(std::uint32_t frame) {
        if (frame > 0) twin_.run_frame(frame);
        const double fps = model_.scene.time.fps, start = frame == 0 ? 0 : (frame - 1) / fps, end = frame / fps;
        CutCounts sum;
        if (cutters_active(model_.scene.cutters, start, end)) cut(start, end, sum);
        for (std::size_t cloth = 0; frame > 0 && cloth < model_.cloths.size(); ++cloth)
            if (!model_.cloths[cloth].tear_limits.empty()) tear(cloth, sum);
        return sum;
    }
    const std::vector<glsl::vec4>& position(std::size_t cloth) const { return twin_.cloth(cloth)[Field::position]; }
    const CutTopology& topology(std::size_t cloth) { return twin_.topology(cloth); }
    const SimulationModel& model() const { return model_; }
    Twin& twin() { return twin_; }

  private:
    void cut(double start, double end, CutCounts& sum) {
        const std::vector<glsl::CutterTriangle> cutters = cutter_triangles(model_.scene.cutters, start, end);
        for (std::size_t cloth = 0; cloth < model_.cloths.size(); ++cloth) {
            CutTopology& topology = twin_.topology(cloth);
            const CutFindings found = find_cuts(topology, twin_.cloth(cloth)[Field::position], cutters);
            const bool hit = std::ranges::any_of(
                found.fractions, [](const glsl::vec4& f) { return f.x >= 0 || f.y >= 0 || f.z >= 0 || f.w >= 0; });
            if (!hit) continue;
            const CutCounts counts = topology.apply(found);
            sum.springs += counts.springs;
            sum.triangles += counts.triangles;
        }
    }
    void tear(std::size_t cloth, CutCounts& sum) {
        CutTopology& topology = twin_.topology(cloth);
        const std::vector<glsl::vec4> loads = tear_loads(topology, position(cloth));
        if (std::ranges::none_of(loads, [](const glsl::vec4& load) { return load.x > 1 || load.y > 1; })) return;
        const CutCounts counts = topology.apply(torn_springs(topology, loads));
        sum.springs += counts.springs;
        sum.torn += counts.springs;
        sum.triangles += counts.triangles;
    }

    SimulationModel model_;
    Twin twin_;
};

}  // namespace drape::test
