import numpy as np
import pytest

import ifsm

shapely = pytest.importorskip("shapely")
from shapely import geometry  # noqa: E402


def test_shapely_lines_and_rings_are_curves(walk, ring, refused):
    assert ifsm.Model(geometry.LineString(walk)) == ifsm.Model(walk)
    assert ifsm.Model(geometry.LinearRing(ring)) == ifsm.Model(ring, closed=True)
    assert ifsm.fit(geometry.Polygon(ring)).closed
    hole = geometry.Polygon([(0, 0), (9, 0), (9, 9)], holes=[[(4, 1), (5, 1), (5, 2)]])
    refused(lambda: ifsm.fit(hole), ifsm.InvalidValue, "points")
    refused(lambda: ifsm.fit(geometry.Point(1, 2)), ifsm.InvalidValue, "points")
    assert [closed for _, closed in ifsm.curves(hole)] == [True, True]


def test_models_are_geometries(walk, ring):
    line = geometry.shape(ifsm.Model(walk))
    assert line.geom_type == "LineString" and np.abs(np.asarray(line.coords) - walk).max() < 1e-12
    polygon = geometry.shape(ifsm.Model(ring, closed=True))
    assert polygon.geom_type == "Polygon" and len(polygon.exterior.coords) == 257
    assert ifsm.Model(ifsm.Model(walk)).sample_count == 257  # and a model is a geometry, too
    with pytest.raises(AttributeError):
        ifsm.Model([[1.0], [2.0]]).__geo_interface__


def test_geopandas_frames_are_lists_of_curves(walk, ring):
    geopandas = pytest.importorskip("geopandas")
    frame = geopandas.GeoDataFrame(geometry=[geometry.LineString(walk), geometry.Polygon(ring)])
    found = ifsm.curves(frame)
    assert [closed for _, closed in found] == [False, True]
    assert np.array_equal(found[0][0], walk)
    models = [ifsm.Model(points, closed=closed) for points, closed in found]
    again = geopandas.GeoSeries([geometry.shape(model) for model in models])
    assert again.geom_type.tolist() == ["LineString", "Polygon"]


def test_geojson_of_every_kind_is_walked(refused):
    line, ring = [(0, 0), (1, 1)], [(0, 0), (1, 0), (1, 1), (0, 0)]
    told = {"type": "FeatureCollection", "features": [
        {"type": "Feature", "properties": {}, "geometry": None},
        {"type": "Feature", "properties": {}, "geometry": {"type": "GeometryCollection", "geometries": [
            {"type": "MultiLineString", "coordinates": [line, line]},
            {"type": "MultiPolygon", "coordinates": [[ring, ring], [ring]]}]}}]}
    assert [(len(points), closed) for points, closed in ifsm.curves(told)] == [(2, False)] * 2 + [(3, True)] * 3
    for lacking in ("Feature", "Polygon", "LineString", "FeatureCollection"):
        refused(lambda: ifsm.curves({"type": lacking}), ifsm.InvalidValue, "geometry")
    refused(lambda: ifsm.curves({"type": "Teapot"}), ifsm.InvalidValue, "geometry")
    refused(lambda: ifsm.curves([1, 2]), ifsm.InvalidType, "geometry")
