import unittest

import numpy as np

import stillbeam as sb


class Drives(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scene = sb.Scene.from_toml("d-tip30-quick").replace(payload=None)
        cls.told = []
        tell = lambda what, done: cls.told.append(done)
        cls.report = sb.drive(scene, {"motor": {"torque": 4.0}}, between="hermite", progress=tell)

    def test_feed_forward_makes_the_error_smaller(self):
        position, _, torque = self.report.trials[:3]
        self.assertEqual((position.sent, torque.sent), ("position", "position, velocity, torque"))
        self.assertLess(torque.hub_error, 0.2 * position.hub_error)
        still = [trial for trial in self.report.trials if trial.still]
        self.assertLess(still[0].residual, torque.residual)
        self.assertEqual(torque.time.shape, torque.motor_torque.shape)
        self.assertLessEqual(np.abs(torque.motor_torque).max(), 4.0)
        self.assertEqual(self.report.drive, "odrive")
        self.assertIn("feed-forward makes", self.report.conclusion)

    def test_every_trial_is_told_from_whatever_thread(self):
        count = len(self.report.trials)
        np.testing.assert_allclose(sorted(self.told), np.arange(1, count + 1) / count)

    def test_data_frame_and_picture(self):
        frame = self.report.to_dataframe()
        self.assertEqual(len(frame), len(self.report.trials))
        self.assertEqual(list(frame["sent"])[0], "position")
        self.assertEqual(len(self.report.plot()), 2)

    def test_refusals(self):
        scene = sb.Scene.from_toml("d-tip30-quick")
        cases = [
            (dict(machine="lathe"), "machine = lathe: no such file"),
            (dict(machine={"motor": {"torque": -1.0}}), "motor.torque = -1"),
            (dict(drive="stepper"), 'drive = "stepper": must be one of odrive, moteus, cia402'),
            (dict(between="leap"), 'between = "leap": must be one of hold'),
        ]
        for keywords, expected in cases:
            with self.assertRaisesRegex(ValueError, expected):
                sb.drive(scene, **keywords)


if __name__ == "__main__":
    unittest.main()
