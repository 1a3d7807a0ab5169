"""The misuse matrix, through Python: whatever is wrong raises something of ifsm's that names the argument."""
import pickle

import numpy as np
import pytest

import ifsm


def test_bases_are_those_that_people_catch():
    assert issubclass(ifsm.InvalidValue, ValueError) and issubclass(ifsm.InvalidType, TypeError)
    assert issubclass(ifsm.OutOfMemory, MemoryError) and issubclass(ifsm.Closed, ValueError)
    assert issubclass(ifsm.NumericalError, ArithmeticError) and issubclass(ifsm.Busy, RuntimeError)
    for name in ifsm.__all__:
        value = getattr(ifsm, name)
        if isinstance(value, type) and issubclass(value, BaseException):
            assert issubclass(value, ifsm.Error) and value.__doc__


def test_every_status_has_its_name():
    for status in ifsm.Status:
        assert ifsm._native.ifsm_status_name(status) == f"IFSM_ERROR_{status.name}"


def test_errors_travel_between_processes():
    with pytest.raises(ifsm.InvalidValue) as caught:
        ifsm.fit([[0.0, 1.0], [float("nan"), 2.0]])
    again = pickle.loads(pickle.dumps(caught.value))
    assert type(again) is ifsm.InvalidValue and str(again) == str(caught.value)
    assert (again.code, again.argument, again.index) == (ifsm.Status.NOT_FINITE, "points", 2)


WRONG_ANYWHERE = [None, "text", b"bytes", object(), {}, [[1, 2], [3]], [None, 1], np.array([1j]), np.array(["a"]),
                  np.array([object()]), np.array([np.datetime64(1, "s")]), ifsm.Filter, 2**70, float("nan"), -2**70, [],
                  np.empty((0, 2)), np.empty((2, 0)), np.full((3, 2), np.inf), np.zeros((2, 2, 2))]


def calls(model, deformer, fit):
    """Every function with one argument to be filled in: {name: (call, argument)}."""
    points = [[0.0, 1.0], [1.0, 3.0], [2.0, 0.0], [4.0, 1.0], [5.0, 0.0]]
    gasket = ifsm.systems.gasket()
    return {
        "Filter": (lambda x: ifsm.Filter(x), "name"),
        "Filter topology": (lambda x: ifsm.Filter("coast", topology=x), "topology"),
        "Filter n": (lambda x: ifsm.Filter("casteljau", control_points=x), "control_points"),
        "from_matrix": (lambda x: ifsm.Filter.from_matrix(x, control_points=3, maps=2), "matrix"),
        "from_maps": (lambda x: ifsm.Filter.from_maps(x, control_points=3, maps=2), "matrix"),
        "Model": (lambda x: ifsm.Model(x), "points"),
        "Model filter": (lambda x: ifsm.Model(points, x), "filter"),
        "Model levels": (lambda x: ifsm.Model(points, levels=x), "levels"),
        "from_polygon": (lambda x: ifsm.Model.from_polygon(x, levels=2), "points"),
        "call": (lambda x: model(x), "t"),
        "call curve": (lambda x: model(0.5, curve=x), "curve"),
        "points": (lambda x: model.points(levels=x), "levels"),
        "points out": (lambda x: model.points(out=x), "out"),
        "address": (lambda x: model.address(x, 3), "t"),
        "address length": (lambda x: model.address(0.5, x), "length"),
        "interval": (lambda x: model.interval(x), "symbols"),
        "details": (lambda x: model.details(x), "level"),
        "significance": (lambda x: model.significance(x), "level"),
        "keep": (lambda x: model.keep(details=x), "details"),
        "keep within": (lambda x: model.keep(within=x), "within"),
        "with_control_points": (lambda x: model.with_control_points(x), "points"),
        "with_details": (lambda x: model.with_details(0, x), "vectors"),
        "with_filter": (lambda x: model.with_filter(x), "filter"),
        "refine": (lambda x: model.refine(x), "levels"),
        "refine seed": (lambda x: model.refine(1, seed=x), "seed"),
        "deformer": (lambda x: model.deformer(turning=x), "turning"),
        "length": (lambda x: model.length(x), "start"),
        "spaced": (lambda x: model.spaced(x), "points"),
        "nearest": (lambda x: model.nearest(x), "queries"),
        "distance": (lambda x: model.distance(x), "other"),
        "curvature": (lambda x: model.curvature(x, 1.0), "t"),
        "curvature scale": (lambda x: model.curvature(0.5, x), "scale"),
        "fractal_dimension": (lambda x: model.fractal_dimension(scales=x), "scales"),
        "to_bytes": (lambda x: model.to_bytes(x), "format"),
        "from_bytes": (lambda x: ifsm.Model.from_bytes(x), "data"),
        "Deformer": (lambda x: ifsm.Deformer(x), "model"),
        "move": (lambda x: deformer.move(x, 1, [0, 1]), "level"),
        "move handles": (lambda x: deformer.move(0, x, [0, 1]), "handles"),
        "move vectors": (lambda x: deformer.move(0, 1, x), "vectors"),
        "move radius": (lambda x: deformer.move(0, 1, [0, 1], falloff="smooth", radius=x), "radius"),
        "pin": (lambda x: deformer.pin(0, x), "handles"),
        "drag": (lambda x: deformer.drag(0, x, [0, 1]), "t"),
        "drag places": (lambda x: deformer.drag(0, 0.5, x), "places"),
        "restyle": (lambda x: deformer.restyle(0, 1, x), "scale"),
        "texture": (lambda x: deformer.texture(0, 1, x), "source"),
        "go_to": (lambda x: deformer.go_to(x), "name"),
        "at_time": (lambda x: deformer.at_time(x), "time"),
        "replay": (lambda x: deformer.replay(x), "data"),
        "deformer points": (lambda x: deformer.points(0, first=x), "first"),
        "changed": (lambda x: deformer.changed(x), "level"),
        "fit": (lambda x: ifsm.fit(x), "points"),
        "fit budget": (lambda x: ifsm.fit(points, budget=x), "budget"),
        "fit progress": (lambda x: ifsm.fit(points, progress=x),
                         "progress"),
        "fit threads": (lambda x: ifsm.fit(points, threads=x), "threads"),
        "fit_sparse": (lambda x: ifsm.fit_sparse(x), "curves"),
        "fit_curve loss": (lambda x: ifsm.fit_curve([points], loss=x), "loss"),
        "fit model": (lambda x: fit.model(x), "curve"),
        "fit budget row": (lambda x: fit.budget(0, x), "budget"),
        "curves": (lambda x: ifsm.curves(x), "geometry"),
        "System": (lambda x: ifsm.System(x), "maps"),
        "System weights": (lambda x: ifsm.System(gasket.maps, x), "weights"),
        "from_parameters": (lambda x: ifsm.System.from_parameters(x), "parameters"),
        "from_parameters scales": (lambda x: ifsm.System.from_parameters(scales=x, shifts=[[0, 0]]), "scales"),
        "from_parameters shifts": (lambda x: ifsm.System.from_parameters(shifts=x, scales=.5), "shifts"),
        "System.named": (lambda x: ifsm.System.named(x), "name"),
        "from_model": (lambda x: ifsm.System.from_model(x), "model"),
        "word": (lambda x: gasket.word(x), "symbols"),
        "point": (lambda x: gasket.point(x), "symbols"),
        "point period": (lambda x: gasket.point([0], period=x), "period"),
        "addresses": (lambda x: gasket.addresses(x, 3), "point"),
        "addresses length": (lambda x: gasket.addresses([0, 0], x), "length"),
        "box": (lambda x: gasket.box(x), "tolerance"),
        "moments": (lambda x: gasket.moments(x), "degree"),
        "moments about": (lambda x: gasket.moments(1, about=x), "about"),
        "box_dimension": (lambda x: gasket.box_dimension(x), "finest"),
        "system model": (lambda x: gasket.model(levels=x), "levels"),
        "system polygon": (lambda x: gasket.model(levels=1, polygon=x), "polygon"),
        "system to_bytes": (lambda x: gasket.to_bytes(x), "format"),
        "system from_bytes": (lambda x: ifsm.System.from_bytes(x), "data"),
        "histogram": (lambda x: gasket.histogram(x), "size"),
        "histogram window": (lambda x: gasket.histogram(8, window=x), "window"),
        "histogram points": (lambda x: gasket.histogram(8, points=x), "points"),
        "histogram seed": (lambda x: gasket.histogram(8, seed=x), "seed"),
        "set": (lambda x: gasket.set(8, tolerance=x), "tolerance"),
        "render colour": (lambda x: gasket.render(8, colour=x), "colour"),
        "render palette": (lambda x: gasket.render(8, palette=x), "palette"),
        "render background": (lambda x: gasket.render(8, background=x), "background"),
        "render symbols": (lambda x: gasket.render(8, symbols=x), "symbols"),
        "render azimuth": (lambda x: gasket.render(8, azimuth=x), "azimuth"),
        "sample": (lambda x: gasket.sample(x), "points"),
        "sample_addresses": (lambda x: gasket.sample_addresses(8, x), "length"),
        "tone_map": (lambda x: ifsm.tone_map(x), "counts"),
        "set_threads": (lambda x: ifsm.set_threads(x), "threads"),
    }


# What a wrong thing may well mean.
OPTIONAL = {"points", "points out", "keep", "keep within", "texture", "fit budget", "fit progress", "spaced",
            "System weights",
            "from_parameters scales", "point period", "box", "moments about", "box_dimension", "system polygon",
            "histogram window", "histogram points", "render background"}
MAY_BE_EMPTY = {"call", "interval", "nearest", "curvature", "move handles", "move vectors", "pin", "drag", "drag places",
                "word", "tone_map"}


def has_a_meaning(name, thing):
    if thing is None:
        return name in OPTIONAL
    if thing == [] if isinstance(thing, list) else isinstance(thing, np.ndarray) and thing.size == 0:
        return name in MAY_BE_EMPTY
    if name in ("keep within", "move radius", "at_time", "render azimuth", "box") and thing in (2**70, -2**70):
        return True  # lengths, times and angles may be any
    return name in ("call", "curvature", "fit_sparse", "tone_map") and np.shape(thing) == (2, 2, 2)  # of any shape; two curves


def test_anything_wrong_anywhere_is_refused_by_name(walk):
    model = ifsm.Model(walk[:33], filter="casteljau")
    deformer = model.deformer().move(0, 1, [1.0, 1.0])
    fit = ifsm.fit_curve([walk[:33]])
    tried = 0
    for name, (call, argument) in calls(model, deformer, fit).items():
        for wrong in WRONG_ANYWHERE:
            if callable(wrong) and name == "fit progress":
                continue  # what that raises comes out as it is: test_threads.py
            before = deformer.samples()
            try:
                call(wrong)
            except ifsm.Error as error:
                told = error.argument.split("[")[0].split(".")[0]
                assert told in (argument, "curves", "points", "dimension", "count", "parameters", "vectors", "handles",
                                "t", "places", "details"), f"{name} with {wrong!r} blames {error.argument!r}: {error}"
                assert len(str(error)) > 15, f"{name} with {wrong!r} says only {error}"
                assert np.array_equal(deformer.samples(), before)
                tried += 1
            except Exception as error:  # noqa: BLE001 -- anything else is what this test is about
                raise AssertionError(f"{name} with {wrong!r} raised {type(error).__name__}: {error}") from error
            else:
                assert has_a_meaning(name, wrong), f"{name} took {wrong!r}"
    assert tried > 1000


def test_closed_objects_are_refused_as_arguments(walk, refused):
    closed = ifsm.Model(walk)
    closed.close()
    gone = ifsm.Filter("coast")
    gone.close()
    open_model = ifsm.Model(walk)
    refused(lambda: open_model.distance(closed), ifsm.Closed, "other")
    refused(lambda: open_model.deformer().texture(0, 1, closed), ifsm.Closed, "source")
    refused(lambda: ifsm.Deformer(closed), ifsm.Closed, "model")
    refused(lambda: ifsm.Model(walk, gone), ifsm.Closed, "filter")
    refused(lambda: ifsm.fit(walk, filter=gone), ifsm.Closed, "filter")


def test_handles_of_another_kind_are_refused(walk):
    native = ifsm._native
    model, filter = ifsm.Model(walk), ifsm.Filter("coast")
    with pytest.raises(ifsm.InvalidType, match="model is a PyCapsule; give ifsm_model"):
        native.ifsm_model_samples(filter._native, None)
    with pytest.raises(ifsm.Closed):
        native.ifsm_model_samples(None, None)
    assert native.ifsm_model_samples(model._native, None) == 514


def test_huge_counts_are_refused_before_memory_is(walk):
    for call in (lambda: ifsm.Model(walk, levels=60), lambda: ifsm.Model(walk).refine(40),
                 lambda: ifsm.Model(walk).spaced(2**41)):
        with pytest.raises(ifsm.InvalidValue) as caught:
            call()
        assert caught.value.code in (ifsm.Status.LIMIT, ifsm.Status.RANGE)
