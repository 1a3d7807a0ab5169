from collections.abc import Callable, Iterable, Mapping
from typing import Any, NamedTuple, Protocol

from . import Filter, Model, _Distance, _Float, _Geometry, _Int, _JoinedName, _Points

__all__ = ["Failure", "Fits", "fit"]

class _Client(Protocol):
    """A ``distributed.Client``, which need not be installed."""

    @property
    def asynchronous(self) -> bool: ...
    def nthreads(self, workers: Any = ...) -> Any: ...

class Failure(NamedTuple):
    curve: Any
    error: Exception

class Fits(NamedTuple):
    models: dict[Any, Model]
    failures: list[Failure]

def fit(
    curves: Iterable[_Points | tuple[_Points, bool]] | Mapping[Any, _Points | tuple[_Points, bool]] | _Geometry,
    client: _Client,
    *,
    closed: bool | None = None,
    progress: bool | Callable[[int, int | None], object] | None = False,
    control_points: _Int | None = None,
    maps: _Int | None = None,
    filter: _JoinedName | Filter | None = None,
    budget: _Int | None = None,
    within: _Float | None = None,
    distance: _Distance = "rms",
    iterations: _Int = 0,
) -> Fits: ...
