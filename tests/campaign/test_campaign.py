"""The campaigns have the right scenes, and call wrong what is wrong. The first argument is the program drape."""
import collections
import contextlib
import hashlib
import io
import itertools
import json
import math
import pathlib
import stat
import subprocess
import sys
import tempfile
import unittest

CAMPAIGN = pathlib.Path(__file__).resolve().parents[2] / "tools/campaign"
DRAPE = sys.argv.pop(1)
sys.path.insert(0, str(CAMPAIGN))
import cases  # noqa: E402
import drawn_a  # noqa: E402
import drawn_b  # noqa: E402
import errors  # noqa: E402
import judge  # noqa: E402
import report  # noqa: E402

SCENES = 400  # of generator b


def pins_of(scene):
    return [pin for cloth in scene["cloths"] for pin in cloth["pins"]]


def colliders_of(scene):
    return [(kind, each) for kind, found in scene["colliders"].items() for each in found]


# Scenes of generator b have each of these in one of fifty at least.
FEATURES = {
    "wind": lambda scene: "wind" in scene,
    "weightless": lambda scene: scene["gravity"] == [0, 0, 0],
    "release": lambda scene: any("release" in pin for pin in pins_of(scene)),
    "moving pins": lambda scene: any("path" in pin for pin in pins_of(scene)),
    "no pins": lambda scene: any(not cloth["pins"] for cloth in scene["cloths"]),
    "rigid": lambda scene: any(cloth["stiffness"] == "rigid" for cloth in scene["cloths"]),
    "bending": lambda scene: any(cloth["stiffness"]["bend"] for cloth in scene["cloths"]
                                 if cloth["stiffness"] != "rigid"),
    "cutters": lambda scene: "cutters" in scene,
    "several cloths": lambda scene: len(scene["cloths"]) > 1,
    "small": lambda scene: any(max(cloth["grid"]) <= 8 for cloth in scene["cloths"]),
    "large": lambda scene: any(max(cloth["grid"]) >= 64 for cloth in scene["cloths"]),
    **{kind: lambda scene, kind=kind: kind in scene["colliders"]
       for kind in ("planes", "spheres", "boxes", "ellipsoids", "capsules")},
    **{f"moving {kind}": lambda scene, kind=kind: any("path" in each for each in scene["colliders"].get(kind, []))
       for kind in ("spheres", "boxes", "ellipsoids", "capsules")},
}


class Scenes(unittest.TestCase):
    def test_a_seed_and_an_index_are_a_scene_for_good(self):
        for draw, told in ((drawn_a.draw_scene, "3bed1a8c694b3e85"), (drawn_b.draw_scene, "0bc4563284048924")):
            self.assertNotEqual(draw(3, 0), draw(4, 0))
            text = json.dumps([draw(seed, index) for seed in (1, 22) for index in range(20)])
            rounded = json.dumps(json.loads(text, parse_float=lambda number: f"{float(number):.9g}"))
            self.assertEqual(hashlib.sha256(rounded.encode()).hexdigest()[:16], told)

    def test_generator_b_holds_all_that_a_scene_may_hold_and_nothing_that_cannot_be(self):
        found = collections.Counter()
        for index in range(SCENES):
            scene = drawn_b.draw_scene(5, index)
            found.update(name for name, has in FEATURES.items() if has(scene))
            self.assertNotIn("solver", scene)  # auto, and nothing that would help it
            for cloth in scene["cloths"]:
                u, v = cloth["placement"]["u"], cloth["placement"]["v"]
                self.assertAlmostEqual(drawn_b.dot(u, v), 0)
                self.assertAlmostEqual(drawn_b.length(u), 1)
                for pin in cloth["pins"]:
                    times = [key["t"] for key in pin.get("path", [])]
                    self.assertEqual(times, sorted(set(times)))
                    self.assertTrue(all(corner[k] < cloth["grid"][k] for corner in pin["box"] for k in (0, 1)))
                    if len(times) == 2 and "pivot" not in pin:  # taut
                        self.assertLess(drawn_b.length(pin["path"][1]["translate"]), 0.16 * max(cloth["size"]))
                    self.assertFalse(cloth["stiffness"] == "rigid" and times and "pivot" not in pin)
                for kind, each in colliders_of(scene):
                    if kind == "spheres":
                        self.assertTrue(drawn_b.clear_of([cloth], each["center"], each["radius"] - 0.02))
        self.assertEqual({name: found[name] for name in FEATURES if found[name] < SCENES / 50}, {})

    def test_the_program_reads_what_is_drawn(self):
        with tempfile.TemporaryDirectory() as folder:
            for generator, index in itertools.product(cases.GENERATORS, range(15)):
                path = pathlib.Path(folder, f"{generator}_{index}.json")
                scene = cases.GENERATORS[generator](1, index)
                path.write_text(cases.text_of(dict(scene, oracles=judge.promises(scene))))
            done = subprocess.run([DRAPE, "check", *pathlib.Path(folder).iterdir()], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


class Cases(unittest.TestCase):
    def test_they_have_names_of_their_own_and_are_those_of_the_seed(self):
        long, short = cases.stability_cases(False, 1, 50, 3), cases.stability_cases(True, 3, 50, 3)
        for every in (long, short):
            self.assertEqual(len({case.name for case in every}), len(every))
        self.assertEqual(short, cases.stability_cases(True, 3, 50, 3))
        self.assertNotEqual(short, cases.stability_cases(True, 4, 50, 3))
        kinds = collections.Counter(case.name.split("/")[0] for case in long)
        self.assertGreater(kinds["pair"], 1100 * len(cases.METHODS))
        self.assertEqual((kinds["random"], kinds["soak"]), (3, 4))
        self.assertGreater(kinds["mix"], 45)  # some rows take away what others change
        self.assertTrue(any(case.kernels == "line_parts" for case in long))
        self.assertEqual({case.tier for case in long if case.name.startswith(("pair", "mix"))}, {"B"})

    def test_an_extreme_is_read_or_refused_as_its_tier_says(self):
        with tempfile.TemporaryDirectory() as folder:
            for row in cases.ROWS:
                path = pathlib.Path(folder, "scene.json")
                path.write_text(cases.text_of(cases.case_of("single", [row], "line", 0).scene))
                code = subprocess.run([DRAPE, "check", "-q", path], capture_output=True).returncode
                self.assertEqual(code, judge.SCENE if row[0] == "C" else judge.OK, row)


class Verdicts(unittest.TestCase):
    CALM = {"stretch_end": 0.01, "penetration_end": 0}

    def test_the_worst_that_is_said_counts(self):
        for warnings, numbers, broken, expected in (
                ([], self.CALM, [], "holds"),
                ([], dict(self.CALM, stretch_end=0.07), [], "bends"),
                ([], dict(self.CALM, stretch_end=math.nan), [], "bends"),
                ([], dict(self.CALM, penetration_end=0.002), [], "bends"),
                (["deep"], self.CALM, [], "warned"),
                (["deep", "cloth 'cloth' has not settled when the run ends"], self.CALM, [], "unsettled"),
                (["deep"], self.CALM, ["plausible: no"], "silent")):
            self.assertEqual(judge.verdict(warnings, numbers, broken)[0], expected)

    def test_exit_codes_say_why_a_run_ended(self):
        tried, kept = "drape: the most that method auto tries", "what was written before it is kept (1 of 61 frames)"
        for code, said, expected in ((3, "x.json:1:1: wrong", "refused"), (5, "drape: not finite", "refused"),
                                     (8, f"warning: w\n{tried}", "refused"), (8, f"{tried}; {kept}", "refused"),
                                     (8, f"{tried}; pins hold it; {kept}", "impossible"),
                                     (-11, "", "failed"), (70, "a defect", "failed"), (None, "", "failed")):
            self.assertEqual(judge.refusal(code, said)[0], expected, code)
        self.assertEqual(judge.refusal(8, "warning: w\ndrape: reason")[1], "drape: reason")

    def test_each_tier_has_its_shortfalls(self):
        self.assertEqual(set(judge.VERDICTS) - judge.SHORT["A"], {"holds"})
        self.assertEqual(judge.SHORT["B"], {"failed", "silent", "unsettled"})
        self.assertEqual(set(judge.VERDICTS) - judge.SHORT["C"], {"refused"})

    def test_one_per_cent_of_autos_scenes_may_be_refused_but_none_be_wrong(self):
        def fault(of_auto=True, **counts):
            verdicts = collections.Counter(counts).elements()
            return report.fault([{"verdict": verdict} for verdict in verdicts], of_auto)
        self.assertEqual(fault(holds=98, impossible=1, refused=1), "")
        self.assertIn("refused 2 of 100", fault(holds=98, refused=2))
        self.assertEqual(fault(of_auto=False, holds=1, refused=9), "")
        self.assertIn("1 runs", fault(holds=999, silent=1))
        self.assertIn("1 as no run may", fault(of_auto=False, holds=999, failed=1))

    def test_a_scene_promises_what_every_run_must_keep(self):
        def checks(*names):
            rows = [row for row in cases.ROWS if row[2] in names]
            return {each["check"] for each in judge.promises(cases.case_of("x", rows, "line", 0).scene)}
        self.assertEqual(checks("base"), {"pins_hold"})
        self.assertEqual(checks("pins none"), {"falls"})
        self.assertEqual(checks("pins none", "wind 5"), set())
        self.assertEqual(checks("pins none", "floor"), set())
        self.assertEqual(checks("pins none", "start stretched 10"), set())
        self.assertEqual(checks("pins released"), {"released"})
        self.assertEqual(checks("pins 100 turns"), {"pins_hold", "pins_follow"})
        self.assertEqual(checks("cut a line", "self collision"), {"pins_hold", "mass_kept", "uncrossed"})


class Errors(unittest.TestCase):
    """A cloth of a metre, whose limit is 20 mm/s: 10 mm for the first half second, 20 mm at frame 60."""
    SCENE = {"time": {"fps": 60, "frames": 4}, "cloths": [{"size": [1, 0.5]}]}

    def worst(self, found, own):
        rows = [{}, {"position_error_m": 0.004}, {"position_error_m": 0.006}, {"position_error_m": 0.05}]
        return errors.worst_frame(self.SCENE, rows, [found], [own])

    def test_the_worst_frame_is_one_that_the_reference_can_tell(self):
        worst = self.worst([0, 0.002, 0.005, 0.5], [0, 1e-4, 1e-4, 0.003])
        self.assertEqual((worst["frame"], worst["share"]), (2, 0.5))
        self.assertAlmostEqual(errors.ratio({"worst": worst}), 1.2)
        self.assertEqual(self.worst([0, 0.002, 0.005, 0.5], [0, 1e-4, 1e-4, 1e-4])["share"], 50)
        self.assertIsNone(errors.ratio({"worst": self.worst([0, 0.002, 0.0025, 0.003], [0, 0.0012, 0.0012, 0.0012])}))

    def test_what_is_said_is_compared_with_what_is_so(self):
        def is_true(kind, found, own=(0, 0, 0, 0), apart=(0, 0, 0, 0), **said):
            return errors.is_true(kind, dict(said, frame="2"), self.SCENE, [found], [own], [apart])
        self.assertTrue(is_true("far off", [0, 0, 0.011, 0], error="30"))
        self.assertFalse(is_true("far off", [0, 0, 0.009, 0], error="11"))
        self.assertTrue(is_true("far off", [0, 0, 0.009, 0.02], error="11"))
        self.assertFalse(is_true("far off", [0, 0, 0.001, 0.02], error="11"))
        self.assertIsNone(is_true("far off", [0, 0, 0.009, 0], own=[0, 0, 0.002, 0], error="11"))
        self.assertTrue(is_true("sensitive", [0] * 4, apart=[0, 0, 0, 0.001], parted="2"))
        self.assertFalse(is_true("sensitive", [0] * 4, apart=[0, 0.001, 0, 0.0005], parted="2"))
        self.assertTrue(is_true("grows fast", [0, 0, 0.003, 0]))
        self.assertFalse(is_true("grows fast", [0, 0, 0.001, 0]))

    def test_an_error_over_three_times_its_limit_needs_a_word(self):
        for share, words, expected in ((2.9, [], "fits"), (3.1, [], "silent"), (3.1, [{"true": True}], "fits"),
                                       (0.5, [{"true": None}], "fits"), (0.5, [{"true": False}], "untrue")):
            self.assertEqual(errors.verdict({"worst": {"share": share}, "words": words}), expected)


# A stand-in for the program that does one thing wrong.
STAND_INS = {
    "a moved pin": ("silent", "pins_hold", 'drape(*sys.argv[1:], *(["--set", "/cloths/0/pins=[]"] if verify else []))'),
    "a frame that is no result": ("silent", "plausible", 'drape(*sys.argv[1:], *(["--set", FAST] if verify else []))'),
    "a frame over auto's limits": ("silent", "stretch_rms", 'drape(*sys.argv[1:]); spoil("stretch_error_rms", 0.02)'),
    "cloth that stays stretched": ("bends", "stretch_end", 'drape(*sys.argv[1:]); spoil("stretch_error_max", 0.09)'),
    "a crash": ("failed", "exit code -11", "os.kill(os.getpid(), 11)"),
}
SCRIPT = """#!/usr/bin/python3
import json, os, subprocess, sys
verify, FAST = sys.argv[1] == "verify", "/cloths/0/velocity=[0,0,6e4]"
code = 0
def drape(*arguments):
    global code
    code = subprocess.run([%r, *arguments]).returncode
    return code
def spoil(key, value):
    if not verify:
        path = sys.argv[sys.argv.index("-o") + 1] + "/manifest.json"
        manifest = json.load(open(path))
        for row in manifest["statistics"]:
            row["cloth/" + key] = value
        json.dump(manifest, open(path, "w"))
%s
sys.exit(code)
"""


class Campaigns(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def campaign(self, *arguments, program=DRAPE):
        return subprocess.run([sys.executable, CAMPAIGN, *arguments, "-o", self.folder / "out", "--program", program],
                              capture_output=True, text=True)

    def test_judges_extremes_and_goes_on_where_it_ended(self):
        arguments = ["stability", "--short", "--validate", "--filter", "^single/(base|start point|mass 0)/"]
        first = self.campaign(*arguments)
        self.assertEqual(first.returncode, 0, first.stderr)
        for line in ("base                    A     holds       holds       holds       holds\n", "0 silent, 0 failed",
                     "mass 0                  C     refused     refused     refused     refused\n"):
            self.assertIn(line, first.stdout)
        self.assertNotIn("short of", first.stdout)
        self.assertIn("12 cases run, 0 kept", first.stderr)
        results = self.folder / "out/results.jsonl"
        scene = self.folder / "out/scenes/single_start_point_explicit.json"
        self.assertIn('"scale": [', scene.read_text())
        self.assertFalse((self.folder / "out/scenes/single_base_line.json").exists())
        results.write_text(results.read_text()[:-20])  # as a kill may leave it
        self.assertIn("1 cases run, 11 kept", self.campaign(*arguments).stderr)
        third = self.campaign(*arguments)
        self.assertIn("0 cases run, 12 kept", third.stderr)
        self.assertEqual(third.stdout, first.stdout)

    def test_every_promise_is_one_that_the_program_can_judge(self):
        names = "pins none|pins released|pins all around|cut a line|self collision|start turned over"
        done = self.campaign("stability", "--short", "--filter", f"^single/({names})/line")
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn("6 runs: 6 holds", done.stdout)

    def test_kernels_leave_the_same_bytes(self):
        done = self.campaign("stability", "--filter", "^single/base/line/")
        self.assertIn("6 runs: 6 holds", done.stdout)

    def test_what_no_method_can_follow_is_told_from_what_auto_could(self):
        done = self.campaign("stability", "--short", "--mixes", "32", "--filter", "^mix/31/.*wind 300/auto")
        self.assertIn("1 impossible", done.stdout)  # by the program's own words of exit code 8

    def test_auto_is_judged_by_what_it_keeps(self):
        done = self.campaign("auto", "--first", "8", "--count", "1", "--validate")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("substeps per frame, most", done.stdout)
        self.assertIn("1/1 b/1/8: ", done.stderr)
        done = self.campaign("auto", "--first", "8", "--count", "1", "--tolerance", "0.5")
        self.assertIn("1 cases run, 0 kept", done.stderr)

    def test_errors_are_compared_with_finer_runs(self):
        done = self.campaign("errors", "--seed", "90417233", "--first", "23", "--count", "1", "--reference-substeps",
                             "64", "--side", "9")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"b/90417233/23 +fits +\d+ ")
        self.assertIn("1 of 1 within a factor of 3", done.stdout)

    def test_what_is_wrong_is_called_so(self):
        for what, (verdict, reason, script) in STAND_INS.items():
            program = self.folder / what.replace(" ", "_")
            program.write_text(SCRIPT % (DRAPE, script))
            program.chmod(program.stat().st_mode | stat.S_IXUSR)
            method = "auto" if "auto" in what else "line"
            done = self.campaign("stability", "--short", "--filter", f"^single/base/{method}$", "-q", program=program)
            self.assertEqual(done.returncode, 7 if verdict in ("silent", "failed") else 0, what + done.stderr)
            self.assertRegex(done.stdout, f"single/base/{method} \\(A\\): {verdict}: .*{reason}")
            named = pathlib.Path(done.stdout.rsplit("; ", 1)[1].strip())
            self.assertEqual(json.loads(named.read_text())["solver"]["method"], method, what)

    def test_refuses_what_it_cannot_do(self):
        for code, said, arguments in ((2, "no case has such a name", ["stability", "--filter", "no such case"]),
                                      (2, "'('", ["stability", "--filter", "("]),
                                      (2, "--generator", ["auto", "--generator", "c"]),
                                      (4, "no such device", ["auto", "--count", "1", "--device", "no such device"])):
            done = self.campaign(*arguments)
            self.assertEqual((done.returncode, done.stdout), (code, ""))
            self.assertIn(said, done.stderr)


if __name__ == "__main__":
    unittest.main()
