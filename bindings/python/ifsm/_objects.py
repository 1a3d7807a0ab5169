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


class Immutable(Handled):
    """Never changes, so that it is its own copy. What there is to know of a new one, `_take` keeps."""

    __slots__ = ()

    @classmethod
    def _of(cls, native):
        self = cls.__new__(cls)
        self._take(native)
        return self

    def __copy__(self):
        return self

    def __deepcopy__(self, memo):
        return self


class Saved(Immutable):
    """Is what its bytes are: equal when they are, pickled as they. ``_take`` sets ``_hash`` to None."""

    __slots__ = ()

    def __init_subclass__(cls, **named):
        super().__init_subclass__(**named)
        if Saved in cls.__bases__:
            cls._kind = cls  # also of those that are derived from it

    def __eq__(self, other):
        if not isinstance(other, self._kind):
            return NotImplemented
        if self is other:
            return True
        return hash(self) == hash(other) and self.to_bytes() == other.to_bytes()

    def __hash__(self):
        if self._hash is None:
            self._hash = hash(self.to_bytes())
        return self._hash

    def __reduce__(self):
        return self._kind.from_bytes, (self.to_bytes(),)


def native_of(given, kind, function, argument):
    """The handle of an argument that must be a `kind`."""
    if not isinstance(given, kind):
        raise invalid_type(function, argument, given, f"an ifsm.{kind.__name__}")
    if given._native is None:
        raise Closed(f"{argument} was closed; give one that is not.", Status.INVALID_HANDLE, function, argument)
    return given._native
