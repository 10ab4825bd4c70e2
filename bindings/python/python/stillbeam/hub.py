"""An arm on a hub that a torque drives, for those who learn controllers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Dict, Optional, Tuple, Union

import numpy as np

from . import _stillbeam
from ._common import Array

if TYPE_CHECKING:
    from ._stillbeam import Scene
    from .drive import Machine


@dataclass(frozen=True, eq=False)
class Box:
    """A box of real vectors, with the names that gymnasium's spaces have."""

    #: Least values.
    low: Array
    #: Greatest values.
    high: Array

    @property
    def shape(self) -> "Tuple[int, ...]":
        """Shape of a vector."""
        return self.low.shape

    def contains(self, value: Any) -> bool:
        """True if a vector is in the box."""
        value = np.asarray(value)
        within = (value >= self.low) & (value <= self.high)
        return bool(value.shape == self.shape and within.all())


class DrivenHub:
    """The reference rod behind motor, gear and friction, with gymnasium's ``reset`` and ``step``.

    gymnasium itself is not needed. The action is the motor's torque at its shaft, N m, held for
    `period` s; the motor gives of it what its limits allow. An observation holds the hub's angle
    less the target, rad, its rate, rad/s, the tip's deflection from where it rests at the target,
    m, and that deflection's mean rate over the step, m/s. The reward of a step is
    ``−period (d² + effort (τ/τ_limit)²)``: d is the tip's distance from its target in lengths of
    the link.

    An episode is terminated once the tip has stayed within `tolerance` lengths of its target for a
    first natural period of the clamped arm; it is truncated after `duration` s.

    scene: the arm. target: hub angle to go to, rad. start: hub angle at the beginning, rad.
    machine: as in ``drive``; by default a direct drive with a torque of up to 5 N m. spread:
    standard deviation of a random starting angle, rad. order, accuracy: polynomials of the rod, 5
    to 8, and tolerance of its integrator.
    """

    #: Names of what is observed.
    observed = ("angle_error", "rate", "deflection", "deflection_rate")

    def __init__(
        self,
        scene: "Scene",
        target: float = 1.0,
        *,
        start: float = 0.0,
        machine: "Optional[Machine]" = None,
        period: float = 0.01,
        duration: float = 3.0,
        effort: float = 0.01,
        tolerance: float = 0.005,
        spread: float = 0.0,
        order: int = 5,
        accuracy: float = 1e-6,
    ) -> None:
        for name, value in (("period", period), ("duration", duration), ("tolerance", tolerance)):
            if not 1e-6 <= value <= 1e6:
                raise ValueError(f"{name} = {value}: must be 0.000001 to 1000000")
        self.scene = scene
        self.target = target
        self.start = start
        self.machine = machine
        self.period = period
        self.duration = duration
        self.effort = effort
        self.tolerance = tolerance
        self.spread = spread
        self._fineness = (order, accuracy)
        self._random = np.random.default_rng()
        arm = scene.replace(move=None, moves=None)
        self._stay = arm.describe()["period_s"][0]
        self._rest = np.asarray(_stillbeam.Plant.rest_tip(scene, target))
        turn = np.array([[np.cos(target), -np.sin(target)], [np.sin(target), np.cos(target)]])
        self._goal = turn @ self._rest
        self._plant = self._at_rest(start)
        limit = self._plant.torque_limit
        self.torque_limit = float("inf") if limit is None else limit
        self.action_space = Box(np.array([-self.torque_limit]), np.array([self.torque_limit]))
        self.observation_space = Box(np.full(4, -np.inf), np.full(4, np.inf))
        self._begin()

    def _at_rest(self, angle: float) -> "_stillbeam.Plant":
        return _stillbeam.Plant(self.scene, self.machine, angle, *self._fineness)

    def _begin(self) -> None:
        self._since: Optional[float] = None
        self._deflection = self._plant.shown()[3]

    def reset(
        self, *, seed: Optional[int] = None, options: "Optional[Dict[str, Any]]" = None
    ) -> "Tuple[Array, Dict[str, Any]]":
        """Put the arm at rest at the beginning. Returns the observation and the facts of ``step``.

        seed: of the random starting angle. options: ``{"start": angle in rad}``.
        """
        if seed is not None:
            self._random = np.random.default_rng(seed)
        start = float((options or {}).get("start", self.start))
        if self.spread > 0.0:
            start += float(self._random.normal(0.0, self.spread))
        self._plant = self._at_rest(start)
        self._begin()
        shown = self._plant.shown()
        return self._observation(shown), self._facts(shown)

    def step(
        self, torque: "Union[float, Array]"
    ) -> "Tuple[Array, float, bool, bool, Dict[str, Any]]":
        """Hold a torque of the motor, N m, for a period.

        Returns the observation, the reward, whether the arm has come to rest at its target, whether
        the time is over, and facts: time s, hub angle rad, tip x and y m, the torque N m that the
        motor gave, and the tip's distance from its target in lengths.
        """
        (wanted,) = np.asarray(torque, dtype=float).reshape(-1)
        if not np.isfinite(wanted):
            raise ValueError(f"torque = {wanted}: must be a finite number in N m")
        shown = self._plant.advance(float(wanted), self.period)
        observation = self._observation(shown)
        facts = self._facts(shown)
        distance = facts["distance"]
        share = facts["torque"] / self.torque_limit if np.isfinite(self.torque_limit) else 0.0
        reward = -self.period * (distance**2 + self.effort * share**2)
        if distance > self.tolerance:
            self._since = None
        elif self._since is None:
            self._since = shown[0]
        rests = self._since is not None and shown[0] - self._since >= self._stay
        return observation, reward, rests, shown[0] >= self.duration - 1e-9, facts

    def close(self) -> None:
        """Do nothing; there is nothing to close."""

    def _observation(self, shown: "Tuple[float, ...]") -> Array:
        _, angle, rate, deflection, *_ = shown
        speed = (deflection - self._deflection) / self.period
        self._deflection = deflection
        return np.array([angle - self.target, rate, deflection - self._rest[1], speed])

    def _facts(self, shown: "Tuple[float, ...]") -> "Dict[str, Any]":
        time, angle, _, _, x, y, torque = shown
        distance = float(np.hypot(x - self._goal[0], y - self._goal[1])) / self.scene.length
        return {
            "time": time,
            "hub_angle": angle,
            "tip_x": x,
            "tip_y": y,
            "torque": torque,
            "distance": distance,
        }
