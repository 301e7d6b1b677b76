// Devices of a kind have these costs in common: from them follow what `auto` proposes and what a method leaves out. The
// kernels that are the fastest on each kind stand in solver/kernel_choice.cpp. `drape bench speed` measures a substep's
// time on a device, and with --tune that of every set of kernels.
#pragma once

#include "drape/solver_method.h"

namespace drape {

/// On a CPU every store of a pass counts; on a GPU small dispatches cost what the next one waits.
enum class DeviceKind { cpu, gpu };

/// A substep takes this of one cloth.
struct SubstepCost {
    double ms;           ///< in dispatches, however small the cloth is
    double particle_ns;  ///< besides, for each particle

    SubstepCost& operator+=(const SubstepCost& more) {
        ms += more.ms;
        particle_ns += more.particle_ns;
        return *this;
    }
};

struct DeviceCosts {
    SubstepCost line, explicit_steps, relax;  ///< by method, bare
    SubstepCost wind, collider_edges;         ///< what these add to any
    SubstepCost colliders;                    ///< what they add to any: the time for each particle times their number
    /// Boxes around lone pins are relaxed again and again by a workgroup each (cloth/nested_boxes.h); where this is
    /// false, more substeps are cheaper.
    bool nested_boxes;

    /// Returns the cost of a method that a scene can name.
    const SubstepCost& of(SolverMethod method) const;
};

/// Returns the costs on devices of a kind.
const DeviceCosts& costs_of(DeviceKind device);

}  // namespace drape
