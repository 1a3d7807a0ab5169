import copy
import pickle

import numpy as np
import pytest

import ifsm


def test_knows_its_names_and_shapes():
    coast = ifsm.Filter("coast")
    assert (coast.topology, coast.control_points, coast.maps, coast.stride) == ("joined", 5, 2, 4)
    assert ifsm.Filter("haar", topology="square").matrix.shape == (2, 2)
    assert ifsm.Filter("casteljau", control_points=4, maps=3).details_per_node == 6
    assert ifsm.Filter("casteljau").contractive is True


def test_comes_back_from_its_matrix():
    for first in (ifsm.Filter("coast"), ifsm.Filter("four-point", topology="square")):
        shape = {"control_points": first.control_points, "maps": first.maps, "topology": first.topology}
        again = ifsm.Filter.from_matrix(first.matrix, **shape, stride=first.stride)
        assert again == first and hash(again) == hash(first) and again.condition == first.condition
        assert pickle.loads(pickle.dumps(first)) == first and copy.deepcopy(first) is first
    assert ifsm.Filter("coast") != ifsm.Filter("casteljau")


def test_canonical_complement_belongs_to_the_maps():
    joined = ifsm.Filter("casteljau", control_points=3)
    assert ifsm.Filter.from_maps(joined.matrix[:3], control_points=3, maps=2) == joined


def test_its_matrix_cannot_be_written():
    with pytest.raises(ValueError):
        ifsm.Filter("coast").matrix[0, 0] = 2


def test_refuses_what_is_none(refused):
    refused(lambda: ifsm.Filter("nope"), ifsm.InvalidValue, "name", code=ifsm.Status.RANGE)
    refused(lambda: ifsm.Filter(3), ifsm.InvalidType, "name")
    refused(lambda: ifsm.Filter("coast", topology="round"), ifsm.InvalidValue, "topology")
    refused(lambda: ifsm.Filter("coast", control_points=7), ifsm.InvalidValue, "control_points")
    wrong = ifsm.Filter("casteljau", control_points=3).matrix.copy()
    wrong[1, 2] = np.nan
    refused(lambda: ifsm.Filter.from_matrix(wrong, control_points=3, maps=2), ifsm.InvalidValue, "matrix", index=7)
    with pytest.raises(ifsm.InvalidValue) as caught:
        ifsm.Filter.from_matrix(np.ones((5, 5)), control_points=3, maps=2)
    assert caught.value.code == ifsm.Status.SINGULAR
