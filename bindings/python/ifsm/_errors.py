"""Exceptions: what the C library's error record tells, as Python people expect it."""
import enum
import math
import re

from . import _native


class Status(enum.IntEnum):
    """What kind of thing went wrong; the numbers are those of ifsm.h and never change."""

    INVALID_HANDLE = _native.IFSM_ERROR_INVALID_HANDLE
    NULL = _native.IFSM_ERROR_NULL
    RANGE = _native.IFSM_ERROR_RANGE
    NOT_FINITE = _native.IFSM_ERROR_NOT_FINITE
    SHAPE = _native.IFSM_ERROR_SHAPE
    SINGULAR = _native.IFSM_ERROR_SINGULAR
    CAPACITY = _native.IFSM_ERROR_CAPACITY
    OPTIONS = _native.IFSM_ERROR_OPTIONS
    FORMAT = _native.IFSM_ERROR_FORMAT
    VERSION = _native.IFSM_ERROR_VERSION
    LIMIT = _native.IFSM_ERROR_LIMIT
    CANCELLED = _native.IFSM_ERROR_CANCELLED
    BUSY = _native.IFSM_ERROR_BUSY
    MEMORY = _native.IFSM_ERROR_MEMORY
    NUMERICAL = _native.IFSM_ERROR_NUMERICAL
    INTERNAL = _native.IFSM_ERROR_INTERNAL


class Error(Exception):
    """Anything that ifsm refuses or fails at. ``str(error)`` is a sentence that says what to do.

    Attributes
    ----------
    code : Status or None
        What kind of thing went wrong; None when Python alone can know, that is, for wrong types.
    function : str
        The function that refused, by its C or Python name.
    argument : str
        The argument to blame, or ``""``.
    index : int or None
        The position in it. Of arrays of points the number of the double: ``divmod(index, dimension)`` is point and
        coordinate.
    value : float or None
        The offending value.
    required : int or None
        What a count must be.
    """

    def __init__(self, message, code=None, function="", argument="", index=None, value=None, required=None):
        super().__init__(message)
        self.code = code
        self.function = function
        self.argument = argument
        self.index = index
        self.value = value
        self.required = required

    def __reduce__(self):
        return type(self), (*self.args, self.code, self.function, self.argument, self.index, self.value, self.required)


class InvalidValue(Error, ValueError):
    """An argument of the right type whose value, shape or size will not do."""


class InvalidType(Error, TypeError):
    """An argument of a type that will not do."""


class Closed(InvalidValue):
    """An object was used after its ``close()``."""


class Cancelled(Error):
    """A progress callback returned true, or a cancel token was used."""


class Busy(Error, RuntimeError):
    """A deformer is being used by another thread."""


class OutOfMemory(Error, MemoryError):
    """There was not enough memory; everything is as it was before the call."""


class NumericalError(Error, ArithmeticError):
    """The numbers left the range of doubles, or no answer was found."""


class InternalError(Error, RuntimeError):
    """A fault of ifsm: please report it."""


_CLASSES = {
    Status.INVALID_HANDLE: Closed,
    Status.CANCELLED: Cancelled,
    Status.BUSY: Busy,
    Status.MEMORY: OutOfMemory,
    Status.NUMERICAL: NumericalError,
    Status.INTERNAL: InternalError,
}
_WRONG_TYPE = -1
# What texts of the C library recommend.
_IN_PYTHON = {"ifsm_model_create": "ifsm.Model", "ifsm_filter_from_maps": "ifsm.Filter.from_maps"}


def _make(status, function, argument, index, value, required, message):
    known = None if index < 0 else index
    given = None if math.isnan(value) and status != Status.NOT_FINITE else value
    wanted = None if required < 0 else required
    if status == _WRONG_TYPE:
        return InvalidType(message, None, function, argument, known, given, wanted)
    code = Status(status)
    for name, here in _IN_PYTHON.items():
        message = message.replace(name, here)
    return _CLASSES.get(code, InvalidValue)(message, code, function, argument, known, given, wanted)


_native.set_error_maker(_make)


class naming:
    """Errors of the C library name its arguments; in here they name Python's: ``with naming(level="levels"): …``."""

    __slots__ = ("_names",)

    def __init__(self, **names):
        self._names = names

    def __enter__(self):
        return self

    def __exit__(self, kind, error, _):
        if isinstance(error, Error):
            rename(error, self._names)


def rename(error, names):
    """Let `error` blame another argument, in its text as well."""
    told, rest = re.match(r"(\w*)(.*)", error.argument, re.S).groups()
    if told in names:
        error.argument = names[told] + rest
        error.args = (re.sub(rf"^{told}\b|\b{told}(?=\[)", names[told], error.args[0]), *error.args[1:])
    return error


def of_one(error):
    """`error` of an array of one element that was given as a number."""
    error.index = None
    error.args = (error.args[0].replace(f"{error.argument}[0]", error.argument, 1), *error.args[1:])
    return error


def invalid_type(function, argument, given, wanted):
    """The exception for an argument of a wrong type; `wanted` says what to give."""
    return InvalidType(f"{argument} is {_described(given)}; give {wanted}.", None, function, argument)


def invalid_value(function, argument, message, code=Status.RANGE, **told):
    return InvalidValue(message, code, function, argument, **told)


def _described(given):
    if given is None:
        return "None"
    kind = type(given).__name__
    kind = f"{'an' if kind[0].lower() in 'aeiou' else 'a'} {kind}"
    try:
        text = repr(given)
    except Exception:  # whatever a stranger's repr does
        return kind
    return f"{text} ({kind})" if len(text) <= 40 else kind
