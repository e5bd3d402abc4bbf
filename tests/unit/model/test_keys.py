"""Keys of points: texts that take the room of numbers, and come back letter by letter."""

from __future__ import annotations

import pickle

import pytest
from hypothesis import given
from hypothesis import strategies as st

from assoc_hull.graph.journal import Journal
from assoc_hull.model.keys import KeyColumn, Keys, LabelColumn, Labels, crossing_key

ODD = [
    "", " ", " x ", "a x b", "a x b ", "a x b +", "a x b +0", "a x b +01", "a x b 1", "a x b +1 ",
    "a x b x c -12", " x  x  o3", "a  x  b +1", "a x b +1.0", "a x b +123456789", "a x b ++1",
    "WL x 1 x ST 4 +1~2", "curve/1 @ (1.0000, 2.0000, 3.0000)", "a x b +\u0663", "\u00e4 x b o7",
]  # fmt: skip
LINES = st.sampled_from(["WL 1", "ST x 4", "", "buttocks:0.258065", " "])
CROSSINGS = st.builds(crossing_key, LINES, LINES, st.sampled_from([-1, 0, 1]), st.integers(1, 99))
TEXTS = st.one_of(st.sampled_from(ODD), CROSSINGS, st.text("ax +-o12", max_size=12))
ACTS = st.one_of(
    st.tuples(st.just("set"), st.integers(0, 30), TEXTS),
    st.tuples(st.sampled_from(["grow", "shrink", "share"]), st.integers(0, 12), TEXTS),
)


@pytest.mark.parametrize("kind", [KeyColumn, LabelColumn])
@given(acts=st.lists(ACTS, max_size=50))
def test_a_column_holds_what_a_list_of_texts_would(
    kind: type[KeyColumn | LabelColumn], acts: list[tuple[str, int, str]]
) -> None:
    """Whatever text is written, and whatever is shared meanwhile."""
    column, wanted = kind(), list[str]()
    kept = list[tuple[KeyColumn | LabelColumn, list[str]]]()
    for act, size, text in acts:
        if act == "share":
            kept.append((column.share(), list(wanted)))
        elif act == "set":
            if wanted:
                column.store[size % len(wanted)] = text
                wanted[size % len(wanted)] = text
        else:
            count = len(wanted) + size if act == "grow" else max(0, len(wanted) - size)
            column.resize(count)
            wanted = [*wanted[:count], *[""] * (count - len(wanted))]
        assert list(column.data) == wanted
        assert all((text in column.data) == (text in wanted) for text in [*ODD, text])
    for shared, texts in kept:
        assert shared.data == texts
    assert pickle.loads(pickle.dumps(column)).data == wanted


@pytest.mark.parametrize("kind", [Keys, Labels])
def test_texts_are_read_as_a_list_is(kind: type[Keys | Labels]) -> None:
    """By number, from the end, by slices, and whether they are there."""
    keys = kind(ODD)
    assert [keys[row] for row in range(-len(ODD), len(ODD))] == ODD + ODD
    assert keys[3:9:2] == ODD[3:9:2]
    assert ("a x b +0" in keys, "b x a +1" in keys) == (True, False)
    assert keys.index("a x b x c -12") == ODD.index("a x b x c -12")
    with pytest.raises(IndexError):
        keys[len(ODD)]
    keys[:] = ODD[::-1]
    assert keys == ODD[::-1]


def test_a_written_key_is_taken_back() -> None:
    """The journal writes keys as it writes any values."""
    column, journal = KeyColumn(), Journal()
    column.resize(2)
    journal.set(column, [0, 1], ["a x b +1", "a x b -2"])
    journal.set(column, [0], ["c"])
    net = journal.net(column)
    assert (net.old, net.new) == (["", ""], ["c", "a x b -2"])
    journal.undo()
    assert column.data == ["", ""]
