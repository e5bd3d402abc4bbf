"""The net of a classical definition: its lines adopted, waterlines and buttocks cut.

Boundary lines give their ends to all others; sections and waterlines make one another, and both
make the buttocks. Flat ends are transoms.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Protocol

from assoc_hull.arguments import shown
from assoc_hull.creation.classical.bodies_beside import put_bodies
from assoc_hull.edit.adoption.adopt_lines import AdoptionReport, adopt
from assoc_hull.edit.document import Document
from assoc_hull.edit.lines.add_line import add_line
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import BadInputError
from assoc_hull.model.attached_body import AttachedBody
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.tables import Association, HullState, Particulars
from assoc_hull.tolerance import Tolerances

if TYPE_CHECKING:
    from assoc_hull.creation.classical.report import ClassicalReport

__all__ = ["LINKS", "TOLERANCES", "ClassicalDefinition", "classical_net"]

LINKS = tuple(
    Association(a, b)
    for a, b in (
        ("boundary", "sections"),
        ("boundary", "waterlines"),
        ("sections", "waterlines"),
        ("boundary", "buttocks"),
        ("sections", "buttocks"),
        ("waterlines", "buttocks"),
    )
)
"""Which lines give points to which, and back."""

TOLERANCES = Tolerances(adopted_spacing=0.01)
"""Arcs of small radius have points closer than one adopts elsewhere."""


class ClassicalDefinition(Protocol):
    """What a definition of a whole hull can tell.

    Attributes
    ----------
    kind : str
        Of the text it is written in, in capitals.
    particulars : Particulars
        Name and principal dimensions.
    notes : tuple of str
        What was moved, left out or looked odd, a sentence each.
    cuts : mapping of str to sequence of float, m
        Where the net is cut by planes of further lines: ``"waterlines"``, ``"buttocks"``.
    """

    @property
    def kind(self) -> str:
        """The kind."""
        ...

    @property
    def particulars(self) -> Particulars:
        """Dimensions."""
        ...

    @property
    def notes(self) -> tuple[str, ...]:
        """Sentences."""
        ...

    @property
    def cuts(self) -> Mapping[str, Sequence[float]]:
        """Further planes."""
        ...

    def lines(self) -> tuple[LineSource, ...]:
        """Give sections, waterlines and boundary lines."""
        ...

    def bodies(self) -> tuple[AttachedBody, ...]:
        """Give what stands beside the net: hatches, deck houses, boxes, appendages."""
        ...

    def report(self, state: HullState | None = None) -> ClassicalReport:
        """Give its own exact numbers, beside those of a net of it if one is handed in."""
        ...


def classical_net(
    definition: ClassicalDefinition, tolerances: Tolerances = TOLERANCES
) -> tuple[HullState, AdoptionReport]:
    """Make the net of a definition.

    Parameters
    ----------
    definition : ClassicalDefinition
        A whole hull.
    tolerances : Tolerances
        Of the net.

    Returns
    -------
    HullState, AdoptionReport
        The net, and how its lines were adopted.

    Raises
    ------
    GeometryError
        A line that the definition cannot give.
    BadInputError, NoMeetingError, RefusedEditError
        Lines of which no net can be made, or a plane that misses it.

    Examples
    --------
    >>> from assoc_hull.creation.classical.middle_body import MiddleBody
    >>> from assoc_hull.creation.classical.classical_net import classical_net
    >>> from assoc_hull.creation.classical.middle_body import Midship
    >>> body = MiddleBody(Midship(16.0, 2.0, 0.3, 2.5), length=40.0, depth=14.0, draught=9.0)
    >>> state, report = classical_net(body)
    >>> print(f"{body.volume(9.0):.5f}")
    11249.94226
    """
    if not all(hasattr(definition, each) for each in ("lines", "particulars", "cuts")):
        remedy = "give one that read_classical gives"
        raise BadInputError(f"the definition is {shown(definition)}", "in classical_net", remedy)
    state, report = adopt(definition.lines(), definition.particulars, LINKS, tolerances)
    document = Document(state)
    for group, places in definition.cuts.items():
        for place in places:
            with Transaction(document, f"cut {group} {place:g}") as edit:
                add_line(edit, group, place)
    if bodies := definition.bodies():
        with Transaction(document, "bodies beside the net") as edit:
            put_bodies(edit, bodies)
    return state, report
