"""Run the Python blocks of the documentation: `python docs/blocks.py [file ...]`.

The blocks of one file run in order in one namespace. A block that is followed by a block
marked `text` prints exactly that. Run as a program, this writes what is printed into the
`text` blocks; `tests/unit/test_docs.py` compares.
"""

import contextlib
import io
import os
import re
import sys
import tempfile
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
BLOCK = re.compile(r"```python\n(?P<code>.*?)```\n(?:\n```text\n(?P<shown>.*?)```\n)?", re.DOTALL)


def pages() -> list[Path]:
    """Give the README and the pages of this folder that show what their Python blocks print."""
    found = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
    return [
        page
        for page in found
        if any(block["shown"] is not None for block in BLOCK.finditer(page.read_text("utf-8")))
    ]


def run(page: Path, folder: Path) -> list[tuple[re.Match[str], str]]:
    """Run the blocks of a page in a folder; give each block and what it printed."""
    space: dict[str, Any] = {"__name__": page.stem}
    done, here = [], Path.cwd()
    text = page.read_text("utf-8")
    os.chdir(folder)
    try:
        for block in BLOCK.finditer(text):
            line = text[: block.start()].count("\n") + 1
            # Empty lines keep the numbers of lines in a traceback those of the page.
            code = compile("\n" * line + block["code"], page.name, "exec")
            printed = io.StringIO()
            with contextlib.redirect_stdout(printed):
                exec(code, space)
            done.append((block, printed.getvalue()))
    finally:
        os.chdir(here)
    return done


def refresh(page: Path) -> bool:
    """Write what the blocks print into a page; tell whether it changed."""
    old = page.read_text("utf-8")
    new = old
    with tempfile.TemporaryDirectory() as folder:
        for block, printed in reversed(run(page, Path(folder))):
            if block["shown"] is not None:
                new = new[: block.start("shown")] + printed + new[block.end("shown") :]
    if new != old:
        page.write_text(new, "utf-8")
    return new != old


def main(names: list[str]) -> int:
    """Refresh the pages that are named, or all."""
    for page in [Path(name).resolve() for name in names] or pages():
        print(f"{page.relative_to(ROOT)}: {'changed' if refresh(page) else 'as it was'}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
