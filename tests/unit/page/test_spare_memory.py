"""Memory that is free goes back to the system after work, and not at every moment."""

import pytest

from assoc_hull.page.spare_memory import SpareMemory


def test_memory_is_given_back_once_after_work(monkeypatch: pytest.MonkeyPatch) -> None:
    """Not without work, not again within seconds, also where the allocator needs no word."""
    calls, now = list[int](), [100.0]
    monkeypatch.setattr("assoc_hull.page.spare_memory.time.monotonic", lambda: now[0])

    def trim(pad: int) -> int:
        calls.append(pad)
        return 1

    memory = SpareMemory(trim=trim)
    now[0] += 60.0
    assert not memory.give_back()
    memory.used = True
    assert memory.give_back()
    memory.used = True
    assert not memory.give_back()
    now[0] += 60.0
    assert memory.give_back()
    assert calls == [0, 0]
    other = SpareMemory(used=True, trim=None)
    now[0] += 60.0
    assert other.give_back()
