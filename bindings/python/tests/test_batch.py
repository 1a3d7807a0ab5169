import os
import signal
import sys
import time

import numpy as np
import pytest

import ifsm

distributed = pytest.importorskip("distributed")
dask = pytest.importorskip("dask")


def cluster_of(count):
    return distributed.LocalCluster(n_workers=count, threads_per_worker=1, dashboard_address=":0")


@pytest.fixture(scope="module")
def client():
    with cluster_of(2) as cluster, distributed.Client(cluster) as client:
        yield client


@pytest.fixture(scope="module")
def walks():
    """Rough open curves of 20 … 44 points in the plane: half a dozen tasks."""
    random = np.random.default_rng(7)
    return [np.cumsum(random.normal(size=(20 + k % 25, 2)), axis=0) for k in range(160)]


@pytest.fixture(scope="module")
def walks_models(walks):
    return [ifsm.fit(walk, threads=1) for walk in walks]


def test_models_are_those_of_local_fits_to_the_bit(client, walks, walks_models, ring, iceland):
    others = [np.arange(6.0), walks[0].astype(np.float32), walks[0][::-1].tolist()]
    curves = [*walks, (ring, True), (iceland, True), *others]
    models, failures = ifsm.batch.fit(curves, client)
    assert failures == [] and list(models) == list(range(len(curves)))
    assert [models[k] for k in range(len(walks))] == walks_models
    local = [ifsm.fit(ring, closed=True), ifsm.fit(iceland, closed=True), *map(ifsm.fit, others)]
    assert list(models.values())[len(walks):] == local
    options = dict(control_points=4, maps=2, filter="casteljau", within=0.5, distance="largest", iterations=3)
    fits = ifsm.batch.fit(walks[:3], client, closed=True, **options)
    assert fits.models == {k: ifsm.fit(walks[k], closed=True, **options) for k in range(3)}


def test_a_bad_curve_is_named_and_stops_nothing_else(client, walks, walks_models):
    bad = walks[4].copy()
    bad[3, 1] = np.nan
    squares = {"type": "MultiPolygon", "coordinates": [[[(0, 0), (1, 0), (1, 1), (0, 0)]]] * 2}
    curves = {"good": walks[0], "nan": bad, "short": walks[0][:1], "words": "coast", "two": squares, "nothing": None,
              "same": np.ones((9, 2)), "last": walks[1]}
    models, failures = ifsm.batch.fit(curves, client)
    assert models["good"] == walks_models[0] and models["last"] == walks_models[1]
    assert [failure.curve for failure in failures] == [key for key in curves if key not in models]
    assert [failure.curve for failure in failures][:5] == ["nan", "short", "words", "two", "nothing"]
    for key, error in failures:
        with pytest.raises(type(error)) as caught:
            ifsm.fit(curves[key])
        assert str(caught.value) == str(error) and isinstance(error, ifsm.Error)
    nan = failures[0].error
    assert (nan.argument, nan.index, nan.code) == ("points", 7, ifsm.Status.NOT_FINITE)
    assert str(failures[0]).startswith("curve 'nan': points[7] is nan")


def test_tiny_curves_have_models(client):
    angles = [np.linspace(0, 2 * np.pi, count, endpoint=False) for count in range(2, 11)]
    models, failures = ifsm.batch.fit([np.column_stack([np.cos(t), np.sin(t)]) for t in angles], client, closed=True)
    assert failures == [] and [model.sample_count for model in models.values()] == list(range(2, 11))


def test_a_worker_killed_in_the_middle_loses_nothing(walks, walks_models):
    with cluster_of(2) as cluster, distributed.Client(cluster) as client:
        pids = client.run(os.getpid)
        killed = []

        def kill(done, total):
            busy = [address for address, tasks in client.processing().items() if tasks]
            if busy and not killed:
                killed.append(busy[0])
                os.kill(pids[busy[0]], signal.SIGKILL)

        models, failures = ifsm.batch.fit(walks, client, progress=kill)
        assert len(killed) == 1 and pids[killed[0]] not in client.run(os.getpid).values()
    assert failures == [] and list(models.values()) == walks_models


def test_a_curve_that_kills_every_worker_is_named_and_loses_nothing_else(walks, walks_models, monkeypatch):
    fitted = ifsm.batch._fitted

    def deadly(curves, options):
        if any(len(points) == 3 for points, _ in curves):
            os.kill(os.getpid(), signal.SIGKILL)
        return fitted(curves, options)

    monkeypatch.setattr(ifsm.batch, "_fitted", deadly)
    with dask.config.set({"distributed.scheduler.allowed-failures": 0}):  # give up at once: the test is the sooner done
        with cluster_of(2) as cluster, distributed.Client(cluster) as client:
            models, failures = ifsm.batch.fit([*walks[:50], walks[0][:3], *walks[50:90]], client)
    assert [failure.curve for failure in failures] == [50] and isinstance(failures[0].error, distributed.KilledWorker)
    assert list(models.values()) == walks_models[:90]


def test_iterators_are_read_as_work_gets_done_and_may_fill_one_array_again_and_again(client):
    read, told = [], []

    def steps():
        array = np.empty((9, 2))
        for k in range(1500):
            array[:] = np.arange(9)[:, None] * [k, -1.0]
            read.append(k)
            yield array

    models, failures = ifsm.batch.fit(steps(), client, control_points=9, iterations=1,
                                      progress=lambda done, total: told.append((done, total, len(read))))
    assert failures == [] and len(models) == 1500
    assert all(model.samples()[8, 0] == pytest.approx(8 * k, rel=1e-14) for k, model in models.items())
    assert told[0][2] < 1500 and told[-1][:2] == (1500, None)
    assert len(told) < 150  # small curves travel together: ten times fewer tasks, at least


def test_keys_of_a_dict_stay_with_their_curves_and_in_order(client, walks, walks_models):
    models, failures = ifsm.batch.fit({("walk", k): walks[k] for k in (3, 1, 2)}, client)
    assert models == {("walk", k): walks_models[k] for k in (1, 2, 3)} and failures == []
    assert [k for _, k in models] == [3, 1, 2]


def test_geojson_is_all_its_lines_and_rings(client, walks, ring):
    line = {"type": "LineString", "coordinates": walks[0].tolist()}
    polygon = {"type": "Polygon", "coordinates": [[*ring.tolist(), ring[0].tolist()], [[0, 0], [1, 0], [0, 1], [0, 0]]]}
    bad = {"type": "LineString", "coordinates": [[0, 0]]}
    features = [{"type": "Feature", "properties": {}, "geometry": geometry} for geometry in (line, bad, polygon)]
    geometry = {"type": "FeatureCollection", "features": features}
    models, failures = ifsm.batch.fit(geometry, client)
    assert [failure.curve for failure in failures] == [1]
    assert models[0] == ifsm.fit(walks[0]) and models[2] == ifsm.fit(ring, closed=True) and models[3].sample_count == 3
    assert ifsm.batch.fit([line], client).models[0] == models[0]
    assert ifsm.batch.fit(models[2], client).models[0].closed
    shapely = pytest.importorskip("shapely.geometry")
    assert ifsm.batch.fit([shapely.LineString(walks[0])], client).models[0] == models[0]


def test_no_curves_have_no_models(client):
    assert ifsm.batch.fit([], client) == ({}, [])


def test_progress_ends_with_all_curves_and_can_cancel(client, walks):
    told = []
    ifsm.batch.fit([*walks[:60], walks[0][:1]], client, progress=lambda done, total: told.append((done, total)))
    assert told == sorted(told) and told[-1] == (61, 61)
    with pytest.raises(ifsm.Cancelled, match="progress"):
        ifsm.batch.fit(walks, client, progress=lambda *_: True)
    deadline = time.monotonic() + 20
    while any(client.processing().values()) and time.monotonic() < deadline:
        time.sleep(0.05)
    assert not any(client.processing().values())  # what was not done is taken back


def test_bars_are_optional(client, walks, capsys, monkeypatch):
    pytest.importorskip("tqdm")
    ifsm.batch.fit(walks[:2], client, progress=True)
    assert "2/2" in capsys.readouterr().err
    monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    ifsm.batch.fit(walks[:2], client, progress=True)
    assert capsys.readouterr().err == ""


def test_options_are_refused_before_any_work(client, walks, refused):
    def fitting(curves=walks, client=client, **options):
        def unread():
            pytest.fail("a curve was read")
            yield

        return lambda: ifsm.batch.fit(unread() if curves is walks else curves, client, **options)

    refused(fitting(distance="far"), ifsm.InvalidValue, "distance")
    refused(fitting(filter="silk"), ifsm.InvalidValue, "filter")
    refused(fitting(filter="coast", control_points=6), ifsm.InvalidValue, "control_points")
    refused(fitting(budget=2.5), ifsm.InvalidType, "budget")
    refused(fitting(progress="bar"), ifsm.InvalidType, "progress")
    refused(fitting(client="localhost"), ifsm.InvalidType, "client")
    refused(fitting(curves="coast"), ifsm.InvalidType, "curves")
    refused(fitting(curves=3), ifsm.InvalidType, "curves")


def test_without_dask_it_says_how_to_get_it(client, walks, monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(ImportError, match=r"pip install ifsm\[batch\]"):
        ifsm.batch.fit(walks, client)
