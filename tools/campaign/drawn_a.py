"""Generator a: scenes such as method auto is tuned on, and more of what a scene may hold; 30 to 90 frames.

One cloth of 20 to 90 particles a side, 0.08 to 0.5 kg/m^2, 500 to 10,000 N/m, swings from an edge, hangs from two
corners, falls on a ball, is a flag, or is held all around. Then wind to 30 m/s with gusts, weightlessness, pins that
are released or move, rigid cloth, bending, narrow grids, more colliders, a second cloth, a blade.
"""
import math
import random


class Draw:
    """C++'s mt19937, by which tools/bench/random_scenes.cpp draws the same sheets, in Python's generator."""

    def __init__(self, seed):
        state = [seed % 2**32]
        for place in range(1, 624):
            state.append((1812433253 * (state[-1] ^ state[-1] >> 30) + place) % 2**32)
        self.random = random.Random()
        self.random.setstate((3, (*state, 624), None))

    def between(self, low, high):
        return low + (high - low) * (self.random.getrandbits(32) / 4294967295.0)

    def scaled(self, low, high):
        """On a logarithmic scale."""
        return math.exp(self.between(math.log(low), math.log(high)))

    def integer(self, low, high):
        return low + self.random.getrandbits(32) % (high - low + 1)

    def one_of(self, count):
        return self.integer(1, count) == 1


def sheet_scene(seed):
    draw = Draw(seed)
    right, bottom = draw.integer(20, 90) - 1, draw.integer(20, 90) - 1
    width, height = draw.between(0.5, 2), draw.between(0.5, 2)
    density, stretch = draw.scaled(0.08, 0.5), draw.scaled(500, 10000)
    cloth = {"name": "sheet", "grid": [right + 1, bottom + 1], "size": [width, height], "areal_density": density,
             "stiffness": {"stretch": stretch, "shear": draw.scaled(0.02, 0.3) * stretch},
             "damping": draw.between(0, 2), "friction": draw.between(0, 0.8),
             "placement": {"origin": [-width / 2, 0, -height / 2], "u": [1, 0, 0], "v": [0, 0, 1]}}
    scene = {"time": {}, "cloths": [cloth], "colliders": {}}
    angle, kind = draw.between(0, 90) * math.pi / 180, draw.integer(0, 4)
    top, left = [[0, 0], [right, 0]], [[0, 0], [0, bottom]]
    boxes = ([top], [[[0, 0]] * 2, [[right, 0]] * 2], [], [left],
             [top, [[0, bottom], [right, bottom]], left, [[right, 0], [right, bottom]]])[kind]
    cloth["pins"] = [{"box": box} for box in boxes]
    if kind == 0:
        cloth["placement"]["v"] = [0, -math.cos(angle), math.sin(angle)]
    elif kind == 2:
        radius = draw.between(0.2, 0.45)
        center = [draw.between(-0.2, 0.2), -draw.between(0.05, 0.3) - radius, draw.between(-0.2, 0.2)]
        scene["colliders"]["spheres"] = [{"center": center, "radius": radius, "friction": draw.between(0, 0.8)}]
    elif kind == 3:
        cloth["placement"]["v"] = [0, -1, 0]
        scene["wind"] = {"velocity": [draw.between(2, 8), 0, draw.between(-2, 2)],
                         "gust": {"amplitude": draw.between(0, 2), "period": 1, "seed": draw.integer(1, 1000)}}
    return scene


def narrow(cloth, draw):
    before, cloth["grid"] = cloth["grid"], [draw.integer(2, 30), int(draw.scaled(2, 129.99))]
    for pin in cloth["pins"]:
        pin["box"] = [[cloth["grid"][axis] - 1 if corner[axis] == before[axis] - 1 else 0 for axis in (0, 1)]
                      for corner in pin["box"]]


def add_wind(scene, draw):
    speed, angle, up = draw.scaled(1, 30), draw.between(0, 2 * math.pi), draw.between(-0.3, 0.3)
    scene["wind"] = {"velocity": [speed * math.cos(angle), speed * up, speed * math.sin(angle)],
                     "gust": {"amplitude": draw.between(0, 0.5) * speed, "period": draw.between(0.3, 2),
                              "seed": draw.integer(1, 100000)}}


def shake(cloth, seconds, draw):
    """To and fro, all pins alike."""
    reach, beat, axis = draw.between(0.05, 0.6), draw.between(0.15, 0.5), draw.integer(0, 2)
    keys = [{"t": k * beat, "translate": [reach if k % 2 == 1 and axis == other else 0 for other in range(3)]}
            for k in range(1000) if k * beat <= seconds]
    for pin in cloth["pins"]:
        pin["path"] = keys


def add_obstacle(scene, seconds, draw):
    """Below the cloth, which starts in the plane y = 0 or hangs from it."""
    depth, x, z = draw.between(0.3, 0.6), draw.between(-0.5, 0.5), draw.between(-0.5, 0.5)
    cloth = scene["cloths"][0]
    hang, r = cloth["size"][1] if cloth["placement"]["v"][1] < -0.1 else 0, draw.between(0.1, 0.25)
    y = -hang - depth
    kind, obstacle = (("planes", {"normal": [0, 1, 0], "offset": y - r}),
                      ("boxes", {"center": [x, y, z], "half_extents": [r, 0.7 * r, 0.5 * r]}),
                      ("capsules", {"from": [x - 0.2, y, z], "to": [x + 0.2, y, z], "radii": [r, 0.5 * r]}),
                      ("ellipsoids", {"center": [x, y, z], "radii": [r, 0.5 * r, 0.8 * r]}))[draw.integer(0, 3)]
    obstacle["friction"] = draw.between(0, 0.8)
    if draw.integer(0, 2) == 0:
        lift, shift = draw.between(0, depth), draw.between(-0.5, 0.5)
        obstacle["path"] = [{"t": 0}, {"t": seconds, "translate": [shift, lift, 0]}]
    scene["colliders"].setdefault(kind, []).append(obstacle)


def add_blade(scene, seconds, draw):
    cloth, place = scene["cloths"][0], scene["cloths"][0]["placement"]
    s, t = draw.between(0.2, 0.8) * cloth["size"][0], draw.between(0.2, 0.8) * cloth["size"][1]
    x, y, z = (place["origin"][k] + (s * place["u"][k] + t * place["v"][k]) for k in range(3))
    begin = draw.between(0, 0.5) * seconds
    scene["cutters"] = [{"triangle": [[x, y - 0.3, z - 0.3], [x, y + 0.3, z], [x, y - 0.3, z + 0.3]],
                         "active": [begin, begin + 0.2 * seconds]}]


def draw_scene(seed, index):
    first = 1000003 * seed + 2 * index
    scene, draw = sheet_scene(first), Draw(first + 1)
    cloth = scene["cloths"][0]
    scene["name"], scene["time"] = f"a_{seed}_{index}", {"fps": 60, "frames": draw.integer(30, 90)}
    seconds = (scene["time"]["frames"] - 1) / 60
    if draw.one_of(4):
        narrow(cloth, draw)
    if draw.one_of(2):
        add_wind(scene, draw)
    if draw.one_of(10):
        scene["gravity"] = [0, 0, 0]
    rigid = draw.one_of(8)
    if draw.one_of(2):
        cloth["stiffness"]["bend"] = draw.scaled(1e-7, 1e-3)
    if rigid:
        cloth["stiffness"] = "rigid"
    if draw.one_of(4):
        shake(cloth, seconds, draw)
    for pin in cloth["pins"]:
        if draw.one_of(5):
            pin["release"] = draw.between(0.05, 0.9) * seconds
    if draw.one_of(3):
        for _ in range(draw.integer(1, 2)):
            add_obstacle(scene, seconds, draw)
    if draw.one_of(8):
        add_blade(scene, seconds, draw)
    if draw.one_of(6):
        second = sheet_scene(first + 500000)["cloths"][0]
        second["name"] = "second"
        second["placement"]["origin"][2] += 5
        scene["cloths"].append(second)
    return scene
