"""What several modules share: types, the keywords of a solver, optional packages."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any, Callable, Dict, Optional

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]
else:
    Array = np.ndarray

#: Called with a few words and the fraction of the work that is done, 0 to 1.
Progress = Optional[Callable[[str, float], object]]


def given(**keywords: Any) -> "Dict[str, Any]":
    """Return the keywords that are not None."""
    return {key: value for key, value in keywords.items() if value is not None}


def optional(name: str, what: str) -> Any:
    """Import a package that only some calls need."""
    try:
        return importlib.import_module(name)
    except ImportError as error:
        package = name.partition(".")[0]
        raise ImportError(f"{what} needs {package}: pip install {package}") from error


def axes(ax: Any, rows: int = 1, **options: Any) -> Any:
    """Return the given axes of matplotlib, or those of a new figure, one below the other."""
    pyplot = optional("matplotlib.pyplot", "plot")
    if ax is not None:
        return ax
    figure, made = pyplot.subplots(rows, 1, sharex=True, layout="constrained", **options)
    return made
