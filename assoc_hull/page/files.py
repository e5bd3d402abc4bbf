"""Files that the page hands over, and that are dropped on it.

What it hands over is written to a folder that is gone afterwards. What was dropped is read as
`assoc_hull.read` does, and shown as lines beside: it never touches the hull of the page.
"""

from __future__ import annotations

import base64
import re
import shutil
import tempfile
from pathlib import Path
from typing import Any

from assoc_hull.edit.shapes import Shapes
from assoc_hull.errors import AssocHullError, BadInputError
from assoc_hull.hull.hull import Hull
from assoc_hull.hull.sources import read
from assoc_hull.model.tables import HullState
from assoc_hull.page.describe import describe_net
from assoc_hull.page.wire import Frame, FrameKind, pack

__all__ = ["EXPORTS", "MOST_BYTES", "read_dropped", "write_export"]

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
                notes = [report.words[:2000]]
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


# --------------------------------------------------------------------------------------
# Dropped files.

MOST_BYTES = 64 * 2**20

_LETTERS = 2000
"""So much of a report is told."""


def read_dropped(data: bytes, name: str) -> dict[str, Any]:
    """Read a file's content; give its lines, their shapes as a frame in base64, and the report.

    What cannot be read gives the `problem` alone, in the words of `assoc_hull.read`.
    """
    # Only letters that no system takes for a folder; the ending says what it is.
    own = re.sub(r"[^A-Za-z0-9._-]+", "-", name)[-80:].strip("-.") or "file"
    try:
        state, shapes, report = _read(data, own)
    except AssocHullError as error:
        # No folder of the server is named.
        return {"problem": re.sub(rf"[^\s']*/{re.escape(own)}", own, str(error))}
    except OSError as error:
        why = f"the server cannot keep the file while it reads ({error.strerror})"
        return {"problem": f"{why}; make room in its temporary folder, or set TMPDIR to another"}
    none = state.live("rows")[:0]
    frame = Frame(FrameKind.GHOST, 0, shapes.curves, shapes.spline, none, state.rows.xyz[none])
    net = describe_net(state)
    return {
        "name": own, "report": report[:_LETTERS], "particulars": net["particulars"],
        "lines": net["lines"], "frame": base64.b64encode(pack(frame)).decode(),
    }  # fmt: skip


def _read(data: bytes, own: str) -> tuple[HullState, Shapes, str]:
    """Read it in a folder that is gone afterwards."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, own)
        path.write_bytes(data)
        hull = read(path)
        found = hull.state, hull.shapes(), str(hull.creation) if hull.definitions else ""
        hull.close()
    return found
