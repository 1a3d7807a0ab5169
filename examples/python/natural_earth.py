#!/usr/bin/env python3
"""Fits every coastline of Natural Earth, 1:10 million, on all cores:  natural_earth.py [world-atlas-2.0.2.tgz]

Needs ifsm[batch], tqdm for the bar, and npm when no file is given. On more machines than this one: --scheduler.

    python -m venv venv && venv/bin/pip install 'ifsm[batch,progress]'
    venv/bin/python natural_earth.py
"""
import argparse
import collections
import contextlib
import json
import pathlib
import subprocess
import tarfile
import tempfile
import time

import numpy as np
from distributed import Client, LocalCluster

import ifsm

PACKAGE = "world-atlas@2.0.2"
MEMBER = "package/land-10m.json"
EARTH_RADIUS = 6371.0088  # km: (2a + b) / 3 of WGS 84
CLASSES = [(2, 4), (5, 10), (11, 100), (101, 1000), (1001, 100000)]  # samples, first … last
NEAR = 0.01  # of a ring's diagonal: how near a sketch comes, root mean square


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("source", nargs="?", type=pathlib.Path, help="the package, or its land-10m.json; else npm's")
    arguments.add_argument("--workers", type=int, help="processes; by default one a core")
    arguments.add_argument("--scheduler", help="address of a Dask scheduler, instead of processes of this machine")
    given = arguments.parse_args()
    coasts = [plane(ring) for ring in rings(topology(given.source))]
    coasts.sort(key=lambda coast: -len(coast[0]))  # the longest first: else everyone waits for it at the end
    with cluster(given) as address, Client(address) as client:
        started = time.perf_counter()
        fits = ifsm.batch.fit(coasts, client, progress=True)
        seconds = time.perf_counter() - started
    report(coasts, fits, seconds)


def cluster(given):
    if given.scheduler:
        return contextlib.nullcontext(given.scheduler)
    return LocalCluster(n_workers=given.workers, threads_per_worker=1, dashboard_address=":0")


# ---- Natural Earth, as TopoJSON --------------------------------------------------------------------------------------


def topology(source):
    if source is None:
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run(["npm", "pack", "--silent", PACKAGE], cwd=folder, check=True, stdout=subprocess.DEVNULL)
            return topology(next(pathlib.Path(folder).glob("*.tgz")))
    if source.suffix == ".json":
        return json.loads(source.read_bytes())
    with tarfile.open(source) as package:
        return json.load(package.extractfile(MEMBER))


def rings(topology):
    """All rings, as arrays of degrees east and north. Arcs are whole numbers, each point but the first told by the step
    to it; ~k is arc k backwards; arcs of a ring share their ends."""
    scale, origin = topology["transform"]["scale"], topology["transform"]["translate"]
    arcs = [np.cumsum(arc, axis=0) * scale + origin for arc in topology["arcs"]]
    for land in topology["objects"]["land"]["geometries"]:
        for polygon in land["arcs"]:
            for ring in polygon:
                parts = [arcs[k] if k >= 0 else arcs[~k][::-1] for k in ring]
                yield np.concatenate([parts[0], *(part[1:] for part in parts[1:])])


def plane(ring):
    """(kilometres east and north of the ring's middle, whether it is closed there): local equirectangular."""
    east = np.unwrap(ring[:, 0], period=360)  # goes on across the date line
    degrees = np.column_stack([east, ring[:, 1]])
    middle = (degrees.min(axis=0) + degrees.max(axis=0)) / 2
    shrink = np.cos(np.radians(middle[1])), 1
    around_a_pole = abs(east[-1] - east[0]) > 180  # Antarctica: on such a plane a line from west to east
    return EARTH_RADIUS * np.radians(degrees - middle) * shrink, not around_a_pole


# ---- What came out ---------------------------------------------------------------------------------------------------


def report(coasts, fits, seconds):
    samples = sum(len(points) for points, _ in coasts)
    print(f"{len(coasts)} coastlines, {samples} samples: {len(fits.models)} models in {seconds:.1f} s, "
          f"{sum(len(model.to_bytes()) for model in fits.models.values()) / 1e6:.1f} MB of CBOR")
    print(f"{'samples':>15} {'coastlines':>11} {'failures':>9} {'details':>9} {'needed':>9}   (means; needed to come "
          f"within {NEAR:.0%} of the diagonal)")
    for first, last in CLASSES:
        row(first, last, coasts, fits)
    for reason, count in collections.Counter(str(failure.error) for failure in fits.failures).most_common():
        print(f"failed {count} times: {reason}")


def row(first, last, coasts, fits):
    inside = lambda key: first <= distinct(coasts[key]) <= last
    models = [model for key, model in fits.models.items() if inside(key)]
    failures = sum(inside(failure.curve) for failure in fits.failures)
    details = np.mean([model.detail_count for model in models] or [np.nan])
    needed = np.mean([needed_details(model) for model in models] or [np.nan])
    print(f"{f'{first} … {last}':>15} {len(models) + failures:11} {failures:9} {details:9.1f} {needed:9.1f}")


def needed_details(model):
    return model.keep(within=NEAR * model.diagonal, resolve="none").details_kept


def distinct(coast):
    """Samples; the last vertex of a ring repeats the first."""
    points, closed = coast
    return len(points) - closed


if __name__ == "__main__":
    main()
