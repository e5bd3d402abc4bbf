"""Arcs joined into lines: no end is lost, on patches, across them, and at undecided cells."""

import attrs
import numpy as np
import pytest

from assoc_hull.errors import DanglingArcError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.bezier_patches import Patches
from assoc_hull.geometry.patches.cell_subdivision import subdivide_again, subdivide_patches
from assoc_hull.geometry.patches.cells import CellKind, SignCells, ZeroSetArcs
from assoc_hull.geometry.patches.components import (
    ComponentKind,
    LineEndKind,
    ZeroSetComponent,
    join_arcs,
)
from assoc_hull.geometry.patches.curvature_functions import IsoFunction, gauss_function
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from tests.curved_patches import graph_plates, patch, random_nets, references
from tests.unit.geometry.patches.isolines import function, monkey, plate, polynomial
from tests.unit.geometry.patches.joined_lines import (
    Joined,
    apart,
    by_patch,
    counts,
    join,
    join_nets,
    joined_of,
    winding,
)

# These patches have no curvature but that of rounding, unless their points are known to less;
# P18 has it along an edge.
NIL = {"P13_plane", "P14_cyl", "P15_cyl_rot", "P16_cone_rot", "P18_inflect_edge"}


@pytest.mark.parametrize("known_to", [0.0, 1e-9], ids=["to rounding", "to 1 nm"])
def test_components_of_reference_patches(known_to: float) -> None:
    """Each reference patch has the pieces that are known of it, however well points are known."""
    for name, known in references().items():
        found = join_nets(patch(name)[None], known_to or (1e-12 if name in NIL else 0.0))
        want = known.closed, known.open, known.junction, known.isolated
        assert counts(found.components) == want, name


def test_a_crossing_has_four_ends() -> None:
    """Where two lines cross, four ends of lines meet at undecided cells; the others are borders."""
    (cross,) = join_nets(patch("P05_cross")[None]).components
    assert cross.meetings == 4
    assert cross.end_kinds.count(LineEndKind.BORDER) == 4
    assert len(cross.cells) >= 1


def test_lines_that_meet_in_a_point_are_a_junction() -> None:
    """Four arcs that end in one point, the positive quarters opposite, are one component."""
    lines = np.array([[0.0, 0.5], [1.0, 0.5], [0.5, 0.0], [0.5, 1.0]])
    box = np.array(
        [[[0.0, 0.5]] * 2, [[0.5, 1.0]] * 2, [[0.0, 0.5], [0.5, 1.0]], [[0.5, 1.0], [0, 0.5]]]
    )
    four, none = np.zeros(4, np.intp), np.zeros((0, 2, 2))
    kind = np.full(4, CellKind.U_SIMPLE)
    cells = SignCells(four, box, four, kind, four - 1, none, none, np.zeros(1, bool))
    across = np.array([1, 1, 0, 0])
    ends = np.stack([lines, np.full((4, 2), 0.5)], axis=1)
    rising = np.array([True, False, False, True])
    arcs = ZeroSetArcs(np.array([0, 1, 3, 2]), across, none[:0, 0].reshape(0, 2), ends, rising)
    (cross,) = join_arcs(apart(np.zeros((1, 2, 2, 3))), cells, arcs)
    assert cross.kind is ComponentKind.JUNCTION
    assert cross.meetings == 4
    assert sorted(
        cross.ends[[k is LineEndKind.BORDER for k in cross.end_kinds]].tolist()
    ) == sorted(lines.tolist())


def test_a_line_may_end_in_the_corner_of_its_patch() -> None:
    """Where undecided cells lie on the border, a line that ends at them ends on the border."""
    slopes = {(1, 0): 1.0, (0, 1): -1.0}, {(2, 0): 1.0, (0, 2): -3.0, (1, 1): 1.0}
    for terms in slopes:
        line_of = joined_of(apart(monkey(0.5)[None]), function(polynomial(terms, 2)))
        (line,) = line_of.components
        assert line.kind is ComponentKind.OPEN
        assert line.end_kinds == (LineEndKind.BORDER, LineEndKind.BORDER)
        assert np.abs(line.ends).min() < 3e-5


def test_edges_of_no_curvature_are_told() -> None:
    """Curvature that is nil along an edge makes an edge line, and no other."""
    (edge,) = join_nets(patch("P18_inflect_edge")[None], 1e-12).components
    assert edge.kind is ComponentKind.EDGE_LINE
    assert edge.edges.tolist() == [[0, 0]]
    assert sorted(edge.ends.tolist()) == [[0.0, 0.0], [0.0, 1.0]]


def test_a_surface_of_no_curvature_has_no_components() -> None:
    """A plane has no line, no point, no edge line: all its cells are nil, and its edges too."""
    assert join_nets(patch("P13_plane")[None], 1e-12).components == ()


def test_no_end_is_lost_on_random_plates_and_nets() -> None:
    """Of 120 plates and 20 nets anywhere in space, folded and pierced, no line breaks off.

    More of these nets are tried through the public function.
    """
    plates = join_nets(graph_plates(120, 1)).components
    assert counts(plates) == (67, 207, 0, 0)
    wild = join_nets(random_nets(20, 2)).components
    assert sum(counts(wild)) > 60
    crossed = [each for each in wild if each.kind is ComponentKind.JUNCTION]
    # A point where the surface has no normal makes all odd things that these nets have.
    assert all("singular" in each.tags for each in crossed)
    assert all(each.meetings % 2 == 0 for each in crossed)


@pytest.mark.parametrize("known_to", [1e-9, 1e-6], ids=["to 1 nm", "to 1 um"])
def test_no_end_is_lost_where_points_are_known_to_less(known_to: float) -> None:
    """Where curvature is nil within what is known, lines end at nil cells or run on unseen."""
    join_nets(graph_plates(20, 5), known_to)
    join_nets(random_nets(8, 6), known_to)


def test_error_bands_are_followed() -> None:
    """Where errors are so large that arcs break off, lines run on along the borders of cells."""
    patches = apart(graph_plates(120, 1))
    rough = joined_of(patches, gauss_function(patches, 0.0, 1e-12))
    assert sum(counts(rough.components)) >= 270


def test_a_lost_arc_is_an_error() -> None:
    """If an arc is missing, its neighbours break off, and that is refused."""
    found = join_nets(patch("P03_circle_loop")[None])
    columns = attrs.astuple(found.arcs, recurse=False)
    fewer = ZeroSetArcs(*(np.delete(column, 1, axis=0) for column in columns))
    with pytest.raises(DanglingArcError, match="2 ends of lines") as caught:
        join_arcs(found.patches, found.cells, fewer)
    assert caught.value.count == 2
    assert 0.0 < caught.value.uv[0] < 1.0


def test_the_positive_side_lies_on_the_left() -> None:
    """A loop about a convex disc runs counter-clockwise, about a saddle in it clockwise."""
    disc = join_nets(monkey(0.5)[None])
    saddle = joined_of(apart(monkey(0.5)[None]), _negated(disc))
    for found, sense in ((disc, 1.0), (saddle, -1.0)):
        (loop,) = found.components
        assert loop.loops == (True,)
        assert winding(found.polyline(loop, 0)) * sense > 0.0


def _negated(found: Joined) -> IsoFunction:
    """The polynomial with the other sign."""
    return attrs.evolve(found.function, b=-found.function.b)


def spline(seed: int, multiplicity: int = 1) -> SplineSurface:
    """A bicubic surface of 3 x 5 spans with random heights."""
    draw = np.random.default_rng(seed)
    inner = np.repeat([1.0, 2.0], multiplicity)
    knots_u = np.concatenate([[0.0] * 4, inner, [3.0] * 4])
    knots_v = np.concatenate([[0.0] * 4, [1.0, 2.0, 3.0, 4.0], [5.0] * 4])
    net = np.zeros((len(knots_u) - 4, len(knots_v) - 4, 3))
    net[..., 0], net[..., 1] = np.mgrid[0 : net.shape[0], 0 : net.shape[1]]
    net[..., 2] = draw.standard_normal(net.shape[:2])
    return SplineSurface("", (3, 3), knots_u, knots_v, net)


def test_lines_cross_the_borders_of_patches() -> None:
    """On a surface of 15 patches with continuous curvature, lines end on its border only."""
    found = join(spline(3).patches())
    several = [each for each in found.components if len(each.patches) > 1]
    assert len(several) >= 5
    for each in found.components:
        assert each.kind in (ComponentKind.OPEN, ComponentKind.CLOSED)
        assert all(kind is LineEndKind.BORDER for kind in each.end_kinds)
        on_border = (each.ends == 0.0) | (each.ends == [3.0, 5.0])
        assert on_border.any(axis=1).all()
        for chain in range(len(each.chains)):
            steps = np.diff(found.polyline(each, chain, 0.05), axis=0)
            assert np.abs(steps).max() < 0.5


def test_lines_end_where_the_curvature_jumps() -> None:
    """At knots where a surface is smooth but its curvature jumps, ends are told, not refused."""
    found = join(spline(3, 2).patches())
    jumps = [each for each in found.components if "knot-line" in each.tags]
    assert jumps
    for each in jumps:
        at = [kind is LineEndKind.KNOT_LINE for kind in each.end_kinds]
        assert np.isin(each.ends[at][:, 0], [1.0, 2.0]).all()


def _kinds(found: Joined) -> list[tuple[int, ...]]:
    return by_patch(found.components, len(found.patches))


def test_what_leaves_a_surface_as_it_is_leaves_its_lines() -> None:
    """Exchange and reversal of parameters, and a mirror, give each patch the same components."""
    some = np.concatenate([graph_plates(20, 8), random_nets(2, 9)])
    plain = _kinds(join_nets(some))
    assert _kinds(join_nets(some.transpose(0, 2, 1, 3))) == plain
    assert _kinds(join_nets(some[:, ::-1])) == plain
    assert _kinds(join_nets(some * [1.0, -1.0, 1.0])) == plain


def test_components_do_not_depend_on_the_batch() -> None:
    """Patches one by one have the components that they have in a batch."""
    some = graph_plates(12, 4)
    together = join_nets(some)
    for k, net in enumerate(some):
        alone = join_nets(net[None]).components
        mine = [each for each in together.components if each.patches.tolist() == [k]]
        assert [each.kind for each in alone] == [each.kind for each in mine]
        for a, b in zip(alone, mine, strict=True):
            assert a.ends.tobytes() == b.ends.tobytes()


def _circle(u: float, v: float, radius: float) -> FloatArray:
    """A polynomial that is positive in a disc."""
    return polynomial({(2, 0): -1.0, (0, 2): -1.0, (0, 0): radius**2}, 2, (-u, 1 - u, -v, 1 - v))


@pytest.mark.parametrize(
    ("disc", "tangent"),
    [
        ((0.6871, 0.53, 0.2), False),
        ((0.2871, 0.53, 0.2), False),
        ((0.5, 0.7137, 0.2), False),
        ((0.6871, 0.7137, 0.2), False),
        ((0.2, 0.3, 0.2), True),
    ],
    ids=["from the right", "from the left", "from above", "two cuts", "the border"],
)
def test_loops_that_touch_a_cut_are_closed(disc: tuple[float, float, float], tangent: bool) -> None:
    """A loop that touches a cut of the search is one loop, and no cell of it stays undecided.

    One that touches the border of the patch is closed as well; the cells there stay undecided,
    as no other cut changes that, but they prove that it passes.
    """
    found = joined_of(apart(monkey(0.5)[None]), function(_circle(*disc)))
    (loop,) = found.components
    assert loop.kind is ComponentKind.CLOSED
    assert loop.tags == (("tangent",) if tangent else ())
    assert (len(loop.cells) > 0) == tangent


@pytest.mark.parametrize(
    ("radius", "kind"),
    [(1e-2, "closed"), (1e-3, "closed"), (1e-4, "closed"), (1e-5, "isolated")],
    ids=["1e-2", "1e-3", "1e-4", "1e-5"],
)
def test_loops_are_lost_in_undecided_cells_only(radius: float, kind: str) -> None:
    """A convex disc of radius 1e-4 in a saddle is a loop; a smaller one is an isolated cluster."""
    (only,) = join_nets(monkey(radius)[None]).components
    assert only.kind.value == kind


@pytest.mark.parametrize(
    ("grid", "links", "pairs"), [(16, 62, 66), (32, 118, 119)], ids=["16 x 16", "32 x 32"]
)
def test_neighbours_are_not_links(grid: int, links: int, pairs: int) -> None:
    """Of cells of a grid that the loop of P08 runs through, more are neighbours than linked.

    So lines are joined by ends that coincide, not cell by neighbouring cell: the loop passes from
    one cell of 16 x 16 to the next 62 times, and 66 pairs of these cells are neighbours.
    """
    found = join_nets(patch("P08_wavy_plate")[None])
    (loop,) = found.components
    line = found.polyline(loop, 0, 1e-5)
    line = np.concatenate([line, line[:1]])
    along = np.linspace(0.0, len(line) - 1.0, 100_001)
    uv = np.stack([np.interp(along, np.arange(len(line)), line[:, i]) for i in (0, 1)], axis=1)
    walked = np.floor(uv * grid).astype(int)
    steps = np.abs(np.diff(walked, axis=0)).sum(axis=1)
    cells = {(int(i), int(j)) for i, j in np.unique(walked, axis=0)}
    neighbours = sum(((i + 1, j) in cells) + ((i, j + 1) in cells) for i, j in cells)
    assert steps.sum() == links
    assert neighbours == pairs


def test_cells_made_anew_do_not_depend_on_the_batch() -> None:
    """Of discs that touch a cut and such that do not, each has the cells that it has alone."""
    discs = [_circle(u, 0.53, 0.2) for u in (0.6871, 0.5, 0.2871)]
    whole = function(*discs)
    cells = subdivide_again(whole, subdivide_patches(whole))
    assert cells.kind.max() < CellKind.UNRESOLVED
    for k, disc in enumerate(discs):
        one = function(disc)
        alone = subdivide_again(one, subdivide_patches(one))
        mine = cells.patch == k
        assert cells.box[mine].tobytes() == alone.box.tobytes()
        held = cells.row[mine][cells.row[mine] >= 0]
        assert cells.b[held].tobytes() == alone.b[alone.row[alone.row >= 0]].tobytes()


def test_a_double_line_is_one_cluster() -> None:
    """A line that the curvature touches without change of sign is one isolated component."""
    (only,) = join_nets(patch("P07_double_cross")[None]).components
    assert only.kind is ComponentKind.ISOLATED
    assert len(only.cells) > 1000


def test_nil_cells_that_are_small_do_not_end_a_line() -> None:
    """Of a plate known to 1 um, lines cross cells in which the curvature is nil within that."""
    flat = plate({(3, 0): 1.0, (0, 2): 1.0, (1, 1): 1e-3}, (-0.7, 1.1, -0.8, 0.9))
    (line,) = join_nets(flat[None], 1e-6).components
    assert line.kind is ComponentKind.OPEN


def test_no_patches_have_no_components() -> None:
    """Nothing joined is nothing."""
    none = Patches(np.zeros((0, 4, 4, 3)), np.zeros((0, 2, 2)), np.zeros(0, np.intp))
    components: tuple[ZeroSetComponent, ...] = join(none).components
    assert components == ()
