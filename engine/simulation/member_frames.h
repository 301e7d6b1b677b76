// The frames of an ensemble's members: served together by one device where they share dispatches, else each by a server
// of its own.
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

/// The arrays that members hand out.
enum class MemberValue : std::uint8_t { position, velocity, normal };
inline constexpr std::size_t member_value_count = 3;

using Members = std::vector<std::unique_ptr<Member>>;

struct MemberFrameOptions {
    bool normals;
    Kernels kernels;
};

class MemberFrames {
  public:
    /// `share`: members share dispatches, those of one method with each other. Frame 0 of all is there then. Throws
    /// DeviceError, telling how many fit, before anything is allocated for members that share dispatches.
    MemberFrames(const vulkan::Device& device, Members& members, const MemberFrameOptions& options, bool share);
    MemberFrames(const MemberFrames&) = delete;
    MemberFrames& operator=(const MemberFrames&) = delete;

    /// Throws DeviceError, telling how many fit, where so many members as these two are, which share dispatches, have
    /// no room on the device.
    static void check_room(const vulkan::Device& device, const Members& two, std::size_t count,
                           const MemberFrameOptions& options);

    /// Simulates the frame after the one that each member is at, by its model as it is now, and takes its statistics.
    /// `meanwhile` is called once, while the device works where it can be.
    void step(const std::function<void()>& meanwhile);
    /// Takes members, which are as they begin again, to their starts, and their statistics there.
    void reset(std::span<const std::size_t> numbers);
    /// Returns what the member's next frame depends on, beside its model.
    SimulationState save(std::size_t number) const;
    /// Takes members to saved states, as far as they are the device's. Throws Error where one is not of such a member;
    /// those that share dispatches are then as they were.
    void restore(std::span<const std::size_t> numbers, std::span<const SimulationState> states);
    MemberArray array(std::size_t cloth, MemberValue value) const;
    /// Brings what arrays show that were handed out up to date, after members went on or were taken elsewhere.
    void refresh() const;
    std::size_t pass_count() const;
    double device_milliseconds() const;

  private:
    struct Group {
        std::vector<std::size_t> numbers;  ///< of members, by their places in the server
        std::unique_ptr<FrameServer> server;
        bool lasting;  ///< arrays lie where the device left them until the next step
    };
    struct Seat {
        std::size_t group, place;
    };
    /// Each has an array for each cloth.
    using Arrays = std::array<std::vector<std::vector<float>>, member_value_count>;
    using Place = std::pair<std::size_t, MemberValue>;

    std::vector<std::vector<std::size_t>> groups_of(const vulkan::Device& device, bool share) const;
    void make_group(const vulkan::Device& device, const std::vector<std::size_t>& numbers);
    FrameServer& server_of(std::size_t number) const { return *groups_[seats_[number].group].server; }
    bool lasts(std::size_t number) const { return groups_[seats_[number].group].lasting; }
    /// Brings members to the frames that they are to be at.
    void simulate(const std::vector<std::size_t>& numbers);
    void keep(std::size_t number, const FinishedFrame& finished);
    void put_back(std::size_t number);
    /// Shows what a lasting member's state is, in the arrays that the device left.
    void show(std::size_t number, const SimulationState& state);
    std::span<const float> view(std::size_t number, std::size_t cloth, MemberValue value) const;
    void begin_still_failed(const Group& group);

    Members& members_;
    MemberFrameOptions options_;
    std::vector<Group> groups_;
    std::vector<Seat> seats_;                                     ///< by member
    std::vector<Arrays> arrays_;                                  ///< by member; empty where they last
    std::vector<SimulationState> starts_;                         ///< by member; those of members alone
    std::vector<std::vector<ClothStatistics>> start_statistics_;  ///< by member
    std::vector<char> over_;                                      ///< by member: it gave up, and stays where it was
    std::function<void()> meanwhile_;
    mutable std::map<Place, std::vector<float>> gathered_;  ///< arrays of all members that do not lie evenly
};

}  // namespace drape
