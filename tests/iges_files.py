"""IGES files put together by hand, entity by entity: what no writer of this package makes."""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray

NET = np.array([[[0.0, 0, 0], [0, 1, 0.5]], [[2, 0, 0.25], [2, 1, 0]], [[4, 0, 0], [4, 1, 1]]])
"""A surface of degree 2 by 1."""

SQUARE = ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0))
"""The box of the parameters, in the sense of its border."""


@attrs.frozen
class Entity:
    """An entity of a file; entity k has the number 2 k + 1."""

    kind: int
    values: Sequence[object]
    form: int = 0
    status: str = "00000000"
    moved: int = 0
    label: str = ""


def surface(
    net: FloatArray = NET,
    *,
    weights: FloatArray | None = None,
    spans: Sequence[float] = (0.0, 1.0, 0.0, 1.0),
    after: Sequence[object] = (),
    status: str = "00000000",
    moved: int = 0,
    label: str = "",
) -> Entity:
    """A Bezier surface, 128."""
    m, n = net.shape[0] - 1, net.shape[1] - 1
    weights = np.ones((m + 1, n + 1)) if weights is None else weights
    knots = [0.0] * (m + 1) + [1.0] * (m + 1) + [0.0] * (n + 1) + [1.0] * (n + 1)
    values = [m, n, m, n, 0, 0, 1, 0, 0, *knots, *weights.T.ravel().tolist()]
    values += [*net.swapaxes(0, 1).ravel().tolist(), *spans, *after]
    return Entity(128, values, status=status, moved=moved, label=label)


def line(start: Sequence[float], end: Sequence[float]) -> Entity:
    """A line between two places in the parameters, 110."""
    return Entity(110, [*start, 0.0, *end, 0.0], status="00010500")


def matrix(rows: FloatArray, shift: Sequence[float], moved: int = 0) -> Entity:
    """A transformation, 124."""
    return Entity(124, np.column_stack([rows, shift]).ravel().tolist(), moved=moved)


def iges(
    entities: Sequence[Entity],
    unit: str = "6,1HM",
    scale: str = "1.",
    marks: tuple[str, str] = (",", ";"),
    exponent: str = "E",
    head: str | None = None,
) -> str:
    """A file of these entities."""
    delimiter, end = marks
    if head is None:
        opening = ",," if marks == (",", ";") else f"1H{delimiter}{delimiter}1H{end}{delimiter}"
        head = f"{opening}1Ha,1Hb,1Hc,1Hd,32,38,6,38,15,1He,{scale},{unit},1,0.1,1Hf;"
        body = head[len(opening) :].replace(",", delimiter).replace(";", end)
        head = opening + body
    directory: list[str] = []
    parameters: list[str] = []
    for number, entity in enumerate(entities):
        first = len(parameters) + 1
        texts = [str(entity.kind), *(_text(value, exponent) for value in entity.values)]
        lines = _lines(texts, delimiter, end)
        parameters += [f"{each:64}{2 * number + 1:8d}" for each in lines]
        directory.append(
            f"{entity.kind:8d}{first:8d}{0:8d}{0:8d}{0:8d}{0:8d}{entity.moved:8d}{0:8d}"
            f"{entity.status}"
        )
        directory.append(
            f"{entity.kind:8d}{0:8d}{0:8d}{len(lines):8d}{entity.form:8d}{'':16}"
            f"{entity.label:>8}{'':8}"
        )
    heads = [head[at : at + 72] for at in range(0, len(head), 72)]
    sections = {"S": ["by hand"], "G": heads, "D": directory, "P": parameters}
    found = [
        f"{each:72}{letter}{k + 1:7d}"
        for letter, rows in sections.items()
        for k, each in enumerate(rows)
    ]
    counts = "".join(f"{letter}{len(rows):7d}" for letter, rows in sections.items())
    return "\n".join([*found, f"{counts:72}T{1:7d}"]) + "\n"


def _text(value: object, exponent: str) -> str:
    return repr(value).replace("e", exponent) if isinstance(value, float) else str(value)


def _lines(texts: list[str], delimiter: str, end: str) -> list[str]:
    lines = [""]
    for place, text in enumerate(texts):
        word = text + (end if place == len(texts) - 1 else delimiter)
        if len(lines[-1]) + len(word) > 64:
            lines.append("")
        lines[-1] += word
    return lines


def face(corners: Sequence[Sequence[float]] = SQUARE, kind: int = 144) -> list[Entity]:
    """A face with a border of straight lines in the parameters: its surface is entity 1.

    As a trimmed surface (144), a bounded one (143) or a face (510).
    """
    count = len(corners)
    lines = [line(corners[i], corners[(i + 1) % count]) for i in range(count)]
    of_surface = surface(status="00010000")
    first = 5 if kind == 144 else 3
    curves = [2 * (first + i) + 1 for i in range(count)]
    if kind == 144:
        chain = Entity(102, [count, *curves], status="00010000")
        return [
            of_surface, Entity(144, [1, 1, 0, 5]), Entity(142, [1, 1, 7, 0, 1], status="00010000"),
            chain, Entity(124, [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]), *lines,
        ]  # fmt: skip
    if kind == 143:
        edges = [value for each in curves for value in (0, 1, 1, each)]
        border = Entity(141, [1, 1, 1, count, *edges], status="00010000")
        return [of_surface, Entity(143, [1, 1, 1, 5]), border, *lines]
    edges = [value for each in curves for value in (0, 0, 0, 1, 1, 0, each)]
    loop = Entity(508, [count, *edges], status="00010000")
    return [of_surface, Entity(510, [1, 1, 1, 5]), loop, *lines]
