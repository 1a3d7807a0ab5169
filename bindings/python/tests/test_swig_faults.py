"""Seven faults that were measured in well-known SWIG bindings. None of them may be here."""
import gc
import inspect
import os
import subprocess
import sys
import weakref

import numpy as np
import pytest

import ifsm


def functions():
    """All that the extension exports, by name."""
    native = ifsm._native
    return {name: getattr(native, name) for name in dir(native)
            if name.startswith("ifsm_") and callable(getattr(native, name)) and not isinstance(getattr(native, name), type)}


TORTURE = """
import ifsm, numpy as np
native = ifsm._native
things = [None, 1, -1, 2**80, 1.5, "text", b"bytes", [], ["a", "b"], {}, object(), lambda *_: None, native, int,
          np.zeros(3), np.zeros((2, 2)), (np.zeros((3, 2)), False), [(np.zeros((3, 2)), True)], [None], (1, 2)]
calls = 0
for name in sorted(dir(native)):
    call = getattr(native, name)
    if not name.startswith("ifsm_") or isinstance(call, (type, int)):
        continue
    for count in range(26):
        for thing in things:
            try:
                call(*[thing] * count)
            except (ifsm.Error, TypeError) as error:
                assert str(error), name
            calls += 1
print(calls)
"""


def test_1_a_wrong_type_never_ends_the_process():
    done = subprocess.run([sys.executable, "-c", TORTURE], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert int(done.stdout) > 20_000


def test_2_a_list_of_strings_is_a_type_error_that_says_so(refused):
    refused(lambda: ifsm.fit(["a", "b", "c"]), ifsm.InvalidType, "points")
    refused(lambda: ifsm.fit([["a", "b"], ["c", "d"]]), ifsm.InvalidType, "points")
    refused(lambda: ifsm.fit_sparse(["a", "b"]), ifsm.InvalidType, "curves[0]")
    with pytest.raises(ifsm.InvalidType):
        ifsm._native.ifsm_fit_sparse(["a"], 0, None, 0, 0, None, 0, 0, 0, 0, None, None, 0.0)


def test_3_what_a_callback_is_given_may_be_kept(walk):
    kept = []
    ifsm.fit(walk, progress=lambda *told: kept.append(told) and None)
    gc.collect()
    assert all(isinstance(fraction, float) and isinstance(stage, str) for fraction, stage in kept)
    assert kept[-1] == (1.0, "done")


def test_4_a_cycle_through_a_callback_is_collected(walk):
    class Owner:
        def __init__(self):
            self.told = 0
            self.model = ifsm.fit(walk, progress=self.tell)  # a bound method: it holds its owner
            self.again = self.tell

        def tell(self, fraction, stage):
            self.told += 1

    owner = Owner()
    seen = weakref.ref(owner)
    assert owner.told > 0
    del owner
    gc.collect()
    assert seen() is None


def resident():
    with open("/proc/self/statm") as statm:
        return int(statm.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def grown(call, calls):
    for _ in range(calls // 10):
        call()  # what is kept for good is kept now
    gc.collect()
    before = resident()
    for _ in range(calls):
        call()
    gc.collect()
    return resident() - before


def leak_candidates(walk):
    native = ifsm._native
    model = ifsm.Model(walk[:17], filter="casteljau")
    deformer = model.deformer()
    cbor = model.to_bytes()
    gasket = ifsm.systems.gasket()

    def failing():
        try:
            model.points(levels=99)
        except ifsm.InvalidValue:
            pass

    def wrong_type():
        try:
            model([["a"]])
        except ifsm.InvalidType:
            pass

    return {
        "samples": model.samples, "points": model.points, "evaluate": lambda: model(0.5), "details": lambda: model.details(1),
        "from_bytes": lambda: ifsm.Model.from_bytes(cbor), "to_bytes": lambda: model.to_bytes("json"),
        "describe": lambda: native.ifsm_model_describe(model._native), "create": lambda: ifsm.Model(walk[:17], "casteljau"),
        "system": lambda: ifsm.System(gasket.maps), "system bytes": lambda: ifsm.System.from_bytes(gasket.to_bytes()),
        "word": lambda: gasket.word([0, 1]), "moments": lambda: gasket.moments(2),
        "entry": lambda: native.ifsm_system_catalog(0),
        "render": lambda: gasket.render(4, points=64, palette=["#fff"]), "histogram": lambda: gasket.histogram(4, points=64),
        "set": lambda: gasket.set(4, full=True), "sample": lambda: gasket.sample(8), "tone": lambda: ifsm.tone_map([1, 2]),
        "filter": lambda: model.filter, "matrix": lambda: ifsm.Filter("casteljau").matrix, "edit": lambda: deformer.move(
            0, 1, [0.0, 1.0]).undo(), "nearest": lambda: model.nearest(walk[:3]), "failing": failing, "wrong": wrong_type,
    }


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="memory is read from Linux's /proc")
@pytest.mark.parametrize("name", ["samples", "points", "evaluate", "details", "from_bytes", "to_bytes", "describe", "create",
                                  "filter", "matrix", "edit", "nearest", "failing", "wrong", "system", "system bytes",
                                  "word", "moments", "entry", "render", "histogram", "set", "sample", "tone"])
def test_5_memory_stays_flat(walk, name):
    # 8 kB a call, the fault that was measured, would be 80 MB; bench/python.py has every function, 10^5 times.
    assert grown(leak_candidates(walk)[name], 10_000) <= 1 << 20


def test_6_every_exception_has_a_text(walk):
    for attempt in (lambda: ifsm.fit(1j), lambda: ifsm.fit(walk, budget=0), lambda: ifsm.Filter(""),
                    lambda: ifsm.Model.from_bytes(b""), lambda: ifsm.Model.from_bytes(b"{"), lambda: ifsm.load("/dev/null"),
                    lambda: ifsm.set_threads(-1), lambda: ifsm._native.ifsm_threads(1)):
        with pytest.raises(Exception) as caught:
            attempt()
        assert len(str(caught.value)) > 15, repr(caught.value)


def test_7_signatures_are_told():
    for owner in (ifsm, ifsm.Model, ifsm.Deformer, ifsm.Filter, ifsm.Fit, ifsm.System, *ifsm.System.__bases__, ifsm.systems):
        for name, value in vars(owner).items():
            if name.startswith("_") or not inspect.isroutine(value) or name == "NamedTuple":  # of the standard library
                continue
            function = getattr(owner, name)
            for parameter in inspect.signature(function).parameters.values():
                assert parameter.kind not in (parameter.VAR_POSITIONAL, parameter.VAR_KEYWORD), f"{owner}.{name}"
            assert inspect.getdoc(function), f"{owner.__name__}.{name} has no docstring"
    assert len(functions()) > 100
