"""The method that ``auto`` takes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Dict, Optional

from . import _stillbeam
from ._common import Progress, given

if TYPE_CHECKING:
    from ._stillbeam import Scene


@dataclass(frozen=True)
class Choice:
    """The cheapest method that is good enough for a scene's moves, and the errors to expect."""

    #: "rigid", "modal" or "elastica".
    method: str
    #: Modes of modal and elastica.
    modes: Optional[int]
    #: "fast" or "fine", of elastica.
    quality: Optional[str]
    #: The method in words.
    name: str
    #: Largest error of the tip to expect, fraction of the length.
    tip_error: float
    #: Largest error of the torque to expect, fraction of its peak.
    torque_error: float
    #: True if both errors are within the tolerances; else no method keeps them and this one comes
    #: nearest.
    within_tolerance: bool
    #: The reason, in a sentence.
    why: str

    @property
    def keywords(self) -> "Dict[str, Any]":
        """Keywords for ``run``, ``Generator`` and ``export``: ``run(scene, **choice.keywords)``."""
        return given(method=self.method, modes=self.modes, quality=self.quality)


def auto(
    scene: "Scene",
    *,
    tolerance: Optional[float] = None,
    torque_tolerance: Optional[float] = None,
    tick: Optional[float] = None,
    progress: Progress = None,
) -> Choice:
    """Choose the cheapest method for a scene's moves.

    tolerance: error of the tip that is allowed, fraction of the length; 0.001 by default.
    torque_tolerance: error of the torque that is allowed, fraction of its peak; 0.01 by default.
    tick: control period, s; by default the scene's.
    """
    keywords = given(tolerance=tolerance, torque_tolerance=torque_tolerance, tick=tick)
    return Choice(**_stillbeam.choose(scene, keywords, progress))
