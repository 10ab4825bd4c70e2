"""Feed-forward setpoints for flexible robot links.

A scene is an arm with its moves. ``run`` gives the setpoints that a microcontroller would send
along them, ``reference`` what the arm really does, ``plan`` a move that arrives still::

    import stillbeam as sb

    scene = sb.Scene(
        link={"length": 0.5, "material": "aluminium", "width": 0.02, "thickness": 0.002},
        payload={"mass": 0.05},
        move={"profile": "cubic", "duration": 0.8, "to": 1.57, "settle": 0.5},
    )
    run = sb.run(scene)
    print(run.method, abs(run.torque).max(), run.residual)

Everything is in SI units: m, kg, s, rad, N. What is out of range raises a ValueError that names the
field, its value, what it must be and what would do. Numbers are those of the command line
``stillbeam-sim`` and of the firmware, to the bit.
"""

from ._stillbeam import Prepared, Scene, __version__
from ._stillbeam import scenes as _scenes
from .choose import Choice, auto
from .drive import DriveReport, Trial, drive
from .export import export
from .generator import Generator, Setpoint
from .hub import Box, DrivenHub
from .identify import Identified, Mode, Panel, identify
from .plan import Plan, plan
from .run import Comparison, Run, reference, run


def scenes() -> "dict[str, str]":
    """Return the scenes that come with the package: their names, each with a few words."""
    return dict(_scenes())


__all__ = [
    "Box",
    "Choice",
    "Comparison",
    "DriveReport",
    "DrivenHub",
    "Generator",
    "Identified",
    "Mode",
    "Panel",
    "Plan",
    "Prepared",
    "Run",
    "Scene",
    "Setpoint",
    "Trial",
    "__version__",
    "auto",
    "drive",
    "export",
    "identify",
    "plan",
    "reference",
    "run",
    "scenes",
]
