"""Wetted surfaces of ships beside fine triangulations that share nothing with hydrostatics.

    python -m tests.wetted_surfaces [NAME ...]

Of a ship that is a net it is the closed mesh on her lines, with 16 points to an edge: it has cells
of its own, and none of the strips of hydrostatics. Of a formula it is the formula on a grid, also
where the ship is read from a file: the frigate from her STL, the DTC against the mesh itself.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

import attrs

import assoc_hull as ah
from tests.foreign_hulls import CORPUS, data_folder
from tests.raked_stern import raked_ship, shell
from tests.shell_area import triangles_below

__all__ = ["FEW", "NEAR", "SHIPS", "Wetted", "wetted_of_hull"]

NEAR = 3e-3
"""So near (a part) S has to come to a triangulation; and within its own estimate."""

_POINTS = 16


@attrs.frozen
class Wetted:
    """S of a ship at her design draught, m2: published, triangulated, and how far it may be off.

    Attributes
    ----------
    found, truth, stated : float, m2
        By hydrostatics, by triangles, and the error that hydrostatics states.
    transom : float, m2
        Immersed transom, which S does not count.
    """

    found: float
    truth: float
    stated: float
    transom: float

    @property
    def off(self) -> float:
        """How far S is off, a part of it."""
        return self.found / self.truth - 1.0

    @property
    def right(self) -> bool:
        """Whether it is near the triangulation, and within its own estimate."""
        return abs(self.off) < NEAR and abs(self.found - self.truth) <= self.stated


def _published(hull: ah.Hull, draught: float, truth: float) -> Wetted:
    found = hull.hydrostatics(draught=draught)
    stated = found.error["wetted_surface"] or 0.0
    return Wetted(found.wetted_surface, truth, stated, found.transom_area)


def wetted_of_hull(hull: ah.Hull) -> Wetted:
    """Measure a net by hydrostatics and by its closed mesh."""
    draught, mesh = hull.particulars.draught, hull.mesh(points=_POINTS)
    truth = triangles_below(mesh.xyz[mesh.triangle[mesh.group == 0]], draught)
    return _published(hull, draught, truth)


def wetted_of_file(name: str) -> Wetted:
    """Read a file of the corpus with its right options, and measure it beside its truth."""
    case = next(case for case in CORPUS if case.name == name)
    with tempfile.TemporaryDirectory() as folder:
        hull = ah.read(case.write(Path(folder)), **case.right)
    draught = hull.particulars.draught
    return _published(hull, draught, float(case.truth().at(draught).wetted))


def wetted_of_raked(rake: float, across: float | None) -> Wetted:
    """Measure the ship with a flat run and a raked transom beside her formula."""
    return _published(raked_ship(rake, across=across), 5.2, shell(rake, 5.2))


def _of(name: str, *values: float) -> Callable[[], Wetted]:
    return lambda: wetted_of_hull(getattr(ah.examples, name)(*values))


SHIPS: dict[str, Callable[[], Wetted]] = {
    "Wigley": _of("wigley"),
    "Series 60, CB .60": _of("series60", 0.60),
    "Series 60, CB .70": _of("series60", 0.70),
    "bulk carrier 207k": _of("bulk_carrier_207k"),
    "bulk carrier 180 m": _of("bulk_carrier_180m"),
    "container ship": _of("container_ship_225m"),
    "plain ship": _of("plain_ship"),
    "coaster": _of("seaking_ship"),
    "ferry": _of("sfolds_ship"),
    "supply ship": _of("prelikon_ship"),
    "flat run, transom raked aft": lambda: wetted_of_raked(0.3, -1.0),
    "flat run, raked forward": lambda: wetted_of_raked(-0.4, 1.0),
    "frigate, from her STL": lambda: wetted_of_file("frigate"),
    "DTC, from her STL": lambda: wetted_of_file("dtc_full"),
}
"""Each is measured when it is called."""

FEW = ("Wigley", "container ship")
"""Those of the ordinary suite."""


def main(arguments: list[str] | None = None) -> int:
    """Print the table; 1 if a ship is not right."""
    parser = argparse.ArgumentParser(prog="python -m tests.wetted_surfaces")
    parser.add_argument("name", nargs="*", help="of the table; all of them if none is given")
    names = parser.parse_args(arguments).name or list(SHIPS)
    print("| ship | S, m2 | by triangles, m2 | off, % | stated, % | transom, m2 | |")
    print("|---|---|---|---|---|---|---|")
    wrong = 0
    for name in names:
        if "DTC" in name and not data_folder().is_dir():
            print(f"| {name} | no data | | | | | |")
            continue
        one = SHIPS[name]()
        wrong += not one.right
        word = "right" if one.right else "WRONG"
        print(
            f"| {name} | {one.found:.1f} | {one.truth:.1f} | {100.0 * one.off:+.4f} | "
            f"{100.0 * one.stated / one.truth:.4f} | {one.transom:.2f} | {word} |",
            flush=True,
        )
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
