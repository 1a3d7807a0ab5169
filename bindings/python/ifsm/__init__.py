"""Fractal detail models of measured curves: fit, sketch, deform, animate. Iterated function systems and their pictures.

>>> points = np.column_stack([np.arange(257), np.cumsum(np.sin(np.arange(257) ** 2))])
>>> model = ifsm.fit(points, budget=64)              # ordered samples in, a model out
>>> sketch = model.points(details=40)                # the nearest sketch of 40 details
>>> bent = model.deformer().move(0, 2, [0, 50])      # bend it by a control point; texture follows
>>> bent.samples().shape
(257, 2)

>>> fern = ifsm.systems.fern()                       # an iterated function system; ifsm.System makes others
>>> fern.render((300, 500), palette="fern").shape    # its attractor, in colours
(500, 300, 4)

Arrays are NumPy's, of shape (points, dimension). Whatever is refused raises a subclass of `ifsm.Error` that names the
argument, the index and the value. Models and filters are immutable and may be shared between threads; long calls run
without the interpreter's lock, and Ctrl-C cancels them.
"""
import atexit

from . import _native, systems
from ._answers import Crossings, Dimension, Distances, Nearest, Spectrum
from ._curves import curves
from ._deformers import Deformer
from ._errors import (
    Busy,
    Cancelled,
    Closed,
    Error,
    InternalError,
    InvalidType,
    InvalidValue,
    NumericalError,
    OutOfMemory,
    Status,
)
from ._filters import Filter
from ._fits import Budget, Fit, FitReport, Known, TrainReport, fit, fit_curve, fit_filter, fit_sparse, train
from ._models import Model
from ._pictures import PictureReport, tone_map
from ._systems import Ball, System

__version__ = _native.ifsm_version_text()

__all__ = [
    "Ball", "Budget", "Busy", "Cancelled", "Closed", "Crossings", "Deformer", "Dimension", "Distances", "Error", "Filter",
    "Fit", "FitReport", "InternalError", "InvalidType", "InvalidValue", "Known", "Model", "Nearest", "NumericalError",
    "OutOfMemory", "PictureReport", "Spectrum", "Status", "System", "TrainReport", "curves", "fit", "fit_curve",
    "fit_filter", "fit_sparse", "load", "log_to", "set_threads", "systems", "threads", "tone_map", "train",
]


def load(path):
    """Read a model from a file that ``Model.save``, or the program ``ifsm``, has written."""
    return Model.load(path)


def threads():
    """How many threads calls may use; 0 is one a core."""
    return _native.ifsm_threads()


def set_threads(count):
    """How many threads calls may use that start later; 0 is one a core. Never changes results."""
    _native.ifsm_set_threads(count)


def log_to(logger="ifsm"):
    """Send the library's lines of diagnosis to a logger (`logging`), given or named; None turns them off, the default."""
    if logger is None:
        _native.ifsm_set_log(None)
        return
    import logging

    target = logging.getLogger(logger) if isinstance(logger, str) else logger
    _native.ifsm_set_log(lambda level, text: target.log(logging.WARNING if level else logging.INFO, "%s", text))


def __getattr__(name):
    """``ifsm.plot`` and ``ifsm.batch`` are imported when they are first used: they bring matplotlib and Dask."""
    if name in ("plot", "batch"):
        import importlib

        return importlib.import_module(f"{__name__}.{name}")
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__():
    return sorted([*globals(), "plot", "batch"])


atexit.register(_native.close_door)

for _name in __all__:
    if _name != "systems":
        globals()[_name].__module__ = __name__  # where people find them
del _name
