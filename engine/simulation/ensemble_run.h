// The frames of simulations that go on together are the ensemble's, or of loops in lanes of one device.
#pragma once

#include <functional>

#include "drape/ensemble.h"
#include "simulation/frame_loop.h"

namespace drape {

struct EnsembleRun::Parts {
    virtual ~Parts() = default;
    virtual void run(const std::function<void(std::size_t)>& simulate) = 0;
    /// Makes a member's frame loop take part.
    virtual void join(std::size_t member, FrameLoopOptions& options) = 0;
};

}  // namespace drape
