import tempfile
import unittest
from pathlib import Path

import numpy as np

import stillbeam as sb

HZ, RATIO = 4.2, 0.008


def ring_down():
    time = np.arange(0.0, 6.0, 0.005)
    omega = 2.0 * np.pi * HZ
    swing = np.exp(-RATIO * omega * time) * np.cos(omega * np.sqrt(1.0 - RATIO**2) * time)
    noise = np.random.default_rng(3).normal(0.0, 0.01, time.size)
    return {"t_s": time, "tip_deflection_mm": 5.0 * swing + noise}


class Logs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.log = ring_down()
        cls.found = sb.identify(cls.log, modes=1)

    def test_frequency_and_damping_of_arrays(self):
        (mode,) = self.found.modes
        self.assertEqual(self.found.case, "ring-down")
        self.assertAlmostEqual(mode.frequency_hz / HZ, 1.0, delta=1e-4)
        self.assertAlmostEqual(mode.damping_ratio / RATIO, 1.0, delta=0.02)
        low, high = mode.frequency_interval_hz
        self.assertTrue(low < mode.frequency_hz < high)
        self.assertGreater(self.found.fit_percent, 95.0)
        self.assertEqual(self.found.report["unit"], "m")

    def test_a_file_a_frame_and_arrays_are_the_same_log(self):
        import pandas

        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "log.csv"
            frame = pandas.DataFrame(self.log)
            frame.to_csv(path, index=False)
            for log in (path, frame, [str(path)]):
                other = sb.identify(log, modes=1)
                self.assertEqual(other.modes, self.found.modes)

    def test_a_scene_is_fitted(self):
        scene = sb.Scene.from_toml("d-tip30").replace(move=None)
        found = sb.identify(self.log, scene=scene, modes=1)
        fitted = found.scene.describe()
        self.assertAlmostEqual(fitted["frequency_hz"][0] / HZ, 1.0, delta=2e-4)
        self.assertAlmostEqual(fitted["damping_ratio"][0] / RATIO, 1.0, delta=0.03)
        self.assertNotEqual(scene.to_toml(), found.scene.to_toml())

    def test_data_frame_and_picture(self):
        self.assertEqual(self.found.to_dataframe().shape, (1, 6))
        self.assertEqual(len(self.found.plot()), 2)

    def test_refusals_name_the_keyword(self):
        short = dict(self.log, t_s=self.log["t_s"][:-1])
        cases = [
            (dict(logs=short), r"logs\[0\]\.tip_deflection_mm: 1200 rows; must be 1199"),
            (dict(logs=self.log, kind="colour"), 'kind = "colour": must be one of deflection'),
            (dict(logs=self.log, modes=9), "modes = 9: must be 1 to 3"),
            (dict(logs=self.log, free=["payload"]), "must be beside scene"),
            (dict(logs=self.log, sensor="x"), "sensor = x: no such column"),
            (dict(logs=self.log, start=5.99), "between start and end"),
            (dict(logs="nowhere.csv"), "nowhere.csv"),
            (dict(logs=self.log, sensor_at=0.1), "sensor_at and sensor_mass"),
        ]
        for keywords, expected in cases:
            with self.assertRaisesRegex(ValueError, expected):
                sb.identify(**keywords)
        with self.assertRaisesRegex(TypeError, r"logs\[0\]: must be a path"):
            sb.identify([3.0])


if __name__ == "__main__":
    unittest.main()
