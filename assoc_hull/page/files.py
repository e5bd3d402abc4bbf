"""Files of the hull that the page hands over: written to a folder that is gone afterwards."""

from __future__ import annotations

import base64
import re
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
        if form in _PLANS:
            hull.plot.lines_plan(path)
            notes = []
        else:
            report = hull.export(path)
            notes = [str(report)[:2000]]
        data = path.read_bytes()
    return {"name": path.name, "data": base64.b64encode(data).decode(), "notes": notes,
            "bytes": len(data), "what": EXPORTS[form]}  # fmt: skip
