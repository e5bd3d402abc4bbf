"""All kinds of input; another is a module in the folder, and a name in the tuple."""

from __future__ import annotations

from tests.fuzz.kind import Kind
from tests.fuzz.kinds.cad_hulls import IGES_HULL, STEP_HULL
from tests.fuzz.kinds.command_lines import COMMAND_LINES
from tests.fuzz.kinds.curves import CURVE
from tests.fuzz.kinds.definitions import DEFINITIONS
from tests.fuzz.kinds.edits import EDITS
from tests.fuzz.kinds.exports import BRITFAIR, DELFTSHIP, DXF, GF, RHINO, TABLE, XLSX
from tests.fuzz.kinds.hull_file import HULL_FILE
from tests.fuzz.kinds.hull_json import HULL_JSON
from tests.fuzz.kinds.lines import DIGITISED, DRAWINGS
from tests.fuzz.kinds.meshes import GLB, OBJ, PLY, STL
from tests.fuzz.kinds.offsets import OFFSETS
from tests.fuzz.kinds.surfaces import SURFACES

__all__ = ["KINDS"]

_TABLES = (OFFSETS, XLSX, TABLE)
_LINES = (DIGITISED, DRAWINGS, BRITFAIR, DELFTSHIP, DXF, GF)
_MESHES = (STL, OBJ, PLY, GLB)
_REST = (DEFINITIONS, *_LINES, *_MESHES, SURFACES, IGES_HULL, STEP_HULL, RHINO, COMMAND_LINES)

KINDS: dict[str, Kind] = {
    kind.name: kind for kind in (*_TABLES, HULL_FILE, HULL_JSON, EDITS, CURVE, *_REST)
}
