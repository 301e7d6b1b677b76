// A scene run by the native kernels on one core or several.
#pragma once

#include <memory>
#include <vector>

#include "cloth/frame_steps.h"

namespace drape::native {

/// How the work of a frame is done.
struct NativeWay {
    int worker_count = 1;  ///< threads
    bool vectors = true;   ///< false: the same kernels compiled without vectors
};

/// The cloths of a scene that the native kernels can run: uniform, held by fixed pins at most, without wind, contact,
/// bending, tethers, and with springs in every direction. Several workers share the rows of a single cloth, or the
/// cloths where there are several.
class NativeRun {
  public:
    /// Throws std::invalid_argument for another scene. `model` must outlive this.
    NativeRun(const SimulationModel& model, NativeWay way);
    ~NativeRun();

    /// Frames one after the other, all the work of their substeps. Returns the milliseconds that each took.
    std::vector<double> run(int frame_count);

    /// m, row by row.
    std::vector<glsl::vec3> positions(std::size_t cloth) const;
    std::vector<glsl::vec3> displacements(std::size_t cloth) const;
    /// m, by first particle, as stored; method line.
    std::vector<float> tension(std::size_t cloth, std::size_t direction) const;

  private:
    class Sheet;
    int worker_count_;
    std::vector<std::unique_ptr<Sheet>> sheets_;
    std::vector<std::vector<Step>> steps_;  ///< of a frame, by cloth
};

}  // namespace drape::native
