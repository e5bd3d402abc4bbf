"""What an open edit has reached: of which objects it is told, with because of what, and to whom."""

from __future__ import annotations

import threading

import numpy as np
import pytest

from assoc_hull.errors import BadInputError, UnknownNameError
from assoc_hull.graph.run_update import closure, spread
from assoc_hull.hull import Hull
from assoc_hull.model.network import HullNetwork
from assoc_hull.model.node import Node
from tests.conftest import Shipped
from tests.formed import formed
from tests.net_strategies import fresh

_POINT = "WL 2.5 x ST 7"


@pytest.fixture
def wigley(shipped: Shipped) -> Hull:
    """The Wigley hull, one's own."""
    return shipped("wigley")


def test_what_a_moved_point_reaches_is_dirty_until_the_edit_ends(wigley: Hull) -> None:
    """Its two curves, and what is computed from these; all else is clean."""
    assert not wigley.dirty
    with wigley.edit("fuller") as edit:
        assert not wigley.dirty
        edit.move(_POINT, y=2.95)
        dirty = wigley.dirty
        assert {"WL 2.5", "ST 7", _POINT} <= set(dirty)
        assert str(wigley.points[_POINT].dirty) == f"because of the move of {_POINT}"
        assert str(wigley.lines["ST 7"].dirty) == str(wigley.lines["ST 7"].curves[0].dirty)
        assert str(dirty["st 7"]) == f"because of the move of {_POINT}, through {_POINT}"
        assert wigley.lines["ST 3"].dirty is None
        assert wigley.points["WL 5 x ST 3"].dirty is None
        assert str(dirty).startswith(f"dirty because of the move of {_POINT}: ")
        with pytest.raises(UnknownNameError):
            dirty["ST 3"]
    assert not wigley.dirty
    assert wigley.lines["ST 7"].dirty is None
    assert "ST 7" in dirty, "what was told stays as it was told"


def test_each_object_names_what_reached_it_first(wigley: Hull) -> None:
    """Of several modifications of one edit."""
    with wigley.edit("two") as edit:
        edit.move(_POINT, y=2.95)
        edit.pull("WL 2.5 x ST 15", 0.01, radius=(8.0, 1.0))
        dirty = wigley.dirty
        assert dirty.asked == (f"the move of {_POINT}", "the pull at WL 2.5 x ST 15")
        assert str(wigley.lines["ST 7"].dirty).startswith(f"because of the move of {_POINT}")
        assert str(wigley.lines["ST 15"].dirty).startswith("because of the pull at WL 2.5 x ST 15")


@pytest.mark.parametrize("act", ["lead", "insert", "fair pull", "add_line"])
def test_what_may_follow_is_dirty_before_the_answer_is_known(shipped: Shipped, act: str) -> None:
    """A lead and a fair pull are solved when the edit ends: what they reach at most is dirty."""
    hull = shipped("wigley")
    place = np.add(hull.lines["WL 2.5"].curves[0].at(37.0), (0.0, 0.01, 0.0))
    with hull.edit(act) as edit:
        if act == "lead":
            edit.lead("WL 2.5", [place])
        elif act == "insert":
            edit.insert("WL 2.5", place)
        elif act == "fair pull":
            edit.pull(_POINT, 0.01, fair=True)
        else:
            edit.add_line("waterlines", 2.0)
        dirty = {each.id for each in hull.dirty.curves}
        first = str(hull.lines["WL 2.5"].dirty)
    assert edit.report is not None
    assert set(edit.report.relofted) <= dirty
    assert act == "add_line" or first.startswith("because of the ")


def test_a_drag_tells_what_its_last_step_reaches(wigley: Hull) -> None:
    """And changes nothing by that."""
    before = wigley.fingerprint
    with wigley.drag(_POINT, radius=(20.0, 4.0)) as drag:
        assert not drag.dirty
        drag.to(d=0.01)
        assert {"ST 7", "WL 2.5", _POINT} <= set(drag.dirty)
        assert str(drag.dirty["ST 7"]).startswith(f"because of the pull at {_POINT}")
        assert not wigley.dirty
        assert wigley.fingerprint == before
        lofted = set(drag.commit("fuller").relofted)
    with pytest.raises(BadInputError, match="it has ended"):
        _ = drag.dirty
    wigley.undo()
    with wigley.drag(_POINT, radius=(20.0, 4.0)) as drag:
        drag.to(d=0.01)
        assert lofted <= {each.id for each in drag.dirty.curves}
        drag.to(d=1e9)
        assert not drag.dirty


def test_nobody_else_sees_what_is_dirty(wigley: Hull) -> None:
    """Another thread reads the hull as it was published: there all is clean."""
    seen = list[object]()
    with wigley.edit("fuller") as edit:
        edit.move(_POINT, y=2.95)
        other = threading.Thread(
            target=lambda: seen.extend([len(wigley.dirty), wigley.lines["ST 7"].dirty])
        )
        other.start()
        other.join()
    assert seen == [0, None]


def test_the_graph_and_why_use_the_word(wigley: Hull) -> None:
    """Inside an edit: nodes have a cause, and `why` begins with it."""
    with wigley.edit("fuller") as edit:
        edit.move(_POINT, y=2.95)
        graph = wigley.graph(only="dirty")
        assert wigley.lines["ST 7"].curves[0].id in graph
        assert all(data["dirty"].startswith("because of") for _, data in graph.nodes(data=True))
        whole = wigley.graph()
        assert "dirty" not in whole.nodes[wigley.lines["ST 3"].curves[0].id]
        first = str(wigley.why("ST 7")).splitlines()[0]
        assert first == f"ST 7 is dirty because of the move of {_POINT}, through {_POINT}"
    assert len(wigley.graph(only="dirty")) == 0
    assert "dirty" not in str(wigley.why("ST 7"))


def test_the_picture_tints_what_is_dirty(wigley: Hull) -> None:
    """And names what was asked for in its block."""
    with wigley.edit("fuller") as edit:
        edit.move(_POINT, y=2.95)
        figure = wigley.plot.dirty(paper="A4")
    texts = {each.get_text() for each in figure.axes[0].texts}
    assert f"the move of {_POINT}" in texts
    colours = {line.get_gid(): line.get_color() for line in figure.axes[0].lines}
    assert colours["body/sections/ST 7"] != colours["body/sections/ST 6"]
    dots = [line for line in figure.axes[0].lines if line.get_gid() == "dirty points"]
    assert sum(np.size(line.get_xdata()) for line in dots) == 2


def test_steps_have_one_number_everywhere(wigley: Hull) -> None:
    """History, why and graph, also where an undone edit has left a gap."""
    for y in (2.93, 2.94, 2.95):
        with wigley.edit(f"to {y}") as edit:
            edit.move(_POINT, y=y)
        if y == 2.94:
            wigley.undo()
    assert [each.number for each in wigley.history] == [1, 3]
    assert wigley.why("ST 7").step == 3
    assert wigley.why("ST 7", step=1).edit == "to 2.93"
    assert wigley.why("ST 7", step=-1) == wigley.why("ST 7")
    assert set(wigley.graph(step=3)) == set(wigley.graph(step=-1))
    away = wigley.why("ST 3", step=3)
    assert (away.edit, away.step, away.what) == ("to 2.95", 3, "not reached by this edit")
    with pytest.raises(BadInputError, match="give one of 1, 3"):
        wigley.why("ST 7", step=2)
    with pytest.raises(BadInputError, match="give one of 1, 3"):
        wigley.graph(step=2)


def test_why_of_a_pull_begins_with_it_and_leaves_out_what_hardly_moved(wigley: Hull) -> None:
    """By a hundredth of the largest, or by what is asked."""
    with wigley.edit("fuller") as edit:
        edit.pull(_POINT, 0.02, radius=(20.0, 4.0))
    first = str(wigley.why("ST 7")).splitlines()[0]
    assert first == f"edit 1, 'fuller', because of the pull at {_POINT}:"
    every, few = wigley.why("ST 7", least=0.0), wigley.why("ST 7", least=0.015)
    assert every.left == 0
    assert len(few.causes) + few.left == len(every.causes)
    assert all(each.moved is not None and each.moved >= 0.015 for each in few.causes)
    assert f"and {few.left} that moved less" in str(few)
    assert len(wigley.why("ST 7", least=1.0).causes) == 1
    with pytest.raises(BadInputError, match="least"):
        wigley.why("ST 7", least=-1.0)


def test_spread_gives_the_closure_each_node_with_a_source_in_it(wigley: Hull) -> None:
    """Seeds come through themselves, and each other node through one that it reads."""
    state = wigley.document.state
    network = HullNetwork(state, wigley.document.index_of(state))
    seeds = Node.point(state.live("rows")[[3, 40]])
    pairs, whole = spread(network, seeds), closure(network, seeds)
    assert sorted(pairs.reader.tolist()) == whole.tolist()
    known = set[int]()
    for node, source in zip(pairs.reader.tolist(), pairs.source.tolist(), strict=True):
        known.add(node)
        assert source in known
        if node != source:
            assert node in network.readers(whole[whole == source]).reader


def test_definitions_with_other_values_are_dirty_with_all_that_is_made_of_them() -> None:
    """Because of their new values."""
    hull = Hull(formed())
    with hull.edit("fuller run") as edit:
        edit.set_form("areas", run_area=0.52)
        dirty = hull.dirty
        assert [each.name for each in dirty.definitions] == ["areas"]
        assert dirty.asked == ("the new values of areas",)
        assert "1 definition" in str(dirty)
        curves = {each.id for each in dirty.curves}
    assert edit.report is not None
    assert set(edit.report.relofted) <= curves


def test_what_lies_beyond_the_end_of_a_section_that_leads_may_be_dirty() -> None:
    """A point beside the line bends it, and so where the deck edge lies along it."""
    hull = fresh(0)
    curve = hull.lines["ST 5"].curves[0]
    place = curve.at(0.884 * curve.span) + np.array([0.0, 0.03125, 0.0])
    with hull.edit("lead") as edit:
        edit.lead(curve, [place])
        dirty = {each.id for each in hull.dirty.curves}
    assert edit.report is not None
    assert "boundary:deck edge/1" in edit.report.relofted
    assert set(edit.report.relofted) <= dirty


def test_a_lead_whose_line_goes_in_the_same_edit_is_dirty_until_its_end_refuses_it() -> None:
    """Asking in between raises nothing."""
    hull = fresh(0)
    x, y, z = hull.lines["ST 5"].curves[0].at(3.0)
    seen = list[bool]()

    def lead_and_remove() -> None:
        with hull.edit("lead") as edit:
            edit.lead("ST 5", [(x, y + 0.01, z)])
            edit.remove_line("ST 5")
            seen.append(bool(hull.dirty))

    with pytest.raises(BadInputError, match="use two edits"):
        lead_and_remove()
    assert seen == [True]
    assert not hull.dirty
