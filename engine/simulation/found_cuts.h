// What a search for cuts and tears found at the end of a frame acts from the next one on.
#pragma once

#include <functional>

#include "simulation/frame_graphs.h"

namespace drape {

struct CutEvent {
    std::uint32_t frame;
    std::size_t cloth;
    CutCounts counts;
};
/// Is told each cut, with the cloth's topology after it.
using CutListener = std::function<void(const CutEvent&, const CutTopology&)>;

/// Takes what the slot's last search found into the topologies, and gives the device what follows from it. Nothing may
/// be in flight, and what the slot handed out is gone. Returns whether a cloth tore.
bool take_cuts(FrameGraphs& graphs, std::uint32_t slot, std::uint32_t frame, const CutListener& listener);

}  // namespace drape
