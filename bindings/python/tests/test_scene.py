import copy
import pickle
import tempfile
import unittest
from pathlib import Path

import numpy as np

import stillbeam as sb

LINK = {"length": 0.4, "mass": 0.0224, "bending_stiffness": 0.46}
MOVE = {"profile": "quintic", "duration": 0.8, "to": 1.57, "settle": 0.3}


class Scenes(unittest.TestCase):
    def test_keywords_and_toml_are_the_same_scene(self):
        scene = sb.Scene(link=LINK, payload={"mass": 0.03}, move=MOVE)
        again = sb.Scene.from_toml(scene.to_toml())
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "arm.toml"
            path.write_text(scene.to_toml(), encoding="utf-8")
            read = sb.Scene.from_toml(path)
            self.assertEqual(read.name, str(path))
            for other in (again, read, sb.Scene.from_toml(str(path))):
                self.assertEqual(other.to_toml(), scene.to_toml())
                self.assertEqual(
                    sb.run(other, method="modal").torque.tobytes(),
                    sb.run(scene, method="modal").torque.tobytes(),
                )

    def test_numbers_pass_to_the_bit(self):
        values = np.random.default_rng(7).uniform(0.1, 1.0, 40)
        for length in values:
            scene = sb.Scene(link=dict(LINK, length=length))
            self.assertEqual(scene.length, float(length))
            self.assertEqual(sb.Scene.from_toml(scene.to_toml()).length, float(length))

    def test_numbers_of_numpy_lists_and_arrays_are_taken(self):
        rows = np.array([[0.0, 0.0], [0.4, 0.5], [0.9, 1.2]])
        scene = sb.Scene(
            link=dict(LINK, length=np.float32(0.5)),
            move={"waypoints": rows, "settle": np.float64(0.25)},
            solver={"modes": np.int64(2), "spin": np.bool_(True)},
        )
        self.assertEqual(scene.length, 0.5)
        run = sb.run(scene, method="elastica")
        self.assertAlmostEqual(run.hub_angle[-1], 1.2, delta=1e-6)

    def test_replace_changes_what_is_named_and_keeps_the_rest(self):
        scene = sb.Scene.from_toml("d-tip30-quick")
        heavier = scene.replace(payload={"mass": 0.05}, solver={"tick": 0.005})
        self.assertEqual((scene.tick, heavier.tick), (0.01, 0.005))
        self.assertIn("# SI units", heavier.to_toml())
        self.assertLess(heavier.describe()["frequency_hz"][0], scene.describe()["frequency_hz"][0])
        queue = scene.replace(moves=[MOVE, dict(MOVE, to=0.0)])
        self.assertEqual((queue.moves, queue.replace(move=MOVE).moves), (2, 1))
        self.assertEqual(scene.replace(move=None).moves, 0)
        turning = scene.replace(move={"profile": "spin-up", "duration": 0.5, "rate": 1.0})
        self.assertEqual(turning.replace(move={"rate": 2.0}).to_toml().count("to ="), 0)
        self.assertEqual(scene.replace(payload=None).describe()["payload_mass_kg"], 0.0)

    def test_errors_name_the_field_its_value_and_what_it_must_be(self):
        scene = sb.Scene(link=LINK, move=MOVE)
        cases = [
            (lambda: sb.Scene(), "link: missing; must be given"),
            (lambda: sb.Scene(link=dict(LINK, length=-1)), "link.length = -1: must be"),
            (lambda: sb.Scene(link=dict(LINK, lenght=1)), "link.lenght"),
            (lambda: scene.replace(payload={"mass": float("nan")}), "payload.mass = NaN: must be"),
            (lambda: scene.replace(move={"profile": "smooth"}), 'move.profile = "smooth"'),
            (lambda: sb.run(sb.Scene(link=LINK)), "move: missing; must be"),
            (lambda: sb.run(scene, method="fastest"), "solver.method"),
            (lambda: sb.run(scene, method="rigid", modes=2), "solver.modes = 2: rigid does not"),
            (lambda: sb.run(scene, tick=0), "solver.tick = 0: must be 0.000001 to 1 s"),
            (lambda: sb.reference(scene, solver="beam"), 'solver = "beam": must be rod or fem'),
            (lambda: sb.reference(scene, every=9.0), "every = 9: must be"),
            (lambda: sb.Scene.from_toml("nowhere.toml"), 'scene = "nowhere.toml": no such file'),
            (lambda: sb.Scene.from_toml("[link]\nlength = x"), "scene:2:10: link.length = x"),
        ]
        for call, expected in cases:
            with self.assertRaises(ValueError) as caught:
                call()
            text = str(caught.exception)
            self.assertIn(expected, text)
            self.assertNotIn("\n", text)

    def test_an_error_of_keywords_tells_no_line_of_a_text_that_nobody_wrote(self):
        with self.assertRaises(ValueError) as caught:
            sb.Scene(link=dict(LINK, length=0))
        self.assertTrue(str(caught.exception).startswith("link.length = 0"), caught.exception)

    def test_what_is_no_value_of_a_table_is_a_type_error_with_its_place(self):
        with self.assertRaisesRegex(TypeError, "payload.mass: a object"):
            sb.Scene(link=LINK, payload={"mass": object()})

    def test_a_scene_is_copied_pickled_and_compared(self):
        scene = sb.Scene.from_toml("s-gravity")
        self.assertEqual(pickle.loads(pickle.dumps(scene)), scene)
        self.assertEqual(copy.deepcopy(scene).to_toml(), scene.to_toml())
        self.assertNotEqual(scene, scene.replace(solver={"tick": 0.002}))

    def test_embedded_scenes_are_listed_and_described(self):
        known = sb.scenes()
        self.assertIn("d-fast", known)
        self.assertIn("violent", known["d-fast"])
        arm = sb.Scene.from_toml("d-tip30").replace(move=None).describe()
        self.assertAlmostEqual(arm["frequency_hz"][0], 3.94, delta=0.05)

    def test_values_in_another_unit_are_noted(self):
        scene = sb.Scene(link=LINK, move=dict(MOVE, duration=20, to=90))
        self.assertTrue(any("90" in note for note in scene.notes), scene.notes)


if __name__ == "__main__":
    unittest.main()
