#include "cloth/device_costs.h"

#include <stdexcept>

namespace drape {

namespace {

/// Lavapipe on 2 cores, Mesa 22.3.6, 24 November 2026.
constexpr DeviceCosts cpu{.line = {0.7, 200},
                          .explicit_steps = {0.07, 60},
                          .relax = {0.77, 140},
                          .wind = {0.07, 64},
                          .collider_edges = {0.14, 48},
                          .colliders = {0.07, 27},
                          .nested_boxes = true};
/// An H200, driver 580.159, 27 November 2026. Explicit steps are measured with tiles of 16x16.
constexpr DeviceCosts gpu{.line = {0.022, 0.45},
                          .explicit_steps = {0.0025, 0.043},
                          .relax = {0.0105, 0.17},
                          .wind = {0.003, 0.05},
                          .collider_edges = {0.006, 0.1},
                          .colliders = {0.003, 0.02},
                          .nested_boxes = false};

}  // namespace

const SubstepCost& DeviceCosts::of(SolverMethod method) const {
    switch (method) {
        case SolverMethod::line:
            return line;
        case SolverMethod::explicit_steps:
            return explicit_steps;
        case SolverMethod::relax:
            return relax;
        case SolverMethod::automatic:
            break;
    }
    throw std::logic_error("method auto has no cost of its own");
}

const DeviceCosts& costs_of(DeviceKind device) { return device == DeviceKind::cpu ? cpu : gpu; }

}  // namespace drape
