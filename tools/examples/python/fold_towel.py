#!/usr/bin/env python3
"""A gripper takes a towel by a corner, lays it over the opposite corner and lets go.

    PYTHONPATH=build/python python3 tools/examples/python/fold_towel.py [FRAMES OF THE FOLD [SCENE]]

SCENE is a file to write: the towel with all that the gripper did. `drape render` makes its pictures, `drape report` its
force plot.
"""
import sys

import drape
import numpy as np

FRAMES = int(sys.argv[1]) if len(sys.argv) > 1 else 90

TOWEL = {
    "name": "towel on a table",
    "forces": True,
    "time": {"fps": 60, "frames": 2},  # an ensemble goes on as long as it is stepped
    "cloths": [{
        "name": "towel",
        "grid": [21, 21],
        "size": [0.4, 0.4],
        "placement": {"origin": [-0.2, 0.004, -0.2], "u": [1, 0, 0], "v": [0, 0, 1]},
        "areal_density": 0.3,
        "stiffness": {"stretch": 500, "shear": 50, "bend": 1e-4},
        "damping": 0.5,
        "friction": 0.5,
        "thickness": 0.004,
        "self_collision": {},
    }],
    "colliders": {"planes": [{"normal": [0, 1, 0], "offset": 0, "friction": 0.5}]},
    "solver": {"method": "line", "substeps": 4},
}
HELD = [0, 0, 1, 1]  # first and last column and row: four particles at a corner
NOTHING = [-1, -1, -1, -1]

table = drape.Ensemble(TOWEL, 1, hands=1, record=True)  # a robot that learns has many members
pull = []  # N, of the hand on the towel


def step(hand, grasp):
    """Moves the only hand of the only member there, in a sixtieth of a second."""
    table.step(hands=[[hand]], grasps=[[grasp]])
    numbers = table.statistics(0)
    pull.append([numbers[f"towel/force_hands_{axis}_n"] for axis in "xyz"])


def area_seen_from_above():
    """Returns how many tiles of 2 cm x 2 cm have a particle above them."""
    tiles = np.floor(table.positions()[0][..., [0, 2]].reshape(-1, 2) / 0.02 + 0.5)
    return len(np.unique(tiles, axis=0))


corner = table.positions()[0, 0, 0].copy()
goal = table.positions()[0, -1, -1] + [-0.03, 0.012, -0.03]
area = area_seen_from_above()

step(corner, NOTHING)  # the gripper is at the corner, open
step(corner, HELD)     # it closes, and the corner stays where it is
for share in np.linspace(0, 1, FRAMES):
    height = 0.15 * np.sin(np.pi * share)
    step(corner + share * (goal - corner) + [0, height, 0], HELD)
laid = table.positions()[0, 0, 0].copy()
for _ in range(30):
    step(goal, NOTHING)  # open again: the towel lies as it lies

lies = table.positions()[0, 0, 0]
failures = table.failures
numbers = table.statistics(0)
if len(sys.argv) > 2:
    table.save_scene(sys.argv[2])
print(f"{table.device}: the corner was laid {1000 * np.linalg.norm(laid - goal):.2f} mm from where it was to go and lies "
      f"{1000 * lies[1]:.1f} mm above the table")
print(f"the gripper pulled with at most {np.linalg.norm(pull, axis=1).max():.2f} N; the towel weighs "
      f"{-numbers['towel/force_gravity_y_n']:.2f} N")
print(f"the towel covers {100 * area_seen_from_above() / area:.0f} % of what it did; {failures or 'nothing failed'}")
