"""Judges a run by what the program judges by: exit code, warnings, the manifest's numbers, and `drape verify`.

A scene promises, as its oracles, what every run of it must keep; `drape verify FILE` then says of the written scene
what is wrong. It looks at every frame anew, by a watch of its own and from positions alone, and so tells whether a run
that ended as done was one.
"""
import math
import re

OK, SCENE, DIVERGED, TOLERANCE = 0, 3, 5, 8

# From the worst to the best.
VERDICTS = {
    "failed": "ended as no run may: a crash, a time limit, another exit code than 0, 3, 5 and 8",
    "silent": "ended as done, but `drape verify` finds a frame that is no result, or a promise that is not kept",
    "refused": "the scene was refused, or the run ended with exit code 5 or 8 and a reason",
    "impossible": "refused, and the program says what of the scene no method can follow",
    "unsettled": "the program warns that the cloth has not settled when the run ends",
    "warned": "the program warns of something else than what it left to the substeps that were asked for",
    "bends": "nothing is said, and the last frames are above the bounds of an accurate run",
    "holds": "within them",
}
# A case of a tier may have none of these verdicts.
SHORT = {
    "A": {"failed", "silent", "refused", "impossible", "unsettled", "warned", "bends"},
    "B": {"failed", "silent", "unsettled"},
    "C": set(VERDICTS) - {"refused"},
}
# Bounds of an accurate run's last frames.
BOUNDS = (
    ("stretch_end", 0.06, "the watch's bound of cloth that its substeps resolve: 3 x 0.02 (engine/control/watch.h)"),
    ("penetration_end", 1e-3, "of an edge: contact leads every particle out, to rounding and what one substep moves"),
)
LAST_FRAMES = 6  # as many as the watch takes for more than a snap
WORST_SPRING = 0.1  # what method auto keeps where a scene asks for nothing (tolerance_worst)
ROUNDING = 1e-6  # eight units of the last place in single precision


def is_strained(cloth):
    return any(key in cloth["placement"] for key in ("scale", "jitter"))


def flown(scene, cloth):
    """The farthest that free cloth gets in the run: v0 e + g (t - e)/c with e = (1 - exp(-c t))/c."""
    time, c = (scene["time"]["frames"] - 1) / scene["time"]["fps"], cloth.get("damping", 0)
    gone = -math.expm1(-c * time) / c if c else time
    fallen = (time - gone) / c if c else 0.5 * time * time
    gravity, velocity = scene.get("gravity", [0, -9.81, 0]), cloth.get("velocity", [0, 0, 0])
    return max(abs(gone * v) + abs(fallen * g) for v, g in zip(velocity, gravity))


def reach(cloth):
    """The farthest that a coordinate is from the origin at the start, m."""
    return max(map(abs, cloth["placement"]["origin"])) + sum(cloth["size"])


def promises(scene):
    """The oracles that every run of a scene must keep."""
    every, cloths = [], scene["cloths"]
    fps, end = scene["time"]["fps"], (scene["time"]["frames"] - 1) / scene["time"]["fps"]
    pins = [(cloth, pin) for cloth in cloths for pin in cloth.get("pins", [])]
    if any("path" not in pin and "release" not in pin for _, pin in pins):
        every.append({"check": "pins_hold"})
    let_go = [pin for _, pin in pins if "release" in pin]
    if let_go and not any("path" in pin for pin in let_go) and any(scene.get("gravity", [9.81])):
        # Until then they hold to the bit; how far the cloth falls after is not promised.
        every.append({"check": "released", "seconds": 1, "least": -1e30, "most": 1e30})
    moved = [(cloth, pin) for cloth, pin in pins
             if len(pin.get("path", [])) > 1 and min(pin.get("release", end), end) > pin["path"][0]["t"] + 2 / fps]
    if moved:
        farthest = max(1 + reach(cloth) + sum(map(abs, pin.get("pivot", [0]))) +
                       max(sum(map(abs, key.get("translate", [0]))) for key in pin["path"]) for cloth, pin in moved)
        every.append({"check": "pins_follow", "error": ROUNDING * farthest})
    blows = any(scene.get("wind", {}).get("velocity", [0]))
    collides = any(scene.get("colliders", {}).values())
    for index, cloth in enumerate(cloths):
        if not (cloth.get("pins") or blows or collides or is_strained(cloth)):
            few = scene.get("solver", {}).get("method", "auto") != "auto" and scene["solver"]["substeps"] <= 64
            way = max(reach(cloth), flown(scene, cloth))
            every.append({"check": "falls", "cloth": index, "from_row": 0, "until_frame": scene["time"]["frames"] - 1,
                          "error": (10 if few else 100) * ROUNDING * way})
    if scene.get("cutters"):
        every.append({"check": "mass_kept", "relative_error": ROUNDING})
    if any(cloth.get("self_collision") for cloth in cloths):
        every.append({"check": "uncrossed"})
    return every


def numbers_of(manifest, scene):
    """Numbers of a finished run, SI units; frame 0 does not count."""
    frames, names = manifest["statistics"][1:], [cloth.get("name", "cloth") for cloth in scene["cloths"]]
    edge = min(side / (count - 1) for cloth in scene["cloths"] for side, count in zip(cloth["size"], cloth["grid"]))

    def worst(rows, key):
        values = [row.get(f"{name}/{key}", 0) for row in rows for name in names]
        return max((math.inf if value is None else value for value in values), default=0)  # JSON has no other word

    def mean(key, otherwise):
        return sum(row.get(key, otherwise) for row in frames) / max(len(frames), 1)

    substeps = manifest["solver"]["substeps"]
    return {"frames": len(frames), "stretch_rms": worst(frames, "stretch_error_rms"),
            "stretch_worst": worst(frames, "stretch_error_max"),
            "stretch_end": worst(frames[-LAST_FRAMES:], "stretch_error_max"),
            "penetration_end": worst(frames[-LAST_FRAMES:], "penetration_m") / edge,
            "substeps_mean": mean("substeps", substeps),
            "substeps_most": max((row.get("substeps", substeps) for row in frames), default=substeps),
            "redone_share": sum(row.get("attempts", 1) > 1 for row in frames) / max(len(frames), 1),
            "sensitive_share": mean("sensitive", 0)}


def over_limits(manifest, scene, numbers):
    """The numbers of frames that method auto handed out though they are over the limits that it keeps."""
    if manifest["solver"].get("asked") != "auto":
        return []
    limits = {"stretch_rms": manifest["solver"]["tolerance"],
              "stretch_worst": scene.get("solver", {}).get("tolerance_worst", WORST_SPRING)}
    return [f"{name} {numbers[name]:.3g}, limit {limit:g}" for name, limit in limits.items()
            if not numbers[name] <= limit]


def told(manifest, path):
    """The warnings of a run: neither about the scene's text nor about what explicit steps soften, which it states."""
    stated = tuple(f"{each['what']}:" for each in manifest["compromises"])
    return [text for text in manifest["warnings"] if not text.startswith((str(path), *stated))]


def refusal(code, said):
    """Verdict and reason of a run that did not end as done; `code` is nothing where time ended it."""
    errors = [line for line in said.splitlines() if not line.startswith(("warning:", "note:"))]
    reason = next((line for line in errors if line), "no word") if code is not None else "still running"
    if code not in (SCENE, DIVERGED, TOLERANCE):
        return "failed", f"exit code {code}: {reason}"
    why = re.search("the most that method auto tries; (?!what was written before)", reason)
    return "impossible" if why else "refused", reason


def missed(report):
    """The checks of `drape verify` that are not met. Of the motion a run warns, too."""
    return [f"{check['check']}: {check['text']}" for check in report["checks"]
            if not check["met"] and check["check"] != "motion"] + [str(error) for error in report["errors"]]


def beyond(numbers):
    """The first number of the last frames that is over its bound; empty: none."""
    return next((f"{name} {numbers[name]:.3g}, bound {bound:g}" for name, bound, _ in BOUNDS
                 if not numbers[name] <= bound), "")


def verdict(warnings, numbers, broken):
    """Verdict and reason of a run that ended as done."""
    if broken:
        return "silent", "; ".join(broken)
    if warnings:
        late = [text for text in warnings if "has not settled" in text]
        return ("unsettled", late[0]) if late else ("warned", "; ".join(warnings))
    over = beyond(numbers)
    return ("bends", over) if over else ("holds", "")
