"""What all tests share: curves, and the names that examples in docstrings use."""
import os
import pathlib

import numpy as np
import pytest

import ifsm

os.environ.setdefault("MPLBACKEND", "Agg")
COASTS = pathlib.Path(__file__).resolve().parents[3] / "data" / "coast"


@pytest.fixture(scope="session")
def walk():
    """A rough open curve of 257 points in the plane."""
    steps = np.random.default_rng(1).normal(size=(257, 2))
    return np.cumsum(steps, axis=0)


@pytest.fixture(scope="session")
def ring(walk):
    """A closed curve of 256 points."""
    t = np.linspace(0, 2 * np.pi, 256, endpoint=False)
    return np.column_stack([np.cos(t), np.sin(t)]) * 50 + walk[:256] * 0.2


@pytest.fixture(scope="session")
def iceland():
    """A real coast, in kilometres; the last row repeats the first."""
    return np.loadtxt(COASTS / "iceland.csv", delimiter=",", skiprows=1)


@pytest.fixture
def model(walk):
    return ifsm.Model(walk, filter="casteljau")


@pytest.fixture
def refused():
    """refused(call, kind, argument): the error that a call ends in, which must blame that argument."""
    def check(call, kind, argument, **told):
        with pytest.raises(kind) as caught:
            call()
        error = caught.value
        assert isinstance(error, ifsm.Error)
        words = str(error).replace("_", " ")  # "control points" names control_points
        if argument is None:  # the caller looks
            return error
        assert error.argument == argument, str(error)
        assert argument == "self" or argument.replace("_", " ") in words, str(error)
        assert len(words) > 20, words
        for name, value in told.items():
            assert getattr(error, name) == value or value != value, name
        return error
    return check
