"""Prepared arms for firmware."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Sequence

from . import _stillbeam

if TYPE_CHECKING:
    from ._stillbeam import Prepared, Scene


def export(
    scene: "Scene", *, payloads: Sequence[float] = (), still: bool = False, **solver: Any
) -> "Prepared":
    """Prepare the stepper of a scene as constants, which a firmware loads in place of its set-up.

    payloads: masses, kg, one arm each; by default the scene's own. still: with the planner of still
    moves. solver: the keywords of ``run``, e.g. ``method="elastica"``.
    """
    return _stillbeam.export(scene, [float(mass) for mass in payloads], still, solver)
