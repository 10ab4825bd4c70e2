"""The generator of the microcontroller, stepped by hand."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple, Optional

from . import _stillbeam
from .run import Run, of_rows

if TYPE_CHECKING:
    from ._stillbeam import Scene


class Setpoint(NamedTuple):
    """What the motor controller is given in one tick.

    On a linear axis m stands for rad, N for N m.
    """

    #: Time, s.
    time: float
    #: Hub angle, rad.
    hub_angle: float
    #: Hub rate, rad/s.
    hub_rate: float
    #: Hub acceleration, rad/s²; where it jumps the right-hand value.
    hub_acceleration: float
    #: The tip in the global frame, X, m.
    tip_x: float
    #: The tip in the global frame, Y, m.
    tip_y: float
    #: Deflection of the tip, m.
    deflection: float
    #: Torque into the hub, N m.
    torque: float


class Generator:
    """A queue of moves and the arm that follows them, to the bit as on the microcontroller.

    It begins at rest at `angle` rad, by default the scene's first; call k of ``tick`` (from 0)
    returns the setpoint at k times the control period. The scene says the arm, the limits of rate,
    acceleration and jerk, and the solver; its own moves are not queued. Other keywords are those of
    ``run``.

    acceleration: greatest acceleration of the hub, rad/s², for which elastica is set up; by default
    that of the scene's moves, else its limit.
    """

    def __init__(
        self,
        scene: "Scene",
        *,
        angle: Optional[float] = None,
        acceleration: Optional[float] = None,
        **solver: Any,
    ) -> None:
        self.scene = scene
        self._native = _stillbeam.Generator(scene, angle, acceleration, solver)

    def push(self, **move: Any) -> float:
        """Put a move behind the others; with none waiting it begins at the next tick.

        The keywords are those of a scene's move, in its unit:
        ``push(profile="quintic", duration=0.6, to=1.57)``. "still" plans one that arrives still. Returns its duration, s, in whole ticks. Raises
        ValueError if it is refused, and nothing has changed then.
        """
        return self._native.push(move)

    def retarget(self, angle: float, duration: float, rate: float = 0.0) -> float:
        """Go elsewhere from where the hub is, in place of all that waits: to `angle` rad in
        `duration` s, to turn on there at `rate` rad/s. Returns the duration in whole ticks, s."""
        return self._native.retarget(angle, duration, rate)

    def tick(self) -> Setpoint:
        """Make a tick and return its setpoint."""
        return Setpoint(*self._native.tick())

    def ticks(self, count: int) -> Run:
        """Make `count` ticks and return their setpoints as arrays."""
        return of_rows(self._native.ticks(count), "by hand", [], self.scene)

    @property
    def period(self) -> float:
        """Control period, s."""
        return self._native.period

    @property
    def time(self) -> float:
        """Time of the next setpoint, s."""
        return self._native.time

    @property
    def is_holding(self) -> bool:
        """True if no move is under way or waiting."""
        return self._native.is_holding

    @property
    def is_asleep(self) -> bool:
        """True if hub and arm rest."""
        return self._native.is_asleep
