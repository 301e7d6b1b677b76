// The frames of an ensemble's members. One server simulates members that share dispatches together; each other member
// has a server of its own.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "simulation/frame_server.h"
#include "simulation/member.h"

namespace drape {

/// The kinds of array that members hand out.
enum class MemberValue : std::uint8_t { position, velocity, normal, tension, contact_force };
inline constexpr std::size_t member_value_count = 5;

struct MemberFrameOptions {
    bool normals;
    Kernels kernels;
};

class MemberFrames {
  public:
    /// `share`: members share dispatches with the members of the same method. Simulates frame 0 of all members. Throws
    /// DeviceError, which says how many fit, before anything is allocated for members that share dispatches.
    MemberFrames(const vulkan::Device& device, Members& members, const MemberFrameOptions& options, bool share);
    MemberFrames(const MemberFrames&) = delete;
    MemberFrames& operator=(const MemberFrames&) = delete;

    /// Throws DeviceError, which says how many fit, where the device has no room for `count` members like these two
    /// that share dispatches.
    static void check_room(const vulkan::Device& device, const Members& two, std::size_t count,
                           const MemberFrameOptions& options);

    /// Tells the device's side of a member that actions changed its model.
    void take_actions(std::size_t number);
    /// Has the member's next frame simulated even if nothing moved for long.
    void wake(std::size_t number);
    /// Simulates each member's next frame by its model as it is now, and takes the statistics. `meanwhile` is called
    /// once, while the device works where that is possible.
    void step(const std::function<void()>& meanwhile);
    /// Returns members, whose host side has been reset, to their starts, with the statistics of frame 0.
    void reset(std::span<const std::size_t> numbers);
    /// Returns what the member's next frame depends on, except for its model.
    SimulationState save(std::size_t number) const;
    /// Restores the device's part of members' saved states. Throws Error where a state does not fit its member; members
    /// that share dispatches are then unchanged.
    void restore(std::span<const std::size_t> numbers, std::span<const SimulationState> states);
    MemberArray array(std::size_t cloth, MemberValue value) const;
    /// Updates the arrays that were handed out, after members went on or were restored.
    void refresh() const;
    std::size_t pass_count() const;
    double device_milliseconds() const;

  private:
    struct Group {
        std::vector<std::size_t> numbers;  ///< of the members, in the order of the server
        std::unique_ptr<FrameServer> server;
        bool lasting;  ///< arrays stay where the device left them until the next step
    };
    struct Seat {
        std::size_t group, place;
    };
    /// For each kind, an array for each cloth.
    using Arrays = std::array<std::vector<std::vector<float>>, member_value_count>;
    using Place = std::pair<std::size_t, MemberValue>;

    std::vector<std::vector<std::size_t>> groups_of(const vulkan::Device& device, bool share) const;
    void make_group(const vulkan::Device& device, const std::vector<std::size_t>& numbers);
    FrameServer& server_of(std::size_t number) const { return *groups_[seats_[number].group].server; }
    bool lasts(std::size_t number) const { return groups_[seats_[number].group].lasting; }
    /// Simulates these members up to the frames that they are to be at.
    void simulate(const std::vector<std::size_t>& numbers);
    void keep(std::size_t number, const FinishedFrame& finished);
    void put_back(std::size_t number);
    /// Writes a member's state into the arrays that the device left, where these are the ones handed out.
    void show(std::size_t number, const SimulationState& state);
    std::span<const float> view(std::size_t number, std::size_t cloth, MemberValue value) const;
    void begin_still_failed(const Group& group);

    Members& members_;
    MemberFrameOptions options_;
    std::vector<Group> groups_;
    std::vector<Seat> seats_;              ///< by member
    std::vector<Arrays> arrays_;           ///< by member; empty in a group that is `lasting`
    std::vector<SimulationState> starts_;  ///< by member; only of members with a server of their own
    std::vector<std::vector<ClothStatistics>> start_statistics_;  ///< by member
    std::vector<std::vector<BodyState>> start_bodies_;            ///< by member
    std::vector<char> over_;  ///< by member: it failed for good, and stays where it was
    std::function<void()> meanwhile_;
    mutable std::map<Place, std::vector<float>>
        gathered_;  ///< arrays of all members, copied where the device's are not evenly spaced
};

}  // namespace drape
