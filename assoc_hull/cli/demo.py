"""The main job on a shipped hull: adopt, fair, see what followed and why, check, undo, draw.

First the edits a designer would ask for, with what to look at afterwards; then the command that
carries them out one by one and writes hull, pictures and words to a folder.
"""

from __future__ import annotations

import argparse
import contextlib
import time
from collections.abc import Callable, Iterator
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

import attrs
import numpy as np

from assoc_hull.cli.arguments import Commands, add_command, add_json
from assoc_hull.cli.hull_words import adoption_words, edit_words, hull_words, largest_gap
from assoc_hull.cli.output import emit, progress
from assoc_hull.edit.explain.causes import Why
from assoc_hull.edit.session import Edit
from assoc_hull.edit.step import EditReport
from assoc_hull.errors import BadInputError, MissingExtraError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.hull import Hull
from assoc_hull.hull.sources import create, examples
from assoc_hull.hull.sources import open as open_hull
from assoc_hull.model.objects import Curve, Point

if TYPE_CHECKING:
    from assoc_hull.plot.lines_plan.drawing import Drawing

__all__ = [
    "EDITS",
    "Demo",
    "DemoEdit",
    "DemoOutcome",
    "add_demo",
    "carry_out",
]

# --------------------------------------------------------------------------------------
# The edits of the demo: what a designer would ask, and what to look at afterwards.


@attrs.frozen
class DemoOutcome:
    """What came of one edit.

    Attributes
    ----------
    name : str
        Name of the edit.
    asked, reached : float, m
        How far a point was asked to go, and how far it went: along its freedom in a drag,
        along the hull's normal in a pull, the largest change of the line in a re-shape.
    report : EditReport
        The report of the edit.
    """

    name: str
    asked: float
    reached: float
    report: EditReport


@attrs.frozen
class DemoEdit:
    """One edit of the demo.

    Attributes
    ----------
    name : str
        Name of the edit.
    asked : float, m
        See `Outcome`.
    change : callable
        Makes the modifications.
    place : callable
        Gives the places (k, 3), m, by which the result is measured.
    along : callable
        Gives the unit directions (k, 3) in which it is measured, before the edit.
    """

    name: str
    asked: float
    change: Callable[[Hull, Edit], object]
    place: Callable[[Hull], FloatArray]
    along: Callable[[Hull], FloatArray]


def carry_out(hull: Hull, wish: DemoEdit) -> DemoOutcome:
    """Carry out one edit, and measure how far it came."""
    before, along = wish.place(hull), wish.along(hull)
    with hull.edit(wish.name) as edit:
        wish.change(hull, edit)
    assert edit.report is not None, "an edit without an error has a report"
    gone = ((wish.place(hull) - before) * along).sum(axis=1)
    reached = float(gone[int(np.argmax(np.abs(gone)))])
    return DemoOutcome(wish.name, wish.asked, reached, edit.report)


def _drag(address: str, distance: float) -> DemoEdit:
    """Drag a shared crossing along its one freedom: the two lines take it with them."""

    def change(hull: Hull, edit: Edit) -> None:
        point = hull.points[address]
        (axis,) = point.free
        edit.move(point, lead=False, **{axis: getattr(point, axis) + distance})

    def along(hull: Hull) -> FloatArray:
        return np.eye(3)[["xyz".index(axis) for axis in hull.points[address].free]]

    name = f"drag {address} by {1e3 * distance:g} mm"
    return DemoEdit(name, distance, change, _place_of(address), along)


def _pull(address: str, distance: float, radius: tuple[float, float]) -> DemoEdit:
    """Pull the hull at a point, fading along the length and along the girth."""

    def change(hull: Hull, edit: Edit) -> None:
        edit.pull(hull.points[address], d=distance, radius=radius)

    name = (
        f"pull at {address} by {1e3 * distance:g} mm, fading over {radius[0]:g} x {radius[1]:g} m"
    )
    return DemoEdit(
        name, distance, change, _place_of(address), lambda hull: _normal(hull.points[address])[None]
    )


def _reshape(
    line: str, span: tuple[float, float], largest: float, fade: tuple[float, float]
) -> DemoEdit:
    """Give a stretch of a waterline a new shape: its points at the sections, moved by a bell."""

    def change(hull: Hull, edit: Edit) -> None:
        edit.reshape(_curve(hull, line), _bulged(hull, line, span, largest), span=span, fade=fade)

    def along(hull: Hull) -> FloatArray:
        return np.array([[0.0, 1.0, 0.0]])

    name = f"re-shape {line} from x {span[0]:g} to {span[1]:g} m by up to {1e3 * largest:g} mm"
    return DemoEdit(name, largest, change, lambda hull: _stretch(hull, line, span), along)


def _place_of(address: str) -> Callable[[Hull], FloatArray]:
    return lambda hull: hull.points[address].position[None]


def _curve(hull: Hull, line: str) -> Curve:
    return hull.lines[line].curves[0]


def _stretch(hull: Hull, line: str, span: tuple[float, float]) -> FloatArray:
    """Give the points of a line at the sections that define it within a span, (k, 3), m."""
    found = [
        point.position
        for point in _curve(hull, line).defining
        if span[0] < point.x < span[1] and _generator(point) == "sections"
    ]
    return np.array(found)


def _generator(point: Point) -> str | None:
    parent = point.parent_curve
    return None if parent is None else parent.line.group.family


def _bulged(hull: Hull, line: str, span: tuple[float, float], largest: float) -> FloatArray:
    points = _stretch(hull, line, span)
    part = (points[:, 0] - span[0]) / (span[1] - span[0])
    bell = 1.0 - np.cos(2.0 * np.pi * part)
    points[:, 1] += largest * bell / bell.max()
    return points


def _normal(point: Point) -> FloatArray:
    """Give the outward unit normal of the hull at a crossing, (3,)."""
    friend = point.friend_point
    if friend is None:
        raise BadInputError(f"{point.name} is no crossing", "in a pull", "name a crossing")
    tangent = [
        each.container_curve.tangent(each.container_curve.closest(each.position)[0])
        for each in (point, friend)
    ]
    normal = np.cross(tangent[0], tangent[1])
    normal = normal / np.linalg.norm(normal)
    return np.asarray(normal if normal[1] > 0.0 else -normal)


EDITS = (
    _drag("WL 0.5 x ST 16", 0.005),
    _pull("WL 0.5 x ST 17", 0.020, (20.0, 8.0)),
    _drag("BTK 0.68 x ST 4", 0.010),
    _reshape("WL 0.75", (12.0, 36.0), 0.025, (20.0, 8.0)),
)
"""A waterline in the entrance, by hand and softly; a buttock in the run, the other direction;
a stretch of a waterline in the run."""


# --------------------------------------------------------------------------------------
# The main job on a shipped hull: adopt, fair, see what followed and why, check, undo, draw.

_CB = 0.70
_BUTTOCK, _FOLLOWER = 2, "WL 0.42"


def add_demo(commands: Commands) -> None:
    """Add ``demo``."""
    parser = add_command(
        commands, "demo", _demo,
        "assoc-hull demo --out demo",
    )  # fmt: skip
    parser.add_argument(
        "--out", metavar="DIR", type=Path, default=Path("demo"),
        help="folder for hulls and pictures (default: demo)",
    )  # fmt: skip
    add_json(parser)


def _demo(arguments: argparse.Namespace) -> int:
    folder: Path = arguments.out
    if folder.exists() and not folder.is_dir():
        raise BadInputError("this is a file", f"at {folder}", "give the name of a folder")
    folder.mkdir(parents=True, exist_ok=True)
    demo = Demo(folder, print if not arguments.json else lambda _: None)
    sound = demo.run()
    if arguments.json:
        emit(arguments, demo.facts, "")
    return 0 if sound else 1


class Demo:
    """The demo: it tells as it goes, and collects the same facts.

    Attributes
    ----------
    folder : Path
        Where hulls and pictures go.
    say : callable
        Takes what is told.
    facts : dict
        What was found; lengths in m, times in s.
    pictures : bool
        Whether there is a library to draw with.
    """

    def __init__(self, folder: Path, say: Callable[[str], object]) -> None:
        self.folder, self.say = folder, say
        self.facts: dict[str, Any] = {"seconds": {}, "files": []}
        self.pictures = find_spec("matplotlib") is not None

    def run(self) -> bool:
        """Run all phases; tells whether the hull was sound and came back as it was."""
        start = time.perf_counter()
        with self._phase("adopt"):
            hull = self._adopt()
        first, ship = hull.fingerprint, self._file("ship.hull")
        with self._phase("save"):
            hull.save(ship, replace=True)
        with self._phase("draw before"):
            before = self._lines_plan(hull, "before")
        with self._phase("edit"):
            self._edit(hull)
        with self._phase("check and verify"):
            sound = self._check(hull)
        with self._phase("draw after"):
            self._compare(before, self._lines_plan(hull, "after"))
        with self._phase("open again"):
            hull = self._again(hull, ship)
        with self._phase("undo"):
            same = self._undo(hull, first)
        hull.close()
        with self._phase("create"):
            self._create()
        self.facts["seconds"]["total"] = time.perf_counter() - start
        self._times()
        return sound and same

    @contextlib.contextmanager
    def _phase(self, name: str) -> Iterator[None]:
        start = time.perf_counter()
        yield
        self.facts["seconds"][name] = time.perf_counter() - start

    def _adopt(self) -> Hull:
        from assoc_hull.shipped.series60 import series60_adopted, todd_table

        with progress("adopting the offsets, cutting further lines"):
            hull = examples.series60(_CB)
            adoption = hull.adoption or series60_adopted(_CB)[1]
            table, offsets = todd_table(_CB)
        self.say("1. The table of offsets, adopted as a net")
        self.say(adoption_words(table, offsets, adoption))
        self.say("further lines cut from the net:\n" + hull_words(hull))
        rounding = dict(zip(map(str, table.z.tolist()), table.rounding.tolist(), strict=True))
        self.facts |= {"particulars": hull.particulars, "rounding": rounding, "adoption": adoption}
        return hull

    def _edit(self, hull: Hull) -> None:
        outcomes: list[DemoOutcome] = []
        for number, wish in enumerate(EDITS):
            outcome = carry_out(hull, wish)
            outcomes.append(outcome)
            self.say(f"\n{number + 2}. {outcome.name}")
            self.say(f"  asked        {1e3 * outcome.asked:.3f} mm")
            self.say(f"  reached      {1e3 * outcome.reached:.3f} mm")
            self.say(edit_words(hull, outcome.report))
            if number == _BUTTOCK:
                self._why(hull.why(_FOLLOWER))
        self.facts |= {"edits": outcomes, "largest_gap": largest_gap(hull)}

    def _why(self, cause: Why) -> None:
        self.say(f"  why {_FOLLOWER} followed, back to what was set:")
        self.say("\n".join(f"    {line}" for line in str(cause).splitlines()))
        self.facts["why"] = cause

    def _check(self, hull: Hull) -> bool:
        findings, differences = hull.check(), hull.verify()
        self.facts |= {"findings": findings, "differences": differences}
        self.say("\n6. The whole hull after all edits")
        self.say(
            f"  largest gap  {1e3 * self.facts['largest_gap']:.2f} mm at all watched crossings"
        )
        self.say(f"  check        {len(findings)} findings")
        self.say(f"  verify       {len(differences)} differences from what the definition gives")
        for each in (*findings, *differences):
            self.say(f"    {each}")
        return not findings and not differences

    def _lines_plan(self, hull: Hull, name: str) -> Drawing | None:
        """Draw the lines plan as PNG and PDF; give the lines as drawn, None without pictures."""
        if not self.pictures:
            return None
        from assoc_hull.plot import snapshot
        from assoc_hull.plot.lines_plan.plan import lines_plan
        from assoc_hull.plot.sheet.sheet_figure import save

        lines = snapshot(hull)
        with progress(f"drawing the lines {name}"):
            figure = lines_plan(lines)
            for ending in ("png", "pdf"):
                save(figure, self._file(f"lines-{name}.{ending}"))
        return lines

    def _compare(self, before: Drawing | None, after: Drawing | None) -> None:
        if before is None or after is None:
            return
        from assoc_hull.plot import before_after

        with progress("drawing the body plan"):
            before_after(before, after, self._file("body-plan-before-after.png"))

    def _again(self, hull: Hull, ship: Path) -> Hull:
        """Let go of the hull, and take it from its file as another process would."""
        last = hull.fingerprint
        hull.save(self._file("after.hull.json"))
        hull.close()
        hull = open_hull(ship)
        names = [report.name for report in hull.history]
        self.say(f"\n7. {ship.name}, closed and opened again")
        self.say(f"  every edit   {len(names)} steps, each on the disk before it counted as made")
        self.say("  fingerprint  " + ("the same" if hull.fingerprint == last else "NOT THE SAME"))
        self.facts["history"] = names
        return hull

    def _file(self, name: str) -> Path:
        path = self.folder / name
        self.facts["files"].append(path)
        return path

    def _undo(self, hull: Hull, first: str) -> bool:
        last = hull.fingerprint
        hull.undo(len(hull.history))
        back = hull.fingerprint
        hull.save(self._file("before.hull.json"))
        self.facts["fingerprint"] = {"start": first, "edited": last, "undone": back}
        self.say("\n8. All edits undone")
        for title, value in self.facts["fingerprint"].items():
            self.say(f"  {title:12} {value}")
        self.say("  the hull is as it was, to the last bit" if back == first else "  NOT THE SAME")
        return back == first

    def _create(self) -> None:
        """Create a ship from six numbers, in one call, and draw her lines."""
        with progress("creating a ship from six numbers"):
            hull = create(
                length=100.0, breadth=16.0, draught=6.5, depth=9.0, cb=0.70, lcb=0.0,
                type="general cargo",
            )  # fmt: skip
            found = hull.hydrostatics(estimate=False)
        self.say("\n9. A ship from six numbers, without a parent")
        ship = hull.particulars
        lcb = found.lcb - 0.5 * ship.length
        self.say(
            f"  {ship.name}: {ship.length:g} x {ship.breadth:g} x {ship.draught:g} m, "
            f"CB {found.cb:.6f}, LCB {lcb:.4f} m from midship, {len(hull.lines)} lines"
        )
        self.facts["created"] = {"particulars": ship, "cb": found.cb, "lcb": lcb}
        if self.pictures:
            from assoc_hull.plot import snapshot
            from assoc_hull.plot.lines_plan.plan import lines_plan
            from assoc_hull.plot.sheet.sheet_figure import save

            save(lines_plan(snapshot(hull)), self._file("lines-created.png"))

    def _times(self) -> None:
        if not self.pictures:
            self.say(f"\nno pictures: {MissingExtraError('matplotlib', 'plot')}")
        self.say("\nwritten: " + ", ".join(str(path) for path in self.facts["files"]))
        times = (f"{name} {value:.2f} s" for name, value in self.facts["seconds"].items())
        self.say("time: " + ", ".join(times))
