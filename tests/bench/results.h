// Makes results as a run would, for tests of what is done with them.
#pragma once

#include "bench/bench_case.h"

namespace drape::bench::test {

/// A result of swing/64/METHOD/SUBSTEPS with these errors and as many passes as substeps.
inline CaseResult swing_result(SolverMethod method, std::uint32_t substeps, double milliseconds, double position,
                               double stretch, std::uint32_t iterations = 1) {
    CaseResult result;
    result.problem = "swing";
    result.size = 64;
    result.method = method;
    result.substeps = substeps;
    result.iterations = iterations;
    result.name = "swing/64/" + std::string(named(method).name) + "/" + setting_name({method, substeps, iterations});
    result.key = result.name;
    result.passes = substeps * iterations;
    result.device = {milliseconds, milliseconds, 0};
    result.wall = {2 * milliseconds, 2 * milliseconds, 0};
    result.metrics = {{"position_rms", position}, {"stretch_error", stretch}, {"stretch_rms", stretch}};
    result.seconds = 1;
    return result;
}

}  // namespace drape::bench::test
