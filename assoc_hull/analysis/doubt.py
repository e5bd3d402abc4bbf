from __future__ import annotations


def doubts_of(net, layout, sections, spread, planes):
    return []
