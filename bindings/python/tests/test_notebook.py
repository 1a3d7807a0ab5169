import base64
import os
import pathlib

import pytest

nbformat = pytest.importorskip("nbformat")
nbclient = pytest.importorskip("nbclient")
pytest.importorskip("ipykernel")

NOTEBOOKS = pathlib.Path(__file__).resolve().parents[1] / "notebooks"


def test_the_notebook_runs_and_draws():
    notebook = nbformat.read(NOTEBOOKS / "coast.ipynb", as_version=4)
    assert not any(cell.get("outputs") for cell in notebook.cells), "keep notebooks without their outputs"
    nbclient.NotebookClient(notebook, timeout=300, resources={"metadata": {"path": str(NOTEBOOKS)}}).execute()
    pictures = [output.data["image/png"] for cell in notebook.cells for output in cell.get("outputs", [])
                if "image/png" in output.get("data", {})]
    assert len(pictures) >= 5
    folder = os.environ.get("IFSM_PICTURES")  # to look at them
    if folder:
        for number, picture in enumerate(pictures):
            pathlib.Path(folder, f"notebook-{number}.png").write_bytes(base64.b64decode(picture))
