"""From the net of a hull to blocks with samples: what must hold of any hull that ships."""

from collections.abc import Callable, Mapping

import attrs
import numpy as np
import pytest

from assoc_hull.analysis.net.curve_net import CurveNet, gather_net
from assoc_hull.geometry.curves import FloatArray, SplineBatch
from assoc_hull.hull import Hull
from assoc_hull.surface.blocks.block_layout import HullBlock, lay_out
from assoc_hull.surface.blocks.block_map import GRID, BlockMap, block_map
from assoc_hull.surface.blocks.block_plan import block_plans
from assoc_hull.surface.cells.net_faces import find_cells
from assoc_hull.surface.cells.net_graph import net_graph

BLOCKS = {
    "wigley": ("body",),
    "series60_70": ("body", "stern counter"),
    "bulk_carrier": ("body", "stern counter", "stern boss", "bow"),
    "container_ship_225m": ("body", "stern counter", "bow stem", "bow bulb"),
    "sfolds_ship": ("body",),
    "dtc": ("body", "stern counter", "stern boss", "bow stem", "bow bulb"),
}
NAMES = list(BLOCKS)


@attrs.frozen(eq=False)
class Case:
    """A hull, laid out."""

    net: CurveNet
    length: float
    blocks: tuple[HullBlock, ...]
    maps: Mapping[str, BlockMap]


def laid(hull: Hull) -> Case:
    """Lay a hull out, with the maps of its blocks as well."""
    net, length = gather_net(hull.state), hull.particulars.length
    maps = dict[str, BlockMap]()
    for plan in block_plans(find_cells(net_graph(net)), length):
        maps[plan.name] = block_map(plan, length, maps)
    return Case(net, length, lay_out(net, length), maps)


@pytest.fixture(scope="session")
def case(request: pytest.FixtureRequest, shipped: Callable[[str], Hull]) -> Callable[[str], Case]:
    """Give a hull that ships, or the DTC, laid out; each once."""
    known = dict[str, Case]()

    def give(name: str) -> Case:
        if name not in known:
            hull = request.getfixturevalue("dtc") if name == "dtc" else shipped(name)
            known[name] = laid(hull)
        return known[name]

    return give


Cases = Callable[[str], Case]


@pytest.mark.parametrize("name", NAMES)
def test_each_hull_has_the_blocks_that_its_profile_asks_for(case: Cases, name: str) -> None:
    """Masters come first; a wall-sided stem has no block of its own."""
    assert tuple(block.name for block in case(name).blocks) == BLOCKS[name]


@pytest.mark.parametrize("name", NAMES)
def test_every_cell_lies_in_exactly_one_block(case: Cases, name: str) -> None:
    """Blocks part the half hull: no cell is left out, none is in two."""
    inside = [each.plan.core.region.inside for each in case(name).maps.values()]
    assert (np.sum(inside, axis=0) == 1).all()


@pytest.mark.parametrize("name", NAMES)
def test_no_cell_is_folded_in_any_map(case: Cases, name: str) -> None:
    """All keep their sense; cells of two edges, or as small as the grid, may come out flat."""
    found = case(name)
    for each in found.maps.values():
        for sheet in (each.core, *each.bays.values()):
            areas = areas_of(sheet.quad.region, sheet.uv)
            assert areas.min() >= 0.0
            flat = np.flatnonzero(sheet.quad.region.inside)[areas == 0.0]
            nodes = [sheet.quad.region.cells.nodes(cell) for cell in flat.tolist()]
            sizes = [np.ptp(sheet.uv[each], axis=0) for each in nodes if len(each) > 2]
            assert all(size.min() <= 2.0 * GRID * found.length for size in sizes)
            assert np.isclose(areas.sum(), np.prod(np.ptp(sheet.box, axis=1)), rtol=1e-9)


def areas_of(region: object, uv: FloatArray) -> FloatArray:
    """Areas of the cells of a region in its map, m2."""
    found = []
    for cell in np.flatnonzero(region.inside).tolist():  # type: ignore[attr-defined]
        u, v = uv[region.cells.nodes(cell)].T  # type: ignore[attr-defined]
        found.append(0.5 * float((u * np.roll(v, -1) - v * np.roll(u, -1)).sum()))
    return np.array(found)


@pytest.mark.parametrize("name", NAMES)
def test_sides_are_closed_and_end_in_the_corners(case: Cases, name: str) -> None:
    """Stretches follow one another from corner to corner; one that has a master is a whole side."""
    for block in case(name).blocks:
        for side, stretches in block.sides.items():
            low, high = block.extent[1 if side[0] == "u" else 0]
            ends = [low, *(each.high for each in stretches)]
            assert [*(each.low for each in stretches), high] == ends
            assert len(stretches) == 1 or not any(each.master for each in stretches)
            assert all(each.high > each.low for each in stretches)


@pytest.mark.parametrize("name", NAMES)
def test_samples_lie_in_the_reach_and_borders_hold_theirs(case: Cases, name: str) -> None:
    """What holds a parameter is on a side of the block, of its reach, or on a section of a body."""
    for block in case(name).blocks:
        uv, held = block.samples.uv, block.samples.held
        assert (uv >= block.reach[:, 0]).all()
        assert (uv <= block.reach[:, 1]).all()
        assert (block.reach[:, 0] <= block.extent[:, 0]).all()
        inner = uv[block.inside]
        assert (inner >= block.extent[:, 0] - 1e-12).all()
        assert (inner <= block.extent[:, 1] + 1e-12).all()
        assert held.any(axis=0).all()
        assert (block.samples.weight > 0.0).all()


@pytest.mark.parametrize("name", ["series60_70", "bulk_carrier", "dtc"])
def test_a_border_has_the_parameters_of_its_master_in_proportion(case: Cases, name: str) -> None:
    """Points of a cut are the same in both blocks, and one affine map joins their parameters."""
    blocks = {block.name: block for block in case(name).blocks}
    compared = 0
    for block in blocks.values():
        for side, stretches in block.sides.items():
            for each in (each for each in stretches if each.master):
                own = points_on(block, side)
                others = points_on(blocks[each.master], each.master_side)
                shared = own.keys() & others.keys()
                ratio = (each.high - each.low) / (each.master_high - each.master_low)
                at = np.array([others[key] for key in sorted(shared)])
                wanted = each.low + ratio * (at - each.master_low)
                found = np.array([own[key] for key in sorted(shared)])
                good = (found > each.low) & (found < each.high)
                assert np.abs(found - wanted)[good].max() < 1e-10
                compared += int(good.sum())
    assert compared > 50


def points_on(block: HullBlock, side: str) -> dict[bytes, float]:
    """Points held in both parameters on a side, and where they lie along it."""
    axis = 0 if side[0] == "u" else 1
    samples, at = block.samples, block.extent[axis, int(side[1])]
    on = samples.held.all(axis=1) & (samples.uv[:, axis] == at) & block.inside
    keys = (point.tobytes() for point in samples.point[on])
    return dict(zip(keys, samples.uv[on, 1 - axis].tolist(), strict=True))


def test_corners_of_a_wall_sided_hull_are_those_of_its_profile(case: Cases) -> None:
    """No line of the net need pass them: the foot of a stem is a knuckle of the profile alone."""
    (body,) = case("wigley").blocks
    wanted = [[0.0, 0.0, 9.375], [100.0, 0.0, 9.375], [100.0, 0.0, 0.0], [0.0, 0.0, 0.0]]
    np.testing.assert_allclose(body.corners, wanted, atol=1e-12)
    np.testing.assert_allclose(body.turns, 90.0, atol=1e-6)
    assert body.singular == ()


def test_a_cut_ends_in_the_corner_of_an_aperture_that_no_line_passes(case: Cases) -> None:
    """The boss begins at the corner of the profile, not where the waterline beside it ends."""
    boss = next(block for block in case("bulk_carrier").blocks if block.name == "stern boss")
    corner = boss.corners[0]
    assert corner[1] == 0.0
    assert 7.1 < corner[2] < 7.9
    assert np.unique(boss.samples.line).max() < len(case("bulk_carrier").net.name)


def test_the_same_net_gives_the_same_bits(case: Cases, series60_70: Hull) -> None:
    """A layout is a function of the lines alone."""
    first, second = case("series60_70"), laid(series60_70)
    for a, b in zip(first.blocks, second.blocks, strict=True):
        for name in ("uv", "point", "weight", "line", "held"):
            one, other = getattr(a.samples, name), getattr(b.samples, name)
            assert one.tobytes() == other.tobytes()


@pytest.mark.parametrize("name", ["series60_70", "bulk_carrier"])
def test_a_hull_of_twice_the_size_has_the_same_layout(case: Cases, name: str) -> None:
    """Nothing but the length of the ship sets a scale."""
    known = case(name)
    found = lay_out(changed(known.net, 2.0, 0.0), 2.0 * known.length)
    for a, b in zip(known.blocks, found, strict=True):
        assert a.name == b.name
        np.testing.assert_allclose(b.corners, 2.0 * a.corners, atol=1e-9)
        np.testing.assert_allclose(b.extent, 2.0 * a.extent, rtol=1e-12)
        np.testing.assert_allclose(b.samples.uv, 2.0 * a.samples.uv, rtol=0.0, atol=1e-9)


def test_a_hull_moved_forward_has_the_same_layout(case: Cases) -> None:
    """Where the origin lies does not matter, but for rounding on the grid."""
    known = case("bulk_carrier")
    found = lay_out(changed(known.net, 1.0, 77.7), known.length)
    for a, b in zip(known.blocks, found, strict=True):
        assert a.name == b.name
        np.testing.assert_allclose(b.corners - a.corners, [[77.7, 0.0, 0.0]] * 4, atol=1e-9)
        assert len(a.samples) == len(b.samples)
        assert np.abs(a.samples.uv - b.samples.uv).max() <= 2.0 * GRID * known.length


def changed(net: CurveNet, scale: float, shift: float) -> CurveNet:
    """A net of another size, or elsewhere."""
    batch = net.batch
    moved = SplineBatch(
        batch.start.copy(), scale * batch.knot, scale * batch.xyz + np.array([shift, 0.0, 0.0]),
        batch.leave.copy(), batch.arrive.copy(),
    )  # fmt: skip
    return attrs.evolve(
        net, batch=moved, x=scale * net.x + shift, place=scale * net.place, normal=net.normal.copy()
    )


def test_lines_left_out_are_not_sampled(case: Cases) -> None:
    """Not a point of them, nor do others end on them."""
    known = case("series60_70")
    names = np.array(known.net.name)
    left = np.isin(names, ["WL 1", "ST 10", "ST 3"])
    assert left.sum() == 3
    blocks = lay_out(known.net, known.length, left)
    assert [block.name for block in blocks] == list(BLOCKS["series60_70"])
    for block in blocks:
        assert not left[block.samples.line].any()
    with_all = sum(int(block.inside.sum()) for block in known.blocks)
    assert sum(int(block.inside.sum()) for block in blocks) < with_all


def test_without_the_section_at_its_bend_a_stern_is_cut_along_a_waterline(case: Cases) -> None:
    """The cut runs to the head of the stern post; no corner of a block lies within it."""
    known = case("series60_70")
    left = np.isin(known.net.name, [*every_fourth(known.net, 0), *every_fourth(known.net, 2)])
    assert left[known.net.name.index("ST 0")]
    blocks = {block.name: block for block in lay_out(known.net, known.length, left)}
    assert list(blocks) == ["body", "stern counter", "stern boss"]
    np.testing.assert_allclose(blocks["stern boss"].corners[0], [0.0, 0.0, 6.18], atol=0.01)


def every_fourth(net: CurveNet, axis: int) -> list[str]:
    """The names of every fourth section, or waterline, from aft or from below, the first too."""
    family = "waterlines" if axis else "sections"
    own = [i for i, name in enumerate(net.family) if name == family]
    at = {net.name[i]: float(net.batch.xyz[net.batch.start[i], axis]) for i in own}
    return sorted(at, key=lambda name: at[name])[::4]
