"""The Python module reads, hands out and refuses the right things, under Vulkan's validation throughout."""
import gc
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import drape
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Programs that do not ask for validation get it all the same.
VALIDATING = dict(os.environ, PYTHONPATH=str(pathlib.Path(drape.__file__).resolve().parent),
                  VK_INSTANCE_LAYERS="VK_LAYER_KHRONOS_validation",
                  VK_LAYER_ENABLES="VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT")
PROGRAM = pathlib.Path(drape.__file__).resolve().parents[1] / "drape"


def sheet(**changes):
    """A sheet of 9 x 7 particles that hangs by its upper corners."""
    scene = {
        "name": "sheet",
        "time": {"fps": 50, "frames": 6},
        "cloths": [{
            "name": "cloth",
            "grid": [9, 7],
            "size": [0.8, 0.6],
            "placement": {"origin": [-0.4, 1, 0], "u": [1, 0, 0], "v": [0, -1, 0]},
            "pins": [{"corner": "top_left"}, {"corner": "top_right"}],
        }],
        "solver": {"method": "relax", "substeps": 4},
        "image": {"size": [64, 48], "samples": 1},
    }
    scene.update(changes)
    return scene


class Validated(unittest.TestCase):
    """Fails when a simulation made by `simulate` had a validation message."""

    def setUp(self):
        self.simulations = []

    def simulate(self, scene, **options):
        self.simulations.append(drape.Simulation(scene, validate=True, **options))
        return self.simulations[-1]

    def tearDown(self):
        for simulation in self.simulations:
            self.assertEqual(simulation.validation_count, 0)


class Scenes(unittest.TestCase):
    def test_path_text_and_dict_are_the_same_scene(self):
        from_dict = drape.parse(sheet())
        from_text = drape.parse("// a comment\n" + json.dumps(sheet()))
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "scene.json"
            path.write_text(json.dumps(sheet()))
            from_file = drape.load(path)
        for scene in (from_dict, from_text, from_file):
            self.assertEqual((scene.name, scene.fps, scene.frame_count, scene.cloths), ("sheet", 50, 6, ["cloth"]))
            self.assertEqual(scene.to_dict(), from_dict.to_dict())

    def test_to_dict_has_every_default_and_is_a_scene(self):
        full = drape.parse(sheet()).to_dict()
        self.assertEqual(full["cloths"][0]["friction"], 0.3)
        self.assertEqual(drape.parse(full).to_dict(), full)

    def test_overrides(self):
        scene = drape.parse(sheet(), {"/time/frames": 3, "/cloths/0/size": [1, 1]})
        self.assertEqual(scene.frame_count, 3)
        self.assertEqual(scene.to_dict()["cloths"][0]["size"], [1, 1])

    def test_shapes_and_maps_are_looked_for_beside_a_scene_file(self):
        across, down = np.meshgrid(np.linspace(-0.4, 0.4, 9), np.linspace(1, 0.4, 7))
        shape = np.stack([across, down, 0.05 * np.sin(9 * across)], axis=2).astype(np.float32)
        cloth = {"grid": [9, 7], "size": [0.8, 0.6], "start": "shape.npy", "maps": {"holes": "cells.npy"}}
        scene = sheet(cloths=[cloth])
        with tempfile.TemporaryDirectory() as folder:
            np.save(pathlib.Path(folder) / "shape.npy", shape)
            np.save(pathlib.Path(folder) / "cells.npy", np.arange(48).reshape(6, 8) != 20)
            path = pathlib.Path(folder) / "scene.json"
            path.write_text(json.dumps(scene))
            loaded = drape.load(path, {"/time/frames": 2})
            simulation = drape.Simulation(loaded)
            simulation.step()
            np.testing.assert_array_equal(simulation.positions(0), shape)
            self.assertEqual(len(simulation.faces(0)), 2 * (48 - 1))
            np.savez_compressed(pathlib.Path(folder) / "packed.npz", positions=np.stack([2 * shape, shape]))
            simulation = drape.Simulation(drape.load(path, {"/cloths/0/start": "packed.npz"}))
            simulation.step()
            np.testing.assert_array_equal(simulation.positions(0), shape)
            with self.assertRaises(drape.SceneError) as caught:  # a dict has no place
                drape.parse(scene)
        self.assertIn("/cloths/0/start: cannot read 'shape.npy'", str(caught.exception))

    def test_warnings_say_where(self):
        cloth = sheet()["cloths"][0]
        overlapping = [cloth, dict(cloth, name="other")]
        self.assertTrue(any("/cloths" in text for text in drape.parse(sheet(cloths=overlapping)).warnings))


class Failures(Validated):
    def test_scene_error_is_the_command_lines(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "wrong.json"
            path.write_text('{\n  "cloths": [{"grid": [1, 2], "siez": [1, 1]}]\n}\n')
            program = subprocess.run([PROGRAM, "check", str(path)], capture_output=True, text=True, check=False)
            with self.assertRaises(drape.SceneError) as caught:
                drape.load(path)
        self.assertIsInstance(caught.exception, drape.Error)
        self.assertEqual(caught.exception.exit_code, program.returncode)
        for line in str(caught.exception).splitlines():
            self.assertIn(line, program.stderr + program.stdout)
        self.assertIn("wrong.json:2:", str(caught.exception))

    def test_missing_file(self):
        with self.assertRaises(drape.FileError) as caught:
            drape.load("/nowhere/scene.json")
        self.assertEqual(caught.exception.exit_code, 1)

    def test_no_such_device(self):
        with self.assertRaises(drape.DeviceError) as caught:
            drape.Simulation(sheet(), device="no such device")
        self.assertEqual(caught.exception.exit_code, 4)

    def test_missed_tolerance(self):
        simulation = self.simulate(sheet(solver={"method": "relax", "substeps": 1, "tolerance": 1e-9}))
        with self.assertRaises(drape.ToleranceError) as caught:
            for _ in simulation:
                pass
        self.assertEqual(caught.exception.exit_code, 8)
        self.assertIn("stretch error", str(caught.exception))

    def test_kept_failures_are_told(self):
        scene = sheet(solver={"method": "relax", "substeps": 1, "tolerance": 1e-9})
        failures = [step.failure for step in self.simulate(scene, keep_failed=True)]
        self.assertEqual(len(failures), 6)
        self.assertIn("stretch error", failures[-1])

    def test_what_was_not_asked_for_is_refused(self):
        simulation = self.simulate(sheet())
        with self.assertRaises(ValueError):
            simulation.positions()  # no frame yet
        simulation.step()
        with self.assertRaises(ValueError):
            simulation.picture()
        with self.assertRaises(ValueError):
            simulation.normals()
        with self.assertRaises(KeyError):
            simulation.positions("curtain")
        with self.assertRaises(IndexError):
            simulation.positions(1)
        with self.assertRaises(ValueError):
            drape.Simulation(sheet(), view="heat")
        with self.assertRaises(ValueError):
            drape.Simulation(sheet(), view="wire", view_range=0.1)


class Frames(Validated):
    def test_arrays_are_those_of_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "scene.json"
            path.write_text(json.dumps(sheet()))
            subprocess.run([PROGRAM, "simulate", path, "-o", folder + "/out", "-q", "--validate"], check=True)
            written = np.load(folder + "/out/positions.npz")
            manifest = json.loads(pathlib.Path(folder, "out/manifest.json").read_text())
        simulation = self.simulate(sheet())
        for number, step in enumerate(simulation):
            self.assertEqual((step.frame, step.time), (number, number / 50))
            np.testing.assert_array_equal(step.positions(), written["positions"][number])
            np.testing.assert_array_equal(step.velocities("cloth"), written["velocities"][number])
            for name, value in step.statistics.items():
                self.assertEqual(manifest["statistics"][number][name], value, name)
        self.assertEqual(number, 5)
        self.assertFalse(simulation.step())
        np.testing.assert_array_equal(simulation.faces(), written["faces"])
        np.testing.assert_array_equal(simulation.uv(), written["uv"])

    def test_views_share_memory_are_read_only_and_outlive_the_name(self):
        simulation = self.simulate(sheet(), draw=True, normals=True)
        simulation.step()
        first, again = simulation.positions(), simulation.positions()
        self.assertTrue(np.shares_memory(first, again))
        self.assertEqual((first.shape, first.dtype, first.strides[2]), ((7, 9, 3), np.float32, 4))
        for array in (first, simulation.velocities(), simulation.normals(), simulation.picture()):
            with self.assertRaises(ValueError):
                array[0, 0, 0] = 1
        start = first.copy()
        simulation.step()
        self.assertFalse(np.array_equal(first, start))  # a view shows the newest frame
        np.testing.assert_allclose(np.linalg.norm(simulation.normals(), axis=2), 1, atol=1e-5)
        kept = first.copy()
        self.simulations.clear()
        del simulation, again
        gc.collect()
        np.testing.assert_array_equal(first, kept)

    def test_layers(self):
        simulation = self.simulate(sheet(), layers=True, size=(40, 30))
        simulation.step()
        layers = simulation.layers()
        cloth = layers["id"] == 1
        self.assertEqual({name: array.shape for name, array in layers.items()},
                         {"depth": (30, 40), "normal": (30, 40, 3), "id": (30, 40), "strain": (30, 40)})
        self.assertTrue(cloth.any())
        np.testing.assert_array_equal(np.isinf(layers["depth"]), layers["id"] == 0)
        np.testing.assert_allclose(np.linalg.norm(layers["normal"][cloth], axis=1), 1, atol=1e-4)
        with self.assertRaises(ValueError):
            simulation.picture()
        with self.assertRaises(ValueError):
            layers["depth"][0, 0] = 1
        plain = self.simulate(sheet())
        plain.step()
        with self.assertRaises(ValueError):
            plain.layers()

    def test_picture(self):
        simulation = self.simulate(sheet(), draw=True, size=(40, 30))
        simulation.step()
        picture = simulation.picture()
        self.assertEqual((picture.shape, picture.dtype), ((30, 40, 4), np.uint8))
        self.assertTrue((picture[..., 3] == 255).all())
        wire = self.simulate(sheet(), draw=True, size=(40, 30), view="wire")
        wire.step()
        self.assertFalse(np.array_equal(picture, wire.picture()))

    def test_cut_faces_are_fewer(self):
        cutter = {"triangle": [[0.03, 2, -1], [0.03, 2, 1], [0.03, -1, 0]], "active": [0.03, 0.06]}
        simulation = self.simulate(sheet(cutters=[cutter]))
        simulation.step()
        self.assertEqual(len(simulation.faces()), 8 * 6 * 2)
        for _ in simulation:
            pass
        self.assertLess(len(simulation.faces()), 8 * 6 * 2)

    def test_goes_on_from_what_was_saved(self):
        simulation = self.simulate(sheet())
        for _ in range(3):
            simulation.step()
        self.assertTrue(simulation.can_save)
        saved = simulation.save()
        simulation.step()
        other = self.simulate(sheet())
        other.restore(saved)
        other.step()
        self.assertEqual(other.frame, simulation.frame)
        np.testing.assert_array_equal(other.positions(), simulation.positions())

    def test_other_threads_run_while_it_steps(self):
        scene = sheet(solver={"method": "relax", "substeps": 400})
        scene["cloths"][0]["grid"] = [65, 65]
        simulation = self.simulate(scene)
        simulation.step()
        ticks, done = [], threading.Event()

        def tick():
            while not done.is_set():
                ticks.append(None)
                time.sleep(0.0005)

        thread = threading.Thread(target=tick)
        thread.start()
        before = len(ticks)
        simulation.step()
        during = len(ticks) - before
        done.set()
        thread.join()
        self.assertGreater(during, 2)  # with the GIL held there would be at most one


class ForcesAndActions(Validated):
    def test_fields_of_forces_are_those_of_the_program(self):
        scene = sheet(forces="fields", colliders={"spheres": [{"center": [0, 0.7, -0.16], "radius": 0.15}]},
                      wind={"velocity": [0, 0, -6]})
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "scene.json"
            path.write_text(json.dumps(scene))
            subprocess.run([PROGRAM, "simulate", path, "-o", folder + "/out", "-q", "--export", "npz,npy"], check=True,
                           env=VALIDATING)
            archive = dict(np.load(folder + "/out/positions.npz"))
            for name in ("tension", "contact_force"):
                np.testing.assert_array_equal(np.load(f"{folder}/out/{name}.npy"), archive[name])
        simulation = self.simulate(scene)
        for frame, step in enumerate(simulation):
            np.testing.assert_array_equal(step.tensions(), archive["tension"][frame])
            np.testing.assert_array_equal(step.contact_forces(), archive["contact_force"][frame])
        self.assertEqual(step.tensions().shape, (7, 9, 4))
        np.testing.assert_array_equal(step.springs(), archive["springs"])
        self.assertGreater(np.abs(step.contact_forces()).max(), 0)
        told = [step.statistics[f"cloth/force_collider_0_sphere_{axis}_n"] for axis in "xyz"]
        np.testing.assert_allclose(step.contact_forces().sum(axis=(0, 1)), told, rtol=1e-5, atol=1e-6)
        members = drape.Ensemble(scene, 2, validate=True)
        for _ in range(frame):
            members.step()
        self.assertEqual(members.tensions().shape, (2, 7, 9, 4))
        np.testing.assert_array_equal(members.tensions()[1], step.tensions())
        np.testing.assert_array_equal(members.contact_forces()[1], step.contact_forces())
        plain = self.simulate(sheet())
        plain.step()
        with self.assertRaisesRegex(ValueError, "\"forces\": \"fields\""):
            plain.tensions()
        with self.assertRaisesRegex(drape.Error, "\"forces\": \"fields\""):
            drape.Ensemble(sheet(), 2, validate=True).tensions()

    def test_a_simulation_is_told_what_an_ensemble_is(self):
        scene = sheet(wind={"velocity": [0, 0, 1]})
        told = self.simulate(scene, controls=["wind", "pins", "holds"], hands=1)
        one = drape.Ensemble(scene, 1, controls=["wind", "pins", "holds"], hands=1)
        told.step()
        corner = told.positions()[-1, 0].astype(float)
        frames = [told.positions().copy()]
        for frame in range(1, 6):
            actions = {"wind": [0.1 * frame, 0, 2], "hands": [corner + [0, 0.002 * frame, 0]]}
            if frame == 2:
                actions.update(grasps=[[0, 6]], pins=[[0.01, 0, 0], [0, 0, 0]])
            if frame == 4:
                actions.update(holds=[True, False])
            told.act(**actions)
            one.step(**{name: np.array(value)[None] for name, value in actions.items()})
            self.assertTrue(told.step())
            np.testing.assert_array_equal(told.positions(), one.positions()[0])
            frames.append(told.positions().copy())
        self.assertAlmostEqual(told.statistics["given_wind_x_m_s"], 0.5)
        with tempfile.TemporaryDirectory() as folder:
            told.save_scene(folder + "/told.json")
            replayed = drape.load(folder + "/told.json")
        for step, positions in zip(self.simulate(replayed), frames):
            np.testing.assert_array_equal(step.positions(), positions)

    def test_what_cannot_be_told_changes_nothing(self):
        told = self.simulate(sheet(), controls=["wind"], hands=1)
        told.step()
        for actions, why in (({"wind": [0, 0, float("nan")]}, "wind: number 2 is nan"),
                             ({"wind": [[0, 0, 0]]}, r"wind: expected an array \[3\]"),
                             ({"hands": [[0, 0]]}, r"hands: expected an array \[1, 3 or 6\]"),
                             ({"grasps": [[0, 0]]}, "hand 0 is nowhere yet"),
                             ({"pins": [[0, 0, 0], [0, 0, 0]]}, "made without control of pins")):
            with self.assertRaisesRegex(drape.ActionError, why):
                told.act(**actions)
        plain = self.simulate(sheet())
        with self.assertRaisesRegex(drape.ActionError, "made without controls"):
            plain.act()
        for each in (told, plain):
            while each.step():
                pass
        np.testing.assert_array_equal(told.frame, plain.frame)


class Ensembles(Validated):
    def ensemble(self, scene, members, **options):
        self.simulations.append(drape.Ensemble(scene, members, validate=True, **options))
        return self.simulations[-1]

    def test_members_of_another_shape_are_asked_for_wrongly(self):
        with self.assertRaisesRegex(drape.Error, "member 1 is of another shape than member 0: /cloths/0/grid") as caught:
            drape.Ensemble(sheet(), [{}, {"/cloths/0/grid": [4, 4]}])
        self.assertEqual(caught.exception.exit_code, 2)

    def test_every_member_is_its_scene_alone(self):
        density = "/cloths/0/areal_density"
        members = [{density: 0.1}, {}, {density: 0.3, "/gravity": [1, -9, 0]}]
        together = self.ensemble(sheet(), members, normals=True)
        self.assertEqual(len(together), 3)
        self.assertIsNone(together.obstacle)
        alone = [self.simulate(drape.parse(sheet(), member), normals=True) for member in members]
        for frame in range(6):
            if frame:
                together.step()
            for number, each in enumerate(alone):
                each.step()
                for name in ("positions", "velocities", "normals"):
                    np.testing.assert_array_equal(getattr(together, name)("cloth")[number], getattr(each, name)())
                mine, other = together.statistics(number), each.statistics
                self.assertEqual({key: mine[key] for key in mine}, {key: other[key] for key in mine})
        np.testing.assert_array_equal(together.frames, [5, 5, 5])
        self.assertEqual(together.failures, {})
        np.testing.assert_array_equal(together.picture(2)[..., :3].shape, (48, 64, 3))

    def test_arrays_are_views_that_keep_the_ensemble(self):
        together = drape.Ensemble(sheet(), 4)
        before = together.positions()
        self.assertEqual(before.shape, (4, 7, 9, 3))
        self.assertFalse(before.flags.writeable)
        start = before.copy()
        together.step()
        self.assertGreater(np.abs(before - start).max(), 0)
        kept = before.copy()
        del together
        gc.collect()
        np.testing.assert_array_equal(before, kept)

    def test_actions_move_what_they_say(self):
        scene = sheet(wind={"velocity": [0, 0, 1]}, colliders={"spheres": [{"center": [0, -1, 0], "radius": 0.1}]})
        together = self.ensemble(scene, 3, controls=["pins", "wind", "colliders"])
        pins = np.zeros((3, 2, 3))
        pins[1, 0] = [0.01, 0.02, 0.03]
        wind = np.zeros((3, 3))
        wind[2] = [0, 0, 6]
        start = together.positions().copy()
        together.step(pins=pins, wind=wind, colliders=np.zeros((3, 1, 6)))
        moved = together.positions() - start
        np.testing.assert_allclose(moved[1, 0, 0], [0.01, 0.02, 0.03], atol=1e-6)
        np.testing.assert_array_equal(moved[0, 0, 0], 0)
        for _ in range(5):
            together.step(wind=wind)
        np.testing.assert_allclose(together.positions()[1, 0, 0] - start[1, 0, 0], [0.01, 0.02, 0.03], atol=1e-6)
        self.assertGreater(together.positions()[2, -1, :, 2].mean(), together.positions()[0, -1, :, 2].mean())

    def test_hands_take_and_pins_let_go(self):
        together = self.ensemble(sheet(), 2, controls=["holds", "gravity"], hands=["cloth"])
        start = together.positions().copy()
        lower = start[:, -1, -1].astype(float)
        grasps = np.full((2, 1, 2), -1)
        grasps[1] = [start.shape[2] - 1, start.shape[1] - 1]
        holds = np.ones((2, 2), bool)
        holds[1] = False
        together.step(hands=lower[:, None], grasps=grasps, holds=holds, gravity=np.zeros((2, 3)))
        for frame in range(1, 4):
            together.step(hands=lower[:, None] + [0.01 * frame, 0, 0], gravity=np.full((2, 3), [0, -9.81, 0]))
        moved = together.positions() - start
        np.testing.assert_allclose(moved[1, -1, -1], [0.03, 0, 0], atol=2e-6)
        np.testing.assert_array_equal(moved[0, 0, 0], 0)
        self.assertLess(moved[1, 0, 0, 1], -0.001)
        with self.assertRaisesRegex(drape.ActionError, "member 0: grasps: hand 0: columns 99 to 99 of rows 0 to 0"):
            together.step(grasps=np.array([[[99, 0]], [[-1, -1]]]))
        with self.assertRaisesRegex(drape.ActionError, r"grasps: expected an array \[2, 1, 2 or 4\]"):
            together.step(grasps=[[-1], [-1]])
        with self.assertRaisesRegex(drape.ActionError, r"holds: expected an array \[2, 2\]"):
            together.step(holds=[True, False])
        np.testing.assert_array_equal(together.frames, [4, 4])

    def test_what_a_member_was_told_is_a_scene(self):
        scene = sheet(forces=True, wind={"velocity": [0, 0, 1]})
        together = drape.Ensemble(scene, [{}, {"/cloths/0/areal_density": 0.3}], controls=["wind"], hands=1,
                                  record=True, validate=True)
        corner = together.positions()[1, -1, 0].astype(float)
        frames = [(together.positions()[1].copy(), together.statistics(1))]
        for frame in range(1, 8):
            hands = np.stack([corner, corner + [0.003 * frame, 0, 0.1 / 3 * frame]])[:, None]
            grasps = np.full((2, 1, 2), -1)
            if 2 <= frame < 6:
                grasps[1] = [0, 6]
            together.step(hands=hands, grasps=grasps, **({"wind": np.full((2, 3), frame / 3)} if frame == 4 else {}))
            frames.append((together.positions()[1].copy(), together.statistics(1)))
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "told.json"
            together.save_scene(path, 1)
            replayed = drape.load(path)
        simulation = drape.Simulation(replayed, validate=True)
        for step, (positions, numbers) in zip(simulation, frames):
            np.testing.assert_array_equal(step.positions(), positions)
            forces = {name: value for name, value in numbers.items() if "force_" in name}
            self.assertEqual({name: step.statistics[name] for name in forces}, forces)
        self.assertEqual(simulation.statistics["given_hands_0_hold"], 0)
        self.assertAlmostEqual(simulation.statistics["given_hands_0_translate_z_m"], corner[2] + 0.7 / 3)
        self.assertEqual(simulation.statistics["given_wind_x_m_s"], 4 / 3)
        self.assertEqual(simulation.validation_count, 0)
        with self.assertRaisesRegex(drape.Error, "nothing is recorded"):
            self.ensemble(sheet(), 1).save_scene("never.json")

    def test_bodies_are_told_and_pushed(self):
        scene = sheet(colliders={"spheres": [{"center": [5, 0, 0], "radius": 0.1, "mass": 0.5, "velocity": [0, 0, 1]}]})
        single = drape.Simulation(scene)
        single.step()
        bodies = single.bodies()
        np.testing.assert_allclose(bodies["position"], [[5, 0, 0]], atol=1e-6)
        np.testing.assert_allclose(bodies["velocity"], [[0, 0, 1]], atol=1e-6)
        self.assertEqual(bodies["turn"].shape, (1, 4))
        together = self.ensemble(scene, 2, controls=["bodies"])
        forces = np.zeros((2, 1, 3))
        forces[1, 0] = [2, 0, 0]
        for _ in range(6):
            together.step(body_forces=forces)
        found = together.bodies()
        self.assertEqual(found["position"].shape, (2, 1, 3))
        frame = 1 / drape.parse(scene).fps
        fallen = -6 * 9.81 * frame
        np.testing.assert_allclose(found["velocity"][:, 0], [[0, fallen, 1], [4 * 6 * frame, fallen, 1]], atol=1e-5)
        thrown = np.zeros((2, 1, 6))
        thrown[:, 0, 1] = 3
        together.step(body_velocities=thrown, body_sets=[[True], [False]])
        np.testing.assert_allclose(together.bodies()["velocity"][:, 0, 1], [3 - 9.81 * frame, 7 / 6 * fallen], atol=1e-5)
        with self.assertRaisesRegex(drape.ActionError, "member 1: body_impulses: number 2 is nan"):
            together.step(body_impulses=[[[0, 0, 0]], [[0, 0, float("nan")]]])
        np.testing.assert_array_equal(together.frames, [7, 7])

    def test_members_by_auto_act_too(self):
        together = self.ensemble(sheet(solver={"method": "auto"}), 2, controls=["pins"], hands=1)
        pins = np.zeros((2, 2, 3))
        for frame in range(4):
            pins[1, 0] = [0.005 * frame, 0, 0]
            together.step(pins=pins)
        moved = together.positions()[:, 0, 0] - self.ensemble(sheet(), 1).positions()[0, 0, 0]
        np.testing.assert_allclose(moved, [[0, 0, 0], [0.015, 0, 0]], atol=1e-6)

    def test_members_go_back_and_on_by_themselves(self):
        together = self.ensemble(sheet(), 3)
        frames = [together.positions()[0].copy()]
        for _ in range(5):
            together.step()
            frames.append(together.positions()[0].copy())
        together.reset([0, 2])
        together.step()
        saved = together.save(2)
        np.testing.assert_array_equal(together.frames, [1, 6, 1])
        np.testing.assert_array_equal(together.positions()[2], frames[1])
        together.step()
        together.restore([1], [saved])
        together.step()
        np.testing.assert_array_equal(together.frames, [3, 2, 3])
        np.testing.assert_array_equal(together.positions()[1], frames[2])
        with self.assertRaises(drape.Error):
            together.restore([0], [{"member": b"nonsense"}])
        with self.assertRaisesRegex(drape.Error, "its checksum does not fit"):
            together.restore([0], [{**saved, "loop": saved["loop"][::-1]}])

    def test_a_mask_says_which_members_go_back(self):
        together = self.ensemble(sheet(), 3)
        together.step()
        together.reset(np.array([True, False, True]))
        np.testing.assert_array_equal(together.frames, [0, 1, 0])

    def test_overrides_are_of_the_scene_as_it_was_written(self):
        changes = [{}, {"/cloths/0/fabric": "silk"}]
        together = self.ensemble(sheet(), changes)
        together.step()
        alone = drape.Simulation(drape.parse(sheet(), changes[1]))
        alone.step()
        alone.step()
        np.testing.assert_array_equal(together.positions()[1], alone.positions(0))
        self.assertGreater(np.abs(together.positions()[1] - together.positions()[0]).max(), 0)

    def test_members_that_go_apart_are_as_those_that_share_dispatches(self):
        changes = {"auto": {"/solver": {"method": "auto"}}, "tear": {"/cloths/0/tear": {"strain": 0.5}},
                   "contact": {"/cloths/0/self_collision": True}}
        for kind, change in changes.items():
            together = self.ensemble(drape.parse(sheet(), change), 2)
            self.assertEqual(together.obstacle is None, kind != "tear")
            positions, velocities = together.positions(), together.velocities()
            start = positions.copy()
            frames = []
            for _ in range(4):
                together.step()
                frames.append(positions[0].copy())
            self.assertGreater(np.abs(frames[0] - start[0]).max(), 0, "the view does not follow")
            self.assertGreater(np.abs(velocities).max(), 0)
            together.reset()
            np.testing.assert_array_equal(positions, start)
            for frame in frames:
                together.step()
                np.testing.assert_array_equal(positions[1], frame)

    def test_dropped_ones_leave_neither_threads_nor_memory(self):
        def kept():
            with open("/proc/self/status", encoding="ascii") as status:
                lines = dict(line.split(":", 1) for line in status)
            return int(lines["Threads"]), int(lines["VmRSS"].split()[0])

        for round_ in range(8):
            ensemble = drape.Ensemble(sheet(), [{}, {"/cloths/0/areal_density": 0.3}], validate=True)
            ensemble.step()
            self.assertEqual(ensemble.validation_count, 0)
            del ensemble
            if round_ == 3:  # the driver keeps what it made of the first ones
                threads, kilobytes = kept()
        self.assertEqual(kept()[0], threads)
        self.assertLess(kept()[1] - kilobytes, 16384)

    def test_what_cannot_be_is_refused(self):
        with self.assertRaisesRegex(drape.Error, "member 1 .* /cloths/0/grid is 8 x 7, not 9 x 7"):
            drape.Ensemble(sheet(), [{}, {"/cloths/0/grid": [8, 7]}])
        with self.assertRaisesRegex(ValueError, "controls are"):
            drape.Ensemble(sheet(), 2, controls=["friction"])
        with self.assertRaisesRegex(drape.Error, "^an ensemble needs a member$"):
            drape.Ensemble(sheet(), [])
        with self.assertRaisesRegex(TypeError, "a dict or a Scene for each"):
            drape.Ensemble(sheet(), ["cloth"])
        together = self.ensemble(sheet(), 2, controls=["pins"])
        pins = np.zeros((2, 2, 3))
        pins[1, 1, 2] = np.inf
        with self.assertRaisesRegex(drape.ActionError, "member 1: pins: number 8 is inf") as caught:
            together.step(pins=pins)
        self.assertEqual(caught.exception.member, 1)
        self.assertIsInstance(caught.exception, drape.Error)
        np.testing.assert_array_equal(together.frames, [0, 0])
        with self.assertRaisesRegex(drape.ActionError, r"pins: expected an array \[2, 2, 3 or 6\]"):
            together.step(pins=np.zeros((2, 1, 3)))
        for members, error in ((1, TypeError), ([0.5], TypeError), ([-1], IndexError), ([True], ValueError)):
            with self.assertRaisesRegex(error, "members: "):
                together.reset(members)
        with self.assertRaises(IndexError):
            together.save(2)


class Examples(unittest.TestCase):
    def run_example(self, *words):
        with tempfile.TemporaryDirectory() as folder:
            example = ROOT / "tools/examples/python" / words[0]
            done = subprocess.run([sys.executable, example, *words[1:]], cwd=folder, env=VALIDATING, text=True,
                                  capture_output=True, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertNotRegex(done.stdout + done.stderr, "VUID|SYNC-HAZARD|Validation Error")
            files = {path.name: path.stat().st_size for path in pathlib.Path(folder).iterdir()}
        return done.stdout, files

    def test_wind_tunnel(self):
        said, _ = self.run_example("wind_tunnel.py", "8")
        self.assertEqual(len(said.splitlines()), 3)
        self.assertIn("8 m/s: the free edge is ", said)

    def test_pulled_corners(self):
        said, _ = self.run_example("pulled_corners.py", "4", "100")
        self.assertRegex(said, r"4 cloths on .*: 100 steps in .* cloth frames a second")
        self.assertRegex(said, r"[1-9]\d* episodes ended, \d+ of them at the goal")

    def test_fold_towel(self):
        said, files = self.run_example("fold_towel.py", "24", "fold.json")
        self.assertGreater(files["fold.json"], 5000)
        pull, weight = map(float, re.search(r"at most (\S+) N; the towel weighs (\S+) N", said).groups())
        self.assertAlmostEqual(weight, 0.3 * 0.4 * 0.4 * 9.81, places=2)
        self.assertGreater(pull, weight / 4)
        found = re.search(r"laid (\S+) mm from .* lies (\S+) mm above the table", said)
        self.assertLess(float(found[1]), 0.01)
        self.assertLess(float(found[2]), 60)
        self.assertLess(int(re.search(r"covers (\d+) %", said)[1]), 90)
        self.assertIn("nothing failed", said)

    def test_walking_cape(self):
        with tempfile.TemporaryDirectory() as folder:
            program = [sys.executable, ROOT / "tools/examples/python/walking_cape.py", folder]
            said = subprocess.run(program, text=True, capture_output=True, check=True).stdout
            self.assertRegex(said, r"^\d{4} vertices, \d{4,5} triangles, 30 poses\n$")
            # The array and the point cache hold the same poses.
            walk = np.load(pathlib.Path(folder) / "walk.npy")
            cache = np.frombuffer(pathlib.Path(folder, "walk.pc2").read_bytes()[32:], "<f4")
            np.testing.assert_array_equal(walk.ravel(), cache)
            few = {"/time/frames": 4, "/solver/method": "line", "/solver/substeps": 4, "/cloths/0/self_collision": False}
            scene = drape.load(pathlib.Path(folder) / "cape.json", few)
        simulation = drape.Simulation(scene, validate=True)
        for _ in range(3):
            simulation.step()
        self.assertTrue(np.isfinite(simulation.positions("cape")).all())

    def test_drop_test(self):
        said, files = self.run_example("drop_test.py", "0.3")
        weight, bears = (float(re.search(what, said)[1]) for what in (r"a sheet of (\S+) N", r"the bar bears (\S+) N"))
        self.assertAlmostEqual(weight, 0.3 * 0.8 * 0.6 * 9.81, places=2)
        self.assertAlmostEqual(float(re.search(r"after (\S+) s", said)[1]), (2 * 0.3 / 9.81) ** 0.5, delta=0.01)
        self.assertGreater(float(re.search(r"with (\S+) N", said)[1]), weight)
        self.assertGreater(bears, 0)
        impulse, change = (float(each) for each in re.search(r"gave (\S+) N s.* by (\S+) kg", said).groups())
        self.assertLess(abs(impulse - change), 1e-4 * weight)  # in a second
        self.assertGreater(files["drop_test.csv"], 10000)
        self.assertGreater(files["drop_test.svg"], 1000)

    def test_fit_swing(self):
        said, _ = self.run_example("fit_swing.py", "16", "3")
        off = [float(each) for each in re.findall(r"the edge is ([\d.]+) mm off", said)]
        self.assertEqual(len(off), 3)
        self.assertLess(off[-1], off[0])

    def test_heat_map(self):
        said, files = self.run_example("heat_map.py", ROOT / "scenes/cloth_on_sphere.json", "3")
        self.assertIn("stretch: 3 frames by ", said)
        self.assertEqual(files["heat_map.ppm"], 2 * 480 * 360 * 3 + len("P6 960 360 255\n"))
        self.assertEqual(files["positions.npy"], 128 + 3 * 65 * 65 * 3 * 4)


if __name__ == "__main__":
    unittest.main()
