"""The text that a campaign ends with."""
import collections

import cases
import judge

DISTRIBUTIONS = {
    "substeps_mean": "substeps per frame, mean of a scene",
    "substeps_most": "substeps per frame, most",
    "redone_share": "redone frames, share",
    "sensitive_share": "sensitive frames, share",
    "stretch_rms": "worst RMS stretch error, m/m",
    "stretch_worst": "worst spring, m/m",
    "frame_s": "wall time, s per frame",
}
REFUSED_SHARE = 0.01  # of method auto's scenes


def singles_table(results):
    """Extremes alone by every method, with the kernels of auto."""
    by_name = {result["name"]: result["verdict"] for result in results}
    lines = [f"{'alone':<24}{'tier':<6}" + "".join(f"{method:<12}" for method in cases.METHODS).rstrip()]
    for tier, _, name, _ in cases.ROWS:
        row = [by_name.get(f"single/{name}/{method}", "-") for method in cases.METHODS]
        if set(row) != {"-"}:
            lines.append(f"{name:<24}{tier:<6}" + "".join(f"{verdict:<12}" for verdict in row).rstrip())
    return [*lines, ""] if len(lines) > 1 else []


def distributions(results):
    lines = [f"{'over scenes':<40}{'count':>6}{'least':>11}{'median':>11}{'90 %':>11}{'worst':>11}"]
    for name, words in DISTRIBUTIONS.items():
        values = sorted((result["numbers"][name], result["name"]) for result in results if result["numbers"])
        if values:
            at = [values[round(share * (len(values) - 1))] for share in (0, 0.5, 0.9, 1)]
            numbers = "".join(f"{value:>11.3g}" for value, _ in at)
            lines.append(f"{words:<40}{len(values):>6}{numbers}  {at[-1][1]}")
    return [*lines, ""]


def counts(results):
    """A line on the cases of each kind: "single", "pair", ..., a generator."""
    kinds = collections.defaultdict(collections.Counter)
    for result in results:
        kinds[result["name"].split("/")[0]][result["verdict"]] += 1
    return [f"{kind:<8}{sum(found.values()):>6} runs: " +
            ", ".join(f"{found[verdict]} {verdict}" for verdict in reversed(judge.VERDICTS))
            for kind, found in kinds.items()]


def text(results, of_auto):
    lines = distributions(results) if of_auto else singles_table(results)
    noted = ("refused", "impossible") if of_auto else ()
    short = [f"  {each['name']} ({each['tier']}): {each['verdict']}: {each['reason']}; {each['scene']}"
             for each in results if each["verdict"] in noted or each["verdict"] in judge.SHORT[each["tier"]]]
    if short:
        short = ["", "short of their tier, with the scene's file:", *short]
    return "\n".join([*lines, *counts(results), *short])


def fault(results, of_auto):
    """The reason for exit code 7; empty: there is none."""
    verdicts = collections.Counter(result["verdict"] for result in results)
    if verdicts["silent"] or verdicts["failed"]:
        return f"{verdicts['silent']} runs ended as done and were wrong, {verdicts['failed']} as no run may"
    if of_auto and verdicts["refused"] > REFUSED_SHARE * len(results):
        return f"method auto refused {verdicts['refused']} of {len(results)} scenes that it could follow"
    return ""
