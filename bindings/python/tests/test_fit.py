import numpy as np
import pytest

import ifsm


def test_five_lines_do_the_main_job(iceland):
    model = ifsm.fit(iceland, closed=True, budget=128)
    assert model.closed and model.sample_count == len(iceland) - 1
    assert np.abs(model.samples() - iceland[:-1]).max() <= 1e-12 * model.diagonal
    start = ifsm.Model(iceland, "coast", closed=True)
    sketch = model.keep(details=123)
    assert model.distance(sketch).rms < start.distance(start.keep(details=123)).rms


def test_is_the_first_model_of_a_fit_of_one_curve(walk):
    with ifsm.fit_sparse([walk], budgets=[32, 64]) as fit:
        assert ifsm.fit_sparse([walk], budgets=[32, 64]).model() == fit.model()
        assert fit.report.budgets == 2 and fit.report.stage == "sparse"
        assert fit.sketch(budget=0).details_kept <= 32 - 5
        row = fit.budget(0, 1)
        assert row.budget == 64 and row.rms <= row.start_rms
        assert fit.filter == fit.model().filter
        kept = fit.model()
    assert kept.samples().shape == walk.shape  # models live on
    assert ifsm.fit(walk, budget=32) == ifsm.fit_sparse([walk], budgets=[32]).model()


def test_curves_share_one_filter(walk, ring):
    fit = ifsm.fit_sparse([walk, (ring, True)], filter="casteljau", control_points=4)
    assert fit.report.curves == 2
    assert fit.model(0).filter == fit.model(1).filter and fit.filter.control_points == 4
    assert fit.model(1).closed and not fit.model(0).closed


def test_keeps_a_bound(walk):
    model = ifsm.fit(walk, within=2.0, distance="largest")
    assert model.distance(model.keep(within=2.0, distance="largest")).largest <= 2.0


def test_stage_curve_finds_the_control_points_again():
    truth = ifsm.Model.from_polygon([[0, 0], [1, 3], [2, -1], [3, 2], [4, 0]], levels=6)
    fit = ifsm.fit_curve([truth.points()], fixed_filter=True)
    assert fit.report.stage == "curve"
    # A linear least-squares problem of condition below 1e3, on numbers of size 4.
    assert np.abs(fit.sketch().control_points - truth.control_points).max() <= 1e-12
    assert fit.parameters().shape == (truth.place_count,)


def test_stage_curve_tells_how_sure_it_is(walk):
    noisy = ifsm.Model.from_polygon([[0, 0], [1, 3], [2, -1], [3, 2], [4, 0]], levels=6).points()
    noisy = noisy + np.random.default_rng(3).normal(scale=0.01, size=noisy.shape)
    fit = ifsm.fit_curve([noisy], fixed_filter=True, known=[ifsm.Known(fixed_ends=True, weights=np.ones(len(noisy)))])
    covariance = fit.covariance()
    assert covariance.shape == (10, 10) and np.allclose(covariance, covariance.T, rtol=0, atol=1e-12 * covariance.max())
    assert fit.curve_covariance([0.1, 0.5]).shape == (2, 2, 2) and fit.curve_covariance(0.5).shape == (2, 2)
    assert fit.report.noise == pytest.approx(0.01, rel=0.2)
    assert np.abs(fit.sketch()(0.0) - noisy[0]).max() <= 1e-15  # a rounding of numbers below 4


def test_what_is_known_holds():
    noisy = ifsm.Model.from_polygon([[0, 0], [1, 3], [2, -1], [3, 2], [4, 0]], levels=6).points()
    fit = ifsm.fit_curve([noisy], known=[ifsm.Known(through=[(0.5, [2, 2])], along=[(0, [1, 1])])], fixed_filter=True)
    curve = fit.sketch()
    assert np.abs(curve(0.5) - [2, 2]).max() <= 1e-10
    first, second = curve.points()[:2]
    across = (second - first) @ [1, -1]
    assert abs(across) <= 1e-10


def test_stage_filter_and_training_run(ring, walk):
    fit = ifsm.fit_filter([walk], kept_levels=2)
    assert fit.report.stage == "filter" and fit.report.final_cost <= fit.report.start_cost
    assert fit.sketch().details_kept <= 4 * (1 + 2)
    trained, report = ifsm.train([walk, (ring, True)], rounds=1, iterations=2)
    assert isinstance(trained, ifsm.Filter) and report.trained == 2 and report.ratio <= 1


def test_bits_do_not_depend_on_threads(walk, ring):
    curves = [walk, (ring, True), walk[::-1]]
    one = ifsm.fit_sparse(curves, threads=1)
    assert all(one.model(c) == ifsm.fit_sparse(curves, threads=count).model(c) for count in (2, 3) for c in range(3))


def test_fits_are_not_pickled(walk):
    import copy
    import pickle

    fit = ifsm.fit_sparse([walk], iterations=1)
    for attempt in (pickle.dumps, copy.copy):
        with pytest.raises(TypeError, match="models"):
            attempt(fit)
    with pytest.raises(TypeError, match="fit_sparse"):
        ifsm.Fit()


def test_progress_is_told_in_order_and_can_cancel(walk):
    told = []
    ifsm.fit(walk, progress=lambda fraction, stage: told.append((fraction, stage)))
    fractions = [fraction for fraction, _ in told]
    assert fractions == sorted(fractions) and fractions[-1] == 1 and told[-1][1] == "done"
    with pytest.raises(ifsm.Cancelled):
        ifsm.fit(walk, progress=lambda *_: True)


def test_progress_bars_are_optional(walk, capsys, monkeypatch):
    import sys

    pytest.importorskip("tqdm")
    ifsm.fit(walk, progress=True)
    assert "100%" in capsys.readouterr().err
    monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    ifsm.fit(walk, progress=True)
    assert capsys.readouterr().err == ""


def test_names_what_is_wrong(walk, refused):
    bad = walk.copy()
    bad[3, 1] = np.inf
    refused(lambda: ifsm.fit(bad), ifsm.InvalidValue, "points", index=7, value=np.inf, code=ifsm.Status.NOT_FINITE)
    refused(lambda: ifsm.fit_sparse([walk, bad]), ifsm.InvalidValue, "curves[1].points", index=7)
    refused(lambda: ifsm.fit(walk, budget=2), ifsm.InvalidValue, "budget", value=2)
    refused(lambda: ifsm.fit(walk, budget=2.5), ifsm.InvalidType, "budget")
    refused(lambda: ifsm.fit(walk, control_points=99), ifsm.InvalidValue, "control_points", value=99)
    refused(lambda: ifsm.fit(walk, control_points=6, filter="coast"), ifsm.InvalidValue, "control_points")
    refused(lambda: ifsm.fit(walk, filter="silk"), ifsm.InvalidValue, "filter")
    refused(lambda: ifsm.fit(walk, filter=walk), ifsm.InvalidType, "filter")
    refused(lambda: ifsm.fit(walk, within=-1), ifsm.InvalidValue, "within", value=-1)
    refused(lambda: ifsm.fit(walk, distance="far"), ifsm.InvalidValue, "distance")
    refused(lambda: ifsm.fit(walk, progress="bar"), ifsm.InvalidType, "progress")
    refused(lambda: ifsm.fit_sparse(walk[0, 0]), ifsm.InvalidType, "curves")
    refused(lambda: ifsm.fit_curve([walk], known=["much"]), ifsm.InvalidType, "known[0]")
    refused(lambda: ifsm.fit_curve([walk], known=3), ifsm.InvalidType, "known")
    refused(lambda: ifsm.Known(through=0.5), ifsm.InvalidType, "through")
    refused(lambda: ifsm.Known(through=[0.5, 1]), ifsm.InvalidType, "through")
    refused(lambda: ifsm.Known(along=[("a", [1, 2])]), ifsm.InvalidType, "along")
    refused(lambda: ifsm.Known(through=[(0.5, [1, 2])], along=[(0, [1])]), ifsm.InvalidValue, "through")
    assert ifsm.Known(through=[(0.5, 1.0)])._told()[5].tolist() == [1.0]


def test_one_curve_where_a_list_is_wanted_is_no_thousand_curves(refused, walk):
    for call in (ifsm.fit_sparse, ifsm.fit_curve, ifsm.fit_filter, ifsm.train):
        assert "[points]" in str(refused(lambda: call(walk), ValueError, "curves"))
    assert ifsm.fit_sparse(np.cumsum(np.ones((2, 65)), axis=1), iterations=1).report.curves == 2  # profiles, as rows
    assert ifsm.fit((walk, False), iterations=1) == ifsm.fit(walk, iterations=1)


def test_nothing_is_ignored_silently(refused, walk):
    refused(lambda: ifsm.fit(walk, within=0), ValueError, "within")
    refused(lambda: ifsm.fit(walk, within=1.0, budget=20), ValueError, "within")
    refused(lambda: ifsm.fit_sparse([walk], budgets=[]), ValueError, "budgets")
    refused(lambda: ifsm.fit_curve([walk], known=[]), ValueError, "known")
    refused(lambda: ifsm.fit(walk, closed="no"), TypeError, "closed")
    assert "joined" in str(refused(lambda: ifsm.fit(walk, filter="haar"), ValueError, "filter"))
    assert "name" in str(refused(lambda: ifsm.fit(walk, filter=3), TypeError, "filter"))
    error = refused(lambda: ifsm.fit_curve([walk], known=[ifsm.Known(weights=[1, 2])]), ValueError, None)
    assert error.argument.startswith("known[0]") and "samples" not in str(error)


def test_known_tells_what_is_known():
    assert repr(ifsm.Known()) == "<ifsm.Known: nothing>"
    known = ifsm.Known(weights=[1, 2], through=[(0.5, [0, 1])], fixed_ends=True)
    assert repr(known) == "<ifsm.Known: weights, through 1 points, fixed ends>"
