"""The modules of the page as one text, for a notebook: it loads a widget's script as one module.

Each module becomes a function that is called once and gives what others import from it, after
those that it imports from: so names at the top of two modules do not meet. It holds for modules
that import by lines of the form `import {a, b} from "./x.js";`, one after the other in no circle,
and export declarations only; a test says so of all.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from graphlib import TopologicalSorter

__all__ = ["imports_of", "joined_modules", "scoped_styles"]

_IMPORT = re.compile(r'^import \{([^}]*)\} from "\./(\w+)\.js";$', re.M)
_EXPORT = re.compile(r"^export (?=(?:async )?(?:const|function|class) )", re.M)


def imports_of(text: str) -> dict[str, list[str]]:
    """Give the names that a module imports, by the module that they are of."""
    return {
        name: [each.strip() for each in names.split(",")] for names, name in _IMPORT.findall(text)
    }


def joined_modules(modules: Mapping[str, str], entry: str, names: tuple[str, ...]) -> str:
    """Join a module, by its name without `.js`, and all that it needs; export names of it."""
    needs = dict[str, set[str]]()
    wanted = {entry: set(names)}
    open_ = [entry]
    while open_:
        name = open_.pop()
        if name in needs:
            continue
        asked = imports_of(modules[name])
        needs[name] = set(asked)
        for other, some in asked.items():
            wanted.setdefault(other, set()).update(some)
            open_.append(other)
    graph = {name: sorted(needs[name]) for name in sorted(needs)}
    parts = [
        _function(name, modules[name], sorted(wanted[name]))
        for name in TopologicalSorter(graph).static_order()
    ]
    exported = ", ".join(f"{name}: _{entry}.{name}" for name in names)
    return "\n".join([*parts, f"export default {{{exported}}};", ""])


def _function(name: str, text: str, wanted: list[str]) -> str:
    """Write a module as a function that was called: `const _net = (() => {...})();`."""
    body = _IMPORT.sub(lambda found: f"const {{{found[1]}}} = _{found[2]};", text)
    body = _EXPORT.sub("", body)
    return f"const _{name} = (() => {{\n{body}\nreturn {{{', '.join(wanted)}}};\n}})();"


def scoped_styles(text: str, scope: str) -> str:
    """Give a style sheet that holds within elements of a class alone, and for their own width."""
    inner = text.replace("body { margin: 0; }", "").replace(
        "@media (max-width", "@container (max-width"
    )
    return f".{scope} {{ container-type: inline-size;\n{inner}\n}}\n"
