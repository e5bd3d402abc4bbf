"""Lines, groups and points are found however a person writes their names; nothing is guessed."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

import assoc_hull as ah
from assoc_hull.errors import UnknownNameError


@pytest.fixture(scope="module")
def hull() -> ah.Hull:
    """A hull that no test changes."""
    return ah.examples.series60(cb=0.70)


def spoken(name: str, lower: bool, comma: bool, spaces: int, zeros: int) -> str:
    """Write a name otherwise."""
    text = name.replace(".", ",") if comma else name
    text = text.lower() if lower else text
    if text[-1].isdigit():
        text += ("" if "," in text or "." in text else ".") + "0" * zeros if zeros else ""
    return text.replace(" ", " " * spaces)


WAYS = st.tuples(st.booleans(), st.booleans(), st.integers(0, 2), st.integers(0, 2))


@given(way=WAYS, number=st.integers(0, 10**6))
def test_a_line_is_found_however_it_is_written(
    hull: ah.Hull, way: tuple[bool, bool, int, int], number: int
) -> None:
    """By the hull, by its lines, and in those of its group."""
    names = list(hull.lines)
    line = hull.lines[names[number % len(names)]]
    text = spoken(line.name, *way)
    assert hull[text] == hull.lines[text] == line
    assert text in hull.lines
    assert text in hull


@given(one=WAYS, other=WAYS, number=st.integers(0, 10**6), sign=st.sampled_from("xX×"))
def test_a_crossing_is_found_however_it_is_written(
    hull: ah.Hull,
    one: tuple[bool, bool, int, int],
    other: tuple[bool, bool, int, int],
    number: int,
    sign: str,
) -> None:
    """From either line."""
    names = [name for name in hull.crossings if "#" not in name]
    name = names[number % len(names)]
    first, second = name.split(" x ")
    text = f"{spoken(first, *one)} {sign} {spoken(second, *other)}"
    assert hull[text] == hull.points[text] == hull[name]


def test_an_edit_takes_names_as_they_are_spoken() -> None:
    """And its script says them as the hull has them, or as they were said: it runs again."""
    hull = ah.examples.wigley()
    with hull.edit("move") as edit:
        edit.move("wl 2,50 x st 7", y=2.95)
    assert hull.points["WL 2.5 x ST 7"].y == 2.95
    again = ah.examples.wigley()
    again.replay(hull)
    assert again.fingerprint == hull.fingerprint


def test_what_two_lines_may_mean_is_not_guessed() -> None:
    """As it is written it is found; another way of writing it leads to neither."""
    hull = ah.examples.wigley()
    with hull.edit("a line") as edit:
        edit.add_line("waterlines", 2.6, "wl 2.5")
    assert hull["wl 2.5"].name == "wl 2.5"
    assert hull["WL 2.5"].name == "WL 2.5"
    with pytest.raises(UnknownNameError):
        hull["Wl 2.50"]
    assert "Wl 2.50" not in hull.lines


@pytest.mark.parametrize(
    "text", ["WL 2.51", "WL", "2.5", "WL 2.5 x", "x ST 7", "WL 2 5", "ST 1 0", "ST 1  0"]
)
def test_another_name_is_none(text: str) -> None:
    """Only the way of writing may differ."""
    hull = ah.examples.wigley()
    with pytest.raises(UnknownNameError):
        hull[text]


@pytest.mark.parametrize("text", ["WL2.5xST7", "wl 2,5X st 7", "WL 2.5×ST 7", "wl2.5 xST7"])
def test_a_crossing_needs_no_spaces(text: str) -> None:
    """Spaces do not matter beside the cross either."""
    assert ah.examples.wigley()[text].name == "WL 2.5 x ST 7"


def test_groups_are_found_however_they_are_written() -> None:
    """Where lines drive, where they are faired, and where one is added."""
    one, other = ah.examples.wigley(), ah.examples.wigley()
    for hull, drivers, group in (
        (one, ["sections", "profile"], "waterlines"),
        (other, ["Sections", "PROFILE"], "Waterlines"),
    ):
        with hull.edit("broader") as edit:
            edit.transform(scale=(1, 1.1, 1), drivers=drivers)
        with hull.edit("a line") as edit:
            edit.add_line(group, 3.0)
        hull.fair([group], noise=0.0005)
    assert one.fingerprint == other.fingerprint


def test_pictures_take_names_as_they_are_spoken() -> None:
    """A name that is no line is refused as ever."""
    hull = ah.examples.wigley()
    assert hull.plot.lines_plan(highlight=["wl 2,50"]).axes
    assert hull.plot.curvature_combs(["wl 2,50", "st07"]).axes
    assert hull.plot.neighbourhood("wl 2,50").axes
    with pytest.raises(UnknownNameError):
        hull.plot.lines_plan(highlight=["WL 2.51"])
