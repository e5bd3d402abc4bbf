"""Binary frames of the page: what is written is read again, and nothing else is."""

import attrs
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import assoc_hull as ah
from assoc_hull.edit.shapes import joined
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import SplineBatch
from assoc_hull.geometry.splines.segments import curvature
from assoc_hull.page.wire import Frame, FrameKind, pack, unpack


def whole(hull: ah.Hull) -> Frame:
    """All of a hull."""
    shapes, state = hull.shapes(), hull.state
    rows = state.live("rows")
    return Frame(FrameKind.NET, state.number, shapes.curves, shapes.spline, rows,
                 state.rows.xyz[rows], structural=True)  # fmt: skip


@st.composite
def frames(draw: st.DrawFn) -> Frame:
    """Frames of some curves and points; a curve may have no knot: it has gone."""
    counts = draw(st.lists(st.integers(0, 5), max_size=6))
    start = np.concatenate([[0], np.cumsum(counts)]).astype(np.int64)
    made = np.random.default_rng(draw(st.integers(0, 99)))
    k, p = int(start[-1]), draw(st.integers(0, 7))
    xyz, leave, arrive = (made.normal(size=(k, 3)) * 100.0 for _ in range(3))
    spline = SplineBatch(start, np.zeros(k), xyz, leave, arrive)
    number = st.integers(0, 2**32 - 1)
    return Frame(
        draw(st.sampled_from(FrameKind)), draw(number), np.arange(len(counts)) + 7, spline,
        np.arange(p) * 3, made.normal(size=(p, 3)), draw(number), draw(number),
        draw(st.booleans()), 0.012, -3.5, 0.25, 0.0625,
    )  # fmt: skip


@given(frames())
def test_a_frame_is_read_as_it_was_written(frame: Frame) -> None:
    """Numbers and places to the bit, derivatives as single ones, sections on 8 bytes."""
    data = pack(frame)
    found = unpack(data)
    assert len(data) % 8 == 0
    for name in ("kind", "state", "gesture", "sequence", "structural"):
        assert getattr(found, name) == getattr(frame, name)
    for name in ("seconds", "volume", "lcb", "normal"):
        assert np.float32(getattr(found, name)) == np.float32(getattr(frame, name))
    assert np.array_equal(found.curves, frame.curves)
    assert np.array_equal(found.rows, frame.rows)
    assert np.array_equal(found.xyz, frame.xyz)
    assert np.array_equal(found.spline.start, frame.spline.start)
    assert np.array_equal(found.spline.xyz, frame.spline.xyz)
    for name in ("leave", "arrive"):
        single = getattr(frame.spline, name).astype(np.float32)
        assert np.array_equal(getattr(found.spline, name), single)


@given(frames(), st.data())
def test_a_damaged_frame_is_one_sentence(frame: Frame, data: st.DataObject) -> None:
    """It is cut, lengthened, of another version or kind, or its counts do not agree."""
    packed = bytearray(pack(frame))
    damage = data.draw(st.sampled_from(["cut", "longer", "version", "kind", "counts"]))
    if damage == "cut":
        packed = packed[: data.draw(st.integers(0, len(packed) - 1))]
    elif damage == "longer":
        packed += b"\0" * data.draw(st.integers(1, 40))
    elif damage == "counts":
        packed[16 + 4 * data.draw(st.integers(0, 2))] ^= 1 << data.draw(st.integers(1, 6))
    else:
        unknown = st.integers(max(FrameKind) + 1, 255)
        packed[0 if damage == "version" else 1] = data.draw(unknown)
    with pytest.raises(BadInputError) as error:
        unpack(bytes(packed))
    assert "\n" not in str(error.value)


@pytest.mark.parametrize("name", ["series60_70", "bulk_carrier"])
def test_curvature_of_what_was_sent_is_that_of_the_hull(
    name: str, request: pytest.FixtureRequest
) -> None:
    """Knots are double, so that combs tell the truth: to 2e-6 1/m; all of a hull is 180 kB."""
    frame = whole(request.getfixturevalue(name))
    data = pack(frame)
    sent, own = unpack(data).spline, frame.spline
    middle = np.repeat(np.arange(own.count), np.diff(own.start) - 1)
    first = np.concatenate(
        [np.arange(a, b - 1) for a, b in zip(own.start, own.start[1:], strict=False)]
    )
    at = middle, 0.5 * (own.knot[first] + own.knot[first + 1])
    short = own.knot[first + 1] - own.knot[first] < 0.02
    apart = np.abs(curvature(sent, at=at) - curvature(own, at=at))[~short]
    assert apart.max() < 2e-6
    assert len(data) < 350_000


def test_a_frame_of_nothing_is_its_header() -> None:
    """An edit that changes nothing is told, too."""
    none = np.zeros(0, np.int64)
    frame = Frame(FrameKind.LIVE, 3, none, joined([]), none, np.zeros((0, 3)), 1, 2)
    assert len(pack(frame)) == 48
    assert attrs.evolve(unpack(pack(frame)), spline=frame.spline).sequence == 2
