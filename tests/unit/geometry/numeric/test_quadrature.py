"""Rules for integrals along a strip."""

import numpy as np
import pytest

from assoc_hull.geometry.numeric.quadrature import lobatto


@pytest.mark.parametrize("count", [2, 3, 4, 9, 33, 201])
def test_lobattos_rule_is_exact_to_its_degree(count: int) -> None:
    """To rounding, for the Legendre polynomials up to 2 n - 3; not for the next even one."""
    nodes, weights = lobatto(count)
    for degree in range(2 * count - 2):
        found = weights @ np.polynomial.Legendre.basis(degree)(2.0 * nodes - 1.0)
        assert found == pytest.approx(1.0 if degree == 0 else 0.0, abs=1e-14)
    beyond = weights @ np.polynomial.Legendre.basis(2 * count - 2)(2.0 * nodes - 1.0)
    assert abs(beyond) > 1.0 / (4.0 * count)


@pytest.mark.parametrize("count", [2, 5, 40, 201])
def test_nodes_of_lobattos_rule_rise_and_are_symmetric(count: int) -> None:
    """From end to end, each once; the weights are alike from either end, and above nil."""
    nodes, weights = lobatto(count)
    assert (nodes[0], nodes[-1]) == (0.0, 1.0)
    assert (np.diff(nodes) > 0.0).all()
    assert nodes + nodes[::-1] == pytest.approx(np.ones(count), abs=1e-15)
    assert weights == pytest.approx(weights[::-1], rel=1e-10)
    assert (weights > 0.0).all()
