"""A stern made unfair on purpose, and faired: the carrier of 207,000 t, whose shape is a formula.

``python -m benchmarks.unfair_stern [--pictures FOLDER]`` puts a uniform noise of 30 mm along the
freedom of all points from ST 0 to ST 3, and takes it out again with the noise stated and estimated;
then makes one smooth dent of 40 mm over four waterlines and three stations, which fairing by noise
leaves. It goes when all four are led through their old places, and not when one is left out.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import Literal

import attrs
import numpy as np

import assoc_hull as ah
from assoc_hull.edit.displacement_field import SolvedField, quintic_fade
from assoc_hull.edit.field_moves import FieldMoves
from assoc_hull.edit.net_battens import net_battens
from assoc_hull.edit.recording import Settings
from assoc_hull.edit.transaction import Transaction
from assoc_hull.geometry.curves import FloatArray, IntArray
from benchmarks.fair_edits import sign_changes
from tests.noisy_nets import uniform_noise

__all__ = ["Stern", "main"]

_NOISE, _DENT = 0.03, 0.04
_AFT, _FORE = 0.0, 45.0
"""m: ST 0 and ST 3."""

_DRAWN, _TOOTH = (-5.5, 60.0), 0.05
"""m: what pictures show; 1/m: the curvature that a tooth of 10 mm stands for."""

_CLEAR = 1.0
"""m: points nearer to the centre plane get no noise, lest lines pass through it."""

_MIDDLE, _LINES, _SPAN = "WL 11 x ST 1.5", ("WL 9", "WL 10", "WL 11", "WL 12"), (5.0, 42.0)
_REACH = (15.0, 3.0)
"""Of the dent along the length and the girth, m."""


@attrs.frozen(eq=False)
class Stern:
    """The carrier, and where her points lay before."""

    hull: ah.Hull
    before: FloatArray
    normal: FloatArray
    rows: IntArray
    signs: dict[str, tuple[int, int]]

    @classmethod
    def of(cls, hull: ah.Hull) -> Stern:
        """Take her as she is."""
        state, problem = hull.document.state, net_battens(hull.document.state)
        place = state.rows.xyz[problem.rows]
        inside = (place[:, 0] >= _AFT) & (place[:, 0] <= _FORE)
        unit = problem.moves / (problem.moves**2).sum(axis=1, keepdims=True)
        return cls(
            hull, state.rows.xyz.data.copy(), unit[inside], problem.rows[inside],
            sign_changes(state),
        )  # fmt: skip

    def error(self) -> FloatArray:
        """How far the points of the stern lie from the formula, normal to the hull, m."""
        step = self.hull.document.state.rows.xyz[self.rows] - self.before[self.rows]
        found: FloatArray = (step * self.normal).sum(axis=1)
        return found

    def tell(self, title: str) -> str:
        """Say error, sign changes too many at lobes of .2 and 1 degree, volume and LCB."""
        error, now = self.error(), sign_changes(self.hull.document.state)
        more = [
            sum(max(now[key][lobe] - was[lobe], 0) for key, was in self.signs.items() if key in now)
            for lobe in range(2)
        ]
        hydrostatics = self.hull.hydrostatics()
        return (
            f"{title:45} error rms {1e3 * np.sqrt((error**2).mean()):6.2f} mm, largest "
            f"{1e3 * np.abs(error).max():6.2f}; sign changes too many {more[0]:3d} and "
            f"{more[1]:3d}; volume {hydrostatics.volume:.2f} m3, LCB {hydrostatics.lcb:.4f} m"
        )


def _displace(hull: ah.Hull, name: str, amount: FloatArray) -> None:
    """Displace the points that may move by amounts along the normal, (k,), m."""
    problem = net_battens(hull.document.state)
    some = np.flatnonzero(amount)
    with Transaction(hull.document, name, Settings(refuse_gaps=False)) as edit:
        field = SolvedField(problem.rows[some], problem.moves[some] * amount[some][:, None])
        edit.pending.ask(FieldMoves).fields.append(field)


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the figures, and draw the stern."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.unfair_stern")
    parser.add_argument("--pictures", type=Path)
    folder = parser.parse_args(arguments).pictures
    hull = ah.examples.bulk_carrier_207k()
    stern, state = Stern.of(hull), hull.document.state
    problem = net_battens(state)
    place = state.rows.xyz[problem.rows]
    print(stern.tell("as the formula has it"))
    _draw(hull, folder, "clean")

    inside = (place[:, 0] >= _AFT) & (place[:, 0] <= _FORE) & (place[:, 1] > _CLEAR)
    noise = uniform_noise(len(problem.rows), _NOISE) * problem.freedom * inside
    _displace(hull, "noise", noise)
    print(stern.tell("30 mm of noise"))
    _draw(hull, folder, "noisy")
    middle = 0.5 * (_AFT + _FORE)
    noises: dict[str, float | Literal["auto"]] = {
        "stated": _NOISE / float(np.sqrt(3.0)), "auto": "auto",
    }  # fmt: skip
    for how, stated in noises.items():
        report = hull.fair(
            noise=stated, at=(middle, 10.0, 10.0), radius=(2.0 * (_FORE - _AFT), 60.0)
        )
        print(stern.tell(f"faired, noise {how} ({1e3 * report.found.noise:.1f} mm)"))
        _draw(hull, folder, f"faired_{how}")
        hull.undo()
    hull.undo()

    step = place - np.array(hull.points[_MIDDLE].position)
    girth = np.sqrt(step[:, 1] ** 2 + step[:, 2] ** 2)
    dent = -_DENT * quintic_fade(step[:, 0] / _REACH[0]) * quintic_fade(girth / _REACH[1])
    _displace(hull, "dent", dent)
    print(stern.tell("one smooth dent of 40 mm"))
    _draw(hull, folder, "dent")
    report = hull.fair(noise="auto")
    print(stern.tell("faired by noise: it stays"))
    print("  " + str(report).splitlines()[-1])
    hull.undo()
    for names in (_LINES[2:3], _LINES):
        with hull.edit("led back") as edit:
            for name in names:
                line = hull.lines[name].curves[0]
                rows = state.curves.rows[line.number]
                old = stern.before[rows]
                moved = np.abs(state.rows.xyz[rows] - old).max(axis=1) > 1e-3
                edit.reshape(line, old[moved], span=_SPAN, fair=True)
        print(stern.tell(f"{', '.join(names)} led through old places"))
        assert edit.report is not None, "it was carried out"
        print("  " + "; ".join(edit.report.notes))
        if len(names) == 1:
            hull.undo()
    _draw(hull, folder, "led")
    return 0


def _draw(hull: ah.Hull, folder: Path | None, name: str) -> None:
    """Draw the stern, at scales that are the same in all pictures."""
    if folder is not None:
        folder.mkdir(parents=True, exist_ok=True)
        lines = [f"WL {each}" for each in (5, 7, 9, 11)]
        combs = folder / f"{name}_combs.png"
        hull.plot.curvature_combs(lines, combs, scale=_TOOTH, x=_DRAWN)
        hull.plot.lines_plan(folder / f"{name}_plan.png", heat="residual", x=_DRAWN)


if __name__ == "__main__":
    raise SystemExit(main())
