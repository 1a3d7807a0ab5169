"""Ordered points, from arrays and from whatever has a `__geo_interface__`."""
import numpy as np

from . import _arrays
from ._errors import Status, invalid_type, invalid_value


def curve(given, closed, function, argument="points"):
    """(array of shape (points, dimension), closed): what the C library is handed.

    A ring may repeat its first point at the end; that one is left out.
    """
    geometry = getattr(given, "__geo_interface__", None)
    if geometry is not None or (isinstance(given, dict) and "type" in given):
        found = list(_lines(given if geometry is None else geometry, function, argument))
        if len(found) != 1:
            raise invalid_value(function, argument, f"{argument} holds {len(found)} lines; give one, or all to "
                                "ifsm.batch.fit: ifsm.curves() lists them.", Status.SHAPE)
        points, is_ring = found[0]
        closed = is_ring if closed is None else closed
    else:
        points = given
    points = _arrays.table(points, function, argument)
    closed = closed is not None and _arrays.is_true(closed, function, "closed")
    if closed and len(points) > 1 and np.array_equal(points[0], points[-1]):
        points = points[:-1]
    count, dimension = points.shape
    if count < 2:
        raise invalid_value(function, argument, f"{argument} holds {count} point{'s' * (count != 1)}; give 2 or more.",
                            Status.SHAPE, required=2)
    if not 1 <= dimension <= 4:
        raise invalid_value(function, argument, f"{argument} has {dimension} columns; points have 1 to 4 dimensions.",
                            Status.SHAPE)
    return points, closed


def curves(geometry):
    """All lines and rings of a geometry, a feature or a collection: a list of (points, closed).

    Parameters
    ----------
    geometry : anything with a ``__geo_interface__``, or a GeoJSON dict
        Shapely geometries, GeoPandas frames and series, models of this library.

    Examples
    --------
    >>> ifsm.curves({"type": "LineString", "coordinates": [(0, 0), (1, 2), (2, 0)]})
    [(array([[0., 0.],
           [1., 2.],
           [2., 0.]]), False)]
    """
    told = getattr(geometry, "__geo_interface__", geometry)
    return [curve(points, closed, "ifsm.curves", "geometry") for points, closed in _lines(told, "ifsm.curves", "geometry")]


def _lines(geometry, function, argument):
    try:
        yield from _walked(geometry, function, argument)
    except KeyError as error:
        raise invalid_value(function, argument, f"{argument} is no GeoJSON: it lacks {error}.", Status.SHAPE) from None


def _walked(geometry, function, argument):
    if not isinstance(geometry, dict) or "type" not in geometry:
        raise invalid_type(function, argument, geometry, "something with a __geo_interface__, or a GeoJSON dict")
    kind = geometry["type"]
    if kind == "FeatureCollection":
        for feature in geometry["features"]:
            yield from _walked(feature, function, argument)
    elif kind == "Feature":
        if geometry["geometry"] is not None:
            yield from _walked(geometry["geometry"], function, argument)
    elif kind == "GeometryCollection":
        for part in geometry["geometries"]:
            yield from _walked(part, function, argument)
    elif kind == "LineString":
        yield geometry["coordinates"], False
    elif kind == "LinearRing":
        yield geometry["coordinates"], True
    elif kind == "MultiLineString":
        for line in geometry["coordinates"]:
            yield line, False
    elif kind == "Polygon":
        for ring in geometry["coordinates"]:
            yield ring, True
    elif kind == "MultiPolygon":
        for polygon in geometry["coordinates"]:
            for ring in polygon:
                yield ring, True
    else:
        raise invalid_value(function, argument, f"{argument} is a {kind}, which is no line; give lines or polygons.")


def geo_interface(points, closed):
    """GeoJSON of a plane curve."""
    if closed:
        ring = [tuple(point) for point in points.tolist()]
        return {"type": "Polygon", "coordinates": (tuple([*ring, ring[0]]),)}
    return {"type": "LineString", "coordinates": tuple(tuple(point) for point in points.tolist())}
