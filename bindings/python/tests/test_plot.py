"""Pictures show the numbers they should, on the axes they should."""
import importlib
import sys

import numpy as np
import pytest

import ifsm

matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402

from ifsm import plot  # noqa: E402


@pytest.fixture(autouse=True)
def no_figure_is_left():
    yield
    pyplot.close("all")


@pytest.fixture
def axes():
    """Axes that pyplot does not know."""
    return Figure(layout="constrained").subplots()


@pytest.fixture
def space():
    """A model of three dimensions."""
    t = np.linspace(0, 9, 129)
    return ifsm.Model(np.column_stack([np.cos(t), np.sin(t), t]))


@pytest.fixture
def four():
    return ifsm.Model(np.random.default_rng(4).normal(size=(65, 4)))


def shown_by(line):
    return np.column_stack(line.get_data_3d() if hasattr(line, "get_data_3d") else line.get_data())


def named(axes, label):
    """The one line with a label."""
    line, = (line for line in axes.lines if line.get_label() == label)
    return line


def words(axes):
    return [text.get_text() for text in axes.get_legend().get_texts()]


def is_near_enough_to_see(axes, points):
    (left, right), (bottom, top) = axes.get_xlim(), axes.get_ylim()
    return ((points >= [left, bottom]) & (points <= [right, top])).all(axis=1)


# ---- curve --------------------------------------------------------------------------------------------------------


def test_a_curve_is_its_points_and_its_control_polygon(model):
    axes = plot.curve(model)
    assert np.array_equal(shown_by(named(axes, "curve")), model.points())
    assert np.array_equal(shown_by(named(axes, "control polygon")), model.control_points)
    assert len(axes.lines) == 2 and words(axes) == ["curve", "control polygon"]
    assert axes.get_aspect() == 1 and (axes.get_xlabel(), axes.get_ylabel()) == ("x", "y")


def test_a_curve_without_its_polygon_is_one_line_and_needs_no_legend(model):
    axes = plot.curve(model, control_polygon=False)
    assert len(axes.lines) == 1 and axes.get_legend() is None


def test_a_curve_can_be_a_level_of_a_sketch(model):
    axes = plot.curve(model, levels=3, details=20)
    sketch = model.keep(details=20)
    assert np.array_equal(shown_by(named(axes, "level 3")), sketch.points(levels=3))
    assert np.array_equal(shown_by(named(axes, "control polygon")), sketch.control_points)


def test_a_curve_of_one_dimension_is_drawn_over_its_parameter(walk):
    model = ifsm.Model(walk[:, 0], filter="casteljau")
    axes = plot.curve(model)
    drawn = shown_by(named(axes, "curve"))
    assert np.array_equal(drawn[:, 0], np.linspace(0, 1, len(model.points())))
    assert np.array_equal(drawn[:, 1], model.points()[:, 0])
    assert np.allclose(model(drawn[:, 0])[:, 0], drawn[:, 1], rtol=0, atol=0)
    assert axes.get_aspect() == "auto" and (axes.get_xlabel(), axes.get_ylabel()) == ("parameter", "value")


def test_a_curve_of_three_dimensions_is_drawn_in_space(space):
    axes = plot.curve(space)
    assert axes.name == "3d" and axes.get_zlabel() == "z"
    assert np.array_equal(shown_by(named(axes, "curve")), space.points())
    assert np.array_equal(shown_by(named(axes, "control polygon")), space.control_points)
    given = Figure().add_subplot(projection="3d")
    assert plot.curve(space, ax=given) is given and np.array_equal(shown_by(given.lines[0]), space.points())


def test_a_curve_of_three_dimensions_is_seen_from_above_on_plane_axes(space, axes):
    plot.curve(space, ax=axes)
    assert np.array_equal(shown_by(named(axes, "curve")), space.points()[:, :2])
    assert "first two" in axes.get_xlabel()


@pytest.mark.parametrize("filter", ["casteljau", "bspline", "haar"])
@pytest.mark.parametrize("dimension", [1, 2])
def test_a_ring_is_drawn_closed(ring, filter, dimension):
    model = ifsm.Model(ring[:, :dimension], filter=filter, closed=True)
    drawn = shown_by(named(plot.curve(model), "curve"))[:, -dimension:]
    assert np.array_equal(drawn[0], drawn[-1])
    assert np.array_equal(drawn[: len(model.points())], model.points())
    assert len(drawn) == len(model.points()) + (filter != "casteljau")


def test_a_ring_of_one_dimension_has_its_values_at_their_parameters(ring):
    for filter in ("casteljau", "bspline"):
        model = ifsm.Model(ring[:, 0], filter=filter, closed=True)
        t, values = shown_by(named(plot.curve(model), "curve")).T
        assert np.array_equal(model(t)[:, 0], values)


def test_control_points_far_beside_a_curve_do_not_make_it_small(ring, model):
    axes = plot.curve(ifsm.Model(ring, filter="bspline", closed=True))
    polygon = shown_by(named(axes, "control polygon"))
    assert np.ptp(polygon, axis=0).max() > 10 * np.ptp(ring, axis=0).max()  # such is this ring
    assert np.ptp(axes.get_xlim()) < 2.2 * np.ptp(ring[:, 0]) and np.ptp(axes.get_ylim()) < 2.2 * np.ptp(ring[:, 1])
    assert is_near_enough_to_see(axes, ring).all()
    beside = model.with_control_points(model.control_points + 0.3 * np.ptp(model.points(), axis=0))
    axes = plot.curve(beside)
    assert is_near_enough_to_see(axes, beside.points()).all()
    assert is_near_enough_to_see(axes, beside.control_points).all()


def test_a_line_is_drawn_as_matplotlib_is_told(model, axes):
    plot.curve(model, ax=axes, control_polygon=False, color="red", linewidth=3, label="mine")
    line = named(axes, "mine")
    assert (line.get_color(), line.get_linewidth()) == ("red", 3)


def test_curves_on_the_same_axes_have_colours_of_their_own(model, axes):
    plot.curve(model, ax=axes, control_polygon=False, label="all")
    plot.curve(model, ax=axes, control_polygon=False, label="few", details=9)
    assert named(axes, "all").get_color() != named(axes, "few").get_color() and words(axes) == ["all", "few"]


def test_lines_of_thousands_of_points_are_thinner_and_few_points_are_seen(iceland):
    model = ifsm.Model(iceland, closed=True)
    many, few = (plot.curve(model, levels=levels, control_polygon=False).lines[0] for levels in (None, 2))
    assert len(many.get_xdata()) > 4000 and many.get_linewidth() < few.get_linewidth()
    assert few.get_marker() == "." and many.get_marker() in ("none", "None")


# ---- before and after ---------------------------------------------------------------------------------------------


def test_before_and_after_are_two_curves_and_the_last_is_on_top(model):
    bent = model.deformer().move(0, 2, [5, 20])
    axes = plot.before_after(model, bent)
    before, after = axes.lines
    assert np.array_equal(shown_by(before), model.points()) and np.array_equal(shown_by(after), bent.snapshot().points())
    assert words(axes) == ["before", "after"]
    assert before.get_linewidth() < after.get_linewidth() and before.get_color() == "0.6"


def test_before_and_after_can_have_the_new_control_polygon(model):
    bent = model.deformer().move(0, 2, [5, 20])
    axes = plot.before_after(model, bent, control_polygon=True)
    assert np.array_equal(shown_by(named(axes, "control polygon")), bent.points(0))


# ---- levels -------------------------------------------------------------------------------------------------------


def test_levels_are_small_multiples_over_the_curve(model):
    axes = plot.levels(model, [0, 2, 4, 6])
    assert axes.shape == (4,)
    for each, level in zip(axes, [0, 2, 4, 6]):
        curve, polygons = each.lines
        assert np.array_equal(shown_by(curve), model.points())
        assert np.array_equal(shown_by(polygons), model.points(levels=level))
        assert each.get_title() == f"level {level}: {len(model.points(levels=level))} points"
        assert each.get_legend() is None
    assert len(axes[0].figure.axes) == 4  # those that nothing is drawn on are gone


def test_labels_and_numbers_of_small_multiples_are_at_the_outer_ones(model):
    axes = plot.levels(model, [0, 1, 2, 3])  # three and one
    assert [each.get_xlabel() for each in axes] == ["", "x", "x", "x"]
    assert [each.get_ylabel() for each in axes] == ["y", "", "", "y"]


def test_levels_by_default_are_the_first_five_and_the_finest(model, walk):
    def told(axes):
        return [each.get_title().split(":")[0] for each in axes]

    assert told(plot.levels(model)) == [f"level {level}" for level in (0, 1, 2, 3, 4, model.levels)]
    assert told(plot.levels(ifsm.Model(walk[:9], filter="casteljau"))) == ["level 0", "level 1"]


def test_levels_can_be_laid_over_each_other(model, axes):
    drawn = plot.levels(model, [0, 3, 5], ax=axes, overlay=True)
    assert drawn.shape == (1,) and drawn[0] is axes
    assert all(np.array_equal(shown_by(line), model.points(levels=level)) for line, level in zip(axes.lines, [0, 3, 5]))
    assert words(axes) == ["level 0", "level 3", "level 5"]
    assert len({tuple(line.get_color()) for line in axes.lines}) == 3


def test_levels_are_drawn_on_the_axes_that_are_given(model):
    given = Figure().subplots(2, 2)
    drawn = plot.levels(model, [0, 1, 2, 3], ax=given)
    assert all(one is other for one, other in zip(drawn, given.ravel()))
    assert pyplot.get_fignums() == []


def test_levels_of_one_and_three_dimensions_are_drawn(walk, space):
    line = plot.levels(ifsm.Model(walk[:, 0]), 2)[0].lines[1]
    assert np.array_equal(line.get_ydata(), ifsm.Model(walk[:, 0]).points(levels=2)[:, 0])
    axes = plot.levels(space, [1, 3])
    assert np.array_equal(shown_by(axes[1].lines[1]), space.points(levels=3))


# ---- scalogram ----------------------------------------------------------------------------------------------------


def test_a_scalogram_has_a_row_a_level_and_each_detail_as_wide_as_its_node(model):
    axes = plot.scalogram(model)
    picture, = axes.images
    sizes = picture.get_array()
    finest = len(model.significance(model.levels - 1))
    assert sizes.shape == (model.levels, finest)
    for level in range(model.levels):
        expected = np.log10(np.repeat(model.significance(level), finest // len(model.significance(level))))
        assert np.array_equal(sizes[level], expected)
    assert tuple(picture.get_extent()) == (0, 1, model.levels - 0.5, -0.5)  # level 0 on top
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("parameter", "level (0: coarsest)")
    assert picture.colorbar.ax.get_ylabel() == r"$\log_{10}$ of significance"


def test_zero_details_have_a_colour_that_no_other_has(model):
    sketch = model.keep(details=30)
    picture = plot.scalogram(sketch).images[0]
    zeros = np.array([np.repeat(sketch.significance(level) == 0, 2 ** (sketch.levels - 1 - level))
                      for level in range(sketch.levels)])
    assert np.array_equal(picture.get_array().mask, zeros) and zeros.any() and not zeros.all()
    palette = picture.get_cmap()
    grey = palette(np.ma.masked_all(1))[0]
    assert np.ptp(grey[:3]) == 0 and not (np.abs(palette(np.arange(256)) - grey).max(axis=1) < 0.1).any()
    assert "grey: zero" in picture.colorbar.ax.get_ylabel()


def test_a_column_of_a_scalogram_shows_the_largest_of_its_details(iceland):
    model = ifsm.Model(iceland, closed=True)
    sizes = plot.scalogram(model).images[0].get_array()
    assert sizes.shape == (model.levels, 512)
    assert np.array_equal(sizes[9], np.log10(model.significance(9).reshape(512, 4).max(axis=1)))
    assert np.array_equal(sizes[7], np.log10(model.significance(7)))


@pytest.mark.parametrize("filter", [ifsm.Filter("casteljau", control_points=3, maps=3), ifsm.Filter("koch"),
                                    ifsm.Filter("bspline", topology="square")])
def test_scalograms_fit_any_shape_of_filter(walk, filter):
    for samples in (20, 257):
        model = ifsm.Model(walk[:samples], filter=filter)
        sizes = plot.scalogram(model).images[0].get_array()
        assert sizes.shape[0] == model.levels and sizes.shape[1] <= 512
        assert [row.max() for row in sizes] == [np.log10(model.significance(k).max()) for k in range(model.levels)]


def test_a_scalogram_spans_six_decades_at_most_and_shows_models_without_any_size():
    samples = np.zeros((65, 1))
    samples[20], samples[50] = 1, 1e-9
    picture = plot.scalogram(ifsm.Model(samples, filter="haar")).images[0]
    low, high = picture.get_clim()
    assert high - low == pytest.approx(6) and high == picture.get_array().max()
    assert picture.colorbar.extend == "min"
    empty = plot.scalogram(ifsm.Model.from_polygon([[0, 0], [1, 2], [2, 0]], levels=3)).images[0]
    assert empty.get_array().mask.all() and empty.get_clim() == (0, 1)


# ---- residuals ----------------------------------------------------------------------------------------------------


def test_residuals_are_distances_over_parameters_with_their_rms(model):
    sketch = model.keep(details=40)
    axes = plot.residuals(model, sketch)
    distances, rms = axes.lines
    assert np.array_equal(distances.get_xdata(), model.parameters())
    assert np.array_equal(distances.get_ydata(), np.linalg.norm(model.samples() - sketch.samples(), axis=1))
    assert list(rms.get_ydata()) == [model.distance(sketch).rms] * 2
    assert words(axes) == ["distance", f"RMS {model.distance(sketch).rms:.4g}"]
    assert axes.get_ylim()[1] > 1.2 * distances.get_ydata().max()
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("parameter", "distance from the model")


def test_residuals_of_the_same_curve_are_none(model):
    assert not plot.residuals(model, model).lines[0].get_ydata().any()


# ---- all of them --------------------------------------------------------------------------------------------------

EACH = [("curve", plot.curve), ("levels", lambda model, **o: plot.levels(model, overlay=True, **o)[0]),
        ("scalogram", plot.scalogram),
        ("residuals", lambda model, **o: plot.residuals(model, ifsm.Model(model.samples() + 1), **o)),
        ("before_after", lambda model, **o: plot.before_after(model, model, **o))]
each = pytest.mark.parametrize("draw", [draw for _, draw in EACH], ids=[name for name, _ in EACH])


@each
def test_axes_that_are_given_are_used_and_returned_and_pyplot_learns_of_none(draw, model, axes):
    assert draw(model, ax=axes) is axes
    assert axes.lines or axes.images
    assert pyplot.get_fignums() == []


@each
def test_without_axes_one_figure_is_made_whose_labels_are_not_cut(draw, model):
    axes = draw(model)
    assert pyplot.get_fignums() == [axes.figure.number]
    axes.figure.canvas.draw()
    whole = axes.figure.bbox.padded(1)
    box = axes.get_tightbbox(axes.figure.canvas.get_renderer())
    assert whole.x0 <= box.x0 and whole.y0 <= box.y0 and box.x1 <= whole.x1 and box.y1 <= whole.y1


@each
def test_labels_that_axes_have_stay(draw, model, axes):
    axes.set(xlabel="easting (km)", ylabel="northing (km)")
    draw(model, ax=axes)
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("easting (km)", "northing (km)")


@each
def test_axes_that_are_none_are_refused_before_a_figure_is_made(draw, model, refused):
    for wrong in (pyplot, "ax", Figure()):
        refused(lambda: draw(model, ax=wrong), ifsm.InvalidType, "ax")
    assert pyplot.get_fignums() == []


@pytest.mark.parametrize("name", [name for name in plot.__all__ if name != "system"])
def test_what_is_no_model_is_refused_by_name(name, model, refused):
    draw = getattr(plot, name)
    arguments = {"residuals": ["model", "sketch"], "before_after": ["model", "deformed"]}.get(name, ["model"])
    closed = ifsm.Model(model.samples())
    closed.close()
    for argument in arguments:
        given = {each: model for each in arguments}
        for wrong in (model.points(), None, "coast.ifsm", model.filter):
            error = refused(lambda: draw(**{**given, argument: wrong}), ifsm.InvalidType, argument)
            assert error.function == f"ifsm.plot.{name}" and "ifsm.Deformer" in str(error)
        refused(lambda: draw(**{**given, argument: closed}), ifsm.Closed, argument)
    assert pyplot.get_fignums() == []


def test_four_dimensions_are_refused_where_there_is_no_picture_of_them(four, refused):
    for draw, argument in ((plot.curve, "model"), (plot.levels, "model"),
                           (lambda model: plot.before_after(model, model), "model")):
        refused(lambda: draw(four), ifsm.InvalidValue, argument, code=ifsm.Status.SHAPE)
    assert pyplot.get_fignums() == []
    assert plot.scalogram(four).images and plot.residuals(four, four.keep(details=5)).lines


def test_options_that_will_not_do_are_refused_by_name_before_a_figure_is_made(model, space, refused):
    refused(lambda: plot.curve(model, levels=99), ifsm.InvalidValue, "levels")
    refused(lambda: plot.curve(model, levels="all"), ifsm.InvalidType, "levels")
    refused(lambda: plot.curve(model, details=-1), ifsm.InvalidValue, "details")
    refused(lambda: plot.levels(model, [1, 99]), ifsm.InvalidValue, "which")
    refused(lambda: plot.levels(model, []), ifsm.InvalidValue, "which", required=1)
    refused(lambda: plot.levels(model, 1.5), ifsm.InvalidType, "which")
    refused(lambda: plot.levels(model, [0, 1], ax=Figure().subplots()), ifsm.InvalidValue, "ax", required=2)
    refused(lambda: plot.levels(model, [0, 1], ax=Figure().subplots(2), overlay=True), ifsm.InvalidValue, "ax", required=1)
    refused(lambda: plot.before_after(model, space), ifsm.InvalidValue, "deformed", required=2)
    refused(lambda: plot.residuals(model, space), ifsm.InvalidValue, "sketch", required=2)
    shorter = ifsm.Model(model.samples()[:-1])
    refused(lambda: plot.residuals(model, shorter), ifsm.InvalidValue, "sketch", required=257)
    without = ifsm.Model.from_polygon([[0, 0], [1, 2], [2, 0]], levels=0)
    refused(lambda: plot.scalogram(without), ifsm.InvalidValue, "model")
    assert pyplot.get_fignums() == []


def test_deformers_are_drawn_as_they_are(model):
    bent = model.deformer().move(0, 2, [5, 20]).move(2, 3, [1, 1])
    now = bent.snapshot()
    assert np.array_equal(shown_by(plot.curve(bent).lines[0]), now.points())
    assert np.array_equal(shown_by(plot.levels(bent, 3)[0].lines[1]), now.points(levels=3))
    distances = np.linalg.norm(now.samples() - model.samples(), axis=1)
    assert np.array_equal(plot.residuals(model, bent).lines[0].get_ydata(), distances)
    assert plot.scalogram(bent).images[0].get_array().shape == (model.levels, 128)


def test_notebooks_show_a_picture_without_pyplot(model, space):
    for shown in (model, space, model.deformer()):
        assert shown._repr_png_().startswith(b"\x89PNG")
    assert pyplot.get_fignums() == []


def test_without_matplotlib_the_error_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    monkeypatch.delitem(sys.modules, "ifsm.plot")
    monkeypatch.delattr(ifsm, "plot")
    with pytest.raises(ImportError, match=r"pip install ifsm\[plot\]"):
        importlib.import_module("ifsm.plot")
