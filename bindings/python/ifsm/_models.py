"""Models: a control polygon, a filter, and a tree of details."""
import numbers
import os

import numpy as np

from . import _arrays, _curves, _native, _progress
from ._answers import Dimension, Distances, Nearest, Spectrum, crossings
from ._errors import Error, Status, invalid_type, invalid_value, naming, of_one, rename
from ._filters import SQUARE_NAMES, Filter
from ._objects import Saved, native_of

FRAMES = {"absolute": _native.IFSM_FRAME_ABSOLUTE, "node": _native.IFSM_FRAME_NODE}
FOLLOWED = {"polyline": _native.IFSM_CURVE_POLYLINE, "limit": _native.IFSM_CURVE_LIMIT}
DISTANCES = {"rms": _native.IFSM_DISTANCE_RMS, "largest": _native.IFSM_DISTANCE_LARGEST,
             "hausdorff": _native.IFSM_DISTANCE_HAUSDORFF}
RESOLVES = {"none": _native.IFSM_RESOLVE_NONE, "values": _native.IFSM_RESOLVE_VALUES,
            "choice": _native.IFSM_RESOLVE_CHOICE}
FORMATS = {"json": _native.IFSM_FORMAT_JSON, "cbor": _native.IFSM_FORMAT_CBOR}
_METHODS = {"boxes": _native.IFSM_DIMENSION_BOXES, "divider": _native.IFSM_DIMENSION_DIVIDER}


class Model(Saved):
    """A curve as a control polygon, a filter, and a tree of detail vectors.

    Immutable: every change is a new model. Share it between threads. Two are equal when they say the same bit for bit;
    then they have the same hash. Pickles travel as CBOR.

    Parameters
    ----------
    points : array of shape (samples, dimension), or anything with a ``__geo_interface__``
        Ordered samples, at least 2, of 1 to 4 dimensions, in any unit. A ring's last point may repeat the first.
    filter : Filter or str
        What takes them apart; the exact model results, no fit takes place. ``ifsm.fit`` finds a filter.
    closed : bool, optional
        Whether the samples are a ring; what the geometry says, or False.
    levels : int
        Depth of the tree; 0: the least with a place for every sample.

    Examples
    --------
    >>> t = np.linspace(0, 1, 65)
    >>> model = ifsm.Model(np.column_stack([t, np.sin(9 * t)]), filter="casteljau")
    >>> model
    <ifsm.Model of 65 samples in 2-D, open: 5 control points + 60 details on 4 levels>
    >>> float(abs(model.samples() - np.column_stack([t, np.sin(9 * t)])).max()) < 1e-14
    True
    >>> model(0.5).round(3)
    array([ 0.5  , -0.978])
    """

    __slots__ = ("_info", "_hash")

    def __init__(self, points, filter="coast", *, closed=None, levels=0):
        samples, ring = _curves.curve(points, closed, "ifsm.Model")
        chosen = _filter(filter, "ifsm.Model", "filter")
        self._take(_native.ifsm_model_create(chosen, (samples, ring), levels))

    def _take(self, native):
        self._native = native
        self._info = _native.ifsm_model_describe(native)
        self._hash = None

    @classmethod
    def from_polygon(cls, points, filter="casteljau", *, levels, closed=False):
        """A model without details: a control polygon of n points, and so many levels below it."""
        polygon = _arrays.table(points, "ifsm.Model.from_polygon", "points")
        chosen = _filter(filter, "ifsm.Model.from_polygon", "filter", len(polygon))
        return cls._of(_native.ifsm_model_from_polygon(chosen, (polygon, _arrays.is_true(closed, "ifsm.Model.from_polygon", "closed")),
                                                         levels))

    # ---- what it is -------------------------------------------------------------------------------------------

    @property
    def dimension(self):
        """Of its points: 1 … 4."""
        return self._info.dimension

    @property
    def closed(self):
        """Whether it is a ring."""
        return bool(self._info.closed)

    @property
    def levels(self):
        """L: details of levels 0 … L - 1, the curve at level L."""
        return self._info.levels

    @property
    def sample_count(self):
        """How many samples it was made from."""
        return self._info.samples

    @property
    def place_count(self):
        """Points of the finest level."""
        return self._info.places

    @property
    def detail_count(self):
        """Detail vectors in all."""
        return self._info.details

    @property
    def details_kept(self):
        """Detail vectors that are not zero."""
        return self._info.details_kept

    @property
    def diagonal(self):
        """Of the samples' bounding box."""
        return self._info.diagonal

    @property
    def filter(self):
        """Its `Filter`."""
        return Filter._of(_native.ifsm_model_filter(self._held()))

    @property
    def control_points(self):
        """The control polygon of the whole curve: a new array of shape (n, dimension)."""
        points = np.empty((self._info.control_points, self._info.dimension))
        _native.ifsm_model_control_points(self._held(), points)
        return points

    # ---- the curve --------------------------------------------------------------------------------------------

    def __call__(self, t, *, curve="polyline"):
        """The curve at parameters.

        Parameters
        ----------
        t : float or array
            0 … 1, from the first place to the last; of a closed curve any number, its fraction counts.
        curve : {"polyline", "limit"}
            The polyline through the finest places, or what it tends to below them, without further details.

        Returns
        -------
        array of the shape of `t`, and dimension last
        """
        return _at(_native.ifsm_model_evaluate, (self._held(), _arrays.choice(curve, FOLLOWED, "ifsm.Model", "curve")), t,
                   self.dimension, "ifsm.Model")

    def samples(self, *, out=None):
        """The curve at the samples: what it was made from, unless details were dropped or changed.

        Returns
        -------
        array of shape (samples, dimension): `out`, if given. A ring's first sample is not repeated, even where the points
        that it was made from repeated it.
        """
        points = _arrays.output(out, (self.sample_count, self.dimension), "ifsm.Model.samples")
        _native.ifsm_model_samples(self._held(), points)
        return points

    def points(self, *, levels=None, details=None, out=None):
        """Synthesis: the control polygons of a level, joined into one line.

        Parameters
        ----------
        levels : int, optional
            How far down, 0 (the control polygon) … ``model.levels`` (the finest places, the default).
        details : int, optional
            Of the nearest sketch with so many details, instead of the model itself: ``model.keep(details=…)``.
        out : array, optional
            Where to write them.

        Returns
        -------
        array of shape (points, dimension); of a joined ring the last point repeats the first
        """
        if details is not None:
            return self.keep(details=details).points(levels=levels, out=out)
        level = self.levels if levels is None else levels
        try:
            count = _native.ifsm_model_points(self._held(), level, None)
        except Error as error:
            raise rename(error, {"level": "levels"})
        points = _arrays.output(out, (count // self.dimension, self.dimension), "ifsm.Model.points")
        _native.ifsm_model_points(self._held(), level, points)
        return points

    def parameters(self):
        """The parameter of each sample, increasing."""
        parameters = np.empty(self.sample_count)
        _native.ifsm_model_parameters(self._held(), parameters)
        return parameters

    def address(self, t, length):
        """The first `length` symbols of a parameter's address, each 0 … N - 1: an array of int32."""
        with naming(parameter="t"):
            return _arrays.fetched(_native.ifsm_model_address, self._held(), t, length, dtype=np.int32)

    def interval(self, symbols):
        """(first, last): the parameters of the node that an address names; of no symbols the whole curve's."""
        return tuple(_native.ifsm_model_interval(
            self._held(), _arrays.integers(symbols, "ifsm.Model.interval", "symbols", np.int32)))

    # ---- details ----------------------------------------------------------------------------------------------

    def details(self, level, *, frame="absolute"):
        """Details of one level: an array of shape (details, dimension), node by node.

        Parameters
        ----------
        level : int
            0 (coarsest) … ``model.levels - 1``.
        frame : {"absolute", "node"}
            In the samples' axes, or in the frame of their node's own polygon.
        """
        return _arrays.fetched(_native.ifsm_model_details, self._held(), level,
                               _arrays.choice(frame, FRAMES, "ifsm.Model.details", "frame"), columns=self.dimension)

    def significance(self, level):
        """How much each detail of a level does to the curve, in the samples' units times the root of places."""
        return _arrays.fetched(_native.ifsm_model_significance, self._held(), level)

    def keep(self, *, details=None, levels=None, above=None, within=None, levels_within=None, distance="rms",
             resolve=None, progress=None):
        """A sketch: a model whose other details are zero. Give one of the first five.

        Parameters
        ----------
        details : int
            The nearest sketch of so many details (control points not counted).
        levels : int
            All details of the first levels.
        above : float
            Those that do more than this to the curve (`significance`).
        within : float
            As few as bring the sketch to within this of the curve, in the samples' units.
        levels_within : float
            All of as few levels as do.
        distance : {"rms", "largest", "hausdorff"}
            What a bound is measured by, and what solving makes small. A search by ``"hausdorff"`` takes tens of seconds
            for thousands of samples.
        resolve : {"none", "values", "choice"}, optional
            Whether what is kept stays as it is, is solved anew, or chosen anew as well. By default ``"choice"`` for
            `details` and `within`, ``"none"`` for the others.
        progress : bool or callable
            As in `ifsm.fit`.
        """
        function = "ifsm.Model.keep"
        rules = {"details": (_native.IFSM_KEEP_COUNT, details), "levels": (_native.IFSM_KEEP_LEVELS, levels),
                 "above": (_native.IFSM_KEEP_THRESHOLD, above), "within": (_native.IFSM_KEEP_WITHIN, within),
                 "levels_within": (_native.IFSM_KEEP_LEVELS_WITHIN, levels_within)}
        given = [name for name, (_, value) in rules.items() if value is not None]
        if len(given) != 1:
            raise invalid_value(function, given[1] if given else "details",
                                f"Give one of {', '.join(rules)}; {' and '.join(given) or 'none'} {'are' if len(given) > 1 else 'is'} given.")
        rule, value = rules[given[0]]
        if resolve is None:
            resolve = "choice" if given[0] in ("details", "within") else "none"
        counts = given[0] in ("details", "levels")
        renamed = {"kept_count": given[0], "count": given[0], "threshold": given[0]}
        with naming(**renamed), _progress.telling(progress, function) as told:
            return Model._of(_native.ifsm_model_keep(
                self._held(), rule, value if counts else 0, 0.0 if counts else value,
                _arrays.choice(resolve, RESOLVES, function, "resolve"),
                _arrays.choice(distance, DISTANCES, function, "distance"), None, told))

    def with_control_points(self, points, *, frame="node"):
        """A model with other control points, of shape (n, dimension); ``"node"``: texture follows."""
        function = "ifsm.Model.with_control_points"
        return Model._of(_native.ifsm_model_with_control_points(
            self._held(), _arrays.choice(frame, FRAMES, function, "frame"),
            _rows(points, function, "points", self._info.control_points, self.dimension)))

    def with_details(self, level, vectors, *, frame="absolute"):
        """A model with other details at one level, as many as there are."""
        function = "ifsm.Model.with_details"
        kind = _arrays.choice(frame, FRAMES, function, "frame")
        count = _native.ifsm_model_details(self._held(), level, kind, None) // self.dimension
        return Model._of(_native.ifsm_model_with_details(
            self._held(), level, kind, _rows(vectors, function, "vectors", count, self.dimension)))

    def with_filter(self, filter):
        """A model with another filter of the same shape; control points and details stay."""
        info = self._info
        return Model._of(_native.ifsm_model_with_filter(
            self._held(), _filter(filter, "ifsm.Model.with_filter", "filter", info.control_points, info.maps)))

    def refine(self, levels=1, *, seed=0, learned=0, roughness=None):
        """A model that goes on below the samples, with random details like those that it has.

        Parameters
        ----------
        levels : int
            How many more, 1 … 40.
        seed : int
            Other seeds, other details; the same, the same bits.
        learned : int
            How many scales are learnt from, the finest ones; 0: 4.
        roughness : float, optional
            What the new displacements are multiplied with; 0: none, 1 by default.
        """
        if isinstance(roughness, numbers.Real) and roughness < 0:
            raise invalid_value("ifsm.Model.refine", "roughness", f"roughness is {roughness}; give a factor that is not "
                                "negative.", value=float(roughness))
        rough = 0.0 if roughness is None else -1.0 if isinstance(roughness, numbers.Real) and roughness == 0 else roughness
        return Model._of(_native.ifsm_model_refine(self._held(), levels, seed, learned, rough))

    def deformer(self, *, turning="similarity", follow="moved"):
        """A `Deformer` of it: edits with undo, time, and texture that follows."""
        from ._deformers import Deformer

        return Deformer(self, turning=turning, follow=follow)

    # ---- questions --------------------------------------------------------------------------------------------

    def length(self, start=0.0, stop=1.0):
        """Arc length from one parameter to another, in the samples' units: negative on the way back. Parameters of rings
        go on: from 0.9 across the seam to 1.1."""
        try:
            return _native.ifsm_model_length(self._held(), start, stop)
        except Error as error:
            raise of_one(rename(error, {"from": "start", "_from": "start", "to": "stop"}))

    def spaced(self, points=None, *, spacing=None):
        """Parameters of points that are equally far apart along the curve: so many, or so far."""
        if (points is None) == (spacing is None):
            raise invalid_value("ifsm.Model.spaced", "points", "Give how many points, or their spacing: one of the two.")
        return _arrays.fetched(_native.ifsm_model_spaced, self._held(), 0 if points is None else points,
                               0.0 if spacing is None else spacing)

    def nearest(self, queries):
        """The points of the curve nearest to queries, of shape (queries, dimension): a `Nearest`."""
        asked = _arrays.table(queries, "ifsm.Model.nearest", "queries", self.dimension)
        rows = np.empty((len(asked), 2 + self.dimension))
        _native.ifsm_model_nearest(self._held(), asked, rows)
        return Nearest(rows[:, 0], rows[:, 1], rows[:, 2:])

    def distance(self, other):
        """How far it is from another model of as many samples: `Distances`."""
        told = _native.ifsm_model_distance(self._held(), native_of(other, Model, "ifsm.Model.distance", "other"))
        return Distances(told.rms, told.largest, told.farthest, told.hausdorff)

    def curvature(self, t, scale):
        """How the curve bends at parameters, seen at a scale along it; in the plane positive to the left."""
        asked = _arrays.doubles(t, "ifsm.Model.curvature", "t")
        curvatures = np.empty(asked.shape)
        try:
            _native.ifsm_model_curvature(self._held(), scale, asked, curvatures)
        except Error as error:
            rename(error, {"parameters": "t"})
            raise error if asked.ndim else of_one(error)
        return curvatures if asked.ndim else float(curvatures)

    def crossings(self):
        """Where a plane curve meets itself: `Crossings`."""
        return crossings(_arrays.fetched(_native.ifsm_model_crossings, self._held(), columns=6))

    def fractal_dimension(self, method="boxes", *, scales=0, smallest=0.0, largest=0.0):
        """The fractal dimension by counting boxes or steps of a divider: a `Dimension`. Zeros choose the scales."""
        kind = _arrays.choice(method, _METHODS, "ifsm.Model.fractal_dimension", "method")
        asked = (self._held(), kind, scales, smallest, largest)
        rows = np.empty((_native.ifsm_model_dimension(*asked, None)[1] // 2, 2))
        report, _ = _native.ifsm_model_dimension(*asked, rows)
        return Dimension(report.dimension, report.standard_error, report.r_squared, rows[:, 0], rows[:, 1])

    def spectrum(self):
        """How rough the curve is, level by level: a `Spectrum`."""
        rows = np.empty((self.levels, 2))
        report, _ = _native.ifsm_model_spectrum(self._held(), rows)
        return Spectrum(report.hurst, report.standard_error, report.r_squared, report.dimension, report.first, report.last,
                        rows[:, 0], rows[:, 1])

    # ---- files, copies, comparison ----------------------------------------------------------------------------

    def to_bytes(self, format="cbor"):
        """The model as a file's bytes, ``"cbor"`` or ``"json"``; doubles come back bit for bit."""
        return _saved(_native.ifsm_model_save, self._held(), format, "ifsm.Model.to_bytes")

    @classmethod
    def from_bytes(cls, data):
        """A model from a file's bytes, of either format."""
        with naming(bytes="data"):
            return cls._of(_native.ifsm_model_load(as_bytes(data, "ifsm.Model.from_bytes", "data")))

    def save(self, path, *, format=None):
        """Write it to a file: JSON when the name ends in ``.json``, else CBOR. The program ``ifsm`` reads both."""
        words = "json" if os.fsdecode(path).endswith(".json") else "cbor"
        data = self.to_bytes(words if format is None else format)
        with open(path, "wb") as file:
            file.write(data)

    @classmethod
    def load(cls, path):
        """Read a file that ``save``, or the program ``ifsm``, has written."""
        with open(path, "rb") as file:
            data = file.read()
        try:
            return cls.from_bytes(data)
        except Error as error:
            error.args = (f"{os.fsdecode(path)}: {error.args[0]}", *error.args[1:])
            raise

    # ---- how it shows itself ----------------------------------------------------------------------------------

    @property
    def __geo_interface__(self):
        """GeoJSON of a plane curve at its samples: a LineString, or a Polygon of a closed one."""
        if self.dimension != 2:
            raise AttributeError(f"a curve of {self.dimension} dimensions has no __geo_interface__")
        return _curves.geo_interface(self.samples(), self.closed)

    def __repr__(self):
        if self._native is None:
            return "<ifsm.Model, closed>"
        kept = self.details_kept
        details = f"{self.detail_count}" if kept == self.detail_count else f"{kept} of {self.detail_count}"
        return (f"<ifsm.Model of {self.sample_count} samples in {self.dimension}-D, "
                f"{'closed' if self.closed else 'open'}: {self._info.control_points} control points + {details} details "
                f"on {self.levels} levels>")

    def _repr_html_(self):
        from ._show import html

        return None if self._native is None else html(self)

    def _repr_png_(self):
        from ._show import png

        return None if self._native is None else png(self)


def _at(call, first, t, dimension, function):
    parameters = _arrays.doubles(t, function, "t")
    points = np.empty((*parameters.shape, dimension))
    try:
        call(*first, parameters, points)
    except Error as error:
        rename(error, {"parameters": "t"})
        raise error if parameters.ndim else of_one(error)
    return points


def _rows(given, function, argument, count, dimension):
    rows = _arrays.table(given, function, argument, dimension)
    if len(rows) != count:
        raise invalid_value(function, argument, f"{argument} has the shape {rows.shape}; give {(count, dimension)}.",
                            Status.SHAPE, required=count)
    return rows


def as_bytes(data, function, argument):
    if not isinstance(data, (bytes, bytearray, memoryview)):
        raise invalid_type(function, argument, data, "bytes")
    return data


def _saved(call, native, format, function):
    words = _arrays.choice(format, FORMATS, function, "format")
    data = bytearray(call(native, words, None))
    call(native, words, data)
    return bytes(data)


def _filter(filter, function, argument, control_points=0, maps=0):
    """The handle of a filter that is given, or named."""
    if isinstance(filter, str):
        try:
            return Filter(filter, control_points=control_points, maps=maps)._native
        except Error as error:
            if filter not in SQUARE_NAMES:
                raise rename(error, {"name": argument}) from None
            return Filter(filter, topology="square")._native
    if not isinstance(filter, Filter):
        raise invalid_type(function, argument, filter, "an ifsm.Filter, or the name of one")
    return native_of(filter, Filter, function, argument)
