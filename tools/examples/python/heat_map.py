#!/usr/bin/env python3
"""Runs a scene file, keeps its positions, and draws its last frame twice: shaded, and its stretch as a heat map.

    PYTHONPATH=build/python python3 tools/examples/python/heat_map.py SCENE [FRAMES]

Writes positions.npy, float32 [frame, row, column, 3] of the first cloth, and heat_map.ppm: both pictures side by side.
"""
import sys

import drape
import numpy as np

if len(sys.argv) < 2:
    sys.exit(__doc__)
try:
    scene = drape.load(sys.argv[1], {"/time/frames": int(sys.argv[2])} if len(sys.argv) > 2 else {})
except drape.Error as error:
    print(error, file=sys.stderr)
    sys.exit(error.exit_code)

pictures = []
for view in ("shaded", "stretch"):
    simulation = drape.Simulation(scene, draw=True, view=view, size=(480, 360))
    frames = [step.positions().copy() for step in simulation]  # copies: each step changes what the views show
    pictures.append(simulation.picture()[..., :3].copy())
    print(f"{view}: {len(frames)} frames by {simulation.method} on {simulation.device}")

np.save("positions.npy", np.stack(frames))
both = np.concatenate(pictures, axis=1)
with open("heat_map.ppm", "wb") as file:
    file.write(f"P6 {both.shape[1]} {both.shape[0]} 255\n".encode())
    file.write(both.tobytes())
