"""What the pictures of `ifsm.plot` are made of: models and systems that can be drawn, lines, axes."""
import numbers

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from . import _pictures
from ._deformers import Deformer
from ._errors import Closed, Status, invalid_type, invalid_value
from ._models import Model
from ._systems import System

_COORDINATES = ("x", "y", "z")
_FEW = 60  # points that are seen one by one
_MANY = 1000  # points from which on a usual line hides what it shows
_AIR = 0.5  # of the curve's extent: how far beside it the view goes for control points; those of a ring may be anywhere
_ABREAST, _PANEL = 3, 3.0  # small multiples in a row, and how wide, in inches
_SLIMMEST = 0.1  # a picture's shorter side over its longer one: of attractors that are lines
_ZOOM = 0.75  # of a box in space: room for its labels, which no layout sees


# ---- what is drawn ------------------------------------------------------------------------------------------------


def model_of(given, function, argument):
    """The model to draw: a deformer's as it is at the moment."""
    if not isinstance(given, (Model, Deformer)):
        raise invalid_type(function, argument, given, "an ifsm.Model or an ifsm.Deformer")
    if given._native is None:
        raise Closed(f"{argument} was closed; give one that is not.", Status.INVALID_HANDLE, function, argument)
    return given.snapshot() if isinstance(given, Deformer) else given


def drawable(given, function, argument):
    shown = model_of(given, function, argument)
    if shown.dimension > len(_COORDINATES):
        raise invalid_value(function, argument, f"{argument} has {shown.dimension} dimensions; curves of 1 to 3 can be "
                            "drawn: make a model of some of its coordinates.", Status.SHAPE)
    return shown


def same_dimension(first, second, function, argument):
    if second.dimension != first.dimension:
        raise invalid_value(function, argument, f"{argument} has {second.dimension} dimensions, and model "
                            f"{first.dimension}; give two of the same.", Status.SHAPE, required=first.dimension)


def system_of(given, function):
    if not isinstance(given, System):
        raise invalid_type(function, "system", given, "an ifsm.System")
    if given._native is None:
        raise Closed("system was closed; give one that is not.", Status.INVALID_HANDLE, function, "system")
    return given


def picture_size(system, size, window):
    """(width, height) of a picture of square pixels whose longer side was given; anything else as it is."""
    if not isinstance(size, numbers.Integral) or size < 1 or system.dimension == 3:
        return size
    if window is None:
        extents = np.ptp(system.box(), axis=0)
    else:
        left, bottom, right, top = _pictures.window_of(window, "ifsm.plot.system")
        extents = np.array([right - left, top - bottom])
    if not 0 < extents.max() < np.inf:
        return size  # a point, or what will be refused
    return tuple(max(1, round(float(size * max(share, _SLIMMEST)))) for share in extents / extents.max())


def closed(model, points):
    """Points of a level as a line: rings under square filters do not repeat their first point by themselves."""
    if model.closed and model.filter.topology == "square":
        return np.concatenate([points, points[:1]])
    return points


def _over(points):
    """Columns to plot: of one dimension values over the parameter."""
    return (np.linspace(0, 1, len(points)), points[:, 0]) if points.shape[1] == 1 else tuple(points.T)


def draw(ax, points, *, beside=None, air=_AIR, **line):
    """A line, with its points where they are few. Given the curve it lies `beside`, it does not take all of the view."""
    few = len(points) <= _FEW
    style = {"linewidth": width(len(points)), "marker": "." if few else "none", **line}
    columns = _over(points)
    if _in_space(ax):
        return ax.plot(*columns, **style)[0]
    if beside is None:
        return ax.plot(*columns[:2], **style)[0]
    drawn = ax.add_artist(Line2D(*columns[:2], **style))  # which, other than plot(), leaves the view as it is
    _view(ax, np.column_stack(columns[:2]), np.column_stack(_over(beside)[:2]), air)
    return drawn


def _view(ax, points, curve, air):
    """Let the view hold a curve, and points that are not far beside it."""
    low, high = curve.min(axis=0), curve.max(axis=0)
    air = air * (high - low)
    near = ((low - air <= points) & (points <= high + air)).all(axis=1)
    ax.update_datalim(np.concatenate([curve, points[near]]))
    ax.autoscale_view()


def draw_polygon(ax, polygon, curve, color, label="control polygon", air=_AIR):
    draw(ax, polygon, beside=curve, air=air, label=label, color=color, alpha=0.6, linestyle="--", linewidth=1,
          marker="o", markersize=4)


def width(count):
    return 0.8 if count > _MANY else 1.4


def _in_space(ax):
    return ax.name == "3d"


# ---- axes ---------------------------------------------------------------------------------------------------------


def new_figure(**options):
    from matplotlib import pyplot  # late: it chooses a backend

    return pyplot.figure(layout="constrained", **options)


def checked_axes(ax, function):
    if not isinstance(ax, Axes):
        raise invalid_type(function, "ax", ax, "matplotlib axes, or None")
    return ax


def axes(ax, model, function):
    return checked_axes(ax, function) if ax is not None else _grid(model, 1)[0]


def axes_of_levels(ax, model, count, function):
    if ax is None:
        return _grid(model, count)
    axes = np.ravel(np.asarray(ax, dtype=object))
    for each in axes:
        checked_axes(each, function)
    if len(axes) != count:
        raise invalid_value(function, "ax", f"ax holds {len(axes)} axes; give {count}.", Status.SHAPE, required=count)
    return axes


def _grid(model, count):
    """So many axes in a figure of their own, in rows of `_ABREAST`."""
    columns = min(count, _ABREAST)
    rows = -(-count // columns)
    space = model.dimension == 3
    figure = new_figure(**{"figsize": (_PANEL * columns, _PANEL * rows)} if count > 1 else {})
    axes = figure.subplots(rows, columns, sharex=not space, sharey=not space, squeeze=False,
                           subplot_kw={"projection": "3d"} if space else {}).ravel()
    for unused in axes[count:]:
        unused.remove()
    if space:
        for each in axes[:count]:
            each.locator_params(nbins=4 if count == 1 else 3)  # more numbers would lie upon each other
    return axes[:count]


def arrange(axes, model):
    """Small multiples as high as what they show, with labels at the outer ones alone."""
    columns = min(len(axes), _ABREAST)
    if model.dimension == 2:
        ratio = np.ptp(axes[0].get_ylim()) / np.ptp(axes[0].get_xlim())
        axes[0].figure.set_figheight(-(-len(axes) // columns) * (_PANEL * min(max(ratio, 0.3), 2) + 0.5))
    if model.dimension == 3:
        return _arrange_in_space(axes)
    for index, ax in enumerate(axes):
        lowest = index + columns >= len(axes)
        ax.tick_params(labelbottom=lowest)
        ax.set_xlabel(ax.get_xlabel() if lowest else "")
        ax.set_ylabel("" if index % columns else ax.get_ylabel())


def _arrange_in_space(axes):
    """Boxes of one size, which can be compared; labels at the first alone, since no layout sees them."""
    finest = axes[-1]
    for index, ax in enumerate(axes):
        ax.set(xlim3d=finest.get_xlim3d(), ylim3d=finest.get_ylim3d(), zlim3d=finest.get_zlim3d())
        ax.set_box_aspect([np.ptp(limits()) for limits in (ax.get_xlim3d, ax.get_ylim3d, ax.get_zlim3d)], zoom=_ZOOM)
        ax.tick_params(labelsize="x-small", pad=0)
        if index > 0:
            ax.set(xlabel="", ylabel="", zlabel="")


def finish(ax, model, own):
    """Axes labels, units, and a legend where there is something to tell apart."""
    if model.dimension == 1:
        label(ax, "parameter", "value")
    else:
        hidden = " (first two of 3 coordinates)" if model.dimension == 3 and not _in_space(ax) else ""
        label(ax, "x" + hidden, "y")
        _equal_units(ax)
    told = len(ax.get_legend_handles_labels()[0])
    if told > 1 and own and not _in_space(ax):  # above, where it covers nothing
        ax.legend(loc="lower left", bbox_to_anchor=(0, 1), ncol=min(told, 3), frameon=False, fontsize="small")
    elif told > 1:  # in space no curve is seen in the corners
        ax.legend(loc="upper left" if _in_space(ax) else "best", fontsize="small")
    return ax


def _equal_units(ax):
    if not _in_space(ax):
        ax.set_aspect("equal")
        return
    if not ax.get_zlabel():
        ax.set_zlabel("z")
    sides = [np.ptp(limits()) for limits in (ax.get_xlim3d, ax.get_ylim3d, ax.get_zlim3d)]
    ax.set_box_aspect(sides, zoom=_ZOOM)


def label(ax, x, y):
    if not ax.get_xlabel():
        ax.set_xlabel(x)
    if not ax.get_ylabel():
        ax.set_ylabel(y)
    return ax
