"""Files of the hull that the page hands over: written to a folder that is gone afterwards."""

from __future__ import annotations

import base64
import re
import shutil
import tempfile
from pathlib import Path
from typing import Any

from assoc_hull.errors import BadInputError
from assoc_hull.hull.hull import Hull

__all__ = ["EXPORTS", "write_export"]

EXPORTS = {
    "pdf": "lines plan, PDF", "svg": "lines plan, SVG", "dxf": "all lines as splines, DXF",
    "csv": "table of offsets, CSV", "xlsx": "table of offsets, workbook",
    "hull.json": "the hull itself, as text", "iges": "surface, IGES", "step": "surface, STEP",
    "stl": "closed mesh, STL",
}  # fmt: skip
"""Endings that the page offers, and what each means."""

_PLANS = ("pdf", "svg")

_ROOM = 16 * 2**20
"""Bytes; where less is free, a file that cannot be written is a full disk."""


def write_export(hull: Hull, form: str) -> dict[str, Any]:
    """Write a copy of the hull in a form of `EXPORTS`; give its name, and its bytes in base64.

    Raises
    ------
    BadInputError, MissingExtraError, OpenNetError, OpenMeshError, NotSoundError
        No such form; what `Hull.export` and `lines_plan` raise.
    """
    if form not in EXPORTS:
        known = ", ".join(EXPORTS)
        raise BadInputError(f"the form {form[:20]!r} is not known", "in export", f"use {known}")
    name = re.sub(r"[^A-Za-z0-9._-]+", "-", hull.particulars.name).strip("-.") or "hull"
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, f"{name}.{form}")
        try:
            if form in _PLANS:
                hull.plot.lines_plan(path)
                notes = []
            else:
                report = hull.export(path)
                notes = [str(report)[:2000]]
            data = path.read_bytes()
        except (OSError, BadInputError) as error:
            # Where it is written is no choice of who asks: the remedy of the library is none here.
            if shutil.disk_usage(folder).free >= _ROOM:
                raise
            what = f"the server has no room to write {path.name} ({tempfile.gettempdir()} is full)"
            remedy = "make room there, or set TMPDIR to another folder"
            raise BadInputError(what, "in export", remedy) from error
    return {"name": path.name, "data": base64.b64encode(data).decode(), "notes": notes,
            "bytes": len(data), "what": EXPORTS[form]}  # fmt: skip
