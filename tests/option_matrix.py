"""Every option of an import on every kind of file: it acts, or is refused with words.

    python -m tests.option_matrix [KIND ...]

Files are those of a small Wigley hull. An option acts if another hull comes in, or if the report
tells it; it is silently ignored if nothing differs.
"""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

import assoc_hull as ah
from assoc_hull.geometry.surfaces.triangles import grid_triangles
from assoc_hull.shipped.wigley import wigley_half_breadth
from tests.body_plans import body_plan
from tests.foreign_hulls import as_of_others, write_lines
from tests.meshes import write

__all__ = ["CHEAP", "KINDS", "OPTIONS", "fate", "read_plainly"]

Options = Mapping[str, Any]


@cache
def _hull() -> ah.Hull:
    return ah.examples.wigley(stations=9, waterlines=6)


def _export(name: str, form: str | None = None) -> Callable[[Path], Path]:
    def write_it(folder: Path) -> Path:
        path = folder / name
        _hull().export(path, form)
        return as_of_others(path) if path.suffix in (".dxf", ".igs") else path

    return write_it


def _own(folder: Path) -> Path:
    path = folder / "own.dxf"
    _hull().export(path)
    return path


def _surface(name: str) -> Callable[[Path], Path]:
    def write_it(folder: Path) -> Path:
        _hull().surface().write(folder / name)
        return folder / name

    return write_it


def _lines(folder: Path) -> Path:
    return write_lines(_hull(), folder / "lines.csv")


def _numbered(folder: Path) -> Path:
    """A table of which the stations are numbers."""
    x, z = np.linspace(0.0, 100.0, 11), np.linspace(0.0, 6.25, 6)
    rows = ["station," + ",".join(f"wl_{each:g}" for each in z)]
    for i, place in enumerate(x.tolist()):
        y = wigley_half_breadth(np.full(6, place), z, 100.0, 10.0, 6.25)
        rows.append(f"{i}," + ",".join(f"{each:.4f}" for each in y))
    path = folder / "numbered.csv"
    path.write_text("# station 0 = AP\n" + "\n".join(rows) + "\n")
    return path


def _mesh(folder: Path) -> Path:
    """The port half, finely enough that lines are smooth."""
    x, z = np.meshgrid(np.linspace(0, 100, 161), np.linspace(0, 6.25, 61), indexing="ij")
    side = grid_triangles(np.stack([x, wigley_half_breadth(x, z, 100.0, 10.0, 6.25), z], axis=2))
    return write(side, folder / "mesh.stl")


def _plan(folder: Path) -> Path:
    """A body plan at 1:50 in mm: stations of eight spacings, one left out: its ends differ."""
    stations = [(f"{i}", 12.5 * i) for i in (1, 3, 4, 5, 6, 7)]
    path = folder / "plan.dxf"
    path.write_text(body_plan(_hull(), stations, scale=50.0, unit="mm"), encoding="utf-8")
    return path


_ALL: Options = {"length": 100.0}
_CUTS: Options = {"stations": 15, "waterlines": 8, "buttocks": 4}

KINDS: dict[str, tuple[Callable[[Path], Path], Options]] = {
    "table": (_export("table.csv"), {}),
    "numbered table": (_numbered, _ALL),
    "workbook": (_export("table.xlsx"), {}),
    "digitised text": (_lines, {}),
    "DXF": (_export("lines.dxf"), {}),
    "own DXF": (_own, {}),
    "IGES curves": (_export("curves.igs", "iges-lines"), {}),
    "BRITFAIR": (_export("sections.bri", "britfair"), {}),
    "GHS": (_export("sections.gf", "gf"), {}),
    "DELFTship": (_export("sections.txt", "delftship"), {}),
    "DELFTship offsets": (_export("offsets.txt", "delftship-offsets"), {}),
    "body plan": (_plan, {"scale": 50.0, "length": 100.0, "station_spacings": 8}),
    "3DM": (_export("curves.3dm"), {}),
    "STL": (_mesh, _CUTS),
    "IGES surfaces": (_surface("surface.igs"), _CUTS),
    "STEP": (_surface("surface.step"), _CUTS),
}
"""How each kind of file is written, and with what it is read plainly."""

CHEAP = ("numbered table", "DELFTship")
"""Kinds whose files come in fastest, one of each way in."""

OPTIONS: dict[str, Options] = {
    "length": {"length": 98.0}, "breadth": {"breadth": 9.9}, "draught": {"draught": 5.0},
    "depth": {"depth": 7.5}, "ap": {"ap": "1 m"}, "fp": {"fp": "99 m"}, "base": {"base": "0.2 m"},
    "waterline": {"waterline": "5 m"}, "origin": {"origin": "midship"},
    "draught_aft": {"draught_aft": 5.2, "draught_fwd": 4.8}, "deck": {"deck": "closed"},
    "unit": {"unit": "cm"}, "station_zero": {"station_zero": "fp"},
    "station_spacings": {"station_spacings": 9}, "frame_spacing": {"frame_spacing": 5.0},
    "centre": {"centre": "0.5 m"}, "deck_edge": {"deck_edge": "WL 1.2"}, "scale": {"scale": 40.0},
    "axes": {"axes": "-x+y+z"}, "stations": {"stations": 7}, "waterlines": {"waterlines": 5},
    "buttocks": {"buttocks": 3}, "tolerance": {"tolerance": 0.2}, "join": {"join": 0.5},
}  # fmt: skip
"""A value for each option that the plain files do not have."""

_STATE: dict[Path, ah.Hull] = {}


def read_plainly(kind: str, path: Path) -> ah.Hull:
    """Read a file with what its kind needs, once."""
    if path not in _STATE:
        _STATE[path] = ah.read(path, accept=True, **KINDS[kind][1])
    return _STATE[path]


def fate(kind: str, path: Path, option: str) -> str:
    """Tell what became of an option: "acts", "told: ...", "refused: ..." or "IGNORED"."""
    plain = read_plainly(kind, path)
    given = {**KINDS[kind][1], **OPTIONS[option]}
    if option == "deck":  # files of ours say that this one is closed
        given["deck"] = {"open": "closed", "closed": "open"}[plain.particulars.deck]
    if given.get("frame_spacing"):
        given.pop("station_spacings", None)
    try:
        hull = ah.read(path, accept=True, **given)
    except ah.errors.AssocHullError as error:
        return f"refused: {error}"
    if (hull.fingerprint, hull.particulars) != (plain.fingerprint, plain.particulars):
        return "acts"
    assert hull.adoption is not None
    assert plain.adoption is not None
    more = [note for note in hull.adoption.notes if note not in plain.adoption.notes]
    return f"told: {more[0]}" if more else "IGNORED"


def main(kinds: list[str] | None = None) -> int:
    """Print a row a kind and option; 1 if any is ignored."""
    ignored = 0
    with tempfile.TemporaryDirectory() as folder:
        for kind in kinds or list(KINDS):
            path = KINDS[kind][0](Path(folder))
            words = {option: fate(kind, path, option) for option in OPTIONS}
            acts = [option for option, word in words.items() if word == "acts"]
            print(f"{kind}: {', '.join(acts)} act")
            rest = [(option, word) for option, word in words.items() if word != "acts"]
            for option, word in rest:
                print(f"    {option}: {word[:150]}", flush=True)
            ignored += sum(word == "IGNORED" for word in words.values())
    print(f"{ignored} ignored")
    return 1 if ignored else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
