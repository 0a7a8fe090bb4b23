"""Who may talk to the page: a relay in front of its server, which by itself asks for nothing.

On localhost the address and the page that asks must be this one, so that no other web page can use
the browser to reach the view. Elsewhere a token is needed: the first address that is opened holds
it, then a cookie does.
"""

from __future__ import annotations

import asyncio
import contextlib
import hmac
import http
import ipaddress
import secrets
import socket
import threading
from http.cookies import CookieError, SimpleCookie
from urllib.parse import parse_qs, urlsplit

from .. import _core

LONGEST_HEAD = 1 << 16  #: bytes
SECONDS_FOR_HEAD = 10.0
PORTS_TO_TRY = 50
GONE = (OSError, asyncio.IncompleteReadError, asyncio.CancelledError)


def is_local(host: str) -> bool:
    """Whether only programs of this machine reach a server there."""
    if host == "localhost":
        return True
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False


def listening_socket(host: str, port: int) -> socket.socket:
    """Bound to the port, or to the next one that is free. Raises UsageError if there is none."""
    if not 0 <= port < 1 << 16:
        raise _core.UsageError(f"port is {port}, but should be a number from 0 to 65535")
    try:
        socket.getaddrinfo(host, None)
    except OSError:
        raise _core.UsageError(f"there is no host {host!r}") from None
    problem: OSError | None = None
    for candidate in range(port, min(port + PORTS_TO_TRY, 1 << 16)) if port else (0,):
        try:
            return socket.create_server((host, candidate), family=_family(host))
        except PermissionError:
            raise _core.UsageError(f"port {candidate} needs rights that you do not have") from None
        except OSError as error:
            problem = error
    raise _core.UsageError(f"cannot listen at {host}, port {port} and those after it: {problem}")


def _family(host: str) -> int:
    return socket.AF_INET6 if ":" in host else socket.AF_INET


class Request:
    """The head of an HTTP request."""

    def __init__(self, head: bytes):
        lines = head.decode("latin-1").split("\r\n")
        self.target = [*lines[0].split(" "), "", ""][1]
        pairs = (line.partition(":") for line in lines[1:] if line)
        self.headers = {name.strip().lower(): value.strip() for name, _, value in pairs}

    @property
    def upgrades(self) -> bool:
        return self.headers.get("upgrade", "").lower() == "websocket"

    def cookie(self, name: str) -> str:
        try:
            found = SimpleCookie(self.headers.get("cookie", "")).get(name)
        except CookieError:
            return ""
        return found.value if found else ""

    def token(self) -> str:
        return parse_qs(urlsplit(self.target).query).get("token", [""])[0]


class Gate:
    """Listens at an address and relays to a port of this machine what may pass."""

    def __init__(self, host: str, port: int, to_port: int, token: str | None):
        self._socket = listening_socket(host, port)
        self.host, self.port = host, self._socket.getsockname()[1]
        self._to_port, self._token = to_port, token
        self._cookie, self._word = f"pymlt_view_{self.port}", secrets.token_urlsafe(16)
        self._loop, self._closing = asyncio.new_event_loop(), asyncio.Event()
        self._thread = threading.Thread(target=self._run, name="pymlt view: gate", daemon=True)
        self._thread.start()

    def close(self) -> None:
        with contextlib.suppress(RuntimeError):
            self._loop.call_soon_threadsafe(self._closing.set)
        self._thread.join(2)

    def _run(self) -> None:
        with contextlib.closing(self._loop) as loop:
            loop.run_until_complete(self._serve())

    async def _serve(self) -> None:
        server = await asyncio.start_server(self._relay, sock=self._socket, limit=LONGEST_HEAD)
        await self._closing.wait()
        server.close()
        await _cancel_all()

    async def _relay(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        with contextlib.closing(writer), contextlib.suppress(*GONE):
            try:
                async with asyncio.timeout(SECONDS_FOR_HEAD):
                    head = await reader.readuntil(b"\r\n\r\n")
            except (TimeoutError, asyncio.LimitOverrunError):
                return
            request = Request(head)
            refusal = self.refusal(request)
            if refusal is not None:
                writer.write(refusal)
                await writer.drain()
                return
            page, to_page = await asyncio.open_connection("127.0.0.1", self._to_port)
            with contextlib.closing(to_page):
                to_page.write(head)
                tasks = [asyncio.ensure_future(_copy(page, writer))]
                if request.upgrades:
                    tasks.append(asyncio.ensure_future(_copy(reader, to_page)))
                try:
                    await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
                finally:
                    for task in tasks:
                        task.cancel()

    def refusal(self, request: Request) -> bytes | None:
        """The answer to a request that may not pass; None for one that may."""
        origin, host = request.headers.get("origin"), request.headers.get("host", "")
        if request.upgrades and (not origin or urlsplit(origin).netloc != host):
            return _answer(http.HTTPStatus.FORBIDDEN, "This page is not part of the view.")
        if self._token is None:
            name = urlsplit(f"//{host}").hostname or ""
            if is_local(name):
                return None
            return _answer(http.HTTPStatus.FORBIDDEN, "Use the address that pymlt has printed.")
        if _equal(request.cookie(self._cookie), self._word):
            return None
        if _equal(request.token(), self._token):
            keep = f"{self._cookie}={self._word}; HttpOnly; SameSite=Strict; Path=/"
            return _answer(http.HTTPStatus.SEE_OTHER, "", f"Location: ./\r\nSet-Cookie: {keep}\r\n")
        return _answer(
            http.HTTPStatus.FORBIDDEN, "A token is needed: use the address that pymlt has printed."
        )


async def _cancel_all() -> None:
    tasks = asyncio.all_tasks() - {asyncio.current_task()}
    for task in tasks:
        task.cancel()
    await asyncio.gather(*tasks, return_exceptions=True)


def _equal(given: str, token: str) -> bool:
    return hmac.compare_digest(given.encode(), token.encode())


async def _copy(source: asyncio.StreamReader, to: asyncio.StreamWriter) -> None:
    with contextlib.suppress(OSError):
        while data := await source.read(1 << 16):
            to.write(data)
            await to.drain()


def _answer(status: http.HTTPStatus, text: str, more: str = "") -> bytes:
    body = text.encode()
    head = (
        f"HTTP/1.1 {status.value} {status.phrase}\r\nContent-Type: text/plain; charset=utf-8\r\n"
        f"Content-Length: {len(body)}\r\nConnection: close\r\n{more}\r\n"
    )
    return head.encode() + body
