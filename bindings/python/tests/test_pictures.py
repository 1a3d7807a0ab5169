"""Pictures of systems: what arrays hold, and how long calls behave."""
import math
import zlib

import numpy as np
import pytest

import ifsm

U8 = np.dtype(np.uint8)


@pytest.fixture(scope="module")
def gasket():
    return ifsm.systems.gasket_right()


@pytest.fixture(scope="module")
def fern():
    return ifsm.systems.fern()


# ---- counts, sets, distances --------------------------------------------------------------------------------------


def test_a_histogram_counts_every_point(fern):
    counts, report = fern.histogram((300, 200), points=100_000, full=True)
    assert (counts.shape, counts.dtype) == ((200, 300), np.uint32)
    assert (report.width, report.height) == (300, 200)
    assert counts.sum() == report.points == report.inside == 100_000
    assert (counts > 0).sum() == report.met and report.undecided == 0
    left, bottom, right, top = report.window
    low, high = fern.box()
    assert left < low[0] and bottom < low[1] and right > high[0] and top > high[1]
    assert np.array_equal(counts, fern.histogram((300, 200), points=100_000))


def test_row_0_is_on_top_and_points_are_where_they_belong(gasket):
    """The gasket's corners: (0, 0), (1, 0), (0, 1); none at (1, 1)."""
    window = -.013, -.017, 1.019, 1.011  # in which no point lies upon an edge
    counts = gasket.histogram(64, window=window, points=50_000, seed=3)
    assert counts[-2, 1] > 0 and counts[-2, -2] > 0 and counts[1, 1] > 0 and not counts[:31, 33:].any()
    x, y = gasket.sample(50_000, seed=3).T
    expected, _, _ = np.histogram2d(y, x, bins=64, range=[window[1::2], window[::2]])
    # Both play the same game, the histogram in single precision: one point in 10^4 is beside its pixel (docs/systems.md).
    assert np.abs(counts - expected[::-1]).sum() <= 50_000 / 1000


def test_the_window_that_is_chosen_is_the_same_when_it_is_given(fern):
    for system in (fern, ifsm.System([[.5, 0, 1e6, 0, .5, 1e6]]), ifsm.systems.cantor_set()):
        counts, report = system.histogram(50, full=True)
        again, told = system.histogram(50, window=report.window, full=True)
        assert np.array_equal(again, counts) and told == report and report.inside == report.points


def test_a_window_may_miss_the_attractor(gasket):
    counts, report = gasket.histogram(16, window=(5, 5, 6, 6), full=True)
    assert not counts.any() and report.inside == 0 and report.window == (5, 5, 6, 6) and report.points > 0


def test_a_set_is_proven(gasket):
    pixels, report = gasket.set(64, window=(-.01, -.01, 1.01, 1.01), full=True)
    assert (pixels.shape, pixels.dtype) == ((64, 64), U8) and set(np.unique(pixels)) <= {0, 1, 2}
    assert (pixels == 2).sum() == report.met and (pixels == 1).sum() == report.undecided
    assert report.points == 0
    counts = gasket.histogram(64, window=(-.01, -.01, 1.01, 1.01))
    assert not ((counts > 0) & (pixels == 0)).any()  # no point of the attractor where there is none
    assert gasket.set(64, tolerance=1).shape == (64, 64)


def test_distances_are_those_of_the_points_nearby(gasket):
    window = (-.5, -.5, 1.5, 1.5)
    found, report = gasket.distances(20, window=window, tolerance=.01, full=True)
    assert (found.shape, found.dtype) == ((20, 20), np.float64) and report.window == window
    middles = -.5 + (np.arange(20) + .5) / 10
    # Of the corner at the lower left: the nearest point of the attractor to what lies to the left of and below it.
    assert found[-1, 0] == pytest.approx(math.hypot(middles[0], middles[0]), abs=.01 / 10)
    assert found[0, -1] == pytest.approx((2 * middles[-1] - 1) / math.sqrt(2), abs=.01 / 10)
    points = gasket.sample(100_000)
    for row, column in ((3, 3), (12, 9), (8, 14)):
        at = np.array([middles[column], -middles[row] + 1])
        nearest = np.linalg.norm(points - at, axis=1).min()
        assert found[row, column] <= nearest + .01 / 10 and found[row, column] >= nearest - .01


# ---- colours ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("colour", ["tone", "symbol", "address", "set", "distance"])
@pytest.mark.parametrize("palette", ["ember", ["#102030", "#fff"]])
def test_pictures_of_the_plane(fern, colour, palette):
    pixels, report = fern.render((60, 90), colour=colour, palette=palette, full=True)
    assert (pixels.shape, pixels.dtype) == ((90, 60, 4), U8) and pixels[..., 3].any()
    assert (report.width, report.height) == (60, 90)
    assert len(np.unique(pixels.reshape(-1, 4), axis=0)) > 2
    on_white = fern.render((60, 90), colour=colour, palette=palette, background="white")
    assert (on_white[..., 3] == 255).all()


@pytest.mark.parametrize("colour", ["tone", "symbol", "address"])
def test_pictures_of_space(colour):
    tetrahedron = ifsm.systems.tetrahedron()
    pixels, report = tetrahedron.render(64, colour=colour, azimuth=.5, elevation=.3, full=True)
    assert pixels.shape == (64, 64, 4) and pixels[32, 32, 3] > 0 and report.window[0] == -report.window[2]
    assert not np.array_equal(pixels, tetrahedron.render(64, colour=colour, azimuth=.7, elevation=.3))
    assert not np.array_equal(pixels, tetrahedron.render(64, colour=colour, azimuth=.5, elevation=.3, field=1))


def test_space_has_no_sets(refused):
    sponge = ifsm.systems.sponge()
    for call in (lambda: sponge.render(16, colour="set"), lambda: sponge.render(16, colour="distance"),
                 lambda: sponge.set(16), lambda: sponge.histogram(16), lambda: sponge.distances(16)):
        assert refused(call, ifsm.InvalidValue, None).code is ifsm.Status.SHAPE


def test_maps_have_colours_of_their_own(gasket):
    pixels = gasket.render(64, window=(0, 0, 1, 1), colour="symbol", oversample=1)
    pieces = pixels[:32, :31], pixels[33:, :31], pixels[33:, 33:]
    colours = [np.median(piece[piece[..., 3] > 0], axis=0) for piece in pieces]
    for one, other in ((0, 1), (0, 2), (1, 2)):
        assert np.abs(colours[one] - colours[other]).max() > 40


def test_palettes_of_ones_own_go_from_few_to_many_points(gasket):
    own = gasket.render(64, palette=["#ff0000", "#00f"], oversample=1)
    counts = gasket.histogram(64)
    assert own[counts == counts.max()][0].tolist() == [0, 0, 255, 255]
    assert own[counts == counts[counts > 0].min()][0, 0] > 150


@pytest.mark.parametrize("given, alpha", [(None, 0), ("transparent", 0), ("white", 255), ("#123", 255), ("#123f", 255),
                                          ("#112233", 255), ("#11223380", 128), ((17, 34, 51), 255), ([17, 34, 51, 9], 9),
                                          (np.array([17, 34, 51], np.uint8), 255)])
def test_backgrounds(gasket, given, alpha):
    corner = gasket.render(16, window=(0, 0, 1, 1), background=given)[0, -1]
    white = isinstance(given, str) and given == "white"
    assert corner.tolist() == ([0, 0, 0, 0] if alpha == 0 else [255, 255, 255, 255] if white else [17, 34, 51, alpha])


def test_counts_of_ones_own_are_coloured_as_a_picture_is(fern, gasket):
    counts = fern.histogram(100, points=500_000, seed=5)
    for options in ({}, {"palette": "ink"}, {"palette": ["#000", "#fff"], "background": "#abcdef"}):
        pixels = ifsm.tone_map(counts, **options)
        assert (pixels.shape, pixels.dtype) == ((100, 100, 4), U8)
        assert np.array_equal(pixels, fern.render(100, points=500_000, seed=5, oversample=1, **options))
    assert np.array_equal(ifsm.tone_map(counts.astype(float)), ifsm.tone_map(counts.tolist()))
    assert ifsm.tone_map(counts[::2, ::3]).shape == (50, 34, 4)
    assert ifsm.tone_map(counts.reshape(10, 10, 100)).shape == (10, 10, 100, 4)
    assert ifsm.tone_map(np.zeros((0, 3), np.int64)).shape == (0, 3, 4)


# ---- points -------------------------------------------------------------------------------------------------------


def test_samples_are_points_of_the_measure(gasket):
    points = gasket.sample(100_000)
    assert (points.shape, points.dtype) == ((100_000, 2), np.float64)
    assert np.array_equal(gasket.sample(100), points[:100])
    assert not np.array_equal(gasket.sample(100, seed=1), points[:100])
    assert np.abs(points.mean(axis=0) - 1 / 3).max() <= 5 * math.sqrt((5 / 27 - 1 / 9) / 100_000)
    assert ifsm.systems.sponge().sample(9).shape == (9, 3)
    assert len(gasket.sample()) == 65536


def test_addresses_are_those_of_the_same_points(gasket):
    points, symbols = gasket.sample(200, seed=4), gasket.sample_addresses(200, 30, seed=4)
    assert (symbols.shape, symbols.dtype) == ((200, 30), np.int32)
    for point, word in zip(points, symbols):
        assert np.abs(gasket.point(word) - point).max() <= 2.0 ** -29
    assert np.array_equal(gasket.sample_addresses(200, 1, seed=4), symbols[:, :1])


# ---- bits, options, errors ----------------------------------------------------------------------------------------


def test_bits_do_not_depend_on_threads(fern):
    for call in (fern.histogram, fern.set, fern.render,
                 lambda size, **options: fern.render(size, colour="address", **options),
                 lambda size, **options: fern.sample(size * size, **options),
                 lambda size, **options: fern.distances(size // 5, **options)):
        assert np.array_equal(call(200, threads=1), call(200, threads=2))
    assert not np.array_equal(fern.histogram(64, seed=1), fern.histogram(64, seed=2))


def test_errors_name_what_python_has(gasket, refused):
    assert "(width, height)" in str(refused(lambda: gasket.histogram(0), ValueError, "size"))
    assert str(refused(lambda: gasket.set(40_000), ValueError, "size")).startswith("size is 40000")
    refused(lambda: gasket.render((10, 40_000)), ValueError, "size[1]")
    refused(lambda: gasket.render((10, 10, 10)), ValueError, "size")
    refused(lambda: gasket.render(1.5), TypeError, "size")
    refused(lambda: gasket.render("big"), TypeError, "size")
    refused(lambda: gasket.render([[1, 2], [3]]), TypeError, "size")
    refused(lambda: gasket.render(16, window=(0, 0, 1)), ValueError, "window")
    refused(lambda: gasket.render(16, window=(0, 0, 0, 0)), ValueError, "window")
    refused(lambda: gasket.render(16, window=(1, 0, 0, 1)), ValueError, "window[2]")
    refused(lambda: gasket.render(16, window=(0, 1, 1, 1)), ValueError, "window[3]")
    refused(lambda: gasket.render(16, window=(0, math.nan, 1, 1)), ValueError, "window[1]")
    refused(lambda: gasket.histogram(16, points=0), ValueError, "points")
    refused(lambda: gasket.histogram(16, points=-1), ValueError, "points")
    refused(lambda: gasket.histogram(16, points="many"), TypeError, "points")
    refused(lambda: gasket.sample(0), ValueError, "points")
    refused(lambda: gasket.sample(2 ** 60), ValueError, "points")
    refused(lambda: gasket.sample_addresses(9, 0), ValueError, "length")
    refused(lambda: gasket.set(16, tolerance=2), ValueError, "tolerance")
    refused(lambda: gasket.render(16, colour="rainbow"), ValueError, "colour")
    refused(lambda: gasket.render(16, palette="viridis"), ValueError, "palette")
    refused(lambda: gasket.render(16, palette=7), TypeError, "palette")
    refused(lambda: gasket.render(16, palette=[]), ValueError, "palette")
    refused(lambda: gasket.render(16, palette=257 * ["#fff"]), ValueError, "palette")
    refused(lambda: gasket.render(16, palette=["#fff", "red-ish"]), ValueError, "palette[1]")
    refused(lambda: gasket.render(16, palette=["#ffffff00"]), ValueError, "palette[0]")
    refused(lambda: gasket.render(16, background="#12"), ValueError, "background")
    refused(lambda: gasket.render(16, background=(1, 2, 256)), ValueError, "background", index=2)
    refused(lambda: gasket.render(16, background=(.1, .2, .3)), TypeError, "background")
    refused(lambda: gasket.render(16, symbols=17), ValueError, "symbols")
    refused(lambda: gasket.render(16, oversample=9), ValueError, "oversample")
    refused(lambda: gasket.render(16, field=4), ValueError, "field")
    refused(lambda: gasket.render(16, azimuth=math.inf), ValueError, "azimuth")
    refused(lambda: gasket.render(16, seed=-1), ValueError, "seed")
    refused(lambda: gasket.render(16, threads=9999), ValueError, "threads")
    refused(lambda: gasket.render(16, full=1), TypeError, "full")
    refused(lambda: gasket.render(16, progress=3), TypeError, "progress")
    refused(lambda: ifsm.tone_map([[-1]]), ValueError, "counts", index=0)
    refused(lambda: ifsm.tone_map([2 ** 32]), ValueError, "counts", index=0)
    refused(lambda: ifsm.tone_map([.5]), TypeError, "counts")
    refused(lambda: ifsm.tone_map("text"), TypeError, "counts")
    refused(lambda: ifsm.tone_map([1], background=3), TypeError, "background")


# ---- long calls ---------------------------------------------------------------------------------------------------

# Shrinks by a ten-thousandth a step.
SLOW = "ifsm.System([[[.9949, -.0998, 1], [.0998, .9949, 0]], [[.5, 0, 0], [0, .5, 0]]])"
LONG = ["fern.histogram(20_000, points=2 ** 40)", "fern.render(1000, points=2 ** 40)",
        "fern.render(1000, points=2 ** 40, colour='symbol')", "fern.set(8000)", "fern.distances(4000)",
        "ifsm.systems.sponge().render(1000, points=2 ** 40)", "while True: fern.sample(2 ** 23)",
        "while True: fern.sample_addresses(2 ** 20, 10)",
        SLOW + ".ball()", SLOW + ".diameter()", SLOW + ".distances(1000)"]

@pytest.mark.parametrize("program", LONG)
def test_ctrl_c_ends_long_pictures_within_a_tenth_of_a_second(program, seconds_to_interrupt):
    """But for arrays that are being made, and machines that are busy: half a second is allowed."""
    assert seconds_to_interrupt("fern = ifsm.systems.fern()", program, "assert fern.render(16).any()") < 0.5


def test_progress_is_told_and_may_stop(fern):
    told = []
    fern.render(500, points=20_000_000, progress=lambda fraction, stage: told.append((fraction, stage)))
    assert told and all(0 <= fraction <= 1 and isinstance(stage, str) for fraction, stage in told)
    assert [fraction for fraction, _ in told] == sorted(fraction for fraction, _ in told)
    with pytest.raises(ifsm.Cancelled):
        fern.histogram(1000, points=2 ** 40, progress=lambda *_: True)

    class Mine(Exception):
        pass

    def raises(fraction, stage):
        raise Mine

    with pytest.raises(Mine):
        fern.sample(2 ** 24, progress=raises)


def test_sizes_that_no_memory_holds_are_refused(fern):
    with pytest.raises(MemoryError):
        fern.sample(2 ** 49)


# ---- shown --------------------------------------------------------------------------------------------------------


def test_notebooks_show_a_picture_without_a_plotting_library(fern):
    image = pytest.importorskip("matplotlib.image")
    import io

    for system in (fern, ifsm.systems.sponge()):
        data = system._repr_png_()
        pixels = image.imread(io.BytesIO(data))
        assert pixels.shape == (320, 320, 4) and (pixels[0, 0] == 1).all() and pixels[..., :3].min() < .7
    assert zlib.crc32(data[12:29]) == int.from_bytes(data[29:33], "big")  # of the header


@pytest.fixture
def plot():
    pytest.importorskip("matplotlib").use("Agg")
    from matplotlib import pyplot

    yield ifsm.plot
    pyplot.close("all")


def test_systems_are_drawn_over_their_coordinates(plot, gasket):
    axes = plot.system(gasket, size=64, palette="sea")
    image, = axes.images
    left, right, bottom, top = image.get_extent()
    expected, report = gasket.render(64, palette="sea", full=True)
    assert (left, bottom, right, top) == report.window
    assert np.array_equal(image.get_array(), expected)
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("x", "y") and axes.get_aspect() == 1


def test_pictures_are_as_wide_as_what_they_show(plot, fern):
    height, width, _ = plot.system(fern, size=200).images[0].get_array().shape
    low, high = fern.box()
    assert height == 200 and width == round(200 * (high - low)[0] / (high - low)[1])
    part = plot.system(fern, size=100, window=(0, 0, 2, 1)).images[0]
    assert part.get_array().shape == (50, 100, 4) and part.get_extent() == [0, 2, 0, 1]
    assert plot.system(fern, size=(30, 40)).images[0].get_array().shape == (40, 30, 4)
    assert plot.system(ifsm.systems.cantor_set(), size=100).images[0].get_array().shape == (10, 100, 4)


def test_systems_of_space_are_drawn_as_seen(plot):
    axes = plot.system(ifsm.systems.octahedron(), size=64, azimuth=.4)
    assert not axes.axison and axes.images[0].get_array().shape == (64, 64, 4)


def test_what_is_no_system_is_not_drawn(plot, refused, fern):
    refused(lambda: plot.system("fern"), ifsm.InvalidType, "system")
    refused(lambda: plot.system(fern, ax=3), ifsm.InvalidType, "ax")
    refused(lambda: plot.system(fern, size="big"), ifsm.InvalidType, "size")
    refused(lambda: plot.system(fern, size=0), ifsm.InvalidValue, "size")
    refused(lambda: plot.system(fern, window=(0, 0, 1)), ifsm.InvalidValue, "window")
    refused(lambda: plot.system(fern, window=(1, 0, 0, 1)), ifsm.InvalidValue, "window[2]")
    closed = ifsm.systems.koch()
    closed.close()
    refused(lambda: plot.system(closed), ifsm.Closed, "system")
