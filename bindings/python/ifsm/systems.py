"""Known iterated function systems, a function each: those of the library's catalog.

>>> ifsm.systems.fern()
<ifsm.System of 4 maps in 2-D, contractive>
>>> ifsm.systems.names()[:3]
['fern_barnsley', 'gasket_right', 'gasket_right_overlapping']
>>> [entry.name for entry in ifsm.systems.catalog() if entry.dimension == 3]
['menger_sponge', 'cantor_dust_3d', 'tetrahedron', 'octahedron', 'fern_3d']

The best known of their kinds have short names: `fern`, `gasket`, `dragon`, `koch`, `levy`, `snowflake`, `sponge`.
"""
import difflib
import itertools
from typing import NamedTuple

from . import _native
from ._errors import InvalidValue
from ._systems import System

_SHORT = ("fern", "gasket", "dragon", "koch", "levy", "snowflake", "sponge")


class Entry(NamedTuple):
    """What the catalog says of a system."""

    name: str
    dimension: int
    source: str
    """A paper and its figure, or where it is found."""


def catalog():
    """All known systems: a list of `Entry`."""
    entries = []
    for index in itertools.count():
        try:
            told = _native.ifsm_system_catalog(index)
        except InvalidValue:  # past the last
            return entries
        entries.append(Entry(told.name, told.dimension, told.source))


def names():
    """The names of all known systems, as `System.named` takes them; the short ones are not among them."""
    return [entry.name for entry in catalog()]


def _maker(name, told):
    def make():
        return System.named(name)

    make.__name__ = make.__qualname__ = name
    make.__module__ = __name__
    make.__doc__ = told
    return make


for _entry in catalog():
    globals()[_entry.name] = _maker(_entry.name, f"The system {_entry.name}, {_entry.dimension}-D: {_entry.source}.")
for _name in _SHORT:
    globals()[_name] = _maker(_name, f"The best known system of its kind, {_name}.")
__all__ = ["Entry", "catalog", "names", *_SHORT, *names()]
del _entry, _name


def __getattr__(name):
    near = difflib.get_close_matches(name, __all__, 1)
    hint = f"did you mean {near[0]!r}?" if near else "names() lists those that there are"
    raise AttributeError(f"module {__name__!r} has no system {name!r}; {hint}")


def __dir__():
    return list(__all__)
