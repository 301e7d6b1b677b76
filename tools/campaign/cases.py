"""The cases of the campaigns: extremes alone, in pairs and in drawn mixes, random scenes, a soak, scenes of auto."""
import dataclasses
import json
import pathlib
import re

import drawn_a
import drawn_b
from drawn_b import MASK, STEP, splitmix64, unit_interval

METHODS = ("relax", "explicit", "line", "auto")
GENERATORS = {"a": drawn_a.draw_scene, "b": drawn_b.draw_scene}
# The sets of --kernels that every extreme is run with. The last two, which only lines have, leave bytes of their own.
KERNELS = {"plain": "plain", "buffer_store": "buffer_store",
           "stream": "buffer_store,explicit_stream,spring_stream,twist_stream",
           "tile": "explicit_tile,spring_tile,twist_tile", "cyclic": "line_cyclic", "parts": "line_parts"}
OTHER_BYTES = ("line_cyclic", "line_parts")
SINGLE_FRAMES, SOAK_FRAMES, SHORT_SOAK_FRAMES = 60, 20000, 1200
# A cloth that has not calmed down by then gets so many frames more: the 5 s in which the watch lets cloth settle.
RECOVERY_FRAMES, SHORT_RECOVERY_FRAMES = 300, 60
BASE = {"name": "stability", "time": {"fps": 60},
        "cloths": [{"grid": [13, 9], "size": [0.6, 0.4],
                    "placement": {"origin": [-0.3, 1, 0], "u": [1, 0, 0], "v": [0, -4, 3]}, "areal_density": 0.2,
                    "stiffness": {"stretch": 1000, "shear": 100, "bend": 0}, "damping": 1, "pins": [{"edge": "top"}]}]}


@dataclasses.dataclass
class Case:
    name: str  # "single/wind 50/line/plain", "pair/...", "mix/7/...", "random/1/12", "soak/base/auto", "b/1/17"
    scene: dict
    tier: str = "B"
    kernels: str = "auto"
    recovery: int = 0


def extremes():
    """(tier, axis, name, changes of the base) of every row; an indented line goes on with the one before."""
    text = pathlib.Path(__file__).with_name("extremes.txt").read_text()
    text = re.sub(r"\n    (?=/)", "  ", text).replace("\n    ", "")
    lines = [re.split(" {2,}", line) for line in text.splitlines() if not line.startswith("#")]
    return [(*line[:3], line[3:]) for line in lines]


ROWS = extremes()


def text_of(scene):
    return json.dumps(scene, indent=1).replace("Infinity", "1e999") + "\n"


def change(scene, override):
    """Replaces a value, as `--set /pointer=value` does."""
    pointer, value = override.split("=", 1)
    *way, last = [int(key) if key.isdigit() else key for key in pointer.split("/")[1:]]
    for key in way:
        scene = scene[key] if isinstance(scene, list) else scene.setdefault(key, {})
    scene[last] = json.loads(value.replace("1e999", "Infinity"))


def case_of(kind, rows, method, recovery, frames=SINGLE_FRAMES, kernels=None):
    """Extremes on the base scene; nothing where one takes away what another changes."""
    scene = json.loads(json.dumps(BASE))
    scene["time"]["frames"] = frames + 1
    scene["solver"] = {"method": method} if method == "auto" else {"method": method, "substeps": 20, "iterations": 1}
    try:
        for override in (override for row in rows for override in row[3]):
            change(scene, override)
    except (AttributeError, TypeError):
        return None
    name = f"{kind}/{' + '.join(row[2] for row in rows)}/{method}" + (f"/{kernels}" if kernels else "")
    return Case(name, scene, rows[0][0] if len(rows) == 1 else "B", KERNELS.get(kernels, "auto"), recovery)


def together(a, b):
    return a[1] != b[1] and "C" not in (a[0], b[0])


class Numbers:
    """In [0, 1), of a splitmix64 state."""

    def __init__(self, state):
        self.state = state & MASK

    def next(self):
        self.state = self.state + STEP & MASK
        return unit_interval(splitmix64(self.state))


def mixed(seed, index):
    """3 to 6 rows of different axes."""
    numbers, chosen = Numbers(splitmix64(seed) + index * 1000 * STEP), set()
    count = 3 + int(4 * numbers.next())
    while len(chosen) < count:
        place = 1 + int(numbers.next() * (len(ROWS) - 1))
        if ROWS[place][0] != "C" and all(together(ROWS[place], ROWS[other]) for other in chosen):
            chosen.add(place)
    return [ROWS[place] for place in sorted(chosen)]


def capped(scene, side):
    """The scene with at most so many particles a side; pins stay where they are on the cloth."""
    for cloth in scene["cloths"]:
        wanted, cloth["grid"] = cloth["grid"], [min(count, side) for count in cloth["grid"]]
        for pin in cloth["pins"]:
            pin["box"] = [[corner[k] * (cloth["grid"][k] - 1) // (wanted[k] - 1) for k in (0, 1)]
                          for corner in pin["box"]]
    return scene


def small_random(seed, index):
    """A scene of generator b, small, half of them by a method and settings that somebody may ask for."""
    scene, numbers = capped(drawn_b.draw_scene(seed, index), 24), Numbers(splitmix64(seed ^ index << 32))
    if numbers.next() >= 0.5:
        scene["solver"] = {"method": ("explicit", "line", "relax")[int(3 * numbers.next())],
                           "substeps": int(2 ** (7 * numbers.next())),
                           "iterations": 1 if numbers.next() < 0.7 else 1 + int(8 * numbers.next())}
    return Case(f"random/{seed}/{index}", scene)


def sets_of(row, method):
    """The names of the sets of kernels that a row alone is run with; nothing: those that auto takes."""
    if row[0] == "C" or method == "auto":
        return [None]
    return [None, *(name for name in KERNELS if method == "line" or KERNELS[name] not in OTHER_BYTES)]


def stability_cases(short, seed, mixes, randoms):
    """Every extreme alone by every method (and every set of kernels, unless short), mixes, random scenes, all pairs of
    different axes (unless short), and a soak; the important ones first."""
    recovery = SHORT_RECOVERY_FRAMES if short else RECOVERY_FRAMES
    every = [case_of("single", [row], method, recovery, kernels=kernels) for row in ROWS for method in METHODS
             for kernels in ([None] if short else sets_of(row, method))]
    every += [case_of(f"mix/{index}", mixed(seed, index), METHODS[index % 4], recovery) for index in range(mixes)]
    every += [small_random(seed, index) for index in range(randoms)]
    every += [case_of("pair", [row, other], method, recovery) for place, row in enumerate(ROWS) if place and not short
              for other in ROWS[place + 1:] if together(row, other) for method in METHODS]
    every += [case_of("soak", ROWS[:1], method, recovery, SHORT_SOAK_FRAMES if short else SOAK_FRAMES)
              for method in (["auto"] if short else METHODS)]
    return [case for case in every if case]


def auto_cases(generator, seed, first, count, tolerance, side):
    """Scenes of method auto, as they are drawn, with at most `side` particles a side."""
    asked = {"solver": {"tolerance": tolerance}} if tolerance else {}
    return [Case(f"{generator}/{seed}/{index}", capped(GENERATORS[generator](seed, index), side) | asked)
            for index in range(first, first + count)]
