"""How the nodes of a hull's network are numbered: points, curves, and definitions.

The engine of `assoc_hull.graph` knows nodes by whole numbers only. Points have the even numbers,
curves the odd ones, and definitions by form parameters the even ones below zero. This module is
the only one that knows: others make nodes, ask of which kind they are, and take the numbers of
their objects back, one node or an array of them at a time.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.model.node import Node
>>> nodes = np.array([Node.point(3), Node.curve(3), Node.form(0)])
>>> Node.is_curve(nodes).tolist(), Node.is_form(nodes).tolist()
([False, True, False], [False, False, True])
>>> Node.number(nodes[Node.is_curve(nodes)]).tolist(), Node.form_number(int(nodes[2]))
([3], 0)
"""

from __future__ import annotations

from typing import TypeVar, overload

import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import IntArray

__all__ = ["Node"]

N = TypeVar("N", int, IntArray)


class Node:
    """Numbers of nodes; each function takes one number, or an array of them."""

    @staticmethod
    def point(row: N) -> N:
        """Give the node of a point."""
        return 2 * row

    @staticmethod
    def curve(curve: N) -> N:
        """Give the node of a curve."""
        return 2 * curve + 1

    @staticmethod
    def form(definition: N) -> N:
        """Give the node of a definition."""
        return -2 - 2 * definition

    @staticmethod
    def number(node: N) -> N:
        """Give the row of the point, or the number of the curve, that a node stands for."""
        return node >> 1

    @staticmethod
    def form_number(node: N) -> N:
        """Give the number of the definition that a node stands for."""
        return -1 - (node >> 1)

    @staticmethod
    @overload
    def is_curve(node: int) -> bool: ...

    @staticmethod
    @overload
    def is_curve(node: IntArray) -> NDArray[np.bool_]: ...

    @staticmethod
    def is_curve(node: int | IntArray) -> bool | NDArray[np.bool_]:
        """Tell whether a node is a curve."""
        return (node & 1) == 1

    @staticmethod
    @overload
    def is_form(node: int) -> bool: ...

    @staticmethod
    @overload
    def is_form(node: IntArray) -> NDArray[np.bool_]: ...

    @staticmethod
    def is_form(node: int | IntArray) -> bool | NDArray[np.bool_]:
        """Tell whether a node is a definition."""
        return node < 0

    @staticmethod
    @overload
    def is_point(node: int) -> bool: ...

    @staticmethod
    @overload
    def is_point(node: IntArray) -> NDArray[np.bool_]: ...

    @staticmethod
    def is_point(node: int | IntArray) -> bool | NDArray[np.bool_]:
        """Tell whether a node is a point."""
        return ((node & 1) == 0) & (node >= 0)
