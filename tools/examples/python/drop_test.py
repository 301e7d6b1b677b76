#!/usr/bin/env python3
"""Drops a sheet on a bar and measures the force on it: drop_test.csv has the numbers, drop_test.svg the curve.

    PYTHONPATH=build/python python3 tools/examples/python/drop_test.py [HEIGHT IN METRES]
"""
import sys

import drape
import numpy as np

HEIGHT = float(sys.argv[1]) if len(sys.argv) > 1 else 0.5
FPS, RADIUS = 240, 0.03  # so many frames a second resolve the blow

DROP = {
    "name": "a sheet falls on a bar",
    "forces": True,
    "time": {"fps": FPS, "frames": 241},
    "cloths": [{
        "name": "sheet",
        "grid": [33, 25],
        "size": [0.8, 0.6],
        "placement": {"origin": [-0.4, RADIUS + 0.005 + HEIGHT, -0.3], "u": [1, 0, 0], "v": [0, 0, 1]},
        "areal_density": 0.3,
        "stiffness": {"stretch": 2000, "shear": 200, "bend": 1e-4},
        "damping": 0.2,
        "friction": 0.8,
    }],
    "colliders": {"capsules": [{"from": [0, 0, -0.5], "to": [0, 0, 0.5], "radius": RADIUS, "friction": 0.8}]},
    "solver": {"method": "line", "substeps": 8},
}


def svg(times, curves, width=720, height=360):
    """Returns a plot of curves, {label: newtons}, over the time in seconds."""
    low = min(0, *(values.min() for values in curves.values()))
    high = max(values.max() for values in curves.values())
    text = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif">',
            f'<rect width="{width}" height="{height}" fill="white"/>']
    x = 50 + (width - 70) * times / times[-1]
    for (label, values), color, line in zip(curves.items(), ("#c03020", "#4060a0"), (20, 40)):
        y = 20 + (height - 60) * (high - values) / (high - low)
        points = " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(x, y))
        text.append(f'<polyline points="{points}" fill="none" stroke="{color}" stroke-width="1.5"/>')
        text.append(f'<text x="{width - 20}" y="{line}" text-anchor="end" fill="{color}">{label}</text>')
    text.append(f'<text x="10" y="24">{high:.0f} N</text><text x="10" y="{height - 40}">{low:.0f} N</text>')
    text.append(f'<text x="{width - 20}" y="{height - 12}" text-anchor="end">{times[-1]:.2f} s</text></svg>')
    return "\n".join(text) + "\n"


rows = []
for step in drape.Simulation(DROP):
    numbers = step.statistics
    # What the bar does to the sheet; the sheet does the opposite to the bar.
    rows.append([step.time] + [-numbers.get(f"sheet/force_collider_0_capsule_{axis}_n", 0.0) for axis in "xyz"] +
                [numbers["sheet/momentum_y_kg_m_s"]] +
                [numbers.get(f"sheet/force_{by}_y_n", 0.0) for by in ("gravity", "damping")])
times, across, down, along, momentum, weight, damping = np.array(rows).T
np.savetxt("drop_test.csv", rows, delimiter=",", fmt="%.9g", comments="",
           header="seconds,x_n,y_n,z_n,momentum_y_kg_m_s,gravity_y_n,damping_y_n")
with open("drop_test.svg", "w", encoding="ascii") as file:
    file.write(svg(times, {"on the bar, downwards": -down, "the sheet's weight": -weight}))

hit = np.flatnonzero(down < 0)[0]
peak = np.argmin(down)
print(f"a sheet of {-weight[-1]:.2f} N falls {HEIGHT:.2f} m; it comes to the bar after {times[hit]:.3f} s, and presses "
      f"on it with {-down[peak]:.1f} N at {times[peak]:.3f} s")
print(f"at the end the bar bears {-down[-24:].mean():.2f} N")
# Impulses of frames, and what the sheet's momentum changed by.
impulse = (-down + weight + damping)[1:].sum() / FPS
change = momentum[-1] - momentum[0]
print(f"bar, gravity and damping gave {impulse:.5f} N s, the momentum changed by {change:.5f} kg m/s")
