"""Fuzz the readers with atheris, which follows the branches that an input takes.

``python -m tests.fuzz.guided offsets -max_total_time=60 -timeout=5 FOLDER``: the folder keeps the
inputs that led somewhere new. atheris is no dependency of the tests: ``pip install atheris``, for
the Pythons it is built for. It tries the readers alone, some hundred to a thousand inputs a second;
`python -m tests.fuzz` tries whole commands, with changes that know what an input means. Hulls as
JSON are left to that: changes of bytes do not come past the check of their form.
"""

from __future__ import annotations

import sys
import warnings
from collections.abc import Callable

__all__ = ["READERS"]


def _offsets(text: str) -> object:
    from assoc_hull.io.offsets.read import read_offsets

    return read_offsets(text + "\n", length=60.0)


def _lines(text: str) -> object:
    from assoc_hull.io.digitised.read import read_lines

    return read_lines(text + "\n")


def _iges(text: str) -> object:
    from assoc_hull.io.iges.surfaces import surfaces_of_iges

    return surfaces_of_iges(text, "file.igs")


READERS: dict[str, Callable[[str], object]] = {
    "offsets": _offsets, "lines": _lines, "iges": _iges
}  # fmt: skip


def main() -> None:
    """Fuzz one reader; what is left of the command line is for atheris."""
    import atheris

    from assoc_hull.errors import AssocHullError

    read = READERS[sys.argv.pop(1)]
    warnings.simplefilter("ignore")
    with atheris.instrument_imports(include=["assoc_hull.io", "assoc_hull.model"]):
        read_once(read, AssocHullError, b"")

    atheris.Setup(sys.argv, lambda data: read_once(read, AssocHullError, data))
    atheris.Fuzz()


def read_once(read: Callable[[str], object], expected: type[Exception], data: bytes) -> None:
    """Read an input; any other error than the expected is a fault."""
    try:
        read(data.decode("utf-8", "replace"))
    except expected:
        return


if __name__ == "__main__":
    main()
