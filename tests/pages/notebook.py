# SPDX-License-Identifier: GPL-2.0-or-later
"""The cells of a notebook run, and the last expression of the last cell but one has three values:
notebook.py <notebook> <folder of the project>"""

import os
import sys
import tempfile

import nbformat
from nbclient import NotebookClient

# The kernel of the Python that runs this test, whichever kernels are installed
with tempfile.TemporaryDirectory() as home:
    os.environ["JUPYTER_DATA_DIR"] = home
    os.environ["IPYTHONDIR"] = home
    notebook = nbformat.read(sys.argv[1], as_version=4)
    NotebookClient(notebook, timeout=600, resources={"metadata": {"path": sys.argv[2]}}).execute()

outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
pictures = [output for output in outputs if "image/png" in output.get("data", {})]
values = [output["data"]["text/plain"] for output in outputs if output["output_type"] == "execute_result"]
assert pictures, "no picture"
assert len(values) == 1 and "hub_drop" in values[0], f"not the averages: {values}"
print(values[0])
