"""viser's server, with the gate's socket and rules in place of its own."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import threading
from collections.abc import Iterator
from http import HTTPStatus
from typing import Any

import websockets.asyncio.server
from websockets.exceptions import InvalidHandshake, InvalidMessage
from websockets.frames import CloseCode

from .. import _core
from .gate import Gate

#: Both a module and the console of rich are changed for a while.
_one_at_a_time = threading.Lock()


def start_viser(viser: Any, gate: Gate) -> Any:
    """Raises UsageError if viser would not serve behind the gate."""
    with _silence(), _behind(gate) as served:
        server = viser.ViserServer(gate.host, gate.port, label="pymlt", verbose=False)
    if not served:
        stop_viser(server)
        raise _core.UsageError(
            f"viser {viser.__version__} does not serve where it is told to: unset "
            "_VISER_PORT_OVERRIDE, or install viser 1.1"
        )
    return server


def stop_viser(server: Any) -> None:
    with _silence():
        server.stop()


@contextlib.contextmanager
def _silence() -> Iterator[None]:
    """viser prints its own address, which is not the one to open, and that it has stopped.

    It prints by rich, which in a notebook leaves the standard output out.
    """
    import rich

    console = rich.get_console()
    with _one_at_a_time:
        before, console.quiet = console.quiet, True
        try:
            yield
        finally:
            console.quiet = before


@contextlib.contextmanager
def _behind(gate: Gate) -> Iterator[list[bool]]:
    """Put what is served at the gate's address behind it; the list is empty if nothing was."""
    serve, served = websockets.asyncio.server.serve, []

    def serve_behind(handler: Any, *place: Any, **settings: Any) -> Any:
        if place != (gate.host, gate.port):
            return serve(handler, *place, **settings)
        page = settings.pop("process_request")
        served.append(True)
        return serve(
            lambda connection: _talk(handler, connection),
            sock=gate.socket,
            process_request=lambda *asked: gate.answer(*asked) or _file(page, *asked),
            create_connection=Connection,
            logger=_logger(),
            **settings,
        )

    websockets.asyncio.server.serve = serve_behind
    try:
        yield served
    finally:
        websockets.asyncio.server.serve = serve


def _file(page: Any, connection: Any, request: Any) -> Any:
    """viser's answer to a request for one of its files."""
    try:
        return page(connection, request)
    except OSError:  # a name that no file can have
        return connection.respond(HTTPStatus.NOT_FOUND, "There is no such page.")


async def _talk(handler: Any, connection: Any) -> None:
    """viser's conversation with a page, which ends without a traceback if it makes no sense."""
    asyncio.get_running_loop().set_exception_handler(_log)
    try:
        await handler(connection)
    except Exception as error:
        _log(None, {"exception": error})
        await connection.close(CloseCode.INVALID_DATA, "This message makes no sense.")


def _log(_loop: Any, context: dict[str, Any]) -> None:
    logging.getLogger(__name__).debug("%r", context)


class Connection(websockets.asyncio.server.ServerConnection):
    """Says so to whom speaks no HTTP; websockets would hang up without a word."""

    _told = False

    def send_data(self) -> None:
        if not self._told and isinstance(self.protocol.handshake_exc, InvalidMessage):
            self._told = True
            self.transport.write(self.respond(400, "This is no HTTP request.").serialize())
        super().send_data()


def _logger() -> logging.Logger:
    """Silent about requests that make no sense, of which websockets tells with a traceback."""
    logger = logging.getLogger(__name__)
    logger.addFilter(_is_our_fault)
    return logger


def _is_our_fault(record: logging.LogRecord) -> bool:
    return not (record.exc_info and isinstance(record.exc_info[1], InvalidHandshake))
