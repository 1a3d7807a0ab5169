"""Type stubs: mypy's stubtest holds them to the code, and programs that are right pass where wrong ones do not."""
import os
import pathlib
import re
import shutil
import subprocess
import sys

import pytest

import ifsm

pytest.importorskip("mypy", reason="mypy is not installed")
from mypy.defaults import PYTHON3_VERSION_MIN  # noqa: E402

README = pathlib.Path(__file__).resolve().parents[1] / "README.md"
PACKAGE = pathlib.Path(ifsm.__file__).parent
VERSIONS = sorted({".".join(map(str, version[:2])) for version in (PYTHON3_VERSION_MIN, sys.version_info)})

RIGHT = """
import copy
import logging
import pathlib
from typing import Optional

import numpy as np
from numpy.typing import NDArray
from typing_extensions import assert_type

import ifsm

Doubles = NDArray[np.float64]
rows: list[list[float]] = [[0.0, 1.0], [1.0, 2.0], [2.0, 0.5]]
samples = np.asarray(rows)


def tell(fraction: float, stage: str) -> bool:
    return fraction > 0.5 and stage == "sparse"


# points are whatever holds numbers, or a geometry
model = ifsm.Model(rows)
for given in (samples.astype(np.float32), samples.astype(np.int64)):
    ifsm.Model(given, filter="casteljau")
ifsm.Model([(0, 0), (1, 2)], ifsm.Filter("haar", topology="square"))
ifsm.Model([samples[0], samples[1]], closed=True)
ifsm.Model({"type": "LineString", "coordinates": rows})
ifsm.Model(model)
assert_type(ifsm.curves(model), list[tuple[Doubles, bool]])

# the curve, in numbers
assert_type(model.points(levels=np.argmax(samples)), Doubles)
assert_type(model.samples(out=np.empty((3, 2))), Doubles)
assert_type(model(0.5), Doubles)
assert_type(model.curvature(0.5, 1), float)
assert_type(model.curvature([0.25, 0.5], 1.0), Doubles)
assert_type(model.address(0.5, 3), NDArray[np.int32])
assert_type(model.interval([0, 1]), tuple[float, float])
assert_type(model.distance(model).farthest, int)
assert_type(model.nearest(rows).parameters, Doubles)
assert_type(model.spaced(5), Doubles)
assert_type(model.spaced(spacing=0.5), Doubles)
assert_type(model.filter.contractive, Optional[bool])

# sketches, by one rule each
assert_type(model.keep(details=3), ifsm.Model)
model.keep(levels=2, resolve="values")
model.keep(above=0.1)
model.keep(within=0.1, distance="hausdorff", progress=tell)
model.keep(levels_within=0.1, details=None, progress=True)

# a chain of edits, also of one's own deformers
bent = model.deformer(turning="rotation").move(0, [1, 2], rows[:2]).drag(2, 0.5, [1, 2]).undo().keep_as("before")
assert_type(bent, ifsm.Deformer)
assert_type(bent.restyle(0, 1, 2.0, angle=0.1).at_time(0.5).snapshot(), ifsm.Model)
assert_type(bent.span, tuple[float, float])


class Editor(ifsm.Deformer):
    def nudge(self) -> "Editor":
        return self.pin(0, range(3)).move(0, 0, [0, 1], reach="curve")


# fits
known = ifsm.Known(through=[(0.5, [2, 2])], along=[(0, [1, 1])], weights=np.ones(3))
with ifsm.fit_curve([(samples, False), rows, model], known=[known, None], loss="huber", loss_scale=0.1) as found:
    assert_type(found.report.iterations, int)
    assert_type(found.budget().rms, float)
    if found.report.stage == "curve":
        assert_type(found.covariance(), Doubles)
trained, report = ifsm.train((line for line in [samples, samples]), budgets=[64, 128])
assert_type(trained, ifsm.Filter)
assert_type(report.ratio, float)

# systems and their pictures
gasket = ifsm.System([[[0.5, 0, 0], [0, 0.5, 0]], [[0.5, 0, 0.5], [0, 0.5, 0]]], weights=[1, 2])
assert_type(ifsm.systems.fern(), ifsm.System)
assert_type([entry.dimension for entry in ifsm.systems.catalog()], list[int])
assert_type(ifsm.System.from_parameters(np.zeros((3, 6))), ifsm.System)
assert_type(ifsm.System.from_parameters(angles=[0.1, 0.2], scales=0.5, shifts=[[0, 0], [1, 0]]), ifsm.System)
assert_type(gasket.contractive, Optional[bool])
assert_type(gasket.witness, Optional[NDArray[np.int32]])
assert_type(gasket.moments(2)[1, 0], float)
assert_type(gasket.ball().radius, float)
assert_type(gasket.box_dimension(), ifsm.Dimension)
assert_type(gasket.model(levels=3, topology="joined"), ifsm.Model)
assert_type(gasket.addresses(gasket.point([0, 1]), 3), NDArray[np.int32])
counts, told = gasket.histogram((300, 200), window=(0, 0, 1.0, 2), full=True)
assert_type(counts, NDArray[np.uint32])
assert_type(told.window, tuple[float, float, float, float])
assert_type(gasket.histogram(64, points=1000, progress=tell), NDArray[np.uint32])
assert_type(gasket.set(64), NDArray[np.uint8])
assert_type(gasket.distances(64, full=True), tuple[Doubles, ifsm.PictureReport])
assert_type(gasket.render(64, palette=["#fff", (1, 2, 3)], background=(0, 0, 0, 255), colour="address"), NDArray[np.uint8])
assert_type(ifsm.tone_map(counts, palette="sea"), NDArray[np.uint8])
assert_type(gasket.sample_addresses(100, 5), NDArray[np.int32])
with open("two.ifs", "rb") as file:
    assert_type(ifsm.System.load(file, "one"), ifsm.System)
gasket.save(pathlib.Path("gasket.ifs"), format="fractint")
ifsm.plot.system(gasket, palette="fern", window=[0, 0, 1, 1])

# modules that are there when they are used
def failed(fits: ifsm.batch.Fits) -> list[str]:
    return [str(failure.error) for failure in fits.failures]


ifsm.plot.before_after(model, bent, ax=ifsm.plot.curve(model, levels=2))
ifsm.plot.levels(bent, [0, 1], ax=ifsm.plot.levels(model, range(2)))


# files, copies, settings
with model as again:
    assert_type(again, ifsm.Model)
    again.save(pathlib.Path("curve.json"), format="json")
    assert_type(ifsm.load("curve.json"), ifsm.Model)
    assert_type(ifsm.Model.from_bytes(again.to_bytes()), ifsm.Model)
    assert_type(copy.deepcopy(again), ifsm.Model)
    pairs: dict[ifsm.Model, str] = {again: "hashed"}
ifsm.log_to(logging.getLogger("mine"))
ifsm.log_to(None)
ifsm.set_threads(ifsm.threads())

# errors
try:
    ifsm.fit(rows, budget=128, filter="coast")
except (ifsm.InvalidValue, ifsm.InvalidType) as error:
    assert_type(error.index, Optional[int])
    if error.code is ifsm.Status.SHAPE or error.argument == "points":
        print(error, error.function, error.required)
except ifsm.Error as error:
    raise SystemExit(str(error)) from error
kinds: list[type[ValueError]] = [ifsm.InvalidValue, ifsm.Closed]
"""

WRONG = """
import numpy as np

import ifsm

points = np.zeros((9, 2))
single = points.astype(np.float32)
names: list[str] = ["a", "b"]
model = ifsm.fit("coast.csv")  # wrong
model = ifsm.fit(points)
model = ifsm.fit(names)  # wrong
model = ifsm.fit(points, True)  # wrong
model = ifsm.fit(points, distance="rmse")  # wrong
model = ifsm.fit(points, budget=1.5)  # wrong
model = ifsm.fit(points, budget=15)
model = ifsm.fit_sparse([points])  # wrong
ifsm.fit_sparse("coast.csv")  # wrong
ifsm.Filter("daubechies")  # wrong
model.filter.maps = 3  # wrong
model.keep()  # wrong
model.keep(details=3, within=0.1)  # wrong
model.keep(3)  # wrong
model.spaced(3, spacing=0.5)  # wrong
model.nearest("here")  # wrong
model.points(3)  # wrong
model.samples(out=single)  # wrong
model.curvature(0.5, 1.0).shape  # wrong
model.curvature([0.5], 1.0).shape
model.deformer().move(0, 2.5, [0, 1])  # wrong
model.deformer().move(0, 2, [0, 1], falloff="soft")  # wrong
model.deformer().move(0, 2, [0, 1]).snapshot().undo()  # wrong
model.deformer().move(0, 2, [0, 1]).undo().snapshot()
ifsm.batch.fit([points], "tcp://scheduler")  # wrong
ifsm.plot.curve(points)  # wrong
ifsm.systems.fernn()  # wrong
fern = ifsm.systems.fern()
fern.render(64, "sea")  # wrong
fern.render(64, palette="viridis")  # wrong
fern.render(1.5)  # wrong
fern.render(64, background=0.5)  # wrong
fern.render(64, full=True).shape  # wrong
fern.render(64).shape
fern.witness.tolist()  # wrong
fern.to_bytes("xml")  # wrong
ifsm.System("fern")  # wrong
ifsm.System.from_parameters(angles=[0.5])  # wrong
ifsm.plot.system(model)  # wrong
ifsm.Error("full").index + 1  # wrong
ifsm.Model._native  # wrong
"""


def run(folder, module, *arguments, **variables):
    """(exit status, what it says), in a folder where nothing but what is installed is found."""
    environment = {**os.environ, "MYPYPATH": "", **variables}
    done = subprocess.run([sys.executable, "-m", module, *arguments], cwd=folder, env=environment,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return done.returncode, done.stdout


@pytest.fixture
def stubs(tmp_path):
    """A copy of the package's stubs alone: for private modules, which have none, stubtest would take their code."""
    package = tmp_path / "stubs" / "ifsm"
    package.mkdir(parents=True)
    for stub in PACKAGE.glob("*.pyi"):
        shutil.copy(stub, package)
    return package


@pytest.fixture
def stubtest(stubs, tmp_path):
    """stubtest(): what it says of the copied stubs and the installed code, all of which it imports."""
    pytest.importorskip("matplotlib", reason="ifsm.plot needs matplotlib")
    return lambda: run(tmp_path, "mypy.stubtest", "--concise", "ifsm", MYPYPATH=str(stubs.parent))


@pytest.fixture
def checked(tmp_path, tmp_path_factory):
    """checked(program, …): what mypy says of it, strictly."""
    def check(program, *arguments):
        (tmp_path / "program.py").write_text(program, encoding="utf-8")
        cache = tmp_path_factory.getbasetemp() / "mypy"
        return run(tmp_path, "mypy", "--strict", "--config-file=", *arguments, "program.py", MYPY_CACHE_DIR=str(cache))
    return check


def test_stubs_say_what_the_code_does(stubtest):
    status, told = stubtest()
    assert status == 0, told


def test_stubs_that_say_something_else_are_found(stubs, stubtest):
    changes = {
        "ifsm.Model.refine": ("levels: _Int = 1, *, seed", "levels: _Int = 2, *, seed"),
        "ifsm.Deformer.pin": ("pin(self, level: _Int, handles", "pin(self, level: _Int, *, handles"),
        "ifsm.Filter.condition": ("    @property\n    def condition(self)", "    def condition(self)"),
        "ifsm.Status.BUSY": ("    BUSY = 13\n", ""),
        "ifsm.load": ("def load(path: _Path) -> Model", "def load(file: _Path) -> Model"),
        "ifsm.System.word": ("def word(self, symbols", "def word(self, letters"),
    }
    stub = stubs / "__init__.pyi"
    text = stub.read_text(encoding="utf-8")
    for right, wrong in changes.values():
        assert text.count(right) == 1, right
        text = text.replace(right, wrong)
    stub.write_text(text, encoding="utf-8")
    status, told = stubtest()
    assert status == 1
    assert {line.split()[0] for line in told.splitlines()} == set(changes), told


def test_stubs_have_the_numbers_of_statuses(stubs):
    """Which stubtest does not look at."""
    numbers = re.findall(r"^    ([A-Z_]+) = (\d+)$", (stubs / "__init__.pyi").read_text(encoding="utf-8"), re.M)
    assert numbers == [(status.name, str(int(status))) for status in ifsm.Status]


def test_the_package_says_that_it_is_typed():
    assert (PACKAGE / "py.typed").is_file()


@pytest.mark.parametrize("version", VERSIONS)
def test_right_programs_pass(checked, version):
    status, told = checked(RIGHT, "--python-version", version)
    assert status == 0, told


def test_the_readme_passes(checked):
    block = re.search(r"```python\n(.*?)```", README.read_text(encoding="utf-8"), re.S)
    status, told = checked(block.group(1))
    assert status == 0, told


def test_wrong_programs_are_told_where(checked):
    status, told = checked(WRONG)
    expected = [number for number, line in enumerate(WRONG.split("\n"), 1) if line.endswith("# wrong")]
    found = sorted({int(number) for number in re.findall(r"^program.py:(\d+): error:", told, re.M)})
    assert status == 1
    assert len(expected) > 15
    assert found == expected, told
