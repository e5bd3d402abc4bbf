"""What a study is asked for is understood, or refused before anything is made."""

from typing import Any

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.study.design import OUTPUTS, StudyDesign
from assoc_hull.variation.fields.bounded_functions import BlendChain
from assoc_hull.variation.fields.field import AffinePiece, StackedField, level_boundaries
from assoc_hull.variation.fields.layers import FieldLayer


def fuller() -> FieldLayer:
    """Broaden the fore body by 2 %."""
    piece = AffinePiece.along(BlendChain.through([60.0, 90.0], [0.0, 1.0]), 0.02, 0.0)
    return FieldLayer(
        "fuller", (StackedField("fuller", "y", level_boundaries(["base"], [0.0]), (piece,)),)
    )


def test_a_value_holds_for_all_variants_and_a_row_for_each() -> None:
    """Single values are repeated; rows by variant and columns by name are one and the same."""
    by_name = StudyDesign.of(set={"draught": 6.0}, reach={"volume": [1.0, 2.0]}, free=["breadth"])
    rows = [{"volume": 1.0}, {"volume": 2.0}]
    by_row = StudyDesign.of(set={"draught": 6.0}, reach=rows, free=["breadth"])
    for design in (by_name, by_row):
        assert design.names == ("draught", "breadth")
        assert design.values.tolist() == [[6.0], [6.0]]
        assert design.targets.tolist() == [[1.0], [2.0]]
    assert by_name.outputs == OUTPUTS


def test_a_layer_is_set_free_or_acts_as_it_is() -> None:
    """By its name, or itself among what is free."""
    layer, aim = fuller(), {"volume": 2700.0}
    held = StudyDesign.of(layers=[layer], set={"fuller": [0.5, 1.5]})
    assert held.given == ("fuller",)
    assert held.values.ravel().tolist() == [0.5, 1.5]
    for free in (StudyDesign.of(layers=[layer], reach=aim, free=["fuller"]),
                 StudyDesign.of(reach=aim, free=[layer], bounds={"fuller": (-1, 3)})):  # fmt: skip
        assert free.free == ("fuller",)
        assert free.layers == (layer,)
    assert free.bounds.tolist() == [[-1.0, 3.0]]
    beside = StudyDesign.of(layers=[layer], set={"breadth": [10.0, 11.0]})
    assert beside.given == ("breadth", "fuller")
    assert beside.values[:, 1].tolist() == [1.0, 1.0]


WRONG: dict[str, tuple[dict[str, Any], str]] = {
    "nothing asked": ({}, "nothing is asked for"),
    "no such parameter": ({"set": {"bredth": 3.0}}, "'breadth'"),
    "set and free": (
        {"set": {"breadth": 3.0}, "reach": {"volume": 3.0}, "free": ["breadth"]}, "set as well",
    ),
    "free twice": ({"reach": {"volume": 3.0}, "free": ["breadth", "breadth"]}, "free twice"),
    "too little free": (
        {"reach": {"volume": 3.0, "lcb": 3.0}, "free": ["breadth"]},
        "2 targets need at least 2 free parameters",
    ),
    "free for nothing": ({"set": {"draught": 3.0}, "free": ["breadth"]}, "nothing to reach"),
    "other lengths": ({"set": {"breadth": [3, 4], "draught": [3, 4, 5]}}, "draught has 3 values"),
    "other names by row": (
        {"reach": [{"volume": 3.0}, {"lcb": 3.0}], "free": ["breadth"]}, "same outputs",
    ),
    "no number": ({"set": {"breadth": [3.0, np.nan]}}, "breadth is"),
    "no values": ({"set": {"breadth": []}}, "breadth has 0 values"),
    "bound of another": (
        {"reach": {"volume": 3.0}, "free": ["breadth"], "bounds": {"draught": (1, 2)}}, "'draught'",
    ),
    "two of a name": ({"layers": [fuller(), fuller()]}, "two parameters are called 'fuller'"),
}  # fmt: skip


@pytest.mark.parametrize(("asked", "words"), WRONG.values(), ids=WRONG)
def test_what_makes_no_study_is_refused(asked: dict[str, Any], words: str) -> None:
    """In one line that says what, before the hull is looked at."""
    with pytest.raises(ah.AssocHullError, match=words) as caught:
        StudyDesign.of(**asked)
    assert "\n" not in str(caught.value)


def test_a_parameter_that_the_parent_lacks_is_refused() -> None:
    """With what it lacks."""
    with pytest.raises(ah.errors.BadInputError, match="cannot vary 'bulb_length'"):
        ah.examples.wigley(stations=9, waterlines=6).study(set={"bulb_length": 3.0})


@pytest.mark.parametrize("asked", [{"set": {"breadth": 10.0}, "outputs": ["volum"]},
                                   {"reach": {"volum": 3.0}, "free": ["breadth"]}],
                         ids=["told", "aimed at"])  # fmt: skip
def test_an_output_that_is_none_is_refused(asked: dict[str, Any]) -> None:
    """With the nearest names."""
    with pytest.raises(ah.errors.UnknownNameError, match="'volume'"):
        ah.examples.wigley(stations=9, waterlines=6).study(**asked)


@pytest.mark.parametrize("name", ["number", "failure", "kmt", "asked volume"])
def test_a_layer_whose_column_would_be_covered_is_refused(name: str) -> None:
    """By an output, or what each row tells."""
    layer = FieldLayer(name, fuller().fields)
    with pytest.raises(ah.errors.BadInputError, match="name of another column"):
        StudyDesign.of(set={name: [0.2, 0.4]}, layers=[layer], outputs=["volume", "kmt"])
