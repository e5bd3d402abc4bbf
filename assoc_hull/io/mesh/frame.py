"""Ship axes of a mesh: unit, axes, which side is up, where the bow is, heel and yaw taken out.

Ship axes are x forward, y to port, z up, m at full scale. Whatever is found rather than given is
reported, and called doubtful where more than one choice remains. Axes are tried in this order:
length, then breadth (where the hull mirrors or is cut), what is left is height; then up, then the
bow.

The change of axes from a file to the ship: axes exchanged or mirrored, and a shift.

A whole hull that lies heeled or yawed in its file: found by its plane of symmetry, and turned.

A surface that mirrors in a plane has the normal of that plane for a principal axis, whatever its
form; which plane it is the surface itself tells, by how well it mirrors there.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.arguments import positive, word
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.surfaces.triangles import Triangles, boundary_edges
from assoc_hull.io.reports import Notebook

__all__ = [
    "AxisChange",
    "Tilt",
    "axes_rows",
    "find_columns",
    "find_tilt",
    "half_side",
    "levelled",
    "mirror_error",
    "place_mesh",
    "refuse_tilt",
    "scale_mesh",
]


@attrs.frozen(eq=False)
class AxisChange:
    """From the file to the ship: ``xyz @ turn + shift``; `turn` exchanges and mirrors axes."""

    turn: FloatArray
    shift: FloatArray

    @classmethod
    def between(cls, before: FloatArray, after: FloatArray) -> AxisChange:
        """Find the change that took vertices (n, 3), m, from one place to another."""
        middle = before.mean(axis=0)
        # Turns are by right angles, so that entries are -1, 0 or 1 but for rounding.
        turn = np.rint(np.linalg.lstsq(before - middle, after - after.mean(axis=0))[0])
        return cls(turn + 0.0, np.median(after - before @ turn, axis=0))

    def back(self, xyz: FloatArray) -> FloatArray:
        """Give points in ship axes, (n, 3), m, in axes of the file."""
        return np.asarray((xyz - self.shift) @ self.turn.T)

    def ahead(self, xyz: FloatArray) -> FloatArray:
        """Give points in axes of the file, (n, 3), m, in ship axes."""
        return np.asarray(xyz @ self.turn + self.shift)

    def plane(self, axis: IntArray, offset: FloatArray) -> tuple[IntArray, FloatArray]:
        """Give axis and offset (m) in the file of planes across axes of the ship."""
        column = np.abs(self.turn).argmax(axis=0)
        sign = self.turn[column, np.arange(3)]
        return column[axis], (offset - self.shift[axis]) * sign[axis]


_WHERE = "the mesh"

_WORST = 0.02
"""A hull that is farther from mirroring, as a part of its length, has no centre plane."""

_PAST_SIDE = 1e-3
"""The surface of half a hull may pass its centre plane by this part of its length."""

_PLATED = 0.02
"""Plating of more than this part of all, in the plane of an open edge, is a side of the hull."""

_ALIKE = 1e-3
"""Ends that mirror but for this part of the length are one as good as the other."""

_LONGEST, _SHORTEST = 600.0, 1.0  # m, of a ship at full scale
_USUAL = {"L/B": (1.5, 40.0), "L/D": (3.0, 80.0), "B/D": (0.4, 12.0)}
"""Length over breadth and depth of anything that floats as a ship, from barge to rowing eight."""

_KEEL_UP = 1.05
"""A hull whose lower half holds more than this many times its upper half lies keel up."""

_UNITS = {"m": 1.0, "mm": 1e-3, "cm": 1e-2, "ft": 0.3048, "in": 0.0254}

# --------------------------------------------------------------------------------------
# Axes. The length is the longest. The breadth is the axis in which the hull mirrors, or across
# which half a hull is cut.


def find_columns(mesh: Triangles, book: Notebook) -> tuple[int, int, int]:
    """Give the columns (0, 1, 2) of length, breadth and height.

    Raises
    ------
    BadInputError
        The hull mirrors in no axis, and is not cut across one.
    """
    x = int(np.argmax(np.ptp(mesh.xyz, axis=0)))
    others = [axis for axis in range(3) if axis != x]
    tried = 1 if x != 1 else others[0]
    y, why, sure = _find_breadth(mesh, x, tried, next(a for a in others if a != tried))
    z = next(axis for axis in others if axis != y)
    names = "".join("xyz"[axis] for axis in (x, y, z))
    said = f"length along {names[0]}, breadth along {names[1]}, height along {names[2]} of the file"
    if (x, y, z) == (0, 1, 2):
        book.assume("axes", _WHERE, f"{said}, because x is longest and {why}")
    else:
        book.repair("axes", _WHERE, f"{said}; turned into ship axes")
    if not sure:
        what = f"{said}, because {why}; another choice is possible: give axes=, such as '+x+y+z'"
        book.suspect("axes doubtful", _WHERE, what)
    return x, y, z


def _find_breadth(mesh: Triangles, x: int, tried: int, other: int) -> tuple[int, str, bool]:
    """Give the axis of breadth, why, and whether that is clear; `tried` is the usual one."""
    mirrors = [axis for axis in (tried, other) if _is_mirrored(mesh, axis)]
    sides = {axis: half_side(mesh, axis) for axis in (tried, other)}
    open_there = [axis for axis in (tried, other) if sides[axis] is not None]
    if mirrors:
        best = mirrors[0]
        cut = other if best == tried else tried
        side = None if cut in mirrors else sides[cut]
        y, why = _mirror_or_cut(mesh, best, cut, side)
        return y, why, y == tried == best or side is None
    if len(open_there) == 2:
        return _centre_axis(mesh, x, tried, other)
    if open_there == [tried]:
        return tried, f"half a hull is cut across {'xyz'[tried]}", True
    if open_there:
        return _cut_or_deck(mesh, tried, other)
    return _nearest_mirror(mesh, tried, other)


def _is_mirrored(mesh: Triangles, axis: int) -> bool:
    """Tell whether both the surface and its open edges mirror in an axis."""
    size = np.ptp(mesh.xyz, axis=0)
    if mirror_error(mesh, axis) * size.max() > 0.02 * size[axis]:
        return False
    rim = boundary_edges(mesh)
    if not len(rim):
        return True
    ends = mesh.xyz[rim]
    length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    balance = float((ends[:, :, axis].mean(axis=1) * length).sum() / length.sum())
    middle = 0.5 * float(mesh.xyz[:, axis].min() + mesh.xyz[:, axis].max())
    return abs(balance - middle) < 0.05 * float(size[axis])


def _mirror_or_cut(mesh: Triangles, mirror: int, cut: int, side: float | None) -> tuple[int, str]:
    """Tell a whole hull with an open deck from half of one that is alike above and below.

    Both mirror in one axis and are open at one side across another: the deck of the one, the centre
    plane of the other. What lies at zero of the file is the centre plane.
    """
    mirrors = f"{'xyz'[mirror]} mirrors"
    if side is None:
        return mirror, mirrors
    size = float(np.ptp(mesh.xyz, axis=0).max())
    middle = 0.5 * float(mesh.xyz[:, mirror].min() + mesh.xyz[:, mirror].max())
    if abs(side) < 1e-3 * size < abs(middle):
        return cut, f"half a hull is cut at {'xyz'[cut]} = 0"
    return mirror, f"{mirrors} and the opening across {'xyz'[cut]} may be the deck"


def _centre_axis(mesh: Triangles, x: int, tried: int, other: int) -> tuple[int, str, bool]:
    """Tell the centre plane of a half hull from its open deck: the keel is straighter."""
    share = {axis: _straight_share(mesh, x, axis, away)
             for axis, away in ((tried, other), (other, tried))}  # fmt: skip
    gain = share[other] - share[tried]
    best = other if gain > 0.05 else tried
    why = f"half a hull is cut across {'xyz'[best]}, where its edge is straighter"
    return best, why, best == tried or gain > 0.15


def _cut_or_deck(mesh: Triangles, tried: int, other: int) -> tuple[int, str, bool]:
    """Tell the centre plane of a half hull from the open deck of one without a bottom.

    The edge of half a hull in its centre plane closes in itself; that of a half deck does not.
    """
    cut = f"half a hull is cut across {'xyz'[other]}"
    if _closes(mesh, other):
        return other, cut, True
    size = float(np.ptp(mesh.xyz, axis=0).max())
    low, high = float(mesh.xyz[:, tried].min()), float(mesh.xyz[:, tried].max())
    if min(abs(low), abs(high)) < 1e-3 * size:
        return tried, f"half a hull lies beside {'xyz'[tried]} = 0", False
    return other, f"{cut}, or its deck is open there", False


def _closes(mesh: Triangles, axis: int) -> bool:
    """Tell whether the open edge in the side across an axis is a ring."""
    rim, side = boundary_edges(mesh), half_side(mesh, axis)
    if side is None:
        return False
    size = float(np.ptp(mesh.xyz, axis=0).max())
    on = (np.abs(mesh.xyz[rim][:, :, axis] - side) < 1e-5 * size).all(axis=1)
    return bool((np.unique(rim[on], return_counts=True)[1] % 2 == 0).all())


def _nearest_mirror(mesh: Triangles, tried: int, other: int) -> tuple[int, str, bool]:
    """Take the axis in which the hull comes closest to mirroring."""
    offs = {axis: mirror_error(mesh, axis) for axis in (tried, other)}
    y = other if offs[tried] > 2.0 * offs[other] + 1e-3 else tried
    if offs[y] > _WORST:
        raise BadInputError(
            f"no side of the mesh mirrors the other (best: {1e2 * offs[y]:.3g} % of the length "
            "off)", f"in {_WHERE}", "give axes=, such as '+x+y+z'",
        )  # fmt: skip
    return y, f"{'xyz'[y]} mirrors but for {1e2 * offs[y]:.2g} % of the length", y == tried


def _straight_share(mesh: Triangles, x: int, axis: int, other: int) -> float:
    """Give the part of the length on which the edge in one open plane lies far from the other."""
    rim, size = boundary_edges(mesh), np.ptp(mesh.xyz, axis=0)
    plane, away = half_side(mesh, axis), half_side(mesh, other)
    middle = mesh.xyz[rim].mean(axis=1)
    step = np.abs(np.diff(mesh.xyz[rim], axis=1)[:, 0, x])
    on = np.abs(middle[:, axis] - plane) < 1e-5 * size.max()
    far = np.abs(middle[:, other] - away) > 0.98 * size[other]
    return float(step[on & far].sum() / size[x])


_BESIDE = 0.02
"""Vertices nearer than this part of the length are found exactly, others among a few thousand."""


def mirror_error(mesh: Triangles, axis: int) -> float:
    """Give how far the mesh is from mirroring in an axis, as a part of its length."""
    from scipy.spatial import cKDTree

    size = float(np.ptp(mesh.xyz, axis=0).max())
    low, high = float(mesh.xyz[:, axis].min()), float(mesh.xyz[:, axis].max())
    middle = 0.5 * (low + high)
    step = max(1, len(mesh.xyz) // 4000)
    some = mesh.xyz[::step].copy()
    some[:, axis] = 2.0 * middle - some[:, axis]
    tree = cKDTree(mesh.xyz)
    away, found = tree.query(some, distance_upper_bound=_BESIDE * size)
    near, far = np.array(found), ~np.isfinite(away)
    # What lies far from all vertices lies nearly as far from many, and a search tries them all:
    # some of them will do.
    near[far] = step * cKDTree(mesh.xyz[::step]).query(some[far])[1]
    # Along the normal only: the other side may be triangulated at other points of the surface.
    away = np.abs(((some - mesh.xyz[near]) * _normals(mesh)[near]).sum(axis=1))
    return float(np.percentile(away, 90)) / size


def _normals(mesh: Triangles) -> FloatArray:
    """Give the mean normal at each vertex: two triangulations of one surface differ along it."""
    vectors = np.repeat(mesh.area_vectors()[:, None, :], 3, axis=1).reshape(-1, 3)
    number, count = mesh.face.ravel(), len(mesh.xyz)
    sums = np.stack([np.bincount(number, column, count) for column in vectors.T], axis=1)
    length = np.linalg.norm(sums, axis=1)
    return np.asarray(sums / np.maximum(length, 1e-300)[:, None])


def _weighted_median(values: FloatArray, weight: FloatArray) -> float:
    """Give the value below which half of the weight lies."""
    order = np.argsort(values, kind="stable")
    part = np.cumsum(weight[order])
    return float(values[order[int(np.searchsorted(part, 0.5 * part[-1]))]])


def _is_plated(mesh: Triangles, axis: int, side: float) -> bool:
    """Tell whether the hull has plating in the plane across an axis."""
    size = float(np.ptp(mesh.xyz, axis=0).max())
    flat = (np.abs(mesh.corners[:, :, axis] - side) < 1e-5 * size).all(axis=1)
    area = np.linalg.norm(mesh.area_vectors(), axis=1)
    return bool(area[flat].sum() > _PLATED * area.sum())


def half_side(mesh: Triangles, axis: int) -> float | None:
    """Give the place of the centre plane if this is a half hull cut across an axis."""
    rim = boundary_edges(mesh)
    if not len(rim):
        return None
    size = float(np.ptp(mesh.xyz, axis=0).max())
    values = mesh.xyz[rim][:, :, axis]
    length = np.linalg.norm(np.diff(mesh.xyz[rim], axis=1)[:, 0], axis=1)
    for outmost in (float(mesh.xyz[:, axis].min()), float(mesh.xyz[:, axis].max())):
        # A surface may pass its centre plane a little: the plane is where most of the edge lies.
        close = (np.abs(values - outmost) < _PAST_SIDE * size).all(axis=1)
        if not close.any():
            continue
        side = _weighted_median(values[close].mean(axis=1), length[close])
        on = (np.abs(values - side) < 1e-5 * size).all(axis=1)
        span = np.ptp(mesh.xyz[rim[on]].reshape(-1, 3), axis=0) if on.any() else np.zeros(3)
        across = [other for other in range(3) if other != axis]
        whole = np.ptp(mesh.xyz, axis=0)
        # A transom or a hatch is open too: the edge of a half hull spans its whole side.
        filled = all(span[other] > 0.8 * whole[other] for other in across)
        cut = filled and length[on].sum() > 0.15 * length.sum()
        # The upright side of an open barge has such an edge, too, and is itself in its plane.
        if cut and not _is_plated(mesh, axis, side):
            return float(np.median(values[on]))
    return None


# --------------------------------------------------------------------------------------
# Placing: unit, centre plane, up, bow; x and z keep the origin of the file.


def scale_mesh(mesh: Triangles, scale: float, unit: str, book: Notebook) -> Triangles:
    """Give the mesh at full scale in m; `scale` is full scale over that of the file.

    `unit` "auto" is metres, or millimetres where metres would give a ship of more than 600 m.

    Raises
    ------
    BadInputError
        A scale that is not positive, an unknown unit, or a ship longer than 600 m or shorter
        than 1 m.
    """
    scale = positive(scale, "scale", "as an argument")
    if word(unit, "unit", "as an argument") != "auto" and unit not in _UNITS:
        raise BadInputError(f"the unit {unit!r} is unknown", "the argument unit", _known_units())
    size = float(np.ptp(mesh.xyz, axis=0).max()) * scale
    chosen = unit if unit != "auto" else _find_unit(size, book)
    length = size * _UNITS[chosen]
    if not length <= _LONGEST:
        raise BadInputError(
            f"the mesh is {length:.6g} m long in {chosen} at scale {scale:g}", f"in {_WHERE}",
            "are these millimetres? give unit='mm', or another scale",
        )  # fmt: skip
    if length < _SHORTEST:
        raise BadInputError(
            f"the mesh is only {length:.4g} m long in {chosen} at scale {scale:g}", f"in {_WHERE}",
            "are these metres? give unit='m', or the scale of the model",
        )  # fmt: skip
    return mesh.moved(mesh.xyz * (scale * _UNITS[chosen]))


def _known_units() -> str:
    return "give one of " + ", ".join(map(repr, ("auto", *_UNITS)))


def _find_unit(size: float, book: Notebook) -> str:
    chosen = "mm" if size > _LONGEST and size * 1e-3 <= _LONGEST else "m"
    why = f"the longest side is {size:.6g} units at full scale"
    book.assume("unit", _WHERE, f"{chosen}, because {why}", size)
    return chosen


Ends = tuple[float | None, float | None]
"""AP and FP along the length of the file, m at full scale, None where they are not given."""


def place_mesh(
    mesh: Triangles, axes: str, book: Notebook, doubt: float = 0.0, ends: Ends = (None, None)
) -> Triangles:
    """Turn a mesh (m, all triangles outward) into ship axes, centre plane at y = 0.

    `axes` is "auto", or which axes of the file are x, y and z, each with a sign: ``"-x-y+z"`` for a
    bow at negative x, ``"+x-z+y"`` for y up. `doubt` (m) is how far vertices may be off what they
    stand for: a centre plane nearer to y = 0 than that is there. `ends` that are given tell where
    the bow is, whatever the shape.

    Raises
    ------
    BadInputError
        Unknown axes, or a mesh whose axes cannot be found.
    """
    if word(axes, "axes", "as an argument") != "auto":
        placed = _centred(_turned(mesh, axes_rows(axes)), book, doubt)
        if ends == (None, None):
            _tell_bow(placed, axes, book)
    else:
        moved = _turned(mesh, np.eye(3)[list(find_columns(mesh, book))])
        moved = _upright(_centred(moved, book, doubt), book)
        told = _told_bow(moved, ends)
        placed = _bow_forward(mesh, moved, book) if told == 0.0 else _as_told(moved, told, book)
    _report_proportions(placed, book)
    return placed


def axes_rows(axes: str) -> FloatArray:
    """Give the rows (3, 3) by which points of the file become x forward, y to port and z up.

    Raises
    ------
    BadInputError
        Anything but three axes, each with a sign.
    """
    text = axes.replace(" ", "").replace(",", "").lower()
    parts = [text[i : i + 2] for i in range(0, len(text), 2)]
    good = len(text) == 6 and all(p[0] in "+-" and p[1] in "xyz" for p in parts)
    if not good or {p[1] for p in parts} != set("xyz"):
        raise BadInputError(
            f"axes are {axes!r}", "the argument axes", "give 'auto', or such as '+x+y+z', '-x-y+z'"
        )
    rows = [(1.0 if p[0] == "+" else -1.0) * np.eye(3)["xyz".index(p[1])] for p in parts]
    return np.array(rows)


def _turned(mesh: Triangles, turn: FloatArray) -> Triangles:
    """Turn the points; a reflection reverses the triangles, so that they stay outward."""
    xyz = np.stack([(mesh.xyz * row).sum(axis=1) for row in turn], axis=1) + 0.0
    face = mesh.face if np.linalg.det(turn) > 0.0 else mesh.face[:, ::-1].copy()
    return Triangles(xyz, face, mesh.origin)


def _centred(mesh: Triangles, book: Notebook, doubt: float) -> Triangles:
    """Put the centre plane at y = 0, a half hull at positive y."""
    size = float(np.ptp(mesh.xyz, axis=0).max())
    low, high = float(mesh.xyz[:, 1].min()), float(mesh.xyz[:, 1].max())
    side = half_side(mesh, 1)
    if side is None and min(-low, high) < 0.02 * (high - low) and abs(low + high) > 1e-6 * size:
        side = low if abs(low) < abs(high) else high
        side = 0.0 if abs(side) < 1e-3 * size else None
    middle = side if side is not None else 0.5 * (low + high)
    xyz = mesh.xyz.copy()
    if abs(middle) > max(1e-6 * size, doubt if side is None else 0.0):
        book.repair("centre plane", _WHERE, f"moved from y = {middle:.6g} m to 0", middle)
        xyz[:, 1] -= middle
    elif side is None:
        _report_asymmetry(mesh, size, book)
    moved = mesh.moved(xyz)
    if _is_starboard(moved):
        book.repair("mirrored", _WHERE, "the half at negative y was mirrored to port")
    kind = "half" if side is not None else "whole"
    book.assume("half or whole", _WHERE, f"the mesh is a {kind} hull")
    return _to_port(moved)


def _is_starboard(mesh: Triangles) -> bool:
    """Tell whether this is half a hull, at negative y."""
    return float(mesh.xyz[:, 1].max()) < 1e-3 * float(np.ptp(mesh.xyz, axis=0).max())


def _to_port(mesh: Triangles) -> Triangles:
    return _turned(mesh, np.diag([1.0, -1.0, 1.0])) if _is_starboard(mesh) else mesh


def _report_asymmetry(mesh: Triangles, size: float, book: Notebook) -> None:
    off = mirror_error(mesh, 1)
    if off > 1e-3:
        what = f"the halves differ by {off * size:.3g} m at one vertex of ten; port is taken"
        book.suspect("asymmetry", _WHERE, what, off * size)


def _report_proportions(mesh: Triangles, book: Notebook) -> None:
    """Report a hull that no ship is like: a unit or scale that differs between the axes."""
    half, (length, _, depth) = float(mesh.xyz[:, 1].max()), np.ptp(mesh.xyz, axis=0).tolist()
    flat = [name for name, size in zip("xyz", (length, half, depth), strict=True) if not size > 0.0]
    if flat:
        raise BadInputError(
            f"the mesh is flat: it has no extent along {' and '.join(flat)}", f"in {_WHERE}",
            "export the whole hull, or give axes=, as '+x+y+z'",
        )  # fmt: skip
    ratios = {"L/B": 0.5 * length / half, "L/D": length / depth, "B/D": 2.0 * half / depth}
    odd = [
        f"{name} is {ratio:.3g}"
        for name, ratio in ratios.items()
        if not _USUAL[name][0] <= ratio <= _USUAL[name][1]
    ]
    if odd:
        what = f"{', '.join(odd)}: check unit and scale of each axis, or give axes="
        book.suspect("proportions", _WHERE, what)


def _upright(mesh: Triangles, book: Notebook) -> Triangles:
    """Turn a hull that lies keel up: its lower half holds more than its upper half."""
    lower, upper = _half_volumes(mesh)
    if lower > _KEEL_UP * upper:
        more = lower / max(upper, 1e-9)
        what = (
            f"its half at low z holds {more:.3g} times its half at high z; turned about its length"
        )
        book.repair("upside down", _WHERE, what)
        return _to_port(_turned(mesh, np.diag([1.0, -1.0, -1.0])))
    return mesh


def _half_volumes(mesh: Triangles) -> tuple[float, float]:
    """Give what the lower and the upper half of the depth amidships hold between the sides, m3.

    Sheer, bulb and dome lie above and below and do not count; neither deck nor bottom is needed.
    """
    centre, x = mesh.corners.mean(axis=1), mesh.xyz[:, 0]
    middle = np.abs(x - 0.5 * (x.min() + x.max())) <= 0.1 * np.ptp(x)
    z = mesh.xyz[middle if middle.any() else slice(None), 2]
    half = 0.5 * float(np.ptp(z))
    level = (centre[:, 2] - float(z.min())) / max(half, 1e-12)
    held = np.abs(centre[:, 1] * mesh.area_vectors()[:, 1])
    lower = float(held[(level >= 0.0) & (level < 1.0)].sum())
    return lower, float(held[(level >= 1.0) & (level <= 2.0)].sum())


_BROADER = 0.15
"""Part of the half-breadth: an end that is broader near the deck by so much is a stern."""


def _tell_bow(mesh: Triangles, axes: str, book: Notebook) -> None:
    """Suspect axes as given where the end that lies forward is the broader one."""
    aft, fore = (_end_breadth(mesh, end) for end in (0.05, -0.05))
    if fore - aft > _BROADER * float(np.abs(mesh.xyz[:, 1]).max()):
        what = (
            f"with axes={axes!r} the fore end is {2.0 * fore:.4g} m broad near the deck, the aft "
            f"end {2.0 * aft:.4g} m: if that is the stern turn the signs of x and y, if not "
            "origin=, or ap= with fp=, says so"
        )
        book.suspect("bow", _WHERE, what, fore - aft)


_AT_END = 0.35
"""A perpendicular within this part of the length of an end is at that end."""


def _told_bow(mesh: Triangles, ends: Ends) -> float:
    """Give 1 if the perpendiculars that are given put the bow at high x, -1 at low x, else 0."""
    ap, fp = ends
    if ap is not None and fp is not None:
        return float(np.sign(fp - ap))
    low, size = float(mesh.xyz[:, 0].min()), float(np.ptp(mesh.xyz[:, 0]))
    for x, sign in ((ap, -1.0), (fp, 1.0)):
        if x is not None:
            part = (x - low) / size
            return sign * (float(part > 1.0 - _AT_END) - float(part < _AT_END))
    return 0.0


def _as_told(mesh: Triangles, told: float, book: Notebook) -> Triangles:
    """Bring the bow to where the given perpendiculars have it; the shape is not asked."""
    if told > 0.0:
        book.assume("bow", _WHERE, "at high x, by the perpendiculars given")
        return mesh
    what = "the bow was at low x, by the perpendiculars given; turned"
    book.repair("bow at negative x", _WHERE, what)
    return _end_for_end(mesh)


def _end_for_end(mesh: Triangles) -> Triangles:
    return _to_port(_turned(mesh, np.diag([-1.0, -1.0, 1.0])))


def _bow_forward(mesh: Triangles, upright: Triangles, book: Notebook) -> Triangles:
    """Turn a hull whose bow is at low x: the stern is by far the broader end near the deck.

    `mesh` is the hull as in the file. Ends that differ less are no evidence against the file.
    """
    aft, fore = (_end_breadth(upright, end) for end in (0.05, -0.05))
    least = _BROADER * float(np.abs(upright.xyz[:, 1]).max())
    seen = f"near the deck the half-breadth is {aft:.4g} m at low x, {fore:.4g} m at high x"
    stay, turn = (_axes_text(mesh, each) for each in (upright, _end_for_end(upright)))
    settle = f"axes={stay!r} puts the bow at high x, axes={turn!r} at low x, and origin= tells, too"
    if aft - fore > least:
        what = f"at high x: near the deck half-breadth {fore:.4g} m there, {aft:.4g} m at low x"
        book.assume("bow", _WHERE, what, aft - fore)
    elif fore - aft > least:
        book.repair("bow at negative x", _WHERE, (
            f"the bow was at low x (half-breadth {aft:.4g} m there, {fore:.4g} m at high x); turned"
        ), fore - aft)  # fmt: skip
        what = f"turned end for end, since {seen}, and a stern is the broader end"
        book.suspect("bow", _WHERE, f"{what}: {settle}", fore - aft)
        return _end_for_end(upright)
    elif mirror_error(upright, 0) > _ALIKE:
        # LCB lies on the wrong side of midship if the bow is at the other end.
        what = f"taken at high x, as in the file, but {seen}, which tells little"
        book.suspect("bow", _WHERE, f"{what}: {settle}", fore - aft)
    else:
        book.assume("bow", _WHERE, "the ends are alike; the bow is taken at high x")
    return upright


def _axes_text(mesh: Triangles, placed: Triangles) -> str:
    """Write the axes= that take a mesh as in the file to where it was placed."""
    turn = AxisChange.between(mesh.xyz, placed.xyz).turn
    at = np.abs(turn).argmax(axis=0).tolist()
    return "".join(("-" if turn[row, i] < 0.0 else "+") + "xyz"[row] for i, row in enumerate(at))


def _end_breadth(mesh: Triangles, end: float) -> float:
    """Give the half-breadth (m) of the upper half of the hull near one end.

    `end` is the part of the length from aft that counts, if positive, else from forward.
    """
    x, z = mesh.xyz[:, 0], mesh.xyz[:, 2]
    size = float(np.ptp(x))
    close = x < x.min() + end * size if end > 0.0 else x > x.max() + end * size
    high = z > 0.5 * (z.min() + z.max())
    chosen = close & high
    return float(np.abs(mesh.xyz[chosen, 1]).max()) if chosen.any() else 0.0


_LEAST, _MOST = 0.02, 15.0
"""Degrees by which a plane of symmetry may be off that of the file to be looked at."""

_OFF = 5e-5
"""A hull farther from mirroring in axes of its file, in parts of its length, may be tilted."""

_BETTER = 0.2
"""About its own plane a tilted hull mirrors with less than this part of that error."""


@attrs.frozen(eq=False)
class Tilt:
    """How a hull lies in its file: `turn` (3, 3) brings points there to upright about `pivot`, m.

    `words` tell the angles.
    """

    turn: FloatArray
    pivot: FloatArray
    words: str

    def upright(self, xyz: FloatArray) -> FloatArray:
        """Give points (n, 3), m, turned upright."""
        return np.asarray((xyz - self.pivot) @ self.turn.T + self.pivot)


def find_tilt(mesh: Triangles) -> Tilt | None:
    """Find by how much a whole hull (m) is heeled or yawed; None where it is not."""
    corner = mesh.corners
    area = np.linalg.norm(mesh.area_vectors(), axis=1)
    if not area.sum() > 0.0:
        return None
    centroid = np.asarray((corner.mean(axis=1) * area[:, None]).sum(axis=0) / area.sum())
    normals = np.linalg.eigh(_second_moments(corner - centroid, area))[1].T
    long = int(np.ptp(mesh.xyz, axis=0).argmax())
    for axis in range(3):
        if axis == long:
            continue
        normal = normals[int(np.abs(normals[:, axis]).argmax())]
        normal = normal * np.sign(normal[axis])
        angle = float(np.degrees(np.arccos(min(1.0, normal[axis]))))
        if not _LEAST < angle < _MOST:
            continue
        tilt = _tilt(normal, centroid, axis, long)
        off = mirror_error(mesh, axis)
        if off > _OFF and mirror_error(mesh.moved(tilt.upright(mesh.xyz)), axis) < _BETTER * off:
            return tilt
    return None


def _second_moments(corner: FloatArray, area: FloatArray) -> FloatArray:
    """Give the integrals of x_i x_j over triangles (n, 3, 3), exactly."""
    sums = corner.sum(axis=1)
    each = np.einsum("nki,nkj->nij", corner, corner) + sums[:, :, None] * sums[:, None, :]
    return np.asarray((area[:, None, None] * each).sum(axis=0) / 12.0)


def _tilt(normal: FloatArray, centroid: FloatArray, axis: int, long: int) -> Tilt:
    """Turn a plane's normal into an axis of the file, about where the plane cuts that axis."""
    target = np.eye(3)[axis]
    about = np.cross(normal, target)
    sine, cosine = float(np.linalg.norm(about)), float(normal @ target)
    k = about / max(sine, 1e-300)
    cross = np.array([[0.0, -k[2], k[1]], [k[2], 0.0, -k[0]], [-k[1], k[0], 0.0]])
    turn = np.eye(3) + sine * cross + (1.0 - cosine) * (cross @ cross)
    pivot = target * float(normal @ centroid) / cosine
    up = 3 - axis - long
    told = [
        f"{name} by {abs(angle):.3g} degrees"
        for name, angle in (
            ("heeled", float(np.degrees(np.arctan2(normal[up], normal[axis])))),
            ("yawed", float(np.degrees(np.arctan2(normal[long], normal[axis])))),
        )
        if abs(angle) > _LEAST
    ]
    return Tilt(turn, pivot, " and ".join(told))


def levelled(mesh: Triangles, book: Notebook) -> Triangles:
    """Turn a whole hull that lies heeled or yawed in its file upright, and tell it."""
    tilt = find_tilt(mesh)
    if tilt is None:
        return mesh
    x, y, z = (float(v) for v in tilt.pivot)
    what = (
        f"the hull lies {tilt.words} in the file, by its plane of symmetry; turned upright about "
        f"({x:.4g}, {y:.4g}, {z:.4g}) m: places that are given count after that"
    )
    book.repair("tilt", _WHERE, what)
    return mesh.moved(tilt.upright(mesh.xyz))


def refuse_tilt(mesh: Triangles, where: str) -> None:
    """Refuse a hull that lies heeled or yawed in its file, where its surfaces would have to turn.

    Raises
    ------
    BadInputError
        It lies so.
    """
    tilt = find_tilt(mesh)
    if tilt is not None:
        raise BadInputError(
            f"the hull lies {tilt.words} in the file, by its plane of symmetry", f"in {where}",
            "turn it upright where it was made, or export a mesh, which is turned here",
        )  # fmt: skip
