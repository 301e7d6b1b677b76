// Applies the cuts and tears that a search found at the end of a frame. They take effect in the next frame.
#pragma once

#include <functional>

#include "simulation/frame_graphs.h"

namespace drape {

struct CutEvent {
    std::uint32_t frame;
    std::size_t cloth;
    CutCounts counts;
};
/// Receives each cut, with the cloth's topology after it.
using CutListener = std::function<void(const CutEvent&, const CutTopology&)>;

/// Adds what the slot's last search found to the topologies, and uploads what changes on the device. No submit may be
/// in flight; the slot's frame, if it was handed out, becomes invalid. Returns whether a cloth tore.
bool take_cuts(FrameGraphs& graphs, std::uint32_t slot, std::uint32_t frame, const CutListener& listener);

}  // namespace drape
