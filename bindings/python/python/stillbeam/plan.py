"""Moves that arrive still."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Dict, Optional

import numpy as np

from . import _stillbeam
from ._common import Array, Progress, axes, given, optional

if TYPE_CHECKING:
    from ._stillbeam import Scene


@dataclass(frozen=True, eq=False)
class Plan:
    """A move that arrives without residual vibration, and what the reference rod makes of it."""

    #: Hub angle at the beginning, rad.
    start: float
    #: Hub angle at the end, rad.
    to: float
    #: Duration, s; whole ticks.
    duration: float
    #: Number of ticks.
    ticks: int
    #: Control period, s.
    tick: float
    #: First natural period of the arm, s.
    first_period: float
    #: Greatest hub rate, rad/s.
    peak_rate: float
    #: Greatest hub acceleration, rad/s².
    peak_acceleration: float
    #: Greatest hub jerk, rad/s³.
    peak_jerk: float
    #: Greatest hub torque in the reference rod, N m.
    peak_torque: float
    #: Greatest bending moment at the clamp in the reference rod, N m.
    peak_moment: float
    #: Greatest deflection of the tip, m.
    peak_deflection: float
    #: Residual vibration in the reference rod, fraction of the length.
    residual: float
    #: Simulations that the search took.
    simulations: int
    #: Errors of the arm's frequencies, fractions from −0.2 to 0.2.
    frequency_error: Array
    #: Residual vibration at each of those errors, fraction of the length.
    residual_at_error: Array
    #: Time of the reference rod's run, s. It ends a first period after arrival.
    time: Array
    #: Hub angle, rad.
    hub_angle: Array
    #: Hub rate, rad/s.
    hub_rate: Array
    #: Hub acceleration, rad/s².
    hub_acceleration: Array
    #: The tip in the global frame, X, m.
    tip_x: Array
    #: The tip in the global frame, Y, m.
    tip_y: Array
    #: Deflection of the tip, m.
    deflection: Array
    #: Torque into the hub, N m.
    torque: Array
    #: Time s, angle rad and rate rad/s of a move with a piecewise-linear acceleration, as the
    #: shortest moves have; their cubic path is the move. None of a move with a bulge.
    rows: Optional[Array]
    #: Fraction to which the arm's frequencies need to be known, of a robust move.
    robust: Optional[float]
    #: The scene of the arm.
    arm: "Scene" = field(repr=False)

    @property
    def scene(self) -> "Scene":
        """The arm with this move, for ``run``, ``drive`` or ``export``; angles in rad."""
        settle = 1.2 * max(self.first_period, 6.0 * self.tick)
        move: Dict[str, Any]
        if self.rows is not None:
            move = given(profile="cubic", waypoints=self.rows, settle=settle)
            return self.arm.replace(unit=None, limits=None, move=move)
        move = given(
            profile="still",
            duration=self.duration,
            to=self.to,
            robust=self.robust,
            settle=settle,
        )
        move["from"] = self.start
        return self.arm.replace(unit=None, limits=None, move=move)

    def waypoints(self) -> Array:
        """Return the hub's motion itself, for another arm or program: a row every tick with time s,
        angle rad, rate rad/s and acceleration rad/s², as ``{"waypoints": …, "profile": "quintic"}``
        of a move has them."""
        times = self.tick * np.arange(self.ticks + 1)
        nearest = np.clip(np.searchsorted(self.time, times - 1e-9), 0, len(self.time) - 1)
        columns = (self.hub_angle, self.hub_rate, self.hub_acceleration)
        rows = np.column_stack([times, *(column[nearest] for column in columns)])
        # At rest, and not within rounding of it.
        rows[[0, -1], 2] = 0.0
        return rows

    def to_dataframe(self) -> Any:
        """Return the reference rod's run as a pandas.DataFrame with units in the columns' names."""
        return optional("pandas", "to_dataframe").DataFrame(
            {
                "t_s": self.time,
                "hub_angle_rad": self.hub_angle,
                "hub_rate_rad_s": self.hub_rate,
                "hub_accel_rad_s2": self.hub_acceleration,
                "tip_x_m": self.tip_x,
                "tip_y_m": self.tip_y,
                "deflection_m": self.deflection,
                "torque_nm": self.torque,
            }
        )

    def plot(self, ax: Any = None) -> Any:
        """Draw the move and its sensitivity with matplotlib; return the three axes."""
        if ax is None:
            pyplot = optional("matplotlib.pyplot", "plot")
            _, ax = pyplot.subplots(3, 1, layout="constrained", figsize=(7, 7))
        made = axes(ax)
        made[0].plot(self.time, self.hub_angle)
        made[0].set_ylabel("hub angle, rad")
        made[1].plot(self.time, 1e3 * self.deflection)
        made[1].set_ylabel("deflection, mm")
        made[1].set_xlabel("time, s")
        for panel in made[:2]:
            panel.axvline(self.duration, color="grey", linestyle=":")
        made[2].plot(100 * self.frequency_error, 100 * self.residual_at_error, marker=".")
        made[2].set_ylabel("residual, % of L")
        made[2].set_xlabel("error of the arm's frequency, %")
        for panel in made:
            panel.grid(True, alpha=0.3)
        return made


def plan(
    scene: "Scene",
    to: float,
    *,
    start: Optional[float] = None,
    duration: Optional[float] = None,
    robust: Optional[float] = None,
    max_rate: Optional[float] = None,
    max_acceleration: Optional[float] = None,
    max_jerk: Optional[float] = None,
    max_torque: Optional[float] = None,
    max_moment: Optional[float] = None,
    progress: Progress = None,
) -> Plan:
    """Plan a move that arrives still, for the scene's arm, limits and tick.

    to: hub angle at the end, rad; on a linear axis the position, m. start: the same at the
    beginning; by default the scene's. duration: s; by default the shortest within the limits.
    robust: fraction to which the arm's frequency is known, 0.01 to 0.3, for a move that stays still
    across it. max_rate, rad/s, max_acceleration, rad/s², max_jerk, rad/s³, max_torque and
    max_moment at the clamp, N m: by default the scene's limits.
    """
    keywords = given(
        to=to,
        start=start,
        duration=duration,
        robust=robust,
        max_rate=max_rate,
        max_acceleration=max_acceleration,
        max_jerk=max_jerk,
        max_torque=max_torque,
        max_moment=max_moment,
    )
    return Plan(**_stillbeam.plan(scene, keywords, progress), robust=robust, arm=scene)
