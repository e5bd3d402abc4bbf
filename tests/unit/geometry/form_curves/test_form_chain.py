import numpy as np
import pytest

from assoc_hull.geometry.form_curves.chain import FormChain, cubic_vertices, straight_vertices
from assoc_hull.geometry.form_curves.curve import FormEnd, form_vertices


@pytest.fixture(scope="module")
def course() -> FormChain:
    """A run, a parallel part and an entrance: TYPE1 of Kim & Kang 1992, table 2."""
    degrees = np.radians([60.0, 0.0, 0.0, -50.0])
    d0, d1 = 0.1525819451966713, 0.16007810593582122
    run = form_vertices(
        FormEnd.of(-1.0, 0.0, degrees[0], -2.0, d0), FormEnd.of(-0.3, 1.0, 0.0, 0.0, d0),
        np.array([0.55]), np.array([-0.59]),
    )  # fmt: skip
    entrance = form_vertices(
        FormEnd.of(0.2, 1.0, 0.0, 0.0, d1), FormEnd.of(1.0, 0.0, degrees[3], -2.0, d1),
        np.array([0.6]), np.array([0.52]),
    )  # fmt: skip
    return FormChain.of([run[0], straight_vertices((-0.3, 1.0), (0.2, 1.0)), entrance[0]])


def test_places_are_found_again(course: FormChain) -> None:
    """Points of a course have ordinates, slopes and curvatures by their abscissae."""
    t = np.linspace(0.0, 4.0, 41)[1:-1]
    for piece in (0, 1, 2):
        points, tangents = course.at(piece, t), course.tangent(piece, t)
        got = course.ordinate(points[:, 0])
        assert got == pytest.approx(points[:, 1], abs=2e-14)
        assert course.slope(points[:, 0]) == pytest.approx(
            tangents[:, 1] / tangents[:, 0], rel=1e-9, abs=1e-12
        )
        assert course.curvature(points[:, 0]) == pytest.approx(
            course.bend(piece, t), rel=1e-8, abs=1e-10
        )


def test_the_ends_and_beyond(course: FormChain) -> None:
    """The ends belong to a course; beyond there is nothing."""
    got = course.ordinate([-1.0, -0.3, 0.2, 1.0, -1.001, 1.001])
    assert got[:4] == pytest.approx([0.0, 1.0, 1.0, 0.0], abs=1e-12)
    assert np.isnan(got[4:]).all()
    assert course.start == pytest.approx([-1.0, 0.0], abs=1e-15)
    assert course.finish == pytest.approx([1.0, 0.0], abs=1e-15)


def test_alone_and_in_company(course: FormChain) -> None:
    """A place has the same bits whatever else is asked for."""
    x = np.random.default_rng(3).uniform(-1.05, 1.05, 301)
    for ask in (course.ordinate, course.slope, course.curvature):
        together = ask(x)
        assert together.tobytes() == np.concatenate([ask(each) for each in x]).tobytes()
        assert together[::-1][:7].tobytes() == ask(x[::-1][:7]).tobytes()


def test_a_course_that_runs_backward(course: FormChain) -> None:
    """Abscissae may fall along a course."""
    back = FormChain(course.vertices[::-1, ::-1])
    x = np.linspace(-1.0, 1.0, 57)
    assert back.ordinate(x) == pytest.approx(course.ordinate(x), abs=1e-13)


def test_all_meetings(course: FormChain) -> None:
    """Every meeting is given once: crossings, joints, ends, knots of what lies in the line."""
    found = course.meets(1, 0.5)
    assert [piece for piece, _ in found] == [0, 2]
    assert course.at(*np.array(found).T)[:, 1] == pytest.approx([0.5, 0.5], abs=1e-14)
    assert course.meets(0, 1.0) == ((2, 4.0),)
    assert course.meets(0, -0.3)[0][0] == 0
    assert len(course.meets(0, -0.3)) == 1
    assert course.meets(1, 3.0) == ()
    inside = [place for place in course.meets(1, 1.0) if place[0] == 1]
    assert inside == [(1, 1.0), (1, 2.0), (1, 3.0), (1, 4.0)]


def test_a_touch_is_a_meeting() -> None:
    """Where a course turns back just at a value, it meets it once."""
    hill = FormChain.of([cubic_vertices((0.0, 0.0), (4.0, 0.0), (1.0, 1.0), (1.0, -1.0))])
    ((piece, t),) = hill.meets(1, 1.0)
    assert piece == 0
    assert t == pytest.approx(2.0, abs=1e-6)


def test_integrals_of_a_course(course: FormChain) -> None:
    """Area and moment are the sums of the given ones and of the parallel part."""
    assert course.area() == pytest.approx(0.55 + 0.5 + 0.6, abs=4e-15)
    moment = 0.55 * -0.59 + 0.5 * (0.04 - 0.09) + 0.6 * 0.52
    assert course.moment() == pytest.approx(moment, abs=4e-15)


def test_cubics_are_exact() -> None:
    """A single cubic has its ends, its derivatives, and no jump of the third derivative."""
    rng = np.random.default_rng(5)
    p, q, leave, arrive = rng.uniform(-1.0, 1.0, (4, 20, 2))
    vertices = cubic_vertices(p, q, leave, arrive)
    third = np.diff(vertices, n=3, axis=1)
    assert np.abs(np.diff(third, axis=1)).max() < 1e-14
    for row in range(20):
        chain = FormChain.of([vertices[row]])
        assert chain.at(0, [0.0, 4.0]) == pytest.approx(np.array([p[row], q[row]]), abs=1e-14)
        got = chain.tangent(0, [0.0, 4.0])
        assert got == pytest.approx(np.array([leave[row], arrive[row]]), abs=1e-14)
