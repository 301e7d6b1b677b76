// The results of the stability benchmark, and its report.
#pragma once

#include <string>
#include <vector>

#include "bench/bench_run.h"
#include "bench/stability_case.h"

namespace drape::bench {

enum class Verdict {
    holds,      ///< the numbers of tier A
    bends,      ///< those of tier B: bounded, and it recovers
    refuses,    ///< the program said so: when it read the scene, or with exit code 5 or 8 and a reason
    unsettled,  ///< bounded, but not back under the law within `recovery_frames`
    fails,      ///< pins, box, energy, mass, flight or non-finite values: silently
};
inline constexpr Spelling<Verdict> verdict_spellings[] = {{"holds", Verdict::holds},
                                                          {"bends", Verdict::bends},
                                                          {"refuses", Verdict::refuses},
                                                          {"unsettled", Verdict::unsettled},
                                                          {"fails", Verdict::fails}};
constexpr const auto& spellings_of(Verdict) { return verdict_spellings; }

struct StabilityResult {
    std::string name, key;
    Verdict verdict = Verdict::fails;
    std::string reason;   ///< why it is not better
    std::string garbage;  ///< what the judge calls silent garbage; empty: nothing
    std::string method;   ///< in use
    Metrics numbers;      ///< stability_judge.h, and wall_s
    bool operator==(const StabilityResult&) const = default;

    template <class Self>
    static void members(Self& self, const auto& see) {
        see("name", self.name), see("key", self.key), see("verdict", self.verdict), see("reason", self.reason);
        see("garbage", self.garbage), see("method", self.method), see("numbers", self.numbers);
    }
};

/// Why a case falls short of its tier: A may not bend, B may not fail or stay unsettled, C must be refused. Empty:
/// nothing.
std::string shortfall(const StabilityCase& each, const StabilityResult& result);

struct StabilityReport : ReportHead {
    std::vector<StabilityCase> cases;  ///< those that were run
    std::vector<StabilityResult> results;
};

/// A table of the extremes alone, counts of the rest, and every case that falls short.
std::string stability_text(const StabilityReport& report);
std::string stability_json(const StabilityReport& report);
std::string stability_csv(const StabilityReport& report);
/// Extremes against extremes by one method, alone on the diagonal, as SVG: a colour and a letter for each verdict.
std::string stability_map(const StabilityReport& report, SolverMethod method);

}  // namespace drape::bench
