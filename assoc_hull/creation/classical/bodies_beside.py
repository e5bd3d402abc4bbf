"""Hatches, deck houses, boxes and appendages of definitions, as bodies beside the net.

The rules of definitions say where a body stands; here they become closed sections (y, z) along x.
"""

from __future__ import annotations

from collections.abc import Iterable

import attrs
import numpy as np

from assoc_hull.arguments import plain_name
from assoc_hull.edit.modifications.names import taken_names
from assoc_hull.edit.transaction import Transaction
from assoc_hull.geometry.classical.appendages import AppendageBox, LoftedAppendage
from assoc_hull.geometry.classical.deck import DeckHouse
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.attached_body import AttachedBody
from assoc_hull.model.attachments import attachments_in_order

__all__ = [
    "ACROSS",
    "DECK_PARTS",
    "block_body",
    "box_body",
    "camber_body",
    "house_body",
    "lofted_body",
    "put_bodies",
    "sections_body",
]

ACROSS = 17
"""Points at which the foot and the top of a block on a deck are taken, from side to side."""

DECK_PARTS = np.linspace(-1.0, 1.0, ACROSS)
"""Parts of its half-breadth at which the camber of a deck is taken."""

_NO_ADDRESS = str.maketrans(dict.fromkeys("#/[]:@", "-"))
"""What addresses are made with, and names cannot have."""

_ALONG = 9
"""Sections, ends among them, of a body that bends along the ship."""


def block_body(
    name: str, group: str, x: FloatArray, foot: FloatArray, top: FloatArray, y: FloatArray
) -> AttachedBody:
    """Make a block of heights at its foot and its top, (k, m) each, m, at x (k,) and y (m,), m."""
    sections = np.empty((len(x), 2 * len(y), 3))
    sections[:, :, 0] = x[:, None]
    sections[:, :, 1] = np.concatenate([y, y[::-1]])
    sections[:, :, 2] = np.concatenate([foot, top[:, ::-1]], axis=1)
    last = len(y) - 1
    return AttachedBody(name, group, sections, (0, last, last + 1, 2 * last + 1), False, 1)


def house_body(house: DeckHouse, group: str) -> AttachedBody:
    """Make the outlines of a deck house or a hatch, whose top is parallel to its deck."""
    sheer = house.deck.sheer.x
    knots = sheer[(sheer > house.x[0]) & (sheer < house.x[1])]
    x = np.array([house.x[0], *knots.tolist(), house.x[1]])
    y = np.linspace(-0.5 * house.breadth, 0.5 * house.breadth, ACROSS)
    drop = house.deck.camber.drop(y, house.deck_half_breadth)
    foot = house.deck.centre(x)[:, None] - drop
    return block_body(house.name, group, x, foot, foot + house.height, y)


def camber_body(x: FloatArray, half: FloatArray, z: FloatArray) -> AttachedBody | None:
    """Make what lies between a deck straight across and its camber; None where it has none.

    Half-breadths at x, (k,), m, and heights of the deck from starboard to port at the parts
    `DECK_PARTS` of them, (k, m), m. The middle edge is the centre line of the deck.
    """
    order = np.flatnonzero(np.append(True, np.diff(x) > 0.0))
    sections = np.dstack([np.broadcast_to(x[:, None], z.shape), half[:, None] * DECK_PARTS, z])
    found = AttachedBody("deck camber", "decks", sections[order], (len(DECK_PARTS) // 2,), False, 1)
    return found if found.flux > 0.0 else None


def box_body(box: AppendageBox, group: str) -> AttachedBody:
    """Make the outlines of a box."""
    (y0, y1), (z0, z1) = box.y, box.z
    ring = np.array([[y0, z0], [y1, z0], [y1, z1], [y0, z1]])
    sections = [np.column_stack([np.full(4, x), ring]) for x in box.x]
    return AttachedBody(box.name, group, sections, range(4), box.symmetric, box.sign)


def sections_body(
    name: str, group: str, x: FloatArray, yz: FloatArray, corners: Iterable[int]
) -> AttachedBody:
    """Make a body of closed sections yz (k, m, 2), m, at x (k,), m."""
    sections = np.dstack([np.broadcast_to(x[:, None], yz.shape[:2]), yz])
    return AttachedBody(name, group, sections, tuple(corners), False, 1)


def lofted_body(name: str, body: LoftedAppendage, both: bool, group: str) -> AttachedBody:
    """Make the outlines of a body through sections; chords where it bends along the ship."""
    x = np.linspace(body.x[0], body.x[-1], _ALONG) if len(body.sections) == 3 else body.x
    yz = body.at(x)
    sections = np.dstack([np.broadcast_to(x[:, None], yz.shape[:2]), yz])
    return AttachedBody(name, group, sections, range(yz.shape[1]), both, body.sign)


def put_bodies(edit: Transaction, bodies: Iterable[AttachedBody]) -> None:
    """Keep bodies beside a net; those of a name that is taken are numbered, however it is written.

    What could be read as an address is no name that they could be looked up by.
    """
    taken = {plain_name(each) for each in taken_names(edit.state)}
    found = []
    for each in bodies:
        plain = each.name.translate(_NO_ADDRESS).replace(" x ", " by ").strip() or each.group
        name, count = plain, 1
        while plain_name(name) in taken:
            count += 1
            name = f"{plain} {count}"
        taken.add(plain_name(name))
        found.append(attrs.evolve(each, name=name))
    edit.journal.set(edit.state.settings.bodies, [0], [attachments_in_order(found)])
