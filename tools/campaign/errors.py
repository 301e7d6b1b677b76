"""What method auto says of its errors, beside what they are: against finer runs of the same scene, frame by frame.

A reference is the scene by method line at many fixed substeps. Its own error is taken for its distance from half as
many, which it is where errors fall at least in proportion to the step; a frame is compared as long as that is below a
quarter of what the motion's limit allows. A twin, the coarser of the two displaced by a millionth of each cloth's size,
tells whether equally exact runs part.
"""
import array
import json
import math
import pathlib
import re
import tempfile
import time

import cases
import judge
from runner import DEVICE, NoDevice, Runner

COMPARABLE = 0.25  # of what is allowed: by how much the reference may be off in a frame that is compared
MEASURED = 3  # times the reference's own error: from there on a distance from it is an error, to a third of it
WITHIN = 3  # the factor within which docs/accuracy.md says that a stated error is right
SILENT = 3  # times its limit: an error of which a run must speak
DISTURBED = 1e-6  # of a cloth's longer side
# What a run says of its motion: kind, and the words that tell it, with their numbers.
WORDS = {
    "far off": r"at frame (?P<frame>\d+) positions are about (?P<error>\S+) mm from the exact motion",
    "grows fast": r"(?P<count>\d+) frames were kept in which the motion's error grew faster than .*"
                  r": (?P<times>\S+) times as fast at frame (?P<frame>\d+), the worst",
    "stands on a point": r"at frame (?P<frame>\d+) the run stands on a point: .* left it by (?P<parted>\S+) mm",
    "sensitive": r"the motion is sensitive from frame (?P<frame>\d+) on: .* had parted by (?P<parted>\S+) mm"}


def positions_of(folder, scene):
    """By cloth and frame: x y z of every particle, m."""
    every = []
    for cloth in scene["cloths"]:
        name = "positions.npy" if len(scene["cloths"]) == 1 else f"positions_{cloth['name']}.npy"
        data = pathlib.Path(folder, name).read_bytes()
        values = array.array("f", data[10 + int.from_bytes(data[8:10], "little"):])
        size = 3 * cloth["grid"][0] * cloth["grid"][1]
        every.append([values[at:at + size] for at in range(0, len(values), size)])
    return every


def rms_between(a, b):
    """By cloth and frame: the RMS distance of their particles, m."""
    return [[math.sqrt(3 * sum((p - q) ** 2 for p, q in zip(one, other)) / len(one))
             for one, other in zip(*frames)] for frames in zip(a, b)]


def motion_limits(scene):
    """By cloth, m/s: what docs/solvers.md says of tolerance_motion."""
    share = scene.get("solver", {}).get("tolerance_motion", 0.02)
    return [share * max(max(cloth["size"]), math.sqrt(max(cloth["size"]))) for cloth in scene["cloths"]]


def worst_frame(scene, statistics, found, own):
    """Of the frames that can be compared, the one in which an error is the largest share of what is allowed."""
    fps, worst = scene["time"]["fps"], None
    for limit, errors, off in zip(motion_limits(scene), found, own):
        for frame in range(1, len(errors)):
            allowed = limit * max(frame / fps, 0.5)
            if not off[frame] <= COMPARABLE * allowed:
                break
            if worst is None or errors[frame] / allowed > worst["share"]:
                worst = {"frame": frame, "share": errors[frame] / allowed, "true": errors[frame], "own": off[frame],
                         "stated": statistics[frame].get("position_error_m")}
    return worst


def shares(scene, errors):
    """By frame: the largest share of what is allowed, over the cloths."""
    fps = scene["time"]["fps"]
    return [max(rows[frame] / (limit * max(frame / fps, 0.5)) for limit, rows in zip(motion_limits(scene), errors))
            for frame in range(len(errors[0]))]


def growths(scene, errors):
    """By frame: how fast errors grew within the tenth of a second before, over the motion's limit."""
    fps = scene["time"]["fps"]
    probe = max(1, round(fps / 10))
    return [max((rows[frame] - rows[max(frame - probe, 0)]) * fps / (probe * limit)
                for limit, rows in zip(motion_limits(scene), errors)) for frame in range(len(errors[0]))]


def over_limit(said, scene, errors, own):
    """Whether an error is over its limit in the frame that is named, or, where it is in that frame what was said
    within the factor, in another that can be compared; nothing where the reference cannot tell."""
    frame, over, doubts = int(said["frame"]), shares(scene, errors), shares(scene, own)
    if over[frame] - 1 >= doubts[frame]:
        return True
    if over[frame] + doubts[frame] > 1:
        return None
    about = float(said["error"]) / 1000 / max(max(rows[frame] for rows in errors), 1e-9)
    elsewhere = any(share > 1 and doubt <= COMPARABLE for share, doubt in zip(over, doubts))
    return 1 / WITHIN <= about <= WITHIN and elsewhere


def is_true(kind, said, scene, errors, own, apart):
    """Whether what a run says is so; nothing where the reference cannot tell. `errors`, `own`, `apart`: of the run, of
    the reference, of the twin, by cloth and frame. A distance is confirmed by a third of it, since the estimates are
    right within a factor by their own words."""
    frame = int(said["frame"])
    if kind == "far off":
        return over_limit(said, scene, errors, own)
    if kind == "grows fast":
        return max(growths(scene, errors)[frame:frame + max(1, round(scene["time"]["fps"] / 10))]) > 1 or \
            max(shares(scene, errors)) > 1
    parted = max(max(rows[frame:]) for rows in apart)
    return parted >= float(said["parted"]) / 1000 / WITHIN


class ErrorRunner(Runner):
    """Runs a scene by auto and by references, and compares."""

    def key(self, case):
        return f"{super().key(case)}-{self.options.reference_substeps}"

    def positions(self, scene, folder):
        """(exit code; what was said; positions and manifest, where there are some)"""
        path = pathlib.Path(folder, "scene.json")
        path.write_text(cases.text_of(scene))
        out = pathlib.Path(folder, "out")
        code, _, said = self.drape("simulate", path, "-o", out, "--export", "npy", "--checkpoint", "never")
        if code == DEVICE:
            raise NoDevice(said.strip())
        if code != 0:
            return code, said, None, None
        return code, said, positions_of(out, scene), json.loads((out / "manifest.json").read_text())

    def fixed(self, scene, substeps, disturbed=False):
        """The positions by line at so many substeps in a sixtieth of a second; nothing where it ends otherwise."""
        changed = json.loads(json.dumps(scene))
        changed["solver"] = {"method": "line", "substeps": max(1, round(substeps * 60 / scene["time"]["fps"]))}
        for cloth in changed["cloths"] if disturbed else ():
            cloth["placement"]["jitter"] = DISTURBED * max(cloth["size"])
        with tempfile.TemporaryDirectory() as folder:
            return self.positions(changed, folder)[2]

    def compare(self, scene, found, manifest, said):
        """What a run says beside what is so."""
        most = self.options.reference_substeps
        fine, half = self.fixed(scene, most), self.fixed(scene, most // 2)
        twin = half and self.fixed(scene, most // 2, disturbed=True)
        if not fine or not twin:
            return {"verdict": "no reference", "reason": "finer runs end without positions"}
        errors, own, apart = rms_between(found, fine), rms_between(fine, half), rms_between(half, twin)
        worst = worst_frame(scene, manifest["statistics"], errors, own)
        lines = said.splitlines()
        words = [(kind, match.groupdict()) for kind, pattern in WORDS.items() for line in lines
                 if (match := re.search(pattern, line))]
        told = [dict(each, kind=kind, true=is_true(kind, each, scene, errors, own, apart),
                     share=shares(scene, errors)[int(each["frame"])]) for kind, each in words]
        parted = max(shares(scene, apart))
        return {"verdict": "", "reason": "", "worst": worst, "words": told, "parted": parted,
                "other": [text for text in judge.told(manifest, "") if not any(re.search(p, text)
                                                                               for p in WORDS.values())]}

    def run(self, case):
        path = self.folder / "scenes" / (re.sub(r"[^\w.+-]+", "_", case.name) + ".json")
        path.write_text(cases.text_of(case.scene))
        begun = time.monotonic()
        with tempfile.TemporaryDirectory() as folder:
            code, said, found, manifest = self.positions(case.scene, folder)
        result = {"name": case.name, "scene": str(path)}
        if found:
            result.update(self.compare(case.scene, found, manifest, said), method=manifest["solver"]["method"])
            result["verdict"] = result["verdict"] or verdict(result)
        else:
            result["verdict"], result["reason"] = judge.refusal(code, said)
        if result["verdict"] == "fits" and not self.options.keep:
            path.unlink()
        return dict(result, seconds=round(time.monotonic() - begun, 2))


def ratio(result):
    """The stated error over the true one in the worst frame; nothing where one of them is not known."""
    worst = result.get("worst")
    if not worst or not worst["stated"] or worst["true"] < MEASURED * worst["own"]:
        return None
    return worst["stated"] / worst["true"]


def verdict(result):
    if result["worst"] and result["worst"]["share"] > SILENT and not result["words"]:
        return "silent"
    return "untrue" if any(each["true"] is False for each in result["words"]) else "fits"


TOLD = {True: "true", False: "FALSE", None: "?"}


def middle(values):
    values = sorted(values)
    return (values[(len(values) - 1) // 2] + values[len(values) // 2]) / 2


def text(results):
    """A line for each scene, and what they come to."""
    lines = [f"{'scene':<16}{'verdict':<14}{'frame':>6}{'true, mm':>10}{'stated':>10}{'limit x':>9}{'parted x':>9}  words"]
    for each in results:
        worst = each.get("worst")
        row = f"{worst['frame']:>6}{1000 * worst['true']:>10.3g}" \
              f"{1000 * worst['stated'] if worst['stated'] else math.nan:>10.3g}{worst['share']:>9.3g}" \
            if worst else f"{'-':>6}{'-':>10}{'-':>10}{'-':>9}"
        parted = f"{each['parted']:>9.2g}" if "parted" in each else f"{'-':>9}"
        words = ", ".join(f"{word['kind']} ({TOLD[word['true']]})" for word in each.get("words", ()))
        lines.append(f"{each['name']:<16}{each['verdict']:<14}{row}{parted}  {words or each['reason'][:100]}")
    ratios = [value for value in map(ratio, results) if value]
    words = [word for each in results for word in each.get("words", ()) if word["true"] is not None]
    if ratios:
        inside = sum(1 / WITHIN <= value <= WITHIN for value in ratios)
        lines += ["", f"stated over true error in the worst frame: median {middle(ratios):.3g}, "
                      f"{inside} of {len(ratios)} within a factor of {WITHIN}"]
    lines.append(f"of {len(words)} warnings and notes that can be judged {sum(word['true'] for word in words)} are true; "
                 f"{sum(each['verdict'] == 'silent' for each in results)} scenes are beyond {SILENT} times their "
                 f"limit without a word")
    other = sorted(f"{each['name']}: {said}" for each in results for said in each.get("other", ()))
    return "\n".join([*lines, *(["", "other warnings, which positions do not judge:", *other] if other else [])])


def fault(results):
    """The reason for exit code 7; empty: there is none."""
    wrong = [each["name"] for each in results if each["verdict"] in ("silent", "failed")]
    return f"errors are not said: {', '.join(wrong)}" if wrong else ""
