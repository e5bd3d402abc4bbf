"""What the parts of `edit.explain` give, one small example of each."""

from __future__ import annotations

from assoc_hull.edit.document import Document
from assoc_hull.edit.explain.compare_states import compare_labelled, compare_states
from assoc_hull.edit.session import Edit
from assoc_hull.shipped.wigley import wigley


def test_two_states_of_a_hull_side_by_side() -> None:
    """Two states of a hull side by side: which lines differ, how far, and the principal
    numbers."""
    assert (
        str(compare_states(wigley(), wigley(), ("as it was", "as it is")))
        == "as it was -> as it is: 0 lines differ"
    )


def test_the_hull_as_it_was_after_any_step_beside() -> None:
    """The hull as it was after any step, beside the hull as it is."""
    document = Document(wigley())
    _ = document.label("as it came")
    with Edit(document, "fuller") as edit:
        edit.move("WL 2.5 x ST 7", y=2.95)
    assert compare_labelled(document, "as it came", None).lines[0].line == "WL 2.5"
