from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from . import Deformer, Model, System, _Array, _Int, _Integers

__all__ = ["before_after", "curve", "levels", "residuals", "scalogram", "system"]

def curve(
    model: Model | Deformer, *, ax: Axes | None = None, control_polygon: bool = True, levels: _Int | None = None,
    details: _Int | None = None, **line: Any
) -> Axes: ...
def levels(
    model: Model | Deformer,
    which: _Integers | None = None,
    *,
    ax: Axes | Sequence[Axes] | NDArray[np.object_] | None = None,
    overlay: bool = False,
) -> NDArray[np.object_]: ...
def scalogram(model: Model | Deformer, *, ax: Axes | None = None) -> Axes: ...
def residuals(model: Model | Deformer, sketch: Model | Deformer, *, ax: Axes | None = None) -> Axes: ...
def before_after(model: Model | Deformer, deformed: Model | Deformer, *, ax: Axes | None = None, control_polygon: bool = False) -> Axes: ...
def system(
    system: System, *, ax: Axes | None = None, size: _Integers = 1024, window: _Array | None = None, **picture: Any
) -> Axes: ...
