"""Fits: the filter under which few details say much."""
from typing import NamedTuple

import numpy as np

from . import _arrays, _curves, _native, _progress
from ._errors import Error, Status, invalid_type, invalid_value, naming, rename
from ._filters import Filter
from ._models import DISTANCES, Model
from ._objects import Handled, native_of

PARAMETERS = {"index": _native.IFSM_PARAMETERS_INDEX, "chord": _native.IFSM_PARAMETERS_CHORD,
              "centripetal": _native.IFSM_PARAMETERS_CENTRIPETAL, "given": _native.IFSM_PARAMETERS_GIVEN}
LOSSES = {"squares": _native.IFSM_LOSS_SQUARES, "huber": _native.IFSM_LOSS_HUBER, "cauchy": _native.IFSM_LOSS_CAUCHY,
          "tukey": _native.IFSM_LOSS_TUKEY}
_STAGES = {_native.IFSM_STAGE_SPARSE: "sparse", _native.IFSM_STAGE_CURVE: "curve", _native.IFSM_STAGE_FILTER: "filter"}
_FIT_REASONS = {_native.IFSM_FIT_CONVERGED: "converged", _native.IFSM_FIT_ITERATIONS: "iterations",
                _native.IFSM_FIT_START_BEST: "start best"}
_TRAIN_REASONS = {_native.IFSM_TRAIN_CONVERGED: "converged", _native.IFSM_TRAIN_ROUNDS: "rounds",
                  _native.IFSM_TRAIN_START_BEST: "start best"}
_POINT, _TANGENT = _native.IFSM_CONSTRAINT_POINT, _native.IFSM_CONSTRAINT_TANGENT


class Budget(NamedTuple):
    """How well a curve is told by so many vectors, under the filter a fit started from and the fitted one."""

    budget: int
    details: int
    start_rms: float
    start_max: float
    rms: float
    max: float
    start_details: int


class FitReport(NamedTuple):
    """What a fit did."""

    stage: str
    reason: str
    """``"converged"``, ``"iterations"``, or ``"start best"``: nothing better than the start was found."""
    curves: int
    budgets: int
    iterations: int
    start_cost: float
    final_cost: float
    start_condition: float
    final_condition: float
    freedom: int
    noise: float


class TrainReport(NamedTuple):
    """What a training did."""

    reason: str
    trained: int
    held_out: int
    sketches: int
    rounds: int
    iterations: int
    ratio: float
    held_out_ratio: float


class Known:
    """What is known about one curve's samples, for `ifsm.fit_curve`.

    Parameters
    ----------
    parameters : array, optional
        One a sample, increasing, 0 … 1; with ``parameters="given"``.
    weights : array, optional
        One a sample, above 0: what its squared residual is multiplied by.
    covariances : array of shape (samples, dimension, dimension), optional
        Instead of weights.
    through : list of (parameter, point)
        The curve passes through these.
    along : list of (0 or 1, direction)
        Its first or last leg lies along these.
    fixed_ends : bool
        It starts and ends where the samples do.
    """

    def __init__(self, *, parameters=None, weights=None, covariances=None, through=(), along=(), fixed_ends=False):
        function = "ifsm.Known"
        vector = lambda given, name: None if given is None else _arrays.doubles(given, function, name).reshape(-1)
        self._arrays = (vector(parameters, "parameters"), vector(weights, "weights"), vector(covariances, "covariances"))
        kinds, at, values = [], [], []
        for kind, name, pairs in ((_POINT, "through", through), (_TANGENT, "along", along)):
            for parameter, value in _pairs(pairs, function, name):
                kinds.append(kind)
                at.append(float(_arrays.doubles(parameter, function, name)))
                values.append(_arrays.doubles(value, function, name).reshape(-1))
        if len({value.shape for value in values}) > 1:
            raise invalid_value(function, "through", "through and along must hold points of one dimension, the curve's.",
                                Status.SHAPE)
        self._constraints = (np.array(kinds, dtype=np.int32), np.array(at, dtype=np.float64),
                             np.ascontiguousarray(np.concatenate(values)) if values else np.empty(0))
        self._fixed_ends = _arrays.is_true(fixed_ends, function, "fixed_ends")

    def _told(self):
        return (*self._arrays, *self._constraints, self._fixed_ends)

    def __repr__(self):
        named = zip(("parameters", "weights", "covariances"), self._arrays)
        parts = [name for name, given in named if given is not None]
        points = int(np.count_nonzero(self._constraints[0] == _POINT))
        directions = len(self._constraints[0]) - points
        parts += [f"through {points} points"] * (points > 0) + [f"along {directions} directions"] * (directions > 0)
        return f"<ifsm.Known: {', '.join(parts + ['fixed ends'] * self._fixed_ends) or 'nothing'}>"


def _pairs(given, function, argument):
    """(parameter, value) pairs, which a list of anything else is not."""
    try:
        pairs = [(parameter, value) for parameter, value in given]
    except (TypeError, ValueError):
        raise invalid_type(function, argument, given, "a list of (parameter, value)") from None
    for parameter, _ in pairs:
        if np.ndim(parameter) != 0:
            raise invalid_type(function, argument, parameter, "one parameter for each value")
    return pairs


_NOTHING_KNOWN = (None, None, None, None, None, None, False)


class Fit(Handled):
    """What `ifsm.fit_sparse`, `ifsm.fit_curve` and `ifsm.fit_filter` found, for all curves that they were given.

    Immutable. It cannot be pickled; its models can.
    """

    __slots__ = ("_report",)

    def __init__(self):
        raise TypeError("An ifsm.Fit is made by ifsm.fit_sparse, ifsm.fit_curve or ifsm.fit_filter.")

    @classmethod
    def _of(cls, native):
        self = cls.__new__(cls)
        self._native = native
        told = _native.ifsm_fit_describe(native)
        self._report = FitReport(_STAGES[told.stage], _FIT_REASONS[told.reason], told.curves, told.budgets,
                                 told.iterations, told.start_cost, told.final_cost, told.start_condition,
                                 told.final_condition, told.freedom, told.noise)
        return self

    @property
    def report(self):
        """What it did: a `FitReport`."""
        return self._report

    @property
    def filter(self):
        """The fitted `Filter`."""
        return self.model().filter

    def model(self, curve=0):
        """A curve's exact model under the fitted filter."""
        return Model._of(_native.ifsm_fit_model(self._held(), curve))

    def sketch(self, curve=0, budget=0):
        """The nearest sketch of a curve that was found; `budget` is its position among the budgets."""
        return Model._of(_native.ifsm_fit_sketch(self._held(), curve, budget))

    def budget(self, curve=0, budget=0):
        """How near it is: a `Budget`."""
        row = _native.ifsm_fit_describe_budget(self._held(), curve, budget)
        return Budget(row.budget, row.details, row.start_rms, row.start_max, row.rms, row.max, row.start_details)

    def parameters(self, curve=0):
        """Where the fit saw a curve's samples."""
        return _arrays.fetched(_native.ifsm_fit_parameters, self._held(), curve)

    def covariance(self, curve=0):
        """Of a curve's control points: (n · dimension) squared. Stage curve alone."""
        return _square(_arrays.fetched(_native.ifsm_fit_covariance, self._held(), curve))

    def filter_covariance(self):
        """Of the filter's fitted entries, row-major. Stages curve and filter."""
        return _square(_arrays.fetched(_native.ifsm_fit_filter_covariance, self._held()))

    def curve_covariance(self, t, curve=0):
        """Of the curve's points at parameters: an array of shape (…, dimension, dimension). Stage curve alone."""
        asked = _arrays.doubles(t, "ifsm.Fit.curve_covariance", "t")
        values = _arrays.fetched(_native.ifsm_fit_curve_covariance, self._held(), curve, np.atleast_1d(asked))
        dimension = int(round((values.size / max(asked.size, 1)) ** 0.5))
        return values.reshape(*asked.shape, dimension, dimension)

    def __reduce__(self):
        raise TypeError("An ifsm.Fit cannot be pickled or copied; its models and sketches can.")

    def __repr__(self):
        if self._native is None:
            return "<ifsm.Fit, closed>"
        told = self._report
        return f"<ifsm.Fit of {told.curves} curves, stage {told.stage}, {told.reason} after {told.iterations} iterations>"


def _square(values):
    side = int(round(values.size ** 0.5))
    return values.reshape(side, side)


def fit(points, *, closed=None, control_points=None, maps=None, filter=None, budget=None, within=None, distance="rms",
        iterations=0, threads=0, progress=None):
    """Fit a detail model to one curve: the main job.

    Finds, by Levenberg-Marquardt, the filter under which few details tell the curve, and returns the exact model of the
    samples under it. For several curves that share a filter, and for what the fit tells, there is `ifsm.fit_sparse`.

    Parameters
    ----------
    points : array of shape (samples, dimension), or anything with a ``__geo_interface__``
        Ordered samples; lists, float32, strided arrays are converted, C-contiguous float64 is read in place.
    closed : bool, optional
        Whether they are a ring; what the geometry says, or False.
    control_points, maps : int, optional
        The shape n (2 … 16), N (2 … 8); -1: chosen. By default the filter's, or 5 and 2.
    filter : str or Filter, optional
        Where to start: ``"coast"``, ``"casteljau"``, or any joined one.
    budget : int, optional
        How many vectors, control points and details together, a sketch may hold that is to be near its curve. By default
        128, or a quarter of fewer samples.
    within : float, optional
        Instead of a budget, a bound that sketches keep, by `distance`.
    distance : {"rms", "largest", "hausdorff"}
    iterations, threads : int
        At most so many; 0 for the defaults.
    progress : bool or callable
        True for a bar (needs tqdm); a callable is told (fraction, stage), and cancels by returning true. Ctrl-C
        cancels, too.

    Returns
    -------
    Model

    Raises
    ------
    InvalidValue, InvalidType
        Naming the argument, and of points the index and value of the first bad number.
    Cancelled

    Examples
    --------
    >>> t = np.linspace(0, 20, 500)
    >>> model = ifsm.fit(np.column_stack([t, np.sin(t) + 0.1 * np.sin(17 * t)]), budget=64)
    >>> sketch = model.keep(details=40)
    >>> sketch.details_kept
    40
    """
    samples, ring = _one(points, "ifsm.fit", "points", closed)
    if within is not None and budget is not None:
        raise invalid_value("ifsm.fit", "within", "Give a budget or within, not both.")
    budgets = None if budget is None else [_arrays.whole(budget, "ifsm.fit", "budget")]
    try:
        fitted = fit_sparse([(samples, ring)], control_points=control_points, maps=maps, filter=filter, budgets=budgets,
                            within=within, distance=distance, iterations=iterations, threads=threads, progress=progress)
    except Error as error:
        raise _of_one_curve(error)
    with fitted:
        return fitted.model()


def _of_one_curve(error):
    """Names what was given: "points", not "curves[0].points"; "budget", not "budgets[0]"."""
    for listed, alone in (("curves[0].", ""), ("the model of curve 0", "its model"), ("curve 0", "the curve"),
                          ("curves[0]", "points"), ("budgets[0]", "budget")):
        error.args = (error.args[0].replace(listed, alone), *error.args[1:])
        error.argument = error.argument.replace(listed, alone)
    if error.argument == "budgets":
        error.argument, error.index = "budget", None
    return error


def fit_sparse(curves, *, control_points=None, maps=None, filter=None, budgets=None, within=None, distance="rms",
               iterations=0, rounds=0, polish=0, threads=0, progress=None):
    """Stage sparse: one filter for all curves, under which few details tell them. Returns a `Fit`.

    Parameters
    ----------
    curves : list
        Of arrays, geometries, or (points, closed).
    budgets : list of int, optional
        Of vectors, control points and details together.
    rounds, polish : int
        Rounds of sparsity and on the sketches' own error; 0 for the defaults, -1 for none.
    others : as in `ifsm.fit`
    """
    function = "ifsm.fit_sparse"
    if isinstance(within, (int, float)) and within == 0:
        raise invalid_value(function, "within", "within is 0; give a distance above 0, or leave it out.", value=0.0)
    start, n, maps = _start(filter, control_points, maps, function)
    asked = None if budgets is None else _arrays.integers(budgets, function, "budgets", np.int64)
    if asked is not None and asked.size == 0:
        raise invalid_value(function, "budgets", "budgets is empty; give one at least, or leave it out.", Status.SHAPE)
    given = _all(curves, function)
    with _progress.telling(progress, function) as told:
        return Fit._of(_native.ifsm_fit_sparse(
            given, threads, start, n, maps, asked, iterations, rounds, polish,
            _arrays.choice(distance, DISTANCES, function, "distance"), None, told, 0.0 if within is None else within))


def fit_curve(curves, *, control_points=None, maps=None, filter=None, fixed_filter=False, parameters="index",
              reparameterise=0, loss="squares", loss_scale=0.0, levels=0, starts=0, iterations=0, tolerance=0.0,
              known=None, threads=0, progress=None):
    """Stage curve: control points and T whose curve *without* details comes nearest to the samples. Returns a `Fit`.

    ``fit.sketch(c)`` is the fitted curve.

    Parameters
    ----------
    curves : list
        Of arrays, geometries, or (points, closed).
    fixed_filter : bool
        Fit control points alone.
    parameters : {"index", "chord", "centripetal", "given"}
        Where samples lie on the curve; in how many rounds of `reparameterise` they find the nearest point anew.
    loss : {"squares", "huber", "cauchy", "tukey"}
        With `loss_scale`, the residual at which outliers begin.
    levels, starts, iterations, tolerance
        Zeros for the defaults: ifsm_fit_curve_options in ifsm.h.
    known : list of Known or None, optional
        What is known about each curve's samples.
    others : as in `ifsm.fit`
    """
    function = "ifsm.fit_curve"
    start, n, maps = _start(filter, control_points, maps, function)
    given = _all(curves, function)
    facts = []
    if known is not None and not isinstance(known, (list, tuple)):
        raise invalid_type(function, "known", known, "a list of ifsm.Known")
    if known is not None and len(known) != len(given):
        raise invalid_value(function, "known", f"known holds {len(known)} entries for {len(given)} curves; give one for "
                            "each, None for curves of which nothing is known.", Status.SHAPE, required=len(given))
    for index, fact in enumerate(known or ()):
        if fact is not None and not isinstance(fact, Known):
            raise invalid_type(function, f"known[{index}]", fact, "an ifsm.Known, or None")
        facts.append(_NOTHING_KNOWN if fact is None else fact._told())
    with naming(samples="known"), _progress.telling(progress, function) as told:
        return Fit._of(_native.ifsm_fit_curve(
            given, threads, start, n, maps, _arrays.is_true(fixed_filter, function, "fixed_filter"),
            _arrays.choice(parameters, PARAMETERS, function, "parameters"), reparameterise,
            _arrays.choice(loss, LOSSES, function, "loss"), loss_scale, levels, starts, iterations, tolerance, facts, None,
            told))


def fit_filter(curves, *, control_points=None, maps=None, filter=None, kept_levels=0, iterations=0, tolerance=0.0,
               threads=0, progress=None):
    """Stage filter: with T as it is, the U under which the first levels of details tell the samples best.

    Returns a `Fit`; ``fit.sketch(c)`` has the details of those `kept_levels` (0: 3; -1: none).
    """
    function = "ifsm.fit_filter"
    start, n, maps = _start(filter, control_points, maps, function)
    given = _all(curves, function)
    with _progress.telling(progress, function) as told:
        return Fit._of(_native.ifsm_fit_filter(given, threads, start, n, maps, kept_levels, iterations, tolerance, None,
                                               told))


def train(curves, *, control_points=None, maps=None, filter=None, budgets=None, hold_out=0, rounds=0, iterations=0,
          condition=0.0, reach=0.0, threads=0, progress=None):
    """Train one filter on curves of a kind, to be chosen as a wavelet is. Returns (Filter, TrainReport).

    Zeros choose the defaults of ifsm_train_options in ifsm.h.
    """
    function = "ifsm.train"
    start, n, maps = _start(filter, control_points, maps, function)
    asked = None if budgets is None else _arrays.integers(budgets, function, "budgets", np.int64)
    given = _all(curves, function)
    with _progress.telling(progress, function) as told:
        made, report = _native.ifsm_train(given, threads, start, n, maps, asked, hold_out, rounds, iterations, condition,
                                          reach, None, told)
    return Filter._of(made), TrainReport(_TRAIN_REASONS[report.reason], report.trained, report.held_out, report.sketches,
                                         report.rounds, report.iterations, report.ratio, report.held_out_ratio)


def _start(filter, control_points, maps, function):
    """(handle of the filter to start from or None, n, N), zeros for what is not said."""
    n = 0 if control_points is None else control_points
    count = 0 if maps is None else maps
    if filter is None:
        return None, n, count
    if isinstance(filter, str):
        shape = {"control_points": n, "maps": count} if filter == "casteljau" else {}
        try:
            filter = Filter(filter, **shape)
        except Error as error:
            if error.argument == "topology":
                raise invalid_value(function, "filter", f"filter is {filter!r}, which is square; a fit needs a joined one, "
                                    "such as 'coast' or 'casteljau'.") from None
            raise rename(error, {"name": "filter"})
    elif not isinstance(filter, Filter):
        raise invalid_type(function, "filter", filter, "an ifsm.Filter, or the name of one")
    start = native_of(filter, Filter, function, "filter")
    for name, given, has in (("control_points", control_points, filter.control_points), ("maps", maps, filter.maps)):
        if given is not None and given != has:
            raise invalid_value(function, name, f"{name} is {given}, and the filter to start from has {has}; give one of "
                                "the two, or both alike.", Status.SHAPE)
    return start, 0, 0


def refuse_one_curve(curves, function):
    """An array of points, given where a list of such is wanted, would be as many curves of two, three samples."""
    if isinstance(curves, np.ndarray) and curves.ndim == 2 and curves.shape[1] <= 4:
        raise invalid_value(function, "curves", f"curves is one array of shape {curves.shape}; give a list of arrays, "
                            "[points] for one curve.", Status.SHAPE)


def _all(curves, function):
    if isinstance(curves, (str, bytes, dict)) or not hasattr(curves, "__iter__"):
        raise invalid_type(function, "curves", curves, "a list of curves")
    refuse_one_curve(curves, function)
    read = [_one(given, function, f"curves[{index}]") for index, given in enumerate(curves)]
    if not read:
        raise invalid_value(function, "curves", "curves is empty; give one at least.", Status.SHAPE, required=1)
    return read


def _one(given, function, argument, closed=None):
    """(points, closed) of one curve; a tuple says itself whether it is closed."""
    if isinstance(given, tuple) and len(given) == 2 and isinstance(given[1], (bool, np.bool_)):
        given, closed = given
    return _curves.curve(given, closed, function, argument)
