import copy
import pickle

import numpy as np
import pytest

import ifsm

EPS = np.finfo(float).eps


def test_gives_its_samples_back(walk, ring):
    for points, closed in ((walk, False), (ring, True)):
        model = ifsm.Model(points, filter="casteljau", closed=closed)
        assert model.closed is closed
        # The library's promise: 1e-12 of the bounding box's diagonal for n <= 12.
        assert np.abs(model.samples() - points).max() <= 1e-12 * model.diagonal
        # The polyline at the samples' parameters is the samples, bit for bit.
        assert np.array_equal(model(model.parameters()), model.samples())


def test_tells_what_it_is(model, walk):
    assert (model.dimension, model.closed, model.sample_count) == (2, False, 257)
    assert model.levels == 6 and model.place_count == 4 * 2**6 + 1
    assert model.detail_count == 4 * (2**6 - 1) == model.details_kept
    assert model.control_points.shape == (5, 2)
    assert model.diagonal == pytest.approx(np.hypot(*np.ptp(walk, axis=0)), rel=4 * EPS)
    assert model.filter == ifsm.Filter("casteljau")


def test_a_ring_may_repeat_its_first_point(ring):
    again = np.vstack([ring, ring[:1]])
    assert ifsm.Model(again, closed=True) == ifsm.Model(ring, closed=True)


def test_is_called_with_parameters_of_any_shape(model):
    assert model(0.25).shape == (2,)
    assert model([0.25, 0.5]).shape == (2, 2)
    assert model(np.full((3, 4), 0.25)).shape == (3, 4, 2)
    assert model(np.empty((0,))).shape == (0, 2)
    assert np.array_equal(model(0), model.samples()[0]) and np.array_equal(model(1), model.samples()[-1])
    smooth = ifsm.Model(np.array([[0.0, 0], [1, 2], [3, 3], [4, 0], [6, 1]]), filter="casteljau")
    assert smooth(0.5, curve="limit").shape == (2,)


def test_points_of_all_levels_start_at_the_control_polygon(model):
    assert np.array_equal(model.points(levels=0), model.control_points)
    for level in range(model.levels + 1):
        assert model.points(levels=level).shape == (4 * 2**level + 1, 2)
    assert np.array_equal(model.points(), model.points(levels=model.levels))


def test_points_with_few_details_are_those_of_the_sketch(model):
    assert np.array_equal(model.points(details=20), model.keep(details=20).points())


def test_keeps_by_every_rule(model):
    assert model.keep(details=20).details_kept <= 20
    two = model.keep(levels=2)
    assert two.details_kept == 4 * (1 + 2) and np.array_equal(two.details(1), model.details(1))
    least = float(np.sort(np.concatenate([model.significance(level) for level in range(model.levels)]))[-10])
    assert model.keep(above=least).details_kept == 9
    bound = 0.05 * model.diagonal
    assert model.distance(model.keep(within=bound)).rms <= bound
    assert model.distance(model.keep(within=bound, distance="largest")).largest <= bound
    assert model.distance(model.keep(levels_within=bound)).rms <= bound


def test_keep_wants_exactly_one_rule(model, refused):
    refused(lambda: model.keep(), ifsm.InvalidValue, "details")
    refused(lambda: model.keep(details=3, levels=2), ifsm.InvalidValue, "levels")
    refused(lambda: model.keep(details=-1), ifsm.InvalidValue, "details", value=-1)
    refused(lambda: model.keep(within=0.0), ifsm.InvalidValue, "within")
    refused(lambda: model.keep(above=float("nan")), ifsm.InvalidValue, "above")


def test_details_and_control_points_can_be_changed(model):
    vectors = model.details(3)
    assert model.with_details(3, vectors) == model
    assert np.array_equal(model.with_details(3, 2 * vectors).details(3), 2 * vectors)
    moved = model.with_control_points(model.control_points + [10, 0])
    # Moved as a whole: each point is a sum of K terms about as large as the curve.
    assert np.abs(moved.samples() - model.samples() - [10, 0]).max() <= 1e-12 * model.diagonal
    flat = ifsm.Model.from_polygon([[0, 0], [1, 2], [3, 1]], levels=4)
    assert flat.details_kept == 0 and np.array_equal(flat.control_points, [[0, 0], [1, 2], [3, 1]])
    assert model.with_filter(ifsm.Filter("coast")).filter == ifsm.Filter("coast")


def test_addresses_name_intervals(model):
    symbols = model.address(0.3, 6)
    first, last = model.interval(symbols)
    assert symbols.dtype == np.int32 and last - first == 2.0**-6 and first <= 0.3 < last
    assert model.interval([]) == (0.0, 1.0)


def test_answers_questions_about_a_circle():
    t = np.linspace(0, 2 * np.pi, 1025)[:-1]
    circle = ifsm.Model(2 * np.column_stack([np.cos(t), np.sin(t)]), filter="casteljau", closed=True)
    # Inscribed polygon of m sides: 2 m r sin(pi / m).
    assert circle.length() == pytest.approx(2 * 1024 * 2 * np.sin(np.pi / 1024), rel=1e-12)
    near = circle.nearest([[4, 0], [0, 0.5]])
    assert near.points.shape == (2, 2) and near.distances[0] == pytest.approx(2, abs=1e-12)
    assert circle.curvature(0.2, 0.1) == pytest.approx(1 / 2 * (1 + 0.13 * (0.1 / 2) ** 2), rel=1e-3)
    assert circle.curvature([0.2, 0.3], 0.1).shape == (2,)
    assert len(circle.spaced(16)) == 16 and np.allclose(np.diff(circle.spaced(16)), 1 / 16, atol=1e-9)
    assert circle.fractal_dimension("divider").dimension == pytest.approx(1, abs=0.02)
    assert circle.crossings().points.shape == (0, 2)
    eight = ifsm.Model(np.column_stack([np.sin(t), np.sin(2 * t + 0.1)]), filter="casteljau", closed=True)
    assert len(eight.crossings().points) == 1
    spectrum = circle.spectrum()
    assert spectrum.scales.shape == spectrum.rms.shape == (circle.levels,)


def test_refines_with_the_same_bits_for_the_same_seed(model):
    finer = model.refine(2, seed=7)
    assert finer.levels == model.levels + 2
    assert finer == model.refine(2, seed=7) and finer != model.refine(2, seed=8)
    assert model.refine(1, roughness=0).length() == pytest.approx(model.length(), rel=1e-9)


def test_is_equal_hashed_and_pickled_by_what_it_says(model, walk):
    same = ifsm.Model(walk, filter="casteljau")
    other = ifsm.Model(walk + 1e-9, filter="casteljau")
    assert model == same and hash(model) == hash(same) and model is not same
    assert model != other and model != "a model" and len({model, same, other}) == 2
    for protocol in range(pickle.HIGHEST_PROTOCOL + 1):
        assert pickle.loads(pickle.dumps(model, protocol)) == model
    assert copy.copy(model) is model and copy.deepcopy({"a": [model]})["a"][0] == model


def test_files_hold_the_bits_in_both_formats(model, tmp_path):
    for name in ("curve.ifsm", "curve.json"):
        model.save(tmp_path / name)
        assert ifsm.load(tmp_path / name) == model
    assert (tmp_path / "curve.json").read_bytes().startswith(b"{")
    for made in (bytes, bytearray, memoryview):
        assert ifsm.Model.from_bytes(made(model.to_bytes("json"))) == model
    assert ifsm.Model.from_bytes(np.frombuffer(model.to_bytes(), np.uint8).tobytes()) == model


def test_ends_when_closed_and_says_so(model, refused):
    with model as held:
        assert held is model
    refused(lambda: model.samples(), ifsm.Closed, "self")
    refused(lambda: model(0.5), ifsm.Closed, "self")
    with pytest.raises(ifsm.Closed):
        with model:
            pass
    assert repr(model) == "<ifsm.Model, closed>"
    model.close()  # again is fine


def test_shows_itself_in_notebooks(model):
    page = model._repr_html_()
    assert "<svg" in page and "257" in page and page.count("<tr>") == 7
    assert model._repr_png_().startswith(b"\x89PNG")
    line = ifsm.Model([[0.0], [1.0], [0.5], [2.0]])
    assert "<svg" in line._repr_html_() and line._repr_png_().startswith(b"\x89PNG")


def test_errors_name_what_python_has(refused, model, tmp_path):
    assert str(refused(lambda: model.length(0, 1.5), ValueError, "stop")).startswith("stop is 1.5")
    assert str(refused(lambda: model(1.1), ValueError, "t")).startswith("t is 1.1")
    assert refused(lambda: model([0.5, 1.1]), ValueError, "t").index == 1
    assert "(5, 2)" in str(refused(lambda: model.with_control_points([[0, 0]]), ValueError, "points"))
    assert "(4, 2)" in str(refused(lambda: model.with_details(0, [[0, 0]]), ValueError, "vectors"))
    assert "(9, 9)" in str(refused(lambda: ifsm.Filter.from_matrix(np.eye(3), control_points=5, maps=2), ValueError, "matrix"))
    transposed = ifsm.Filter("casteljau").matrix[:5].T
    refused(lambda: ifsm.Filter.from_maps(transposed, control_points=5, maps=2), ValueError, "matrix")
    assert "square" in str(refused(lambda: ifsm.Filter("haar"), ValueError, "topology"))
    assert "ifsm.Model" in str(refused(lambda: model.with_filter(ifsm.Filter("casteljau", control_points=3)), ValueError, None))
    assert model.with_filter("casteljau") == model
    refused(lambda: model.refine(roughness=-1), ValueError, "roughness")
    path = tmp_path / "x.csv"
    path.write_text("x,y")
    assert str(refused(lambda: ifsm.load(path), ValueError, None)).startswith(str(path))
    assert repr(ifsm.Model.__new__(ifsm.Model)) == "<ifsm.Model, closed>"


def test_sizes_that_no_memory_holds_are_refused_at_once(refused, model):
    error = refused(lambda: model.refine(30), MemoryError, "levels")
    assert "GiB" in str(error) and error.required > 2 ** 30
    refused(lambda: ifsm.Model.from_polygon([[0, 0], [1, 1], [2, 0]], levels=37), MemoryError, "levels")


def test_the_spectrum_of_a_straight_line_is_no_measurement():
    line = ifsm.Model(np.column_stack([np.arange(65.0), np.zeros(65)]), "casteljau")
    assert np.isnan(line.spectrum().hurst) and np.isnan(line.spectrum().dimension)
