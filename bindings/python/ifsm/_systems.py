"""Iterated function systems: some affine maps of the plane or of space."""
import os
import pathlib
from typing import NamedTuple

import numpy as np

from . import _arrays, _given, _native
from ._answers import Dimension
from ._errors import Status, invalid_value, naming
from ._filters import _PROOFS, TOPOLOGIES
from ._models import Model, as_bytes
from ._objects import Saved, native_of
from ._pictures import Pictured

FORMATS = {"json": _native.IFSM_FORMAT_JSON, "cbor": _native.IFSM_FORMAT_CBOR, "fractint": _native.IFSM_FORMAT_FRACTINT}
_SUFFIXES = {".json": "json", ".ifs": "fractint"}


class Ball(NamedTuple):
    """A ball that holds the attractor."""

    centre: np.ndarray
    radius: float


class System(Saved, Pictured):
    """An iterated function system: affine maps x → M x + t, and how likely each is.

    Its *attractor* is the one compact set that is the union of its images under the maps. A *word* is a list of maps, the
    outermost first. Immutable; share it between threads. Two are equal when they say the same bit for bit; then they have
    the same hash. Pickles travel as CBOR. ``ifsm.systems`` has known ones.

    Parameters
    ----------
    maps : array of shape (maps, d, d + 1), or (maps, 6), (maps, 12)
        Of each map the rows of (M | t), in the plane or in space; 1 … 256 maps. Flat, a map of the plane is a b e c d f.
    weights : array, optional
        One a map, not negative; divided by their sum. By default |det M|, but at least a 25th of the maps' mean.

    Examples
    --------
    >>> gasket = ifsm.System([[[.5, 0, 0], [0, .5, 0]], [[.5, 0, .5], [0, .5, 0]], [[.5, 0, 0], [0, .5, .5]]])
    >>> gasket
    <ifsm.System of 3 maps in 2-D, contractive>
    >>> gasket.box().round(6) + 0.0
    array([[0., 0.],
           [1., 1.]])
    >>> round(gasket.similarity_dimension(), 6)
    1.584963
    >>> gasket.render(256, colour="symbol").shape
    (256, 256, 4)
    """

    __slots__ = ("_info", "_hash")

    def __init__(self, maps, weights=None):
        function = "ifsm.System"
        dimension, rows = _given.rows_of_maps(maps, function)
        shares = _given.vector(weights, len(rows), function, "weights", optional=True)
        with naming(probabilities="weights", count="maps"):
            self._take(_native.ifsm_system_create(dimension, rows, shares))

    def _take(self, native):
        self._native = native
        self._info = _native.ifsm_system_describe(native)
        self._hash = None

    @classmethod
    def from_parameters(cls, parameters=None, *, angles=None, scales=None, shears=None, shifts=None, weights=None):
        """A system from what its maps do: shear, then scale, then turn, then move. Angles are in radians.

        Give either all numbers in one array, or each kind by its name.

        Parameters
        ----------
        parameters : array of shape (maps, 6) or (maps, 12)
            In the plane angle, scale x, scale y, shear, shift x, shift y; in space axis times angle, scales, shears xy, xz,
            yz, shifts. What `System.parameters` tells.
        angles : array of shape (maps,), in space (maps, 3)
            0 by default; in space axes times angles.
        scales : array of shape (maps, d), or (maps,) for the same along all axes, or a number for all maps
            1 by default.
        shears : array of shape (maps,), in space (maps, 3)
            0 by default.
        shifts : array of shape (maps, d)
        weights : array, optional
            As in `System`.

        Examples
        --------
        >>> ifsm.System.from_parameters(angles=[np.pi / 4, 3 * np.pi / 4], scales=0.5 ** 0.5, shifts=[[0, 0], [1, 0]]) \\
        ...     .similarity_dimension()
        2.0
        """
        function = "ifsm.System.from_parameters"
        named = {"angles": angles, "scales": scales, "shears": shears, "shifts": shifts}
        given = [name for name, value in named.items() if value is not None]
        if (parameters is None) == (not given):
            raise invalid_value(function, "parameters", "Give parameters in one array, or by their names: one of the two.")
        rows = (_given.rows_of_parameters(named, function) if parameters is None else
                _arrays.table(parameters, function, "parameters"))
        dimension = _given.dimension_of(rows, function, "parameters", "(maps, 6) or (maps, 12)")
        shares = _given.vector(weights, len(rows), function, "weights", optional=True)
        with naming(probabilities="weights", count="parameters"):
            return cls._of(_native.ifsm_system_from_parameters(dimension, rows, shares))

    @classmethod
    def named(cls, name):
        """A known system: one of ``ifsm.systems.names()``; ``-`` is the same as ``_``."""
        return cls._of(_native.ifsm_system_named(name))

    @classmethod
    def from_model(cls, model):
        """The system that a model without its details is: its attractor is that model's limit.

        Of models in the plane with 3 control points, or in space with 4.
        """
        return cls._of(_native.ifsm_system_from_model(native_of(model, Model, "ifsm.System.from_model", "model")))

    # ---- what it is -------------------------------------------------------------------------------------------

    @property
    def dimension(self):
        """2 or 3."""
        return self._info.dimension

    @property
    def maps(self):
        """Rows of (M | t) of each map: a new array of shape (maps, d, d + 1)."""
        return self._part(_native.ifsm_system_maps, (self.dimension, self.dimension + 1))

    @property
    def probabilities(self):
        """How likely each map is, of sum 1: a new array."""
        return self._part(_native.ifsm_system_probabilities, ())

    @property
    def parameters(self):
        """What the maps do, as `from_parameters` takes it: a new array of shape (maps, 6) or (maps, 12).

        Scales are not negative, but for the last, which has det's sign; angles above -π, up to π.
        """
        return self._part(_native.ifsm_system_parameters, (_given.NUMBERS[self.dimension],))

    @property
    def fixed_points(self):
        """Each map's fixed point: a new array of shape (maps, d); not finite where a map has none or many."""
        return self._part(_native.ifsm_system_fixed_points, (self.dimension,))

    def _part(self, call, shape):
        values = np.empty((self._info.maps, *shape))
        call(self._held(), values)
        return values

    @property
    def contractive(self):
        """Whether all words of maps contract in the long run: True or False when proven, else None.

        The maps of probability 0 take no part. Whatever asks for the attractor refuses systems that are not."""
        return _PROOFS[self._info.contractive]

    @property
    def witness(self):
        """A word that does not contract, where `contractive` is False: an array of int32; else None."""
        return _arrays.fetched(_native.ifsm_system_witness, self._held(), dtype=np.int32) if self._is_refuted else None

    @property
    def radius(self):
        """The spectral radius of the `witness`, at least 1; or None."""
        return self._info.radius if self._is_refuted else None

    @property
    def _is_refuted(self):
        return self.contractive is False

    # ---- words and addresses ----------------------------------------------------------------------------------

    def word(self, symbols):
        """The map that a word is, numbers of maps, the outermost first: rows (M | t), an array of shape (d, d + 1)."""
        d, read = self.dimension, _symbols(symbols, "ifsm.System.word")
        return _arrays.fetched(_native.ifsm_system_word, self._held(), read, columns=d + 1)

    def point(self, symbols, *, period=None):
        """The point of an address: an array of d numbers.

        Parameters
        ----------
        symbols : list of int
            Numbers of maps that are not of probability 0.
        period : int, optional
            How many of them, the last ones, are repeated for ever; by default all.

        Examples
        --------
        >>> ifsm.System.named("gasket_right").point([1, 0], period=1)
        array([0.5, 0. ])
        """
        read = _symbols(symbols, "ifsm.System.point")
        if len(read) == 0:
            raise invalid_value("ifsm.System.point", "symbols", "symbols is empty; give one at least.", Status.SHAPE)
        with naming(symbol_count="symbols"):
            return _arrays.fetched(_native.ifsm_system_point, self._held(), read, len(read) if period is None else period)

    def addresses(self, point, length, *, tolerance=0.0):
        """The words in whose pieces of the attractor a point lies: an array of int32, of shape (words, length).

        All that are within `tolerance` of it, none that is farther than twice that: several where pieces touch or overlap;
        none beside the attractor.

        Parameters
        ----------
        point : array of d numbers
        length : int
            1 … 1024.
        tolerance : float
            0: 1e-9 of the attractor's size.
        """
        place = _given.vector(point, self.dimension, "ifsm.System.addresses", "point")
        found = _arrays.fetched(_native.ifsm_system_addresses, self._held(), place, length, tolerance, dtype=np.int32)
        return found.reshape(-1, length)

    # ---- questions --------------------------------------------------------------------------------------------

    def box(self, tolerance=None):
        """The attractor's bounding box: lowest and highest coordinates, an array of shape (2, d).

        It holds the attractor, rounding included, and is too large by at most `tolerance`, 1e-9 of its size by default.
        """
        return _arrays.fetched(_native.ifsm_system_box, self._held(), _or_zero(tolerance), columns=self.dimension)

    def ball(self, tolerance=None):
        """A ball that holds the attractor, nearly the smallest: a `Ball`. As `box`."""
        told = _arrays.fetched(_native.ifsm_system_ball, self._held(), _or_zero(tolerance))
        return Ball(told[:-1], float(told[-1]))

    def diameter(self, tolerance=None):
        """The distance of the two points of the attractor that are farthest from each other. As `box`."""
        return _native.ifsm_system_diameter(self._held(), _or_zero(tolerance))

    def moments(self, degree, *, about=None):
        """Moments of the measure, exact to rounding: the mean of (x - about)^a, by the powers a.

        Parameters
        ----------
        degree : int
            The highest, 1 … 8.
        about : array of d numbers, optional
            The origin by default.

        Returns
        -------
        dict of (i, j), in space (i, j, k), to the mean of x^i y^j z^k, by growing degree

        Examples
        --------
        >>> moments = ifsm.System.named("gasket_right").moments(2)
        >>> round(moments[1, 0], 12), round(moments[2, 0], 12), round(5 / 27, 12)
        (0.333333333333, 0.185185185185, 0.185185185185)
        """
        place = _given.vector(about, self.dimension, "ifsm.System.moments", "about", optional=True)
        values = _arrays.fetched(_native.ifsm_system_moments, self._held(), degree, place)
        return dict(zip(_given.powers(self.dimension, degree), values.tolist()))

    def similarity_dimension(self):
        """s of Moran's equation, the sum of r^s = 1 over the maps' ratios r.

        The Hausdorff dimension where pieces overlap little, else above it. Raises InvalidValue for a map that is no
        similarity.
        """
        return _native.ifsm_system_similarity_dimension(self._held())

    def box_dimension(self, finest=None):
        """The box-counting dimension, estimated on grids of 2, 4, … 2^finest boxes a side: a `Dimension`.

        Some hundredths off; a tenth for shapes that fill the plane and have a rough edge. `finest` is 6 … 13, in space
        6 … 9; 10 and 7 by default.
        """
        asked = (self._held(), 0 if finest is None else finest)
        rows = np.empty((_native.ifsm_system_box_dimension(*asked, None)[1] // 2, 2))
        report, _ = _native.ifsm_system_box_dimension(*asked, rows)
        return Dimension(report.dimension, report.standard_error, report.r_squared, rows[:, 0], rows[:, 1])

    def model(self, *, levels, topology="square", polygon=None):
        """A model without details whose limit is the attractor of the maps of probability above 0, 2 … 8 in number.

        Parameters
        ----------
        levels : int
            As in `Model.from_polygon`.
        topology : {"square", "joined"}
            Joined, the pieces must be one chain, each beginning where the one before ends.
        polygon : array of shape (d + 1, d), optional
            Its control points, not on one line; chosen by default.
        """
        function = "ifsm.System.model"
        kind = _arrays.choice(topology, TOPOLOGIES, function, "topology")
        points = None if polygon is None else (_arrays.table(polygon, function, "polygon", self.dimension), False)
        return Model._of(_native.ifsm_model_from_system(self._held(), kind, points, levels))

    # ---- files, copies, comparison ----------------------------------------------------------------------------

    def to_bytes(self, format="cbor", *, name=None):
        """The system as a file's bytes: ``"cbor"``, ``"json"``, or ``"fractint"``, where `name` is what it is called.

        Doubles come back bit for bit.
        """
        kind = _arrays.choice(format, FORMATS, "ifsm.System.to_bytes", "format")
        data = bytearray(_native.ifsm_system_save(self._held(), kind, name, None))
        _native.ifsm_system_save(self._held(), kind, name, data)
        return bytes(data)

    @classmethod
    def from_bytes(cls, data, *, name=None):
        """A system from a file's bytes: CBOR, JSON, Fractint's text, or flam3's XML where that is affine.

        `name` says which of a file of several; `file_names` lists them. A model's bytes give what `from_model` makes of it.
        """
        if name is None and b"ifsm-model" in bytes(as_bytes(data, "ifsm.System.from_bytes", "data")):
            return cls.from_model(Model.from_bytes(data))
        with naming(bytes="data"):
            return cls._of(_native.ifsm_system_load(as_bytes(data, "ifsm.System.from_bytes", "data"), name))

    def save(self, path, *, format=None):
        """Write it to a file: JSON when its name ends in ``.json``, Fractint's text for ``.ifs``, else CBOR.

        Flames are read alone, and ``.ifsm`` is a model's ending: both are refused, unless `format` says what to write.
        """
        file = pathlib.Path(os.fsdecode(path))
        if format is None and file.suffix in (".flame", ".ifsm"):
            raise invalid_value("ifsm.System.save", "path", f"path ends in {file.suffix}, which no system is written as; end it "
                                "in .json, .cbor or .ifs, or save the model that System.model makes.")
        data = self.to_bytes(_SUFFIXES.get(file.suffix, "cbor") if format is None else format, name=file.stem)
        file.write_bytes(data)

    @classmethod
    def load(cls, file, name=None):
        """Read what ``save``, Fractint or flam3 has written: a path, or a file open for reading bytes. See `from_bytes`."""
        return _given.of_file(file, lambda data: cls.from_bytes(data, name=name), "ifsm.System.load")

    @staticmethod
    def file_names(file):
        """The names of the systems in a file, which is given as to `load`; JSON and CBOR have none: ``[""]``."""
        def names(data):
            with naming(bytes="file"):
                return _arrays.fetched(_native.ifsm_system_file_names, data, dtype=np.uint8).tobytes().decode().split("\n")[:-1]

        return _given.of_file(file, names, "ifsm.System.file_names")

    # ---- how it shows itself ----------------------------------------------------------------------------------

    def __repr__(self):
        if self._native is None:
            return "<ifsm.System, closed>"
        count = self._info.maps
        proof = {True: "contractive", False: "not contractive", None: "perhaps contractive"}[self.contractive]
        return f"<ifsm.System of {count} map{'s' * (count != 1)} in {self.dimension}-D, {proof}>"

    def _repr_png_(self):
        from ._show import png_of_system

        return None if self._native is None else png_of_system(self)


def _symbols(given, function):
    return _arrays.integers(given, function, "symbols", np.int32)


def _or_zero(tolerance):
    return 0.0 if tolerance is None else tolerance
