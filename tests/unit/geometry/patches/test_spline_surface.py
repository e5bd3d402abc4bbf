"""B-spline surfaces: points, their Bezier patches, parts, and what is refused."""

import numpy as np
import pytest
from scipy.interpolate import NdBSpline

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.bezier_patches import Patches
from assoc_hull.geometry.patches.spline_surface import SplineSurface

CLAMPED_U = [0.0, 0, 0, 0, 1, 1, 2.5, 3, 4, 4, 4, 4]
CLAMPED_V = [-1.0, -1, -1, -1, 0, 0.5, 2, 2, 2, 2]


def random_surface(seed: int = 0) -> SplineSurface:
    """A bicubic surface of 4 x 3 patches with a double knot."""
    net = np.random.default_rng(seed).normal(size=(8, 6, 3))
    return SplineSurface("random", (3, 3), np.array(CLAMPED_U), np.array(CLAMPED_V), net)


def bezier_points(patches: Patches, s: FloatArray, t: FloatArray) -> FloatArray:
    """Points of each patch at parameters of its own, by scipy: (k, points, 3)."""
    m, n = patches.degrees
    knots = [np.repeat([0.0, 1.0], degree + 1) for degree in (m, n)]
    net = np.moveaxis(patches.net, 0, 2)
    found = NdBSpline((knots[0], knots[1]), net, (m, n))(np.stack([s, t], axis=-1))
    return np.moveaxis(found, 1, 0)


def boxes(surface: SplineSurface) -> FloatArray:
    """The parameters that each patch covers, four numbers a row."""
    return surface.patches().box.reshape(-1, 4)


@pytest.mark.parametrize(
    ("degrees", "knots_u", "knots_v"),
    [
        pytest.param((3, 3), CLAMPED_U, CLAMPED_V, id="bicubic with a double knot"),
        pytest.param((1, 3), [0.0, 0, 1, 2, 2], CLAMPED_V, id="ruled strips"),
        pytest.param((2, 3), np.arange(8.0), np.arange(9.0) ** 1.5, id="ends not repeated"),
    ],
)
def test_patches_are_the_surface(
    degrees: tuple[int, int], knots_u: FloatArray, knots_v: FloatArray
) -> None:
    """Points, and Bezier patches, agree with scipy's B-splines to 5e-15."""
    rng = np.random.default_rng(1)
    counts = [len(knots) - d - 1 for knots, d in zip((knots_u, knots_v), degrees, strict=True)]
    net = rng.uniform(-1.0, 1.0, (*counts, 3))
    ku, kv = np.array(knots_u, np.float64), np.array(knots_v, np.float64)
    surface = SplineSurface("s", degrees, ku, kv, net)
    patches, (s, t) = surface.patches(7), rng.uniform(size=(2, 40))
    low, high = patches.box[:, :, 0], patches.box[:, :, 1]
    u, v = (low[:, i, None] * (1 - q) + high[:, i, None] * q for i, q in ((0, s), (1, t)))
    truth = NdBSpline((ku, kv), net, degrees)(np.stack([u, v], axis=-1))
    assert np.abs(bezier_points(patches, s, t) - truth).max() <= 5e-15
    assert np.abs(surface.at(u, v) - truth).max() <= 5e-15
    assert set(patches.surface) == {7}


def test_a_control_point_changes_its_patches_only() -> None:
    """Of 7 x 7 bicubic patches with single knots a moved point changes 16; the rest keep bits."""
    knots = np.concatenate([[0.0] * 3, np.arange(8.0), [7.0] * 3])
    net = np.random.default_rng(2).normal(size=(10, 10, 3))
    moved = net.copy()
    moved[4, 5] += [0.0, 0.125, -0.25]
    before, after = (
        SplineSurface("s", (3, 3), knots, knots, each).patches() for each in (net, moved)
    )
    same = np.array(
        [a.tobytes() == b.tobytes() for a, b in zip(before.net, after.net, strict=True)]
    )
    assert np.count_nonzero(~same) == 16
    assert not same.reshape(7, 7)[1:5, 2:6].any()


def test_a_net_of_one_patch_is_kept() -> None:
    """A Bezier net comes back with its own bits, nil without sign."""
    net = np.random.default_rng(3).normal(size=(4, 6, 3)) + 100.0
    net[0, 0] = -0.0
    found = SplineSurface.bezier(net).patches()
    assert found.net.tobytes() == (net + 0.0).tobytes()
    assert found.degrees == (3, 5)


def test_neighbours_share_their_border() -> None:
    """Control points on a border between patches are the same numbers on both sides."""
    net = random_surface().patches().net.reshape(4, 3, 4, 4, 3)
    assert np.array_equal(net[:-1, :, -1], net[1:, :, 0])
    assert np.array_equal(net[:, :-1, :, -1], net[:, 1:, :, 0])


@pytest.mark.parametrize("weighted", [False, True], ids=["polynomial", "rational"])
def test_a_part_is_the_surface_there(weighted: bool) -> None:
    """A part has the points of the surface; patches that it holds whole stay, to rounding."""
    whole = random_surface(4)
    if weighted:
        weights = np.random.default_rng(5).uniform(0.5, 2.0, (8, 6))
        whole = SplineSurface("r", (3, 3), whole.knots_u, whole.knots_v, whole.net, weights)
    part = whole.restricted((0.3, 3.5), (-0.5, 0.5), "plate")
    assert (part.name, part.domain) == ("plate", ((0.3, 3.5), (-0.5, 0.5)))
    u, v = np.meshgrid(np.linspace(0.3, 3.5, 23), np.linspace(-0.5, 0.5, 11))
    assert np.abs(part.at(u, v) - whole.at(u, v)).max() <= 1e-14
    assert len(part.patches()) == 4 * 2
    kept = {tuple(box): net for box, net in zip(boxes(part), part.patches().net, strict=True)}
    assert np.allclose(kept[tuple(boxes(whole)[4])], whole.patches().net[4], rtol=0.0, atol=1e-14)


def test_a_rational_surface_is_the_quotient() -> None:
    """Points are quotients of two B-splines, on the surface and on its patches."""
    polynomial, rng = random_surface(6), np.random.default_rng(7)
    weights = rng.uniform(0.5, 2.0, (8, 6))
    surface = SplineSurface(
        "r", (3, 3), polynomial.knots_u, polynomial.knots_v, polynomial.net, weights
    )
    u, v = rng.uniform(0.0, 4.0, 30), rng.uniform(-1.0, 2.0, 30)
    both = np.concatenate([polynomial.net * weights[..., None], weights[..., None]], axis=-1)
    truth = NdBSpline((surface.knots_u, surface.knots_v), both, 3)(np.stack([u, v], axis=-1))
    assert np.abs(surface.at(u, v) - truth[:, :3] / truth[:, 3:]).max() <= 5e-15
    patches = surface.patches()
    assert patches.weight is not None
    corner = surface.at(patches.box[:, 0, 0], patches.box[:, 1, 1])
    assert np.abs(patches.net[:, 0, -1] - corner).max() <= 5e-15


def test_the_border_of_a_patch_is_that_of_its_neighbour() -> None:
    """Parameters 0 and 1 of patches are those of the surface at both ends, to the last bit."""
    low = np.random.default_rng(10).uniform(-1.0, 1.0, (200, 2))
    box = np.stack([low, np.random.default_rng(11).uniform(1.0, 3.0, (200, 2))], axis=2)
    patches, row = Patches(np.zeros((200, 2, 2, 3)), box, np.zeros(200, np.intp)), np.arange(200)
    for end in (0, 1):
        found = patches.parameters(row, np.full((200, 2), float(end)))
        assert np.array_equal(found, box[..., end])


def test_a_part_may_end_where_the_surface_does() -> None:
    """An end that rounding has put outside is the end."""
    part = random_surface().restricted((0.0, 4.0 + 1e-13), (-1.0, 2.0))
    assert part.domain == ((0.0, 4.0), (-1.0, 2.0))
    assert np.array_equal(part.net, random_surface().net)


def test_equal_weights_are_none() -> None:
    """A surface whose weights are all equal is a polynomial one."""
    net = np.random.default_rng(8).normal(size=(3, 3, 3))
    assert SplineSurface.bezier(net, weights=np.full((3, 3), 0.25)).weights is None


def test_knots_apart_by_rounding_are_one() -> None:
    """Knots 1e-14 apart make no patch of that breadth."""
    knots = np.array([0.0, 0, 0, 1.0, 1.0 + 1e-14, 2, 2, 2])
    net = np.random.default_rng(9).normal(size=(5, 3, 3))
    surface = SplineSurface("s", (2, 2), knots, np.array([0.0, 0, 0, 1, 1, 1]), net)
    assert len(surface.patches()) == 2


NET = np.zeros((4, 4, 3))
KNOTS = np.repeat([0.0, 1.0], 4)


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"degrees": (3, 0)}, "from 1 to 7"),
        ({"degrees": (8, 3)}, "from 1 to 7"),
        ({"degrees": 3}, "pair of whole numbers"),
        ({"knots_u": KNOTS[:-1]}, "7 knots for 4 control points of degree 3"),
        ({"knots_u": KNOTS[::-1]}, "falls from 1 to 0 at place 4"),
        ({"knots_v": np.full(8, 2.0)}, "holds 2 8 times, for degree 3"),
        ({"knots_v": [0, 0, 0, 0, 0, 1, 1, 1]}, "holds 0 5 times, for degree 3"),
        ({"knots_v": [0, 0, 0, 0, 1, 1, 1, np.inf]}, "finite"),
        ({"net": NET[:3]}, "3 control points in u for degree 3"),
        ({"net": NET[..., :2]}, r"shape \(4, 4, 2\)"),
        ({"net": np.where(np.arange(3) == 1, np.nan, NET)}, "y of the control point 0, 0 is nan"),
        ({"net": NET + 2e6}, "up to 1e\\+06 m"),
        ({"net": "a"}, "net is 'a'"),
        ({"weights": np.zeros((4, 4))}, "weight of the control point 0, 0 is 0"),
        ({"weights": np.ones((4, 3))}, r"shape \(4, 3\)"),
        ({"weights": np.ones((4, 4)) + 1e9 * np.eye(4)}, "between 1 and 1e"),
        ({"name": "two\nlines"}, "one line"),
        ({"name": None}, "name is None"),
    ],
)
def test_what_is_no_surface_is_refused(changed: dict[str, object], words: str) -> None:
    """An error of the family says what is wrong."""
    given = {"name": "s", "degrees": (3, 3), "knots_u": KNOTS, "knots_v": KNOTS, "net": NET}
    with pytest.raises(BadInputError, match=words):
        SplineSurface(**(given | changed))  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("u", "v", "words"),
    [
        ((1, 0), (0, 1), "rising"),
        ((0, 2), (0, 1), "u is 2, in surface 's'; give u from 0 to 1"),
        ((0, 1), (0.5, np.nan), "v is nan"),
        (("a", "b"), (0, 1), "give \\(low, high\\)"),
        ((0, 1), None, "give \\(low, high\\)"),
        ((0, 1), (0.5,), "give \\(low, high\\)"),
    ],
)
def test_what_is_no_part_is_refused(u: object, v: object, words: str) -> None:
    """A part needs two rising parameters of the domain each way."""
    surface = SplineSurface.bezier(NET, "s")
    with pytest.raises(BadInputError, match=words):
        surface.restricted(u, v)


def test_points_outside_are_refused() -> None:
    """There is no point beyond the ends of the parameter, nor at arrays that do not fit."""
    surface = SplineSurface.bezier(NET, "s")
    with pytest.raises(BadInputError, match=r"v is 1\.5"):
        surface.at(0.0, [0.0, 1.5])
    with pytest.raises(BadInputError, match="broadcast"):
        surface.at([0.0, 1.0, 0.5], [0.0, 1.0])
    with pytest.raises(BadInputError, match="u is 'a'"):
        surface.at("a", 0.0)
