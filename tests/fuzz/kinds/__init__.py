"""All kinds of input; another is a module here, and a name in the tuple."""

from __future__ import annotations

from tests.fuzz.kind import Kind

from .edits import EDITS
from .hull_json import HULL_JSON
from .lines import DIGITISED, DRAWINGS
from .meshes import OBJ, STL
from .offsets import OFFSETS

__all__ = ["KINDS"]

KINDS: dict[str, Kind] = {
    kind.name: kind for kind in (OFFSETS, HULL_JSON, EDITS, DIGITISED, DRAWINGS, STL, OBJ)
}
