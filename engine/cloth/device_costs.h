// The costs that devices of a kind have in common. They decide what `auto` proposes and which steps a method leaves
// out. The fastest kernels for each kind are listed in solver/kernel_choice.cpp. `drape bench speed` measures the time
// of a substep on a device, and with --tune that of every combination of kernels.
#pragma once

#include "drape/solver_method.h"

namespace drape {

/// On a CPU every store of a pass costs time; on a GPU the cost of small dispatches is how long the next one waits.
enum class DeviceKind { cpu, gpu };

/// The cost of a substep of one cloth.
struct SubstepCost {
    double ms;           ///< of its dispatches, however small the cloth is
    double particle_ns;  ///< in addition, for each particle

    SubstepCost& operator+=(const SubstepCost& more) {
        ms += more.ms;
        particle_ns += more.particle_ns;
        return *this;
    }
};

struct DeviceCosts {
    SubstepCost line, explicit_steps, relax;  ///< by method, with nothing else
    SubstepCost wind, collider_edges;         ///< added to any method
    SubstepCost colliders;  ///< added to any method: the time per particle, times the number of colliders
    /// true: a workgroup each relaxes boxes around lone pins repeatedly (cloth/nested_boxes.h). false: more substeps
    /// are cheaper.
    bool nested_boxes;

    /// Returns the cost of a method that a scene can name.
    const SubstepCost& of(SolverMethod method) const;
};

/// Returns the costs on devices of a kind.
const DeviceCosts& costs_of(DeviceKind device);

}  // namespace drape
