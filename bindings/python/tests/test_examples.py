"""Examples in docstrings, in the README, and the scripts run as they stand."""
import doctest
import importlib
import pathlib
import re

import numpy as np
import pytest

import ifsm

README = pathlib.Path(__file__).resolve().parents[1] / "README.md"


@pytest.mark.parametrize("name", ["ifsm", "ifsm.plot", "ifsm.systems", "ifsm._pictures"])
def test_examples_in_docstrings_say_what_happens(name):
    if name == "ifsm.plot":
        pytest.importorskip("matplotlib").use("Agg")
    module = importlib.import_module(name)
    runner = doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE)
    for test in doctest.DocTestFinder().find(module, name, extraglobs={"ifsm": ifsm, "np": np}):
        runner.run(test)
    assert runner.failures == 0 and runner.tries > 1


def test_the_readme_runs(tmp_path, monkeypatch):
    blocks = re.findall(r"```python\n(.*?)```", README.read_text(encoding="utf-8"), re.S)
    assert blocks
    monkeypatch.chdir(tmp_path)
    names = {}
    for block in blocks:
        exec(compile(block, str(README), "exec"), names)


def test_no_module_needs_more_than_numpy():
    import subprocess
    import sys

    loaded = subprocess.run([sys.executable, "-c", "import sys, ifsm; print(*sys.modules)"], capture_output=True, text=True,
                            check=True).stdout.split()
    assert not {"matplotlib", "dask", "distributed", "tqdm", "shapely"} & set(loaded)
