#pragma once

#include <algorithm>

#include "reference/cut_twin.h"
#include "reference/twin.h"

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
        if (!cutters_active(model_.scene.cutters, start, end)) return sum;
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
        return sum;
    }
    const std::vector<glsl::vec4>& position(std::size_t cloth) const { return twin_.cloth(cloth)[Field::position]; }
    const CutTopology& topology(std::size_t cloth) { return twin_.topology(cloth); }
    const SimulationModel& model() const { return model_; }
    Twin& twin() { return twin_; }

  private:
    SimulationModel model_;
    Twin twin_;
};

}  // namespace drape::test
