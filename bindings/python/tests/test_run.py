import _thread
import signal
import sys
import threading
import unittest

import numpy as np

import stillbeam as sb


class Runs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scene = sb.Scene.from_toml("d-tip30-quick")

    def test_a_run_is_named_arrays(self):
        run = sb.run(self.scene, method="elastica", quality="fast")
        self.assertEqual(run.method, "elastica, 2 modes, fast, 10 ms, f32")
        self.assertEqual(len(run), len(run.time))
        np.testing.assert_allclose(np.diff(run.time), 0.01, rtol=1e-12)
        self.assertAlmostEqual(run.hub_angle[-1], np.pi, delta=1e-6)
        distance = np.hypot(run.tip_x, run.tip_y)
        self.assertLess(distance.max(), 0.4 + 1e-6)
        self.assertIsNone(run.payload_x)

    def test_auto_says_what_it_took_and_a_run_by_its_keywords_is_the_same(self):
        choice = sb.auto(self.scene)
        self.assertTrue(choice.within_tolerance)
        self.assertLessEqual(choice.tip_error, 1e-3)
        by_auto, by_name = sb.run(self.scene), sb.run(self.scene, **choice.keywords)
        self.assertEqual(by_auto.method, choice.name)
        if choice.method != "elastica":
            self.assertEqual(by_auto.torque.tobytes(), by_name.torque.tobytes())
        loose = sb.auto(self.scene, tolerance=1.0, torque_tolerance=1.0)
        self.assertEqual((loose.method, loose.keywords), ("rigid", {"method": "rigid"}))

    def test_the_reference_judges_a_run(self):
        run, rod = sb.run(self.scene, method="elastica"), sb.reference(self.scene)
        rigid = sb.run(self.scene, method="rigid")
        near, far = run.compare(rod), rigid.compare(rod)
        self.assertEqual(near.common, len(rod))
        self.assertLess(near.tip_max, 1e-3)
        self.assertGreater(far.tip_max, 0.1)
        self.assertAlmostEqual(run.residual, rod.residual, delta=2e-3)
        self.assertGreater(rod.residual, 0.1)

    def test_a_run_that_shows_no_residual_has_none(self):
        turning = self.scene.replace(move={"profile": "spin-up", "duration": 0.5, "rate": 1.0})
        self.assertTrue(np.isnan(sb.run(turning, method="modal").residual))

    def test_data_frames_have_the_columns_of_the_file(self):
        frame = sb.run(self.scene, method="modal").to_dataframe()
        self.assertEqual(list(frame.columns)[:2], ["t_s", "hub_angle_rad"])
        self.assertEqual(list(frame.columns)[-1], "torque_nm")
        gantry = sb.Scene(
            axis="linear",
            link={"length": 0.4, "mass": 0.0224, "bending_stiffness": 0.46},
            payload={"mass": 0.03, "offset": 0.05},
            move={"profile": "quintic", "duration": 1.0, "to": 0.2},
        )
        run = sb.run(gantry, method="modal")
        frame = run.to_dataframe()
        self.assertEqual(list(frame.columns)[1], "hub_position_m")
        self.assertEqual(list(frame.columns)[-2:], ["payload_x_m", "payload_y_m"])
        self.assertEqual(run.payload_x.shape, run.time.shape)

    def test_progress_is_told_and_its_exception_raised(self):
        told = []
        sb.reference(self.scene, progress=lambda what, done: told.append((what, done)))
        self.assertGreater(len(told), 3)
        self.assertEqual({what for what, _ in told}, {"reference"})
        self.assertTrue(all(0.0 <= done <= 1.0 for _, done in told))
        self.assertEqual(told, sorted(told))

    def test_an_exception_of_the_call_ends_the_work(self):
        told = []

        def stop(what, done):
            told.append(done)
            raise RuntimeError("enough")

        for work in [sb.reference, sb.auto]:
            told.clear()
            with self.assertRaisesRegex(RuntimeError, "enough"):
                work(self.scene, progress=stop)
            self.assertEqual(len(told), 1)
        with self.assertRaisesRegex(RuntimeError, "enough"):
            sb.plan(self.scene, to=1.0, progress=stop)

    def test_an_interrupt_ends_long_work_before_its_time(self):
        # Some seconds of simulation, if it is let.
        scene = sb.Scene(
            link={"length": 0.4, "mass": 0.0224, "bending_stiffness": 0.46},
            move={"profile": "quintic", "duration": 1.0, "to": 1.0, "settle": 20.0},
        )
        told = []

        def interrupt(what, done):
            if not told:
                _thread.interrupt_main()
            told.append(done)

        # A shell starts what runs in its background with interrupts ignored.
        before = signal.signal(signal.SIGINT, signal.default_int_handler)
        try:
            with self.assertRaises(KeyboardInterrupt):
                sb.reference(scene, every=0.1, progress=interrupt)
        finally:
            signal.signal(signal.SIGINT, before)
        self.assertLess(told[-1], 0.5)
        # The next one is not concerned.
        self.assertGreater(len(sb.reference(self.scene)), 10)

    def test_a_run_releases_the_interpreter(self):
        # With so long an interval, another thread gets on only if the run lets it.
        before = sys.getswitchinterval()
        gate, seen = threading.Lock(), []
        gate.acquire()

        def other():
            with gate:
                seen.append(True)

        thread = threading.Thread(target=other)
        thread.start()
        sys.setswitchinterval(1000.0)
        try:
            gate.release()
            for _ in range(1000):
                if seen:
                    break
                sb.run(self.scene, method="elastica", tick=0.001)
            self.assertTrue(seen)
        finally:
            sys.setswitchinterval(before)
            thread.join()

    def test_limits_refuse_a_run_with_what_would_do(self):
        limited = self.scene.replace(limits={"torque": 0.01})
        with self.assertRaisesRegex(ValueError, r"limits\.torque = 0\.01: move needs .*fits"):
            sb.run(limited, method="modal")

    def test_rounded_durations_are_noted(self):
        scene = self.scene.replace(move={"duration": 0.5123})
        self.assertTrue(any("0.5123" in note for note in sb.run(scene, method="modal").notes))


if __name__ == "__main__":
    unittest.main()
