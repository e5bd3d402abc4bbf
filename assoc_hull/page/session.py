"""The hull behind the page: one thread that works on it, and what every connection asks of it.

`Session.submit` takes messages from any thread, and returns at once; the worker answers by
`Client.tell`. Of the places that one gesture asks for only the newest waits: an older one that was
not begun is dropped, so the worker is never behind the hand by more than one step.
"""

from __future__ import annotations

import contextlib
import json
import logging
import threading
import time
from collections import deque
from collections.abc import Callable, Iterator
from typing import Any, ClassVar, Protocol, cast

import attrs
import numpy as np

from assoc_hull.edit.document import SIGNED, STOPPED
from assoc_hull.edit.drag import Drag, DragWay, Live
from assoc_hull.edit.hull_normals import hull_normals
from assoc_hull.edit.shapes import joined
from assoc_hull.edit.step import EditReport
from assoc_hull.errors import AssocHullError, BadInputError, RefusedEditError, StaleHullError
from assoc_hull.hull.hull import Hull
from assoc_hull.io.hull_file.saving import is_behind_file
from assoc_hull.model.address import address
from assoc_hull.model.kinds import Role
from assoc_hull.model.objects import Point
from assoc_hull.page.answers import (
    describe_fairness,
    describe_hydrostatics,
    describe_parameters,
    describe_why,
)
from assoc_hull.page.describe import describe_net, describe_state, net_words
from assoc_hull.page.files import write_export
from assoc_hull.page.ghosts import (
    Ghost,
    ghost_of_edits,
    ghost_of_variant,
    ghost_of_window,
)
from assoc_hull.page.messages import (
    Apply,
    AskFairness,
    AskHydrostatics,
    AskPreview,
    AskSteps,
    AskWhy,
    Begin,
    Cancel,
    Check,
    Checkpoint,
    Commit,
    Compare,
    Export,
    Go,
    Hello,
    Message,
    Parameters,
    Question,
    Redo,
    Sign,
    Stop,
    To,
    Undo,
    Vary,
    Window,
)
from assoc_hull.page.past import (
    describe_steps,
    ghost_of_step,
    movements_of_step,
    require_own_steps,
    require_step,
    state_of_step,
)
from assoc_hull.page.readers import CopyReaders
from assoc_hull.page.spare_memory import SpareMemory
from assoc_hull.page.wire import Frame, FrameKind, pack

__all__ = ["Client", "Session"]

_LOG = logging.getLogger("assoc_hull.page")


class Client(Protocol):
    """One connection: what a session knows of it."""

    author: str

    def tell(self, message: str | bytes) -> None:
        """Send a message; from any thread, without waiting."""


@attrs.define(eq=False)
class _Gesture:
    """A point that somebody holds; `let_go` once its end was asked for."""

    client: Client
    number: int
    row: int
    drag: Drag
    place: list[float]
    let_go: bool = False
    touched: float = attrs.field(factory=time.monotonic)


_Job = tuple[Client, Message | None]
_STOPPED = ("it was stopped; nothing is changed",)
_IDLE: _Job = None, None  # type: ignore[assignment]
_LOOK_AGAIN = 0.2  # s
_WATCH = 0.5  # s between two looks at what other processes have committed
_FORGOTTEN = 30.0  # s without a move: another may take the hull from a view that has vanished


class Session:
    """A hull that pages show and edit; `close` ends its thread.

    Parameters
    ----------
    hull : Hull
        The hull. What others make of it, in this process as a cell of a notebook does, or in
        another one by the hull file, is shown as soon as the worker is idle.
    """

    def __init__(self, hull: Hull) -> None:
        self.hull = hull
        self._clients = list[Client]()
        self._gesture: _Gesture | None = None
        self._jobs = deque[_Job]()
        self._awake = threading.Condition()
        self._open = True
        self._reader = CopyReaders("assoc-hull page reader", 1)
        # A surface takes ten seconds to write: no other answer waits for it.
        self._writer = CopyReaders("assoc-hull page writer", 1)
        # A fair answer may take minutes: hydrostatics do not wait for it, nor the next one asked.
        self._answerer = CopyReaders("assoc-hull page answerer", 2)
        self._newest = dict[tuple[Client, type[Message]], int]()
        # The variation that is being made, and whether it is still wanted.
        self._varying: tuple[Client, int | None] | None = None
        self._wanted = True
        self._opening = hull.snapshot()
        self._shown = hull.state_number
        self._words = net_words(hull.state)
        self._memory = SpareMemory()
        self._watched = time.monotonic()
        self._faults = 0
        self._worker = threading.Thread(target=self._work, name="assoc-hull page", daemon=True)
        self._worker.start()

    # ----------------------------------------------------------------------------------
    # From any thread.

    def submit(self, client: Client, message: Message) -> None:
        """Ask for something; the answer comes to the client."""
        if isinstance(message, Stop):
            self._stop(client, message.id)
            return
        with self._awake:
            if isinstance(message, To):
                self._drop_older(client, message.gesture)
            if isinstance(message, Commit | Cancel):
                held = self._held(client, message.gesture)
                if held is not None:
                    held.let_go = True
                    held.drag.stop()
            self._jobs.append((client, message))
            self._awake.notify()

    def _stop(self, client: Client, number: int | None = None) -> None:
        """End the answer to a question, or all that a client waits for, also while others run."""
        with self._awake:
            self._wanted &= self._varying not in ((client, number), (client, None))
            given_up = [
                job for job in self._jobs
                if job[0] is client and isinstance(job[1], Question | Export)
                and number in (None, job[1].id)
            ]  # fmt: skip
            self._jobs = deque(job for job in self._jobs if job not in given_up)
        for _, message in given_up:
            if isinstance(message, Vary) and message.apply:
                self._refuse(client, 0, 0, _STOPPED, None, message.id)
        for each in (self._reader, self._writer, self._answerer):
            each.stop(client, number)

    def _drop_older(self, client: Client, gesture: int) -> None:
        """Forget the place that a gesture asked for last, if nobody has begun with it."""
        for index in range(len(self._jobs) - 1, -1, -1):
            whose, waiting = self._jobs[index]
            if whose is client and type(waiting) is To and waiting.gesture == gesture:
                del self._jobs[index]
                return

    def leave(self, client: Client) -> None:
        """Forget a connection that has ended, and what it holds."""
        with self._awake:
            self._jobs.append((client, None))
            self._awake.notify()

    def close(self) -> None:
        """End the thread, when the command that runs is done; answers are not waited for."""
        with self._awake:
            self._open = False
            self._awake.notify()
        for each in (self._reader, self._writer, self._answerer):
            each.close()
        # The collector may end a session that is lost in the worker itself.
        if threading.current_thread() is not self._worker:
            self._worker.join()

    # ----------------------------------------------------------------------------------
    # In the worker.

    def _work(self) -> None:
        while (job := self._next()) is not None:
            try:
                self._watch_file()
                self._show_others()
                if job is not _IDLE:
                    self._memory.used = True
                    self._do(*job)
                elif self._gesture is None:
                    self._memory.give_back()
            except Exception:  # one message that fails must not silence the page for everybody
                self._faults += 1
                _LOG.exception("fault %d of the page's session", self._faults)
        self._end_gesture()

    def _do(self, client: Client, message: Message | None) -> None:
        """Do what a client asks for; None says that it has gone."""
        if message is None:
            self._forget(client)
            return
        with self._told(client, message):
            self._acts[type(message)](self, client, message)

    def _next(self) -> _Job | None:
        """Wait for a job; `_IDLE` where none came, None at the end."""
        with self._awake:
            self._awake.wait_for(lambda: self._jobs or not self._open, _LOOK_AGAIN)
            if not self._open:
                return None
            return self._jobs.popleft() if self._jobs else _IDLE

    def _watch_file(self) -> None:
        """Take over what another process has committed, unless a point is held.

        Then it waits until the point is let go: a hull must not change under a hand.
        """
        now = time.monotonic()
        if self._gesture is not None or now - self._watched < _WATCH:
            return
        self._watched = now
        with contextlib.suppress(AssocHullError):  # the next edit says what is wrong with the file
            if is_behind_file(self.hull.document):
                known = len(self.hull.document.steps)
                self.hull.refresh()
                self._show_others()
                self._tell_newest(known)

    def _tell_newest(self, known: int) -> None:
        """Tell everybody whose the newest edit is, if there are more than were known."""
        made = [each for each in self.hull.document.history if each.number > known]
        for each in self._clients if made else ():
            report = made[-1].report
            _send(each, {"t": "theirs", "author": report.author, **_figures(report)})

    def _show_others(self) -> None:
        """Show what others have made of the hull in this process since it was shown last."""
        if self.hull.state_number == self._shown:
            return
        held = self._gesture
        self._end_gesture()  # it was begun on another hull
        if held is not None:
            why = ("the hull was changed in another place; take hold of the point again",)
            self._refuse(held.client, held.number, 0, why, held.row)
        try:
            self._publish(self._shown)
        except AssocHullError:  # too much has changed since: all is told
            number = self.hull.state_number
            self._tell_net(self._clients)
            self._shown = number

    @contextlib.contextmanager
    def _told(self, client: Client, message: Message) -> Iterator[None]:
        """Tell whatever fails, as a problem; a gesture that fails is over."""
        try:
            yield
        except StaleHullError as error:
            self._end_gesture()
            self._take_over(client, message, error)
        except AssocHullError as error:
            self._problem(client, message, str(error))
        except Exception as error:  # a page that falls silent is of no use to a designer
            self._faults += 1
            _LOG.exception("fault %d of the page's session", self._faults)
            what = f"an error of this program (number {self._faults} in its log): "
            self._problem(client, message, f"{what}{type(error).__name__} {error}")

    def _take_over(self, client: Client, message: Message, error: StaleHullError) -> None:
        """Show what another process has committed, and say that nothing else was done."""
        before = self.hull.state_number
        self.hull.refresh()
        self._publish(before)
        newer = ", ".join(error.newer[-3:]) or "an undo or a redo"
        text = f"another program has changed the hull ({newer}): it is shown now, and your edit "
        self._problem(client, message, f"{text}was not made; look, and do it again")

    def _problem(self, client: Client, message: Message, text: str) -> None:
        number = getattr(message, "gesture", 0)
        if isinstance(message, Begin | To | Cancel):
            self._end_gesture()
        answer = {"t": "problem", "id": getattr(message, "id", 0), "gesture": number, "text": text}
        _send(client, answer)

    def _forget(self, client: Client) -> None:
        if self._gesture is not None and self._gesture.client is client:
            self._end_gesture()
        self._clients = [each for each in self._clients if each is not client]
        for key in [key for key in self._newest if key[0] is client]:
            del self._newest[key]
        self._stop(client)

    def _hello(self, client: Client, message: Hello) -> None:
        client.author = message.author
        if client not in self._clients:
            self._clients.append(client)
        path = self.hull.path
        file = None if path is None else path.name
        _send(client, {"t": "session", "author": client.author, "file": file})
        self._tell_net([client])
        held = self._gesture
        if held is not None and held.client is not client:
            _send(client, {"t": "hold", "author": held.client.author, "row": held.row})

    def _sign(self, client: Client, message: Sign) -> None:
        client.author = message.author
        _send(client, describe_state(self.hull.document, client.author))

    def _begin(self, client: Client, message: Begin) -> None:
        if (text := self._held_by_other(client)) is not None:
            self._refuse(client, message.gesture, 0, (text,), None)
            return
        self._end_gesture()
        state = self.hull.state
        if message.row >= state.rows.count or not state.rows.alive[message.row]:
            what, remedy = f"there is no point {message.row}", "reload the page"
            raise BadInputError(what, "in begin", remedy)
        radius = None if message.radius is None else (message.radius[0], message.radius[1])
        point, how = Point.of(state, message.row), cast(DragWay, message.how)
        drag = self.hull.drag(point, how, radius)
        place = drag.start.tolist()
        self._gesture = _Gesture(client, message.gesture, message.row, drag, place)
        if how == "move" and not drag.free:
            # The library says why, and what may be moved instead.
            self._refuse(client, message.gesture, 0, drag.to(y=place[1]).refused, message.row)
            self._end_gesture()
            return
        _send(client, {
            "t": "grip", "gesture": message.gesture, "row": message.row, "start": place,
            "free": "".join(drag.free),
            "normal": None if drag.normal is None else drag.normal.tolist(),
            "radius": None if drag.radius is None else list(drag.radius),
        })  # fmt: skip
        for each in self._others(client):
            _send(each, {"t": "hold", "author": client.author, "row": message.row})

    def _others(self, client: Client) -> list[Client]:
        return [each for each in self._clients if each is not client]

    def _held_by_other(self, client: Client) -> str | None:
        """Say who else has a point in hand: nobody takes the hull from under it."""
        if (held := self._gesture) is None or held.client is client:
            return None
        if time.monotonic() - held.touched > _FORGOTTEN:
            self._end_gesture()
            return None
        name = address(self.hull.state, held.row)
        return f"{held.client.author} holds {name}; wait until it is let go"

    def _require_free(self, client: Client, act: str) -> None:
        if (text := self._held_by_other(client)) is not None:
            who, _, remedy = text.partition("; ")
            raise BadInputError(who, f"in {act}", remedy)

    def _held(self, client: Client, gesture: int) -> _Gesture | None:
        held = self._gesture
        if held is None or held.client is not client or held.number != gesture:
            return None
        return held

    def _to(self, client: Client, message: To) -> None:
        if (held := self._held(client, message.gesture)) is None:
            return  # it was let go meanwhile
        held.touched = time.monotonic()
        live = held.drag.to(**message.amounts)
        if held.let_go:
            return  # nobody waits for the answer, which may be that it was stopped
        if live.refused:
            self._refuse(client, message.gesture, message.seq, live.refused, held.row)
        else:
            frame = self._live(held.number, message.seq, live)
            client.tell(pack(frame))
            if others := self._others(client):
                theirs = pack(attrs.evolve(frame, kind=FrameKind.THEIRS))
                for each in others:
                    each.tell(theirs)

    def _live(self, gesture: int, sequence: int, live: Live) -> Frame:
        state, lcb = self.hull.state, live.lcb_change
        # A watched crossing slides with its lines: how far the hull moves is told by the others.
        own = state.rows.role[live.rows] != Role.WATCHED
        rows = live.rows[own]
        way = (live.xyz[own] - state.rows.xyz[rows]) * hull_normals(state)[rows]
        return Frame(
            FrameKind.LIVE, state.number, live.curves, live.spline, live.rows, live.xyz, gesture,
            sequence, bool(live.born or live.gone), live.seconds, live.volume_change,
            lcb if np.isfinite(lcb) else 0.0, float(np.abs(way.sum(axis=1)).max(initial=0.0)),
        )  # fmt: skip

    def _refuse(
        self, client: Client, gesture: int, sequence: int, reasons: tuple[str, ...],
        row: int | None, number: int = 0,
    ) -> None:  # fmt: skip
        _send(client, {"t": "refused", "gesture": gesture, "seq": sequence, "id": number,
                       "reasons": list(reasons), "row": row})  # fmt: skip

    def _commit(self, client: Client, message: Commit) -> None:
        if (held := self._held(client, message.gesture)) is None:
            what = "the point was let go before"
            raise BadInputError(what, f"in {message.name}", "take hold of it again")
        live = held.drag.to(**message.amounts)
        if live.refused:
            self._refuse(client, message.gesture, message.seq, live.refused, held.row)
            self._end_gesture()
            return
        self._edit(client, lambda: held.drag.commit(message.name), gesture=message.gesture)

    def _cancel(self, client: Client, message: Cancel) -> None:
        if self._held(client, message.gesture) is not None:
            self._end_gesture()

    def _end_gesture(self) -> None:
        if self._gesture is not None:
            self._gesture.drag.__exit__(None, None, None)
            for each in self._others(self._gesture.client):
                _send(each, {"t": "hold", "author": self._gesture.client.author, "row": None})
        self._gesture = None

    def _apply(self, client: Client, message: Apply) -> None:
        def carry_out() -> EditReport:
            report = self.hull.apply(message.name, message.ops)
            assert report is not None, "no edit is open here that it could have joined"
            return report

        self._require_free(client, "an edit")
        try:
            self._edit(client, carry_out, number=message.id)
        except RefusedEditError as error:
            self._refuse(client, 0, 0, error.findings, None, message.id)

    def _edit(
        self, client: Client, act: Callable[[], EditReport], *, gesture: int = 0, number: int = 0
    ) -> None:
        """Make an edit in the name of a client; tell everybody, and the client what it did."""
        before = self.hull.state_number
        with self._signed(client):
            report = act()
        self._end_gesture()
        self._publish(before)
        told = _figures(report)
        _send(client, {"t": "done", "id": number, "gesture": gesture, **told})
        for each in self._others(client):
            _send(each, {"t": "theirs", "author": client.author, **told})

    def _undo(self, client: Client, message: Undo) -> None:
        self._require_free(client, "undo")
        before = self.hull.state_number
        self.hull.undo(author=client.author)
        self._turned(client, before, message.id)

    def _redo(self, client: Client, message: Redo) -> None:
        self._require_free(client, "redo")
        before = self.hull.state_number
        self.hull.redo()
        self._turned(client, before, message.id)

    def _turned(self, client: Client, before: int, number: int) -> None:
        """Show a state that was there before."""
        self._end_gesture()
        self._publish(before)
        _send(client, {"t": "answer", "id": number, "value": None})

    def _check(self, client: Client, message: Check) -> None:
        found = [
            {"kind": each.kind, "object": each.object, "place": each.place, "text": str(each)}
            for each in self.hull.check()
        ]
        _send(client, {"t": "answer", "id": message.id, "value": found})

    def _parameters(self, client: Client, message: Parameters) -> None:
        of = message.of
        self._look(client, message, lambda copy: describe_parameters(copy, of))

    def _vary(self, client: Client, message: Vary) -> None:
        if message.apply:
            self._require_free(client, "a variation")
            try:
                self._edit(client, lambda: self._made_variant(client, message), number=message.id)
            except RefusedEditError as error:
                self._refuse(client, 0, 0, error.findings, None, message.id)
            return
        accept = message.accept
        self._show(
            client, message,
            lambda copy: _shown(ghost_of_variant(copy, message.set, accept=accept)),
        )  # fmt: skip

    def _made_variant(self, client: Client, message: Vary) -> EditReport:
        """Vary the hull itself, unless that is given up meanwhile."""
        with self._awake:
            self._varying, self._wanted = (client, message.id), True
        token = STOPPED.set(lambda: not self._wanted)
        try:
            made = self.hull.vary(set=message.set, accept=message.accept, in_place=True)
        except KeyboardInterrupt:
            raise RefusedEditError("the variation", _STOPPED) from None
        finally:
            STOPPED.reset(token)
            self._varying = None
        return made.report.edit

    def _steps(self, client: Client, message: AskSteps) -> None:
        _answer(client, message.id, describe_steps(self.hull.document))

    def _go(self, client: Client, message: Go) -> None:
        self._require_free(client, "going to a step")
        document, before = self.hull.document, self.hull.state_number
        require_step(document, message.step, "going to a step")
        require_own_steps(document, message.step, client.author)
        document.go_to(message.step)
        self._turned(client, before, message.id)

    def _compare(self, client: Client, message: Compare) -> None:
        self._require_free(client, "comparing")
        self._end_gesture()
        then = state_of_step(self.hull.document, message.step)
        self._show(client, message, lambda copy: ghost_of_step(then, copy.state))

    def _checkpoint(self, client: Client, message: Checkpoint) -> None:
        self._require_free(client, "checkpoint")
        self._end_gesture()
        with self._signed(client):
            self.hull.checkpoint(message.name)
        _answer(client, message.id, describe_steps(self.hull.document))

    def _why(self, client: Client, message: AskWhy) -> None:
        found, document = self.hull.why(message.of), self.hull.document
        moved = {} if found.edit is None else movements_of_step(document, found.step)
        _answer(client, message.id, describe_why(found, moved))

    def _hydrostatics(self, client: Client, message: AskHydrostatics) -> None:
        opening = self._opening
        self._look(client, message, lambda copy: describe_hydrostatics(copy, opening))

    def _fairness(self, client: Client, message: AskFairness) -> None:
        self._look(client, message, describe_fairness)

    def _window(self, client: Client, message: Window) -> None:
        row, noise, reach = message.row, message.noise, message.radius
        self._show(
            client, message, lambda copy: ghost_of_window(copy, row, (reach[0], reach[1]), noise)
        )

    def _preview(self, client: Client, message: AskPreview) -> None:
        self._show(client, message, lambda copy: ghost_of_edits(copy, message.ops))

    def _export(self, client: Client, message: Export) -> None:
        copy = self.hull.snapshot()

        def write() -> None:
            with self._told(client, message):
                _answer(client, message.id, write_export(copy, message.form))

        self._writer.submit(client, message, message.id, write)

    def _look(
        self, client: Client, message: Question, job: Callable[[Hull], object]
    ) -> None:  # fmt: skip
        """Answer from a copy of the hull in the thread of readers; the newest of a kind wins."""
        copy, key = self.hull.snapshot(), (client, type(message))

        def look() -> None:
            if self._newest.get(key) != message.id:
                return
            found = job(copy)
            if self._newest.get(key) == message.id:  # nobody has given it up meanwhile
                _answer(client, message.id, found)

        self._newest[key] = message.id
        self._read(client, message, look)

    def _show(
        self, client: Client, message: Question, job: Callable[[Hull], tuple[Frame, object]]
    ) -> None:
        """Show a ghost that is made on a copy, with its figures; the newest of a kind wins."""
        number = self.hull.state_number

        def show(copy: Hull) -> object:
            frame, words = job(copy)
            if self._newest.get((client, type(message))) != message.id:
                return words
            client.tell(pack(attrs.evolve(frame, state=number, sequence=message.id)))
            return words

        self._look(client, message, show)

    @contextlib.contextmanager
    def _signed(self, client: Client) -> Iterator[None]:
        """Sign what this thread does by the name of a client; others sign by their own."""
        signed = SIGNED.set(client.author)
        try:
            yield
        finally:
            SIGNED.reset(signed)

    def _read(self, client: Client, message: Question, job: Callable[[], None]) -> None:
        """Do something with a copy of the hull in the thread of readers; drags go on."""

        def told() -> None:
            with self._told(client, message):
                job()

        readers = self._answerer if isinstance(message, AskPreview) else self._reader
        readers.submit(client, type(message), message.id, told)

    def _publish(self, before: int) -> None:
        """Tell everybody what has changed since a state."""
        number = self.hull.state_number
        changed, state = self.hull.since(before), self.hull.state
        # A knuckle or another name is no structure, but stands in the net that pages know.
        if changed.structural or net_words(state) != self._words:
            self._tell_net(self._clients)
            self._shown = number
            return
        curves = changed.curves[state.curves.alive[changed.curves]]
        # Watched points follow their curves, and are no part of what an edit tells of itself.
        rows = state.live("rows")
        follows = np.isin(state.rows.curve[rows], curves).any(axis=1)
        rows = rows[follows | np.isin(rows, changed.rows)]
        spline = joined([state.spline(curve) for curve in curves.tolist()])
        frame = Frame(FrameKind.PUBLISHED, state.number, curves, spline, rows, state.rows.xyz[rows])
        self._tell_all(self._clients, pack(frame))
        self._shown = number  # only now: what could not be shown is looked at again

    def _tell_net(self, clients: list[Client]) -> None:
        """Tell all of the hull."""
        state, shapes = self.hull.state, self.hull.shapes()
        rows = state.live("rows")
        text = _text(describe_net(state))
        frame = pack(Frame(FrameKind.NET, state.number, shapes.curves, shapes.spline, rows,
                           state.rows.xyz[rows], structural=True))  # fmt: skip
        self._words = net_words(state)
        for client in clients:
            client.tell(text)
        self._tell_all(clients, frame)

    def _tell_all(self, clients: list[Client], frame: bytes) -> None:
        for client in clients:
            client.tell(frame)
            _send(client, describe_state(self.hull.document, client.author))

    _acts: ClassVar[dict[type[Any], Callable[[Session, Client, Any], None]]] = {
        Hello: _hello, Sign: _sign, Begin: _begin, To: _to, Commit: _commit, Cancel: _cancel,
        Apply: _apply, Undo: _undo, Redo: _redo, Check: _check,
        Parameters: _parameters, Vary: _vary, AskSteps: _steps, Go: _go, Compare: _compare,
        Checkpoint: _checkpoint, AskWhy: _why, AskHydrostatics: _hydrostatics,
        AskFairness: _fairness, Window: _window, AskPreview: _preview, Export: _export,
    }  # fmt: skip


def _figures(report: EditReport) -> dict[str, Any]:
    """Give what is told of an edit that was made."""
    normal = report.largest_normal
    return {
        "name": report.name, "relofted": len(report.relofted), "notes": list(report.notes),
        "inflections": sum(n for _, n in report.inflections),
        "normal": None if normal is None else normal.distance,
    }  # fmt: skip


def _shown(ghost: Ghost) -> tuple[Frame, object]:
    return ghost.frame, ghost.words


def _send(client: Client, message: dict[str, Any]) -> None:
    client.tell(_text(message))


def _answer(client: Client, number: int, value: object) -> None:
    _send(client, {"t": "answer", "id": number, "value": value})


def _text(message: dict[str, Any]) -> str:
    return json.dumps(message, separators=(",", ":"), allow_nan=False)
