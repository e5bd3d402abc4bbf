"""What the parts of `edit.modifications` give, one small example of each."""

from __future__ import annotations

import re

import pytest

from assoc_hull.edit.document import Document
from assoc_hull.edit.session import Edit
from assoc_hull.errors import BadInputError, UnknownNameError
from assoc_hull.shipped.wigley import wigley


def test_giving_a_definition_other_values_whatever_is_generated() -> None:
    """Giving a definition other values: whatever is generated from it follows."""
    with (
        pytest.raises(
            UnknownNameError,
            match=re.escape(
                "there is no definition named 'sectional areas'; there is none of any name"
            ),
        ),
        Edit(Document(wigley()), "fuller") as edit,
    ):
        edit.set_form("sectional areas", run_area=0.52)


def test_returning_lines_to_the_definitions_what_was_drawn() -> None:
    """Returning lines to the definitions: what was drawn by hand gives way, at the designer's
    wish."""
    with pytest.raises(BadInputError), Edit(Document(wigley()), "back") as edit:
        edit.reattach("ST 7")
