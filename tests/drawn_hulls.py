"""Small hulls of straight lines, written as a designer gives them: a table of points by line."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

import assoc_hull as ah

Place = tuple[float, float, float]

LENGTH, HALF, DEPTH = 60.0, 6.0, 4.0
"""Of the barges; m."""


def drawn(places: Sequence[Place], count: int = 41) -> np.ndarray:
    """Give points at equal steps along straight sides, and every corner, (n, 3)."""
    corner = np.array(places, float)
    along = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(corner, axis=0), axis=1))]
    at = np.unique(np.r_[np.linspace(0.0, along[-1], count), along])
    return np.column_stack([np.interp(at, along, corner[:, k]) for k in range(3)])


def written(lines: Sequence[tuple[str, Sequence[Place]]], path: Path) -> Path:
    """Write lines to a CSV file."""
    rows = [
        f"{name},{x:.5f},{y:.5f},{z:.5f}" for name, at in lines for x, y, z in drawn(at).tolist()
    ]
    path.write_text("\n".join(["line,x,y,z", *rows, ""]))
    return path


def frame(x: float, keel: float = 0.0) -> list[Place]:
    """Give the half section of a barge."""
    return [(x, 0.0, keel), (x, HALF, keel), (x, HALF, DEPTH)]


def box_barge(path: Path) -> ah.Hull:
    """Read a box of 60 x 12 x 4 m with plumb ends, the first station 5 m from each; 2.5 m deep."""
    lines = [(f"ST {x}", frame(x)) for x in (5.0, 10.0, 20.0, 30.0, 40.0, 50.0, 55.0)]
    lines += [
        ("profile", [(0.0, 0.0, 0.0), (LENGTH, 0.0, 0.0)]),
        ("deck edge", [(0.0, HALF, DEPTH), (LENGTH, HALF, DEPTH)]),
        ("transom", frame(0.0)), ("bow end", frame(LENGTH)),
    ]  # fmt: skip
    return ah.read(written(lines, path / "box.csv"), draught=2.5, ap=0.0, deck="closed")


def transom_boat(path: Path) -> ah.Hull:
    """Read a boat of 24 m with one chine, and a plumb transom that the chine runs into."""

    def half(x: float) -> float:
        return 2.6 * (1.0 - max(0.0, (x - 8.0) / 16.0) ** 2)

    def keel(x: float) -> float:
        return 1.6 * max(0.0, (x - 12.0) / 12.0) ** 2

    def deck(x: float) -> Place:
        return x, half(x) + 0.3 * (1.0 - (x / 24.0) ** 2), 2.6

    def rib(x: float) -> list[Place]:
        chine = 0.7 + 0.9 * max(0.0, (x - 8.0) / 16.0)
        return [(x, 0.0, keel(x)), (x, half(x), chine), deck(x)]

    along = np.linspace(0.0, 24.0, 121).tolist()
    stations = (1.5, 3.0, 5.0, 7.0, 9.0, 11.0, 13.0, 15.0, 16.5, 18.0, 19.5, 21.0, 22.3)
    lines: list[tuple[str, list[Place]]] = [(f"ST {x:g}", rib(x)) for x in stations]
    lines += [
        ("profile", [*((x, 0.0, keel(x)) for x in along), (24.0, 0.0, 2.6)]),
        ("deck edge", [deck(x) for x in along]),
        ("transom", rib(0.0)),
    ]
    return ah.read(
        written(lines, path / "boat.csv"), draught=1.0, ap=0.0, deck="closed", accept=True
    )


def raked_barge(path: Path) -> ah.Hull:
    """Read a barge with raked ends, that turn at x = 6 and 50 m; few stations beside these."""

    def keel(x: float) -> float:
        return 4.0 * max(0.0, (6.0 - x) / 6.0, (x - 50.0) / 10.0)

    stations = (2.5, 3.5, 4.5, 6.0, 8.0, 10.0, 20.0, 30.0, 40.0, 46.0, 50.0, 52.0, 54.0, 56.0)
    lines = [(f"ST {x:g}", frame(x, keel(x))) for x in stations]
    lines += [
        ("profile", [(x, 0.0, keel(x)) for x in (1.5, 6.0, 50.0, 57.5)]),
        ("deck edge", [(1.5, HALF, DEPTH), (57.5, HALF, DEPTH)]),
        ("transom", frame(1.5, 3.0)), ("bow end", frame(57.5, 3.0)),
    ]  # fmt: skip
    return ah.read(written(lines, path / "raked.csv"), draught=2.5, ap=0.0, deck="closed")


def ro_pax(path: Path) -> ah.Hull:
    """Read a ship of 121 m with round bilges, and a knuckle from the transom to the raked stem.

    Below it frames are superellipses, upright at the knuckle, above it they flare. Waterlines
    at 0.7, 1.5, 3 and 5 m.
    """

    def part(x: float, begin: float, end: float) -> float:
        return float(np.clip((x - begin) / (end - begin), 0.0, 1.0))

    def keel(x: float) -> float:
        return 4.0 * part(x, 30.0, 0.0) ** 2 + 7.0 * part(x, 108.0, 118.0) ** 2

    def knuckle(x: float) -> Place:
        aft, fore = part(x, 30.0, 0.0), part(x, 65.0, 118.0)
        return x, 10.0 - 1.5 * aft**2 - 10.0 * fore**2.2, 7.0

    def deck(x: float) -> Place:
        return x, 12.0 - 1.5 * part(x, 30.0, 0.0) ** 2 - 12.0 * part(x, 70.0, 121.0) ** 2.6, 11.0

    def power_of(x: float) -> float:
        return 5.0 - 2.8 * part(x, 60.0, 118.0)

    def level(z: float) -> list[Place]:
        begin = 30.0 * (1.0 - min(z / 4.0, 1.0) ** 0.5)
        places = []
        for x in np.linspace(begin, 108.0 + 10.0 * (z / 7.0) ** 0.5, 241).tolist():
            low, (_, half, top) = keel(x), knuckle(x)
            down, power = min((top - z) / (top - low), 1.0), power_of(x)
            places.append((x, half * float(1.0 - down**power) ** (1.0 / power), z))
        return places

    def rib(x: float) -> list[Place]:
        low, (_, half, top) = keel(x), knuckle(x)
        power = power_of(x)
        # Even steps of the breadth up to the middle of the bilge, of the height beyond.
        even = np.linspace(0.0, 0.5 ** (1.0 / power), 31)
        other = (1.0 - even**power) ** (1.0 / power)
        across, down = np.r_[even, other[-2::-1]], np.r_[other, even[-2::-1]]
        at = zip((half * across).tolist(), (top - (top - low) * down).tolist(), strict=True)
        return [*((x, y, z) for y, z in at), deck(x)]

    stations = [2.0, 5.0, 9.0, 14.0, *np.arange(20.0, 96.0, 5.0).tolist()]
    stations += [100.0, 104.0, 108.0, 111.0, 113.5, 115.5]
    stem = [(float(x), 0.0, keel(float(x))) for x in np.linspace(108.0, 118.0, 41)]
    stern = [(float(x), 0.0, keel(float(x))) for x in np.linspace(0.0, 30.0, 61)]
    lines: list[tuple[str, list[Place]]] = [(f"ST {x:g}", rib(x)) for x in stations]
    lines += [(f"WL {z:g}", level(z)) for z in (0.7, 1.5, 3.0, 5.0)]
    lines += [
        ("profile", [*stern, *stem, (121.0, 0.0, 11.0)]),
        ("deck edge", [deck(float(x)) for x in np.linspace(0.0, 121.0, 243)]),
        ("transom", rib(0.0)),
    ]
    return ah.read(
        written(lines, path / "ropax.csv"), draught=5.0, ap=0.0, deck="closed", accept=True
    )


def half_chined(path: Path) -> ah.Hull:
    """Read a hull of 60 m with flat ends: round frames aft, forward frames with a chine."""
    turn = np.linspace(0.0, 0.5 * np.pi, 25)

    def rib(x: float) -> list[Place]:
        if x > 25.0:
            return [(x, 0.0, 0.0), (x, HALF - 1.0, 1.0), (x, HALF, DEPTH)]
        way = zip(np.sin(turn) ** 0.5, 1.0 - np.cos(turn) ** 0.5, strict=True)
        return [(x, float(HALF * y), float(DEPTH * z)) for y, z in way]

    lines = [(f"ST {x:g}", rib(x)) for x in (5.0, 10.0, 15.0, 20.0, 30.0, 35.0, 40.0, 50.0, 55.0)]
    lines += [
        ("profile", [(0.0, 0.0, 0.0), (LENGTH, 0.0, 0.0)]),
        ("deck edge", [(0.0, HALF, DEPTH), (LENGTH, HALF, DEPTH)]),
        ("transom", rib(0.0)), ("bow end", rib(LENGTH)),
    ]  # fmt: skip
    return ah.read(
        written(lines, path / "half.csv"), draught=2.5, ap=0.0, deck="closed", accept=True
    )


def sharpie(path: Path) -> ah.Hull:
    """Read a double-ended boat of 12 m with a flat bottom: chine and keel meet at both its ends."""

    def bottom(x: float) -> float:
        return 0.3 * ((x - 6.0) / 6.0) ** 2

    def rib(x: float) -> list[Place]:
        half, low = 1.0 - ((x - 6.0) / 6.0) ** 2, bottom(x)
        return [(x, 0.0, low), (x, half, low), (x, 1.4 * half, 1.2)]

    along = np.linspace(0.0, 12.0, 121).tolist()
    lines = [(f"ST {x}", rib(float(x))) for x in range(1, 12)]
    lines += [
        ("profile", [(0.0, 0.0, 1.2), *((x, 0.0, bottom(x)) for x in along), (12.0, 0.0, 1.2)]),
        ("deck edge", [rib(x)[-1] for x in along]),
    ]
    return ah.read(
        written(lines, path / "sharpie.csv"), draught=0.6, ap=0.0, deck="closed", accept=True
    )
