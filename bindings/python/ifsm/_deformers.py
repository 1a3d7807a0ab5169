"""Deformers: models being edited."""
import numpy as np

from . import _arrays, _native
from ._answers import crossings
from ._errors import Status, invalid_value, naming
from ._models import Model, _at, _saved, as_bytes
from ._objects import Handled, native_of

TURNINGS = {"similarity": _native.IFSM_TURNING_SIMILARITY, "rotation": _native.IFSM_TURNING_ROTATION,
            "linear": _native.IFSM_TURNING_LINEAR}
FOLLOWS = {"moved": _native.IFSM_FOLLOW_MOVED, "each": _native.IFSM_FOLLOW_EACH, "none": _native.IFSM_FOLLOW_NONE}
REACHES = {"nodes": _native.IFSM_REACH_NODES, "curve": _native.IFSM_REACH_CURVE}
FALLOFFS = {"none": _native.IFSM_FALLOFF_NONE, "linear": _native.IFSM_FALLOFF_LINEAR,
            "smooth": _native.IFSM_FALLOFF_SMOOTH}
RULERS = {"handles": _native.IFSM_RULER_HANDLES, "length": _native.IFSM_RULER_LENGTH}
LEADS = {"handles": _native.IFSM_LEAD_HANDLES, "details": _native.IFSM_LEAD_DETAILS}
EASINGS = {"smooth": _native.IFSM_EASING_SMOOTH, "linear": _native.IFSM_EASING_LINEAR, "in": _native.IFSM_EASING_IN,
           "out": _native.IFSM_EASING_OUT}


class Deformer(Handled):
    """A model being edited: moves, pins, drags, other looks and textures, with undo, time, and texture that follows.

    Level l has *handles*, the points ``model.points(levels=l)`` (a ring's first one is not repeated); level 0's are the
    control points. Edits return the
    deformer, so that they can be chained; one that fails leaves it as it was. One thread at a time: a second one gets
    `Busy`.

    Parameters
    ----------
    model : Model
        Stays as it is.
    turning : {"similarity", "rotation", "linear"}
        What a turn may be.
    follow : {"moved", "each", "none"}
        Whose turn details take: that of the nearest node above them that holds a moved handle, that of their own node's
        polygon, or none.

    Examples
    --------
    >>> model = ifsm.Model(np.column_stack([np.arange(65), np.zeros(65)]), filter="casteljau")
    >>> bent = model.deformer().move(0, 2, [0, 10]).snapshot()
    >>> bent.control_points[2]
    array([32., 10.])
    >>> model.deformer().drag(2, 0.5, [32, 5])(0.5)
    array([32.,  5.])
    """

    __slots__ = ("_model", "_options")

    def __init__(self, model, *, turning="similarity", follow="moved"):
        function = "ifsm.Deformer"
        self._native = None
        self._model = model
        self._options = (turning, follow)
        self._native = _native.ifsm_deformer_create(
            native_of(model, Model, function, "model"), _arrays.choice(turning, TURNINGS, function, "turning"),
            _arrays.choice(follow, FOLLOWS, function, "follow"))

    @property
    def model(self):
        """What is being edited."""
        return self._model

    @property
    def undoable(self):
        """Steps that `undo` can go back."""
        return self._told().undoable

    @property
    def redoable(self):
        """Steps that `redo` can go forth."""
        return self._told().redoable

    @property
    def edits(self):
        """Edits that made the present state."""
        return self._told().edits

    @property
    def span(self):
        """(begin, end): when the first of them begins, and when the last one ends."""
        told = self._told()
        return told.begin, told.end

    def _told(self):
        return _native.ifsm_deformer_describe(self._held())

    # ---- edits ------------------------------------------------------------------------------------------------

    def move(self, level, handles, vectors, *, places=False, reach="nodes", falloff="none", ruler="handles", radius=0.0):
        """Move handles of a level.

        Parameters
        ----------
        level : int
            0 … ``model.levels``.
        handles : int or list of int
        vectors : array of shape (handles, dimension), or one point for one handle
            By how much; with `places`, where to.
        reach : {"nodes", "curve"}
            Only nodes that hold a handle turn, and elsewhere every bit stays; or all of the curve (paper 002, Local).
        falloff, ruler, radius
            How handles near a moved one follow: ``"linear"`` or ``"smooth"``, within so many ``"handles"``, or so far in
            arc ``"length"``.
        """
        function = "ifsm.Deformer.move"
        moved = _handles(handles, function)
        _native.ifsm_deformer_move(
            self._held(), level, moved, self._points(vectors, len(moved), function, "vectors", "handles"), _arrays.is_true(places, function, "places"),
            _arrays.choice(reach, REACHES, function, "reach"), _arrays.choice(falloff, FALLOFFS, function, "falloff"),
            _arrays.choice(ruler, RULERS, function, "ruler"), radius)
        return self

    def _points(self, given, count, function, argument, others):
        points = _arrays.table(given, function, argument, self._model.dimension)
        if len(points) != count:
            raise invalid_value(function, argument, f"{argument} holds {len(points)} points for {count} {others}; give one "
                                "for each.", Status.SHAPE, required=count)
        return points

    def pin(self, level, handles):
        """Pin handles where they are: whatever moves above them, they stay."""
        _native.ifsm_deformer_pin(self._held(), level, _handles(handles, "ifsm.Deformer.pin"), 1)
        return self

    def release(self, level, handles):
        """Let pinned handles go to where they would be."""
        _native.ifsm_deformer_pin(self._held(), level, _handles(handles, "ifsm.Deformer.release"), 0)
        return self

    def drag(self, level, t, places, *, lead="handles"):
        """Drag points of the curve, at parameters, to places: exactly, by the least change of a level's handles or
        details (``lead``). Pinned handles stay."""
        function = "ifsm.Deformer.drag"
        parameters = np.atleast_1d(_arrays.doubles(t, function, "t"))
        goals = self._points(places, parameters.size, function, "places", "parameters")
        with naming(parameters="t"):
            _native.ifsm_deformer_drag(self._held(), level, _arrays.choice(lead, LEADS, function, "lead"), parameters, goals)
        return self

    def restyle(self, first, last, scale=1.0, *, angle=0.0, mirror=0, fade=0):
        """Appearance: details of levels `first` … `last` scaled, mirrored along an axis (counted from 1), and turned
        (radians); `fade` levels on each side follow, less and less."""
        _native.ifsm_deformer_restyle(self._held(), first, last, scale, fade, mirror, angle)
        return self

    def texture(self, first, last, source=None, *, roughness=0.0, size=0.0, seed=0, fade=0):
        """Details of levels `first` … `last` replaced: by those of another model, or, without one, by random ones whose
        sizes shrink by N^-roughness from level to level (0: 0.5), starting at `size` (0: the model's own)."""
        other = None if source is None else native_of(source, Model, "ifsm.Deformer.texture", "source")
        with naming(**{"from": "source", "_from": "source"}):
            _native.ifsm_deformer_texture(self._held(), first, last, fade, other, roughness, size, seed)
        return self

    # ---- history and time -------------------------------------------------------------------------------------

    def undo(self):
        """A step back."""
        _native.ifsm_deformer_undo(self._held())
        return self

    def redo(self):
        """And forth again."""
        _native.ifsm_deformer_redo(self._held())
        return self

    def keep_as(self, name):
        """Keep the present state by a name."""
        _native.ifsm_deformer_keep_as(self._held(), name)
        return self

    def go_to(self, name):
        """Go to a kept state: a step that can be undone."""
        _native.ifsm_deformer_go_to(self._held(), name)
        return self

    def time(self, begin, end, easing="smooth"):
        """When the edits that follow take place, for `at_time`; a new deformer's take from 0 to 1."""
        _native.ifsm_deformer_time(self._held(), begin, end, _arrays.choice(easing, EASINGS, "ifsm.Deformer.time", "easing"))
        return self

    def at_time(self, time):
        """The curve at a time, a deformer of its own: a frame of an animation."""
        frame = Deformer.__new__(Deformer)
        frame._model = self._model
        frame._options = self._options
        frame._native = _native.ifsm_deformer_at_time(self._held(), time)
        return frame

    def to_bytes(self, format="cbor"):
        """The edits that made the present state, with their times."""
        return _saved(_native.ifsm_deformer_save, self._held(), format, "ifsm.Deformer.to_bytes")

    def replay(self, data):
        """Make the edits that `to_bytes` told, after those that there are: all, or none."""
        with naming(bytes="data"):
            _native.ifsm_deformer_replay(self._held(), as_bytes(data, "ifsm.Deformer.replay", "data"))
        return self

    # ---- the curve as it is -----------------------------------------------------------------------------------

    def __call__(self, t):
        """The curve at parameters, as ``model(t)``."""
        return _at(_native.ifsm_deformer_evaluate, (self._held(),), t, self._model.dimension, "ifsm.Deformer")

    def samples(self, *, out=None):
        """The curve at the samples, as ``model.samples()``."""
        points = _arrays.output(out, (self._model.sample_count, self._model.dimension), "ifsm.Deformer.samples")
        _native.ifsm_deformer_samples(self._held(), points)
        return points

    def points(self, level=None, *, first=0, count=None, out=None):
        """Handles of a level, where they are: all, or a window of `count` from `first` on. By default the finest ones."""
        model = self._model
        level = model.levels if level is None else _arrays.whole(level, "ifsm.Deformer.points", "level")
        if not 0 <= level <= model.levels:
            raise invalid_value("ifsm.Deformer.points", "level", f"level is {level}; give a value from 0 to "
                                f"{model.levels}.", value=level)
        if count is None:
            count = self._handle_count(level) - _arrays.whole(first, "ifsm.Deformer.points", "first")
        with naming(number="count"):
            doubles = _native.ifsm_deformer_points(self._held(), level, first, count, None)
        points = _arrays.output(out, (doubles // model.dimension, model.dimension), "ifsm.Deformer.points")
        _native.ifsm_deformer_points(self._held(), level, first, count, points)
        return points

    def _handle_count(self, level):
        model = self._model
        edges = (model._info.control_points - 1) * model._info.maps ** level  # of joined polygons
        if model._info.topology == _native.IFSM_TOPOLOGY_JOINED:
            return edges if model.closed else edges + 1
        return _native.ifsm_model_points(model._held(), level, None) // model.dimension

    def changed(self, level):
        """(first, count): the handles of a level that the last step may have changed."""
        return tuple(_native.ifsm_deformer_changed(self._held(), level))

    def crossings(self):
        """Where the curve as it is meets itself and the model does not: `Crossings`."""
        return crossings(_arrays.fetched(_native.ifsm_deformer_crossings, self._held(), columns=6))

    def snapshot(self):
        """The present state as a model of its own."""
        return Model._of(_native.ifsm_deformer_snapshot(self._held()))

    # ---- copies, and how it shows itself ----------------------------------------------------------------------

    def __copy__(self):
        return _deformer_again(self._model, self._options, self.to_bytes())

    def __deepcopy__(self, memo):
        return self.__copy__()

    def __reduce__(self):
        return _deformer_again, (self._model, self._options, self.to_bytes())

    def __repr__(self):
        if self._native is None:
            return "<ifsm.Deformer, closed>"
        told = self._told()
        return f"<ifsm.Deformer, {told.edits} edits, {told.undoable} to undo, {told.redoable} to redo, of {self._model!r}>"

    def _repr_html_(self):
        return None if self._native is None else self.snapshot()._repr_html_()

    def _repr_png_(self):
        return None if self._native is None else self.snapshot()._repr_png_()


def _handles(given, function):
    return _arrays.integers(given, function, "handles", np.int64)


def _deformer_again(model, options, edits):
    turning, follow = options
    return Deformer(model, turning=turning, follow=follow).replay(edits)
