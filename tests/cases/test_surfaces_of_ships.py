"""Surfaces of ships: how near the lines they run, how blocks meet, what they enclose.

Distances are those of a ship of 300 m: they scale with the length.
"""

from collections.abc import Callable

import numpy as np
import pytest

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.hull import Hull
from assoc_hull.hull.results import HullSurface
from assoc_hull.surface.blocks.fitted_surface import FittedBlock
from tests.long_forms import long_form

BODY, ENDS, MEDIAN = 8.0, 15.0, 1.5  # mm
SHIPS = ["series60_70", "bulk_carrier", "dtc"]

Fitted = Callable[[Hull], HullSurface]


@pytest.fixture(params=SHIPS)
def ship(request: pytest.FixtureRequest) -> Hull:
    """Series 60, the carrier and the DTC, one after the other."""
    found: Hull = request.getfixturevalue(request.param)
    return found


def in_mm(metres: FloatArray, hull: Hull) -> FloatArray:
    """Lengths as they would be on a ship of 300 m, mm."""
    return metres * (300.0 / hull.particulars.length) * 1000.0


def every_fourth(hull: Hull, first: int) -> list[str]:
    """Every fourth section and every fourth waterline by place."""
    found = []
    for group in ("sections", "waterlines"):
        lines = hull.groups[group].lines.values()
        at = sorted((line.plane.offset, line.name) for line in lines if line.plane is not None)
        found += [name for _, name in at[first::4]]
    return found


def test_lines_lie_near_the_surface(ship: Hull, surface_of: Fitted) -> None:
    """95 % of the points within 8 mm on the body, 15 mm at the ends; the median within 1.5 mm."""
    found = surface_of(ship)
    for block in found.blocks:
        median, p95 = np.percentile(in_mm(block.distance, ship), [50.0, 95.0])
        assert p95 <= (BODY if block.kind == "body" else ENDS), block.name
        assert median <= MEDIAN, block.name


def test_every_line_is_fitted_to(ship: Hull, surface_of: Fitted) -> None:
    """No line is forgotten, and the points of each are as dense as those of its fellows."""
    found = surface_of(ship)
    names, net = set(), found.net
    for block in found.blocks:
        names |= {net.name[line] for line in block.samples.line.tolist()}
    assert names == set(net.name)
    length = sum(net.length(curve) for curve in range(net.batch.count))
    points = sum(len(block.samples) for block in found.blocks)
    assert length / points < 0.8 * ship.particulars.length / 300.0


def test_no_point_is_folded(ship: Hull, surface_of: Fitted) -> None:
    """From place to place normals turn by less than 90 degrees, but at corners that are named."""
    for block in surface_of(ship).blocks:
        normal, u, v = normals(block)
        turn = np.minimum(
            (normal[1:, :-1] * normal[:-1, :-1]).sum(-1),
            (normal[:-1, 1:] * normal[:-1, :-1]).sum(-1),
        )
        for corner in block.singular:
            near = [
                np.abs(each - at) <= 0.05 * np.ptp(each)
                for each, at in zip((u, v), corner, strict=True)
            ]
            turn[np.outer(near[0][:-1], near[1][:-1])] = 1.0
        assert turn.min() > 0.0, block.name


def normals(block: FittedBlock) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Unit normals by differences of points on a grid, and its parameters."""
    surface = block.surface
    u, v = (np.linspace(*each, 150) for each in surface.domain)
    place = surface.at(u[:, None], v[None, :])
    found = np.cross(np.diff(place, axis=0)[:, :-1], np.diff(place, axis=1)[:-1])
    size = np.linalg.norm(found, axis=-1, keepdims=True)
    return found / np.maximum(size, 1e-300), u[:-1], v[:-1]


def test_blocks_meet_without_a_gap(ship: Hull, surface_of: Fitted) -> None:
    """Along each border both surfaces have the same points, and one normal."""
    found = surface_of(ship)
    blocks = {block.name: block for block in found.blocks}
    seen = []
    for block in found.blocks:
        for side, parts in block.made.block.sides.items():
            for part in parts:
                if not part.master:
                    continue
                share = np.linspace(0.0, 1.0, 301)
                own = along(block, side, part.low + share * (part.high - part.low))
                low, high = part.master_low, part.master_high
                master = blocks[part.master]
                other = along(master, part.master_side, low + share * (high - low))
                assert np.abs(own - other).max() < 1e-9
                seen.append((part.master, block.name))
    assert sorted(seen) == sorted(border.names for border in found.borders)
    for border in found.borders:
        assert border.joined_gap < 1e-9
        assert border.angle[2] <= (0.1 if "body" in border.names else 0.5)
    assert not [note for note in found.notes if "over the limit" in note]


def along(block: FittedBlock, side: str, at: FloatArray) -> FloatArray:
    """Points of a side."""
    surface = block.surface
    (u0, u1), (v0, v1) = surface.domain
    if side[0] == "u":
        return surface.at(u0 if side == "u0" else u1, np.clip(at, v0, v1))
    return surface.at(np.clip(at, u0, u1), v0 if side == "v0" else v1)


def test_it_encloses_what_the_lines_enclose(ship: Hull, surface_of: Fitted) -> None:
    """Volume within .02 %, its centre within .01 % of the length of those of hydrostatics."""
    found = surface_of(ship).below()
    truth = ship.hydrostatics(estimate=False)
    assert 2.0 * found.volume == pytest.approx(truth.volume, rel=2e-4)
    lcb = found.moment[0] / found.volume
    assert abs(lcb - truth.lcb) <= 1e-4 * ship.particulars.length


@pytest.mark.parametrize(
    ("name", "block", "word", "place"),
    [
        ("dtc", "stern counter", "stem not resolved", (15.23, 0.0, 9.35)),
        ("bulk_carrier", "stern counter", "stem not resolved", (9.0, 0.0, 7.0)),
        ("bulk_carrier", "bow", "singular corner", (306.4, 0.0, 7.0)),
        ("series60_70", "stern counter", "singular corner", (-1.11, 0.0, 6.41)),
    ],
    ids=["aperture of the DTC", "aperture of the carrier", "tip of the bulb", "counter"],
)
def test_hard_places_are_named(
    name: str, block: str, word: str, place: tuple[float, ...],
    request: pytest.FixtureRequest, surface_of: Fitted,
) -> None:  # fmt: skip
    """Where a surface cannot follow, its notes say what and where, and so does its report."""
    found = surface_of(request.getfixturevalue(name))
    (own,) = (each for each in found.blocks if each.name == block)
    notes = [each for each in own.notes if each.startswith(word)]
    told = [note[note.index("(") + 1 : note.index(")")].split(", ") for note in notes]
    away = np.abs(np.array(told, np.float64) - place).max(axis=1)
    assert away.min() < 0.6
    assert all(f"{block}: {note}" in str(found) for note in notes)


def test_lines_left_out_lie_near_it(series60_70: Hull) -> None:
    """Every fourth section and waterline: p95 at most three times that of the lines fitted to."""
    left_out_within(series60_70, 0, 3.0)


@long_form
@pytest.mark.parametrize("name", ["dtc", "bulk_carrier"])
def test_lines_left_out_of_large_ships_lie_near_them(
    name: str, request: pytest.FixtureRequest
) -> None:
    """Every fourth section and waterline: p95 at most three times that of the lines fitted to."""
    left_out_within(request.getfixturevalue(name), 0, 3.0)


def left_out_within(hull: Hull, first: int, times: float) -> None:
    """Leave lines out, and measure the surface from them."""
    names = every_fourth(hull, first)
    found = hull.surface(leave_out=names)
    fitted, left_out = found.whole
    assert found.left_out == tuple(names)
    assert left_out.p95 <= times * fitted.p95
    assert left_out.line in names
    used = {found.net.name[i] for block in found.blocks for i in block.samples.line.tolist()}
    assert not used & set(names)
    each = [block.left_out for block in found.blocks if block.left_out is not None]
    assert max(one.largest for one in each) == left_out.largest
    assert f"{1e3 * left_out.largest:.2f}" in str(found)
