"""Foreign files of hulls whose truth is known, and what the door makes of them.

    python -m tests.foreign_hulls [--only NAME] [--quick] [--details]

Each `Foreign` writes one real file: published data, or a shipped or formula hull exported and then
moved, scaled or damaged as files of other programs are. It is imported with nothing said, with the
right options, and with one wrong option among the right ones. A `Cell` says what came of it, by
comparison with the hull that the file was cut from.

Places are compared by landmarks, not by coordinates: the ends of the hull (or of its sections,
where a form holds no more), and its highest point. So a hull whose origin lies elsewhere is not
wrong for that, but one that floats at another place on the hull is.
"""

from __future__ import annotations

import argparse
import contextlib
import inspect
import os
import re
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache, partial
from pathlib import Path
from typing import Any

import attrs
import ezdxf.filemanagement
import numpy as np
import openpyxl
from scipy.interpolate import CubicSpline
from scipy.optimize import brentq

import assoc_hull as ah
from assoc_hull.errors import AssocHullError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.geometry.surfaces.triangles import Triangles, grid_triangles, merge_vertices
from assoc_hull.io.iges.write import iges_text
from assoc_hull.io.lines.line_points import lines_as_points
from assoc_hull.io.lines.own_lines import MARK
from assoc_hull.io.mesh.read import read_triangles
from assoc_hull.io.surfaces.surface_file import read_surface_file
from assoc_hull.model.tables import copy_state
from tests.meshes import mirrored, write

__all__ = ["CORPUS", "QUICK", "Cell", "Foreign", "Row", "markdown", "row_of", "try_options"]

V_OFF, LCB_OFF, S_OFF = 5e-4, 5e-4, 5e-3
"""What a right hull may be off: V, LCB as a part of Lpp, S."""

FRAME_OFF = 2e-3
"""Particulars and the draught may be off by this part before they count as other ones."""

Options = Mapping[str, Any]

# --------------------------------------------------------------------------------------
# Truth.


@attrs.frozen
class Floating:
    """Volume (m3), LCB (m, forward of the truth's AP) and wetted surface (m2) at a draught."""

    volume: float
    lcb: float
    wetted: float


@attrs.frozen(eq=False)
class Truth:
    """A hull as it was before it became a file.

    Attributes
    ----------
    at : callable
        Gives `Floating` at a draught above the true base line.
    length, breadth, draught : float, m
        True particulars; x = 0 at the true AP.
    ends : (float, float), m
        Aftmost and foremost x of what the file holds.
    top : float, m
        Highest z of what the file holds; nan where the file does not tell it.
    published : str
        Values printed by others, to be shown beside.
    """

    at: Callable[[float], Floating]
    length: float
    breadth: float
    draught: float
    ends: tuple[float, float]
    top: float
    published: str = ""


def at_scale(truth: Truth, factor: float) -> Truth:
    """Give the truth of a model of a hull, every length times a factor."""

    def at(draught: float) -> Floating:
        real = truth.at(draught / factor)
        return Floating(factor**3 * real.volume, factor * real.lcb, factor**2 * real.wetted)

    aft, fore = truth.ends
    return Truth(
        at, factor * truth.length, factor * truth.breadth, factor * truth.draught,
        (factor * aft, factor * fore), factor * truth.top, truth.published,
    )  # fmt: skip


def _of_hull(hull: ah.Hull, draught: float) -> Floating:
    found = hull.hydrostatics(draught=draught, on_error="report")
    return Floating(found.volume, found.lcb, found.wetted_surface)


@attrs.frozen(eq=False)
class Shell:
    """Triangles of a hull's shell, port or both sides, measured below a level by Gauss's theorem.

    The volume is the flow of (0, y, 0) through the shell: centre plane, water and transom let none
    through, so the mesh may be open there.
    """

    mesh: Triangles
    sides: float

    def at(self, draught: float) -> Floating:
        """Measure what lies below z = draught; triangles in the plane of the transom are none."""
        corner = _below(self.mesh.corners, draught)
        normal = 0.5 * np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
        area = np.linalg.norm(normal, axis=1)
        x, y = corner[:, :, 0], corner[:, :, 1]
        # Exact means of y and of x y over a triangle, corners and their sum.
        mean = y.mean(axis=1)
        mixed = ((x * y).sum(axis=1) + x.sum(axis=1) * y.sum(axis=1)) / 12.0
        outward = np.sign((mean * normal[:, 1]).sum())
        volume = outward * (mean * normal[:, 1]).sum()
        moment = outward * (mixed * normal[:, 1]).sum()
        aft = self.mesh.xyz[:, 0].min()
        flat = (np.abs(x - aft) < 1e-3 * (self.mesh.xyz[:, 0].max() - aft)).all(axis=1)
        flat &= np.abs(normal[:, 0]) > 0.999 * area
        wetted = area[~flat].sum()
        return Floating(self.sides * volume, moment / volume, self.sides * wetted)


def _below(corner: FloatArray, level: float) -> FloatArray:
    """Clip triangles (n, 3, 3) by z <= level."""
    under = corner[:, :, 2] <= level
    count = under.sum(axis=1)
    parts = [corner[count == 3]]
    for wanted in (1, 2):
        some, mark = corner[count == wanted], under[count == wanted]
        # The corner that is alone on its side comes first, the order of the others stays.
        alone = np.argmax(mark if wanted == 1 else ~mark, axis=1)
        some = np.take_along_axis(some, ((alone[:, None] + np.arange(3)) % 3)[:, :, None], axis=1)
        a, b, c = some[:, 0], some[:, 1], some[:, 2]
        cut = [a + ((level - a[:, 2]) / (e[:, 2] - a[:, 2]))[:, None] * (e - a) for e in (b, c)]
        if wanted == 1:
            parts.append(np.stack([a, *cut], axis=1))
        else:
            parts += [np.stack([cut[0], b, c], axis=1), np.stack([cut[0], c, cut[1]], axis=1)]
    return np.concatenate(parts)


def truth_of_hull(hull: ah.Hull, *, sections: bool = False) -> Truth:
    """Give the truth of a hull; `sections` where the file holds nothing else of it."""
    ship = hull.particulars
    aft, fore, top = extent(hull, sections=sections)
    return Truth(partial(_of_hull, hull), ship.length, ship.breadth, ship.draught, (aft, fore), top)


def extent(hull: ah.Hull, *, sections: bool = False) -> tuple[float, float, float]:
    """Give aftmost and foremost x and highest z of all lines, or of those in planes across alone.

    The highest place is a point of the deck edge; the bottom is lower than its points where
    splines swing below it.
    """
    points = [
        piece.points
        for line in lines_as_points(hull.state, _FAMILIES)
        for piece in line.pieces
        if not sections or np.ptp(piece.points[:, 0]) < _ACROSS
    ]
    every = np.concatenate(points)
    return float(every[:, 0].min()), float(every[:, 0].max()), float(every[:, 2].max())


_ACROSS = 1e-6
"""A line that keeps its x to this (m) is a section, or a transom that a file has as one."""

_FAMILIES = ("boundary", "sections", "waterlines", "buttocks")


def truth_of_mesh(
    mesh: Triangles, length: float, breadth: float, draught: float, published: str = ""
) -> Truth:
    """Give the truth of triangles, port half or whole, in ship axes."""
    low, high = mesh.xyz.min(axis=0), mesh.xyz.max(axis=0)
    sides = 1.0 if low[1] < -0.1 * high[1] else 2.0
    return Truth(
        Shell(mesh, sides).at, length, breadth, draught, (float(low[0]), float(high[0])),
        float(high[2]), published,
    )  # fmt: skip


# --------------------------------------------------------------------------------------
# Cells: what became of a file.


@attrs.frozen
class Cell:
    """One import beside the truth.

    Attributes
    ----------
    word : str
        "right", "told" (wrong, and a suspicion or refusal names why), "refused", "silent" (wrong,
        and nothing names why) or "unusable" (no hydrostatics).
    off : (float, float, float) or None
        V in %, LCB in % of Lpp as a place on the hull, S in %.
    suspicions : tuple of str
        What the import suspected.
    text : str
        The refusal, or what is wrong.
    hull : Hull or None
        What came in.
    """

    word: str
    off: tuple[float, float, float] | None = None
    suspicions: tuple[str, ...] = ()
    text: str = ""
    seconds: float = 0.0
    hull: ah.Hull | None = attrs.field(default=None, repr=False, eq=False)


@attrs.frozen
class Wrong:
    """One wrong option, and the words by which a finding names it."""

    options: Options
    names: str

    def __str__(self) -> str:
        return ", ".join(f"{name}={value!r}" for name, value in self.options.items())


@attrs.frozen(eq=False)
class Foreign:
    """A file of a hull.

    Attributes
    ----------
    name, what : str
        Short, for a table; and what is peculiar.
    write : callable
        Writes the file into a folder and gives its path.
    truth : callable
        Gives the truth.
    right : mapping
        Options with which a sound hull is taken.
    wrong : tuple of Wrong
        Each takes the place of right options.
    """

    name: str
    what: str
    write: Callable[[Path], Path]
    truth: Callable[[], Truth]
    right: Options = attrs.field(factory=dict)
    wrong: tuple[Wrong, ...] = ()
    sections: bool = False
    """Whether the file holds sections only (a transom among them): places go by these."""
    cuts: Options = attrs.field(factory=dict)
    """Fewer planes of a mesh or of surfaces, for imports that are to fail anyway."""
    sound: bool = True
    """Whether the file holds a hull at all; what does not is to be refused."""


def suspicions_of(hull: ah.Hull) -> tuple[str, ...]:
    """Give what an import suspected, of the notes of its adoption."""
    notes = hull.adoption.notes if hull.adoption else ()
    head = "suspicion: "
    return tuple(each.removeprefix(head) for each in notes if each.startswith(head))


def try_options(case: Foreign, path: Path, options: Options, names: str = "") -> Cell:
    """Import with options and set the hull beside its truth; `names` is what must be named."""
    missing = sorted(set(options) - set(inspect.signature(ah.read).parameters))
    if missing:
        return Cell("refused", text=f"there is no option {', '.join(missing)} yet")
    begin = time.perf_counter()
    try:
        hull = ah.read(path, **options)
    except AssocHullError as error:
        return Cell("refused", text=str(error), seconds=time.perf_counter() - begin)
    spent = time.perf_counter() - begin
    told = suspicions_of(hull)
    named = any(re.search(names, each, re.IGNORECASE) for each in told) if names else False
    try:
        off, wrong = _compare(case, hull, options)
    except AssocHullError as error:
        word = "told" if named else "unusable"
        return Cell(word, None, told, f"no hydrostatics: {error}", spent, hull)
    if not wrong:
        return Cell("right", off, told, "", spent, hull)
    return Cell("told" if named else "silent", off, told, "; ".join(wrong), spent, hull)


def _compare(
    case: Foreign, hull: ah.Hull, options: Options
) -> tuple[tuple[float, float, float], list[str]]:
    """Measure how far a hull is off, and say what is wrong of it."""
    truth, ship = case.truth(), hull.particulars
    if "scale" not in options and "scale" in case.right:
        # The file of a model says nothing of a ship: as it is it is a boat of that size.
        truth = at_scale(truth, 1.0 / case.right["scale"])
    found = hull.hydrostatics(draught=ship.draught)
    aft, fore, top = extent(hull, sections=case.sections)
    # The draught that was given is meant from the true base line; a found one is a plane in space.
    lift = 0.0 if np.isnan(truth.top) else truth.top - top
    plane = truth.draught if "draught" in options else ship.draught + lift
    if np.isnan(truth.top) and abs(plane / truth.draught - 1.0) < FRAME_OFF:
        plane = truth.draught  # a base line at the lowest point found, and the same waterline
    real = truth.at(plane)
    place = found.lcb - aft + truth.ends[0]
    off = (
        100.0 * (found.volume / real.volume - 1.0),
        100.0 * (place - real.lcb) / truth.length,
        100.0 * (found.wetted_surface / real.wetted - 1.0),
    )
    limits = (("V", V_OFF), ("LCB", LCB_OFF), ("S", S_OFF))
    wrong = [
        f"{name} {value:+.3f} %"
        for (name, limit), value in zip(limits, off, strict=True)
        if abs(value) > 100.0 * limit
    ]
    span, wanted = fore - aft, truth.ends[1] - truth.ends[0]
    if abs(span / wanted - 1.0) > FRAME_OFF:
        wrong.append(f"{span:.4g} m long, not {wanted:.4g}")
    wrong += _frame(truth, hull, aft, plane, options)
    return off, wrong


_ASSUMED = {
    "Lpp": r"length|proportions", "AP": r"aft perpendicular|ap\b|origin", "B": r"breadth",
    "T": r"draught|base line",
}  # fmt: skip
"""By what kind of assumption a value that was not given is told."""


def _frame(truth: Truth, hull: ah.Hull, aft: float, plane: float, given: Options) -> list[str]:
    """Say what is wrong of the frame and is not told: Lpp, AP, B, T."""
    ship, notes = hull.particulars, hull.adoption.notes if hull.adoption else ()
    heads = [each for each in notes if each.startswith(("assumed: ", "suspicion: "))]
    wrong = []
    for name, value, real, size in (
        ("Lpp", ship.length, truth.length, truth.length),
        ("AP", truth.ends[0] - aft, 0.0, truth.length),
        ("B", ship.breadth, truth.breadth, truth.breadth),
        ("T", plane, truth.draught, truth.draught),
    ):
        told = any(re.match(rf"(assumed|suspicion): ({_ASSUMED[name]})", each) for each in heads)
        # What is found and told is no silence, LCB then is in % of the frame so named; what was
        # given is to be as it was given.
        told &= _OPTION[name].isdisjoint(given)
        if abs(value - real) > FRAME_OFF * size and not told:
            wrong.append(f"{name} {value:.4g}, not {real:.4g}, untold")
    return wrong


_OPTION = {"Lpp": {"length"}, "AP": {"ap", "length", "origin"}, "B": {"breadth"}, "T": {"draught"}}


# --------------------------------------------------------------------------------------
# Rows: a file with nothing said, with the right options, with wrong ones.


@attrs.frozen
class Row:
    """All cells of a file; `remedy` is what following the refusals of the defaults led to."""

    case: Foreign
    defaults: Cell
    right: Cell
    wrong: tuple[tuple[Wrong, Cell], ...]
    remedy: tuple[Options, Cell] | None = None


def row_of(case: Foreign, folder: Path, *, wrong: bool = True) -> Row:
    """Write the file and try all of it."""
    path = case.write(folder)
    defaults = try_options(case, path, {})
    right = try_options(case, path, case.right) if case.right else defaults
    others = tuple(
        (each, try_options(case, path, {**case.right, **case.cuts, **each.options}, each.names))
        for each in (case.wrong if wrong else ())
    )
    remedy = follow(case, path, defaults.text) if defaults.word == "refused" else None
    return Row(case, defaults, right, others, remedy)


_STEPS = 4
"""A user who is refused more often than this goes elsewhere."""


def follow(case: Foreign, path: Path, message: str) -> tuple[Options, Cell]:
    """Do what refusals say: give values that they propose, else what one knows of the ship."""
    options: dict[str, Any] = {}
    cell = Cell("refused", text=message)
    for _ in range(_STEPS):
        more = asked_for(cell.text, case.right, options)
        if not more:
            break
        options |= more
        cell = try_options(case, path, options)
        if cell.word != "refused":
            break
    return options, cell


_NAMED = re.compile(
    r"\b(unit|scale|length|breadth|draught|depth|axes|centre|base|waterline|ap|fp|origin|join|"
    r"station_zero|tolerance|deck)="
    r"(?:'([^']*)'|\"([^\"]*)\"|(?:of )?([-+]?\d+(?:\.\d+)?))?"
)


def asked_for(text: str, known: Options, given: Options) -> dict[str, Any]:
    """Give options that a refusal asks for and that were not given."""
    found: dict[str, Any] = {}
    for match in _NAMED.finditer(text):
        name = match[1]
        if name in given or name in found:
            continue
        if name in known:
            found[name] = known[name]
        elif match[2] or match[3]:
            found[name] = match[2] or match[3]
        elif match[4]:
            found[name] = float(match[4])
    bare = re.findall(r"give (?:it |the )?(scale|length|breadth|draught|unit)\b", text)
    found |= {name: known[name] for name in bare if name in known and name not in given}
    return found


def uses_of(hull: ah.Hull) -> dict[str, str]:
    """Run on a hull what a naval architect runs next; give what failed."""
    ship = hull.particulars
    acts: dict[str, Callable[[], object]] = {
        "hydrostatics": lambda: hull.hydrostatics(draught=ship.draught),
        "vary": lambda: hull.vary(set={"breadth": 1.01 * ship.breadth}),
        "panels": lambda: hull.panels(draught=ship.draught, count=400),
        "mesh": lambda: hull.mesh(),
        "surface": lambda: hull.surface(),
    }
    failed = {}
    for name, act in acts.items():
        try:
            act()
        except AssocHullError as error:
            failed[name] = str(error)
    return failed


# --------------------------------------------------------------------------------------
# Hulls that files are cut from.


def data_folder() -> Path:
    """Give the folder of published hulls; it need not be there."""
    named = os.environ.get("ASSOC_HULL_DATA")
    return Path(named) if named else Path(__file__).resolve().parents[2] / "shared" / "data"


@cache
def shipped(name: str, *values: float) -> ah.Hull:
    """Give a shipped hull; it is only read."""
    hull: ah.Hull = getattr(ah.examples, name)(*values)
    return hull


def moved(
    hull: ah.Hull, scale: Sequence[float] = (1.0, 1.0, 1.0), shift: Sequence[float] = (0, 0, 0)
) -> ah.Hull:
    """Give a copy that is scaled about the origin, then shifted, with its particulars scaled."""
    other = ah.Hull(copy_state(hull.state))
    with other.edit("move") as edit:
        edit.transform(drivers=list(other.groups), scale=scale, shift=shift, planes="follow")
    return other


@cache
def scaled(name: str, x: float, y: float, z: float) -> ah.Hull:
    """Give a shipped hull in other proportions, with particulars to suit."""
    parent = shipped(name)
    hull, ship = moved(parent, (x, y, z)), parent.particulars
    hull.state.settings.particulars.data[0] = attrs.evolve(
        ship, length=x * ship.length, breadth=y * ship.breadth, depth=z * ship.depth,
        draught=z * ship.draught,
    )  # fmt: skip
    return hull


def half_grid(
    half: Callable[[FloatArray, FloatArray], FloatArray], keel: FloatArray,
    top: float, x: FloatArray, up: int,
) -> Triangles:  # fmt: skip
    """Triangulate y = half(x, z) from keel to top, close where the hull turns into the keel."""
    part = 0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi / 2, up) * 2.0)
    z = keel[:, None] + (top - keel[:, None]) * part[None, :] ** 1.5
    station = np.broadcast_to(x[:, None], z.shape)
    y = half(station, z)
    y[:, 0] = 0.0
    return grid_triangles(np.stack([station, y, z], axis=2))


# The frigate: a slender hull with a transom, and an ellipsoid as dome under its forefoot.

FRIGATE = {"lwl": 120.0, "lpp": 117.0, "breadth": 14.0, "draught": 4.4, "depth": 10.0}
_DOME = (104.0, 7.0, 1.4, 0.1, 1.9)
"""Middle x, half length, half breadth, middle z and half height of the dome, m."""


def frigate_keel(x: FloatArray) -> FloatArray:
    """Height of the lowest point: level, a cut-up aft to .4 m below water, the dome forward."""
    aft = np.maximum(0.0, 1.0 - x / 40.0)
    middle, long, _, height, deep = _DOME
    inside = np.maximum(0.0, 1.0 - ((x - middle) / long) ** 2)
    dome = np.where(inside > 0.0, height - deep * np.sqrt(inside), np.inf)
    return np.asarray(np.minimum(4.0 * aft**2, dome))


def frigate_half(x: FloatArray, z: FloatArray) -> FloatArray:
    """Half-breadth of hull and dome: where both are, they run into one another."""
    lwl, depth = FRIGATE["lwl"], FRIGATE["depth"]
    fore = np.maximum(0.0, (x - 55.0) / (lwl - 55.0))
    aft = np.maximum(0.0, (55.0 - x) / 55.0)
    plan = 0.5 * FRIGATE["breadth"] * (1.0 - fore**2.2) * (1.0 - 0.35 * aft**2.5)
    keel = 4.0 * np.maximum(0.0, 1.0 - x / 40.0) ** 2
    part = np.clip((z - keel) / (depth - keel), 0.0, 1.0)
    body = plan * np.sqrt(1.0 - (1.0 - part) ** 5)
    middle, long, wide, height, deep = _DOME
    inside = 1.0 - ((x - middle) / long) ** 2 - ((z - height) / deep) ** 2
    dome = wide * np.sqrt(np.maximum(0.0, inside))
    return np.asarray((body**4 + dome**4) ** 0.25)


@cache
def frigate_mesh(along: int, up: int) -> Triangles:
    """The port half in its own axes: x from the transom, z from the base line."""
    middle, long = _DOME[0], _DOME[1]
    even = np.linspace(0.0, FRIGATE["lwl"], along)
    x = np.unique(np.concatenate([even, middle + long * np.cos(np.linspace(0, np.pi, along // 8))]))
    return half_grid(frigate_half, frigate_keel(x), FRIGATE["depth"], x, up)


@cache
def frigate_truth() -> Truth:
    """Its perpendiculars: FP where the stem meets the water, AP 117 m abaft."""
    mesh = frigate_mesh(1201, 241)
    at_ap = Triangles(mesh.xyz - [FRIGATE["lwl"] - FRIGATE["lpp"], 0.0, 0.0], mesh.face)
    return truth_of_mesh(at_ap, FRIGATE["lpp"], FRIGATE["breadth"], FRIGATE["draught"])


def write_frigate(folder: Path) -> Path:
    """Whole, with transom and deck, as a STL; x aft from the FP, z up from the waterline."""
    half = frigate_mesh(301, 61)
    shell = mirrored(half)
    file_axes = (shell.xyz - [FRIGATE["lwl"], 0.0, FRIGATE["draught"]]) * [-1.0, 1.0, 1.0]
    return write(Triangles(file_axes, shell.face[:, ::-1]), folder / "frigate.stl")


# Meshes of a row of points a station, as a script of one's own writes them: a boat with a V bottom,
# and a ship with flat side, flat bottom and round bilges. The triangles themselves are the truth.


@cache
def vee_boat_mesh(along: int, around: int) -> Triangles:
    """The port half of a boat of 20 m: bottom and side ruled, the chine ends in a raked stem."""
    stations = []
    for part in np.linspace(0.0, 1.0, along).tolist():
        plan = 1.0 if part < 0.4 else 1.0 - ((part - 0.4) / 0.6) ** 2
        chine, deck = 0.55 + 1.1 * part**3, 2.4 + 0.5 * part**2
        keel = chine * max(0.0, (part - 0.55) / 0.45) ** 2
        corner = np.array(
            [[18.0 * part, 0.0, keel], [18.0 * part, 2.125 * plan, chine],
             [20.0 * part, 2.5 * plan**0.7, deck]]
        )  # fmt: skip
        step = np.linspace(0.0, 2.0, 2 * around - 1)
        stations.append([np.interp(step, [0.0, 1.0, 2.0], column) for column in corner.T])
    return grid_triangles(np.moveaxis(np.array(stations), 1, 2))


@cache
def box_ship_mesh(along: int, around: int) -> Triangles:
    """The port half of a ship of 100 x 16 x 10 m, bilge radius 2 m, ends of her lines parabolic."""
    stations = []
    for x in (50.0 * (1.0 - np.cos(np.linspace(0.0, np.pi, along)))).tolist():
        away = max(0.35 - 0.01 * x, 0.01 * x - 0.65, 0.0) / 0.35
        half = 8.0 * (1.0 - away**2)
        flat, turn = max(half - min(2.0, half), 0.0), np.linspace(0.0, np.pi / 2, around)[1:]
        bilge = half - flat
        y = [np.linspace(0.0, flat, around), flat + bilge * np.sin(turn), np.full(around - 1, half)]
        z = [np.zeros(around), bilge * (1.0 - np.cos(turn)), np.linspace(bilge, 10.0, around)[1:]]
        each = np.concatenate(y), np.concatenate(z)
        stations.append(np.column_stack([np.full(len(each[0]), x), *each]))
    return grid_triangles(np.array(stations))


def _whole(half: Callable[[], Triangles], name: str) -> Callable[[Path], Path]:
    """Write both halves of a mesh, without deck, as a STL."""

    def made(folder: Path) -> Path:
        port = half()
        both = port.xyz, port.xyz * [1.0, -1.0, 1.0]
        face = np.concatenate([port.face, port.face[:, ::-1] + len(port.xyz)])
        return write(Triangles(np.concatenate(both), face), folder / f"{name}.stl")

    return made


# The chine boat: ruled surfaces between keel, chine and sheer.

BOAT = {"draught": 0.62, "depth": 1.9}


def boat_surfaces() -> list[SplineSurface]:
    """Bottom and side to port, x from the transom, z from the keel, which is straight aft."""
    keel = np.zeros((8, 3))
    keel[:, 0] = np.linspace(0.0, 11.7, 8)
    keel[:, 2] = [0, 0, 0, 0, 0, 0, 0.15, 0.95]
    x = np.array([0.0, 4.2, 8.6, 11.8])
    chine = np.column_stack([x, [1.5, 1.75, 1.65, 0.0], [0.42, 0.40, 0.46, 1.25]])
    sheer = np.column_stack([x * [1, 1, 1, 1.02], [1.65, 1.95, 2.1, 0.0], [1.7, 1.75, 1.8, 2.1]])
    chine, sheer = _elevated(chine, 7), _elevated(sheer, 7)
    return [
        SplineSurface.bezier(np.stack([keel, chine], axis=1), "bottom"),
        SplineSurface.bezier(np.stack([chine, sheer], axis=1), "side"),
    ]


def _elevated(points: FloatArray, degree: int) -> FloatArray:
    """The same Bezier curve with more control points."""
    while len(points) <= degree:
        part = np.arange(1, len(points))[:, None] / len(points)
        inner = part * points[:-1] + (1.0 - part) * points[1:]
        points = np.concatenate([points[:1], inner, points[-1:]])
    return points


def boat_length() -> float:
    """From the transom to where the stem meets the water, m."""
    bottom = boat_surfaces()[0]
    stem = brentq(lambda u: float(bottom.at(u, 0.0)[2]) - BOAT["draught"], 0.5, 1.0)
    return float(bottom.at(stem, 0.0)[0])


def _triangulated(surfaces: Sequence[SplineSurface], along: int, up: int) -> Triangles:
    parts, begin = [], 0
    faces = []
    for each in surfaces:
        (a, b), (c, d) = [(float(k[0]), float(k[-1])) for k in (each.knots_u, each.knots_v)]
        u, v = np.meshgrid(np.linspace(a, b, along), np.linspace(c, d, up), indexing="ij")
        grid = grid_triangles(each.at(u, v))
        parts.append(grid.xyz)
        faces.append(grid.face + begin)
        begin += len(grid.xyz)
    return merge_vertices(np.concatenate(parts), np.concatenate(faces))


@cache
def boat_truth() -> Truth:
    """Measured on fine triangles; x from the transom is the AP, the FP at the water's end."""
    mesh = _triangulated(boat_surfaces(), 1201, 161)
    return truth_of_mesh(mesh, boat_length(), 2.0 * mesh.xyz[:, 1].max(), BOAT["draught"])


def write_boat(folder: Path) -> Path:
    """Both surfaces to port as IGES in mm."""
    path = folder / "chine_boat.igs"
    path.write_text(iges_text(boat_surfaces(), "mm"))
    return path


# --------------------------------------------------------------------------------------
# Files.


def write_lines(hull: ah.Hull, path: Path, unit: float = 1.0, skip: str = "") -> Path:
    """Write all lines as digitised lines, a blank row between pieces; `skip` is left out."""
    rows = ["line,x,y,z"]
    for line in lines_as_points(hull.state, ("boundary", "sections", "waterlines", "buttocks")):
        name = line.name
        if name == skip or (line.group == "boundary" and name not in _KEPT):
            continue
        for number, piece in enumerate(line.pieces):
            rows += [""] if number else []
            rows += [f"{name}," + ",".join(f"{unit * v:.5f}" for v in p) for p in piece.points]
    path.write_text("\n".join(rows) + "\n")
    return path


_KEPT = ("profile", "deck edge", "transom")
"""Boundary curves that digitised lines know."""


def holed(text: str, name: str, place: Sequence[float], width: float) -> str:
    """Take a piece out of a line of digitised points: `width` of it about a place."""
    rows = text.splitlines()
    mine = [i for i, row in enumerate(rows) if row.startswith(f"{name},")]
    points = np.array([[float(v) for v in rows[i].split(",")[1:]] for i in mine])
    leg = np.linalg.norm(np.diff(points, axis=0), axis=1)
    # Nearest place of the polyline, then half the width to both sides along it.
    t = ((np.array(place) - points[:-1]) * np.diff(points, axis=0)).sum(axis=1) / leg**2
    foot = points[:-1] + np.clip(t, 0.0, 1.0)[:, None] * np.diff(points, axis=0)
    near = int(np.argmin(np.linalg.norm(foot - place, axis=1)))
    run = np.concatenate([[0.0], np.cumsum(leg)])
    middle = float(run[near] + np.linalg.norm(foot[near] - points[near]))
    ends = [middle - 0.5 * width, middle + 0.5 * width]
    cut = [np.array([np.interp(s, run, points[:, k]) for k in range(3)]) for s in ends]
    before = [rows[i] for i, s in zip(mine, run, strict=True) if s < ends[0]]
    after = [rows[i] for i, s in zip(mine, run, strict=True) if s > ends[1]]
    told = [f"{name}," + ",".join(f"{v:.5f}" for v in each) for each in cut]
    kept = [*before, told[0], "", told[1], *after]
    return "\n".join([*rows[: mine[0]], *kept, *rows[mine[-1] + 1 :]]) + "\n"


def _export(
    name: str, make: Callable[[], ah.Hull], form: str | None = None, unit: str | None = None
) -> Callable[[Path], Path]:
    def write_it(folder: Path) -> Path:
        path = folder / name
        make().export(path, form, unit)
        return as_of_others(path) if path.suffix in (".dxf", ".igs") else path

    return write_it


def as_of_others(path: Path) -> Path:
    """Make a drawing of ours one of another program: a layer a line in DXF, no texts of ours."""
    if path.suffix == ".igs":
        # As long as the mark, so that counts of letters and lines hold.
        path.write_text(path.read_text().replace(MARK, "OTHER_CADS"))
        return path
    drawing = ezdxf.filemanagement.readfile(path)
    for entity in drawing.modelspace():
        name = str(entity.get_xdata(MARK)[0].value)
        entity.discard_xdata(MARK)
        if name not in drawing.layers:
            drawing.layers.add(name)
        entity.dxf.layer = name
    drawing.header.custom_vars.clear()
    drawing.saveas(path)
    text = path.read_text()
    path.write_text(text.replace(MARK, "OTHER_CADS"))
    return path


def _copy(*parts: str) -> Callable[[Path], Path]:
    return lambda _: data_folder().joinpath(*parts)


def _dtc() -> Triangles:
    mesh = read_triangles(data_folder() / "dtc" / "DTC-scaled.stl.gz")
    return Triangles(59.407 * mesh.xyz, mesh.face)


@cache
def dtc_truth() -> Truth:
    """The mesh itself, clipped."""
    return truth_of_mesh(
        _dtc(), 355.0, 51.0, 14.5, "V 173467 m3, LCB 174.059 m, S 22032 m2, CB .661"
    )


@cache
def wigley_truth() -> Truth:
    """The surface of the file on fine triangles: a fit of the formula."""
    surfaces = read_surface_file(data_folder() / "wigley" / "wavebem_wigley.iges")
    mesh = _triangulated(surfaces, 801, 401)
    xyz = mesh.xyz * [1.0, np.sign(mesh.xyz[:, 1].mean()), 1.0]
    low = xyz.min(axis=0)
    mesh = Triangles(xyz - [low[0], 0.0, low[2]], mesh.face)
    return truth_of_mesh(mesh, 2.5, 0.25, 0.15625, "V 4LBT/9 = .043403 m3, S .929941 m2")


@cache
def sysser_table() -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Give x, keel heights, heights of waterlines and half-breadths (nan: none), m."""
    rows = [
        row.split(",")
        for row in (data_folder() / "sysser1" / "sysser01_offsets.csv").read_text().splitlines()
        if not row.startswith("#")
    ]
    z = np.array([float(cell.removeprefix("wl_")) for cell in rows[0][4:]])
    body = np.array([[float(cell or "nan") for cell in row[1:]] for row in rows[1:]])
    return body[:, 0], body[:, 1], z, body[:, 3:]


@cache
def sysser_truth() -> Truth:
    """Splines through the offsets: of sections by chords, then along the ship, triangulated."""
    x, keel, z, y = sysser_table()
    rows = []
    for low, half in zip(keel, y, strict=True):
        known = np.isfinite(half) & (z > low + 1e-9)
        points = np.column_stack([np.append(0.0, half[known]), np.append(low, z[known])])
        run = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1)))
        rows.append(CubicSpline(run, points)(np.linspace(0.0, run[-1], 401)))
    fine = np.linspace(x[0], x[-1], 1601)
    skin = CubicSpline(x, np.array(rows), axis=0)(fine)
    skin[:, 0, 0] = 0.0
    along = np.broadcast_to(fine[:, None], skin.shape[:2])
    mesh = grid_triangles(np.dstack([along, skin[..., 0], skin[..., 1]]))
    published = "V 9.1830 m3, S 25.099 m2, LCB -.229 m of mid-LWL"
    found = truth_of_mesh(mesh, 10.0, 2.0 * float(np.nanmax(y)), 0.794, published)
    # Its highest half-breadths lie below the sheer, of which the table has the height only.
    return attrs.evolve(found, top=float("nan"))


def write_yacht(folder: Path) -> Path:
    """The yacht's table with heights from the waterline, as designers of yachts have them."""
    text = (data_folder() / "sysser1" / "sysser01_offsets.csv").read_text().splitlines()
    rows = [row.split(",") for row in text if not row.startswith("#")]
    head = rows[0][:4] + [f"wl_{float(cell[3:]) - 0.794:.6g}" for cell in rows[0][4:]]
    body = []
    for row in rows[1:]:
        low = [f"{float(cell) - 0.794:.6f}" for cell in row[2:4]]
        body.append([*row[:2], *low, *row[4:]])
    path = folder / "yacht.csv"
    path.write_text("\n".join(",".join(row) for row in [head, *body]) + "\n")
    return path


@cache
def with_post(scale: float) -> ah.Hull:
    """The plain ship with stations drawn on both sides of her post, as a table needs them."""
    hull = ah.Hull(copy_state(shipped("plain_ship").state))
    with hull.edit("stations") as edit:
        for x in (3.6, 4.0, 4.4, 5.0):
            edit.add_line("sections", x)
    hull = moved(hull, (scale, scale, scale))
    ship = hull.particulars
    hull.state.settings.particulars.data[0] = attrs.evolve(
        ship, length=scale * ship.length, breadth=scale * ship.breadth, depth=scale * ship.depth,
        draught=scale * ship.draught,
    )  # fmt: skip
    return hull


def tanker() -> ah.Hull:
    """The plain ship at twice her size: 240 m."""
    return with_post(2.0)


def _table_rows(hull: ah.Hull, folder: Path) -> list[list[str]]:
    """The block of half-breadths of an exported table, without its words."""
    path = folder / "table.csv"
    hull.export(path)
    rows = [row.split(",") for row in path.read_text().splitlines() if not row.startswith("#")]
    path.unlink()
    end = next((i for i, row in enumerate(rows) if i and row[0] == rows[0][0]), len(rows))
    # Stations beside the post have no number: places tell where they are.
    first = int("station" in rows[0])
    return [row[first:] for row in rows[:end] if any(row)]


def write_tanker(folder: Path) -> Path:
    """A table as yards print it: half-breadths in mm, heights in m."""
    head, *body = _table_rows(tanker(), folder)
    breadths = [i for i, cell in enumerate(head) if cell.startswith("wl_") or cell == "y_deck"]
    for row in body:
        for i in breadths:
            row[i] = f"{1e3 * float(row[i]):.0f}" if row[i] else ""
    path = folder / "tanker.csv"
    path.write_text("\n".join(",".join(row) for row in [head, *body]) + "\n")
    return path


def write_workbook(folder: Path) -> Path:
    """A table in a workbook as others make it: no words, x = 0 at the FP."""
    book = openpyxl.Workbook()
    for row in _table_rows(with_post(1.0), folder):
        cells = [float(each) if _is_number(each) else each or None for each in row]
        if isinstance(cells[0], float):
            cells[0] = round(cells[0] - 120.0, 6)
        book.active.append(cells)
    path = folder / "cargo.xlsx"
    book.save(path)
    return path


def _is_number(cell: str) -> bool:
    with contextlib.suppress(ValueError):
        float(cell)
        return True
    return False


def write_catamaran(folder: Path) -> Path:
    """Two Wigley demihulls, closed, in one STL."""
    mesh = shipped("wigley", 40.0, 3.0, 2.0).mesh()
    xyz, face = mesh.xyz, mesh.triangle
    aside = np.array([0.0, 6.0, 0.0])
    both = np.concatenate([xyz + aside, xyz - aside])
    return write(Triangles(both, np.concatenate([face, face + len(xyz)])), folder / "catamaran.stl")


def write_half(folder: Path) -> Path:
    """The port half of a Series 60 hull."""
    mesh = shipped("series60", 0.70).mesh(half=True, points=8)
    return write(mesh.triangles, folder / "half.stl")


def write_container(folder: Path) -> Path:
    """Digitised lines whose profile lacks 7 mm above the stern bulb."""
    path = write_lines(shipped("container_ship_225m"), folder / "container.csv")
    path.write_text(holed(path.read_text(), "profile", CONTAINER_HOLE, 0.007))
    return path


CONTAINER_HOLE = (8.15, 0.0, 6.55)
"""Near this place the profile runs above the stern bulb."""


def write_workboat(folder: Path) -> Path:
    """Digitised lines of a boat of 24 m whose keel lacks 170 mm."""
    path = write_lines(workboat(), folder / "workboat.csv")
    path.write_text(holed(path.read_text(), "profile", (10.0, 0.0, 0.0), 0.170))
    return path


def workboat() -> ah.Hull:
    """The plain ship, a fifth of her."""
    return scaled("plain_ship", 0.2, 0.2, 0.2)


def tug() -> ah.Hull:
    """A tug of 30 m in the proportions of tugs."""
    return scaled("prelikon_ship", 30.0 / 114.0, 10.0 / 22.0, 4.2 / 7.0)


def write_model(folder: Path) -> Path:
    """The surface of a ship at 1/25, in m."""
    patches = shipped("bulk_carrier_180m").surface().patches
    path = folder / "model.igs"
    path.write_text(iges_text([attrs.evolve(each, net=each.net / 25.0) for each in patches], "m"))
    return path


def write_step(folder: Path) -> Path:
    """The surface of the container ship."""
    path = folder / "container.step"
    shipped("container_ship_225m").surface().write(path)
    return path


def _shift(name: str, *shift: float) -> Callable[[], ah.Hull]:
    return lambda: moved(shipped(name), shift=shift)


def _scaled_dtc(folder: Path) -> Path:
    return write(_dtc(), folder / "dtc.stl")


# --------------------------------------------------------------------------------------
# The corpus.


def _ship(name: str, *values: float, sections: bool = False) -> Callable[[], Truth]:
    return cache(lambda: truth_of_hull(shipped(name, *values), sections=sections))


def _made(make: Callable[[], ah.Hull], sections: bool = False) -> Callable[[], Truth]:
    return cache(lambda: truth_of_hull(make(), sections=sections))


_UNIT = r"\bunits?\b|\bscale\b"
_LENGTH = r"\blength\b|\bLpp\b|L/B"
_DRAUGHT = r"\bdraught\b"
_BREADTH = r"breadth"
_ZERO = r"station[_ ]zero|station 0|bow|stern"
_ORIGIN = r"origin|\bap\b|\bfp\b|perpendicular"
_BASE = r"base"


_FEW: Options = {"stations": 15, "waterlines": 8, "buttocks": 4}


def _w(names: str, **options: Any) -> Wrong:
    return Wrong(options, names)


CORPUS: tuple[Foreign, ...] = (
    Foreign(
        "series60_060", "Series 60, CB .60: Todd's table, y/(B/2) and z/T, station 0 = FP, CSV",
        _copy("series60", "s60_cb060_offsets.csv"), _ship("series60", 0.60),
        {"length": 121.92},
        (_w(_LENGTH, length=400.0, breadth=16.256), _w(_ZERO, station_zero="ap"),
         _w(_DRAUGHT, draught=3.2), _w(_BREADTH, breadth=10.0), _w(_UNIT, unit="mm")),
    ),
    Foreign(
        "series60_070", "Series 60, CB .70: the same",
        _copy("series60", "s60_cb070_offsets.csv"), _ship("series60", 0.70),
        {"length": 121.92},
        (_w(_ZERO, station_zero="ap"), _w(_DRAUGHT, draught=11.0), _w(_BREADTH, breadth=25.0)),
    ),
    Foreign(
        "dtc_model", "DTC: STL at 1:59.407, z from the keel, x from about AP",
        _copy("dtc", "DTC-scaled.stl.gz"), dtc_truth,
        {"scale": 59.407, "length": 355.0, "draught": 14.5},
        (_w(_UNIT, scale=100.0), _w(_UNIT, scale=1.0), _w(_UNIT, unit="ft"),
         _w(_LENGTH, length=255.0), _w(_DRAUGHT, draught=145.0)),
        cuts=_FEW,
    ),
    Foreign(
        "dtc_full", "DTC: the same at full scale", _scaled_dtc, dtc_truth,
        {"length": 355.0, "draught": 14.5},
        (_w(_UNIT, scale=59.407), _w(_UNIT, unit="ft"), _w(_LENGTH, length=455.0),
         _w(_DRAUGHT, draught=1.45)),
        cuts=_FEW,
    ),
    Foreign(
        "wigley", "Wigley: WaveBEM's half surface, IGES, 2.5 m, z from the waterline",
        _copy("wigley", "wavebem_wigley.iges"), wigley_truth, {"length": 2.5, "draught": 0.15625},
        (_w(_UNIT, unit="mm"), _w(_UNIT, scale=40.0), _w(_LENGTH, length=3.5),
         _w(_DRAUGHT, draught=0.12), _w(_BREADTH, breadth=0.5)),
        cuts=_FEW,
    ),
    Foreign(
        "sysser1", "Sysser 1: yacht, CSV, m, blanks below a rising keel, x from the stern",
        _copy("sysser1", "sysser01_offsets.csv"), sysser_truth,
        {"length": 10.0, "draught": 0.794},
        (_w(_UNIT, unit="mm"), _w(_UNIT, unit="ft"), _w(_LENGTH, length=16.0),
         _w(_DRAUGHT, draught=1.9)),
    ),
    Foreign(
        "carrier_transom", "207k carrier: IGES curves in mm, x from the transom",
        _export("carrier.igs", _shift("bulk_carrier_207k", 5.0, 0.0, 0.0), "iges-lines", "mm"),
        _ship("bulk_carrier_207k"), {"length": 300.0, "draught": 18.0, "deck": "closed"},
        (_w(_UNIT, unit="m"), _w(_UNIT, scale=0.5), _w(_LENGTH, length=200.0),
         _w(_DRAUGHT, draught=180.0), _w(_BREADTH, breadth=40.0), _w(_ORIGIN, ap=30.0)),
    ),
    Foreign(
        "carrier_midship", "180 m carrier: DXF splines in mm, x from midship, z from the "
        "waterline",
        _export("carrier.dxf", _shift("bulk_carrier_180m", -90.0, 0.0, -10.5), "dxf", "mm"),
        _ship("bulk_carrier_180m"), {"length": 180.0, "draught": 10.5},
        (_w(_UNIT, unit="m"), _w(_UNIT, unit="in"), _w(_LENGTH, length=120.0),
         _w(_DRAUGHT, draught=7.5), _w(_ORIGIN, origin="fp"), _w(_BASE, base=-7.0)),
    ),
    Foreign(
        "cargo_fp", "Cargo ship of 120 m: XLSX table, x from the FP, negative abaft",
        write_workbook, _made(partial(with_post, 1.0), True),
        {"length": 120.0, "draught": 7.2, "station_zero": "fp"},
        (_w(_UNIT, unit="mm"), _w(_LENGTH, length=80.0), _w(_DRAUGHT, draught=72.0),
         _w(_ZERO, station_zero="ap")),
        sections=True,
    ),
    Foreign(
        "container_holed", "225 m container ship: digitised lines, 7 mm of the profile missing",
        write_container, _ship("container_ship_225m"),
        {"length": 225.0, "draught": 10.8},
        (_w(_UNIT, unit="ft"), _w(_LENGTH, length=150.0), _w(_DRAUGHT, draught=1.08)),
    ),
    Foreign(
        "container_step", "225 m container ship: STEP of her surface", write_step,
        _ship("container_ship_225m"), {"length": 225.0, "draught": 10.8},
        (_w(_UNIT, unit="m"), _w(_LENGTH, length=325.0)),
        cuts=_FEW,
    ),
    Foreign(
        "frigate", "Frigate: whole STL; dome 1.8 m below base; x aft from FP, z from the waterline",
        write_frigate, frigate_truth, {"length": 117.0, "draught": 4.4},
        (_w(_UNIT, unit="ft"), _w(_LENGTH, length=70.0), _w(_DRAUGHT, draught=6.2),
         _w(_BASE, base=-6.2)),
        cuts=_FEW,
    ),
    Foreign(
        "chine_boat", "Planing boat of 12 m, hard chine: IGES surfaces in mm, port half",
        write_boat, boat_truth, {"length": round(boat_length(), 4), "draught": 0.62},
        (_w(_UNIT, unit="m"), _w(_LENGTH, length=7.0), _w(_DRAUGHT, draught=6.2)),
        cuts=_FEW,
    ),
    Foreign(
        "vee_boat", "Boat of 20 m, V bottom: STL",
        _whole(lambda: vee_boat_mesh(41, 7), "vee_boat"),
        lambda: truth_of_mesh(vee_boat_mesh(41, 7), 16.68, 4.432, 1.0),
        {"length": 16.68, "draught": 1.0},
        (_w(_UNIT, unit="ft"), _w(_LENGTH, length=20.0), _w(_DRAUGHT, draught=2.6)),
        cuts=_FEW,
    ),
    Foreign(
        "box_ship", "Flat-sided ship of 100 m: STL",
        _whole(lambda: box_ship_mesh(81, 13), "box_ship"),
        lambda: truth_of_mesh(box_ship_mesh(81, 13), 100.0, 16.0, 6.0),
        {"length": 100.0, "draught": 6.0},
        (_w(_UNIT, unit="ft"), _w(_LENGTH, length=115.0), _w(_DRAUGHT, draught=60.0)),
        cuts=_FEW,
    ),
    Foreign(
        "catamaran", "Catamaran: two Wigley demihulls of 40 m, 12 m apart, in one STL",
        write_catamaran, _ship("wigley", 40.0, 3.0, 2.0),
        {"centre": 6.0, "length": 40.0, "draught": 2.0},
        (_w(r"centre|symmetric", centre=5.0), _w(_LENGTH, length=80.0)),
        cuts=_FEW,
    ),
    Foreign(
        "yacht", "Sysser 1: the same table, z from the waterline", write_yacht, sysser_truth,
        {"length": 10.0, "draught": 0.794, "base": -0.794},
        (_w(_UNIT, unit="mm"), _w(_DRAUGHT, draught=1.3), _w(_LENGTH, length=16.0),
         _w(_BASE, base=-0.4)),
    ),
    Foreign(
        "half_stl", "Series 60, CB .70: STL of the port half", write_half,
        _ship("series60", 0.70), {"length": 121.92, "draught": 6.967},
        (_w(_UNIT, unit="ft"), _w(_LENGTH, length=90.0), _w(_DRAUGHT, draught=69.67)),
        cuts=_FEW,
    ),
    Foreign(
        "workboat", "Workboat of 24 m: digitised lines, 170 mm of the keel missing",
        write_workboat, _made(workboat), {"length": 24.0, "draught": 1.44, "join": 0.2},
        (_w(_UNIT, unit="ft"), _w(_LENGTH, length=15.0), _w(_DRAUGHT, draught=14.4)),
    ),
    Foreign(
        "tanker_mm", "Tanker of 240 m: table, half-breadths in mm, heights in m", write_tanker,
        _made(tanker, True), {"unit": "mm,m", "length": 240.0, "draught": 14.4},
        (_w(_UNIT, unit="mm"), _w(_UNIT, unit="m"), _w(_LENGTH, length=160.0),
         _w(_DRAUGHT, draught=0.0144)),
        sections=True,
    ),
    Foreign(
        "carrier_table", "207k carrier: her table",
        _export("carrier.csv", partial(shipped, "bulk_carrier_207k")),
        _ship("bulk_carrier_207k", sections=True), {"deck": "closed"}, sections=True, sound=False,
    ),
    Foreign(
        "model_25", "180 m carrier: her surface at 1/25, IGES, m", write_model,
        _ship("bulk_carrier_180m"), {"scale": 25.0, "length": 180.0, "draught": 10.5},
        (_w(_UNIT, scale=2.5), _w(_UNIT, scale=1.0), _w(_UNIT, unit="mm")),
        cuts=_FEW,
    ),
    Foreign(
        "tug", "Tug of 30 m: DELFTship sections", _export("tug.txt", tug, "delftship"),
        _made(tug, True), {"length": 30.0, "draught": 4.2},
        (_w(_UNIT, unit="ft"), _w(_LENGTH, length=20.0), _w(_DRAUGHT, draught=42.0)),
        sections=True,
    ),
    Foreign(
        "ferry_gf", "Ferry of 90 m: GHS sections, ft", 
        _export("ferry.gf", partial(shipped, "sfolds_ship"), "gf"),
        _ship("sfolds_ship", sections=True), {"length": 90.0, "draught": 5.8, "deck": "closed"},
        (_w(_UNIT, unit="m"), _w(_LENGTH, length=60.0), _w(_DRAUGHT, draught=0.58)),
        sections=True,
    ),
    Foreign(
        "coaster_bri", "Coaster of 106 m: BRITFAIR sections",
        _export("coaster.bri", partial(shipped, "seaking_ship"), "britfair"),
        _ship("seaking_ship", sections=True),
        {"origin": "ap", "length": 106.0, "draught": 6.6, "deck": "closed"},
        (_w(_UNIT, unit="ft"), _w(_LENGTH, length=70.0), _w(_DRAUGHT, draught=66.0)),
        sections=True,
    ),
    Foreign(
        "plain_offsets", "Plain ship: FREE!ship's list of all lines, FP at x = 0",
        _export("plain.txt", _shift("plain_ship", -120.0, 0.0, 0.0), "delftship-offsets"),
        _ship("plain_ship"), {"length": 120.0, "draught": 7.2},
        (_w(_UNIT, unit="ft"), _w(_LENGTH, length=80.0), _w(_DRAUGHT, draught=72.0)),
    ),
)  # fmt: skip
"""All files."""

QUICK = ("series60_070", "sysser1", "yacht")
"""Those of the ordinary suite: the cheapest of each kind."""

# --------------------------------------------------------------------------------------
# The table.


def markdown(rows: Sequence[Row]) -> str:
    """Give the table of the documentation."""
    head = "| file | nothing said | right options | V, LCB, S off, % | wrong options |"
    lines = [head, "|---|---|---|---|---|"]
    lines += [
        f"| {row.case.what} | {_default_words(row)} | {_word(row.right)} | {_offs(row.right)} | "
        f"{_wrong_words(row)} |"
        for row in rows
    ]
    return "\n".join(lines)


def _word(cell: Cell) -> str:
    """Give what came of it, and how many suspicions."""
    words = {"silent": "SILENTLY WRONG", "unusable": "no hydrostatics"}
    many = f" ({len(cell.suspicions)})" if cell.suspicions else ""
    return words.get(cell.word, cell.word) + many


def _offs(cell: Cell) -> str:
    return "" if cell.off is None else ", ".join(f"{value:+.3f}" for value in cell.off)


def _default_words(row: Row) -> str:
    """Give what came of nothing said; of a refusal, what doing as it says led to."""
    if row.remedy is None:
        return _word(row.defaults)
    options, cell = row.remedy
    return f"refused, then {_word(cell)}" if options else "refused"


def _wrong_words(row: Row) -> str:
    words = [_word(cell).partition(" (")[0] for _, cell in row.wrong]
    return ", ".join(f"{words.count(word)} {word}" for word in sorted(set(words)))


_SHOWN = 4


def details(row: Row) -> str:
    """Tell all of a row, for whoever mends the door."""
    lines = [f"## {row.case.name}: {row.case.what}"]
    cells = [("defaults", {}, row.defaults), ("right", row.case.right, row.right)]
    cells += [(f"wrong {each}", each.options, cell) for each, cell in row.wrong]
    if row.remedy:
        cells.append(("remedy", row.remedy[0], row.remedy[1]))
    for name, options, cell in cells:
        lines.append(f"- {name} {dict(options)}: **{cell.word}** [{_offs(cell)}] {cell.text}")
        lines += [f"    - suspicion: {each[:300]}" for each in cell.suspicions[:_SHOWN]]
        more = len(cell.suspicions) - _SHOWN
        lines += [f"    - and {more} suspicions more"] if more > 0 else []
        lines[-1] += f" ({cell.seconds:.0f} s)"
    return "\n".join(lines)


@contextlib.contextmanager
def _folder() -> Iterator[Path]:
    kept = os.environ.get("ASSOC_HULL_CORPUS")
    if kept:
        Path(kept).mkdir(parents=True, exist_ok=True)
        yield Path(kept)
        return
    with tempfile.TemporaryDirectory() as folder:
        yield Path(folder)


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the table."""
    parser = argparse.ArgumentParser(prog="python -m tests.foreign_hulls")
    parser.add_argument("--only", action="append", metavar="NAME")
    parser.add_argument("--quick", action="store_true", help="the files of the ordinary suite")
    parser.add_argument("--details", action="store_true", help="every cell with its texts")
    parser.add_argument("--right", action="store_true", help="without wrong options")
    parser.add_argument("--uses", action="store_true", help="what runs on the right hulls")
    given = parser.parse_args(arguments)
    names = given.only or (QUICK if given.quick else [case.name for case in CORPUS])
    rows = []
    with _folder() as folder:
        for case in CORPUS:
            if case.name in names:
                place = folder / case.name
                place.mkdir(exist_ok=True)
                rows.append(row_of(case, place, wrong=not given.right))
                if given.details:
                    print(details(rows[-1]), flush=True)
                if given.uses and rows[-1].right.hull:
                    failed = uses_of(rows[-1].right.hull)
                    print(f"- uses: {failed or 'all run'}", flush=True)
    if not given.details:
        print(markdown(rows))
    return 0


if __name__ == "__main__":
    sys.exit(main())
