"""What the parts of `edit` give, one small example of each."""

from __future__ import annotations

from assoc_hull.edit.document import Document
from assoc_hull.edit.script import replay
from assoc_hull.edit.session import Edit
from assoc_hull.shipped.wigley import wigley


def test_the_edits_of_one_hull_made_again_on_another() -> None:
    """The edits of one hull made again on another."""
    one, other = Document(wigley()), Document(wigley(breadth=11.0))
    with Edit(one, "fuller") as edit:
        edit.move("WL 2.5 x ST 7", y=2.95)
    assert [str(each) for each in replay(other, one.history)] == ["fuller: made again"]
