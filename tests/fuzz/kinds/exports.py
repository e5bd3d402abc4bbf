"""Files as other programs take them: BRITFAIR, DELFTship, GHS, DXF, tables, Rhino."""

from __future__ import annotations

import functools
import io
import tempfile
import zipfile
import zlib
from pathlib import Path
from random import Random

from assoc_hull.io.export.write import export_hull
from tests.fuzz.kind import TARGET, Kind
from tests.fuzz.kinds.hulls import whole_hull
from tests.fuzz.text import change_bytes, change_text

__all__ = ["BRITFAIR", "DELFTSHIP", "DXF", "GF", "RHINO", "TABLE", "XLSX"]

OPTIONS: tuple[list[str], ...] = (
    [], ["--tolerance", "0.1"], ["--draught", "5"], ["--unit", "m"], ["--accept"], ["--strict"],
    ["--deck", "closed", "--json"],
)  # fmt: skip
TABLE_OPTIONS: tuple[list[str], ...] = (
    [], ["--length", "100"], ["--station-zero", "ap"], ["--accept"], ["--unit", "mm", "--accept"],
)  # fmt: skip


@functools.cache
def exported(name: str, form: str) -> bytes:
    """A small hull in a form."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / name
        export_hull(whole_hull().state, path, form)
        return path.read_bytes()


def _text(rng: Random, name: str, *forms: str) -> bytes:
    return change_text(rng, exported(name, rng.choice(forms)).decode("latin-1"))


def make_britfair(rng: Random) -> bytes:
    """A changed BRITFAIR text."""
    return _text(rng, "ship.bri", "britfair")


def make_delftship(rng: Random) -> bytes:
    """A changed text for DELFTship, of curves or of offsets."""
    return _text(rng, "ship.txt", "delftship", "delftship-offsets")


def make_gf(rng: Random) -> bytes:
    """A changed geometry file."""
    return _text(rng, "ship.gf", "gf")


def make_dxf(rng: Random) -> bytes:
    """A drawing whose entities are changed: lines in their places, or a plan of three views."""
    text = exported("lines.dxf", rng.choice(("dxf", "dxf-plan"))).decode("ascii")
    head, mark, rest = text.partition("ENTITIES\n")
    entities, end, tail = rest.partition("ENDSEC\n")
    changed = change_text(rng, entities).decode("utf-8", "replace")
    return f"{head}{mark}{changed}{end}{tail}".encode("utf-8", "replace")


def make_xlsx(rng: Random) -> bytes:
    """A workbook of which one part is changed, or its bytes."""
    data = exported("ship.xlsx", "xlsx")
    if rng.random() < 0.2:
        return change_bytes(rng, data)
    parts = {each: zipfile.ZipFile(io.BytesIO(data)).read(each) for each in _names(data)}
    sheets = [name for name in parts if "sheet" in name or "shared" in name]
    name = rng.choice(sheets if rng.random() < 0.8 else list(parts))
    # A part is one long line: a line per element is what the changes are made for.
    parts[name] = change_text(rng, parts[name].decode("utf-8").replace("><", ">\n<"))
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w") as book:
        for each, content in parts.items():
            book.writestr(zipfile.ZipInfo(each), content)
    return out.getvalue()


def make_table(rng: Random) -> bytes:
    """A changed table of offsets of a whole hull."""
    return _text(rng, "ship.csv", "csv")


def make_rhino(rng: Random) -> bytes:
    """A file of Rhino whose bytes are changed: often only its first part, where curves lie."""
    data = exported("ship.3dm", "3dm")
    if rng.random() < 0.5:
        return change_bytes(rng, data)
    found = bytearray(data)
    for _ in range(rng.choice((1, 3, 30, 300))):
        found[rng.randrange(32, len(found))] = rng.randrange(256)
    return bytes(found)


def _names(data: bytes) -> list[str]:
    return zipfile.ZipFile(io.BytesIO(data)).namelist()


def _import(name: str, data: bytes, options: tuple[list[str], ...]) -> list[list[str]]:
    return [["import", name, "-o", TARGET, *options[zlib.crc32(data) % len(options)]]]


def of_britfair(data: bytes) -> list[list[str]]:
    """Import it."""
    return _import("ship.bri", data, OPTIONS)


def of_delftship(data: bytes) -> list[list[str]]:
    """Import it."""
    return _import("ship.txt", data, OPTIONS)


def of_gf(data: bytes) -> list[list[str]]:
    """Import it."""
    return _import("ship.gf", data, OPTIONS)


def of_dxf(data: bytes) -> list[list[str]]:
    """Import it."""
    return _import("lines.dxf", data, OPTIONS)


def of_table(data: bytes) -> list[list[str]]:
    """Import it."""
    return _import("ship.csv", data, TABLE_OPTIONS)


def of_rhino(data: bytes) -> list[list[str]]:
    """Import it."""
    return _import("ship.3dm", data, OPTIONS)


def of_xlsx(data: bytes) -> list[list[str]]:
    """Import it."""
    return _import("ship.xlsx", data, TABLE_OPTIONS)


BRITFAIR = Kind("britfair", "ship.bri", make_britfair, of_britfair, weight=2)
DELFTSHIP = Kind("delftship", "ship.txt", make_delftship, of_delftship, weight=2)
GF = Kind("gf", "ship.gf", make_gf, of_gf, weight=2)
DXF = Kind("dxf-lines", "lines.dxf", make_dxf, of_dxf, weight=2)
RHINO = Kind("rhino", "ship.3dm", make_rhino, of_rhino, weight=1)
TABLE = Kind("table", "ship.csv", make_table, of_table, weight=2)
XLSX = Kind("xlsx", "ship.xlsx", make_xlsx, of_xlsx, weight=2)
