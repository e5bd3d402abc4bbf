"""Changes of bytes and of lines of text."""

from __future__ import annotations

import re
from collections.abc import Callable
from random import Random

from tests.fuzz.odd import odd_number, odd_word

__all__ = ["change_bytes", "change_text"]

NUMBER = re.compile(r"[-+]?\d+\.?\d*(?:[eE][-+]?\d+)?")
MARKS = re.compile(r"([,;\t ]+)")
Lines = list[str]


def change_text(rng: Random, text: str) -> bytes:
    """A text with one to four changes of lines, cells or numbers, seldom of bytes as well."""
    for _ in range(rng.choice((1, 1, 1, 2, 2, 4))):
        text = rng.choice(_CHANGES)(rng, text)
    data = text.encode(rng.choice(_CODINGS) if rng.random() < 0.04 else "utf-8", "surrogatepass")
    return change_bytes(rng, data) if rng.random() < 0.15 else data


_CODINGS = ("utf-8-sig", "utf-16", "utf-32", "utf-16-le")


def change_bytes(rng: Random, data: bytes) -> bytes:
    """Bytes flipped, cut off, put in, taken out or said twice."""
    found = bytearray(data)
    for _ in range(rng.choice((1, 1, 2, 8))):
        at, end = sorted(rng.randrange(len(found) + 1) for _ in range(2))
        match rng.randrange(5):
            case 0 if at < len(found):
                found[at] ^= 1 << rng.randrange(8)
            case 1:
                del found[at:]
            case 2:
                found[at:at] = rng.randbytes(rng.choice((1, 2, 16)))
            case 3:
                del found[at : min(end, at + 40)]
            case _:
                found[at:at] = found[at : min(end, at + 200)]
    return bytes(found)


def _of_lines(change: Callable[[Random, Lines], None]) -> Callable[[Random, str], str]:
    """A change of the list of lines as a change of the text."""

    def changed(rng: Random, text: str) -> str:
        lines = text.split("\n")
        change(rng, lines)
        return "\n".join(lines)

    return changed


def _without(rng: Random, lines: Lines) -> None:
    at = rng.randrange(len(lines))
    del lines[at : at + rng.choice((1, 1, 1, 2, 5))]
    if not lines:
        lines.append("")


def _twice(rng: Random, lines: Lines) -> None:
    at, to = rng.randrange(len(lines)), rng.randrange(len(lines))
    lines[to:to] = lines[at : at + rng.choice((1, 1, 3, 10))] * rng.choice((1, 1, 30))


def _swapped(rng: Random, lines: Lines) -> None:
    at, to = rng.randrange(len(lines)), rng.randrange(len(lines))
    lines[at], lines[to] = lines[to], lines[at]


def _odd_line(rng: Random, lines: Lines) -> None:
    lines.insert(rng.randrange(len(lines)), rng.choice(("", "#", ",,,", "\t", odd_word(rng))))


def _cells(rng: Random, lines: Lines) -> None:
    """A cell of a line is replaced, taken out, put in, or exchanged with another."""
    at = rng.randrange(len(lines))
    cells = MARKS.split(lines[at])
    one, other = (2 * rng.randrange((len(cells) + 1) // 2) for _ in range(2))
    match rng.randrange(6):
        case 0 | 1:
            cells[one] = odd_word(rng)
        case 2:
            del cells[one : one + 2]
        case 3:
            cells[one:one] = [odd_word(rng), ","]
        case 4:
            cells[one], cells[other] = cells[other], cells[one]
        case _:
            cells[one] = cells[other]
    lines[at] = "".join(cells)


def _column(rng: Random, lines: Lines) -> None:
    """A column is taken out, or made odd, in all lines."""
    column, odd, away = rng.randrange(6), odd_word(rng), rng.random() < 0.5
    for number, line in enumerate(lines):
        cells = line.split(",")
        if column < len(cells):
            if away:
                del cells[column]
            else:
                cells[column] = odd
            lines[number] = ",".join(cells)


def _number(rng: Random, text: str) -> str:
    """One number becomes another: odd, of the other sign, of another size, or a little off."""
    found = list(NUMBER.finditer(text))
    if not found:
        return text
    match = rng.choice(found)
    return text[: match.start()] + _other(rng, match.group()) + text[match.end() :]


def _numbers(rng: Random, text: str) -> str:
    """All numbers change in one way: a factor, a sign, or one value for all."""
    factor, same = rng.choice((0.0, -1.0, 1e3, 1e-3, 1e6, 1e-9, 1e200)), rng.random() < 0.2

    def other(match: re.Match[str]) -> str:
        return "1" if same else f"{float(match.group()) * factor:.6g}"

    return NUMBER.sub(other, text)


def _other(rng: Random, word: str) -> str:
    match rng.randrange(6):
        case 0 | 1:
            return str(odd_number(rng)) if rng.random() < 0.5 else odd_word(rng)
        case 2:
            return "-" + word
        case 3:
            return f"{float(word) * 10.0 ** rng.randint(-6, 6):.9g}"
        case 4:
            return word.replace(".", ",")
        case _:
            return f"{float(word) + rng.gauss(0.0, 1.0):.6g}"


def _mark(rng: Random, text: str) -> str:
    """Another separator, another end of line, or another decimal mark."""
    old, new = rng.choice(
        ((",", ";"), (",", "\t"), ("\n", "\r\n"), ("\n", "\r"), (".", ","), (",", " "), ("\n", ""))
    )
    return text.replace(old, new)


def _quoted(rng: Random, text: str) -> str:
    at = rng.randrange(len(text) + 1)
    return text[:at] + rng.choice(('"', "'", "#", "\n", "\0", ",", "[", "{", "}")) + text[at:]


_CHANGES: tuple[Callable[[Random, str], str], ...] = (
    _of_lines(_without), _of_lines(_twice), _of_lines(_swapped), _of_lines(_odd_line),
    _of_lines(_cells), _of_lines(_cells), _of_lines(_cells), _of_lines(_column),
    _number, _number, _number, _numbers, _mark, _quoted,
)  # fmt: skip
