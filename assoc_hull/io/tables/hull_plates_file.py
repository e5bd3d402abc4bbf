"""Plates of a hull as a table (CSV) or a document (JSON).

Names and units are those of the Python objects; see `assoc_hull.io.tables.hull_plates_schema` for
the JSON Schema.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
>>> from assoc_hull.io.tables.hull_plates_file import hull_plates_csv
>>> from assoc_hull.surface.plates.hull_plates import hull_plates
>>> from assoc_hull.surface.plates.hull_seams import HullSeams
>>> x, z = np.mgrid[0:30:2j, 0:3:2j]
>>> side = SplineSurface.bezier(np.stack([x, 8.0 + 0.0 * x, z], axis=-1), "body")
>>> print(hull_plates_csv(hull_plates((side,), HullSeams(x=12.0))).splitlines()[0][:30])
name,range,area,length,breadth
"""

from __future__ import annotations

import json
import os
from typing import Any

from assoc_hull.arguments import instance
from assoc_hull.io.tables.plate_cells import plain, rows_csv
from assoc_hull.io.write_file import form_by_ending, write_whole
from assoc_hull.surface.plates.hull_plate import HullPlate
from assoc_hull.surface.plates.hull_plate_table import COLUMNS, HullPlates
from assoc_hull.surface.plates.hull_seams import AXES
from assoc_hull.surface.plates.suggestions import CAVEAT

__all__ = ["FORMAT", "SCHEMA", "hull_plates_csv", "hull_plates_document", "write_hull_plates"]

FORMAT, SCHEMA = "assoc-hull hull plates", 1

_ENDINGS = {".csv": "csv", ".json": "json"}


def write_hull_plates(
    plates: HullPlates, path: str | os.PathLike[str], form: str | None = None
) -> None:
    """Write plates of a hull as a table or a document, by the ending of the name.

    Parameters
    ----------
    plates : HullPlates
        The plates.
    path : path
        The file; what was there is replaced by the whole of it, or stays.
    form : {"csv", "json"} or None
        None: by the ending.

    Raises
    ------
    BadInputError
        Another form, or a file that cannot be written.
    """
    where = "in write_hull_plates"
    instance(plates, HullPlates, "plates", where)
    chosen = form_by_ending(path, form, tuple(_ENDINGS.values()), _ENDINGS, where)
    if chosen == "csv":
        text = hull_plates_csv(plates)
    else:
        text = json.dumps(hull_plates_document(plates), indent=1, allow_nan=False) + "\n"
    write_whole(path, text.encode())


def hull_plates_csv(plates: HullPlates) -> str:
    """Lay out plates as comma-separated text: a row of names, a row of units, a row a plate.

    Numbers have all digits; what a plate does not have is blank.
    """
    return rows_csv(COLUMNS, plates.table())


def hull_plates_document(plates: HullPlates) -> dict[str, Any]:
    """Give plates of a hull as JSON says it; null where a plate has no such number."""
    band, options = plates.regions.band, plates.options
    return {
        "format": FORMAT,
        "schema": SCHEMA,
        "units": {column.name: column.unit for column in COLUMNS},
        "seams": {
            **{axis: list(getattr(plates.seams, axis)) for axis in AXES},
            "inside": plates.seams.inside,
        },
        "search": {"zero": band.mode, "strain_tol": band.strain_tol, "k0": band.k0},
        "options": {
            "breadth": options.breadth, "sagitta_tol": options.sagitta_tol,
            "sagitta_length": options.sagitta_length, "share": options.share,
        },
        "fits": plates.fits,
        "patches": {"all": plates.regions.count, "computed": plates.computed},
        "plates": [
            _document(plate, row) for plate, row in zip(plates, plates.table(), strict=True)
        ],
        "notes": list(plates.notes),
        "caveat": CAVEAT,
    }  # fmt: skip


def _document(plate: HullPlate, row: dict[str, Any]) -> dict[str, Any]:
    """Give one plate: its row, its ranges, and the axis in space."""
    direction = None if plate.roll_direction is None else plate.roll_direction.tolist()
    found = {name: plain(value) for name, value in row.items()}
    ranges = {axis: [plain(end) for end in getattr(plate.range, axis)] for axis in AXES}
    return {
        **found, "ranges": ranges, "blocks": list(plate.blocks),
        "axes": plate.axes.tolist(), "roll_direction": direction, "notes": list(plate.notes),
    }  # fmt: skip
