"""From a measured log to an arm."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Dict, Mapping, Optional, Sequence, Tuple, Union, cast

from . import _stillbeam
from ._common import Array, axes, given, optional

if TYPE_CHECKING:
    from ._stillbeam import Scene

#: A CSV by its path, or columns of numbers by name; a pandas.DataFrame is one too.
Log = Union[str, "os.PathLike[str]", Mapping[str, Any]]


@dataclass(frozen=True)
class Mode:
    """A natural mode."""

    #: Natural frequency without damping, Hz.
    frequency_hz: float
    #: Its 95 % interval, Hz.
    frequency_interval_hz: Tuple[float, float]
    #: Damping ratio.
    damping_ratio: float
    #: Its 95 % interval.
    damping_interval: Tuple[float, float]


@dataclass(frozen=True, eq=False)
class Panel:
    """A log and its fit."""

    #: The log's name.
    log: str
    #: Time from the first row, s.
    time: Array
    #: What the sensor shows, in its SI unit.
    measured: Array
    #: The model.
    fitted: Array


@dataclass(frozen=True, eq=False)
class Identified:
    """What logs tell of an arm."""

    #: "ring-down" or "forced".
    case: str
    #: The modes, the first one first.
    modes: Tuple[Mode, ...]
    #: Fit of what was fitted, %: 100 (1 − ‖y − ŷ‖/‖y − ȳ‖).
    fit_percent: float
    #: The same of what was held out, %.
    validation_percent: float
    #: What a person should know before trusting it.
    warnings: Tuple[str, ...]
    #: The scene with the fitted values; None without a scene.
    scene: "Optional[Scene]"
    #: The logs and their fits.
    panels: Tuple[Panel, ...]
    #: All figures, by the names of the command line's ``identify --json``.
    report: Dict[str, Any] = field(repr=False)

    def to_dataframe(self) -> Any:
        """Return a pandas.DataFrame with a row for each mode."""
        return optional("pandas", "to_dataframe").DataFrame(
            {
                "frequency_hz": [mode.frequency_hz for mode in self.modes],
                "frequency_low_hz": [mode.frequency_interval_hz[0] for mode in self.modes],
                "frequency_high_hz": [mode.frequency_interval_hz[1] for mode in self.modes],
                "damping_ratio": [mode.damping_ratio for mode in self.modes],
                "damping_low": [mode.damping_interval[0] for mode in self.modes],
                "damping_high": [mode.damping_interval[1] for mode in self.modes],
            }
        )

    def plot(self, ax: Any = None) -> Any:
        """Draw the first log, its fit and their difference with matplotlib; return the two axes."""
        made = axes(ax, 2, figsize=(7, 5))
        panel = self.panels[0]
        made[0].plot(panel.time, panel.measured, label="measured")
        made[0].plot(panel.time, panel.fitted, label="fitted", linewidth=1)
        made[0].set_ylabel(f"{self.report['sensor']}, {self.report['unit']}")
        made[0].set_title(panel.log)
        made[0].legend()
        made[1].plot(panel.time, panel.measured - panel.fitted, color="grey")
        made[1].set_ylabel("difference")
        made[1].set_xlabel("time, s")
        for part in made:
            part.grid(True, alpha=0.3)
        return made


def identify(
    logs: "Union[Log, Sequence[Log]]",
    *,
    scene: "Optional[Scene]" = None,
    time: Optional[str] = None,
    hub: Optional[str] = None,
    sensor: Optional[str] = None,
    kind: Optional[str] = None,
    sign: Optional[str] = None,
    start: Optional[float] = None,
    end: Optional[float] = None,
    modes: Optional[int] = None,
    sensor_lowpass: Optional[Tuple[float, float]] = None,
    sensor_at: Optional[float] = None,
    sensor_mass: Optional[float] = None,
    free: Sequence[str] = (),
) -> Identified:
    """Find frequencies and damping in measured logs, and fit a scene to them.

    logs: one or several, of which the last is held out for validation. Names of columns end in
    their unit (``t_s``, ``hub_angle_rad``, ``tip_acceleration_g``, ``tip_deflection_mm``, …).
    scene: the arm as documented. time, hub, sensor: columns by name, if they have unusual ones.
    kind: "deflection", "angle", "strain", "acceleration" or "torque". sign: "-" if the sensor
    counts against the hub's angle. start, end: the part that is used, s from the first row.
    modes: 1 to 3. sensor_lowpass: corner in Hz and damping ratio. sensor_at, sensor_mass: a sensor
    that is not in the scene, m from the clamp, and kg. free: what is fitted, of "stiffness",
    "payload" and "clamp".
    """
    if isinstance(logs, (str, os.PathLike)) or hasattr(logs, "keys"):
        several = [cast(Log, logs)]
    else:
        several = list(logs)
    keywords = given(
        time=time,
        hub=hub,
        sensor=sensor,
        kind=kind,
        sign=sign,
        start=start,
        end=end,
        modes=modes,
        sensor_lowpass=sensor_lowpass,
        sensor_at=sensor_at,
        sensor_mass=sensor_mass,
        free=list(free) or None,
    )
    found = _stillbeam.identify(several, scene, keywords)
    report = found["report"]
    return Identified(
        case=report["case"],
        modes=tuple(
            Mode(
                mode["frequency_hz"],
                tuple(mode["frequency_interval_hz"]),
                mode["damping_ratio"],
                tuple(mode["damping_interval"]),
            )
            for mode in report["modes"]
        ),
        fit_percent=report["fit_percent"],
        validation_percent=report["validation_percent"],
        warnings=tuple(report["warnings"]),
        scene=found["scene"],
        panels=tuple(Panel(**panel) for panel in found["panels"]),
        report=report,
    )
