import unittest

import numpy as np

import stillbeam as sb

FREE = {"friction": {"coulomb": 0.0, "viscous": 0.0}, "motor": {"torque": 1.0}}


class Hubs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scene = sb.Scene.from_toml("d-tip30").replace(move=None)

    def test_the_torque_of_a_run_turns_the_hub_along_it(self):
        scene = self.scene.replace(
            move={"profile": "quintic", "duration": 0.6, "to": 1.0, "settle": 0.1},
            solver={"tick": 0.001},
        )
        run = sb.run(scene, method="elastica")
        rotor = {"motor": {"torque": 1.0, "rotor_inertia": 0.0}}
        machine = dict(FREE, **rotor)
        hub = sb.DrivenHub(scene, 1.0, machine=machine, period=0.001)
        hub.reset()
        angles = [0.0]
        for torque in 0.5 * (run.torque[:-1] + run.torque[1:]):
            *_, facts = hub.step(torque)
            angles.append(facts["hub_angle"])
        # Nothing holds the hub to its command, so small errors of the torque add up.
        np.testing.assert_allclose(angles, run.hub_angle, atol=5e-3)

    def test_a_controller_brings_the_arm_to_rest(self):
        machine = dict(FREE, motor={"torque": 1.0, "rotor_inertia": 2e-3})
        hub = sb.DrivenHub(self.scene, 0.5, machine=machine, period=0.005, duration=4.0)
        observation, facts = hub.reset()
        self.assertEqual(len(observation), len(hub.observed))
        self.assertEqual((observation[0], facts["time"]), (-0.5, 0.0))
        rewards, terminated, truncated = [], False, False
        while not (terminated or truncated):
            error, rate, *_ = observation
            observation, reward, terminated, truncated, facts = hub.step(-0.3 * error - 0.06 * rate)
            rewards.append(reward)
        self.assertTrue(terminated, facts)
        self.assertLess(facts["time"], 2.0)
        self.assertLess(facts["distance"], 0.005)
        self.assertTrue(all(reward <= 0.0 for reward in rewards))

    def test_time_runs_out(self):
        hub = sb.DrivenHub(self.scene, 1.0, duration=0.05)
        hub.reset()
        ends = [hub.step(0.0)[2:4] for _ in range(5)]
        self.assertEqual(ends, [(False, False)] * 4 + [(False, True)])

    def test_a_seed_repeats_an_episode(self):
        def episode(seed):
            hub = sb.DrivenHub(self.scene, 1.0, spread=0.3)
            first, _ = hub.reset(seed=seed)
            return [first[0]] + [hub.step([0.1])[0][1] for _ in range(5)]

        self.assertEqual(episode(4), episode(4))
        self.assertNotEqual(episode(4), episode(5))
        hub = sb.DrivenHub(self.scene, 1.0)
        self.assertEqual(hub.reset(options={"start": 0.25})[1]["hub_angle"], 0.25)

    def test_the_motor_gives_what_it_can(self):
        hub = sb.DrivenHub(self.scene, 1.0, machine={"motor": {"torque": 0.2}})
        self.assertEqual(hub.torque_limit, 0.2)
        self.assertTrue(hub.action_space.contains([0.2]))
        self.assertFalse(hub.action_space.contains([0.3]))
        hub.reset()
        self.assertEqual(hub.step(9.0)[-1]["torque"], 0.2)

    def test_refusals(self):
        hub = sb.DrivenHub(self.scene)
        with self.assertRaisesRegex(ValueError, "torque = nan"):
            hub.step(float("nan"))
        with self.assertRaisesRegex(ValueError, "period = 0"):
            sb.DrivenHub(self.scene, period=0)
        with self.assertRaisesRegex(ValueError, "axis"):
            sb.DrivenHub(self.scene.replace(axis="linear"))


if __name__ == "__main__":
    unittest.main()
