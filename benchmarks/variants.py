"""Variants of a parent beside what a user would take instead: ratios of one run.

A row of a study (a certified map, lines made again, checks, exact hydrostatics) stands beside the
same variant made by an edit and measured as a hull that was never seen, which was the way of the
release before, and beside a free-form deformation of 50,000 points of a mesh with the volume of
that mesh. The deformation misses what is asked for; by how much is told too.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

import assoc_hull as ah
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.hull.sources import examples
from assoc_hull.model.program.engine import wait_for_engine
from assoc_hull.model.tables import copy_state
from assoc_hull.study.design import StudyDesign
from assoc_hull.study.prepared_parent import StudyParent
from assoc_hull.study.run import StudyRun, make_row
from benchmarks.clock import Figure, side_by_side
from benchmarks.ffd import SIDE, Lattice

__all__ = ["figures"]

_HULLS: dict[str, Callable[[], ah.Hull]] = {
    "carrier": examples.bulk_carrier_207k,
    "Series 60 .70": examples.series60,
    "Wigley": examples.wigley,
}
_POINTS = 50_000
_MORE = 1.01
"""Times the breadth, and the draught, of the parent."""


def figures(quick: bool) -> list[Figure]:
    """Measure a row of a study of breadth and draught, on three hulls."""
    wait_for_engine()
    rounds = 5 if quick else 15
    found = list[Figure]()
    for name, make in _HULLS.items():
        hull = make()
        run = StudyRun.of(copy_state(hull.state), _design(hull))
        mesh = _Deformed(hull)
        times = side_by_side(
            {"row": lambda run=run: make_row(run, 0), "edit": lambda run=run: _edited(run.ground),
             "ffd": mesh.variant},
            rounds,
        )  # fmt: skip
        found += [
            Figure(f"{name}: a row of a study", 1e3 * times["row"], "ms"),
            Figure(f"{name}: rows a second and core", 1.0 / times["row"], "1/s", 500.0),
            Figure(f"{name}: the same by an edit / by the study", times["edit"] / times["row"]),
            Figure(f"{name}: FFD and mesh / study", times["ffd"] / times["row"], "x", 15.0),
            Figure(f"{name}: breadth that the FFD misses", mesh.missed(), "m"),
            Figure(f"{name}: vary of both", 1e3 * _vary(hull, rounds), "ms", 25.0, "most"),
        ]
    return found


def _design(hull: ah.Hull) -> StudyDesign:
    size = hull.particulars
    return StudyDesign.of(
        set={"breadth": [_MORE * size.breadth], "draught": [_MORE * size.draught]}
    )


def _edited(ground: StudyParent) -> FloatArray:
    """Make the variant by an edit of a copy, and measure it as a hull that was never seen."""
    values = _MORE * ground.present
    return ground.outputs.values(ground.document(values, "variant").state)


def _vary(hull: ah.Hull, rounds: int) -> float:
    size = hull.particulars
    asked = {"breadth": _MORE * size.breadth, "draught": _MORE * size.draught}
    return side_by_side({"vary": lambda: hull.vary(set=asked)}, max(rounds // 3, 2))["vary"]


class _Deformed:
    """A mesh of a hull in a lattice, the broadest control points of which move outward."""

    def __init__(self, hull: ah.Hull) -> None:
        mesh = hull.mesh()
        fine = mesh.xyz[mesh.triangle]
        while len(fine) < 2 * _POINTS:  # each triangle in four
            a, b, c = fine[:, 0], fine[:, 1], fine[:, 2]
            ab, bc, ca = 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)
            parts = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
            fine = np.concatenate([np.stack(each, axis=1) for each in parts])
        flat, self.corner = np.unique(fine.reshape(-1, 3), axis=0, return_inverse=True)
        self.xyz = flat
        box = np.array([flat.min(axis=0) - 1.0, flat.max(axis=0) + 1.0])
        self.weights = Lattice(box).weights(flat)
        moves = np.zeros((SIDE, SIDE, SIDE, 3))
        moves[:, -1, :, 1] = 0.5 * (_MORE - 1.0) * hull.particulars.breadth
        moves[:, 0, :, 1] = -moves[:, -1, :, 1]
        self.moves, self.asked = moves.reshape(-1, 3), _MORE * hull.particulars.breadth
        self.places = flat

    def variant(self) -> float:
        """Move all points, and take the volume of the mesh."""
        self.places = self.xyz + self.weights @ self.moves
        a, b, c = self.places[self.corner].reshape(-1, 3, 3).transpose(1, 0, 2)
        return float(np.einsum("ni,ni->", a, np.cross(b, c)) / 6.0)

    def missed(self) -> float:
        """Give by how much the breadth that was asked for is missed, m."""
        return abs(float(np.ptp(self.places[:, 1])) - self.asked)
