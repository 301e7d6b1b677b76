#!/usr/bin/env python3
"""Measures how far a flag lifts in winds of several speeds: a scene built as a dict, positions as NumPy arrays.

    PYTHONPATH=build/python python3 tools/examples/python/wind_tunnel.py [FRAMES]
"""
import sys

import drape
import numpy as np

FRAMES = int(sys.argv[1]) if len(sys.argv) > 1 else 180


def flag(speed):
    """A flag of 1.2 m x 0.8 m on a pole, in a wind of `speed` m/s along x."""
    return {
        "name": f"flag at {speed} m/s",
        "time": {"fps": 60, "frames": FRAMES},
        "wind": {"velocity": [speed, 0, 0.1 * speed], "gust": {"amplitude": 0.2 * speed, "period": 1.1}},
        "cloths": [{
            "name": "flag",
            "grid": [37, 25],
            "size": [1.2, 0.8],
            "placement": {"origin": [0, 2, 0], "u": [1, 0, 0], "v": [0, -1, 0]},
            "fabric": "cotton",
            "damping": 0.3,
            "pins": [{"edge": "left"}],
        }],
    }


for speed in (2, 4, 8):
    simulation = drape.Simulation(flag(speed))
    lifts = []
    for step in simulation:
        # This is a view on the library's memory, which holds the frame until the next step.
        free_edge = step.positions("flag")[:, -1]
        lifts.append(free_edge[:, 0].mean())
    errors = simulation.statistics["flag/stretch_error_rms"]
    print(f"{speed} m/s: the free edge is {np.mean(lifts[len(lifts) // 2:]):.2f} m from the pole, "
          f"{np.std(lifts[len(lifts) // 2:]):.2f} m to and fro; stretch error {100 * errors:.3f} %")
