// Runs a model's frames on the device and fetches any of its images: for comparison with the C++ twin.
#pragma once

#include <array>
#include <bit>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "cloth/schedule.h"
#include "graph/executor.h"
#include "passes/cloth_solver.h"

namespace drape::test {

class DeviceRun {
  public:
    DeviceRun(const vulkan::Device& device, const SimulationModel& model, const graph::BarrierFilter& keep = {});

    /// Simulates from frame-1 to `frame` and waits.
    void run_frame(std::uint32_t frame);

    /// Texels of "<cloth>/<part>" of a persistent image, or the normals.
    std::vector<glsl::vec4> image(std::size_t cloth, const std::string& part) const;
    std::vector<float> tension(std::size_t cloth, std::size_t direction) const;
    std::array<std::uint32_t, glsl::control_texel_count> line_control(std::size_t cloth) const;
    std::vector<glsl::vec4> normals(std::size_t cloth) const;

    const graph::Graph& graph() const { return graph_; }
    const graph::Plan& plan() const { return plan_; }
    const graph::ResourcePool& pool() const { return *pool_; }
    const ClothSolver& solver() const { return solver_; }

  private:
    const vulkan::Device& device_;
    const SimulationModel& model_;
    ClothSolver solver_;
    graph::Graph graph_;
    graph::Plan plan_;
    std::unique_ptr<graph::ResourcePool> pool_;
    std::unique_ptr<graph::RecordedPlan> recorded_;
    vulkan::FrameSlots slots_;
};

/// Whether two lists of texels are the same bits; on failure `where` names the first difference.
bool same_bits(const std::vector<glsl::vec4>& a, const std::vector<glsl::vec4>& b, std::string& where);

}  // namespace drape::test
