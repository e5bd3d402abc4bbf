"""Why tells edit, causes and amounts, back to what the designer set."""

import numpy as np
import pytest

from assoc_hull.edit.document import Document
from assoc_hull.edit.explain.causes import node_of, why
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import BadInputError, ForeignPointError
from assoc_hull.graph.journal import Journal
from assoc_hull.graph.run_update import CauseTracer, Readers, cause_chain
from assoc_hull.model.address import resolve_address
from assoc_hull.model.kinds import Role
from assoc_hull.model.make_objects import Maker
from assoc_hull.model.objects import Line, Point, handle
from assoc_hull.shipped.wigley import wigley

POINT = "WL 2.5 x ST 7"


@pytest.fixture
def document() -> Document:
    """A hull where ST 7 drives WL 5, so that a chain has two curves."""
    state = wigley()
    row = resolve_address(state, "WL 5 x ST 7").row
    Maker(state, Journal()).roles(np.array([row]), np.array([Role.DRIVES_B]))
    curve = resolve_address(state, "ST 7 [1]").curve
    rows = state.curves.rows[curve]
    Maker(state, Journal()).define(curve, rows[rows != row])
    return Document(state)


def move(document: Document, name: str, dy: float, address: str = POINT) -> None:
    """Move one point along y."""
    row = resolve_address(document.state, address).row
    value = document.state.rows.xyz[[row]] + [[0.0, dy, 0.0]]
    with Transaction(document, name) as edit:
        edit.write(np.array([row]), value, name)


def test_nothing_has_reached_a_new_hull(document: Document) -> None:
    """Without an edit there is no cause."""
    found = why(document, node_of(document.state, "WL 2.5"))
    assert (found.edit, found.step, found.causes) == (None, 0, ())
    assert found.chain() == ["waterlines:2.500000/1"]


def test_the_chain_leads_back_to_the_edit(document: Document) -> None:
    """Curve, driven point, driver, and the point that was set, each with its movement."""
    move(document, "fair", 0.01)
    found = why(document, node_of(document.state, "WL 5"))
    keys = document.state.rows.key.data
    assert found.chain() == [
        "waterlines:5.000000/1",
        keys[resolve_address(document.state, "WL 5 x ST 7").row],
        "sections:35.000000/1",
        keys[resolve_address(document.state, POINT).row],
    ]
    assert (found.edit, found.step) == ("fair", 1)
    last = found.causes[0].causes[0].causes[0]
    assert last.what == "set by the edit"
    assert last.moved is None or last.moved == pytest.approx(0.01)
    assert found.causes[0].moved is not None
    assert 0.0 < found.causes[0].moved < 0.01


def test_the_text_is_an_indented_tree(document: Document) -> None:
    """One object a line, deeper for each cause."""
    move(document, "fair", 0.01)
    lines = str(why(document, node_of(document.state, "WL 5"))).splitlines()
    assert lines[0] == "edit 1, 'fair':"
    assert lines[1].startswith("WL 5: followed, moved ")
    told = [line for line in lines[1:] if not line.lstrip().startswith("stopped at")]
    assert [len(line) - len(line.lstrip()) for line in told] == [0, 2, 4, 6]


def test_the_last_edit_that_reached_the_object_is_told(document: Document) -> None:
    """Later edits elsewhere play no part; an undone one neither."""
    move(document, "first", 0.01)
    move(document, "second", 0.01)
    move(document, "elsewhere", 0.01, "WL 2.5 x ST 15")
    assert why(document, node_of(document.state, "ST 7")).edit == "second"
    document.undo(2)
    assert why(document, node_of(document.state, "ST 7")).edit == "first"


def test_a_watched_crossing_moves_with_its_curves(document: Document) -> None:
    """It has no value: its causes are the two curves."""
    row = resolve_address(document.state, "WL 1.25 x ST 7").row
    Maker(document.state, Journal()).roles(np.array([row]), np.array([Role.WATCHED]))
    move(document, "fair", 0.01)
    found = why(document, 2 * row)
    assert [each.name for each in found.causes] == ["ST 7", "WL 1.25"]
    assert found.edit == "fair"


def test_what_came_out_the_same_tells_why_it_stopped() -> None:
    """A node that was evaluated and did not change is known, with causes and no movement."""
    pushes = Readers(np.array([3, 5, 7, 7]), np.array([2, 3, 5, 3]))
    moved = np.array([np.nan, 0.1, 0.2])
    tracer = CauseTracer(pushes, np.array([2, 3, 5]), moved, np.array([2]))
    trace = tracer.trace(7)
    assert tracer.knows(7)
    assert not tracer.knows(9)
    assert trace.moved == 0.0
    assert [each.node for each in trace.causes] == [5, 3]
    assert cause_chain(trace) == [7, 5, 3, 2]
    assert tracer.cut_off(3) == (7,)


def test_a_ring_over_two_passes_ends() -> None:
    """A later pass may run the other way; the tree stays finite."""
    pushes = Readers(np.array([3, 5, 3]), np.array([2, 3, 5]))
    tracer = CauseTracer(pushes, np.array([2, 3, 5]), np.array([np.nan, 0.1, 0.2]), np.array([2]))
    assert len(cause_chain(tracer.trace(5))) <= 4


def test_a_cut_off_curve_is_explained(document: Document) -> None:
    """The edit that evaluated it last, and that it came out with the same bits."""
    move(document, "fair", 0.01)
    import attrs

    node = node_of(document.state, "WL 5")
    step = document.history[0]
    kept = step.changed != node
    step.replace(attrs.evolve(step.body, changed=step.changed[kept], moved=step.moved[kept]))
    found = why(document, node)
    assert "same bits" in found.what
    assert found.edit == "fair"
    driver = why(document, 2 * resolve_address(document.state, "WL 5 x ST 7").row)
    assert driver.stopped == ("WL 5",)


def test_handles_of_other_hulls_and_groups_are_refused(document: Document) -> None:
    """Only objects of this hull, only points and curves."""
    with pytest.raises(ForeignPointError):
        node_of(document.state, Point.of(wigley(), 0))
    with pytest.raises(BadInputError):
        node_of(document.state, "waterlines")
    line = handle(document.state, "ST 7")
    assert isinstance(line, Line)
    assert node_of(document.state, line) == node_of(document.state, line.curves[0])
