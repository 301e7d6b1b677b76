// The plain steps of a frame, which the twin takes, in the order of the device's, of which some do several at once.
#pragma once

#include <vector>

#include "cloth/step.h"
#include "reference/twin.h"

namespace drape::test {

class TwinSteps {
  public:
    /// `steps` are the twin's (Twin::steps).
    TwinSteps(std::vector<Step> steps, std::size_t cloth_count);

    /// Takes what one of the device's steps, which is taken for these cloths, does: the plain steps of each cloth up to
    /// its like, or, where it joins others and has none, up to the last of the same kind, substep and iteration. So a
    /// step that a kernel does beside its own, before it, is taken too.
    void take(Twin& twin, const FrameInputs& inputs, const Step& step, const std::vector<std::size_t>& cloths);
    /// Returns whether all steps were taken.
    bool done() const;

  private:
    /// The steps of a cloth; the last list has those of all of them.
    struct Lane {
        std::vector<Step> steps;
        std::size_t next = 0;
    };
    static std::size_t end_of(const Lane& lane, const Step& step);
    std::vector<Lane> lanes_;
};

}  // namespace drape::test
