#!/usr/bin/env python3
"""RMS error of a curve kept as its K largest wavelet coefficient pairs: the peer of the detail budgets.

usage: wavelet_best_k.py SAMPLES curve.csv...      (SAMPLES a power of two)
Each curve is resampled by arc length to SAMPLES + 1 points, the last one dropped; x and y share one choice of
coefficients (largest norm of the pair). Prints, a line a curve and budget: name K rms of the best of db2, db4, sym8 and
bior4.4.
"""
import sys

import numpy as np
import pywt

BUDGETS = [16, 32, 64, 128, 256, 512]
WAVELETS = ["db2", "db4", "sym8", "bior4.4"]


def resample(points, count):
    along = np.r_[0, np.cumsum(np.hypot(*np.diff(points, axis=1)))]
    at = np.linspace(0, along[-1], count)
    return np.stack([np.interp(at, along, row) for row in points])


def errors(points, wavelet):
    coefficients = [pywt.wavedec(row, wavelet, mode="periodization") for row in points]
    flat = [pywt.coeffs_to_array(c) for c in coefficients]
    order = np.argsort(-np.hypot(flat[0][0], flat[1][0]))
    for budget in BUDGETS:
        keep = np.zeros(len(order), bool)
        keep[order[:budget]] = True
        back = [pywt.waverec(pywt.array_to_coeffs(np.where(keep, a, 0), s, "wavedec"), wavelet, mode="periodization")
                for a, s in flat]
        yield np.sqrt(((np.array(back) - points) ** 2).sum() / points.shape[1])


if __name__ == "__main__":
    samples = int(sys.argv[1])
    for path in sys.argv[2:]:
        points = resample(np.loadtxt(path, delimiter=",", skiprows=1).T, samples + 1)[:, :-1]
        best = np.min([list(errors(points, w)) for w in WAVELETS], axis=0)
        for budget, error in zip(BUDGETS, best):
            print(path.split("/")[-1], budget, error)
