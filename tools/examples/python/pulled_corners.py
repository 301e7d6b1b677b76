#!/usr/bin/env python3
"""Many cloths at once, each pulled by one corner: a loop as learning programs have it, without depending on any.

    PYTHONPATH=build/python python3 tools/examples/python/pulled_corners.py [MEMBERS] [STEPS]
"""
import sys
import time

import drape
import numpy as np

MEMBERS = int(sys.argv[1]) if len(sys.argv) > 1 else 1024
STEPS = int(sys.argv[2]) if len(sys.argv) > 2 else 120

CLOTH = {
    "name": "cloth pulled by a corner",
    "time": {"fps": 60, "frames": 2},  # an ensemble goes on as long as it is stepped
    "cloths": [{
        "name": "cloth",
        "grid": [16, 16],
        "size": [0.4, 0.4],
        "placement": {"origin": [0, 0.6, 0], "u": [1, 0, 0], "v": [0, -1, 0]},
        "areal_density": 0.2,
        "stiffness": {"stretch": 400, "shear": 80, "bend": 1e-5},
        "damping": 0.5,
        "pins": [{"corner": "top_left"}],
    }],
    "colliders": {"planes": [{"normal": [0, 1, 0], "offset": 0}]},
    "solver": {"method": "line", "substeps": 4},
}


class PullCorner:
    """Bring the cloth's free end to a goal by moving one corner of it. Arrays have a row per member.

    An observation is [held corner, opposite corner, its velocity, goal], 12 numbers in m and m/s. An action is the
    velocity of the held corner, 3 numbers in m/s, at most 1 each. The reward is minus the distance, m, of the opposite
    corner to the goal. An episode ends after 90 frames, or within 3 cm.
    """

    longest = 90

    def __init__(self, members, seed=0):
        random = np.random.default_rng(seed)
        densities = random.uniform(0.1, 0.4, members)
        self.cloths = drape.Ensemble(CLOTH, [{"/cloths/0/areal_density": float(each)} for each in densities],
                                     controls=["pins"])
        self.random = random
        self.hand = np.zeros((members, 3))
        self.goal = np.zeros((members, 3))
        self.reset(np.arange(members))

    def reset(self, members):
        """Begins episodes of some members anew."""
        if len(members):
            self.cloths.reset(list(members))
            self.hand[members] = 0
            self.goal[members] = self.random.uniform([-0.3, 0.1, -0.3], [0.5, 0.5, 0.3], (len(members), 3))
        return self.observe()

    def observe(self):
        positions, velocities = self.cloths.positions(), self.cloths.velocities()
        return np.concatenate([positions[:, 0, 0], positions[:, -1, -1], velocities[:, -1, -1], self.goal], axis=1)

    def step(self, action):
        """Returns observations, rewards, which episodes are over; those begin anew."""
        self.hand += np.clip(action, -1, 1) / 60
        self.cloths.step(pins=self.hand[:, None])
        self.device_ms = self.cloths.device_ms
        distance = np.linalg.norm(self.cloths.positions()[:, -1, -1] - self.goal, axis=1)
        failed = np.isin(np.arange(len(self.cloths)), list(self.cloths.failures))
        over = (distance < 0.03) | (self.cloths.frames >= self.longest) | failed
        self.reset(np.flatnonzero(over))
        return self.observe(), -distance, over, distance < 0.03


def policy(observation):
    """Hold the corner as far above the goal as the cloth is long, and lead what hangs from it there."""
    held, opposite, velocity, goal = np.split(observation, 4, axis=1)
    above = goal + [0, 0.55, 0]
    return 3 * (above - held) + 2 * (goal - opposite) - 0.5 * velocity


environment = PullCorner(MEMBERS)
observation = environment.observe()
episodes = reached = 0
begun = time.perf_counter()
on_device = 0.0
for step in range(STEPS):
    observation, reward, over, there = environment.step(policy(observation))
    episodes += int(over.sum())
    reached += int(there.sum())
    on_device += environment.device_ms / 1000
seconds = time.perf_counter() - begun
print(f"{MEMBERS} cloths on {environment.cloths.device}: {STEPS} steps in {seconds:.2f} s, {on_device:.2f} s of them the "
      f"device's; {MEMBERS * STEPS / seconds:.0f} cloth frames a second")
print(f"{episodes} episodes ended, {reached} of them at the goal; mean reward {reward.mean():.3f}")
