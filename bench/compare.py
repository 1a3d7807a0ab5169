#!/usr/bin/env python3
"""The tables of docs/benchmarks.md:  compare.py ours.txt peer.txt
Ratios of K-detail RMS (bench_budgets) over the best wavelet's (wavelet_best_k.py), as K counts vectors; and, with R's
floats counted, over the wavelet's at K + floats / 2 vectors, its error interpolated log-log."""
import math
import sys


def load(path):
    return {(name, int(k)): [float(x) for x in rest]
            for name, k, *rest in (row.split() for row in open(path)) if name}


def interpolated(errors, name, budgets, k):
    low = max([b for b in budgets if b <= k] or budgets[:1])
    low = min(low, budgets[-2])
    high = budgets[budgets.index(low) + 1]
    a, b = math.log(errors[name, low][0]), math.log(errors[name, high][0])
    return math.exp(a + (b - a) * math.log(k / low) / math.log(high / low))


def floats_of_filter(n, maps):
    width = (n - 1) * maps + 1
    return (width - 2) * (width - 1)


def table(title, ratio, names, budgets):
    print(title)
    print(f"{'':18}" + "".join(f"{k:>8}" for k in budgets))
    for name in names:
        print(f"{name:18}" + "".join(f"{ratio(name, k):8.3f}" for k in budgets))
    mean = [math.exp(sum(math.log(ratio(name, k)) for name in names) / len(names)) for k in budgets]
    print(f"{'geometric mean':18}" + "".join(f"{m:8.3f}" for m in mean) + "\n")


if __name__ == "__main__":
    ours, peer = load(sys.argv[1]), load(sys.argv[2])
    names, budgets = sorted({n for n, _ in ours}), sorted({k for _, k in ours})
    table("RMS over the best wavelet's, R not counted", lambda n, k: ours[n, k][0] / peer[n, k][0], names, budgets)

    def counted(name, k):
        rms, n, maps = ours[name, k][:3]
        return rms / interpolated(peer, name, budgets, k + floats_of_filter(int(n), int(maps)) / 2)

    table("R's floats counted (two a vector)", counted, names, budgets)
    times = sorted(row[3] for row in ours.values())
    print(f"a fit took {times[len(times) // 2]:.0f} ms (median), {times[-1]:.0f} at most")
