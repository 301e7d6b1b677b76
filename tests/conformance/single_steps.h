// Runs the steps of a frame one at a time: each pass of the device starts from the twin's state, and what it leaves is
// compared with what the twin's step does.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "contact_mirror.h"
#include "field_pair.h"
#include "graph/executor.h"
#include "solver/cloth_solver.h"
#include "twin/twin.h"

namespace drape::test {

class SingleSteps {
  public:
    /// Starts where the twin is; its topology stays as it is then. Of the steps of a kernel that is not plain the
    /// others are left out, and of a frame of many substeps all but the first two and the last. Throws VulkanError
    /// where the device has not what a kernel needs.
    SingleSteps(const vulkan::Device& device, const SimulationModel& model, const Kernels& kernels, Twin& twin);

    /// Gets the fields that a step wrote, or a frame's last two together.
    using Visit = std::function<void(const std::vector<Step>& steps, const std::vector<FieldPair>& fields)>;
    /// Takes device and twin from frame - 1 to `frame`.
    void run_frame(std::uint32_t frame, const Visit& visit);

  private:
    /// A step as a graph of its own, which is empty where the device leaves the step out. What a frame ends with is one
    /// with an explicit step before it, which may have left the state in the spare images.
    struct Single {
        std::vector<Step> steps{}, twin{};  ///< the device's, the twin's
        std::vector<std::size_t> cloths{};
        graph::Graph graph{};
        graph::Plan plan{};
        std::unique_ptr<graph::RecordedPlan> recorded{};
        std::vector<ClothState> before{}, after{};             ///< handles that the step finds and leaves
        std::set<std::string, std::less<>> used{}, written{};  ///< resources
        const Step& step() const { return steps.back(); }
        bool runs() const { return !graph.passes().empty(); }
    };
    void find_singles();
    bool is_wanted(const Step& step) const;
    void build(Single& single);
    void run(Single& single);
    void upload(const Single& single);
    /// Uploads what the image does not hold already.
    /// Uploads and downloads a cloth's field, which is an image or, where cloths are together, a slice of one.
    void put(const Single& single, graph::Handle handle, const std::string& name, std::span<const std::byte> bytes);
    void get(const Single& single, graph::Handle handle, const std::string& name, std::vector<std::byte>& bytes) const;
    std::vector<FieldPair> fields(const Single& single);
    /// Adds what a step of a cloth left beside its images.
    void add_decision(const Single& single, std::size_t cloth, std::vector<FieldPair>& fields) const;

    const vulkan::Device& device_;
    const SimulationModel& model_;
    Twin& twin_;
    ClothSolver solver_;
    bool all_kernels_ = true;  ///< no step has a kernel that is not plain
    std::vector<std::unique_ptr<Single>> singles_;
    std::unique_ptr<graph::ResourcePool> pool_;
    std::unique_ptr<ContactMirror> contact_;
    std::map<std::string, std::vector<std::byte>, std::less<>> held_;  ///< what images are known to hold
    vulkan::FrameSlots slots_;
};

}  // namespace drape::test
