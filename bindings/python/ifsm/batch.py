"""Fits beyond one machine: every curve a model of its own, on a Dask cluster.

>>> from distributed import Client, LocalCluster                                      # doctest: +SKIP
>>> with LocalCluster() as cluster, Client(cluster) as client:                        # doctest: +SKIP
...     models, failures = ifsm.batch.fit({"iceland": coast, "faroes": islands}, client)

Needs Dask: ``pip install ifsm[batch]``.
"""
import collections.abc
import contextlib
import uuid
from typing import NamedTuple

from . import _arrays, _curves, _fits
from ._errors import Cancelled, Error, Status, invalid_type, invalid_value
from ._models import DISTANCES, Model

__all__ = ["Failure", "Fits", "fit"]

_FUNCTION = "ifsm.batch.fit"
_TASK_POINTS = 4096  # what a task is filled up to: about a second of work, a thousand times what Dask needs to send it
_CURVE_POINTS = 128  # what a curve counts for beside its points: short fits take about as long as such a one
_TASKS_A_THREAD = 4  # in flight: enough that no worker waits for this process, few enough for any scheduler
_LEAST_TASKS = 16  # in flight when no worker is there, or few: they come and go


class Failure(NamedTuple):
    """A curve that has no model, and why. Its text names both."""

    curve: object
    """Its key: the position in a list, the key in a dict."""
    error: Exception
    """What ``ifsm.fit`` raises for it; `distributed.KilledWorker` when it ended the workers that tried."""

    def __str__(self):
        return f"curve {self.curve!r}: {self.error}"


class Fits(NamedTuple):
    """What `ifsm.batch.fit` found. Every curve is in one of the two."""

    models: dict
    """`Model` by the curve's key, in the order of the curves."""
    failures: list
    """`Failure`, in the order of the curves."""


def fit(curves, client, *, closed=None, progress=False, control_points=None, maps=None, filter=None, budget=None,
        within=None, distance="rms", iterations=0):
    """Fit each curve by itself on the workers of a Dask cluster: the models of `ifsm.fit`, bit for bit.

    Curves are sent in tasks of some thousand points and come back as CBOR. A worker that dies loses nothing: Dask gives
    its tasks to others. A curve that cannot be fitted becomes a `Failure`, and stops nothing else. So does a curve that
    ends one worker after the other: tasks that Dask gives up are tried again curve by curve, last and alone.

    Parameters
    ----------
    curves : iterable, dict, or anything with a ``__geo_interface__``
        Arrays of shape (samples, dimension), geometries, or (points, closed), all of any dimension and length; of a
        dict its values. Of GeoJSON, GeoPandas frames and the like, all lines and rings, in the order of `ifsm.curves`.
        Iterators are read as work gets done, so that they need not fit into memory; the models must.
    client : distributed.Client
        Of any cluster whose workers can import `ifsm`. Workers are the parallelism: every fit uses one thread, however
        many a worker has.
    closed : bool, optional
        Whether they are rings, unless a curve is (points, closed); what the geometry says, or False.
    progress : bool or callable
        True for a bar (needs tqdm); a callable is told (curves done, curves or None for iterators) after each task, and
        cancels by returning true.
    control_points, maps, filter, budget, within, distance, iterations
        As in `ifsm.fit`, for all curves alike. A curve with fewer vectors than a `budget` that is given fails; the
        default suits every length.

    Returns
    -------
    Fits
        ``models, failures = …``: dict of key to Model, list of Failure.

    Raises
    ------
    InvalidValue, InvalidType
        For options, before any work; what is wrong with a curve is a Failure.
    Cancelled
        By `progress`. Like Ctrl-C and every other exception, it takes back what was not done yet.
    ImportError
        Without Dask.

    Examples
    --------
    >>> models, failures = ifsm.batch.fit(coasts, client, closed=True, progress=True)    # doctest: +SKIP
    >>> print(*failures, sep="\\n")                                                      # doctest: +SKIP
    curve 17: points[7] is nan; every value must be finite: remove or replace it.
    """
    distributed = _distributed()
    _require_synchronous(client, distributed)
    options = _checked(control_points=control_points, maps=maps, filter=filter, budget=budget, within=within,
                       distance=distance, iterations=iterations)
    if closed is not None:
        _arrays.is_true(closed, _FUNCTION, "closed")
    named, total = _named(curves)
    with _telling(progress, total) as told, _Work(client, distributed, options, told) as work:
        for task in _tasks(work.readable(named, closed)):
            work.send(task)
        work.finish()
        return work.fits()


class _Work:
    """The tasks of one call: sent, in flight, done."""

    def __init__(self, client, distributed, options, told):
        self._client = client
        self._killed = distributed.KilledWorker
        self._completed = distributed.as_completed(loop=client.loop)
        self._options = options
        self._told = told
        self._name = f"ifsm-fit-{uuid.uuid4().hex}"
        self._in_flight = {}  # task's key: its future, and (key, curve) pairs
        self._sent = 0
        self._most = 0  # tasks in flight
        self._recount = 0  # how many are sent when workers are counted again: each time asks the scheduler
        self._order = []
        self._models = {}
        self._errors = {}
        self._suspects = []

    def __enter__(self):
        return self

    def __exit__(self, *_):
        """After an exception there are tasks in flight, which nobody wants any more."""
        futures = [future for future, _ in self._in_flight.values()]
        if futures:
            with contextlib.suppress(Exception):  # the client may be closed, which does the same
                self._client.cancel(futures)

    def readable(self, named, closed):
        """(key, curve) of those that can be sent; the others fail here."""
        for key, given in named:
            self._order.append(key)
            try:
                points, ring = _fits._one(given, _FUNCTION, "points", closed)
            except Error as error:
                self._errors[key] = error
            else:
                yield key, (points.copy(), ring)  # whoever yields curves may fill one array again and again

    def send(self, task):
        """Send (key, curve) pairs as one task, once there is room; fetch what is done meanwhile."""
        self._count_workers()
        while self._in_flight and (len(self._in_flight) >= self._most or self._completed.has_ready()):
            self._fetch()
        self._completed.add(self._submit(task))

    def finish(self):
        """Fetch all that is in flight. Then try curves of tasks that Dask gave up, one at a time, with nothing beside
        them: which of a task's curves, or of a worker's tasks, ended the worker, nobody can tell before."""
        while self._in_flight:
            self._fetch()
        for key, curve in self._suspects:
            future = self._submit([(key, curve)])
            try:
                [result] = future.result()
            except self._killed as error:
                result = error
            del self._in_flight[future.key]
            self._take(key, result)
            self._tell()
        self._tell()

    def fits(self):
        models = {key: self._models[key] for key in self._order if key in self._models}
        return Fits(models, [Failure(key, self._errors[key]) for key in self._order if key in self._errors])

    def _count_workers(self):
        if self._sent >= self._recount:
            threads = sum(self._client.nthreads().values())
            self._most = max(_LEAST_TASKS, _TASKS_A_THREAD * threads)
            self._recount = self._sent + self._most

    def _submit(self, task):
        """Curves go with the task, to the scheduler: data scattered to a worker would die with it. Keys that are tuples
        make one group of all tasks, which the scheduler hands out a few at a time."""
        future = self._client.submit(_fitted, [curve for _, curve in task], self._options, key=(self._name, self._sent))
        self._sent += 1
        self._in_flight[future.key] = future, task
        return future

    def _fetch(self):
        """Wait for a task, whichever is done first, and take what it found."""
        future = next(self._completed)
        _, task = self._in_flight[future.key]
        try:
            results = future.result()
        except self._killed:
            self._suspects += task
        else:
            for (key, _), result in zip(task, results):
                self._take(key, result)
        del self._in_flight[future.key]
        self._tell()

    def _take(self, key, result):
        if isinstance(result, Exception):
            self._errors[key] = result
        else:
            self._models[key] = Model.from_bytes(result)

    def _tell(self):
        self._told(len(self._models) + len(self._errors))


def _fitted(curves, options):
    """On a worker: of each curve its model as CBOR, or the error."""
    return [_outcome(points, closed, options) for points, closed in curves]


def _outcome(points, closed, options):
    try:
        return _fits.fit(points, closed=closed, threads=1, **options).to_bytes()
    except (Error, MemoryError) as error:
        return error


def _tasks(curves):
    """Lists of (key, curve), each of about as much work; a long curve is a task of its own, or ends one."""
    task, size = [], 0
    for key, (points, closed) in curves:
        task.append((key, (points, closed)))
        size += _CURVE_POINTS + len(points)
        if size >= _TASK_POINTS:
            yield task
            task, size = [], 0
    if task:
        yield task


def _named(curves):
    """(iterator of (key, curve), how many or None)."""
    told = getattr(curves, "__geo_interface__", curves)
    if isinstance(told, dict) and isinstance(told.get("type"), str):
        curves = list(_curves._lines(told, _FUNCTION, "curves"))
    if isinstance(curves, collections.abc.Mapping):
        return iter(curves.items()), len(curves)
    if isinstance(curves, (str, bytes)) or not isinstance(curves, collections.abc.Iterable):
        raise invalid_type(_FUNCTION, "curves", curves, "curves: a list, an iterator, a dict, or a geometry")
    _fits.refuse_one_curve(curves, _FUNCTION)
    return enumerate(curves), len(curves) if isinstance(curves, collections.abc.Sized) else None


def _checked(**options):
    """Options as the workers get them; refuses those that would fail with every curve, as far as one can know here."""
    _fits._start(options["filter"], options["control_points"], options["maps"], _FUNCTION)
    _arrays.choice(options["distance"], DISTANCES, _FUNCTION, "distance")
    if options["budget"] is not None:
        _arrays.whole(options["budget"], _FUNCTION, "budget")
    return options


def _distributed():
    try:
        import distributed
    except ImportError as error:
        raise ImportError("ifsm.batch needs Dask: pip install ifsm[batch]") from error
    return distributed


def _require_synchronous(client, distributed):
    if not isinstance(client, distributed.Client):
        raise invalid_type(_FUNCTION, "client", client, "a distributed.Client")
    if client.asynchronous:
        raise invalid_value(_FUNCTION, "client", "client is asynchronous; give one that is not.")


@contextlib.contextmanager
def _telling(progress, total):
    """What is called with the number of curves done: it tells `progress`, moves a bar for True, or does nothing."""
    if progress is None or progress is False:
        yield lambda done: None
    elif progress is True:
        try:
            from tqdm.auto import tqdm
        except ImportError:
            yield lambda done: None
            return
        with tqdm(total=total, unit="curve") as bar:
            yield lambda done: bar.update(done - bar.n)
    elif callable(progress):
        def tell(done):
            if progress(done, total):
                raise Cancelled(f"progress returned true after {done} curves.", Status.CANCELLED, _FUNCTION, "progress")
        yield tell
    else:
        raise invalid_type(_FUNCTION, "progress", progress, "True, False or a callable of (done, total)")
