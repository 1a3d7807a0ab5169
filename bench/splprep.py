#!/usr/bin/env python3
"""Time and floats of a smoothing spline that is as near to a curve as our sketch of K vectors: scipy's splprep.

usage: splprep.py SAMPLES ours.txt curve.csv...      (ours.txt: what bench_budgets printed)
Each curve is resampled by arc length to SAMPLES + 1 points, parameters equally spaced (arc length, as splprep's own
would be but for cut corners), cubic. s is bisected until the spline's RMS at the samples is ours within 0.1 %, which is
what FITPACK holds s to. Times are milliseconds of processor time: `call` is the one call at the s found (the median of
five), `search` the bisection with all its calls. Floats: the spline's are two a coefficient and one a knot, all that
tck holds but the degree. Ours over them: two values a vector; with one more for the address of each detail; with R's as
well, which a filter by name does not cost.
"""
import math
import statistics
import sys
import time

import numpy as np
from scipy.interpolate import splev, splprep

from compare import floats_of_filter
from wavelet_best_k import resample

BUDGET = 128
TOLERANCE = 1e-3


class Peer:
    def __init__(self, points):
        self.points = points
        self.at = np.linspace(0, 1, points.shape[1])

    def call(self, s):
        start = time.process_time()
        tck, _ = splprep(self.points, u=self.at, s=s, k=3)
        return tck, 1000 * (time.process_time() - start)

    def rms(self, tck):
        return np.sqrt(((np.array(splev(self.at, tck)) - self.points) ** 2).sum() / self.points.shape[1])

    def search(self, target):
        """From all of the curve's squares to 1e-8 of them, halving the exponent: as one does who knows nothing of s."""
        start = time.process_time()
        most = ((self.points - self.points.mean(axis=1, keepdims=True)) ** 2).sum()
        low, high, calls = most * 1e-8, most, 0
        while True:
            s = math.sqrt(low * high)
            tck, _ = self.call(s)
            calls += 1
            rms = self.rms(tck)
            if abs(rms / target - 1) <= TOLERANCE:
                return s, tck, calls, 1000 * (time.process_time() - start)
            low, high = (s, high) if rms < target else (low, s)


def load(path):
    for name, k, rms, n, maps, milliseconds in (row.split() for row in open(path)):
        if int(k) == BUDGET:
            yield name, float(rms), int(n), int(maps), float(milliseconds)


def compared(points, rms, n, maps, milliseconds):
    peer = Peer(points)
    s, tck, calls, searched = peer.search(rms)
    call = statistics.median(peer.call(s)[1] for _ in range(5))
    knots, floats = len(tck[0]), len(tck[0]) + 2 * len(tck[1][0])
    ours, addresses = 2 * BUDGET, BUDGET - n
    filter_floats = floats_of_filter(n, maps)
    return {
        "rms": rms, "s/(m rms^2)": s / (points.shape[1] * rms**2),
        "ours ms": milliseconds, "call ms": call, "search ms": searched, "calls": calls,
        "/call": milliseconds / call, "/search": milliseconds / searched,
        "knots": knots, "tck": floats, "values": ours / floats, "+ addresses": (ours + addresses) / floats,
        "+ R": (ours + addresses + filter_floats) / floats,
    }  # fmt: skip


def cell(value):
    return f"{value:12d}" if isinstance(value, int) else f"{value:12.4g}"


if __name__ == "__main__":
    samples, paths = int(sys.argv[1]), {path.split("/")[-1]: path for path in sys.argv[3:]}
    rows = {}
    for name, *told in load(sys.argv[2]):
        points = resample(np.loadtxt(paths[name], delimiter=",", skiprows=1).T, samples + 1)
        rows[name] = compared(points, *told)
    heads = list(next(iter(rows.values())))
    print(f"{'':18}" + "".join(f"{head:>12}" for head in heads))
    for name, row in rows.items():
        print(f"{name:18}" + "".join(map(cell, row.values())))
    means = [math.exp(sum(math.log(row[head]) for row in rows.values()) / len(rows)) for head in heads]
    print(f"{'geometric mean':18}" + "".join(map(cell, means)))
