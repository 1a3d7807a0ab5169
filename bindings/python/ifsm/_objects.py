"""What all objects of the library have in common: one handle, closed once."""
from ._errors import Closed, Status, invalid_type


class Handled:
    """Owns what it names. ``close()``, or leaving a ``with``, gives it up at once; else it goes with the object."""

    __slots__ = ("_native", "__weakref__")

    def __new__(cls, *_, **__):
        self = object.__new__(cls)
        self._native = None  # until it is made: a subclass may forget to
        return self

    def close(self):
        """Give the object's memory back. Calls that run in other threads finish; later ones raise `Closed`."""
        self._native = None

    def __enter__(self):
        self._held()
        return self

    def __exit__(self, *_):
        self.close()

    def _held(self):
        native = self._native
        if native is None:
            name = type(self).__name__
            raise Closed(f"This {name} was closed, or never made: make a new one.", Status.INVALID_HANDLE, f"ifsm.{name}", "self")
        return native


def native_of(given, kind, function, argument):
    """The handle of an argument that must be a `kind`."""
    if not isinstance(given, kind):
        raise invalid_type(function, argument, given, f"an ifsm.{kind.__name__}")
    if given._native is None:
        raise Closed(f"{argument} was closed; give one that is not.", Status.INVALID_HANDLE, function, argument)
    return given._native
