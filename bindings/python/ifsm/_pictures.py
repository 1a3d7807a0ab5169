"""Pictures of systems: counts, sets, distances and colours in arrays, row 0 on top."""
import string
from typing import NamedTuple

import numpy as np

from . import _arrays, _native, _progress
from ._errors import Status, invalid_type, invalid_value, naming
from ._objects import Handled

COLOURS = {"tone": _native.IFSM_COLOUR_TONE, "symbol": _native.IFSM_COLOUR_SYMBOL,
           "address": _native.IFSM_COLOUR_ADDRESS, "set": _native.IFSM_COLOUR_SET,
           "distance": _native.IFSM_COLOUR_DISTANCE}
PALETTES = {"dusk": _native.IFSM_PALETTE_DUSK, "sea": _native.IFSM_PALETTE_SEA, "fern": _native.IFSM_PALETTE_FERN,
            "ember": _native.IFSM_PALETTE_EMBER, "ink": _native.IFSM_PALETTE_INK}
_SIZE = 1024
_USUAL_SAMPLE = 65536
# C's words for what is given here in one.
_SIDES = {"left": "window[0]", "bottom": "window[1]", "right": "window[2]", "top": "window[3]"}


class PictureReport(NamedTuple):
    """What a picture shows."""

    window: tuple[float, float, float, float]
    """left, bottom, right, top: ``extent`` of matplotlib's ``imshow`` wants (left, right, bottom, top)."""
    width: int
    height: int
    points: int
    """That the chaos game played; 0 where it did not."""
    inside: int
    """Those in the window: 0 tells that it misses the attractor."""
    met: int
    """Pixels that were hit, or are met for certain; where it was oversampled, of those computed."""
    undecided: int
    """Of a set: pixels to whose edge it comes within the tolerance, and none was found inside."""


class Pictured(Handled):
    """What a system can be asked to draw; for `System`."""

    __slots__ = ()

    def histogram(self, size=_SIZE, *, window=None, points=None, seed=0, threads=0, full=False, progress=None):
        """How often the chaos game hits each pixel: points of the measure, drawn at random.

        The same seed gives the same bits on any number of threads.

        Parameters
        ----------
        size : int or (int, int)
            Pixels, of a side or (width, height), 1 … 32768.
        window : (left, bottom, right, top), optional
            In the system's units; around the attractor by default.
        points : int, optional
            How many to play; 16 a pixel by default.
        seed : int
            Other seeds, other points.
        threads : int
            At most so many; 0: as `ifsm.set_threads` says.
        full : bool
            Whether to tell a `PictureReport` as well.
        progress : bool or callable
            As in `ifsm.fit`.

        Returns
        -------
        array of uint32, of shape (height, width): counts, which stay at 2^32 - 1; with `full` (array, `PictureReport`)

        Examples
        --------
        >>> counts, report = ifsm.System.named("gasket").histogram(64, full=True)
        >>> int(counts.sum()) == report.inside == report.points == 16 * 64 * 64
        True
        """
        function = "ifsm.System.histogram"
        return self._drawn(_native.ifsm_system_histogram, function, size, window, threads,
                           (seed, _some(points, function)), np.uint32, (), full, progress)

    def set(self, size=_SIZE, *, window=None, tolerance=0.0, threads=0, full=False, progress=None):
        """Which pixels' squares the attractor meets. Nothing is drawn at random.

        Parameters
        ----------
        size, window, threads, full, progress
            As in `histogram`.
        tolerance : float
            In pixels, up to 1; 0: 1/64.

        Returns
        -------
        array of uint8, of shape (height, width)
            0 empty, 2 met: both are proofs, rounding included. 1 undecided: the attractor comes within the tolerance of
            the pixel's edge. With `full` (array, `PictureReport`).

        Examples
        --------
        >>> pixels = ifsm.System.named("carpet").set(27)
        >>> int((pixels == 2).sum()) >= 8 ** 3
        True
        """
        return self._drawn(_native.ifsm_system_set, "ifsm.System.set", size, window, threads, (tolerance,), np.uint8, (),
                           full, progress)

    def distances(self, size=_SIZE, *, window=None, tolerance=0.0, threads=0, full=False, progress=None):
        """How far the middle of each pixel is from the attractor, in the system's units.

        Parameters
        ----------
        size, window, threads, full, progress
            As in `histogram`.
        tolerance : float
            In pixels, up to 1; 0: 1/8. Distances are not below the true ones, and above by at most this.

        Returns
        -------
        array of shape (height, width); with `full` (array, `PictureReport`)
        """
        return self._drawn(_native.ifsm_system_distances, "ifsm.System.distances", size, window, threads, (tolerance,),
                           np.float64, (), full, progress)

    def render(self, size=_SIZE, *, window=None, colour="tone", palette="dusk", symbols=0, background=None, points=None,
               seed=0, oversample=0, tolerance=0.0, azimuth=0.0, elevation=0.0, field=0.0, threads=0, full=False,
               progress=None):
        """A picture, of the plane or of space.

        Of space it shows the nearest point of each pixel, darker where it lies behind its surroundings.

        Parameters
        ----------
        size, points, seed, threads, full, progress
            As in `histogram`; of space 32 points a pixel by default.
        window : (left, bottom, right, top), optional
            As in `histogram`; of space in the plane through the middle of its ball, whose centre is (0, 0).
        colour : {"tone", "symbol", "address", "set", "distance"}
            How dense the measure is (of space: how near it is), on a logarithmic scale; the map whose piece it is; the
            share of the measure that has smaller addresses; pixels that the attractor meets, as `set` tells; how far it
            is, as `distances` tells. The last two of the plane alone.
        palette : {"dusk", "sea", "fern", "ember", "ink"}, or a list of colours
            From light to dark, by lightness alone; or 1 … 256 colours equally far apart. Of ``"symbol"`` it does not count:
            maps have colours that the colour-blind tell apart.
        symbols : int
            Of addresses, 1 … 16; 0: all.
        background : colour, optional
            Transparent by default. Colours are ``"#rgb"``, ``"#rrggbb"``, ``"#rrggbbaa"``, ``"white"``, ``"black"`` or
            integers (red, green, blue) or (red, green, blue, alpha), 0 … 255.
        oversample : int
            Pixels computed for each one, along both sides, 1 … 8; 0: 2, or 1 for distances and above 4096 pixels a side.
        tolerance : float
            Of sets and distances, in pixels, up to 1; 0: theirs.
        azimuth, elevation : float
            Of space: where the eye is, in radians: from the x axis to the y axis, and above the xy plane.
        field : float
            Of space: the angle of view in radians, 0 … 3; 0: the eye is infinitely far. All three 0: .6, .45, .5, from
            aside and above.

        Returns
        -------
        array of uint8, of shape (height, width, 4): red, green, blue (sRGB) and alpha, which is not multiplied in; with
        `full` (array, `PictureReport`)

        Examples
        --------
        >>> pixels = ifsm.System.named("fern").render((300, 500), palette="fern", background="white")
        >>> pixels.shape, pixels.dtype
        ((500, 300, 4), dtype('uint8'))
        """
        function = "ifsm.System.render"
        shows = _arrays.choice(colour, COLOURS, function, "colour")
        name, stops = _palette(palette, function)
        return self._drawn(_native.ifsm_system_render, function, size, window, threads,
                           (seed, _some(points, function), tolerance, shows, name, stops, symbols, oversample,
                            _background(background, function), azimuth, elevation, field), np.uint8, (4,), full, progress)

    def _drawn(self, call, function, size, window, threads, options, dtype, channels, full, progress):
        native, (width, height), sides = self._held(), _size(size, function), window_of(window, function)
        full = _arrays.is_true(full, function, "full")
        sizes = ("size[0]", "size[1]") if _is_list(size) else ("size", "size")
        names = {**_SIDES, "width": sizes[0], "height": sizes[1]}
        with naming(**names), _progress.telling(progress, function) as told:
            draw = lambda sides, values: call(native, width, height, threads, *sides, *options, None, told, values)[0]
            chosen = draw(sides, None)  # refuses what is wrong before memory is asked for
            values = np.empty((height, width, *channels), dtype)
            report = draw((chosen.left, chosen.bottom, chosen.right, chosen.top), values)
        return (values, _report(report)) if full else values

    def sample(self, points=_USUAL_SAMPLE, *, seed=0, threads=0, progress=None):
        """Points of the measure, by the chaos game: an array of shape (points, dimension).

        The first n are the same however many there are, and on any number of threads.

        Parameters
        ----------
        points : int
        seed, threads, progress
            As in `histogram`.
        """
        function = "ifsm.System.sample"
        asked, native = _some(points, function, optional=False), self._held()
        with naming(point_count="points"), _progress.telling(progress, function) as told:
            arguments = (native, threads, seed, asked, None, told)
            made = np.empty((_native.ifsm_system_sample(*arguments, None) // self.dimension, self.dimension))
            _native.ifsm_system_sample(*arguments, made)
        return made

    def sample_addresses(self, points, length, *, seed=0, threads=0, progress=None):
        """The first symbols of the addresses of the points that `sample` tells: an array of int32, (points, length)."""
        function = "ifsm.System.sample_addresses"
        asked, native = _some(points, function, optional=False), self._held()
        with naming(point_count="points"), _progress.telling(progress, function) as told:
            arguments = (native, threads, seed, asked, None, told, length)
            count = _native.ifsm_system_sample_addresses(*arguments, None)
            made = np.empty((count // length, length), np.int32)
            _native.ifsm_system_sample_addresses(*arguments, made)
        return made


def tone_map(counts, *, palette="dusk", background=None):
    """Colours for counts that one has, as `System.render` gives them of a density.

    Parameters
    ----------
    counts : array of integers, of any shape
        0 … 2^32 - 1; of any source, `System.histogram` or ``numpy.histogram2d``. Row 0 is on top.
    palette, background
        As in `System.render`.

    Returns
    -------
    array of uint8, of the shape of `counts` and 4 last

    Examples
    --------
    >>> ifsm.tone_map([[0, 1], [2, 3]], palette=["#204080"], background="white")[:, 1]
    array([[ 32,  64, 128, 255],
           [ 32,  64, 128, 255]], dtype=uint8)
    """
    function = "ifsm.tone_map"
    given = _counts(counts, function)
    name, stops = _palette(palette, function)
    pixels = np.empty((*given.shape, 4), np.uint8)
    _native.ifsm_tone_map(given, name, stops, _background(background, function), pixels)
    return pixels


# ---- what is given ------------------------------------------------------------------------------------------------


def _is_list(given):
    return isinstance(given, (tuple, list, np.ndarray))


def _size(given, function):
    """(width, height); C looks at their limits, but its 0 is a default."""
    pair = (_arrays.integers(given, function, "size", np.int64).tolist() if _is_list(given) else
            2 * [_arrays.whole(given, function, "size")])
    if len(pair) != 2 or 0 in pair:
        raise invalid_value(function, "size", f"size is {given!r}; give pixels, a number from 1 on or (width, height).")
    return pair


def window_of(given, function):
    if given is None:
        return 0.0, 0.0, 0.0, 0.0
    sides = _arrays.doubles(given, function, "window")
    if sides.shape != (4,):
        raise invalid_value(function, "window", f"window has the shape {sides.shape}; give (left, bottom, right, top).",
                            Status.SHAPE, required=4)
    if not sides.any():  # which is C's word for the default
        raise invalid_value(function, "window", "window is nothing but zeros; give one of some size, or None for one around "
                            "the attractor.")
    return tuple(sides.tolist())


def _some(points, function, optional=True):
    """A number of points, 0 for C's default; which nobody gets by asking for none."""
    if points is None and optional:
        return 0
    count = _arrays.whole(points, function, "points")
    if count == 0:
        raise invalid_value(function, "points", "points is 0; give 1 or more.", value=0.0)
    return count


def _counts(given, function):
    try:
        array = np.asarray(given)
    except (ValueError, TypeError):
        array = None
    if array is None or array.dtype.kind not in "iu":
        whole = array is not None and array.dtype.kind == "f" and bool((array == np.floor(array)).all())
        if not whole:  # of numpy.histogram2d they are whole
            raise invalid_type(function, "counts", given, "an array of integers")
    limits = np.iinfo(np.uint32)
    for index in np.flatnonzero((array < 0) | (array > limits.max))[:1]:
        value = array.flat[index]
        raise invalid_value(function, "counts", f"counts[{index}] is {value}; give counts from 0 to {limits.max}.",
                            index=int(index), value=float(value))
    return np.ascontiguousarray(array, np.uint32).reshape(array.shape)


# ---- colours ------------------------------------------------------------------------------------------------------

_NAMED = {"white": (255, 255, 255, 255), "black": (0, 0, 0, 255), "transparent": (0, 0, 0, 0)}
_WANTED = "a colour, such as '#2a4b8d', 'white' or (42, 75, 141)"


def _colour(given, function, argument):
    """(red, green, blue, alpha)."""
    if isinstance(given, str):
        digits = given[1:]
        if given in _NAMED:
            return _NAMED[given]
        if given[:1] != "#" or len(digits) not in (3, 4, 6, 8) or not set(digits) <= set(string.hexdigits):
            raise invalid_value(function, argument, f"{argument} is {given!r}; give {_WANTED}.")
        if len(digits) < 6:
            digits = "".join(2 * digit for digit in digits)
        return tuple(bytes.fromhex(digits.ljust(8, "f")))
    if not _is_list(given) or len(given) not in (3, 4):
        raise invalid_type(function, argument, given, _WANTED)
    parts = _arrays.integers(given, function, argument, np.int64).tolist()
    for index, part in enumerate(parts):
        if not 0 <= part <= 255:
            raise invalid_value(function, argument, f"{argument}[{index}] is {part}; give numbers from 0 to 255.", index=index,
                                value=float(part))
    return (*parts, 255)[:4]


def _background(given, function):
    if given is None:
        return 0
    return int.from_bytes(_colour(given, function, "background"), "big")


def _palette(given, function):
    """(number of a palette, colours instead or None)."""
    if isinstance(given, str) or given is None:
        return _arrays.choice(given, PALETTES, function, "palette"), None
    try:
        colours = list(given)
    except TypeError:
        wanted = f"one of {', '.join(map(repr, PALETTES))}, or a list of colours"
        raise invalid_type(function, "palette", given, wanted) from None
    if not 1 <= len(colours) <= 256:
        raise invalid_value(function, "palette", f"palette holds {len(colours)} colours; give 1 to 256.", Status.SHAPE)
    stops = bytearray()
    for index, colour in enumerate(colours):
        read = _colour(colour, function, f"palette[{index}]")
        if read[3] != 255:
            raise invalid_value(function, f"palette[{index}]", f"palette[{index}] is {colour!r}, which lets through what is "
                                "behind it; give colours without alpha.")
        stops += bytes(read[:3])
    return PALETTES["dusk"], bytes(stops)


def _report(told):
    return PictureReport((told.left, told.bottom, told.right, told.top), told.width, told.height, told.points, told.inside,
                         told.met, told.undecided)
