import array
import gc
import mmap
import sys

import numpy as np
import pytest

import ifsm
from ifsm import _arrays


def test_what_is_right_is_not_copied(walk):
    assert _arrays.doubles(walk, "f", "points") is walk
    assert ifsm._native.address_of(walk) == walk.ctypes.data
    assert ifsm._native.address_of(memoryview(walk)[100:]) == walk[100:].ctypes.data
    readonly = walk.copy()
    readonly.setflags(write=False)
    assert _arrays.doubles(readonly, "f", "points") is readonly
    ifsm.Model(readonly)  # reading is enough


@pytest.mark.parametrize("made", [
    lambda walk: walk.tolist(),
    lambda walk: [tuple(point) for point in walk],
    lambda walk: np.asfortranarray(walk),
    lambda walk: np.repeat(walk, 2, axis=0)[::2],
    lambda walk: walk[::-1][::-1],
    lambda walk: np.column_stack([walk, walk])[:, :2],
    lambda walk: walk.astype(">f8"),
    lambda walk: memoryview(walk),
    lambda walk: np.frombuffer(b"-" + walk.tobytes(), np.float64, offset=1).reshape(-1, 2),  # at an odd address
    lambda walk: np.lib.stride_tricks.as_strided(walk.copy(), walk.shape, walk.strides),
])
def test_the_same_numbers_in_any_layout_are_the_same_model(walk, made):
    assert ifsm.Model(made(walk)) == ifsm.Model(walk)


def test_narrower_numbers_are_widened(walk):
    for dtype in (np.float32, np.float16, np.int8, np.int64, np.uint16):
        narrow = (walk + 100).astype(dtype)
        assert ifsm.Model(narrow) == ifsm.Model(narrow.astype(np.float64))
    assert ifsm.Model(array.array("d", [0, 1, 5, 2])).dimension == 1


def test_shapes_are_checked(walk, refused):
    for wrong in (walk.reshape(-1, 1, 2), np.float64(3), walk[:0], walk[:1], np.empty((5, 0)), np.empty((5, 5))):
        refused(lambda: ifsm.Model(wrong), ifsm.InvalidValue, "points", code=ifsm.Status.SHAPE)


def test_results_are_written_where_one_says(model):
    room = np.empty((257, 2))
    address = room.ctypes.data
    assert model.samples(out=room) is room and room.ctypes.data == address
    assert np.array_equal(room, model.samples())
    pages = mmap.mmap(-1, room.nbytes)
    shared = np.frombuffer(pages, dtype=np.float64).reshape(room.shape)
    model.samples(out=shared)
    assert bytes(pages) == room.tobytes()


def test_where_one_says_must_be_what_would_be_new(model, refused):
    for wrong in (np.empty((257, 3)), np.empty((257, 2), np.float32), np.empty((2, 257)).T, np.empty(514),
                  np.empty((514, 2))[::2]):
        refused(lambda: model.samples(out=wrong), ifsm.InvalidValue, "out")
    locked = np.empty((257, 2))
    locked.setflags(write=False)
    refused(lambda: model.samples(out=locked), ifsm.InvalidValue, "out")
    refused(lambda: model.samples(out=[1, 2]), ifsm.InvalidType, "out")
    refused(lambda: model.points(levels=1, out=np.empty((3, 2))), ifsm.InvalidValue, "out")


def test_the_extension_takes_nothing_but_what_it_can_read_in_place(model, walk):
    native = ifsm._native
    odd = np.frombuffer(b"-" + walk.tobytes(), np.float64, offset=1)
    for wrong in (walk.astype(np.float32), walk[::2], odd, walk.tolist(), "text", 5):
        with pytest.raises(ifsm.InvalidType):
            native.ifsm_model_evaluate(model._native, 0, wrong, None)


def test_nothing_is_held_after_a_call(walk):
    points = walk.copy()
    before = sys.getrefcount(points)
    model = ifsm.Model(points)
    model.nearest(points)
    with pytest.raises(ifsm.InvalidValue):
        ifsm.fit(points, budget=1)
    gc.collect()
    assert sys.getrefcount(points) == before
    points.resize((100, 2))  # NumPy refuses while a buffer is out


def test_masked_values_are_refused_and_not_read(refused):
    points = np.ma.masked_equal([[0.0, 1.0], [2.0, -9999.0], [3.0, 4.0]], -9999.0)
    error = refused(lambda: ifsm.Model(points), ValueError, "points")
    assert error.index == 3
    assert ifsm.Model(np.ma.array([[0.0, 1.0], [2.0, 3.0]])).sample_count == 2  # a mask that hides nothing


def test_what_is_no_number_is_told_by_its_dtype(refused):
    for given, word in ((np.array([[1, 2], [3, 4]], dtype=object), "astype"), (np.array([[1j, 2], [3, 4]]), "complex"),
                        (np.array([[True, False], [True, True]]), "bool")):
        assert word in str(refused(lambda: ifsm.Model(given), TypeError, "points"))
    nested = []
    for _ in range(100_000):
        nested = [nested]
    refused(lambda: ifsm.Model(nested), ifsm.Error, "points")
