"""Generator b: scenes that nobody tunes by, with all that a scene may hold, in combinations that no one would think of.

It was written apart from generator a and shares nothing with it, so that what one forgets the other may have. A scene
has one to three cloths of 2 x 2 to 129 x 129 particles, 0.02 to 1 kg/m^2, limp to rigid, bending 0 to 1e-2 N m, hung,
thrown, released, dragged along paths or pulled taut; gravity, none or another; still air to 60 m/s with gusts; up to
four colliders of all kinds but meshes, still or moving; cutters; 30 to 90 frames. What cannot be is left out: rigid
cloth is not pulled, and no collider starts within a cloth.
"""
import math

STEP, MASK = 0x9e3779b97f4a7c15, 2**64 - 1


def splitmix64(state):
    x = (state + STEP) & MASK
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9 & MASK
    x = (x ^ x >> 27) * 0x94d049bb133111eb & MASK
    return x ^ x >> 31


def unit_interval(bits):
    return (bits >> 11) * 2.0**-53


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def times(factor, a):
    return [factor * a[0], factor * a[1], factor * a[2]]


def along(start, distance, way):
    return [start[k] + distance * way[k] for k in range(3)]


def length(a):
    return math.sqrt(dot(a, a))


class Dice:
    """The order of draws is the scene: no expression draws in an order that a reader has to look up."""

    def __init__(self, seed, index):
        self.state = (seed * STEP + index) & MASK
        self.next(), self.next()

    def next(self):
        bits = splitmix64(self.state)
        self.state = (self.state + STEP) & MASK
        return bits

    def unit(self):
        return unit_interval(self.next())

    def uniform(self, low, high):
        return low + (high - low) * self.unit()

    def scaled(self, low, high):
        """On a logarithmic scale."""
        return low * (high / low) ** self.unit()

    def chance(self, probability):
        return self.unit() < probability

    def below(self, count):
        return min(int(self.unit() * count), count - 1)

    def direction(self):
        """Uniform over the sphere."""
        z, angle = self.uniform(-1, 1), self.uniform(0, 2 * math.pi)
        r = math.sqrt(1 - z * z)
        return [r * math.cos(angle), r * math.sin(angle), z]

    def vector(self, shortest, longest):
        size = self.scaled(shortest, longest)
        return times(size, self.direction())

    def leaning(self, way, most):
        """A unit vector that leans away from `way` by up to `most` of its length."""
        share = self.uniform(0, most)
        leant = along(way, share, self.direction())
        largest = max(map(abs, leant))  # as std::hypot rounds
        size = largest * length([x / largest for x in leant])
        return [x / size for x in leant]


def point_of(cloth, s, t):
    """Where the point (s, t) in [0, 1]^2 of the flat cloth starts."""
    place = cloth["placement"]
    return along(along(place["origin"], s * cloth["size"][0], place["u"]), t * cloth["size"][1], place["v"])


def draw_cloth(number, dice):
    """Cells are up to four times as long as wide, but ribbons of many cells stay in a room. Three of ten cloths hang
    straight down or lie flat."""
    grid = [math.floor(dice.scaled(1.5001, 129.4999) + 0.5) for _ in range(2)]
    cell = dice.scaled(0.2, 3) / (grid[0] - 1)
    size = [cell * (grid[0] - 1), cell * dice.scaled(0.25, 4) * (grid[1] - 1)]
    shrink = min(1, 4 / max(size))
    size = [side * shrink for side in size]
    density, rigid, stretch = dice.scaled(0.02, 1), dice.chance(0.12), dice.scaled(50, 5e4)
    stiffness = {"stretch": stretch, "shear": stretch * dice.scaled(0.01, 0.6),
                 "bend": 0 if dice.chance(0.5) else dice.scaled(1e-7, 1e-2)}
    cloth = {"name": f"cloth{number}", "grid": grid, "size": size, "areal_density": density,
             "stiffness": "rigid" if rigid else stiffness, "damping": 0 if dice.chance(0.5) else dice.scaled(0.03, 6),
             "friction": dice.uniform(0, 1), "thickness": dice.uniform(0.001, 0.012)}
    u, other = dice.direction(), dice.direction()
    while abs(dot(u, other)) > 0.9:
        other = dice.direction()
    v = along(other, -dot(u, other), u)
    v = times(1 / length(v), v)
    kind = dice.uniform(0, 1)
    if kind < 0.3:
        u, v = [1, 0, 0], [0, -1, 0] if kind < 0.15 else [0, 0, 1]
    middle = [6.0 * number, dice.uniform(-0.5, 2), 0]
    cloth["placement"] = {"origin": along(along(middle, -0.5 * size[0], u), -0.5 * size[1], v), "u": u, "v": v}
    cloth["velocity"] = dice.vector(0.1, 5) if dice.chance(0.3) else [0, 0, 0]
    return cloth


def draw_path(seconds, speed, dice):
    """Through a few places and attitudes, at up to `speed` m/s: a curve is faster than its mean, so legs are slower."""
    legs = 1 + dice.below(4)
    begin = 0 if dice.chance(0.5) else dice.uniform(0, 0.5 * seconds)
    leg = (seconds - begin) / legs * dice.uniform(0.3, 1)
    keys = [{"t": begin, "translate": [0, 0, 0], "rotate": [0, 0, 0]}]
    for number in range(1, legs + 1):
        shift = leg * dice.uniform(0, 0.6 * speed)
        translate = along(keys[-1]["translate"], shift, dice.direction())
        rotate = keys[-1]["rotate"]
        if dice.chance(0.4):
            rotate = [angle + dice.uniform(-120, 120) * leg for angle in rotate]
        keys.append({"t": begin + number * leg, "translate": translate, "rotate": rotate})
    return keys


def pins_taut(cloth, right, bottom, seconds, dice):
    """Two borders, one pulled away from the other, then still."""
    axis = 0 if dice.chance(0.5) else 1
    share = 0 if cloth["stiffness"] == "rigid" else dice.scaled(0.002, 0.15)
    time = seconds * dice.uniform(0.2, 1)
    pins = [{"box": [[0, 0], [right * axis, bottom * (1 - axis)]]},
            {"box": [[right * (1 - axis), bottom * axis], [right, bottom]]}]
    if share > 0:
        way = times(share * cloth["size"][axis], cloth["placement"]["uv"[axis]])
        pins[1]["path"] = [{"t": 0}, {"t": time, "translate": way}]
    return pins


def draw_pins(cloth, seconds, dice):
    right, bottom = cloth["grid"][0] - 1, cloth["grid"][1] - 1
    kind, points = dice.below(7), []
    if kind == 3:
        points = [[0, 0], [right, 0]]
    elif kind == 4:
        for _ in range(1 + dice.below(3)):
            at = [dice.below(right + 1), dice.below(bottom + 1)]
            points += [at] if at not in points else []
    elif kind == 6:
        points = [[column, row] for column in (0, right) for row in (0, bottom)]
    pins = [{"box": [at, at]} for at in points]
    if kind in (1, 2):
        pins = [{"box": [[0, 0], [right, 0] if kind == 1 else [0, bottom]]}]
    elif kind == 5:
        pins = pins_taut(cloth, right, bottom, seconds, dice)
    # One path for all pins: apart they would pull cloth to any length.
    if not any("path" in pin for pin in pins) and dice.chance(0.45):
        path = draw_path(seconds, dice.scaled(0.2, 8), dice)
        for pin in pins:
            pin.update(path=path, pivot=point_of(cloth, 0.5, 0.5))
    for pin in pins:
        if dice.chance(0.25):
            pin["release"] = dice.uniform(0.02, 1) * seconds
    cloth["pins"] = pins
    if pins:
        cloth["velocity"] = [0, 0, 0]


def draw_forces(scene, dice):
    kind = dice.uniform(0, 1)
    scene["gravity"] = [0, 0, 0] if kind < 0.15 else dice.vector(1, 20) if kind < 0.25 else [0, -9.81, 0]
    if not dice.chance(0.55):
        return
    wind = scene["wind"] = {"velocity": dice.vector(0.5, 60), "drag": dice.uniform(0.3, 2), "lift": dice.uniform(0, 1)}
    if dice.chance(0.6):
        wind["gust"] = {"amplitude": length(wind["velocity"]) * dice.uniform(0.1, 0.8), "period": dice.uniform(0.1, 3),
                        "seed": dice.next() >> 40}


def draw_solid(size, dice):
    """Returns the kind of a shape about the origin, what it is, and the radius of the ball around it."""
    kind = dice.below(4)
    sides = [size * dice.scaled(0.25, 1) for _ in range(3 if kind in (1, 2) else 1)]
    if kind == 0:
        return "spheres", {"radius": sides[0]}, sides[0]
    if kind == 1:
        return "boxes", {"half_extents": sides}, length(sides)
    if kind == 2:
        return "ellipsoids", {"radii": sides}, max(sides)
    half = times(sides[0], dice.direction())
    radii = [0.5 * (size * dice.scaled(0.25, 1)) for _ in range(2)]
    return "capsules", {"from": times(-1, half), "to": half, "radii": radii}, 0.5 * length(times(2, half)) + max(radii)


def clear_of(cloths, center, radius):
    """Points of a lattice are looked at, which are up to a 32nd of the sides from everything between them."""
    for cloth in cloths:
        room = radius + 0.02 + cloth["thickness"] + (cloth["size"][0] + cloth["size"][1]) / 32
        apart = (along(point_of(cloth, i / 16, j / 16), -1, center) for i in range(17) for j in range(17))
        if any(dot(way, way) < room * room for way in apart):
            return False
    return True


def add_plane(scene, dice):
    up = [0, 1, 0] if dice.chance(0.7) else dice.leaning([0, 1, 0], 0.6)
    lowest = min(dot(up, point_of(cloth, s, t)) for cloth in scene["cloths"] for s in (0, 1) for t in (0, 1))
    plane = {"normal": up, "offset": lowest - dice.uniform(0.05, 0.6), "friction": dice.uniform(0, 1)}
    scene["colliders"].setdefault("planes", []).append(plane)


def add_solid(scene, seconds, dice):
    """Beside a cloth, mostly where gravity takes it."""
    cloths, gravity = scene["cloths"], scene["gravity"]
    cloth = cloths[dice.below(len(cloths))]
    kind, solid, radius = draw_solid(dice.scaled(0.1, 0.6) * max(cloth["size"]), dice)
    falls = dot(gravity, gravity) > 0 and dice.chance(0.7)
    way = dice.leaning(times(1 / length(gravity), gravity), 0.5) if falls else dice.direction()
    s, t = dice.uniform(0, 1), dice.uniform(0, 1)
    center = point_of(cloth, s, t)
    for _ in range(400):
        if clear_of(cloths, center, radius):
            break
        center = along(center, 0.1 * radius + 0.02, way)
    if kind == "capsules":
        solid["from"], solid["to"] = along(solid["from"], 1, center), along(solid["to"], 1, center)
    else:
        solid["center"] = center
    solid["friction"] = dice.uniform(0, 1)
    if dice.chance(0.5):
        solid["rotate"] = [dice.uniform(-180, 180) for _ in range(3)]
    if dice.chance(0.4):
        solid["path"] = draw_path(seconds, dice.scaled(0.1, 3), dice)
    scene["colliders"].setdefault(kind, []).append(solid)


def add_cutter(scene, seconds, dice):
    """A blade through a cloth, at rest or moved along."""
    cloth = scene["cloths"][dice.below(len(scene["cloths"]))]
    s, t = dice.uniform(0.1, 0.9), dice.uniform(0.1, 0.9)
    u, v, middle = cloth["placement"]["u"], cloth["placement"]["v"], point_of(cloth, s, t)
    normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
    normal = times(1 / length(normal), normal)
    reach, turn = dice.uniform(0.1, 0.6) * max(cloth["size"]), dice.uniform(0, 2 * math.pi)
    edge = along(times(math.cos(turn), u), math.sin(turn), v)
    corners = [along(along(middle, side * reach, edge), -0.4 * reach, normal) for side in (-1, 1)]
    begin = dice.uniform(0, 0.8) * seconds
    cutter = {"triangle": [*corners, along(middle, reach, normal)],
              "active": [begin, begin + dice.uniform(0.05, 0.6) * seconds]}
    if dice.chance(0.6):
        cutter["path"] = draw_path(seconds, dice.scaled(0.2, 3), dice)
    scene.setdefault("cutters", []).append(cutter)


def draw_scene(seed, index):
    dice = Dice(seed, index)
    fps = 60 if dice.chance(0.75) else 30 if dice.chance(0.5) else 120
    scene = {"name": f"b_{seed}_{index}", "time": {"fps": fps, "frames": 30 + dice.below(61)}, "cloths": [],
             "colliders": {}}
    seconds = (scene["time"]["frames"] - 1) / fps
    draw_forces(scene, dice)
    many = dice.uniform(0, 1)
    for number in range(1 if many < 0.7 else 2 if many < 0.9 else 3):
        cloth = draw_cloth(number, dice)
        draw_pins(cloth, seconds, dice)
        scene["cloths"].append(cloth)
    if dice.chance(0.5):
        for _ in range(1 + dice.below(4)):
            add_plane(scene, dice) if dice.chance(0.25) else add_solid(scene, seconds, dice)
    if dice.chance(0.15):
        for _ in range(1 + dice.below(2)):
            add_cutter(scene, seconds, dice)
    return scene
