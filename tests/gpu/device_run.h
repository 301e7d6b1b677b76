// Runs a model's frames on the device and fetches any of its images, for comparison with the C++ twin.
#pragma once

#include <array>
#include <bit>
#include <cstring>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "cloth/frame_steps.h"
#include "graph/executor.h"
#include "solver/cloth_solver.h"

namespace drape::test {

template <class T>
std::vector<T> texels_of(std::span<const std::byte> bytes) {
    std::vector<T> texels(bytes.size() / sizeof(T));
    std::memcpy(texels.data(), bytes.data(), bytes.size());
    return texels;
}

class DeviceRun {
  public:
    DeviceRun(const vulkan::Device& device, const SimulationModel& model, const graph::BarrierFilter& keep = {},
              const Kernels& kernels = Kernels::automatic(), const FrameNeeds& needs = {.drawing = true});

    void run_frame(std::uint32_t frame);

    /// Returns a field that the device keeps, or the normals, row by row.
    std::vector<std::byte> bytes(std::size_t cloth, Field field) const;
    template <class T = glsl::vec4>
    std::vector<T> texels(std::size_t cloth, Field field) const {
        return texels_of<T>(bytes(cloth, field));
    }

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
    mutable std::map<std::string, std::vector<std::byte>> state_;  ///< since the last frame; none: not fetched yet
};

/// The sets of kernels with the plain ones' bits that the device has for a model's cloths.
std::vector<Kernels> kernel_sets(const vulkan::Device& device, const SimulationModel& model);

/// Returns whether two lists of texels are the same bits; on failure `where` names the first difference.
bool same_bits(const std::vector<glsl::vec4>& a, const std::vector<glsl::vec4>& b, std::string& where);

}  // namespace drape::test
