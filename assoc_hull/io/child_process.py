"""Foreign readers in a process of their own, with limits of memory and of processor time.

Compiled libraries end the process, or take all of its memory, on some files. A `ChildSession` makes
an object of this package in a child and calls its methods there; only plain values and arrays come
back, and errors of this package as themselves. Where the system can fork, a server imports the
library once and forks a worker for each session; `serve` is its loop.
"""

from __future__ import annotations

import atexit
import contextlib
import importlib
import json
import os
import pickle
import signal
import struct
import subprocess
import sys
import threading
import weakref
from collections.abc import Callable
from io import BytesIO
from pathlib import Path
from typing import IO, Any

import attrs

from assoc_hull.errors import AssocHullError, BadInputError
from assoc_hull.graph.derived import Gate

__all__ = ["ChildSession", "Limits", "limits_for", "run_in_child", "serve"]

_SECONDS, _MEMORY = "ASSOC_HULL_READ_SECONDS", "ASSOC_HULL_READ_MEMORY"
"""Variables of the environment with which a caller allows more: s, MB."""

_MB = 1e6


@attrs.frozen
class Limits:
    """What a child may take.

    Attributes
    ----------
    seconds : float
        Of its processor.
    memory : float, MB
        Beyond what the library takes by itself.
    """

    seconds: float
    memory: float


def limits_for(path: Path) -> Limits:
    """Give the limits for a file, by its size, unless the environment sets them.

    Raises
    ------
    BadInputError
        A variable of the environment that is no number above 0.
    """
    size = path.stat().st_size / _MB if path.exists() else 0.0
    return Limits(_from_environment(_SECONDS, 8.0 + 60.0 * size),
                  _from_environment(_MEMORY, 600.0 + 60.0 * size))  # fmt: skip


def _from_environment(name: str, default: float) -> float:
    text = os.environ.get(name)
    if text is None:
        return default
    with contextlib.suppress(ValueError):
        if 0.0 < float(text) < 1e9:
            return float(text)
    raise BadInputError(f"{name} is {text[:40]!r}", "in the environment", "give a number above 0")


# --------------------------------------------------------------------------------------
# Frames: a length, and a value in pickled form.

_HEAD = struct.Struct("<Q")


def _send(file: IO[bytes], value: object) -> None:
    data = pickle.dumps(value, protocol=5)
    file.write(_HEAD.pack(len(data)) + data)
    file.flush()


def _receive(file: IO[bytes]) -> bytes | None:
    """Give the next frame; None where there is none any more."""
    head = _exactly(file, _HEAD.size)
    return None if head is None else _exactly(file, _HEAD.unpack(head)[0])


def _exactly(file: IO[bytes], size: int) -> bytes | None:
    """Read so many bytes and no more: what follows is for another process."""
    parts: list[bytes] = []
    while size:
        part = file.read(min(size, 1 << 20))
        if not part:
            return None
        parts.append(part)
        size -= len(part)
    return b"".join(parts)


class _Plain(pickle.Unpickler):
    """Takes arrays, plain values and errors of this package: a child may have been taken over."""

    _NUMPY = ("_reconstruct", "_frombuffer", "ndarray", "dtype", "scalar")

    def find_class(self, module: str, name: str) -> Any:
        """Give what a pickle names, if it is harmless."""
        if module == AssocHullError.__module__ and name.isidentifier():
            return super().find_class(module, name)
        if module.split(".")[0] == "numpy" and name in self._NUMPY:
            return super().find_class(module, name)
        raise pickle.UnpicklingError(f"{module}.{name}")


# --------------------------------------------------------------------------------------
# The child.


def serve() -> None:
    """Answer requests on standard input until it ends; libraries print to nowhere."""
    requests, answers = os.fdopen(os.dup(0), "rb", 0), os.fdopen(os.dup(1), "wb")
    nowhere = os.open(os.devnull, os.O_RDWR)
    for standard in (0, 1):
        os.dup2(nowhere, standard)
    while (data := _receive(requests)) is not None:
        request = pickle.loads(data)
        if request is None:
            continue  # the end of a session whose worker has ended already
        if not hasattr(os, "fork"):
            _work(request, requests, answers)
            return
        for name in request["preload"]:
            # What is missing is told by the worker, as the error that the package has for it.
            with contextlib.suppress(Exception):
                module, _, function = name.partition(":")
                found = importlib.import_module(module)
                if function:
                    getattr(found, function)()
        worker = os.fork()
        if worker == 0:
            _work(request, requests, answers)
            os._exit(0)
        status = os.waitpid(worker, 0)[1]
        if status:
            # A frame may be torn: the server ends too, and tells by its code how the worker did.
            os._exit(_SIGNALLED + os.WTERMSIG(status) if os.WIFSIGNALED(status) else _FAILED)


_SIGNALLED, _FAILED = 100, 99


def _work(request: dict[str, Any], requests: IO[bytes], answers: IO[bytes]) -> None:
    """Make the object of a session and call its methods until the session ends."""
    # The server was started earlier, perhaps from another folder: names of files are relative.
    with contextlib.suppress(OSError):
        os.chdir(request["folder"])
    _limit(request["limits"])
    module, _, name = request["target"].partition(":")
    found: list[Any] = []

    def make(*arguments: object) -> None:
        found.append(getattr(importlib.import_module(module), name)(*arguments))

    _answer(answers, make, request["arguments"])
    while found and (data := _receive(requests)) is not None:
        call = pickle.loads(data)
        if call is None:
            return
        method, arguments = call
        _answer(answers, getattr(found[0], method), arguments)


def _folder() -> str:
    """Give the folder that names of files are relative to; the root if it is gone."""
    try:
        return os.getcwd()
    except OSError:
        return os.sep


def _answer(answers: IO[bytes], call: Callable[..., object], arguments: tuple[Any, ...]) -> None:
    try:
        answer: tuple[str, object] = "done", call(*arguments)
    except AssocHullError as error:
        answer = "error", error
    except MemoryError:
        answer = "memory", None
    except Exception as error:  # a library raises whatever its readers meet
        words = f"{type(error).__name__}: {error}"
        lacking = "bad_alloc" in words or "OutOfMemory" in words
        answer = ("memory", None) if lacking else ("fault", type(error).__name__)
    try:
        _send(answers, answer)
    except Exception as error:  # what cannot be pickled, or no memory is left for it
        kind = "memory" if isinstance(error, MemoryError) else "fault"
        _send(answers, (kind, type(error).__name__))


def _limit(limits: Limits) -> None:
    """Limit memory and processor time, where the system can; the parent looks at the clock."""
    try:
        import resource
    except ImportError:
        return
    seconds = int(limits.seconds) + 1
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 1))
    with contextlib.suppress(OSError, ValueError):
        pages = int(Path("/proc/self/statm").read_text("ascii").split()[0])
        size = pages * resource.getpagesize() + int(limits.memory * _MB)
        resource.setrlimit(resource.RLIMIT_AS, (size, size))


# --------------------------------------------------------------------------------------
# The parent.

_SCRIPT = (
    "import json, sys; sys.path[:] = json.loads(sys.argv[1]); "
    "from assoc_hull.io.child_process import serve; serve()"
)
_ONE_THREAD = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
_KEPT = 2
"""Servers that wait for the next session."""

_PATIENCE, _GRACE = 5.0, 120.0
"""So many times its processor time, and so many seconds more, may a call last by the clock."""


class _Server:
    """A child with its pipes, of the process that made it."""

    def __init__(self) -> None:
        self.owner = os.getpid()
        environment = os.environ | dict.fromkeys(_ONE_THREAD, "1")
        self.process = subprocess.Popen(
            [sys.executable, "-c", _SCRIPT, json.dumps(sys.path)], env=environment,
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
            start_new_session=True,
        )  # fmt: skip

    def end(self) -> None:
        """End the child and its workers."""
        if self.owner != os.getpid():
            return
        with contextlib.suppress(OSError):
            # Workers are of its group: they end too.
            if hasattr(os, "killpg"):
                os.killpg(self.process.pid, signal.SIGKILL)
            else:
                self.process.kill()
        for pipe in (self.process.stdin, self.process.stdout):
            if pipe is not None:
                with contextlib.suppress(OSError):
                    pipe.close()
        self.process.wait()


_WAITING: list[_Server] = []
_GATE = Gate()


def _take() -> _Server:
    return _GATE.alone(_waiting) or _Server()


def _waiting() -> _Server | None:
    while _WAITING:
        server = _WAITING.pop()
        if server.owner == os.getpid() and server.process.poll() is None:
            return server
    return None


def _give_back(server: _Server) -> None:
    if not _GATE.alone(lambda: _kept(server)):
        server.end()


def _kept(server: _Server) -> bool:
    room = hasattr(os, "fork") and server.owner == os.getpid() and len(_WAITING) < _KEPT
    if room:
        _WAITING.append(server)
    return room


def _forget() -> None:
    """Leave the servers to the process that made them, in one that was forked from it."""
    global _GATE
    _GATE = Gate()
    for server in _WAITING:
        server.process.returncode = 0  # none of ours: it is not waited for here
    _WAITING.clear()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_forget)


@atexit.register
def _end_all() -> None:
    while _WAITING:
        _WAITING.pop().end()


def _finish(server: _Server) -> None:
    """Let the worker of a session end, and keep its server."""
    if server.owner != os.getpid() or server.process.stdin is None:
        return
    try:
        _send(server.process.stdin, None)
    except (OSError, ValueError):
        server.end()
    else:
        _give_back(server)


class ChildSession:
    """An object of this package in a child process, until the session is closed or forgotten.

    Parameters
    ----------
    target : str
        Module and name of what makes the object there, as ``"package.module:Name"``.
    arguments : tuple
        Of it; plain values.
    limits : Limits
        Of memory and time, for the whole session.
    where : str
        For messages, as ``"at hull.step"``.
    preload : tuple of str
        Modules that a server imports, and functions (``"module:name"``) that it calls, before it
        forks: what that costs is paid once.

    Raises
    ------
    BadInputError
        A limit is passed, the child ends, or what is called there fails; which is said.
    AssocHullError
        As it is raised there.
    """

    def __init__(
        self,
        target: str,
        arguments: tuple[Any, ...],
        limits: Limits,
        where: str,
        preload: tuple[str, ...] = (),
    ) -> None:
        self._limits, self._where = limits, where
        self._server = _take()
        self._finish = weakref.finalize(self, _finish, self._server)
        self._finish.atexit = False
        request = {
            "target": target, "arguments": arguments, "limits": limits, "preload": preload,
            "folder": _folder(),
        }  # fmt: skip
        self._ask(request)

    def call(self, method: str, *arguments: object) -> Any:
        """Call a method of the object there."""
        return self._ask((method, arguments))

    def close(self) -> None:
        """End the session; the server stays for the next one."""
        self._finish()

    def _ask(self, request: object) -> Any:
        process = self._server.process
        assert process.stdin is not None
        assert process.stdout is not None
        late = threading.Event()

        def stop() -> None:
            late.set()
            with contextlib.suppress(OSError):
                process.kill() if not hasattr(os, "killpg") else os.killpg(process.pid, 9)

        clock = threading.Timer(_PATIENCE * self._limits.seconds + _GRACE, stop)
        clock.daemon = True
        clock.start()
        data: bytes | None = None
        try:
            with contextlib.suppress(OSError):
                _send(process.stdin, request)
                data = _receive(process.stdout)
        except BaseException:
            self._drop()
            raise
        finally:
            clock.cancel()
        if data is None:
            raise self._ended(late=late.is_set())
        return self._result(data)

    def _drop(self) -> int:
        """Give the session up with its server; tell how that ended."""
        self._finish.detach()
        with contextlib.suppress(subprocess.TimeoutExpired):
            self._server.process.wait(1.0)
        self._server.end()
        return int(self._server.process.returncode)

    def _result(self, data: bytes) -> Any:
        try:
            kind, value = _Plain(BytesIO(data)).load()
        except Exception as error:
            self._drop()
            what = "the library that reads it gave no result that can be taken"
            raise BadInputError(what, self._where, _AGAIN) from error
        if kind == "done":
            return value
        if kind == "error":
            raise value
        if kind == "memory":
            raise self._too_much()
        raise BadInputError(f"it cannot be read ({value})", self._where, _AGAIN)

    def _too_much(self) -> BadInputError:
        what = f"reading it takes more than {self._limits.memory:.0f} MB of memory"
        return BadInputError(what, self._where, f"{_ONLY}, or allow more MB with {_MEMORY}")

    def _ended(self, *, late: bool) -> BadInputError:
        """Say how the child ended."""
        code = self._drop()
        number = code - _SIGNALLED if code > _SIGNALLED else -code
        if late or number == getattr(signal, "SIGXCPU", -1):
            what = f"reading it takes more than {self._limits.seconds:.0f} s of processor time"
            return BadInputError(what, self._where, f"{_ONLY}, or allow more s with {_SECONDS}")
        name = signal.Signals(number).name if 0 < number < signal.NSIG else f"code {code}"
        what = f"the library that reads it broke down ({name})"
        aborted = name in ("SIGABRT", "SIGKILL")
        more = f", or, if memory ran out, allow more MB with {_MEMORY}" if aborted else ""
        return BadInputError(what, self._where, f"{_AGAIN}{more}")


_AGAIN = "the file is damaged: export it again"
_ONLY = "export the hull only"


def run_in_child(
    target: str,
    arguments: tuple[Any, ...],
    limits: Limits,
    where: str,
    preload: tuple[str, ...] = (),
) -> Any:
    """Call a function of this package in a child; what is returned and raised is as there.

    The arguments are those of `ChildSession`.
    """
    session = ChildSession(
        "assoc_hull.io.child_process:_Function", (target,), limits, where, preload
    )
    try:
        return session.call("call", arguments)
    finally:
        session.close()


class _Function:
    """A function as an object of a session."""

    def __init__(self, target: str) -> None:
        module, _, name = target.partition(":")
        self.function = getattr(importlib.import_module(module), name)

    def call(self, arguments: tuple[Any, ...]) -> Any:
        """Call it."""
        return self.function(*arguments)
