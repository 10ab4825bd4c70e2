import unittest

import numpy as np

import stillbeam as sb


class Plans(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scene = sb.Scene.from_toml("d-tip30-quick")
        cls.plan = sb.plan(cls.scene, 3.14159265358979, duration=0.51)

    def test_a_plan_arrives_still_and_says_how_sure_that_is(self):
        plan = self.plan
        self.assertEqual((plan.ticks, round(plan.duration, 9)), (51, 0.51))
        self.assertLess(plan.residual, 1e-3)
        self.assertEqual(plan.residual_at_error[plan.frequency_error == 0.0], plan.residual)
        self.assertGreater(plan.residual_at_error[0], 10 * plan.residual)
        self.assertAlmostEqual(plan.hub_angle[-1], np.pi, delta=1e-9)
        self.assertEqual(plan.time.shape, plan.torque.shape)
        self.assertEqual(plan.peak_torque, max(plan.peak_torque, abs(plan.torque).max()))

    def test_its_scene_runs_and_rests(self):
        run = sb.run(self.plan.scene, method="elastica")
        self.assertLess(run.residual, 2e-3)
        quick = sb.run(self.scene, method="elastica")
        self.assertGreater(quick.residual, 0.1)

    def test_its_waypoints_are_the_motion_for_another_arm(self):
        rows = self.plan.waypoints()
        self.assertEqual(rows.shape, (52, 4))
        again = self.scene.replace(move={"waypoints": rows, "settle": 0.3})
        self.assertLess(sb.reference(again).residual, 1e-3)
        softer = again.replace(link={"bending_stiffness": 0.8 * 0.46})
        self.assertGreater(sb.reference(softer).residual, 0.01)

    def test_limits_make_the_shortest_move_longer(self):
        slow = sb.plan(self.scene, 1.0, max_rate=1.5)
        self.assertLessEqual(slow.peak_rate, 1.5 * (1 + 1e-4))
        self.assertGreater(slow.duration, 1.0 / 1.5)

    def test_data_frame_and_picture(self):
        frame = self.plan.to_dataframe()
        self.assertEqual(frame.shape, (len(self.plan.time), 8))
        self.assertEqual(len(self.plan.plot()), 3)

    def test_refusals(self):
        with self.assertRaisesRegex(ValueError, "duration"):
            sb.plan(self.scene, 3.0, duration=-1.0)
        with self.assertRaisesRegex(ValueError, "robust"):
            sb.plan(self.scene, 3.0, duration=0.6, robust=0.9)


if __name__ == "__main__":
    unittest.main()
