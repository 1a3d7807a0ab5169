"""What questions about curves are answered with."""
from typing import NamedTuple

import numpy as np


class Distances(NamedTuple):
    """How far one curve is from another, in the samples' units."""

    rms: float
    """Root mean square between samples of the same number."""
    largest: float
    """The largest between them."""
    farthest: int
    """The number of that sample."""
    hausdorff: float
    """Between the polylines through the finest places, edges and all, to a millionth."""


class Nearest(NamedTuple):
    """The points of a curve nearest to queries."""

    parameters: np.ndarray
    distances: np.ndarray
    points: np.ndarray
    """Of shape (queries, dimension)."""


class Crossings(NamedTuple):
    """Where a plane curve meets itself."""

    first: np.ndarray
    """Of shape (meetings, 2): row k has the two parameters at which the curve is at one point."""
    last: np.ndarray
    """The same numbers; but of a piece that is gone twice, those where it ends."""
    points: np.ndarray
    """Of shape (meetings, 2): the places of `first`."""


class Dimension(NamedTuple):
    """A fractal dimension, as counting tells it."""

    dimension: float
    standard_error: float
    r_squared: float
    scales: np.ndarray
    counts: np.ndarray


class Spectrum(NamedTuple):
    """How rough a curve is, level by level."""

    hurst: float
    standard_error: float
    r_squared: float
    dimension: float
    first: int
    """The levels that were fitted, from here"""
    last: int
    """to here."""
    scales: np.ndarray
    rms: np.ndarray


def crossings(rows):
    """Rows of the C library, in columns that have names."""
    return Crossings(rows[:, 0:2], rows[:, 2:4], rows[:, 4:6])
