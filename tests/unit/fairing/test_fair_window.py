"""A window that is faired by hand shows at each step what its commit does."""

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.errors import BadInputError, UnknownNameError
from tests.conftest import Shipped
from tests.noisy_nets import put_noise

WIDTH = 1.6e-3


@pytest.mark.parametrize(
    ("name", "at", "radius"),
    [
        ("wigley", "WL 3.75 x ST 8", (20.0, 4.0)),
        ("series60_70", "WL 0.5 x ST 16", (12.0, 2.5)),
        ("wigley", "WL 3.75 x ST 8", (80.0, 20.0)),
    ],
)
def test_a_step_shows_what_the_commit_does(
    name: str, at: str, radius: tuple[float, float], shipped: Shipped
) -> None:
    """Points to the rounding of displacements, curves as near; and nothing before."""
    hull = shipped(name)
    put_noise(hull, WIDTH)
    print_ = hull.fingerprint
    window = hull.fair_window(at=at, radius=radius)
    window.to(noise=3e-3)
    frame = window.to(noise=1e-3)
    assert hull.fingerprint == print_
    assert (frame.noise, frame.radius) == (1e-3, radius)
    before, shapes = hull.state.rows.xyz[frame.rows], frame.shapes
    problem_moves = np.abs(frame.displacement) > 1e-6
    report = window.commit("by hand")
    assert hull.history[-1].name == "by hand"
    assert report.found.unknowns == len(frame.rows)
    step = np.linalg.norm(hull.state.rows.xyz[frame.rows] - before, axis=1)
    far = np.abs(frame.displacement)[problem_moves]
    assert (step[problem_moves] >= far - 1e-6).all()
    shown = {
        curve: shapes.spline.curve(place) for place, curve in enumerate(shapes.curves.tolist())
    }
    for curve in shapes.curves.tolist():
        now = hull.state.spline(curve)
        if len(now.knot) == len(shown[curve].knot):
            off = np.linalg.norm(now.xyz - shown[curve].xyz, axis=1)
            assert np.median(off) < 5e-5


def test_another_radius_and_another_noise_are_kept_from_step_to_step() -> None:
    """What is not named is as it was."""
    hull = ah.examples.wigley()
    put_noise(hull, WIDTH)
    window = hull.fair_window(at=(40.0, 4.5, 3.75), radius=(20.0, 4.0))
    first = window.to(noise=1e-3)
    wider = window.to(radius=(30.0, 4.0))
    assert (wider.noise, wider.radius) == (1e-3, (30.0, 4.0))
    assert len(wider.rows) > len(first.rows)
    again = window.to(noise=1e-3, radius=(20.0, 4.0))
    assert np.array_equal(again.displacement, first.displacement)


def test_the_window_follows_the_hull() -> None:
    """After an edit the next step is that of a new window."""
    hull = ah.examples.wigley()
    window = hull.fair_window(at="WL 3.75 x ST 8", radius=(20.0, 4.0))
    window.to(noise=1e-3)
    put_noise(hull, WIDTH)
    new = hull.fair_window(at="WL 3.75 x ST 8", radius=(20.0, 4.0)).to(noise=1e-3)
    # the middle is where it was named
    old = window.to()
    assert np.abs(old.displacement - new.displacement).max() < 0.1 * WIDTH
    assert np.abs(new.displacement).max() > 0.1e-3


def test_what_is_wrong_with_a_window_is_said() -> None:
    """And nothing has changed."""
    hull = ah.examples.wigley()
    with pytest.raises(UnknownNameError):
        hull.fair_window(at="WL 99 x ST 8", radius=(20.0, 4.0))
    with pytest.raises(BadInputError, match="radi"):
        hull.fair_window(at="WL 3.75 x ST 8", radius=(0.0, 4.0))
    with pytest.raises(BadInputError, match="nothing to move"):
        hull.fair_window(at=(500.0, 0.0, 0.0), radius=(1.0, 1.0))
    window = hull.fair_window(at="WL 3.75 x ST 8", radius=(20.0, 4.0))
    with pytest.raises(BadInputError, match="noise is not stated"):
        window.to()
    with pytest.raises(BadInputError, match="no step was made"):
        window.commit()
    with pytest.raises(BadInputError, match="above 0"):
        window.to(noise=-1.0)
    assert hull.history == ()
