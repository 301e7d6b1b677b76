#!/usr/bin/env python3
"""Finds the bending stiffness and the drag of a cloth from how its free edge swung, by random search in an ensemble.

    PYTHONPATH=build/python python3 tools/examples/python/fit_swing.py [MEMBERS] [ROUNDS]
"""
import sys

import drape
import numpy as np

MEMBERS = int(sys.argv[1]) if len(sys.argv) > 1 else 64
ROUNDS = int(sys.argv[2]) if len(sys.argv) > 2 else 4
FRAMES = 60
BEND, DRAG = "/cloths/0/stiffness/bend", "/wind/drag"
TRUE = {BEND: 3e-3, DRAG: 1.1}  # they are what was "recorded"; a real fit has a video instead

SWING = {
    "name": "a stiff cloth swings in a draught",
    "time": {"fps": 60, "frames": FRAMES + 1},
    "wind": {"velocity": [0, 0, 1.5]},
    "cloths": [{
        "name": "cloth",
        "grid": [13, 17],
        "size": [0.3, 0.4],
        "placement": {"origin": [-0.15, 1, 0], "u": [1, 0, 0], "v": [0, -0.5, 0.87]},
        "areal_density": 0.25,
        "stiffness": {"stretch": 1000, "shear": 100, "bend": 1e-3},
        "pins": [{"edge": "top"}],
    }],
    "solver": {"method": "line", "substeps": 8},
}


def swings(members):
    """Returns the free edge's middle in every frame and member: [frame, member, 3], m."""
    ensemble = drape.Ensemble(SWING, members)
    path = []
    for frame in range(FRAMES):
        ensemble.step()
        path.append(ensemble.positions()[:, -1, 6].copy())
    return np.array(path)


recorded = swings([TRUE])
random = np.random.default_rng(1)
low, high = np.log([1e-4, 0.3]), np.log([3e-2, 3.0])
for search in range(ROUNDS):
    guesses = np.exp(random.uniform(low, high, (MEMBERS, 2)))
    errors = np.sqrt(((swings([{BEND: float(b), DRAG: float(d)} for b, d in guesses]) - recorded) ** 2).sum(2).mean(0))
    best = np.argsort(errors)[:max(4, MEMBERS // 16)]
    print(f"round {search}: best bend {guesses[best[0], 0]:.2e} N m, drag {guesses[best[0], 1]:.3f}: the edge is "
          f"{1000 * errors[best[0]]:.2f} mm off")
    # The next guesses lie around the best of these.
    middle, spread = np.log(guesses[best]).mean(0), 2 * np.log(guesses[best]).std(0)
    low, high = middle - spread, middle + spread
print(f"recorded with bend {TRUE[BEND]:.2e} N m, drag {TRUE[DRAG]:.3f}")
