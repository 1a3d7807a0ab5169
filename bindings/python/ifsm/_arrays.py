"""Numbers in and out: whatever NumPy understands becomes what the C library reads, without a copy where it is that."""
import operator

import numpy as np

from ._errors import Status, invalid_type, invalid_value


def doubles(given, function, argument):
    """`given` as a C-contiguous array of float64: itself when it is one."""
    try:
        array = np.asarray(given)
    except (ValueError, TypeError):  # of ragged lists, and of objects that will not be arrays
        array = None
    except RecursionError:
        raise invalid_value(function, argument, f"{argument} is nested too deeply; give rows of numbers.",
                            Status.SHAPE) from None
    if array is None or array.dtype.kind not in "fiu":
        raise _not_numbers(given, array, function, argument)
    if np.ma.is_masked(given):
        index = int(np.flatnonzero(np.ma.getmaskarray(given))[0])
        raise invalid_value(function, argument, f"{argument}[{index}] is masked; remove it, or fill it with a number.",
                            index=index)
    array = np.asarray(array, dtype=np.float64, order="C")
    return array if array.flags.aligned else array.copy()


def _not_numbers(given, array, function, argument):
    if (array is None or array.dtype == object) and _is_ragged(given):
        return invalid_value(function, argument, f"{argument} has rows of different lengths; give as many numbers for each "
                             "point.", Status.SHAPE)
    columns = getattr(given, "dtypes", None)  # of a table of pandas
    if columns is not None and hasattr(columns, "items"):
        for name, dtype in columns.items():
            if getattr(dtype, "kind", "O") not in "fiu":
                return invalid_type(function, argument, given, f"real numbers: its column {name!r} is of dtype {dtype}")
    if array is not None and (array.dtype != object or isinstance(given, np.ndarray)):
        return invalid_type(function, argument, given, f"real numbers: its dtype is {array.dtype}"
                            + ("; .astype(float) converts it" if array.dtype == object else ""))
    return invalid_type(function, argument, given, "real numbers")


def is_true(given, function, argument):
    """A bool, of Python or NumPy, and nothing that is only like one."""
    if isinstance(given, (bool, np.bool_)):
        return bool(given)
    raise invalid_type(function, argument, given, "True or False")


def _is_ragged(given):
    if not isinstance(given, (list, tuple)):
        return False
    return len({len(row) if hasattr(row, "__len__") else 0 for row in given}) > 1


def table(given, function, argument, columns=None):
    """`given` as rows; a single row of numbers is one point when `columns` says how many it has."""
    array = doubles(given, function, argument)
    if array.ndim == 1 and columns is not None and array.shape[0] == columns:
        array = array.reshape(1, columns)
    if array.ndim == 1 and columns in (None, 1):
        array = array.reshape(-1, 1)
    if array.ndim != 2 or (columns is not None and array.shape[1] != columns):
        wanted = "(points, dimension)" if columns is None else f"(points, {columns})"
        raise invalid_value(function, argument, f"{argument} has the shape {array.shape}; give {wanted}.", Status.SHAPE)
    return array


def integers(given, function, argument, dtype):
    """Whole numbers, one or several, as a vector of `dtype`."""
    try:
        array = np.atleast_1d(np.asarray(given))
    except (ValueError, TypeError):
        raise invalid_type(function, argument, given, "integers") from None
    if array.size == 0:
        array = array.astype(dtype)
    if array.dtype.kind not in "iu" or array.ndim != 1:
        raise invalid_type(function, argument, given, "an integer or a list of them")
    limits = np.iinfo(dtype)
    for index in np.flatnonzero((array < limits.min) | (array > limits.max))[:1]:
        raise invalid_value(function, argument, f"{argument}[{index}] is {array[index]}; give one from {limits.min} to "
                            f"{limits.max}.",
                            index=int(index), value=float(array[index]))
    return np.ascontiguousarray(array, dtype=dtype)


def whole(given, function, argument):
    """An int, of anything that says it is one."""
    try:
        return operator.index(given)
    except TypeError:
        raise invalid_type(function, argument, given, "an integer") from None


def choice(given, choices, function, argument):
    """The number that a word stands for."""
    if isinstance(given, str) and given in choices:
        return choices[given]
    words = ", ".join(repr(word) for word in choices)
    if isinstance(given, str):
        raise invalid_value(function, argument, f"{argument} is {given!r}; give one of {words}.")
    raise invalid_type(function, argument, given, f"one of {words}")


def output(out, shape, function):
    """Where results go: a new array, or the caller's `out`, which must be exactly what would be new."""
    if out is None:
        return np.empty(shape)
    if not isinstance(out, np.ndarray):
        raise invalid_type(function, "out", out, "a NumPy array")
    if out.dtype != np.float64 or not out.flags.c_contiguous or not out.flags.writeable:
        raise invalid_value(function, "out", "out is not a writable C-contiguous array of float64; give one, or leave it "
                            "out.", Status.SHAPE)
    if out.shape != shape:
        raise invalid_value(function, "out", f"out has the shape {out.shape}; give {shape}.", Status.SHAPE,
                            required=int(np.prod(shape)))
    return out


def fetched(call, *arguments, columns=None, dtype=np.float64):
    """What a call writes whose size it tells itself: asked first, then filled."""
    values = np.empty(_count(call(*arguments, None)), dtype=dtype)
    call(*arguments, values)
    return values if columns is None else values.reshape(-1, columns)


def _count(told):
    return told[-1] if isinstance(told, (tuple, list)) else told
