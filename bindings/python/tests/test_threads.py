"""Threads, the interpreter's lock, and Ctrl-C."""
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import ifsm


def test_other_threads_run_while_the_library_works(walk):
    points = np.cumsum(np.random.default_rng(1).normal(size=(1025, 2)), axis=0)
    inside, turns = threading.Event(), []

    def count():
        while not inside.is_set():
            time.sleep(0)
        while inside.is_set():
            turns.append(None)
            time.sleep(0)

    other = threading.Thread(target=count)
    other.start()
    model = ifsm.Model(points)
    inside.set()
    model.keep(within=1.0, distance="hausdorff")  # no callback: nothing else would let the other thread run
    inside.clear()
    other.join()
    # Switching from a thread that holds the lock takes 5 ms; a thread that runs freely turns thousands of times.
    assert len(turns) > 1000


def test_models_are_shared_between_threads(walk):
    model = ifsm.Model(walk, filter="casteljau")
    expected, found = model.keep(details=30), []

    def work():
        for _ in range(5):
            found.append(model.keep(details=30) == expected and model.length() == expected.length() or
                         np.array_equal(model.samples(), model.samples()))

    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [True] * 20


def test_closing_lets_calls_of_other_threads_finish():
    points = np.cumsum(np.random.default_rng(1).normal(size=(1025, 2)), axis=0)
    expected = ifsm.Model(points).keep(within=5.0)
    for _ in range(5):
        model, found = ifsm.Model(points), []
        thread = threading.Thread(target=lambda: found.append(model.keep(within=5.0)))
        thread.start()
        while not found and thread.is_alive() and model._native is not None:
            time.sleep(0.001)
            model.close()
        thread.join()
        assert not found or found == [expected]  # it had begun, or was refused: never anything else


POINTS = "points = np.cumsum(np.random.default_rng(1).normal(size=(200_000, 2)), axis=0)"


@pytest.mark.parametrize("program", [
    "ifsm.fit(points, budget=2000, rounds_of=None)".replace(", rounds_of=None", ""),
    "ifsm.fit_sparse([points], budgets=[500, 2000, 8000], progress=lambda *_: None)",
    "ifsm.fit_curve([points], reparameterise=10000)",
    "ifsm.Model(points).keep(within=0.5, distance='hausdorff')",
])
def test_ctrl_c_ends_long_calls(program, seconds_to_interrupt):
    assert seconds_to_interrupt(POINTS, program, "assert ifsm.fit(points[:100]).sample_count == 100") > 0


def test_what_a_callback_raises_comes_out_of_the_call(walk):
    class Mine(Exception):
        pass

    def tell(fraction, stage):
        raise Mine("no")

    with pytest.raises(Mine, match="no") as caught:
        ifsm.fit(walk, progress=tell)
    assert caught.traceback[-1].name == "tell"
    assert ifsm.fit(walk).sample_count == 257


def test_a_callback_may_use_the_library_and_its_failures_stay_inside(walk):
    inner = []

    def tell(fraction, stage):
        try:
            ifsm.fit(walk, budget=1)
        except ifsm.InvalidValue as error:
            inner.append(error.argument)
        inner.append(ifsm.Model(walk).sample_count)

    model = ifsm.fit(walk, progress=tell)
    assert model == ifsm.fit(walk) and "budget" in inner and 257 in inner


def test_threads_are_set_for_the_process():
    try:
        ifsm.set_threads(2)
        assert ifsm.threads() == 2
    finally:
        ifsm.set_threads(0)
    with pytest.raises(ifsm.InvalidValue):
        ifsm.set_threads(2000)


def test_lines_of_diagnosis_go_to_logging(caplog, walk):
    ifsm.log_to("somewhere")
    try:
        ifsm.fit(walk, iterations=1)
    finally:
        ifsm.log_to(None)
    assert all(record.name == "somewhere" for record in caplog.records)


SCRIPT = """
import threading, time
import numpy as np
import ifsm
big = np.cumsum(np.random.default_rng(1).normal(size=(200_001, 2)), axis=0)
"""


def run(script, timeout=60):
    return subprocess.run([sys.executable, "-c", SCRIPT + script], capture_output=True, text=True, timeout=timeout)


@pytest.mark.parametrize("work", [
    "ifsm.fit(big)",
    "ifsm.fit(big, progress=lambda fraction, stage: None)",
    "ifsm.Model(big).refine(6)",
])
def test_a_script_may_end_while_a_daemon_thread_still_computes(work):
    """CPython before 3.14 would end that thread by unwinding it through C++, which aborts the process."""
    done = run(f"""
def forever():
    while True:
        {work}
for _ in range(3):
    threading.Thread(target=forever, daemon=True).start()
time.sleep(1)
print("end")
""")
    assert (done.returncode, done.stdout) == (0, "end\n"), done.stderr


@pytest.mark.parametrize("work", [
    "model.refine(6)",
    "model.spaced(20_000_000)",
    "model.nearest(np.zeros((2_000_000, 2)))",
    "model(np.linspace(0, 1, 20_000_000))",
    "model.crossings()",
])
def test_ctrl_c_ends_calls_that_have_no_progress_within_a_tenth_of_a_second(work):
    """But for arrays that are being made: half a second is allowed."""
    done = run(f"""
import os, signal
model = ifsm.Model(big)
def interrupt():
    time.sleep(0.3)
    global sent
    sent = time.perf_counter()
    os.kill(os.getpid(), signal.SIGINT)
threading.Thread(target=interrupt).start()
try:
    while True:
        {work}
except KeyboardInterrupt:
    print(time.perf_counter() - sent)
assert model.length() > 0
""")
    assert done.returncode == 0, done.stderr
    assert float(done.stdout) < 0.5


def test_a_slow_callback_leaves_time_for_the_work(walk):
    calls = []

    def slow(fraction, stage):
        calls.append(fraction)
        time.sleep(0.06)  # longer than the time after which it is asked again

    start = time.perf_counter()
    model = ifsm.fit(walk, progress=slow)
    took = time.perf_counter() - start
    assert model == ifsm.fit(walk)
    assert calls[-1] == 1
    assert sum(0.06 for _ in calls) < 0.8 * took + 0.5  # half of the time, but for new stages
