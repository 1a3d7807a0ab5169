"""What systems are made from: rows of maps, parameters, files."""
import itertools
import os

import numpy as np

from . import _arrays
from ._errors import Error, Status, invalid_type, invalid_value
from ._models import as_bytes

NUMBERS = {2: 6, 3: 12}  # of a map, by dimension


def rows_of_maps(given, function):
    """(dimension, rows of one map each)."""
    maps = _arrays.doubles(given, function, "maps")
    if maps.ndim == 3 and maps.shape[1:] in ((2, 3), (3, 4)):
        maps = maps.reshape(len(maps), -1)
    return dimension_of(maps, function, "maps", "(maps, d, d + 1), or (maps, 6) or (maps, 12)"), maps


def dimension_of(rows, function, argument, wanted):
    for dimension, numbers in NUMBERS.items():
        if rows.ndim == 2 and rows.shape[1] == numbers and len(rows) > 0:
            return dimension
    raise invalid_value(function, argument, f"{argument} has the shape {rows.shape}; give {wanted}.", Status.SHAPE)


def rows_of_parameters(named, function):
    """Parameters in one array, of those that were given by name."""
    if named["shifts"] is None:
        raise invalid_type(function, "shifts", None, "one shift a map, an array of shape (maps, d)")
    shifts = _arrays.table(_finite(named["shifts"], function, "shifts"), function, "shifts")
    count, dimension = shifts.shape
    if dimension not in NUMBERS or count == 0:
        raise invalid_value(function, "shifts", f"shifts has the shape {shifts.shape}; give (maps, 2) or (maps, 3).",
                            Status.SHAPE)
    turns = 1 if dimension == 2 else 3
    columns = []
    for name, width, otherwise in (("angles", turns, 0.0), ("scales", dimension, 1.0), ("shears", turns, 0.0)):
        given = np.array(otherwise) if named[name] is None else _finite(named[name], function, name)
        if given.ndim == 1 and len(given) == count:
            given = given.reshape(count, 1)
        if given.shape not in ((), (count, width)) and (given.shape != (count, 1) or name != "scales"):
            raise invalid_value(function, name, f"{name} has the shape {given.shape}; give {(count, width)}, a row a map.",
                                Status.SHAPE)
        columns.append(np.broadcast_to(given, (count, width)))
    return np.ascontiguousarray(np.hstack([*columns, shifts]))


def _finite(given, function, argument):
    """C would find what is not, but under another name."""
    values = _arrays.doubles(given, function, argument)
    for index in np.flatnonzero(~np.isfinite(values))[:1]:
        raise invalid_value(function, argument, f"{argument}[{index}] is {values.flat[index]}; every value must be finite: "
                            "remove or replace it.", Status.NOT_FINITE, index=int(index), value=float(values.flat[index]))
    return values


def vector(given, count, function, argument, optional=False):
    """So many numbers; or None."""
    if given is None and optional:
        return None
    numbers = _arrays.doubles(given, function, argument)
    if numbers.shape != (count,):
        raise invalid_value(function, argument, f"{argument} has the shape {numbers.shape}; give {count} numbers.",
                            Status.SHAPE, required=count)
    return numbers


def powers(dimension, degree):
    """In C's order: degree by degree, powers of x falling, then those of y."""
    for sum_of_powers in range(degree + 1):
        for powers in itertools.product(range(sum_of_powers, -1, -1), repeat=dimension):
            if sum(powers) == sum_of_powers:
                yield powers


def of_file(file, read, function):
    """What `read` makes of a file's bytes; errors begin with its path."""
    if hasattr(file, "read"):
        return read(as_bytes(file.read(), function, "file"))
    if not isinstance(file, (str, bytes, os.PathLike)):
        raise invalid_type(function, "file", file, "a path, or a file open for reading bytes")
    with open(file, "rb") as opened:
        data = opened.read()
    try:
        return read(data)
    except Error as error:
        error.args = (f"{os.fsdecode(file)}: {error.args[0]}", *error.args[1:])
        raise
