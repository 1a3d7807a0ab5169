"""The conformance file, which the tests of the C ABI make: here every call in it goes through the SWIG module.

tests/conformance/README.md describes the file.
"""
import json
import math
import pathlib
import re
import struct

import numpy as np
import pytest

import ifsm
from ifsm import _native as native

FILE = pathlib.Path(__file__).resolve().parents[3] / "tests" / "conformance" / "calls.json"
STEPS = json.loads(FILE.read_text(encoding="utf-8"))["steps"]
CALLS = [step for step in STEPS if "call" in step]
TYPES = {"double": np.float64, "int32": np.int32, "uint32": np.uint32, "uint8": np.uint8}
ARRAYS = {"int32": np.int32, "uint32": np.uint32}  # told as numbers
KNOWN = ("parameters", "weights", "covariances", "constraint_kinds", "constraint_parameters", "constraint_values")
NEAR = 1e-6  # where numbers went through libm, as in conformance_test.cpp


# ----------------------------------------------------------------------------------------------------------------
# From the file to Python

def number(text):
    return float.fromhex(text) if re.search("x|nan|inf", text) else int(text)


def doubles(texts):
    return np.array([float.fromhex(text) for text in texts], np.float64)


def listed(told):
    if told is None:
        return []
    return list(told) if isinstance(told, (list, tuple)) else [told]


class Runner:
    """Makes calls, one after the other, and keeps the objects that come of them."""

    def __init__(self):
        self.objects = {}

    def call(self, step):
        """The results, in C's order."""
        call = getattr(native, step["call"])
        arguments = [self.argument(value) for value in step["arguments"].values()]
        results = listed(call(*arguments))
        for place, value in enumerate(step["arguments"].values()):
            if isinstance(value, dict) and "output" in value:  # so far its size was asked for, which comes last
                arguments[place] = array = np.empty(results[-1], TYPES[value["output"]])
                results = listed(call(*arguments))
                assert results[-1] == len(array)
                results[-1] = array
        if "as" in step:  # objects come before what is told about them
            self.objects[step["as"]] = results.pop(0)
        return results

    def argument(self, value):
        if isinstance(value, str):
            return number(value)
        if isinstance(value, list):
            return doubles(value)
        if not isinstance(value, dict):
            return value
        return getattr(self, next(iter(value)))(**value)  # the first key says what it is

    def handle(self, handle):
        return self.objects[handle]

    def text(self, text):
        return text

    def callback(self, callback):
        return lambda *_: callback == "stop"

    def points(self, points, dimension, closed):
        return doubles(points).reshape(-1, dimension), closed

    def curves(self, curves):
        return [self.points(**one) for one in curves]

    def known(self, known):
        return [(*(self.argument(one[name]) for name in KNOWN), one["fixed_ends"]) for one in known]

    def int32(self, int32):
        return np.array([int(one) for one in int32], np.int32)

    def int64(self, int64):
        return np.array([int(one) for one in int64], np.int64)

    def uint32(self, uint32):
        return np.array([int(one) for one in uint32], np.uint32)

    def bytes(self, bytes):
        return bytearray.fromhex(bytes)

    def output(self, output, capacity=None):
        return None if capacity is None else np.empty(capacity, TYPES[output])


# ----------------------------------------------------------------------------------------------------------------
# From Python to the file

def same(result, expected, libm):
    if isinstance(expected, str):
        wanted = number(expected)
        return same_double(result, wanted, libm) if isinstance(wanted, float) else result == wanted
    if isinstance(expected, list):
        return len(result) == len(expected) and all(
            same_double(float(one), float.fromhex(wanted), libm) for one, wanted in zip(result, expected))
    if not isinstance(expected, dict):
        return type(result) is int and result == expected
    if "text" in expected:
        return result == expected["text"]
    for name in ARRAYS.keys() & expected.keys():
        return result.dtype == ARRAYS[name] and result.tolist() == expected[name]
    if "bytes" in expected:
        return result.tobytes().hex() == expected["bytes"]
    return all(same(getattr(result, field), wanted, libm) for field, wanted in expected.items())


def same_double(result, wanted, libm):
    if type(result) is not float:
        return False
    if math.isnan(wanted):
        return math.isnan(result)
    if libm and abs(result - wanted) <= NEAR * max(1, abs(result), abs(wanted)):
        return True
    return struct.pack("<d", result) == struct.pack("<d", wanted)


def told_of(error):
    return {"status": f"IFSM_ERROR_{error.code.name}", "function": error.function, "argument": error.argument,
            "index": error.index, "value": repr(error.value), "required": error.required}


def told_in(step):
    error = step["error"]
    value = number(error["value"])
    nothing = math.isnan(value) and error["status"] != "IFSM_ERROR_NOT_FINITE"
    return {"status": error["status"], "function": step["call"], "argument": error["argument"],
            "index": None if int(error["index"]) < 0 else int(error["index"]),
            "value": repr(None if nothing else value),
            "required": None if int(error["required"]) < 0 else int(error["required"])}


# ----------------------------------------------------------------------------------------------------------------

@pytest.fixture(scope="module")
def outcomes():
    """(step, results or exception) of each call. Steps need what came before: all are run, whichever are looked at."""
    runner, outcomes = Runner(), []
    for step in STEPS:
        if "release" in step:
            del runner.objects[step["release"]]
            continue
        try:
            outcomes.append((step, runner.call(step)))
        except Exception as error:  # what it should have been is for the tests to say
            outcomes.append((step, error))
    return outcomes


@pytest.mark.parametrize("name", sorted({step["call"] for step in CALLS}))
def test_a_call_gives_what_the_file_says(outcomes, name):
    for step, outcome in outcomes:
        if step["call"] != name:
            continue
        if "error" in step:
            assert isinstance(outcome, ifsm.Error) and outcome.code is not None, (step, outcome)
            assert told_of(outcome) == told_in(step), step["arguments"]
        else:
            assert isinstance(outcome, list), (step, outcome)
            assert len(outcome) == len(step["results"]), (step, outcome)
            for result, (what, expected) in zip(outcome, step["results"].items()):
                assert same(result, expected, "libm" in step), (what, result, step)


def test_every_function_is_called():
    functions = {name for name in dir(native)
                 if name.startswith("ifsm_") and not isinstance(getattr(native, name), type)}
    assert functions == {step["call"] for step in CALLS}


def test_structs_are_told_whole():
    """Each field that a struct has in Python is in the file."""
    told = {}
    for step in CALLS:
        for result in step.get("results", {}).values():
            if isinstance(result, dict) and not result.keys() & {"text", "bytes", *ARRAYS}:
                told[frozenset(result)] = step["call"]
    for name in dir(native):
        kind = getattr(native, name)
        if name.startswith("ifsm_") and isinstance(kind, type):
            assert frozenset(field for field in dir(kind) if not field.startswith("_") and field not in
                             {"this", "thisown", "acquire", "disown", "own", "append", "next"}) in told, name


def test_the_runner_knows_all_kinds_of_values():
    """Those that the README tells of; the file need not have each."""
    runner = Runner()
    call = lambda name, results, **step: same_all(runner.call({"call": name, **step}), results)
    same_all = lambda found, expected: len(found) == len(expected) and all(map(same, found, expected, len(found) * [False]))
    hexadecimal = lambda *numbers: [float(one).hex() for one in numbers]
    assert call("ifsm_system_create", [], arguments={
        "dimension": 2, "maps": hexadecimal(.5, 0, 0, 0, .5, 0, .5, 0, .5, 0, .5, 0), "probabilities": []}, **{"as": "line"})
    handle = {"handle": "line"}
    assert call("ifsm_system_catalog", [{"dimension": 2, "name": {"text": "gasket_right"}, "source": {
        "text": "paper 003, Fig. 2a"}}], arguments={"index": 1})
    assert not call("ifsm_system_catalog", [{"dimension": 2, "name": {"text": "gasket_left"}}], arguments={"index": 1})
    report = {"width": 2, "height": 1, "left": "0x0p+0", "bottom": "-0x1p-1", "right": "0x1p+0", "top": "0x1p-1", "points": 9,
              "inside": 9, "met": 2, "undecided": 0}
    drawn = dict(system=handle, width=2, height=1, threads=1, left="0x0p+0", bottom="-0x1p-1", right="0x1p+0", top="0x1p-1",
                 seed="18446744073709551615", points=9, cancel=None, progress={"callback": "continue"})
    counts = runner.call({"call": "ifsm_system_histogram", "arguments": {**drawn, "counts": {"output": "uint32"}}})[1]
    assert counts.dtype == np.uint32 and counts.sum() == 9
    assert call("ifsm_system_histogram", [report, {"uint32": counts.tolist()}],
                arguments={**drawn, "counts": {"output": "uint32"}})
    assert not call("ifsm_system_histogram", [report, {"uint32": [0, 0]}], arguments={**drawn, "counts": {"output": "uint32"}})
    with pytest.raises(ifsm.Error) as caught:
        call("ifsm_system_histogram", [], arguments={**drawn, "counts": {"output": "uint32", "capacity": 1}})
    assert caught.value.code is ifsm.Status.CAPACITY and caught.value.required == 2
    assert call("ifsm_tone_map", [{"bytes": "00000000" + "204080ff"}], arguments={
        "counts": {"uint32": [0, 7]}, "palette": 0, "stops": {"bytes": "204080"}, "background": 0, "rgba": {"output": "uint8"}})
    saved = runner.call({"call": "ifsm_system_save", "arguments": {
        "system": handle, "format": 2, "name": None, "bytes": {"output": "uint8"}}})[0].tobytes()
    assert saved.startswith(b"system")
    assert call("ifsm_system_load", [], arguments={"bytes": {"bytes": saved.hex()}, "name": None}, **{"as": "again"})
    assert call("ifsm_model_from_system", [], arguments={"system": {"handle": "again"}, "topology": 1, "polygon": None,
                                                         "levels": 2}, **{"as": "model"})
