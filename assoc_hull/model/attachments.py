"""What a hull holds beside its net, kind by kind: tunnels and bodies.

`ATTACHMENTS` is the one table of kinds: names, look-ups, records, fingerprints, steps and mappings
go through it. Each kind has a column of the settings of its own, for steps in hull files write the
whole of a column, and older files have steps that know one kind only.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TypeVar, cast

import attrs

from assoc_hull.arguments import plain_name
from assoc_hull.graph.table import ValueColumn
from assoc_hull.model.attached_body import AttachedBody
from assoc_hull.model.tables import HullState
from assoc_hull.model.tunnel_definition import TunnelDefinition

__all__ = [
    "ATTACHMENTS",
    "Attachment",
    "AttachmentKind",
    "attachment_named",
    "attachment_names",
    "attachment_records",
    "attachments_in_order",
]

Attachment = TunnelDefinition | AttachedBody

Held = TypeVar("Held", bound=Attachment)


@attrs.frozen
class AttachmentKind:
    """One kind of things beside the net.

    Attributes
    ----------
    word : str
        What one is called.
    column : str
        What several are called: in the settings, in records and in files.
    made : type
        The class of one.
    """

    word: str
    column: str
    made: type[TunnelDefinition] | type[AttachedBody]

    def of(self, state: HullState) -> ValueColumn[tuple[Attachment, ...]]:
        """Give the column of the settings that holds them."""
        return cast("ValueColumn[tuple[Attachment, ...]]", getattr(state.settings, self.column))


ATTACHMENTS = (
    AttachmentKind("tunnel", "tunnels", TunnelDefinition),
    AttachmentKind("body", "bodies", AttachedBody),
)
"""All kinds."""


def attachments_in_order(held: Iterable[Held]) -> tuple[Held, ...]:
    """Give things of one kind by name: the order in which they were made plays no part."""
    return tuple(sorted(held, key=lambda each: each.name))


def attachment_names(state: HullState) -> Iterator[str]:
    """Give the names of all things beside the net."""
    for kind in ATTACHMENTS:
        yield from (each.name for each in kind.of(state)[0])


def attachment_named(state: HullState, name: str) -> tuple[AttachmentKind, Attachment] | None:
    """Give what a name stands for, however a person writes it, with its kind."""
    every = [(kind, each) for kind in ATTACHMENTS for each in kind.of(state)[0]]
    if not every:
        return None
    plain = plain_name(name)
    exact = [found for found in every if found[1].name == name]
    alike = exact or [found for found in every if plain_name(found[1].name) == plain]
    return alike[0] if alike else None


def attachment_records(state: HullState) -> dict[str, list[dict[str, object]]]:
    """Give all things beside the net as plain values, by column and then by name."""
    return {kind.column: [attrs.asdict(each) for each in kind.of(state)[0]] for kind in ATTACHMENTS}
