"""Run the example notebook and keep what its cells show; write its cells into the page of the site.

`make site` runs it in its own environment: `python docs/notebook_cells.py`. A cell that fails, but
for those marked so, ends it. Nothing of time or machine is kept, so the same code gives the same
file.
"""

import html
import json
import os
import re
import sys
import tempfile
from pathlib import Path
from typing import Any

NOTEBOOK = Path(__file__).with_name("hull.ipynb")
PAGE = "notebook.md"
MARK = r"<!-- cells of hull\.ipynb -->"


def execute() -> None:
    """Run all cells in a kernel, and write the notebook with what they show."""
    import nbformat
    from jupyter_client.manager import AsyncKernelManager
    from nbclient import NotebookClient

    notebook = nbformat.read(NOTEBOOK, as_version=4)
    with tempfile.TemporaryDirectory() as folder:
        # Its sockets are files of the folder: nobody else on the machine can speak to the kernel.
        kernel = AsyncKernelManager(kernel_name="python3", transport="ipc", ip=f"{folder}/kernel")
        client = NotebookClient(
            notebook, km=kernel, timeout=300, resources={"metadata": {"path": folder}},
            record_timing=False,
        )  # fmt: skip
        client.execute(env={**os.environ, "PYTHONPATH": str(NOTEBOOK.parents[1])})
    notebook.metadata = {"kernelspec": notebook.metadata["kernelspec"]}
    for cell in notebook.cells:
        cell.metadata.pop("execution", None)
    NOTEBOOK.write_text(json.dumps(notebook, indent=1, ensure_ascii=False) + "\n", "utf-8")


def tables() -> str:
    """Give the cells with what they show as Markdown."""
    cells = json.loads(NOTEBOOK.read_text("utf-8"))["cells"]
    return "\n\n".join(part for cell in cells for part in _parts(cell))


def _parts(cell: dict[str, Any]) -> list[str]:
    source = "".join(cell["source"])
    if cell["cell_type"] == "markdown":
        return [source]
    return [f"```python\n{source}\n```", *map(_shown, cell["outputs"])]


def _shown(output: dict[str, Any]) -> str:
    """Give an output in the richest of its forms that a page can hold."""
    kinds = output.get("data", {})
    if "text/html" in kinds:
        return "".join(kinds["text/html"]).replace("\n\n", "\n&#8203;\n")
    if "image/png" in kinds:
        data = "".join(kinds["image/png"]).replace("\n", "")
        return f'<img alt="What the cell shows" src="data:image/png;base64,{data}">'
    text = kinds.get("text/plain") or output.get("text") or _last(output)
    return f"<pre>{html.escape(''.join(text), quote=False)}</pre>"


def _last(output: dict[str, Any]) -> str:
    """Give a failure as IPython shows it, without colours."""
    return re.sub(r"\x1b\[[0-9;]*m", "", "\n".join(output["traceback"]))


if __name__ == "__main__":
    execute()
    print(f"{NOTEBOOK.name}: {NOTEBOOK.stat().st_size} bytes")
    sys.exit(0)
