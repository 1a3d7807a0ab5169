#!/usr/bin/env python3
"""What Python costs over C: run by an interpreter that has ifsm installed, on a machine that does nothing else.

    build/venv-3.11/bin/python bench/python_numbers.py [--leaks] [libifsm.so]

With the shared library of a C build beside it (build/bench/src/capi/libifsm.so), the same calls are made by ctypes from C
structs, for the ratios; medians of several. --leaks calls every function 10^5 times (fits a hundredth as often) and tells
by how much memory grew.
"""
import ctypes
import gc
import os
import pathlib
import signal
import statistics
import subprocess
import sys
import threading
import time

import numpy as np

import ifsm

COAST = pathlib.Path(__file__).resolve().parents[1] / "data" / "coast" / "great_britain.csv"


def walk(count):
    return np.cumsum(np.random.default_rng(1).normal(size=(count, 2)), axis=0)


def seconds(call, repeats=15):
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        call()
        times.append(time.perf_counter() - start)
    return statistics.median(times)


def each(call, times=20_000):
    """Seconds of one call of many."""
    def many():
        for _ in range(times):
            call()
    return seconds(many, 7) / times


class Curve(ctypes.Structure):
    _fields_ = [("points", ctypes.c_void_p), ("count", ctypes.c_int64), ("dimension", ctypes.c_int32),
                ("closed", ctypes.c_int32)]


class Budgets(ctypes.Structure):
    _fields_ = [("struct_size", ctypes.c_uint32), ("threads", ctypes.c_int32), ("start", ctypes.c_uint64),
                ("rest", ctypes.c_byte * 1024)]


def calls():
    print("one call, microseconds: all of it, and what the C function of the call takes (C side: see bench_calls)")
    model = ifsm.Model(walk(17), filter="casteljau")
    half = np.array(0.5)
    native = ifsm._native
    rows = {
        "model.dimension": lambda: model.dimension,
        "model(0.5)": lambda: model(0.5),
        "model(array)": lambda: model(half),
        "model.length()": model.length,
        "model.samples()": model.samples,
        "model.control_points": lambda: model.control_points,
        "native describe": lambda: native.ifsm_model_describe(model._native),
        "native length": lambda: native.ifsm_model_length(model._native, 0.0, 1.0),
        "empty function": lambda: None,
    }
    for name, call in rows.items():
        print(f"  {name:<24}{1e6 * each(call):8.3f}")


def c_calls(library):
    """The same C functions, called in a loop by a C program: compiled on the spot against the same library."""
    source = r"""
#include <ifsm.h>
#include <stdio.h>
#include <time.h>
static double now(void) { struct timespec t; clock_gettime(CLOCK_MONOTONIC, &t); return t.tv_sec + 1e-9 * t.tv_nsec; }
int main(void) {
  double points[34], out[64], half = 0.5, length; int64_t count; ifsm_filter f = {0}; ifsm_model m = {0};
  for (int k = 0; k < 34; ++k) points[k] = (k * k) % 11;
  ifsm_curve c = {points, 17, 2, 0};
  if (ifsm_filter_named("casteljau", 0, 5, 2, &f) || ifsm_model_create(f, &c, NULL, &m)) return 1;
  enum { TIMES = 200000 };
  int bad = 0; double t = now();
  for (int k = 0; k < TIMES; ++k) bad |= ifsm_model_evaluate(m, 0, &half, 1, out, 2, &count);
  printf("evaluate %.4f\n", (now() - t) / TIMES * 1e6); t = now();
  for (int k = 0; k < TIMES; ++k) bad |= ifsm_model_length(m, 0, 1, &length);
  printf("length %.4f\n", (now() - t) / TIMES * 1e6); t = now();
  for (int k = 0; k < TIMES; ++k) bad |= ifsm_model_samples(m, out, 34, &count);
  printf("samples %.4f\n", (now() - t) / TIMES * 1e6); t = now();
  for (int k = 0; k < TIMES; ++k) bad |= ifsm_model_control_points(m, out, 10, &count);
  printf("control_points %.4f\n", (now() - t) / TIMES * 1e6);
  return bad;
}
"""
    root = pathlib.Path(__file__).resolve().parents[1]
    program = pathlib.Path(library).parent / "python_numbers_c"
    subprocess.run(["cc", "-O2", "-x", "c", "-", "-I", root / "include", "-x", "none", library, "-o", program,
                    f"-Wl,-rpath,{pathlib.Path(library).resolve().parent}"], input=source, text=True, check=True)
    print("the same in C, microseconds")
    print("  " + subprocess.run([program], capture_output=True, text=True, check=True).stdout.replace("\n", "\n  ").rstrip())


def fits(library):
    points = walk(4097)
    python = seconds(lambda: ifsm.fit(points), 7)
    print(f"ifsm.fit of 4097 points: {1e3 * python:.1f} ms")
    if library:
        c = ctypes.CDLL(str(library))
        curve = Curve(points.ctypes.data, len(points), 2, 0)

        def in_c():
            fit, model = ctypes.c_uint64(), ctypes.c_uint64()
            assert c.ifsm_fit_sparse(ctypes.byref(curve), ctypes.c_int64(1), None, ctypes.byref(fit)) == 0
            assert c.ifsm_fit_model(fit, ctypes.c_int64(0), ctypes.byref(model)) == 0
            c.ifsm_model_destroy(model)
            c.ifsm_fit_destroy(fit)
        ratios = []
        for _ in range(9):  # in turns: the machine's speed drifts
            ratios.append(seconds(lambda: ifsm.fit(points), 1) / seconds(in_c, 1))
        print(f"  over C: {statistics.median(ratios):.4f} (median of {len(ratios)} pairs; {min(ratios):.3f} … {max(ratios):.3f})")


def threads():
    points = walk(4097)

    def work():  # long enough that starting threads, and the last one's end alone, do not count
        for _ in range(4):
            ifsm.fit(points, threads=1)

    def at_once(count):
        running = [threading.Thread(target=work) for _ in range(count)]
        for thread in running:
            thread.start()
        for thread in running:
            thread.join()
    ratios = [4 * seconds(lambda: at_once(1), 1) / seconds(lambda: at_once(4), 1) for _ in range(9)]
    print(f"four threads fitting at once, over one: {statistics.median(ratios):.2f} times on {os.cpu_count()} cores "
          f"({min(ratios):.2f} … {max(ratios):.2f})")


def imports():
    run = lambda code: seconds(lambda: subprocess.run([sys.executable, "-c", code], check=True), 11)
    empty, numpy, own = run("pass"), run("import numpy"), run("import ifsm")
    print(f"import: python alone {1e3 * empty:.0f} ms, with numpy {1e3 * numpy:.0f} ms, with ifsm {1e3 * own:.0f} ms: "
          f"ifsm itself {1e3 * (own - numpy):.0f} ms")


def interrupts():
    late = []
    points = walk(200_000)
    for program in (lambda: ifsm.fit(points, budget=2000), lambda: ifsm.Model(points).keep(within=0.5, distance="hausdorff"),
                    lambda: ifsm.fit_curve([points], reparameterise=10000)):
        sent = []

        def interrupt():
            time.sleep(0.7)
            sent.append(time.perf_counter())
            os.kill(os.getpid(), signal.SIGINT)
        threading.Thread(target=interrupt).start()
        try:
            program()
        except KeyboardInterrupt:
            late.append(1e3 * (time.perf_counter() - sent[0]))
    print("Ctrl-C answered after, ms:", ", ".join(f"{each:.0f}" for each in late))


def resident():
    with open("/proc/self/statm") as statm:
        return int(statm.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def leaks():
    points = walk(17)
    model = ifsm.Model(points, filter="casteljau")
    other = ifsm.Model(points[::-1], filter="casteljau")
    filter = model.filter
    deformer = model.deformer().move(0, 1, [-40.0, 30.0])
    edits = deformer.to_bytes()
    fit = ifsm.fit_curve([points], fixed_filter=True)
    data = model.to_bytes()
    gasket = ifsm.systems.gasket()
    maps, parameters, saved = gasket.maps, gasket.parameters, gasket.to_bytes()
    line = ifsm.systems.koch()
    own = line.model(levels=1)

    def failing(call):
        def attempt():
            try:
                call()
            except ifsm.Error:
                pass
        return attempt

    many = {
        "Filter": lambda: ifsm.Filter("casteljau"), "from_matrix": lambda: ifsm.Filter.from_matrix(
            filter.matrix, control_points=5, maps=2), "Model": lambda: ifsm.Model(points, filter),
        "from_polygon": lambda: ifsm.Model.from_polygon(points[:5], levels=2), "call": lambda: model(0.5),
        "samples": model.samples, "points": model.points, "parameters": model.parameters,
        "address": lambda: model.address(0.3, 5), "interval": lambda: model.interval([0, 1]), "details":
        lambda: model.details(1), "significance": lambda: model.significance(1), "keep": lambda: model.keep(levels=1),
        "with_control_points": lambda: model.with_control_points(points[:5]), "with_details":
        lambda: model.with_details(0, points[:4]), "with_filter": lambda: model.with_filter(filter), "refine": model.refine,
        "length": model.length, "spaced": lambda: model.spaced(5), "nearest": lambda: model.nearest(points[:2]),
        "distance": lambda: model.distance(other), "curvature": lambda: model.curvature(0.5, 1.0), "crossings":
        model.crossings, "fractal_dimension": lambda: model.fractal_dimension("divider"), "spectrum": model.spectrum,
        "to_bytes": model.to_bytes, "from_bytes": lambda: ifsm.Model.from_bytes(data), "hash": lambda: hash(
            ifsm.Model.from_bytes(data)), "model.filter": lambda: model.filter, "deformer": model.deformer,
        "move, undo": lambda: deformer.move(0, 1, [0.0, 1.0]).undo(), "pin, undo": lambda: deformer.pin(0, 1).undo(),
        "drag, undo": lambda: deformer.drag(1, 0.5, [0.0, 0.0]).undo(), "restyle, undo": lambda: deformer.restyle(
            0, 1, 2.0).undo(), "texture, undo": lambda: deformer.texture(0, 1, seed=1).undo(), "keep_as, go_to, undo":
        lambda: deformer.keep_as("a").go_to("a").undo(), "time": lambda: deformer.time(0, 1), "at_time":
        lambda: deformer.at_time(0.5), "replay": lambda: model.deformer().replay(edits), "deformer points":
        deformer.points, "deformer samples": deformer.samples, "deformer call": lambda: deformer(0.5), "changed":
        lambda: deformer.changed(0), "deformer crossings": deformer.crossings, "snapshot": deformer.snapshot,
        "report": lambda: fit.report, "fit.model": fit.model, "fit.sketch": fit.sketch, "fit.budget": fit.budget,
        "fit.parameters": fit.parameters, "covariance": fit.covariance, "curve_covariance": lambda: fit.curve_covariance(0.5),
        "System": lambda: ifsm.System(maps, [1, 2, 3]), "from_parameters": lambda: ifsm.System.from_parameters(parameters),
        "named": ifsm.systems.fern, "catalog": ifsm.systems.catalog, "maps": lambda: gasket.maps, "system parameters":
        lambda: gasket.parameters, "probabilities": lambda: gasket.probabilities, "fixed_points":
        lambda: gasket.fixed_points, "word": lambda: gasket.word([0, 1]), "point": lambda: gasket.point([0, 1]),
        "addresses": lambda: gasket.addresses([0.5, 0], 4), "box": gasket.box, "moments": lambda: gasket.moments(2),
        "similarity_dimension": gasket.similarity_dimension, "system to_bytes": gasket.to_bytes, "system from_bytes":
        lambda: ifsm.System.from_bytes(saved), "system model": lambda: line.model(levels=1), "from_model":
        lambda: ifsm.System.from_model(own), "histogram": lambda: gasket.histogram(4, points=9, full=True), "render":
        lambda: gasket.render(4, points=9, palette=["#fff", "#000"]), "tone_map": lambda: ifsm.tone_map([[1, 2]]),
        "sample": lambda: gasket.sample(9), "sample_addresses": lambda: gasket.sample_addresses(9, 3),
        "refused picture": failing(lambda: gasket.render(0)), "refused maps": failing(lambda: ifsm.System([[1, 2]])),
        "refused value": failing(lambda: model.points(levels=99)), "refused type": failing(lambda: model("a")),
        "refused array": failing(lambda: ifsm.Model([[1, 2], [3, np.nan]])),
    }
    few = {
        "fit": lambda: ifsm.fit(points), "fit_sparse": lambda: ifsm.fit_sparse([points], progress=lambda *_: None),
        "fit_curve": lambda: ifsm.fit_curve([points], known=[ifsm.Known(fixed_ends=True)]), "fit_filter":
        lambda: ifsm.fit_filter([points]), "train": lambda: ifsm.train([points], rounds=1), "cancelled fit":
        failing(lambda: ifsm.fit(points, progress=lambda *_: True)), "keep details": lambda: model.keep(details=3),
        "set": lambda: gasket.set(9), "distances": lambda: gasket.distances(9), "ball": gasket.ball, "diameter":
        gasket.diameter, "box_dimension": lambda: gasket.box_dimension(6), "cancelled picture":
        failing(lambda: gasket.render(99, progress=lambda *_: True)),
    }
    worst = 0
    for calls, times in ((many, 100_000), (few, 1_000)):
        for name, call in calls.items():
            for _ in range(times // 10):
                call()
            gc.collect()
            before = resident()
            for _ in range(times):
                call()
            gc.collect()
            grown = resident() - before
            worst = max(worst, grown)
            print(f"  {name:<24}{times:>8} times: {grown / 2**20:+.2f} MiB", flush=True)
    print(f"memory grew by {worst / 2**20:.2f} MiB at most")


def main(arguments):
    library = next((path for path in arguments if path.endswith(".so")), None)
    if "--leaks" in arguments:
        return leaks()
    calls()
    if library:
        c_calls(library)
    fits(library)
    threads()
    imports()
    interrupts()


if __name__ == "__main__":
    main(sys.argv[1:])
