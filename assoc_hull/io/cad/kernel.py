"""OpenCASCADE, which reads and writes STEP: the right version, silent, its settings given back.

Its messages go to standard output, where they would spoil what a command prints, and its settings
are those of the whole process. So nobody calls it but within `quiet`. It works in millimetres.

Examples
--------
>>> from assoc_hull.io.cad.kernel import quiet_kernel, require_opencascade
>>> require_opencascade()
>>> with quiet_kernel({"write.step.unit": "M"}):
...     from OCP.Interface import Interface_Static
...
...     print(Interface_Static.CVal_s("write.step.unit"))
M
"""

from __future__ import annotations

import threading
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from importlib.util import find_spec
from types import MappingProxyType
from typing import Any

from assoc_hull.errors import MissingExtraError

__all__ = [
    "MILLIMETRES",
    "ascii_words",
    "quiet_kernel",
    "require_installed",
    "require_opencascade",
    "warm_up",
]

MILLIMETRES = 1000.0
"""Lengths of OpenCASCADE in one of the kernel."""

_LIBRARY, _VERSION = "cadquery-ocp-novtk", "8.0"
"""Arrays and settings have other names in 7.9, and may have again in 8.1."""

_ALONE = threading.RLock()
_ALWAYS: Mapping[str, str] = MappingProxyType({"xstep.cascade.unit": "MM"})


def require_opencascade() -> None:
    """See that OpenCASCADE is there, in the version that this package is written for.

    Raises
    ------
    MissingExtraError
        It is not installed, or of another version.
    """
    try:
        import OCP
    except ImportError as error:
        raise MissingExtraError(f"{_LIBRARY} {_VERSION}", "cad") from error
    found = str(getattr(OCP, "__version__", "without a version"))
    if not f"{found}.".startswith(f"{_VERSION}."):
        raise MissingExtraError(f"{_LIBRARY} {_VERSION} (this is {found})", "cad")


def require_installed() -> None:
    """See that OpenCASCADE is there, without loading it; its version is looked at by who does.

    Raises
    ------
    MissingExtraError
        It is not installed.
    """
    if find_spec("OCP") is None:
        raise MissingExtraError(f"{_LIBRARY} {_VERSION}", "cad")


@contextmanager
def quiet_kernel(settings: Mapping[str, str] = _ALWAYS) -> Iterator[None]:
    """Let OpenCASCADE print nothing, with settings of its own; both are put back.

    Parameters
    ----------
    settings : mapping of str to str
        Names and values of its static parameters.

    Raises
    ------
    MissingExtraError
        It is not installed, or of another version.
    """
    require_opencascade()
    from OCP.IGESControl import IGESControl_Controller
    from OCP.Interface import Interface_Static
    from OCP.Message import Message
    from OCP.STEPControl import STEPControl_Controller

    with _ALONE:
        messenger = Message.DefaultMessenger_s()
        printers = list(messenger.Printers())
        for each in printers:
            messenger.RemovePrinter(each)
        # Parameters do not exist before those who read them do.
        STEPControl_Controller.Init_s()
        IGESControl_Controller.Init_s()
        wanted = {**_ALWAYS, **settings}
        before = {name: Interface_Static.CVal_s(name) for name in wanted}
        try:
            for name, value in wanted.items():
                Interface_Static.SetCVal_s(name, value)
            yield
        finally:
            for name, value in before.items():
                Interface_Static.SetCVal_s(name, value)
            for each in printers:
                messenger.AddPrinter(each)


def warm_up() -> None:
    """Load OpenCASCADE and make its settings, which takes a second."""
    with quiet_kernel():
        pass


def ascii_words(text: str) -> Any:
    """Give text as OpenCASCADE takes it; what is no ASCII becomes ``?``."""
    from OCP.TCollection import TCollection_HAsciiString

    return TCollection_HAsciiString(text.encode("ascii", "replace").decode())
