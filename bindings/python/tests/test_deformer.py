import copy
import pickle
import threading

import numpy as np
import pytest

import ifsm


def test_edits_can_be_undone_bit_for_bit(model):
    deformer = model.deformer()
    before = deformer.samples()
    deformer.move(0, 2, [5, 5]).move(2, [3, 4], [[1, 0], [0, 1]])
    after = deformer.samples()
    assert (deformer.edits, deformer.undoable, deformer.redoable) == (2, 2, 0)
    assert np.array_equal(deformer.undo().undo().samples(), before)
    assert np.array_equal(deformer.redo().redo().samples(), after)


def test_moves_lead_handles_to_places(model):
    deformer = model.deformer().move(3, [7], [[3, 4]], places=True)
    assert np.abs(deformer.points(3)[7] - [3, 4]).max() <= 1e-12 * model.diagonal
    first, count = deformer.changed(3)
    assert first <= 7 < first + count < 33


def test_drags_go_where_they_are_led(model):
    deformer = model.deformer().drag(2, [0.3, 0.7], [[0, 0], [1, 1]])
    # Exactly, says the library: to rounding of coordinates as large as the curve.
    assert np.abs(deformer([0.3, 0.7]) - [[0, 0], [1, 1]]).max() <= 1e-10 * model.diagonal


def test_pins_hold_until_released(model):
    deformer = model.deformer().pin(1, 4).move(0, 2, [9, 0])
    held = deformer.points(1)[4]
    assert np.abs(held - model.points(levels=1)[4]).max() <= 1e-12 * model.diagonal
    assert not np.array_equal(deformer.release(1, [4]).points(1)[4], held)


def test_looks_and_textures_change_details_alone(model, ring):
    deformer = model.deformer().restyle(4, 5, 0.0)
    assert np.array_equal(deformer.snapshot().details(5), np.zeros((4 * 32, 2)))
    other = ifsm.Model(np.random.default_rng(2).normal(size=(257, 2)), filter="casteljau")
    textured = model.deformer().texture(4, 5, other).snapshot()
    assert np.array_equal(textured.details(3), model.details(3))
    seeded = model.deformer().texture(4, 5, seed=3)
    assert np.array_equal(seeded.samples(), model.deformer().texture(4, 5, seed=3).samples())


def test_time_runs_from_the_model_to_the_present(model):
    deformer = model.deformer().time(0, 2, "linear").move(0, 2, [8, 0])
    assert deformer.span == (0, 2)
    assert np.array_equal(deformer.at_time(-1).samples(), model.deformer().samples())
    assert np.array_equal(deformer.at_time(2).samples(), deformer.samples())
    half = deformer.at_time(1).points(0)[2] - model.control_points[2]
    assert np.abs(half - [4, 0]).max() <= 1e-12 * model.diagonal


def test_named_states_and_logs_come_back(model):
    deformer = model.deformer(turning="rotation").move(0, 1, [1, 2]).keep_as("bent").move(0, 1, [5, 5])
    bent = model.control_points[1] + [1, 2]
    assert np.abs(deformer.go_to("bent").points(0)[1] - bent).max() <= 1e-12 * model.diagonal
    for again in (copy.copy(deformer), copy.deepcopy(deformer), pickle.loads(pickle.dumps(deformer)),
                  ifsm.Deformer(model, turning="rotation").replay(deformer.to_bytes("json"))):
        assert np.array_equal(again.samples(), deformer.samples()) and again is not deformer


def test_snapshot_is_the_present_state(model):
    deformer = model.deformer().move(1, 3, [4, 4])
    assert np.abs(deformer.snapshot().samples() - deformer.samples()).max() <= 1e-12 * model.diagonal
    assert np.array_equal(deformer(0.25).shape, (2,))


def test_windows_of_points_are_those_of_all(ring):
    deformer = ifsm.Model(ring, filter="casteljau", closed=True).deformer()
    every = deformer.points()
    assert len(every) == 256
    assert np.array_equal(deformer.points(first=10, count=5), every[10:15])
    assert np.array_equal(deformer.points(first=250), every[250:])


def test_a_deformer_outlives_its_model(model):
    deformer = model.deformer().move(0, 1, [1, 1])
    expected = deformer.points()
    model.close()
    assert np.array_equal(deformer.points(), expected) and deformer.points(2).shape == (17, 2)
    assert np.array_equal(deformer.snapshot().control_points, deformer.points(0))


def test_an_edit_that_fails_changes_nothing(model, refused):
    deformer = model.deformer().move(0, 1, [1, 1])
    before = deformer.samples()
    refused(lambda: deformer.move(0, [1, 1], [[1, 1], [2, 2]]), ifsm.InvalidValue, "handles", index=1)
    refused(lambda: deformer.move(0, 99, [1, 1]), ifsm.InvalidValue, "handles", index=0)
    refused(lambda: deformer.move(0, 1, [1, np.nan]), ifsm.InvalidValue, "vectors", index=1)
    refused(lambda: deformer.move(0, 1, [1, 1, 1]), ifsm.InvalidValue, "vectors")
    refused(lambda: deformer.move(0, 1.5, [1, 1]), ifsm.InvalidType, "handles")
    refused(lambda: deformer.move(99, 1, [1, 1]), ifsm.InvalidValue, "level", value=99)
    refused(lambda: deformer.move(0, 1, [1, 1], reach="far"), ifsm.InvalidValue, "reach")
    refused(lambda: deformer.drag(0, 2.0, [1, 1]), ifsm.InvalidValue, "t")
    refused(lambda: deformer.texture(0, 1, "wool"), ifsm.InvalidType, "source")
    refused(lambda: deformer.go_to("nowhere"), ifsm.InvalidValue, "name")
    refused(lambda: deformer.replay("edits"), ifsm.InvalidType, "data")
    refused(lambda: deformer.time(2, 1), ifsm.InvalidValue, "end")
    with pytest.raises(ifsm.InvalidValue):
        deformer.redo()
    assert np.array_equal(deformer.samples(), before) and deformer.undoable == 1


def test_a_second_thread_is_busy_or_served_and_nothing_is_lost(model):
    deformer = model.refine(8).deformer()
    outcomes = []

    def edit():
        for _ in range(20):
            try:
                deformer.move(0, 2, [1.0, 0.0])
                outcomes.append("made")
            except ifsm.Busy as error:
                assert error.code == ifsm.Status.BUSY
                outcomes.append("busy")

    threads = [threading.Thread(target=edit) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(outcomes) == 80 and deformer.edits == outcomes.count("made") >= 1
