"""What an open edit has reached so far: nodes of a hull, and through what each was reached."""

from __future__ import annotations

from collections.abc import Mapping

import attrs

__all__ = ["CLEAN", "DirtyNodes"]


@attrs.frozen(eq=False)
class DirtyNodes:
    """The nodes that an update could have to evaluate, if it ran now.

    Attributes
    ----------
    asked : tuple of str
        What was asked for, in words.
    by : dict of int to int
        By node, which of `asked` has reached it.
    source : dict of int to int
        By node, the node through which it was reached; itself, if it was asked for.
    perhaps : frozenset of int
        Curves that are none of these, and are lofted only where a gap has to be mended, a crossing
        is born, or a feature that was bent by a little is drawn anew.
    """

    asked: tuple[str, ...] = ()
    by: Mapping[int, int] = attrs.field(factory=dict)
    source: Mapping[int, int] = attrs.field(factory=dict)
    perhaps: frozenset[int] = frozenset()

    def way(self, node: int) -> list[int]:
        """Give the nodes from what was asked for to one that is dirty, this included."""
        found = [node]
        while self.source[found[-1]] != found[-1]:
            found.append(self.source[found[-1]])
        return found[::-1]


CLEAN = DirtyNodes()
"""Nothing is dirty."""
