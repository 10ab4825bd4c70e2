"""Runs of the core and of the reference solvers."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Dict, Optional, Tuple, Union

from . import _stillbeam
from ._common import Array, Progress, axes, given, optional

if TYPE_CHECKING:
    from ._stillbeam import Rows, Scene


@dataclass(frozen=True, eq=False)
class Comparison:
    """How far run `a` is from a more accurate run `b` of the same scene."""

    #: Number of times that both runs have.
    common: int
    #: Largest distance of the tips, fraction of the link's length.
    tip_max: float
    #: Root mean square distance of the tips, fraction of the length.
    tip_rms: float
    #: Time of the largest distance, s.
    tip_max_at: float
    #: Largest difference of the torque away from its jumps, fraction of b's peak.
    torque: float


@dataclass(frozen=True, eq=False)
class Run:
    """A run: one array a quantity, one entry a tick, from t = 0 on.

    On a linear axis the hub's arrays are in m, m/s and m/s², and `torque` is a force in N.
    """

    #: Time, s.
    time: Array
    #: Hub angle θ, rad, not wrapped.
    hub_angle: Array
    #: Hub rate, rad/s.
    hub_rate: Array
    #: Hub acceleration, rad/s²; where it jumps the right-hand value, at the end of a move the left.
    hub_acceleration: Array
    #: The tip in the global frame, X, m.
    tip_x: Array
    #: The tip in the global frame, Y, m.
    tip_y: Array
    #: Deflection of the tip, its Y in the hub's frame, m.
    deflection: Array
    #: Torque into the hub by inverse dynamics, N m.
    torque: Array
    #: The payload's centre in the global frame, X, m; None if it is the tip.
    payload_x: Optional[Array]
    #: The payload's centre in the global frame, Y, m; None if it is the tip.
    payload_y: Optional[Array]
    #: The method in words; with ``auto`` the one that it took.
    method: str
    #: What a person should know: rounded durations, tolerances that no method keeps.
    notes: Tuple[str, ...]
    #: The scene.
    scene: "Scene"
    _rows: "Rows" = field(repr=False)

    @property
    def residual(self) -> float:
        """Residual vibration, fraction of the length.

        It is the tip's largest deflection from its rest over a first period after the last arrival;
        NaN if the run does not show it.
        """
        found, _ = self._rows.residual(self.scene)
        return float("nan") if found is None else found

    def compare(self, reference: "Run") -> Comparison:
        """Return how far this run is from a more accurate one of the same scene."""
        return Comparison(**_stillbeam.compare(self._rows, reference._rows, self.scene))

    def to_dataframe(self) -> Any:
        """Return a pandas.DataFrame with the columns of the command line's CSV."""
        pandas = optional("pandas", "to_dataframe")
        values = [
            self.time,
            self.hub_angle,
            self.hub_rate,
            self.hub_acceleration,
            self.tip_x,
            self.tip_y,
            self.deflection,
            self.torque,
        ]
        columns = dict(zip(self._rows.names(), values))
        if self.payload_x is not None and self.payload_y is not None:
            columns.update(payload_x_m=self.payload_x, payload_y_m=self.payload_y)
        return pandas.DataFrame(columns)

    def to_csv(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Write the file that ``stillbeam-sim run --csv`` writes: nine digits, all of it or none."""
        self._rows.write(os.fspath(path))

    def plot(self, ax: Any = None, label: Optional[str] = None) -> Any:
        """Draw hub angle, deflection and torque over time with matplotlib; return the three axes.

        `ax` are three axes to draw into, e.g. those of another run.
        """
        made = axes(ax, 3, figsize=(7, 6))
        linear = self.scene.axis == "linear"
        labels = (
            "hub position, m" if linear else "hub angle, rad",
            "deflection, mm",
            "force, N" if linear else "torque, N m",
        )
        name = self.method if label is None else label
        for panel, text, values in zip(
            made, labels, (self.hub_angle, 1e3 * self.deflection, self.torque)
        ):
            panel.plot(self.time, values, label=name)
            panel.set_ylabel(text)
            panel.grid(True, alpha=0.3)
        made[-1].set_xlabel("time, s")
        made[0].legend()
        return made

    def __len__(self) -> int:
        return len(self._rows)

    def __repr__(self) -> str:
        return f"<Run of {self.scene.name}: {self.method}, {len(self)} rows>"


def of_rows(rows: "Rows", method: str, notes: "list[str]", scene: "Scene") -> Run:
    """Return the arrays of rows with their names."""
    columns: "Dict[str, Any]" = {"payload_x": None, "payload_y": None, **rows.columns()}
    return Run(**columns, method=method, notes=tuple(notes), scene=scene, _rows=rows)


def run(
    scene: "Scene",
    *,
    method: Optional[str] = None,
    elements: Optional[int] = None,
    mass: Optional[str] = None,
    modes: Optional[int] = None,
    quality: Optional[str] = None,
    tolerance: Optional[float] = None,
    torque_tolerance: Optional[float] = None,
    tick: Optional[float] = None,
    scalar: Optional[str] = None,
    spin: Optional[bool] = None,
    progress: Progress = None,
) -> Run:
    """Run the core on a scene: the setpoints that a firmware would send, a row every tick.

    method: "rigid", "newmark", "modal", "elastica", "pointwise" or "auto"; by default the scene's, else
        auto.
    elements: beam elements, 1, 2, 4 or 8 (newmark, modal). mass: "consistent" or "lumped".
    modes: 1 to 3 (modal, elastica, pointwise). quality: "fast" or "fine" (elastica).
    tolerance: error of the tip that auto may make, fraction of the length.
    torque_tolerance: error of the torque that auto may make, fraction of its peak.
    tick: control period, s. scalar: "f32", as on the target, or "f64".
    spin: centrifugal stiffening and softening.
    progress: called with a few words and the fraction that is done; without it, long work shows a
    bar on the terminal.

    Raises ValueError for a scene, a limit or a keyword that is refused.
    """
    keywords = given(
        method=method,
        elements=elements,
        mass=mass,
        modes=modes,
        quality=quality,
        tolerance=tolerance,
        torque_tolerance=torque_tolerance,
        tick=tick,
        scalar=scalar,
        spin=spin,
    )
    return of_rows(*_stillbeam.run(scene, keywords, progress), scene)


def reference(
    scene: "Scene",
    *,
    solver: str = "rod",
    every: Optional[float] = None,
    progress: Progress = None,
) -> Run:
    """Solve a scene with a reference solver, which shares no method with the core.

    solver: "rod", the inextensible rod with exact kinematics, or "fem", the paper's corotational
    elements in the global frame. every: interval of the rows, s; by default the scene's tick.
    """
    return of_rows(*_stillbeam.reference(scene, solver, every, progress), scene)
