"""Filters: the matrix R."""
import numpy as np

from . import _arrays, _native
from ._errors import Status, invalid_value
from ._objects import Immutable

TOPOLOGIES = {"joined": _native.IFSM_TOPOLOGY_JOINED, "square": _native.IFSM_TOPOLOGY_SQUARE}
SQUARE_NAMES = ("haar", "bspline", "four-point", "koch", "takagi")
_NAMES = {number: name for name, number in TOPOLOGIES.items()}
_PROOFS = {1: True, -1: False, 0: None}


class Filter(Immutable):
    """The matrix R, under which neighbours share their end points (``joined``) or places (``square``).

    Immutable; share it between threads. Equal filters have equal matrices, bit for bit.

    Parameters
    ----------
    name : str
        ``"coast"`` (joined, 5 points, 2 maps: trained on coastlines), ``"casteljau"`` (any shape: subdivides a Bézier
        polygon), ``"koch"``, ``"takagi"``, or, square alone, ``"haar"``, ``"bspline"``, ``"four-point"``.
    topology : {"joined", "square"}
    control_points, maps : int
        The shape n, N; 0 for the name's own.

    Raises
    ------
    InvalidValue
        For a name or a shape that there is not.

    Examples
    --------
    >>> ifsm.Filter("casteljau", control_points=3)
    <ifsm.Filter joined, 3 control points, 2 maps, condition 1.94>
    >>> ifsm.Filter("casteljau", control_points=3).matrix.shape
    (5, 5)
    """

    __slots__ = ("_info", "_matrix")

    def __init__(self, name, *, topology="joined", control_points=0, maps=0):
        kind = _arrays.choice(topology, TOPOLOGIES, "ifsm.Filter", "topology")
        self._take(_native.ifsm_filter_named(name, kind, control_points, maps))

    def _take(self, native):
        self._native = native
        self._info = _native.ifsm_filter_describe(native)
        self._matrix = None

    @classmethod
    def from_matrix(cls, matrix, *, control_points, maps, topology="joined", stride=0):
        """A filter from the whole of R, of shape (rows, rows).

        Raises InvalidValue for a column of T whose sum is not 1, joints that are not shared, or an R that cannot be
        inverted.
        """
        return cls._made(_native.ifsm_filter_from_matrix, matrix, control_points, maps, topology, stride, "from_matrix")

    @classmethod
    def from_maps(cls, matrix, *, control_points, maps, topology="joined", stride=0):
        """A filter from T alone, with the canonical complement: joined, of shape (n, (n - 1) N + 1); square, (n, n N)."""
        return cls._made(_native.ifsm_filter_from_maps, matrix, control_points, maps, topology, stride, "from_maps")

    @classmethod
    def _made(cls, call, matrix, control_points, maps, topology, stride, name):
        function = f"ifsm.Filter.{name}"
        kind = _arrays.choice(topology, TOPOLOGIES, function, "topology")
        entries = _arrays.doubles(matrix, function, "matrix")
        if isinstance(control_points, int) and isinstance(maps, int):
            columns = (control_points - 1) * maps + 1 if topology == "joined" else control_points * maps
            shape = (control_points if name == "from_maps" else columns, columns)
            if entries.shape != shape and 1 <= control_points <= 16 and 2 <= maps <= 8:
                raise invalid_value(function, "matrix", f"matrix has the shape {entries.shape}; {control_points} control "
                                    f"points and {maps} maps, {topology}, take {shape}.", Status.SHAPE)
        return cls._of(call(kind, control_points, maps, stride, entries))

    @property
    def topology(self):
        """``"joined"`` or ``"square"``."""
        return _NAMES[self._info.topology]

    @property
    def control_points(self):
        """n, the number of control points."""
        return self._info.control_points

    @property
    def maps(self):
        """N, the number of maps: children of a node."""
        return self._info.maps

    @property
    def stride(self):
        """Places between neighbouring leaf polygons."""
        return self._info.stride

    @property
    def details_per_node(self):
        """Detail vectors of a node."""
        return self._info.details_per_node

    @property
    def contractive(self):
        """Whether all words of T contract vectors of sum zero: True or False when proven, else None."""
        return _PROOFS[self._info.contractive]

    @property
    def condition(self):
        """The 2-norm condition number of R."""
        return self._info.condition

    @property
    def matrix(self):
        """R, an array of shape (rows, rows), read-only."""
        if self._matrix is None:
            matrix = np.empty((self._info.rows, self._info.rows))
            _native.ifsm_filter_matrix(self._held(), matrix)
            matrix.setflags(write=False)
            self._matrix = matrix
        return self._matrix

    def _key(self):
        info = self._info
        return info.topology, info.control_points, info.maps, info.stride, self.matrix.tobytes()

    def __eq__(self, other):
        return self._key() == other._key() if isinstance(other, Filter) else NotImplemented

    def __hash__(self):
        return hash(self._key())

    def __reduce__(self):
        return _filter_again, (self.topology, self.control_points, self.maps, self.stride, self.matrix.copy())

    def __repr__(self):
        if self._native is None:
            return "<ifsm.Filter, closed>"
        return (f"<ifsm.Filter {self.topology}, {self.control_points} control points, {self.maps} maps, "
                f"condition {self.condition:.3g}>")


def _filter_again(topology, control_points, maps, stride, matrix):
    return Filter.from_matrix(matrix, control_points=control_points, maps=maps, topology=topology, stride=stride)
