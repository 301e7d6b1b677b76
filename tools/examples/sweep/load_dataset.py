#!/usr/bin/python3
"""Opens a data set of `drape sweep --dataset` as a training program would, and checks it.

    tools/examples/sweep/load_dataset.py out/flag_simple/dataset

Every trajectory has the arrays that meta.json lists, of the dtypes and shapes it says (-1: any); positions are finite,
cells name nodes of cloth or of obstacles, nodes of no cell (in holes) are handles (type 3, as pinned ones are) and stay
where they are, and cells of obstacles (type 1: colliders) keep their edges as long as they are. Prints what was found;
the exit code is not 0 where it is otherwise. Needs python3-numpy.
"""
import glob
import json
import os
import sys

import numpy

OBSTACLE, HANDLE = 1, 3


def trajectories(folder):
    """Yields (name, arrays by field) of every trajectory, in order."""
    for path in sorted(glob.glob(os.path.join(folder, "trajectory_*.npz"))):
        with numpy.load(path) as archive:
            yield os.path.basename(path), {field: archive[field] for field in archive.files}


def check(name, arrays, meta):
    if sorted(set(arrays) - set(meta["inputs"])) != sorted(meta["field_names"]):
        raise ValueError(f"{name} has {sorted(arrays)}")
    for field, feature in meta["inputs"].items():
        if feature["type"] == "dynamic" and len(arrays[field]) != len(arrays["world_pos"]):
            raise ValueError(f"{name}: {field} has {len(arrays[field])} frames")
    for field, feature in meta["features"].items():
        array = arrays[field]
        fits = len(array.shape) == len(feature["shape"]) and all(
            wanted in (-1, length) for length, wanted in zip(array.shape, feature["shape"]))
        if not fits or array.dtype != feature["dtype"]:
            raise ValueError(f"{name}: {field} is {array.dtype} {array.shape}, meta.json says {feature}")
    world, cells, types = arrays["world_pos"], arrays["cells"][0], arrays["node_type"][0, :, 0]
    if not numpy.isfinite(world).all():
        raise ValueError(f"{name}: a position is not finite")
    if cells.min() < 0 or cells.max() >= world.shape[1]:
        raise ValueError(f"{name}: a cell names a node that is not there")
    solid = (types[cells] == OBSTACLE).all(axis=1)
    if (types[cells[~solid]] == OBSTACLE).any():
        raise ValueError(f"{name}: a cell is of cloth and of an obstacle")
    sides = world[:, cells[solid]]
    edges = numpy.linalg.norm(sides - numpy.roll(sides, 1, axis=2), axis=-1)
    if not numpy.allclose(edges, edges[:1], rtol=0, atol=1e-6 * max(1, numpy.abs(world).max())):
        raise ValueError(f"{name}: an obstacle changes its shape")
    alone = numpy.setdiff1d(numpy.arange(world.shape[1]), cells)
    if (types[alone] != HANDLE).any() or (world[:, alone] != world[:1, alone]).any():
        raise ValueError(f"{name}: a node of no cell is free, or moves")
    if numpy.array_equal(world[0], world[-1]):
        raise ValueError(f"{name}: nothing moves")


def main():
    folder = sys.argv[1]
    with open(os.path.join(folder, "meta.json")) as file:
        meta = json.load(file)
    count = 0
    for name, arrays in trajectories(folder):
        check(name, arrays, meta)
        count += 1
    if count == 0:
        raise ValueError(f"no trajectory in {folder}")
    shapes = {field: feature["shape"] for field, feature in meta["features"].items()}
    apart = meta["dt"] if meta["dt"] > 0 else "not the same"
    print(f"{count} trajectories of {meta['trajectory_length']} frames, {apart} s apart: {shapes}")


main()
