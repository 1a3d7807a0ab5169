"""Pictures of models and of systems, drawn with matplotlib.

>>> t = np.linspace(0, 1, 257)
>>> model = ifsm.Model(np.column_stack([t, np.sin(9 * t ** 2)]))
>>> axes = ifsm.plot.curve(model)                        # a figure of its own
>>> ifsm.plot.curve(model.keep(details=9), ax=axes, label="9 details") is axes    # or axes that there are
True

All functions but `system` take models, or deformers as they are at the moment, and return the axes that they have drawn
on. Without `ax` they make a figure by pyplot; labels that axes have already stay. Needs matplotlib: ``pip install ifsm[plot]``.
"""
import numpy as np

from . import _arrays
from ._errors import Status, invalid_value, naming

try:
    import matplotlib
    from matplotlib.ticker import MaxNLocator
except ImportError as error:
    raise ImportError("ifsm.plot draws with matplotlib, which is not installed: pip install ifsm[plot]") from error
from . import _drawing

__all__ = ["before_after", "curve", "levels", "residuals", "scalogram", "system"]

_FIRST_LEVELS = 5  # that `levels` shows beside the finest: later ones look like it at this size
_WIDE_AIR = 2.0  # where control points are what is shown
_COLUMNS = 512  # of a scalogram, at most: about the pixels of its figure's axes, so that none of them is lost
_DECADES = 6  # below the largest detail: those that a palette tells apart, and far above rounding
_ZERO = "0.85"  # light grey: no colour of viridis


# ---- curves -------------------------------------------------------------------------------------------------------


def curve(model, *, ax=None, control_polygon=True, levels=None, details=None, **line):
    """Draw a curve and its control polygon.

    Of one dimension over its parameter; in the plane with equal units; in space on 3-D axes, if these are given or none
    are, else its first two coordinates.

    Parameters
    ----------
    model : Model or Deformer
        Of 1 to 3 dimensions.
    ax : matplotlib Axes, optional
    control_polygon : bool
        Whether to draw it. Control points far beside the curve, as rings may have them, are left out of view.
    levels, details : int, optional
        As in ``model.points``: how far down, and of the nearest sketch with so many details.
    line
        For the curve's line, what matplotlib's ``Axes.plot`` takes: ``color``, ``linewidth``, ``label``, …

    Returns
    -------
    matplotlib Axes

    Raises
    ------
    InvalidValue
        For a model of 4 dimensions.

    Examples
    --------
    >>> model = ifsm.Model(np.column_stack([np.arange(65), np.arange(65) % 5]))
    >>> axes = ifsm.plot.curve(model, details=20, color="black")
    >>> bool(np.array_equal(axes.lines[0].get_xydata(), model.points(details=20)))
    True
    """
    function = "ifsm.plot.curve"
    shown = _drawing.drawable(model, function, "model")
    if details is not None:
        shown = shown.keep(details=details)
    points = _drawing.closed(shown, shown.points(levels=levels))
    own, ax = ax is None, _drawing.axes(ax, shown, function)
    drawn = _drawing.draw(ax, points, **{"label": "curve" if levels is None else f"level {levels}", **line})
    if control_polygon:
        # On axes of somebody's own, a legend is theirs to ask for: by a label.
        named = own or "label" in line
        _drawing.draw_polygon(ax, shown.control_points, points, drawn.get_color(), "control polygon" if named else "_polygon")
    return _drawing.finish(ax, shown, own)


def before_after(model, deformed, *, ax=None, control_polygon=False):
    """Draw a curve thin and grey, and what has become of it over it.

    Parameters
    ----------
    model, deformed : Model or Deformer
        Of one dimension, 1 to 3. The numbers of their samples may differ.
    ax : matplotlib Axes, optional
    control_polygon : bool
        Whether to draw that of `deformed`. Control points farther beside the curve than twice its extent are left out
        of view.

    Returns
    -------
    matplotlib Axes

    Examples
    --------
    >>> model = ifsm.Model(np.column_stack([np.arange(65), np.arange(65) % 5]), filter="casteljau")
    >>> axes = ifsm.plot.before_after(model, model.deformer().move(0, 2, [0, 40]))
    >>> [line.get_label() for line in axes.lines]
    ['before', 'after']
    """
    function = "ifsm.plot.before_after"
    before, after = _drawing.drawable(model, function, "model"), _drawing.drawable(deformed, function, "deformed")
    _drawing.same_dimension(before, after, function, "deformed")
    own, ax = ax is None, _drawing.axes(ax, before, function)
    _drawing.draw(ax, _drawing.closed(before, before.points()), label="before", color="0.6", linewidth=0.7)
    points = _drawing.closed(after, after.points())
    drawn = _drawing.draw(ax, points, label="after", color="C0")
    if control_polygon:
        _drawing.draw_polygon(ax, after.control_points, points, drawn.get_color(), air=_WIDE_AIR)
    return _drawing.finish(ax, before, own)


def levels(model, which=None, *, ax=None, overlay=False):
    """Draw the levels of a model: the control polygons of each, joined, as ``model.points(levels=…)``.

    Parameters
    ----------
    model : Model or Deformer
        Of 1 to 3 dimensions.
    which : int or list of int, optional
        Levels, 0 (the control polygon) … ``model.levels``. By default the first five, and the finest.
    ax : matplotlib Axes, or an array of them, optional
        One for each level; with `overlay` a single one.
    overlay : bool
        Whether to draw all in one picture, coarse ones dark and fine ones light; else each over the grey curve.

    Returns
    -------
    array of matplotlib Axes, one for each level, or one for all

    Examples
    --------
    >>> model = ifsm.Model(np.column_stack([np.arange(65), np.arange(65) % 5]))
    >>> [axes.get_title() for axes in ifsm.plot.levels(model, [0, 3])]
    ['level 0: 5 points', 'level 3: 33 points']
    >>> ifsm.plot.levels(model, overlay=True).shape
    (1,)
    """
    function = "ifsm.plot.levels"
    shown = _drawing.drawable(model, function, "model")
    chosen = _levels(shown, which, function)
    with naming(levels="which"):
        lines = [_drawing.closed(shown, shown.points(levels=level)) for level in chosen]
    finest = _drawing.closed(shown, shown.points())
    axes = _drawing.axes_of_levels(ax, shown, 1 if overlay else len(lines), function)
    if overlay:
        _overlay(axes[0], chosen, lines, finest)
    else:
        _small_multiples(axes, chosen, lines, finest)
    for each in axes:
        _drawing.finish(each, shown, ax is None)
    if ax is None and len(axes) > 1:
        _drawing.arrange(axes, shown)
    return axes


def _levels(model, which, function):
    if which is None:
        return [*range(min(_FIRST_LEVELS, model.levels)), model.levels]
    chosen = _arrays.integers(which, function, "which", np.int64).tolist()
    if not chosen:
        raise invalid_value(function, "which", "which is empty; give one level at least.", Status.SHAPE, required=1)
    return chosen


def _overlay(ax, chosen, lines, finest):
    shades = matplotlib.colormaps["viridis"](np.linspace(0, 0.9, len(lines)))  # its last tenth is pale on white
    for level, points, shade in zip(chosen, lines, shades):
        _drawing.draw(ax, points, beside=finest, label=f"level {level}", color=shade)


def _small_multiples(axes, chosen, lines, finest):
    for ax, level, points in zip(axes, chosen, lines):
        _drawing.draw(ax, finest, color="0.75", linewidth=0.6, marker="none", label="_curve")
        _drawing.draw(ax, points, beside=finest, color="C0", label=f"_level {level}")
        ax.set_title(f"level {level}: {len(points)} point{'s' * (len(points) != 1)}", fontsize="medium")


# ---- numbers over the curve ---------------------------------------------------------------------------------------


def scalogram(model, *, ax=None):
    """Draw the sizes of details over the parameter (across) and the level (down).

    Colours tell log10 of ``model.significance(level)``, in the samples' units times the root of places, six decades at
    most; details that are zero are grey. At levels with more details than 512, neighbours share a column, which shows the
    largest.

    Parameters
    ----------
    model : Model or Deformer
        Of any dimension, with one level at least.
    ax : matplotlib Axes, optional
        Loses some of its width to the colour bar.

    Returns
    -------
    matplotlib Axes

    Examples
    --------
    >>> model = ifsm.Model(np.arange(65) % 5)
    >>> axes = ifsm.plot.scalogram(model.keep(details=20))
    >>> axes.images[0].get_array().shape                   # levels, details of the finest one
    (4, 32)
    """
    function = "ifsm.plot.scalogram"
    shown = _drawing.model_of(model, function, "model")
    if shown.levels == 0:
        raise invalid_value(function, "model", "model has no levels, and so no details; give one that has.")
    sizes = _sizes(shown)
    ax = _drawing.checked_axes(ax, function) if ax is not None else _drawing.new_figure(figsize=(7, 4)).subplots()
    palette = matplotlib.colormaps["viridis"].with_extremes(bad=_ZERO)
    picture = ax.imshow(sizes, aspect="auto", extent=(0, 1, shown.levels - 0.5, -0.5), cmap=palette,
                        interpolation="nearest")  # levels are apart, and must not run into each other
    low, high = _range(sizes)
    picture.set_clim(low, high)
    bar = ax.figure.colorbar(picture, ax=ax, extend="min" if (sizes < low).any() else "neither")
    bar.set_label(r"$\log_{10}$ of significance" + (" (grey: zero)" if sizes.mask.any() else ""))
    ax.yaxis.set_major_locator(MaxNLocator(integer=True))
    return _drawing.label(ax, "parameter", "level (0: coarsest)")


def _sizes(model):
    """log10 of significances, of shape (levels, columns); those of zeros are masked."""
    rows = [model.significance(level) for level in range(model.levels)]
    columns = max(len(row) for row in rows if len(row) <= max(_COLUMNS, len(rows[0])))
    return np.ma.log10(np.ma.masked_equal([_in_columns(row, columns) for row in rows], 0))


def _in_columns(row, columns):
    """Each value as wide as its node; of several in a column the largest. One of the two counts divides the other."""
    if len(row) <= columns:
        return np.repeat(row, columns // len(row))
    return row.reshape(columns, -1).max(axis=1)


def _range(sizes):
    if sizes.mask.all():
        return 0, 1
    return max(sizes.min(), sizes.max() - _DECADES), sizes.max()


def residuals(model, sketch, *, ax=None):
    """Draw the distances between samples of the same number, over the model's parameters, and their RMS.

    Parameters
    ----------
    model, sketch : Model or Deformer
        Of as many samples, and of one dimension.
    ax : matplotlib Axes, optional

    Returns
    -------
    matplotlib Axes

    Examples
    --------
    >>> model = ifsm.Model(np.column_stack([np.arange(65), np.arange(65) % 5]))
    >>> axes = ifsm.plot.residuals(model, model.keep(details=20))
    >>> axes.lines[0].get_ydata().shape
    (65,)
    """
    function = "ifsm.plot.residuals"
    exact, near = _drawing.model_of(model, function, "model"), _drawing.model_of(sketch, function, "sketch")
    _drawing.same_dimension(exact, near, function, "sketch")
    if near.sample_count != exact.sample_count:
        raise invalid_value(function, "sketch", f"sketch has {near.sample_count} samples, and model {exact.sample_count}; "
                            "give a sketch of that model.", Status.SHAPE, required=exact.sample_count)
    distances = np.linalg.norm(near.samples() - exact.samples(), axis=1)
    rms = exact.distance(near).rms
    ax = _drawing.checked_axes(ax, function) if ax is not None else _drawing.new_figure(figsize=(7, 3.5)).subplots()
    ax.plot(exact.parameters(), distances, linewidth=_drawing.width(len(distances)), label="distance")
    ax.axhline(rms, color="C1", linestyle="--", linewidth=1.4, label=f"RMS {rms:.4g}")
    if rms == 0:
        ax.set_ylim(0, 1)
    else:
        ax.set_ylim(0, max(ax.get_ylim()[1], 1.25 * distances.max()))  # room for the legend above the line
    ax.legend(loc="upper right", ncol=2, fontsize="small")
    return _drawing.label(ax, "parameter", "distance from the model")


# ---- systems ------------------------------------------------------------------------------------------------------


def system(system, *, ax=None, size=1024, window=None, **picture):
    """Draw the attractor of a system: of the plane over its own coordinates; of space as it is seen, without any.

    Parameters
    ----------
    system : System
        Contractive.
    ax : matplotlib Axes, optional
    size : int or (int, int)
        Pixels of the longer side, or (width, height).
    window : (left, bottom, right, top), optional
        The part to show; the attractor by default.
    picture
        What `System.render` takes: ``colour``, ``palette``, ``background``, ``points``, ``azimuth``, …

    Returns
    -------
    matplotlib Axes

    Examples
    --------
    >>> axes = ifsm.plot.system(ifsm.systems.fern(), size=200, palette="fern")
    >>> axes.images[0].get_array().shape
    (200, 97, 4)
    """
    function = "ifsm.plot.system"
    shown = _drawing.system_of(system, function)
    if ax is not None:
        _drawing.checked_axes(ax, function)
    pixels, report = shown.render(_drawing.picture_size(shown, size, window), window=window, full=True, **picture)
    left, bottom, right, top = report.window
    ax = ax if ax is not None else _drawing.new_figure().subplots()
    ax.imshow(pixels, extent=(left, right, bottom, top))
    if shown.dimension == 3:
        ax.set_axis_off()
        return ax
    return _drawing.label(ax, "x", "y")
