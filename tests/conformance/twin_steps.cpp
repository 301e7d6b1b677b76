#include "twin_steps.h"

#include <algorithm>

namespace drape::test {

namespace {

/// The plain steps of one cloth, or of all at once, in order.
class Lane {
  public:
    void add(const Step& step) { steps_.push_back(step); }

    /// Takes the steps of one of the device's, before the `next` one of the lane; null: all that are left.
    std::vector<Step> take(const Step& step, const Step* next) {
        std::size_t end = begin_of(step, begin_);
        // Several substeps at once end with the last one.
        for (std::uint32_t k = 1; k < step.count && end < steps_.size(); ++k) {
            Step later = step;
            later.substep += k;
            end = begin_of(later, end + 1);
        }
        // One that has no like joins all of one kind.
        while (end + 1 < steps_.size() && steps_[end].kind != step.kind && are_alike(steps_[end], steps_[end + 1]))
            ++end;
        end = next ? begin_of(*next, std::min(end + 1, steps_.size())) : steps_.size();
        const std::vector<Step> taken(at(begin_), at(end));
        begin_ = end;
        return taken;
    }

  private:
    std::vector<Step>::const_iterator at(std::size_t place) const {
        return steps_.begin() + static_cast<std::ptrdiff_t>(place);
    }
    static bool are_beside(const Step& one, const Step& other) {
        return one.substep == other.substep && one.iteration == other.iteration;
    }
    static bool are_alike(const Step& one, const Step& other) {
        return one.kind == other.kind && are_beside(one, other);
    }
    /// Returns where a step of the device begins, from a place on.
    std::size_t begin_of(const Step& step, std::size_t from) const {
        auto found = std::find_if(at(from), steps_.end(), [&](const Step& plain) { return are_alike(plain, step); });
        if (found == steps_.end())
            found = std::find_if(at(from), steps_.end(), [&](const Step& plain) { return are_beside(plain, step); });
        return static_cast<std::size_t>(found - steps_.begin());
    }

    std::vector<Step> steps_;
    std::size_t begin_ = 0;
};

}  // namespace

std::vector<std::vector<Step>> twin_steps(const std::vector<Step>& plain, const std::vector<DeviceStep>& device,
                                          std::size_t cloth_count) {
    std::vector<Lane> lanes(cloth_count + 1);  // the last one is of all cloths at once
    for (const Step& step : plain) lanes[std::min(step.cloth, cloth_count)].add(step);
    const auto lanes_of = [&](const DeviceStep& each) {
        return each.step.cloth < cloth_count ? each.cloths : std::vector<std::size_t>{cloth_count};
    };
    std::vector<const Step*> next(lanes.size());
    std::vector<std::vector<const Step*>> nexts(device.size());  // by step and lane of its own
    for (std::size_t k = device.size(); k-- > 0;)
        for (const std::size_t lane : lanes_of(device[k])) {
            nexts[k].push_back(next[lane]);
            next[lane] = &device[k].step;
        }
    std::vector<std::vector<Step>> all(device.size());
    for (std::size_t k = 0; k < device.size(); ++k) {
        const std::vector<std::size_t> own = lanes_of(device[k]);
        for (std::size_t place = 0; place < own.size(); ++place) {
            const std::vector<Step> taken = lanes[own[place]].take(device[k].step, nexts[k][place]);
            all[k].insert(all[k].end(), taken.begin(), taken.end());
        }
    }
    return all;
}

}  // namespace drape::test
