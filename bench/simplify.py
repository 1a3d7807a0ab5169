#!/usr/bin/env python3
"""Hausdorff distances of bench_hausdorff's sketches over those of Douglas and Peucker's polylines and of wavelets, at
equal floats: two a vertex; three a coefficient pair, as a detail.

usage: simplify.py SAMPLES ours.txt curve.csv...      (SAMPLES a power of two)
Vertices are taken where the polyline is farthest, until there are as many as asked for. Wavelets: K largest pairs, the
best of db2, db4, sym8 and bior4.4 by its own Hausdorff distance.
"""
import heapq
import math
import sys

import numpy as np
import pywt

from wavelet_best_k import WAVELETS, resample

FLOATS = [128, 256, 512, 1024]


def to_polyline(points, polyline):
    """The largest distance of the points from the polyline (a point a row)."""
    starts, steps = polyline[:-1], np.diff(polyline, axis=0)
    lengths = np.maximum((steps ** 2).sum(1), 1e-300)
    farthest = 0.0
    for part in np.array_split(points, max(1, len(points) * len(starts) // 2 ** 22)):
        off = part[:, None] - starts
        along = np.clip((off * steps).sum(2) / lengths, 0, 1)
        farthest = max(farthest, ((off - along[..., None] * steps) ** 2).sum(2).min(1).max())
    return math.sqrt(farthest)


def hausdorff(a, b):
    return max(to_polyline(a, b), to_polyline(b, a))


def simplified(points, vertices):
    def farthest(first, last):
        if last - first < 2:
            return 0.0, first
        start, step, inner = points[first], points[last] - points[first], points[first + 1:last]
        along = np.clip((inner - start) @ step / max(step @ step, 1e-300), 0, 1)
        distances = np.hypot(*(inner - start - along[:, None] * step).T)
        return distances.max(), first + 1 + int(distances.argmax())

    def segment(first, last):
        distance, at = farthest(first, last)
        return -distance, first, at, last

    kept, heap = {0, len(points) - 1}, [segment(0, len(points) - 1)]
    while len(kept) < vertices:
        _, first, at, last = heapq.heappop(heap)
        kept.add(at)
        heapq.heappush(heap, segment(first, at))
        heapq.heappush(heap, segment(at, last))
    return points[sorted(kept)]


def wavelets(points, pairs):
    for wavelet in WAVELETS:
        flat = [pywt.coeffs_to_array(pywt.wavedec(row, wavelet, mode="periodization")) for row in points[:-1].T]
        order = np.argsort(-np.hypot(flat[0][0], flat[1][0]))[:pairs]
        keep = np.zeros(flat[0][0].size, bool)
        keep[order] = True
        back = np.array([pywt.waverec(pywt.array_to_coeffs(np.where(keep, a, 0), s, "wavedec"), wavelet,
                                      mode="periodization") for a, s in flat]).T
        yield np.vstack([back, back[:1]])


def table(title, ratios):
    print(title)
    print(f"{'':18}" + "".join(f"{f:>8}" for f in FLOATS))
    for name, row in ratios.items():
        print(f"{name:18}" + "".join(f"{r:8.3f}" for r in row))
    means = np.exp(np.log(list(ratios.values())).mean(0))
    print(f"{'geometric mean':18}" + "".join(f"{m:8.3f}" for m in means) + "\n")


if __name__ == "__main__":
    samples = int(sys.argv[1])
    ours = {(name, int(f)): (float(h), float(squares)) for name, f, h, squares, _ in map(str.split, open(sys.argv[2]))}
    over_polyline, over_wavelet, over_squares = {}, {}, {}
    for path in sys.argv[3:]:
        name = path.split("/")[-1]
        points = resample(np.loadtxt(path, delimiter=",", skiprows=1).T, samples + 1).T
        polyline = [hausdorff(points, simplified(points, f // 2)) for f in FLOATS]
        wavelet = [min(hausdorff(points, w) for w in wavelets(points, f // 3)) for f in FLOATS]
        over_polyline[name] = [ours[name, f][0] / h for f, h in zip(FLOATS, polyline)]
        over_wavelet[name] = [ours[name, f][0] / h for f, h in zip(FLOATS, wavelet)]
        over_squares[name] = [ours[name, f][0] / ours[name, f][1] for f in FLOATS]
    table("Hausdorff over Douglas-Peucker's, at so many floats", over_polyline)
    table("over the best wavelet's", over_wavelet)
    table("over our own choice for the least squares", over_squares)
