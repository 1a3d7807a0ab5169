"""Systems: what they are made of, what they answer, and how they travel. Pictures: test_pictures.py."""
import copy
import io
import itertools
import math
import pickle

import numpy as np
import pytest

import ifsm

EPS = np.finfo(float).eps
RIGHT = [[[.5, 0, 0], [0, .5, 0]], [[.5, 0, .5], [0, .5, 0]], [[.5, 0, 0], [0, .5, .5]]]


@pytest.fixture
def gasket():
    """Of corners (0, 0), (1, 0), (0, 1)."""
    return ifsm.System(RIGHT)


@pytest.fixture
def growing():
    """A system that is not contractive: its second map doubles lengths."""
    return ifsm.System([[.5, 0, 0, 0, .5, 0], [2, 0, 1, 0, .5, 0]])


@pytest.fixture
def skewed():
    """Four maps of all kinds, one of them never taken."""
    return ifsm.System([[.4, .1, 0, -.2, .5, 0], [.5, 0, 1, 0, -.3, .2], [.1, 0, .3, .4, .2, 1], [.9, 0, 0, 0, .9, 5]],
                       [1, 2, 1, 0])


def in_space(count=3):
    rng = np.random.default_rng(3)
    return ifsm.System(np.concatenate([rng.uniform(-.3, .3, (count, 3, 3)), rng.uniform(-1, 1, (count, 3, 1))], axis=2))


# ---- what it is ---------------------------------------------------------------------------------------------------


def test_maps_are_taken_as_rows_or_flat(gasket):
    flat = np.reshape(RIGHT, (3, 6))
    assert ifsm.System(flat) == gasket == ifsm.System(flat.tolist()) == ifsm.System(np.float32(RIGHT))
    assert np.array_equal(gasket.maps, RIGHT) and gasket.maps.shape == (3, 2, 3)
    space = in_space()
    assert space.dimension == 3 and space.maps.shape == (3, 3, 4)
    assert ifsm.System(space.maps.reshape(3, 12)) == space
    assert (gasket.dimension, gasket.contractive, gasket.witness, gasket.radius) == (2, True, None, None)


def test_weights_become_probabilities(gasket, skewed):
    assert np.abs(gasket.probabilities - 1 / 3).max() <= EPS
    assert np.array_equal(skewed.probabilities, [.25, .5, .25, 0])
    flat = ifsm.System([[1 / 3, 0, 0, 0, 0, 0], [1 / 3, 0, 2 / 3, 0, 0, 0]])
    assert np.array_equal(flat.probabilities, [.5, .5])


def test_arrays_of_a_system_are_the_callers_own(gasket):
    for name in ("maps", "probabilities", "parameters", "fixed_points"):
        getattr(gasket, name)[:] = 7
        assert not (getattr(gasket, name) == 7).any()


def test_parameters_say_what_maps_do(skewed):
    angle, sx, sy, shear, x, y = .3, .5, .4, .2, 1, 2
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    linear = turn @ np.diag([sx, sy]) @ [[1, shear], [0, 1]]
    made = ifsm.System.from_parameters([[angle, sx, sy, shear, x, y]])
    assert np.abs(made.maps[0] - np.column_stack([linear, [x, y]])).max() <= 4 * EPS
    assert np.abs(made.parameters - [[angle, sx, sy, shear, x, y]]).max() <= 8 * EPS
    for system in (skewed, in_space()):
        again = ifsm.System.from_parameters(system.parameters, weights=system.probabilities)
        assert np.abs(again.maps - system.maps).max() <= 64 * EPS  # some dozen roundings of numbers up to 5


def test_parameters_may_be_given_by_name():
    by_name = ifsm.System.from_parameters(angles=[.1, .2], scales=[[.5, .4], [.3, .2]], shears=[.6, .7],
                                          shifts=[[1, 2], [3, 4]], weights=[1, 3])
    assert by_name == ifsm.System.from_parameters([[.1, .5, .4, .6, 1, 2], [.2, .3, .2, .7, 3, 4]], weights=[1, 3])
    assert ifsm.System.from_parameters(scales=.5, shifts=[[0, 0], [.5, 0], [0, .5]]) == ifsm.System(RIGHT)
    assert ifsm.System.from_parameters(scales=[.5, .25], shifts=np.zeros((2, 3))) == ifsm.System.from_parameters(
        [[0, 0, 0, .5, .5, .5, 0, 0, 0, 0, 0, 0], [0, 0, 0, .25, .25, .25, 0, 0, 0, 0, 0, 0]])
    turned = ifsm.System.from_parameters(angles=[[0, 0, np.pi / 2]], scales=.5, shifts=[[0, 0, 1]])
    assert np.abs(turned.word([0]) - [[0, -.5, 0, 0], [.5, 0, 0, 0], [0, 0, .5, 1]]).max() <= EPS


def test_what_does_not_contract_has_a_witness(growing, refused):
    assert growing.contractive is False and growing.witness.tolist() == [1] and growing.radius == 2
    assert growing.witness.dtype == np.int32
    assert "not contractive" in repr(growing) and growing._repr_png_() is None
    for call in (growing.box, growing.diameter, lambda: growing.moments(1), lambda: growing.sample(9),
                 lambda: growing.render(16), lambda: growing.point([0])):
        refused(call, ifsm.InvalidValue, "system")


def test_fixed_points_are_those_of_the_maps(gasket):
    assert np.array_equal(gasket.fixed_points, [[0, 0], [1, 0], [0, 1]])
    assert not np.isfinite(ifsm.System([[1, 0, 1, 0, 1, 0]]).fixed_points).any()


# ---- words, addresses, questions ----------------------------------------------------------------------------------


def test_a_word_is_its_maps_one_after_the_other(skewed):
    square = np.zeros((4, 3, 3))
    square[:, :2], square[:, 2, 2] = skewed.maps, 1
    for word in itertools.product(range(3), repeat=2):
        product = np.linalg.multi_dot([np.eye(3), *square[list(word)]])
        assert np.abs(skewed.word(word) - product[:2]).max() <= 8 * EPS
    assert np.array_equal(skewed.word([]), [[1, 0, 0], [0, 1, 0]])


def test_points_have_addresses_and_addresses_points(gasket):
    assert np.array_equal(gasket.point([0]), [0, 0]) and np.array_equal(gasket.point([1]), [1, 0])
    assert np.array_equal(gasket.point([0, 1], period=1), [.5, 0])
    assert np.abs(gasket.point([0, 1]) - [1 / 3, 0]).max() <= EPS
    both = gasket.addresses([.5, 0], 4)
    assert both.dtype == np.int32 and both.tolist() == [[0, 1, 1, 1], [1, 0, 0, 0]]
    assert gasket.addresses([.5, .5], 3).tolist() == [[1, 2, 2], [2, 1, 1]]
    assert gasket.addresses([2, 2], 3).shape == (0, 3)
    assert gasket.addresses([.4, .3], 1).shape == (0, 1)
    assert gasket.addresses([.4, .3], 1, tolerance=.21).tolist() == [[0], [1], [2]]  # .14, .1 and .2 away


def test_the_attractor_is_where_answers_say(gasket):
    assert np.abs(gasket.box() - [[0, 0], [1, 1]]).max() <= 1e-8
    assert (gasket.box()[0] <= 0).all() and (gasket.box()[1] >= 1).all()
    assert math.sqrt(2) <= gasket.diameter() <= math.sqrt(2) + 1e-8
    assert math.sqrt(2) <= gasket.diameter(.01) <= math.sqrt(2) + .01
    centre, radius = gasket.ball()
    assert (gasket.ball().centre == centre).all() and centre.shape == (2,)
    assert math.sqrt(.5) <= radius <= 1.02 * math.sqrt(.5)
    assert (np.linalg.norm(gasket.sample(1000) - centre, axis=1) <= radius).all()
    assert in_space().box().shape == (2, 3) and in_space().ball().centre.shape == (3,)


def test_moments_are_exact(gasket):
    moments = gasket.moments(2)
    expected = {(0, 0): 1, (1, 0): 1 / 3, (0, 1): 1 / 3, (2, 0): 5 / 27, (1, 1): 2 / 27, (0, 2): 5 / 27}
    assert list(moments) == list(expected)
    assert moments == pytest.approx(expected, abs=4 * EPS)
    central = gasket.moments(3, about=[1 / 3, 1 / 3])
    assert len(central) == 10 and abs(central[1, 0]) <= 4 * EPS
    assert central[2, 0] == pytest.approx(5 / 27 - 1 / 9, abs=4 * EPS)


def test_moments_have_the_order_of_their_powers():
    """That of the C ABI, which tells values alone: means of points say which is which."""
    space = in_space()
    points = space.sample(200_000)
    for powers, value in space.moments(3).items():
        values = np.prod(points ** powers, axis=1)
        assert abs(values.mean() - value) <= 8 * values.std() / math.sqrt(len(points)) + 1e-12, powers
    assert list(space.moments(1)) == [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]


def test_dimensions_are_those_of_the_gasket(gasket):
    assert gasket.similarity_dimension() == pytest.approx(math.log(3, 2), abs=4 * EPS)
    told = gasket.box_dimension()
    assert isinstance(told, ifsm.Dimension) and told.dimension == pytest.approx(math.log(3, 2), abs=.05)
    assert np.array_equal(told.counts[:3], 3. ** np.arange(1, 4)) or len(told.counts) == 10
    assert len(gasket.box_dimension(6).scales) == 6 and (np.diff(told.scales) < 0).all()


def test_maps_that_are_no_similarities_have_no_such_dimension(skewed, refused):
    assert refused(skewed.similarity_dimension, ifsm.InvalidValue, "system").index == 0


def test_models_are_systems_and_systems_models():
    koch = ifsm.systems.koch()
    model = koch.model(levels=4)
    assert isinstance(model, ifsm.Model) and model.details_kept == 0 and model.filter.topology == "square"
    again = ifsm.System.from_model(model)
    assert np.abs(again.maps - koch.maps).max() <= 1e-12 and np.abs(again.probabilities - .25).max() <= EPS
    chain = koch.model(topology="joined", levels=3)
    assert chain.filter.topology == "joined" and np.abs(chain(0) - [0, 0]).max() <= 1e-12
    assert np.abs(chain(1) - [1, 0]).max() <= 1e-12
    own = koch.model(levels=2, polygon=[[0, 0], [.5, .3], [1, 0]])
    assert np.array_equal(own.control_points, [[0, 0], [.5, .3], [1, 0]])


def test_chains_that_break_are_refused_by_their_map(gasket, refused):
    broken = refused(lambda: gasket.model(topology="joined", levels=2), ifsm.InvalidValue, None)
    assert (broken.argument, broken.index) == ("system", 1) and "chain" in str(broken)
    flat = refused(lambda: gasket.model(levels=2, polygon=[[0, 0], [1, 1], [2, 2]]), ifsm.InvalidValue, None)
    assert flat.argument == "polygon" and "line" in str(flat)
    refused(lambda: ifsm.System.from_model("koch"), ifsm.InvalidType, "model")


# ---- files, copies, comparison ------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["system.json", "system.cbor", "system.ifs"])
def test_files_hold_the_bits(skewed, tmp_path, name):
    for system in (skewed, in_space()):
        system.save(tmp_path / name)
        again = ifsm.System.load(tmp_path / name)
        assert np.array_equal(again.maps, system.maps)
        assert np.abs(again.probabilities - system.probabilities).max() <= EPS  # divided by their sum once more
        assert name.endswith(".ifs") or again == system
        with open(tmp_path / name, "rb") as file:
            assert ifsm.System.load(file) == again
        assert ifsm.System.load(str(tmp_path / name)) == again


def test_suffixes_say_formats(gasket, tmp_path):
    for name, begin in (("a.json", b"{"), ("leaf.ifs", b"leaf"), ("a.cbor", gasket.to_bytes()[:4])):
        gasket.save(tmp_path / name)
        assert (tmp_path / name).read_bytes().startswith(begin)
    assert ifsm.System.file_names(tmp_path / "leaf.ifs") == ["leaf"]
    assert ifsm.System.file_names(tmp_path / "a.json") == [""]
    gasket.save(tmp_path / "b.txt", format="json")
    assert (tmp_path / "b.txt").read_bytes() == gasket.to_bytes("json")
    assert gasket.to_bytes("fractint", name="Gasket").startswith(b"Gasket")


def test_files_of_several_systems_want_a_name(gasket, tmp_path, refused):
    path = tmp_path / "two.ifs"
    path.write_bytes(gasket.to_bytes("fractint", name="one") + ifsm.systems.fern().to_bytes("fractint", name="other"))
    assert ifsm.System.file_names(path) == ifsm.System.file_names(io.BytesIO(path.read_bytes())) == ["one", "other"]
    assert ifsm.System.load(path, "one").maps.shape == (3, 2, 3)
    assert ifsm.System.from_bytes(path.read_bytes(), name="other").maps.shape == (4, 2, 3)
    for name in (None, "third"):
        error = refused(lambda: ifsm.System.load(path, name), ifsm.InvalidValue, None)
        assert str(error).startswith(str(path)) and "one" in str(error) and error.argument == "name"
    assert refused(lambda: ifsm.System.from_bytes(b"{"), ifsm.InvalidValue, None).argument == "data"
    assert refused(lambda: ifsm.System.file_names(io.BytesIO(b"{")), ifsm.InvalidValue, None).argument == "file"
    refused(lambda: ifsm.System.load(io.StringIO("x")), ifsm.InvalidType, "file")
    refused(lambda: ifsm.System.load(3), ifsm.InvalidType, "file")
    with pytest.raises(FileNotFoundError):
        ifsm.System.load(tmp_path / "none.json")


def test_is_equal_hashed_and_pickled_by_what_it_says(gasket, skewed):
    same, other = ifsm.System(RIGHT), ifsm.System(np.add(RIGHT, 1e-15))
    assert gasket == same and hash(gasket) == hash(same) and gasket is not same
    assert gasket != other and gasket != "a system" and len({gasket, same, other}) == 2
    assert ifsm.System(RIGHT, [1, 1, 2]) != gasket
    for system in (gasket, skewed, in_space()):
        for protocol in range(pickle.HIGHEST_PROTOCOL + 1):
            assert pickle.loads(pickle.dumps(system, protocol)) == system
    assert copy.copy(gasket) is gasket and copy.deepcopy({"a": [gasket]})["a"][0] == gasket


def test_ends_when_closed_and_says_so(gasket, refused):
    with gasket as held:
        assert held is gasket
    for call in (gasket.box, lambda: gasket.maps, lambda: gasket.render(16), lambda: gasket.sample(3)):
        refused(call, ifsm.Closed, "self")
    assert repr(gasket) == "<ifsm.System, closed>" and gasket._repr_png_() is None
    assert repr(ifsm.System.__new__(ifsm.System)) == "<ifsm.System, closed>"
    refused(lambda: ifsm.Model.from_polygon([[0, 0], [1, 0], [0, 1]], gasket, levels=2), ifsm.InvalidType, "filter")


def test_systems_are_told_in_a_line(gasket):
    assert repr(gasket) == "<ifsm.System of 3 maps in 2-D, contractive>"
    assert repr(ifsm.System([[.5, 0, 0, 0, .5, 0]])) == "<ifsm.System of 1 map in 2-D, contractive>"


# ---- known systems ------------------------------------------------------------------------------------------------


def test_every_system_of_the_catalog_is_a_function():
    entries = ifsm.systems.catalog()
    assert len(entries) >= 36 and [entry.name for entry in entries] == ifsm.systems.names()
    for name, dimension, source in entries:
        make = getattr(ifsm.systems, name)
        assert make.__name__ == name and source in make.__doc__ and name in dir(ifsm.systems)
        system = make()
        assert system == ifsm.System.named(name) and system.dimension == dimension
    for name in ("fern", "gasket", "dragon", "koch", "levy", "snowflake", "sponge"):
        assert getattr(ifsm.systems, name)() == ifsm.System.named(name) and name in dir(ifsm.systems)


def test_unknown_systems_are_refused_with_a_hint(refused):
    with pytest.raises(AttributeError, match="no system 'fernn'; did you mean 'fern'"):
        ifsm.systems.fernn
    with pytest.raises(AttributeError, match="names"):
        ifsm.systems.qqq
    assert not hasattr(ifsm.systems, "__path__")
    assert "fern_barnsley" in str(refused(lambda: ifsm.System.named("qqq"), ifsm.InvalidValue, None))
    assert ifsm.System.named("twin-dragon") == ifsm.systems.twin_dragon()


# ---- errors -------------------------------------------------------------------------------------------------------


def test_errors_name_what_python_has(gasket, refused):
    assert "(3, 5)" in str(refused(lambda: ifsm.System(np.zeros((3, 5))), ifsm.InvalidValue, "maps"))
    assert refused(lambda: ifsm.System([[.5, 0, 0, 0, .5, math.nan]]), ifsm.InvalidValue, "maps").index == 5
    refused(lambda: ifsm.System(np.zeros((257, 6))), ifsm.InvalidValue, "maps")
    refused(lambda: ifsm.System([]), ifsm.InvalidValue, "maps")
    refused(lambda: ifsm.System(RIGHT, [1, 2]), ifsm.InvalidValue, "weights")
    refused(lambda: ifsm.System(RIGHT, [1, 2, -1]), ifsm.InvalidValue, "weights")
    assert refused(lambda: ifsm.System(RIGHT, [0, 0, 0]), ifsm.InvalidValue, None).argument == "weights"
    make = ifsm.System.from_parameters
    refused(lambda: make(), ifsm.InvalidValue, "parameters")
    refused(lambda: make([[0, 1, 1, 0, 0, 0]], shifts=[[0, 0]]), ifsm.InvalidValue, "parameters")
    refused(lambda: make([[0, 1, 1]]), ifsm.InvalidValue, "parameters")
    refused(lambda: make(angles=[1]), ifsm.InvalidType, "shifts")
    refused(lambda: make(angles=[1, 2, 3], shifts=[[0, 0], [1, 1]]), ifsm.InvalidValue, "angles")
    refused(lambda: make(scales=[[1, 2, 3]], shifts=[[0, 0]]), ifsm.InvalidValue, "scales")
    assert refused(lambda: make(scales=[.5, math.inf], shifts=[[0, 0], [1, 1]]), ifsm.InvalidValue, "scales").index == 1
    assert refused(lambda: gasket.word([0, 3]), ifsm.InvalidValue, "symbols").index == 1
    refused(lambda: gasket.point([]), ifsm.InvalidValue, "symbols")
    refused(lambda: gasket.point(2000 * [0]), ifsm.InvalidValue, "symbols")
    refused(lambda: gasket.point([0], period=2), ifsm.InvalidValue, "period")
    refused(lambda: gasket.addresses([0, 0, 0], 3), ifsm.InvalidValue, "point")
    refused(lambda: gasket.addresses([0, 0], 0), ifsm.InvalidValue, "length")
    refused(lambda: gasket.box(-1), ifsm.InvalidValue, "tolerance")
    refused(lambda: gasket.moments(9), ifsm.InvalidValue, "degree")
    refused(lambda: gasket.moments(1, about=[1]), ifsm.InvalidValue, "about")
    refused(lambda: gasket.box_dimension(3), ifsm.InvalidValue, "finest")
    refused(lambda: gasket.to_bytes("xml"), ifsm.InvalidValue, "format")


def test_endings_that_no_system_has_are_refused(tmp_path):
    for name in ("x.flame", "x.ifsm"):
        with pytest.raises(ValueError, match="which no system is written as"):
            ifsm.systems.fern().save(tmp_path / name)
        assert not (tmp_path / name).exists()


def test_a_models_bytes_are_its_system():
    koch = ifsm.systems.koch()
    again = ifsm.System.from_bytes(koch.model(levels=2).to_bytes())
    assert np.allclose(again.maps, koch.maps, atol=1e-14)
