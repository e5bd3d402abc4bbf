"""Acts on a hull, drawn once by a seeded generator and written out as plain data.

An act is a mapping with the key ``act``; `tests.unchanged` carries it out. Numbers and addresses
are those of the hull before its round, so that an act may well be refused: that counts, too.
"""

from __future__ import annotations

import random
from typing import Any

import assoc_hull as ah

__all__ = ["Act", "draw"]

Act = dict[str, Any]

_TRIES = 200


def draw(hull: ah.Hull, name: str) -> list[list[Act]]:
    """Draw rounds of acts, each to be begun on the hull as it is made."""
    made = _Draw(hull, random.Random(f"unchanged {name}"))
    return [
        made.points(),
        made.shapes(),
        made.own_points(),
        made.lines(),
        made.names(),
        made.scripts(),
        made.variants(),
        made.wholes(),
    ]


class _Draw:
    """A hull, what acts may name of it, and where numbers come from."""

    def __init__(self, hull: ah.Hull, chance: random.Random) -> None:
        self.hull, self.chance = hull, chance
        ship = hull.particulars
        self.length, self.half, self.draught = ship.length, 0.5 * ship.breadth, ship.draught
        points = {address: each for address, each in hull.points.items() if each.y > 0.0}
        self.crossings = [
            address for address, each in points.items()
            if each.role == "defining" and each.sort == "crossing"
        ]  # fmt: skip
        self.driven = [address for address, each in points.items() if each.role != "defining"]
        self.adopted = [address for address, each in points.items() if each.sort == "adopted"]
        self.movable = [
            address for address, each in points.items()
            if each.free and (each.sort == "adopted" or each.crossing_role == "shared")
        ]  # fmt: skip
        self.families: dict[str, list[str]] = {}
        for title, line in hull.lines.items():
            self.families.setdefault(line.group.name, []).append(title)

    def number(self, low: float, high: float) -> float:
        """A number as a designer would type it."""
        return round(self.chance.uniform(low, high), 4)

    def line(self, group: str) -> str:
        """A line that is neither the first nor the last of its group."""
        names = self.families[group]
        return self.chance.choice(names[1:-1] or names)

    def position(self, title: str) -> float:
        """Where the plane of a line stands."""
        found = self.hull.lines[title].position
        assert found is not None, f"{title} lies in no plane of its family"
        return found

    def move(self, among: list[str] | None = None) -> Act:
        """Move a point a little in all that it is free in."""
        address = self.chance.choice(among or self.movable)
        point, most = self.hull.points[address], 1e-4 * self.length
        free = point.free or ("y",)
        now = {axis: getattr(point, axis) for axis in free}
        places = {axis: now[axis] + self.number(-most, most) for axis in free}
        return {"op": "move", "point": address, **places}

    def pull(self, size: float, radius: float | None = None) -> Act:
        """Pull at a point, by a part of the half breadth."""
        op = {"op": "pull", "point": self.chance.choice(self.crossings), "d": size * self.half}
        reach = {} if radius is None else {"radius": [radius * self.length, radius * self.length]}
        return op | reach

    def place(self) -> tuple[str, list[float]]:
        """A section and a place on it."""
        for _ in range(_TRIES):
            title = self.line("sections")
            x = self.position(title)
            z = self.number(0.2 * self.draught, 0.9 * self.draught)
            try:
                y = self.hull.half_breadth(x, z)
            except ah.AssocHullError:
                continue
            if y > 0.05 * self.half:
                return title, [x, y, z]
        raise AssertionError("no section has a place between keel and waterline")

    def insert(self, title: str, place: list[float], out: float = 0.0) -> Act:
        """Insert a point on a section, or a little off it."""
        x, y, z = place
        return {"op": "insert", "curve": title, "place": [x, y + out, z]}

    def reshape(self) -> Act:
        """Give a section another shape through one place."""
        title, (x, y, z) = self.place()
        points = [[x, y * self.number(0.998, 1.002), z]]
        span = [z - 0.3 * self.draught, z + 0.3 * self.draught]
        return {"op": "reshape", "curve": title, "points": points, "span": span}

    def add_line(self, group: str) -> Act:
        """Cut a new line."""
        most = {"sections": self.length, "waterlines": self.draught, "buttocks": self.half}
        position = round(self.number(0.2, 0.8) * most[group], 2)
        return {"op": "add_line", "group": group, "position": position}

    def shift_line(self, group: str) -> Act:
        """Shift a line by very little of the ship."""
        title = self.line(group)
        position = self.position(title) * self.number(1.001, 1.02)
        return {"op": "shift_line", "line": title, "position": position}

    def points(self) -> list[Act]:
        """Points are moved and pulled, and an edit is taken back."""
        wrong = {"op": "move", "point": self.chance.choice(self.movable), "x": 1.0, "z": 1.0}
        return [
            _edit("move", self.move()),
            _edit("wrong freedom", wrong),
            _edit("pull", self.pull(0.001)),
            {"act": "undo", "n": 1},
            {"act": "redo", "n": 1},
        ]

    def shapes(self) -> list[Act]:
        """The hull takes another shape; much too large a pull; a point that others drive."""
        return [
            _edit("pull within a radius", self.pull(0.002, 0.1)),
            _edit("reshape", self.reshape()),
            _edit("driven", self.move(self.driven)),
            _edit("far too much", self.pull(-0.6)),
            _edit("several", self.move(), self.move(), self.pull(0.0005)),
        ]

    def own_points(self) -> list[Act]:
        """Points that belong to one line come and go and change what they are."""
        title, place = self.place()
        adopted = self.chance.choice(self.adopted)
        kind = {"op": "set_kind", "point": self.chance.choice(self.crossings), "kind": "knuckle"}
        return [
            _edit("insert", self.insert(title, place, 0.0005 * self.half)),
            _edit("unpin", {"op": "unpin", "point": f"{title} @ placed 1"}),
            _edit("pin", {"op": "pin", "point": adopted}),
            _edit("delete", {"op": "delete", "point": self.chance.choice(self.adopted)}),
            _edit("kind", kind),
        ]

    def lines(self) -> list[Act]:
        """Lines come, go and are shifted."""
        gone = {"op": "remove_line", "line": self.line("waterlines")}
        return [
            _edit("new waterline", self.add_line("waterlines")),
            _edit("new buttock", self.add_line("buttocks")),
            _edit("line shifted", self.shift_line("waterlines")),
            _edit("line removed", gone),
            _edit("new section", self.add_line("sections")),
        ]

    def names(self) -> list[Act]:
        """Names, roles, and two edits taken back."""
        title = self.line("sections")
        role = {"op": "set_role", "crossing": self.chance.choice(self.driven or self.crossings)}
        some = [self.line("sections"), self.line("waterlines")]
        return [
            _edit("renamed", {"op": "rename", "obj": title, "name": f"{title} new"}),
            _edit("role", role | {"role": "shared"}),
            _edit("roles", {"op": "renew_roles", "lines": some}),
            _edit("old name", {"op": "remove_line", "line": title}),
            {"act": "undo", "n": 2},
        ]

    def scripts(self) -> list[Act]:
        """Scripts of several ops, one that is looked at only, a checkpoint to return to."""
        several = [self.move(), self.move(), self.pull(0.001)]
        mixed = [self.move(), self.add_line("buttocks"), {"op": "rename", "obj": None, "name": "X"}]
        return [
            {"act": "checkpoint", "name": "before"},
            {"act": "apply", "name": "several", "edits": several},
            {"act": "preview", "edits": [self.move(), self.add_line("waterlines")]},
            {"act": "apply", "name": "mixed", "edits": mixed},
            {"act": "go", "name": "before"},
        ]

    def variants(self) -> list[Act]:
        """Variants by one and by two parameters, in place and not; what was done made again."""
        ship = self.hull.particulars
        broader, deeper = self.number(1.002, 1.01), self.number(1.002, 1.01)
        two = {"breadth": ship.breadth / broader, "draught": ship.draught * deeper}
        shift = self.chance.choice([{"cb": 0.002}, {"lcb_percent": 0.1}])
        return [
            {"act": "vary", "set": {"breadth": ship.breadth * broader}},
            {"act": "vary", "set": two, "in_place": True},
            _edit("move", self.move()),
            {"act": "shift", "by": shift},
            {"act": "replay"},
        ]

    def wholes(self) -> list[Act]:
        """What concerns the whole hull, or what it was made of; an output that is reached."""
        volume = self.hull.hydrostatics().volume * self.number(1.001, 1.005)
        scale = [1.0, self.number(0.995, 1.005), 1.0]
        carried = {"op": "transform", "drivers": ["sections"], "scale": scale, "planes": "follow"}
        away = {"op": "dissociate", "a": "waterlines", "b": "buttocks"}
        return [
            _edit("scaled", carried),
            _edit("form", self.form()),
            {"act": "vary", "reach": {"volume": volume}, "free": ["breadth"]},
            _edit("dissociated", away),
            {"act": "replay"},
        ]

    def form(self) -> Act:
        """Another value of a definition; of a hull without any, another end of a line."""
        values = [
            (each.name, key, value)
            for each in self.hull.definitions.values()
            for key, value in each.values.items()
            if value and key.endswith("_y")
        ]
        if values:
            title, key, value = self.chance.choice(values)
            return {"op": "set_form", "definition": title, key: value * self.number(0.998, 1.002)}
        tangent = [1.0, self.number(0.0, 0.05), 0.0]
        title = self.line("waterlines")
        return {"op": "set_end", "curve": title, "end": "finish", "tangent": tangent}


def _edit(name: str, *edits: Act) -> Act:
    """Modifications of one ``with`` block."""
    return {"act": "edit", "name": name, "edits": list(edits)}
