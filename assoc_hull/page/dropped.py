"""A file that was dropped on the page: read as `assoc_hull.read` does, and shown as lines beside.

It never touches the hull of the page; the file lies in a folder that is gone afterwards.
"""

from __future__ import annotations

import base64
import re
import tempfile
from pathlib import Path
from typing import Any

from assoc_hull.edit.shapes import Shapes
from assoc_hull.errors import AssocHullError
from assoc_hull.hull.sources import read
from assoc_hull.model.tables import HullState
from assoc_hull.page.describe import describe_net
from assoc_hull.page.wire import Frame, FrameKind, pack

__all__ = ["MOST_BYTES", "read_dropped"]

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
