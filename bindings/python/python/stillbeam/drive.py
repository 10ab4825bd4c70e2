"""A drive in the loop."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Dict, Optional, Tuple, Union

from . import _stillbeam
from ._common import Array, Progress, axes, optional

if TYPE_CHECKING:
    from ._stillbeam import Scene

#: A machine: "odrive-tuned", "moteus-tuned", "cia402-tuned", "geared", the path of a machine file,
#: its text, or its tables as dicts.
Machine = Union[str, "os.PathLike[str]", Dict[str, Any]]


@dataclass(frozen=True, eq=False)
class Trial:
    """A run of drive and machine, four samples a tick."""

    #: What of the setpoints is sent, and what is not known.
    sent: str
    #: True if the moves arrive still.
    still: bool
    #: Largest difference of the hub from its command, later by the drive's lag, rad.
    hub_error: float
    #: Largest distance of the tip from where it is if the hub follows, fraction of the length.
    tip_error: float
    #: Residual vibration, fraction of the length.
    residual: float
    #: Residual of the same arm whose hub follows exactly, fraction of the length.
    residual_if_exact: float
    #: Largest distance of the tip from its target after arrival, fraction of the length.
    off_after_arrival: float
    #: Largest torque of the motor, N m.
    peak_torque: float
    #: Fraction of the time in which the motor could not give what was asked for.
    saturated: float
    #: Time by which the drive follows later, by design, s.
    lag: float
    #: Time between two samples, s.
    sample_interval: float
    #: Time, s.
    time: Array
    #: Hub angle, rad.
    hub_angle: Array
    #: Hub rate, rad/s.
    hub_rate: Array
    #: The tip in the global frame, X, m.
    tip_x: Array
    #: The tip in the global frame, Y, m.
    tip_y: Array
    #: Deflection of the tip, m.
    deflection: Array
    #: Torque of the motor at its shaft, N m.
    motor_torque: Array


@dataclass(frozen=True, eq=False)
class DriveReport:
    """What the setpoints are worth: one machine with less and with more of them."""

    #: The trials, in the order of the command line's table.
    trials: Tuple[Trial, ...]
    #: Control period, s.
    tick: float
    #: Name of the drive.
    drive: str
    #: What feed-forward bought, in a line.
    conclusion: str
    #: Reason why there are no still moves, if so.
    no_still: Optional[str]
    #: Time of the commanded motion, s.
    command_time: Array = field(repr=False)
    #: Commanded hub angle, rad.
    command_angle: Array = field(repr=False)

    def to_dataframe(self) -> Any:
        """Return a pandas.DataFrame with a row for each trial."""
        names = (
            "sent",
            "hub_error",
            "tip_error",
            "residual",
            "residual_if_exact",
            "off_after_arrival",
            "peak_torque",
            "saturated",
        )
        rows = [{name: getattr(trial, name) for name in names} for trial in self.trials]
        return optional("pandas", "to_dataframe").DataFrame(rows, columns=list(names))

    def plot(self, ax: Any = None) -> Any:
        """Draw hub angle and deflection of the first three trials with matplotlib: position alone,
        with velocity, with torque too. Return the two axes."""
        made = axes(ax, 2, figsize=(7, 5))
        made[0].plot(self.command_time, self.command_angle, "k:", label="commanded")
        for trial in self.trials[:3]:
            made[0].plot(trial.time, trial.hub_angle, label=trial.sent)
            made[1].plot(trial.time, 1e3 * trial.deflection)
        made[0].set_ylabel("hub angle, rad")
        made[0].legend()
        made[1].set_ylabel("deflection, mm")
        made[1].set_xlabel("time, s")
        for panel in made:
            panel.grid(True, alpha=0.3)
        return made


def drive(
    scene: "Scene",
    machine: Optional[Machine] = None,
    *,
    drive: Optional[str] = None,
    between: Optional[str] = None,
    progress: Progress = None,
) -> DriveReport:
    """Let a drive and its machine follow a scene, with less and with more feed-forward.

    machine: motor, gear, friction, encoder and gains; by default a direct drive with a little
    friction on an ODrive with its own gains. drive: another drive with its own gains, "odrive",
    "moteus" or "cia402". between: way between setpoints, "hold", "extrapolate", "linear" or
    "hermite"; by default the drive's own.
    """
    found = _stillbeam.drive(scene, machine, drive, between, progress)
    found["trials"] = tuple(Trial(**trial) for trial in found["trials"])
    return DriveReport(**found)
