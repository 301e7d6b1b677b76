"""Writes a walking figure as one mesh that deforms, and a scene in which it carries a cape.

    python walking_cape.py FOLDER
    drape render FOLDER/cape.json -o FOLDER/out

The figure is a smooth union of tapered capsules, one for each bone, whose surface at rest becomes one closed mesh; its
vertices follow the bones by smooth weights (linear blend skinning) through one cycle of steps on the spot. The scene
takes it forward by a path. FOLDER then holds body.obj, walk.npy, walk.pc2 and cape.json. NumPy is needed.
"""

import json
import pathlib
import struct
import sys

import numpy as np

POSES, CYCLE = 30, 1.0  # of one cycle of two steps; s
SPEED, SECONDS = 0.9, 3.0  # m/s; s
CELL = 0.022  # m: of the lattice on which the surface is found

# name: parent, from, to (m), radii at both (m), and the swing (degrees about x, forward) at phases of the cycle.
BONES = {
    "trunk": (None, (0, 0.95, 0), (0, 1.36, 0), (0.125, 0.135), lambda p: 3),
    "head": ("trunk", (0, 1.50, 0.02), (0, 1.64, 0.03), (0.055, 0.095), lambda p: 0),
    "arm_l": ("trunk", (0.20, 1.40, 0), (0.29, 1.14, 0), (0.062, 0.048), lambda p: -24 * np.sin(p)),
    "arm_r": ("trunk", (-0.20, 1.40, 0), (-0.29, 1.14, 0), (0.062, 0.048), lambda p: 24 * np.sin(p)),
    "hand_l": ("arm_l", (0.29, 1.14, 0), (0.34, 0.90, 0.02), (0.046, 0.035), lambda p: 18 - 12 * np.sin(p)),
    "hand_r": ("arm_r", (-0.29, 1.14, 0), (-0.34, 0.90, 0.02), (0.046, 0.035), lambda p: 18 + 12 * np.sin(p)),
    "thigh_l": ("trunk", (0.095, 0.92, 0), (0.11, 0.50, 0), (0.095, 0.062), lambda p: 24 * np.sin(p)),
    "thigh_r": ("trunk", (-0.095, 0.92, 0), (-0.11, 0.50, 0), (0.095, 0.062), lambda p: -24 * np.sin(p)),
    "shin_l": ("thigh_l", (0.11, 0.50, 0), (0.12, 0.11, -0.01), (0.060, 0.044), lambda p: -22 - 20 * np.cos(p)),
    "shin_r": ("thigh_r", (-0.11, 0.50, 0), (-0.12, 0.11, -0.01), (0.060, 0.044), lambda p: -22 + 20 * np.cos(p)),
    "foot_l": ("shin_l", (0.12, 0.08, -0.02), (0.13, 0.06, 0.13), (0.046, 0.036), lambda p: 8),
    "foot_r": ("shin_r", (-0.12, 0.08, -0.02), (-0.13, 0.06, 0.13), (0.046, 0.036), lambda p: 8),
}


def distances(points):
    """Distances of points [n, 3] to every bone's capsule, [bone, n]."""
    found = []
    for _, start, end, radii, _ in BONES.values():
        start, way = np.array(start), np.subtract(end, start)
        share = np.clip((points - start) @ way / (way @ way), 0, 1)
        radius = radii[0] + share * (radii[1] - radii[0])
        found.append(np.linalg.norm(points - start - share[:, None] * way, axis=1) - radius)
    return np.array(found)


def body(points):
    """Distance to the smooth union of all capsules, less than zero inside."""
    smooth = 0.018
    all_of_them = distances(points)
    least = all_of_them.min(0)
    return least - smooth * np.log(np.exp((least - all_of_them) / smooth).sum(0))


def surface():
    """Vertices [n, 3] and quads [m, 4] of the surface: a vertex in each cell that it passes, a quad across each edge of
    the lattice (surface nets)."""
    lower, upper = np.array([-0.48, -0.06, -0.24]), np.array([0.48, 1.84, 0.26])
    size = np.ceil((upper - lower) / CELL).astype(int)
    lattice = np.stack(np.meshgrid(*(np.arange(n) for n in size), indexing="ij"), -1)
    value = body((lower + CELL * lattice).reshape(-1, 3)).reshape(size)
    sums, counts = np.zeros(tuple(size - 1) + (3,)), np.zeros(size - 1)
    corners = np.array([[i, j, k] for i in (0, 1) for j in (0, 1) for k in (0, 1)])

    def at(corner):
        return value[tuple(slice(c, n - 1 + c) for c, n in zip(corner, size))]

    for one in corners:
        for axis in range(3):
            if one[axis]:
                continue
            other = one + np.eye(3, dtype=int)[axis]
            first, second = at(one), at(other)
            crossed = (first < 0) != (second < 0)
            share = np.where(crossed, first / np.where(crossed, first - second, 1), 0)
            sums += crossed[..., None] * (one + share[..., None] * (other - one))
            counts += crossed
    cells = np.argwhere(counts > 0)
    number = np.full(size - 1, -1)
    number[tuple(cells.T)] = np.arange(len(cells))
    vertices = lower + CELL * (cells + sums[tuple(cells.T)] / counts[tuple(cells.T)][:, None])
    quads = []
    for axis in range(3):
        along, u, v = (np.eye(3, dtype=int)[(axis + k) % 3] for k in range(3))
        low = value[tuple(slice(1 - along[k], size[k] - 1) for k in range(3))]
        high = value[tuple(slice(1, size[k] - 1 + along[k]) for k in range(3))]
        for place in np.argwhere((low < 0) != (high < 0)):
            node = place + 1 - along  # the edge's lower end
            ring = [number[tuple(node - a * u - b * v)] for a, b in ((1, 1), (0, 1), (0, 0), (1, 0))]
            quads.append(ring if value[tuple(node)] < 0 else ring[::-1])
    return vertices, np.array(quads)


def turn(degrees):
    angle = np.radians(degrees)
    # Positive angles swing what hangs down forward, to +z.
    return np.array([[1, 0, 0], [0, np.cos(angle), np.sin(angle)], [0, -np.sin(angle), np.cos(angle)]])


def poses(vertices):
    """Places of the vertices in each pose of the cycle, [pose, n, 3]."""
    near = distances(vertices)
    weights = np.exp(-(near - near.min(0)) / 0.02)
    weights /= weights.sum(0)
    places = np.zeros((POSES, len(vertices), 3))
    for pose in range(POSES):
        phase, frames = 2 * np.pi * pose / POSES, {}
        for name, (parent, start, _, _, swing) in BONES.items():
            rotation, shift = frames[parent] if parent else (np.eye(3), np.zeros(3))
            start = np.array(start)
            own = turn(swing(phase))
            frames[name] = (rotation @ own, rotation @ (start - own @ start) + shift)
        for weight, (rotation, shift) in zip(weights, frames.values()):
            places[pose] += weight[:, None] * (vertices @ rotation.T + shift)
    return places


def scene():
    start, end = 0.4, SECONDS - 0.4
    times = np.arange(start, end + 0.1, 0.4).tolist()
    walk = [{"t": t, "translate": [0, 0, SPEED * (t - start)]} for t in times]
    columns, rows, width, length = 49, 73, 0.50, 0.95
    held = 5  # particles along the edge that each shoulder has
    return {
        "name": "walking cape",
        "time": {"fps": 60, "frames": int(60 * SECONDS) + 1},
        "cloths": [{
            "name": "cape", "grid": [columns, rows], "size": [width, length],
            "placement": {"origin": [width / 2, 1.43, -0.20], "u": [-1, 0, 0], "v": [0, -1, 0]},
            "areal_density": 0.25, "stiffness": {"stretch": 3000, "shear": 60, "bend": 2e-5},
            "damping": 0.6, "friction": 0.3, "thickness": 0.008, "self_collision": True,
            "pins": [{"box": [[first, 0], [first + held - 1, 1]], "path": walk}
                     for first in (6, columns - 6 - held)],
            "appearance": {"front": [0.62, 0.08, 0.12], "back": [0.42, 0.06, 0.10], "pattern": "plain"}}],
        "colliders": {
            "planes": [{"friction": 0.6, "color": [0.72, 0.69, 0.65]}],
            "meshes": [{"file": "body.obj", "frames": "walk.npy", "frames_per_second": POSES / CYCLE, "loop": True,
                        "spacing": 0.02, "friction": 0.3, "color": [0.45, 0.50, 0.58], "path": walk}]},
        "wind": {"velocity": [0, 0, 0.01], "drag": 1.2},
        "camera": {"position": [3.1, 1.7, -1.6], "target": [0, 0.85, 1.2], "fov": 42},
    }


def main(folder):
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    vertices, quads = surface()
    with open(folder / "body.obj", "w") as file:
        file.writelines(f"v {x:.6f} {y:.6f} {z:.6f}\n" for x, y, z in vertices)
        file.writelines("f " + " ".join(str(corner + 1) for corner in quad) + "\n" for quad in quads)
    places = poses(vertices).astype("<f4")
    np.save(folder / "walk.npy", places)
    head = struct.pack("<12siiffi", b"POINTCACHE2\0", 1, len(vertices), 0.0, 1.0, POSES)
    (folder / "walk.pc2").write_bytes(head + places.tobytes())
    (folder / "cape.json").write_text(json.dumps(scene(), indent=1) + "\n")
    print(f"{len(vertices)} vertices, {2 * len(quads)} triangles, {POSES} poses")


if __name__ == "__main__":
    main(sys.argv[1])
