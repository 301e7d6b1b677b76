// Members whose steps differ, or work on all cloths of a scene at once, have a frame loop each.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "base/byte_stream.h"
#include "picture/frame_copy.h"
#include "simulation/frame_loop.h"
#include "simulation/member_runs.h"

namespace drape {

namespace {

constexpr const char* frame_part = "last frame";

class MembersApart : public MemberRuns {
  public:
    MembersApart(const vulkan::Device& device, Members& members, const MemberRunOptions& options) : members_(members) {
        loop_options_.draw = false;
        loop_options_.positions = loop_options_.velocities = loop_options_.statistics = true;
        loop_options_.normals = options.normals;
        loop_options_.kernels = options.kernels;
        loop_options_.keep_promises = false;
        frames_.resize(members.size());
        for (std::size_t k = 0; k < members.size(); ++k) {
            over_.push_back(false);
            try {
                loops_.push_back(std::make_unique<FrameLoop>(device, members[k]->model, loop_options_));
            } catch (const vulkan::VulkanError& error) {
                throw vulkan::VulkanError(fmt::format("{} of {} members fit: {}", k, members.size(), error.what()));
            }
            starts_.push_back(loops_.back()->save());
            simulate(k, 0);
        }
    }

    void step(const std::function<void()>& meanwhile) override {
        meanwhile();
        for (std::size_t k = 0; k < members_.size(); ++k) simulate(k, ++members_[k]->frame);
    }

    void reset(std::span<const std::size_t> numbers) override {
        for (const std::size_t number : numbers) {
            loops_[number]->restore(starts_[number]);
            over_[number] = false;
            simulate(number, 0);
        }
    }

    SimulationState save(std::size_t number) const override {
        if (!loops_[number]->can_save())
            throw Error(fmt::format("member {} cannot be saved in frame {}: method auto has begun a probe", number,
                                    members_[number]->frame));
        SimulationState state = loops_[number]->save();
        ByteWriter writer;
        const_cast<MembersApart*>(this)->transfer(writer, number);  // a writer changes nothing
        state[frame_part] = writer.take();
        return state;
    }

    void restore(std::span<const std::size_t> numbers, std::span<const SimulationState> states) override {
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            SimulationState state = states[i];
            const auto part = state.find(frame_part);
            if (part == state.end()) throw Error("the saved state is not of this scene: it has no last frame");
            ByteReader reader(part->second);
            transfer(reader, numbers[i]);
            state.erase(frame_part);
            loops_[numbers[i]]->restore(state);
        }
    }

    MemberArray array(std::size_t cloth, MemberValue value) const override {
        const Grid& grid = members_.front()->model.cloths[cloth].grid;
        const std::size_t stride = std::size_t{4} * grid.particle_count();
        std::vector<float>& gathered = gathered_[{cloth, value}];
        gathered.resize(stride * members_.size());
        for (std::size_t k = 0; k < members_.size(); ++k)
            std::ranges::copy(frames_[k][static_cast<std::size_t>(value)][cloth],
                              gathered.begin() + static_cast<std::ptrdiff_t>(k * stride));
        return {gathered.data(), members_.size(), grid.rows(), grid.columns(), stride};
    }
    std::size_t pass_count() const override {
        std::size_t count = 0;
        for (const auto& loop : loops_) count += loop->plan(FrameKind::simulate_and_output).passes.size();
        return count;
    }

  private:
    /// It has an array for each MemberValue and cloth.
    using Frame = std::array<std::vector<std::vector<float>>, 3>;

    void simulate(std::size_t number, std::uint32_t frame) {
        Member& member = *members_[number];
        if (over_[number]) return;
        try {
            loops_[number]->run(
                frame, [&](std::uint32_t each) { return each == frame; },
                [&](const FinishedFrame& finished) { keep(number, finished); });
        } catch (const FrameError& gave_up) {
            over_[number] = true;
            member.failure = gave_up.failure();
        }
    }
    void keep(std::size_t number, const FinishedFrame& finished) {
        members_[number]->statistics = finished.statistics;
        members_[number]->effort = finished.effort;
        const std::array all{&finished.positions, &finished.velocities, &finished.normals};
        for (std::size_t value = 0; value < all.size(); ++value) {
            frames_[number][value].clear();
            for (const std::span<const float> array : *all[value])
                frames_[number][value].emplace_back(array.begin(), array.end());
        }
    }
    template <class Archive>
    void transfer(Archive& archive, std::size_t number) {
        for (std::vector<std::vector<float>>& value : frames_[number])
            for (std::vector<float>& array : value) archive(array);
    }

    Members& members_;
    FrameLoopOptions loop_options_;
    std::vector<std::unique_ptr<FrameLoop>> loops_;
    std::vector<SimulationState> starts_;
    std::vector<Frame> frames_;
    std::vector<bool> over_;  ///< a loop gave up, and stays where it was
};

}  // namespace

std::unique_ptr<MemberRuns> run_apart(const vulkan::Device& device, Members& members, const MemberRunOptions& options) {
    return std::make_unique<MembersApart>(device, members, options);
}

}  // namespace drape
