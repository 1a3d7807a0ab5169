"""What all tests share: curves, and the names that examples in docstrings use."""
import os
import pathlib
import subprocess
import sys

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


INTERRUPTED = """
import os, signal, threading, time
import numpy as np, ifsm
BEFORE
sent = []
def interrupt():
    time.sleep(0.5)
    sent.append(time.perf_counter())
    os.kill(os.getpid(), signal.SIGINT)
threading.Thread(target=interrupt).start()
try:
    PROGRAM
except KeyboardInterrupt:
    print(time.perf_counter() - sent[0])
AFTER
"""


@pytest.fixture(scope="session")
def seconds_to_interrupt():
    """Runs lines before, a long program, and lines after in a process of its own; tells how soon Ctrl-C ended the program."""
    def run(before, program, after):
        text = INTERRUPTED.replace("BEFORE", before).replace("PROGRAM", program).replace("AFTER", after)
        done = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, timeout=120)
        assert done.returncode == 0, done.stderr
        return float(done.stdout)

    return run
