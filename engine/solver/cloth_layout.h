// How the cloths of a scene lie on the device: which are simulated together, what cuts have left of each, how long the
// lists of contact are. The passes of all graphs follow it, and so does what the host puts into their resources
// (state_transfer.h, host_inputs.h) and reads of them.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "cloth/cut_topology.h"
#include "solver/pass_kit.h"

namespace drape {

/// Cloths that are simulated together. Their images of a field lie below each other in one image.
struct Together {
    std::vector<std::size_t> cloths;
    bool unlike;                                                           ///< they differ in numbers of the scene
    std::string name;                                                      ///< of their state; no cloth has it
    std::map<std::uint32_t, std::shared_ptr<ClothConstants>> constants{};  ///< by substeps per frame
    /// Of the passes of all graphs.
    std::shared_ptr<std::vector<glsl::uvec4>> sizes_of_present = std::make_shared<std::vector<glsl::uvec4>>();
};

struct ContactLists {
    ContactCapacity capacity{};    ///< entries that they have room for from the next `declare` on
    std::uint64_t most_bytes = 0;  ///< of each
    /// Returns whether they get all the room that is wanted.
    bool resize(const ContactCapacity& wanted) {
        capacity = limited(wanted, most_bytes);
        return capacity == wanted;
    }
};

struct ClothLayout {
    /// Throws VulkanError when the device has not what a kernel that is asked for needs.
    ClothLayout(const vulkan::Device& device, const SimulationModel& of, const Kernels& wanted);

    /// Returns whether every cloth is simulated together with another.
    bool all_together() const;
    bool is_alone(std::size_t cloth) const { return list_of_[cloth] == together.size(); }
    /// Returns the place in `together` of those that a cloth is one of.
    std::size_t list_of(std::size_t cloth) const { return list_of_[cloth]; }
    /// Returns a cloth's place among those that it is together with.
    std::uint32_t place_of(std::size_t cloth) const { return place_of_[cloth]; }
    /// Returns the name of the state that a cloth's is a part of.
    const std::string& state_name(std::size_t cloth) const;
    /// Returns a cloth's part of what a pass over its state left on the host.
    std::span<const std::byte> part_of(std::size_t cloth, const vulkan::Buffer& of_state) const;
    /// Returns each cloth's part of the slot's buffer with a name that `name_of` gives for the state.
    template <class NameOf>
    std::vector<std::span<const std::byte>> parts(const graph::ResourcePool& pool, std::uint32_t slot,
                                                  const NameOf& name_of) const {
        std::vector<std::span<const std::byte>> all;
        for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth)
            all.push_back(part_of(cloth, pool.buffer(name_of(state_name(cloth)), slot)));
        return all;
    }
    /// Returns the cloths that a step is taken for.
    std::vector<std::size_t> cloths_of(const Step& step) const;
    FieldContext context(std::size_t cloth) const { return context(cloth, {}, model); }
    FieldContext context(std::size_t cloth, const FrameNeeds& needs, const SimulationModel& run) const {
        return {run, run.cloths[cloth], topologies[cloth], needs};
    }

    const SimulationModel& model;
    const Kernels kernels;  ///< those that steps may use
    /// The topology that cuts have left of each cloth. A change acts from the next `declare` or `upload_cut` on.
    std::vector<CutTopology> topologies;
    std::vector<Together> together;
    /// The sizes that iterations of each cloth choose from, which the graphs of all kinds of frames share.
    std::vector<std::shared_ptr<std::vector<glsl::uvec4>>> iteration_sizes;
    ContactLists lists;

  private:
    void find_together(const vulkan::Device& device);

    std::vector<std::size_t> list_of_;  ///< the size of `together`: alone
    std::vector<std::uint32_t> place_of_;
};

}  // namespace drape
