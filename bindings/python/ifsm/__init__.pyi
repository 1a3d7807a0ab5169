import enum
import logging
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, Literal, NamedTuple, NoReturn, Protocol, SupportsFloat, SupportsIndex, overload

import numpy as np
from numpy.typing import NDArray
from typing_extensions import Self, TypeAlias

from . import batch as batch, plot as plot, systems as systems

__all__ = [
    "Ball", "Budget", "Busy", "Cancelled", "Closed", "Crossings", "Deformer", "Dimension", "Distances", "Error", "Filter",
    "Fit", "FitReport", "InternalError", "InvalidType", "InvalidValue", "Known", "Model", "Nearest", "NumericalError",
    "OutOfMemory", "PictureReport", "Spectrum", "Status", "System", "TrainReport", "curves", "fit", "fit_curve",
    "fit_filter", "fit_sparse", "load", "log_to", "set_threads", "systems", "threads", "tone_map", "train",
]

__version__: str

# ---- what is given -----------------------------------------------------------------------------------------------
# numpy.typing.ArrayLike takes any str; these take numbers alone.

_Number: TypeAlias = np.floating[Any] | np.integer[Any]

class _HasArray(Protocol):
    def __array__(self) -> NDArray[_Number]: ...

class _Rows(Protocol):
    """Lists and tuples of numbers, nested or not. No str, which contains nothing but str; no dict, which cannot count."""

    def __len__(self) -> int: ...
    def __contains__(self, value: object, /) -> bool: ...
    def __getitem__(self, index: int, /) -> float | _HasArray | _Rows: ...
    def count(self, value: Any, /) -> int: ...

class _Readable(Protocol):
    def read(self) -> bytes: ...

class _HasGeoInterface(Protocol):
    @property
    def __geo_interface__(self) -> Mapping[str, Any]: ...

_Int: TypeAlias = SupportsIndex
_Float: TypeAlias = SupportsFloat | SupportsIndex
_Array: TypeAlias = _HasArray | _Rows
_Geometry: TypeAlias = _HasGeoInterface | dict[str, Any]
_Points: TypeAlias = _Array | _Geometry
_Curves: TypeAlias = Iterable[_Points | tuple[_Points, bool]]
_Integers: TypeAlias = SupportsIndex | Sequence[SupportsIndex] | NDArray[np.integer[Any]]
_Doubles: TypeAlias = NDArray[np.float64]
_Progress: TypeAlias = bool | Callable[[float, str], object] | None
_Path: TypeAlias = str | os.PathLike[str]

_JoinedName: TypeAlias = Literal["coast", "casteljau", "koch", "takagi"]
_FilterName: TypeAlias = Literal[_JoinedName, "haar", "bspline", "four-point"]
_Topology: TypeAlias = Literal["joined", "square"]
_Frame: TypeAlias = Literal["absolute", "node"]
_Distance: TypeAlias = Literal["rms", "largest", "hausdorff"]
_Resolve: TypeAlias = Literal["none", "values", "choice"]
_Format: TypeAlias = Literal["json", "cbor"]
_SystemFormat: TypeAlias = Literal["json", "cbor", "fractint"]
_Turning: TypeAlias = Literal["similarity", "rotation", "linear"]
_Follow: TypeAlias = Literal["moved", "each", "none"]
_Colour: TypeAlias = str | Sequence[SupportsIndex] | NDArray[np.integer[Any]]
_Palette: TypeAlias = (
    Literal["dusk", "sea", "fern", "ember", "ink"] | list[Any] | tuple[Any, ...] | NDArray[np.integer[Any]]
)

# ---- errors ------------------------------------------------------------------------------------------------------

class Status(enum.IntEnum):
    INVALID_HANDLE = 1
    NULL = 2
    RANGE = 3
    NOT_FINITE = 4
    SHAPE = 5
    SINGULAR = 6
    CAPACITY = 7
    OPTIONS = 8
    FORMAT = 9
    VERSION = 10
    LIMIT = 11
    CANCELLED = 12
    BUSY = 13
    MEMORY = 14
    NUMERICAL = 15
    INTERNAL = 16

class Error(Exception):
    code: Status | None
    function: str
    argument: str
    index: int | None
    value: float | None
    required: int | None

    def __init__(
        self,
        message: str,
        code: Status | None = None,
        function: str = "",
        argument: str = "",
        index: int | None = None,
        value: float | None = None,
        required: int | None = None,
    ) -> None: ...

class InvalidValue(Error, ValueError): ...
class InvalidType(Error, TypeError): ...
class Closed(InvalidValue): ...
class Cancelled(Error): ...
class Busy(Error, RuntimeError): ...
class OutOfMemory(Error, MemoryError): ...
class NumericalError(Error, ArithmeticError): ...
class InternalError(Error, RuntimeError): ...

# ---- filters -----------------------------------------------------------------------------------------------------

class _Handled:
    def close(self) -> None: ...
    def __enter__(self) -> Self: ...
    def __exit__(self, *_: object) -> None: ...

class Filter(_Handled):
    def __init__(
        self, name: _FilterName, *, topology: _Topology = "joined", control_points: _Int = 0, maps: _Int = 0
    ) -> None: ...
    @classmethod
    def from_matrix(
        cls, matrix: _Array, *, control_points: _Int, maps: _Int, topology: _Topology = "joined", stride: _Int = 0
    ) -> Self: ...
    @classmethod
    def from_maps(
        cls, matrix: _Array, *, control_points: _Int, maps: _Int, topology: _Topology = "joined", stride: _Int = 0
    ) -> Self: ...
    @property
    def topology(self) -> _Topology: ...
    @property
    def control_points(self) -> int: ...
    @property
    def maps(self) -> int: ...
    @property
    def stride(self) -> int: ...
    @property
    def details_per_node(self) -> int: ...
    @property
    def contractive(self) -> bool | None: ...
    @property
    def condition(self) -> float: ...
    @property
    def matrix(self) -> _Doubles: ...
    def __eq__(self, other: object) -> bool: ...
    def __hash__(self) -> int: ...
    def __copy__(self) -> Self: ...
    def __deepcopy__(self, memo: dict[int, Any]) -> Self: ...

# ---- models ------------------------------------------------------------------------------------------------------

class Distances(NamedTuple):
    rms: float
    largest: float
    farthest: int
    hausdorff: float

class Nearest(NamedTuple):
    parameters: _Doubles
    distances: _Doubles
    points: _Doubles

class Crossings(NamedTuple):
    first: _Doubles
    last: _Doubles
    points: _Doubles

class Dimension(NamedTuple):
    dimension: float
    standard_error: float
    r_squared: float
    scales: _Doubles
    counts: _Doubles

class Spectrum(NamedTuple):
    hurst: float
    standard_error: float
    r_squared: float
    dimension: float
    first: int
    last: int
    scales: _Doubles
    rms: _Doubles

class Model(_Handled):
    def __init__(
        self, points: _Points, filter: _FilterName | Filter = "coast", *, closed: bool | None = None, levels: _Int = 0
    ) -> None: ...
    @classmethod
    def from_polygon(
        cls, points: _Array, filter: _FilterName | Filter = "casteljau", *, levels: _Int, closed: bool = False
    ) -> Self: ...
    @property
    def dimension(self) -> int: ...
    @property
    def closed(self) -> bool: ...
    @property
    def levels(self) -> int: ...
    @property
    def sample_count(self) -> int: ...
    @property
    def place_count(self) -> int: ...
    @property
    def detail_count(self) -> int: ...
    @property
    def details_kept(self) -> int: ...
    @property
    def diagonal(self) -> float: ...
    @property
    def filter(self) -> Filter: ...
    @property
    def control_points(self) -> _Doubles: ...
    @property
    def __geo_interface__(self) -> dict[str, Any]: ...
    def __call__(self, t: _Float | _Array, *, curve: Literal["polyline", "limit"] = "polyline") -> _Doubles: ...
    def samples(self, *, out: _Doubles | None = None) -> _Doubles: ...
    def points(
        self, *, levels: _Int | None = None, details: _Int | None = None, out: _Doubles | None = None
    ) -> _Doubles: ...
    def parameters(self) -> _Doubles: ...
    def address(self, t: _Float, length: _Int) -> NDArray[np.int32]: ...
    def interval(self, symbols: _Integers) -> tuple[float, float]: ...
    def details(self, level: _Int, *, frame: _Frame = "absolute") -> _Doubles: ...
    def significance(self, level: _Int) -> _Doubles: ...
    @overload
    def keep(
        self,
        *,
        details: _Int,
        levels: None = None,
        above: None = None,
        within: None = None,
        levels_within: None = None,
        distance: _Distance = "rms",
        resolve: _Resolve | None = None,
        progress: _Progress = None,
    ) -> Model: ...
    @overload
    def keep(
        self,
        *,
        details: None = None,
        levels: _Int,
        above: None = None,
        within: None = None,
        levels_within: None = None,
        distance: _Distance = "rms",
        resolve: _Resolve | None = None,
        progress: _Progress = None,
    ) -> Model: ...
    @overload
    def keep(
        self,
        *,
        details: None = None,
        levels: None = None,
        above: _Float,
        within: None = None,
        levels_within: None = None,
        distance: _Distance = "rms",
        resolve: _Resolve | None = None,
        progress: _Progress = None,
    ) -> Model: ...
    @overload
    def keep(
        self,
        *,
        details: None = None,
        levels: None = None,
        above: None = None,
        within: _Float,
        levels_within: None = None,
        distance: _Distance = "rms",
        resolve: _Resolve | None = None,
        progress: _Progress = None,
    ) -> Model: ...
    @overload
    def keep(
        self,
        *,
        details: None = None,
        levels: None = None,
        above: None = None,
        within: None = None,
        levels_within: _Float,
        distance: _Distance = "rms",
        resolve: _Resolve | None = None,
        progress: _Progress = None,
    ) -> Model: ...
    def with_control_points(self, points: _Array, *, frame: _Frame = "node") -> Model: ...
    def with_details(self, level: _Int, vectors: _Array, *, frame: _Frame = "absolute") -> Model: ...
    def with_filter(self, filter: Filter) -> Model: ...
    def refine(
        self, levels: _Int = 1, *, seed: _Int = 0, learned: _Int = 0, roughness: _Float | None = None
    ) -> Model: ...
    def deformer(self, *, turning: _Turning = "similarity", follow: _Follow = "moved") -> Deformer: ...
    def length(self, start: _Float = 0.0, stop: _Float = 1.0) -> float: ...
    @overload
    def spaced(self, points: _Int, *, spacing: None = None) -> _Doubles: ...
    @overload
    def spaced(self, points: None = None, *, spacing: _Float) -> _Doubles: ...
    def nearest(self, queries: _Array) -> Nearest: ...
    def distance(self, other: Model) -> Distances: ...
    @overload
    def curvature(self, t: float | _Number, scale: _Float) -> float: ...
    @overload
    def curvature(self, t: _Rows | NDArray[_Number], scale: _Float) -> _Doubles: ...
    @overload
    def curvature(self, t: _HasArray, scale: _Float) -> Any: ...
    def crossings(self) -> Crossings: ...
    def fractal_dimension(
        self,
        method: Literal["boxes", "divider"] = "boxes",
        *,
        scales: _Int = 0,
        smallest: _Float = 0.0,
        largest: _Float = 0.0,
    ) -> Dimension: ...
    def spectrum(self) -> Spectrum: ...
    def to_bytes(self, format: _Format = "cbor") -> bytes: ...
    @classmethod
    def from_bytes(cls, data: bytes | bytearray | memoryview) -> Self: ...
    def save(self, path: _Path, *, format: _Format | None = None) -> None: ...
    @classmethod
    def load(cls, path: _Path) -> Self: ...
    def __eq__(self, other: object) -> bool: ...
    def __hash__(self) -> int: ...
    def __copy__(self) -> Self: ...
    def __deepcopy__(self, memo: dict[int, Any]) -> Self: ...

# ---- deformers ---------------------------------------------------------------------------------------------------

class Deformer(_Handled):
    def __init__(self, model: Model, *, turning: _Turning = "similarity", follow: _Follow = "moved") -> None: ...
    @property
    def model(self) -> Model: ...
    @property
    def undoable(self) -> int: ...
    @property
    def redoable(self) -> int: ...
    @property
    def edits(self) -> int: ...
    @property
    def span(self) -> tuple[float, float]: ...
    def move(
        self,
        level: _Int,
        handles: _Integers,
        vectors: _Array,
        *,
        places: bool = False,
        reach: Literal["nodes", "curve"] = "nodes",
        falloff: Literal["none", "linear", "smooth"] = "none",
        ruler: Literal["handles", "length"] = "handles",
        radius: _Float = 0.0,
    ) -> Self: ...
    def pin(self, level: _Int, handles: _Integers) -> Self: ...
    def release(self, level: _Int, handles: _Integers) -> Self: ...
    def drag(
        self,
        level: _Int,
        t: _Float | _Array,
        places: _Array,
        *,
        lead: Literal["handles", "details"] = "handles",
    ) -> Self: ...
    def restyle(
        self,
        first: _Int,
        last: _Int,
        scale: _Float = 1.0,
        *,
        angle: _Float = 0.0,
        mirror: _Int = 0,
        fade: _Int = 0,
    ) -> Self: ...
    def texture(
        self,
        first: _Int,
        last: _Int,
        source: Model | None = None,
        *,
        roughness: _Float = 0.0,
        size: _Float = 0.0,
        seed: _Int = 0,
        fade: _Int = 0,
    ) -> Self: ...
    def undo(self) -> Self: ...
    def redo(self) -> Self: ...
    def keep_as(self, name: str) -> Self: ...
    def go_to(self, name: str) -> Self: ...
    def time(
        self, begin: _Float, end: _Float, easing: Literal["smooth", "linear", "in", "out"] = "smooth"
    ) -> Self: ...
    def at_time(self, time: _Float) -> Deformer: ...
    def to_bytes(self, format: _Format = "cbor") -> bytes: ...
    def replay(self, data: bytes | bytearray | memoryview) -> Self: ...
    def __call__(self, t: _Float | _Array) -> _Doubles: ...
    def samples(self, *, out: _Doubles | None = None) -> _Doubles: ...
    def points(
        self, level: _Int | None = None, *, first: _Int = 0, count: _Int | None = None, out: _Doubles | None = None
    ) -> _Doubles: ...
    def changed(self, level: _Int) -> tuple[int, int]: ...
    def crossings(self) -> Crossings: ...
    def snapshot(self) -> Model: ...
    def __copy__(self) -> Deformer: ...
    def __deepcopy__(self, memo: dict[int, Any]) -> Deformer: ...

# ---- systems -----------------------------------------------------------------------------------------------------

class Ball(NamedTuple):
    centre: _Doubles
    radius: float

class PictureReport(NamedTuple):
    window: tuple[float, float, float, float]
    width: int
    height: int
    points: int
    inside: int
    met: int
    undecided: int

class System(_Handled):
    def __init__(self, maps: _Array, weights: _Array | None = None) -> None: ...
    @overload
    @classmethod
    def from_parameters(
        cls,
        parameters: _Array,
        *,
        angles: None = None,
        scales: None = None,
        shears: None = None,
        shifts: None = None,
        weights: _Array | None = None,
    ) -> Self: ...
    @overload
    @classmethod
    def from_parameters(
        cls,
        parameters: None = None,
        *,
        angles: _Array | None = None,
        scales: _Array | _Float | None = None,
        shears: _Array | None = None,
        shifts: _Array,
        weights: _Array | None = None,
    ) -> Self: ...
    @classmethod
    def named(cls, name: str) -> Self: ...
    @classmethod
    def from_model(cls, model: Model) -> Self: ...
    @property
    def dimension(self) -> int: ...
    @property
    def maps(self) -> _Doubles: ...
    @property
    def probabilities(self) -> _Doubles: ...
    @property
    def parameters(self) -> _Doubles: ...
    @property
    def fixed_points(self) -> _Doubles: ...
    @property
    def contractive(self) -> bool | None: ...
    @property
    def witness(self) -> NDArray[np.int32] | None: ...
    @property
    def radius(self) -> float | None: ...
    def word(self, symbols: _Integers) -> _Doubles: ...
    def point(self, symbols: _Integers, *, period: _Int | None = None) -> _Doubles: ...
    def addresses(self, point: _Array, length: _Int, *, tolerance: _Float = 0.0) -> NDArray[np.int32]: ...
    def box(self, tolerance: _Float | None = None) -> _Doubles: ...
    def ball(self, tolerance: _Float | None = None) -> Ball: ...
    def diameter(self, tolerance: _Float | None = None) -> float: ...
    def moments(self, degree: _Int, *, about: _Array | None = None) -> dict[tuple[int, ...], float]: ...
    def similarity_dimension(self) -> float: ...
    def box_dimension(self, finest: _Int | None = None) -> Dimension: ...
    def model(self, *, levels: _Int, topology: _Topology = "square", polygon: _Array | None = None) -> Model: ...
    @overload
    def histogram(
        self,
        size: _Integers = 1024,
        *,
        window: _Array | None = None,
        points: _Int | None = None,
        seed: _Int = 0,
        threads: _Int = 0,
        full: Literal[False] = False,
        progress: _Progress = None,
    ) -> NDArray[np.uint32]: ...
    @overload
    def histogram(
        self,
        size: _Integers = 1024,
        *,
        window: _Array | None = None,
        points: _Int | None = None,
        seed: _Int = 0,
        threads: _Int = 0,
        full: Literal[True],
        progress: _Progress = None,
    ) -> tuple[NDArray[np.uint32], PictureReport]: ...
    @overload
    def set(
        self,
        size: _Integers = 1024,
        *,
        window: _Array | None = None,
        tolerance: _Float = 0.0,
        threads: _Int = 0,
        full: Literal[False] = False,
        progress: _Progress = None,
    ) -> NDArray[np.uint8]: ...
    @overload
    def set(
        self,
        size: _Integers = 1024,
        *,
        window: _Array | None = None,
        tolerance: _Float = 0.0,
        threads: _Int = 0,
        full: Literal[True],
        progress: _Progress = None,
    ) -> tuple[NDArray[np.uint8], PictureReport]: ...
    @overload
    def distances(
        self,
        size: _Integers = 1024,
        *,
        window: _Array | None = None,
        tolerance: _Float = 0.0,
        threads: _Int = 0,
        full: Literal[False] = False,
        progress: _Progress = None,
    ) -> _Doubles: ...
    @overload
    def distances(
        self,
        size: _Integers = 1024,
        *,
        window: _Array | None = None,
        tolerance: _Float = 0.0,
        threads: _Int = 0,
        full: Literal[True],
        progress: _Progress = None,
    ) -> tuple[_Doubles, PictureReport]: ...
    @overload
    def render(
        self,
        size: _Integers = 1024,
        *,
        window: _Array | None = None,
        colour: Literal["tone", "symbol", "address", "set", "distance"] = "tone",
        palette: _Palette = "dusk",
        symbols: _Int = 0,
        background: _Colour | None = None,
        points: _Int | None = None,
        seed: _Int = 0,
        oversample: _Int = 0,
        tolerance: _Float = 0.0,
        azimuth: _Float = 0.0,
        elevation: _Float = 0.0,
        field: _Float = 0.0,
        threads: _Int = 0,
        full: Literal[False] = False,
        progress: _Progress = None,
    ) -> NDArray[np.uint8]: ...
    @overload
    def render(
        self,
        size: _Integers = 1024,
        *,
        window: _Array | None = None,
        colour: Literal["tone", "symbol", "address", "set", "distance"] = "tone",
        palette: _Palette = "dusk",
        symbols: _Int = 0,
        background: _Colour | None = None,
        points: _Int | None = None,
        seed: _Int = 0,
        oversample: _Int = 0,
        tolerance: _Float = 0.0,
        azimuth: _Float = 0.0,
        elevation: _Float = 0.0,
        field: _Float = 0.0,
        threads: _Int = 0,
        full: Literal[True],
        progress: _Progress = None,
    ) -> tuple[NDArray[np.uint8], PictureReport]: ...
    def sample(
        self, points: _Int = 65536, *, seed: _Int = 0, threads: _Int = 0, progress: _Progress = None
    ) -> _Doubles: ...
    def sample_addresses(
        self, points: _Int, length: _Int, *, seed: _Int = 0, threads: _Int = 0, progress: _Progress = None
    ) -> NDArray[np.int32]: ...
    def to_bytes(self, format: _SystemFormat = "cbor", *, name: str | None = None) -> bytes: ...
    @classmethod
    def from_bytes(cls, data: bytes | bytearray | memoryview, *, name: str | None = None) -> Self: ...
    def save(self, path: _Path, *, format: _SystemFormat | None = None) -> None: ...
    @classmethod
    def load(cls, file: _Path | _Readable, name: str | None = None) -> Self: ...
    @staticmethod
    def file_names(file: _Path | _Readable) -> list[str]: ...
    def __eq__(self, other: object) -> bool: ...
    def __hash__(self) -> int: ...
    def __copy__(self) -> Self: ...
    def __deepcopy__(self, memo: dict[int, Any]) -> Self: ...

def tone_map(counts: _Array, *, palette: _Palette = "dusk", background: _Colour | None = None) -> NDArray[np.uint8]: ...

# ---- fits --------------------------------------------------------------------------------------------------------

class Budget(NamedTuple):
    budget: int
    details: int
    start_rms: float
    start_max: float
    rms: float
    max: float
    start_details: int

class FitReport(NamedTuple):
    stage: Literal["sparse", "curve", "filter"]
    reason: Literal["converged", "iterations", "start best"]
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
    reason: Literal["converged", "rounds", "start best"]
    trained: int
    held_out: int
    sketches: int
    rounds: int
    iterations: int
    ratio: float
    held_out_ratio: float

class Known:
    def __init__(
        self,
        *,
        parameters: _Array | None = None,
        weights: _Array | None = None,
        covariances: _Array | None = None,
        through: Iterable[tuple[float, _Array]] = (),
        along: Iterable[tuple[int, _Array]] = (),
        fixed_ends: bool = False,
    ) -> None: ...

class Fit(_Handled):
    def __init__(self) -> NoReturn: ...
    @property
    def report(self) -> FitReport: ...
    @property
    def filter(self) -> Filter: ...
    def model(self, curve: _Int = 0) -> Model: ...
    def sketch(self, curve: _Int = 0, budget: _Int = 0) -> Model: ...
    def budget(self, curve: _Int = 0, budget: _Int = 0) -> Budget: ...
    def parameters(self, curve: _Int = 0) -> _Doubles: ...
    def covariance(self, curve: _Int = 0) -> _Doubles: ...
    def filter_covariance(self) -> _Doubles: ...
    def curve_covariance(self, t: _Float | _Array, curve: _Int = 0) -> _Doubles: ...

def fit(
    points: _Points,
    *,
    closed: bool | None = None,
    control_points: _Int | None = None,
    maps: _Int | None = None,
    filter: _JoinedName | Filter | None = None,
    budget: _Int | None = None,
    within: _Float | None = None,
    distance: _Distance = "rms",
    iterations: _Int = 0,
    threads: _Int = 0,
    progress: _Progress = None,
) -> Model: ...
def fit_sparse(
    curves: _Curves,
    *,
    control_points: _Int | None = None,
    maps: _Int | None = None,
    filter: _JoinedName | Filter | None = None,
    budgets: _Integers | None = None,
    within: _Float | None = None,
    distance: _Distance = "rms",
    iterations: _Int = 0,
    rounds: _Int = 0,
    polish: _Int = 0,
    threads: _Int = 0,
    progress: _Progress = None,
) -> Fit: ...
def fit_curve(
    curves: _Curves,
    *,
    control_points: _Int | None = None,
    maps: _Int | None = None,
    filter: _JoinedName | Filter | None = None,
    fixed_filter: bool = False,
    parameters: Literal["index", "chord", "centripetal", "given"] = "index",
    reparameterise: _Int = 0,
    loss: Literal["squares", "huber", "cauchy", "tukey"] = "squares",
    loss_scale: _Float = 0.0,
    levels: _Int = 0,
    starts: _Int = 0,
    iterations: _Int = 0,
    tolerance: _Float = 0.0,
    known: Iterable[Known | None] | None = None,
    threads: _Int = 0,
    progress: _Progress = None,
) -> Fit: ...
def fit_filter(
    curves: _Curves,
    *,
    control_points: _Int | None = None,
    maps: _Int | None = None,
    filter: _JoinedName | Filter | None = None,
    kept_levels: _Int = 0,
    iterations: _Int = 0,
    tolerance: _Float = 0.0,
    threads: _Int = 0,
    progress: _Progress = None,
) -> Fit: ...
def train(
    curves: _Curves,
    *,
    control_points: _Int | None = None,
    maps: _Int | None = None,
    filter: _JoinedName | Filter | None = None,
    budgets: _Integers | None = None,
    hold_out: _Int = 0,
    rounds: _Int = 0,
    iterations: _Int = 0,
    condition: _Float = 0.0,
    reach: _Float = 0.0,
    threads: _Int = 0,
    progress: _Progress = None,
) -> tuple[Filter, TrainReport]: ...

# ---- the rest ----------------------------------------------------------------------------------------------------

def curves(geometry: _Geometry) -> list[tuple[_Doubles, bool]]: ...
def load(path: _Path) -> Model: ...
def threads() -> int: ...
def set_threads(count: _Int) -> None: ...
def log_to(logger: str | logging.Logger | logging.LoggerAdapter[Any] | None = "ifsm") -> None: ...
