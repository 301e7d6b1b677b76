// How the frames of an ensemble's members are simulated: together, or each by a loop of its own.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "simulation/member.h"
#include "solver/cloth_solver.h"
#include "vulkan/device.h"

namespace drape {

/// The arrays that members hand out.
enum class MemberValue : std::uint8_t { position, velocity, normal };

class MemberRuns {
  public:
    virtual ~MemberRuns() = default;
    /// Simulates the frame after the one that each member is at, by its model as it is now, and takes its statistics.
    /// `meanwhile` is called while the device works, where it can be.
    virtual void step(const std::function<void()>& meanwhile) = 0;
    /// Takes members, which are as they begin again, to their starts, and their statistics there.
    virtual void reset(std::span<const std::size_t> members) = 0;
    /// Returns what the member's next frame depends on, beside its model.
    virtual SimulationState save(std::size_t member) const = 0;
    /// Takes members to saved states, as far as they are the device's. Throws Error where one is not of such a member,
    /// before any changes where they share dispatches.
    virtual void restore(std::span<const std::size_t> members, std::span<const SimulationState> states) = 0;
    /// Hands out the arrays of what members were taken to, where that did not.
    virtual void look() {}
    virtual MemberArray array(std::size_t cloth, MemberValue value) const = 0;
    /// Brings what arrays show that were handed out up to date, after members went on or were taken elsewhere.
    void refresh() const {
        for (const auto& [which, gathered] : gathered_) array(which.first, which.second);
    }
    virtual std::size_t pass_count() const = 0;
    virtual double device_milliseconds() const { return 0; }

  protected:
    /// Arrays of a cloth's values that do not lie evenly in what the device left.
    mutable std::map<std::pair<std::size_t, MemberValue>, std::vector<float>> gathered_;
};

using Members = std::vector<std::unique_ptr<Member>>;

struct MemberRunOptions {
    bool normals;
    Kernels kernels;
};

/// Adds the readbacks of what members hand out.
void add_look(graph::Graph& graph, ClothSolver& solver, bool normals);

/// Throws DeviceError, telling how many fit, where members of so many bytes each have no room on the device together.
void check_bytes(const vulkan::Device& device, std::uint64_t bytes_each, std::size_t count);
/// Do so for as many members as are like these two: that share dispatches, and that have lanes.
void check_lane_room(const vulkan::Device& device, Members& two, std::size_t count, const MemberRunOptions& options);
void check_room(const vulkan::Device& device, Members& two, std::size_t count, const MemberRunOptions& options);
/// Members share dispatches.
std::unique_ptr<MemberRuns> run_together(const vulkan::Device& device, Members& members,
                                         const MemberRunOptions& options);
/// Each has a frame loop, all of which ask one device for what they do and go along where that is the same.
std::unique_ptr<MemberRuns> run_in_lanes(const vulkan::Device& device, Members& members,
                                         const MemberRunOptions& options);
/// Each has a frame loop with a device of its own.
std::unique_ptr<MemberRuns> run_apart(const vulkan::Device& device, Members& members, const MemberRunOptions& options);

}  // namespace drape
