// Runs one case on the device: once for its errors, then again for its time.
#pragma once

#include <functional>
#include <string>

#include "bench/bench_run.h"
#include "bench/problem.h"

namespace drape::bench {

/// A hash of all shader modules.
std::string shaders_hash();

/// "swing/64/relax/20"
std::string case_name(const Problem& problem, std::uint32_t size, const Setting& setting);

/// Hash of all that decides a case's result: what the device is given (initial state, constants, steps,
/// shader modules), device and driver, program version, the problem, and how it is measured.
std::string case_key(const DeviceInfo& device, const Problem& problem, std::uint32_t size, const Setting& setting);

/// Passes per frame x particles x frames: what a case's run time goes by, with a share per dispatch.
double case_work(const DeviceInfo& device, const Problem& problem, std::uint32_t size, const Setting& setting);

/// Throws DeviceError, Stopped, and what the references throw. `stop` is asked before every frame.
CaseResult run_case(const Device& device, const Problem& problem, std::uint32_t size, const Setting& setting,
                    References& references, const std::function<bool()>& stop);

}  // namespace drape::bench
