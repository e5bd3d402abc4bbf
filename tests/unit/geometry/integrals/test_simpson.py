"""Simpson's rule in runs of equal spacing."""

import numpy as np
import pytest

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.integrals.stations import integrate_by_simpson, simpson_weights
from tests.cases import versluis


def test_the_carrier_of_versluis_has_its_values_to_the_last_digit() -> None:
    """V 39,670.8 m3, CB .749637, LCB 2.924 m forward of midship, KB 5.482 m."""
    x, area = versluis.X, versluis.AREAS
    columns = np.stack([area, area * x, versluis.MOMENTS], axis=1)
    volume, lengthwise, upward = integrate_by_simpson(x, columns).tolist()
    box = versluis.LPP * versluis.BREADTH * versluis.DRAUGHT
    assert f"{volume:.1f}" == "39670.8"
    assert f"{volume / box:.6f}" == "0.749637"
    assert f"{lengthwise / volume - versluis.LPP / 2.0:.3f}" == "2.924"
    assert f"{upward / volume:.3f}" == "5.482"


def test_cubics_are_exact_over_runs_of_other_spacing() -> None:
    """Each run of equal steps integrates cubics exactly, whatever the rounding of its places."""
    x = np.concatenate([np.linspace(0.0, 1.0, 5), np.linspace(1.0, 7.0, 19)[1:], [7.1, 7.2]])
    found = integrate_by_simpson(x, np.stack([x**0, x, x**2, x**3], axis=1))
    np.testing.assert_allclose(found, [7.2 ** (k + 1) / (k + 1) for k in range(4)], rtol=1e-13)
    assert simpson_weights(np.array([0.0, 1, 2])).tolist() == [1 / 3, 4 / 3, 1 / 3]


@pytest.mark.parametrize(
    ("x", "words"),
    [
        ([0.0, 1.0], "1 equal step.s. from x = 0 to 1 m"),
        ([0.0, 1.0, 2.0, 4.0, 6.0, 8.0], "3 equal step.s. from x = 2 to 8 m"),
        ([0.0, 1.0, 2.0, 3.1, 4.0], "1 equal step.s. from x = 2 to 3.1 m"),
        ([0.0, 2.0, 1.0], "do not ascend"),
        ([0.0, 1.0, float("nan")], "not finite"),
    ],
)
def test_uneven_runs_are_refused_with_their_place(x: list[float], words: str) -> None:
    """An odd number of equal steps, and places out of order, are named."""
    with pytest.raises(BadInputError, match=words):
        integrate_by_simpson(x, np.zeros(len(x)))
