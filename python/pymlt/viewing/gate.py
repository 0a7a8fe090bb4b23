"""Who may talk to the page: what is asked of a request before its server, viser, sees it.

On localhost the address and the page that asks must be this one, so that no other web page can use
the browser to reach the view. Elsewhere a token is needed: the first address that is opened holds
it, then a cookie does.
"""

from __future__ import annotations

import hmac
import ipaddress
import re
import secrets
import socket
from http import HTTPStatus
from http.cookies import CookieError, SimpleCookie
from typing import TYPE_CHECKING
from urllib.parse import parse_qs

from .. import _core

if TYPE_CHECKING:
    from websockets.asyncio.server import ServerConnection
    from websockets.http11 import Request, Response

PORTS_TO_TRY = 50
HOST = r"(\[[0-9a-f:.]+\]|[0-9a-z._-]+)(:\d{1,5})?"
ORIGIN = rf"null|[a-z][0-9a-z+.-]*://{HOST}"


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


class Gate:
    """A socket that listens, and the rules for requests that come."""

    def __init__(self, host: str, port: int, token: str | None):
        if token is not None and not token.strip():
            raise _core.UsageError("the token is blank, but should be a word that nobody guesses")
        self.socket = listening_socket(host, port)
        self.host: str = host
        self.port: int = self.socket.getsockname()[1]
        self._token = token
        self._cookie, self._word = f"pymlt_view_{self.port}", secrets.token_urlsafe(16)

    def answer(self, connection: ServerConnection, request: Request) -> Response | None:
        """To a request that may not pass; None for one that may."""
        hosts, origins = (request.headers.get_all(name) for name in ("Host", "Origin"))
        if not _is_well_formed(request.path, hosts, origins):
            return connection.respond(HTTPStatus.BAD_REQUEST, "This request makes no sense.")
        asked_by_page = origins or "Upgrade" in request.headers
        if asked_by_page and origins != [f"http://{host}" for host in hosts]:
            return connection.respond(HTTPStatus.FORBIDDEN, "This page is not part of the view.")
        if self._token is None:
            name = re.sub(r":\d+$", "", hosts[0]).strip("[]")
            if is_local(name):
                return None
            return connection.respond(
                HTTPStatus.FORBIDDEN, "Use the address that pymlt has printed."
            )
        if _equal(_cookie(request, self._cookie), self._word):
            return None
        if _equal(_token(request), self._token):
            answer = connection.respond(HTTPStatus.SEE_OTHER, "")
            answer.headers["Location"] = "./"
            keep = f"{self._cookie}={self._word}; HttpOnly; SameSite=Strict; Path=/"
            answer.headers["Set-Cookie"] = keep
            return answer
        return connection.respond(
            HTTPStatus.FORBIDDEN, "A token is needed: use the address that pymlt has printed."
        )


def _is_well_formed(path: str, hosts: list[str], origins: list[str]) -> bool:
    return (
        path.startswith("/")
        and path.isascii()
        and path.isprintable()
        and len(hosts) == 1
        and len(origins) <= 1
        and re.fullmatch(HOST, hosts[0], re.IGNORECASE) is not None
        and all(re.fullmatch(ORIGIN, origin, re.IGNORECASE) for origin in origins)
    )


def _cookie(request: Request, name: str) -> str:
    try:
        found = SimpleCookie("; ".join(request.headers.get_all("Cookie"))).get(name)
    except CookieError:
        return ""
    return found.value if found else ""


def _token(request: Request) -> str:
    return parse_qs(request.path.partition("?")[2]).get("token", [""])[0]


def _equal(given: str, word: str) -> bool:
    return hmac.compare_digest(given.encode(errors="surrogateescape"), word.encode())
