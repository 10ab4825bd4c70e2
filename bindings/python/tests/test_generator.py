import unittest

import numpy as np

import stillbeam as sb


class Generators(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scene = sb.Scene.from_toml("d-tip30-quick")

    def test_by_hand_as_by_run_to_the_bit(self):
        for solver in (
            dict(method="rigid"),
            dict(method="newmark"),
            dict(method="newmark", mass="lumped", elements=2),
            dict(method="newmark", scalar="f64"),
            dict(method="modal"),
            dict(method="modal", elements=4, modes=1),
            dict(method="elastica"),
        ):
            run = sb.run(self.scene, **solver)
            generator = sb.Generator(self.scene, **solver)
            duration = generator.push(profile="quintic", duration=0.51, to=3.14159265358979)
            self.assertAlmostEqual(duration, 0.51, delta=1e-12)
            first = generator.tick()
            rest = generator.ticks(len(run) - 1)
            for name in ("time", "hub_angle", "hub_rate", "tip_x", "tip_y", "deflection"):
                values = getattr(run, name)
                self.assertEqual(getattr(first, name), values[0])
                self.assertEqual(getattr(rest, name).tobytes(), values[1:].tobytes(), solver)

    def test_moves_queue_up_from_where_the_one_before_ends(self):
        generator = sb.Generator(self.scene, method="modal", angle=0.5)
        generator.push(profile="cubic", duration=0.3, to=1.0)
        generator.push(profile="dwell", duration=0.1)
        generator.push(profile="s-curve", duration=0.4, to=-0.2)
        self.assertFalse(generator.is_holding)
        run = generator.ticks(81)
        self.assertTrue(generator.is_holding)
        self.assertEqual(generator.time, 81 * generator.period)
        self.assertAlmostEqual(run.hub_angle[0], 0.5, delta=1e-7)
        self.assertAlmostEqual(run.hub_angle[35], 1.0, delta=1e-6)
        self.assertAlmostEqual(run.hub_angle[-1], -0.2, delta=1e-6)

    def test_a_still_move_leaves_the_arm_at_rest(self):
        swing = {}
        for profile in ("quintic", "still"):
            generator = sb.Generator(self.scene, method="elastica")
            duration = generator.push(profile=profile, duration=0.51, to=3.14159265358979)
            generator.ticks(round(duration / generator.period))
            swing[profile] = abs(generator.ticks(30).deflection).max()
        self.assertLess(swing["still"], 0.01 * swing["quintic"])

    def test_a_change_of_mind(self):
        generator = sb.Generator(self.scene, method="elastica", acceleration=300.0)
        generator.push(profile="quintic", duration=0.51, to=3.0)
        generator.ticks(20)
        duration = generator.retarget(0.5, 0.6)
        run = generator.ticks(round(duration / generator.period) + 1)
        self.assertAlmostEqual(run.hub_angle[-1], 0.5, delta=1e-5)
        generator.push(profile="cubic", duration=0.5, to=0.0)
        self.assertAlmostEqual(generator.ticks(60).hub_angle[-1], 0.0, delta=1e-5)

    def test_a_hub_that_turns_comes_to_rest(self):
        generator = sb.Generator(self.scene, method="modal")
        generator.push(profile="spin-up", duration=0.2, rate=2.0)
        generator.push(profile="quintic", duration=0.6, to=1.0)
        run = generator.ticks(81)
        self.assertAlmostEqual(run.hub_angle[-1], 1.0, delta=1e-5)
        self.assertAlmostEqual(run.hub_rate[-1], 0.0, delta=1e-5)

    def test_what_is_refused_changes_nothing(self):
        scene = self.scene.replace(limits={"acceleration": 100.0}, move=None)
        generator = sb.Generator(scene, method="elastica")
        with self.assertRaisesRegex(ValueError, "acceleration"):
            generator.push(profile="quintic", duration=0.1, to=3.0)
        with self.assertRaisesRegex(ValueError, "move.profile"):
            generator.push(profile="leap", duration=0.1, to=3.0)
        with self.assertRaisesRegex(ValueError, "waypoints"):
            generator.push(waypoints=[[0.0, 0.0], [1.0, 0.5]])
        self.assertTrue(generator.is_holding)
        for _ in range(14):
            generator.push(profile="dwell", duration=0.1)
        with self.assertRaisesRegex(ValueError, "queue"):
            generator.push(profile="dwell", duration=0.1)
        self.assertTrue((generator.ticks(200).deflection == 0.0).all())
        self.assertTrue(generator.is_asleep)

    def test_angles_are_in_the_scenes_own_unit(self):
        scene = self.scene.replace(unit="deg", move=None, limits={"rate": 360.0})
        generator = sb.Generator(scene, method="modal", angle=np.radians(10.0))
        generator.push(profile="quintic", duration=0.8, to=90.0)
        self.assertAlmostEqual(generator.ticks(81).hub_angle[-1], np.pi / 2, delta=1e-6)

    def test_set_ups_that_there_are_not_are_refused(self):
        bare = self.scene.replace(move=None)
        cases = [
            (dict(method="elastica"), "acceleration: missing"),
            (dict(method="elastica", acceleration=-1.0), "acceleration = -1: must be"),
            (dict(method="modal", elements=3), "solver.elements"),
            (dict(method="modal", elements=1, mass="lumped", modes=2), "solver.modes"),
        ]
        for keywords, expected in cases:
            with self.assertRaisesRegex(ValueError, expected):
                sb.Generator(bare, **keywords)


if __name__ == "__main__":
    unittest.main()
