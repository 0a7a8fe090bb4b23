"""Who gets into the live view: nothing listens but its gate, and what may not pass is refused."""

import http.client
import logging
import socket
import threading
import time
import urllib.request
from concurrent.futures import ThreadPoolExecutor

import msgspec
import pytest
import tiny
from listening import listeners
from websockets.sync.client import connect

import pymlt as mlt

viser = pytest.importorskip("viser", reason="the view needs viser (pip install viser)")

from pymlt.viewing.gate import is_local, listening_socket  # noqa: E402

UPGRADE = {
    "Upgrade": "websocket",
    "Connection": "Upgrade",
    "Sec-WebSocket-Version": "13",
    "Sec-WebSocket-Key": "dGhlIHNhbXBsZSBub25jZQ==",
    "Sec-WebSocket-Protocol": f"viser-v{viser.__version__}",
}
EVIL = "http://evil.example"


@pytest.fixture
def page():
    """Makes views; `.ports` are all at which this process listens since."""
    made, before = [], listeners()

    def make(**settings):
        view = mlt.view(tiny.scene(), port=0, **settings)
        view.ports = sorted(found.port for found in listeners() - before)
        made.append(view)
        return view

    yield make
    for view in made:
        view.stop()


def ask(port: int, head: str) -> http.client.HTTPResponse:
    """The answer to exactly these bytes, one for each character."""
    with socket.create_connection(("localhost", port), timeout=60) as connection:
        connection.sendall(head.encode("latin-1"))
        answer = http.client.HTTPResponse(connection)
        answer.begin()
        answer.text = "" if answer.status == 101 else answer.read().decode()
        return answer


def get(port: int, target: str = "/", **headers) -> http.client.HTTPResponse:
    """The answer to a request; a header may be several."""
    lines = [f"GET {target} HTTP/1.1"]
    for name, value in ({"Host": f"localhost:{port}"} | headers).items():
        lines += [f"{name}: {one}" for one in ([value] if isinstance(value, str) else value)]
    return ask(port, "\r\n".join([*lines, "", ""]))


def status(port: int, target: str = "/", **headers) -> int:
    return get(port, target, **headers).status


def test_the_page_is_there_and_goes_away(page):
    view = page()
    with urllib.request.urlopen(view.url) as answer:
        assert answer.status == 200
        assert "<html" in answer.read().decode()
    assert view.url in repr(view)
    assert view.url in view._repr_html_()
    start = time.monotonic()
    view.stop()
    assert time.monotonic() - start < 2
    with pytest.raises(ConnectionRefusedError):
        get(view.port)
    assert not [t for t in threading.enumerate() if t.name.startswith("pymlt view")]


def test_a_page_that_has_just_opened_can_be_closed(page):
    for _ in range(5):
        view = page()
        view.stop()
        assert not view._server._websock_server._server_thread.is_alive()


def test_pages_that_open_at_the_same_time(capsys):
    """Each behind its own gate; nothing is printed, and what is printed later is not lost."""
    before = listeners()
    with ThreadPoolExecutor(4) as pool:
        views = list(pool.map(lambda _: mlt.view(tiny.scene(), port=0), range(4)))
        ports = {found.port for found in listeners() - before}
        assert ports == {view.port for view in views}
        assert [status(port, Host="evil.example") for port in ports] == [403] * 4
        list(pool.map(lambda view: view.stop(), views))
    assert listeners() == before
    print("later")
    assert capsys.readouterr().out == "later\n"


def test_only_pages_of_the_view_may_talk_to_it(page):
    view = page()
    assert view.ports == [view.port]
    for port in view.ports:
        here = f"http://localhost:{port}"
        assert status(port) == 200
        assert status(port, Origin=here) == 200
        assert status(port, **UPGRADE, Origin=here) == 101
        assert status(port, Upgrade="websocket", Origin=here) == 426
        assert status(port, Host="evil.example") == 403
        assert status(port, Host="evil.example", **UPGRADE, Origin=EVIL) == 403
        for origin in (
            EVIL,
            "null",
            f"http://localhost:{port + 1}",
            f"http://127.0.0.1:{port}",
            *(f"{scheme}://localhost:{port}" for scheme in ("https", "ftp", "chrome-extension")),
        ):
            assert status(port, Origin=origin) == 403
            assert status(port, **UPGRADE, Origin=origin) == 403
        assert status(port, **UPGRADE) == 403


def test_a_token_opens_the_page_once_and_a_cookie_from_then_on(page):
    view = page(token="open sesame")
    assert view.ports == [view.port]
    for port in view.ports:
        here = f"http://localhost:{port}"
        for target in "/", "/?token=wrong", "/?token=", "/?token=%FF":
            assert status(port, target) == 403
            assert status(port, target, **UPGRADE, Origin=here) == 403
        assert status(port, Cookie=f"pymlt_view_{port}=wrong") == 403
        assert status(port, Cookie=f"pymlt_view_{port}=\xff") == 403
        opened = get(port, "/?token=open%20sesame")
        assert opened.status == 303
        assert opened.headers["Location"] == "./"  # without the token: people copy addresses
        cookie, *kept = opened.headers["Set-Cookie"].split("; ")
        assert {"HttpOnly", "SameSite=Strict"} <= set(kept)
        assert status(port, Cookie=cookie) == 200
        assert status(port, Cookie=cookie, **UPGRADE, Origin=here) == 101
        assert status(port, Cookie=cookie, **UPGRADE, Origin=EVIL) == 403


@pytest.mark.parametrize("token", [None, "open sesame"])
def test_what_makes_no_sense_is_refused_without_a_traceback(page, caplog, token):
    view = page(token=token)
    port = view.port
    for host in "[", "[::1", "a b", "localhost:port", "me@localhost", "", "\xff", "\0", []:
        assert status(port, Host=host) == 400, host
    assert status(port, Host=["localhost", "localhost"]) == 400
    for origin in "http://[::1", "http://[", "localhost", "", "\xff", "\0", [EVIL, EVIL]:
        assert status(port, Origin=origin) == 400, origin
        assert status(port, **UPGRADE, Origin=origin) == 400, origin
    for target in "http://[", f"http://localhost:{port}/", "*", "/\xff", "/\x01", "":
        assert status(port, target) == 400, target
    for head in "\r\n\r\n", "GET\r\n\r\n", "POST / HTTP/1.1\r\n\r\n", "\xff\0\r\n", "a" * 10_000:
        assert ask(port, head).status == 400, head[:20]
    view.stop()  # all has been said then
    assert not [record for record in caplog.records if record.levelno >= logging.WARNING]


def test_a_page_whose_name_is_too_long_for_a_file_is_not_there(page):
    port = page().port
    for target in "/" + 4000 * "a", "/" + 2000 * "a/", "/%00", "/no-such-page":
        assert get(port, target).status == 404, target[:20]


def junk() -> list[bytes | str]:
    """Messages that nobody's page sends; some are nearly one."""
    pack = msgspec.msgpack.encode
    words = [pack(value) for value in (None, 3, "word", [1], {}, {"type": 3}, {"type": "Nonsense"})]
    words += [pack({"type": kind}) for kind in ("ViewerCameraMessage", "GuiUpdateMessage")]
    camera = dict.fromkeys(("wxyz", "position", "look_at", "up_direction"), "up")
    camera |= {key: [] for key in ("fov", "near", "far", "image_height", "image_width")}
    words.append(pack({"type": "ViewerCameraMessage", **camera}))
    for updates in None, 3, {"value": [[]]}:
        words.append(pack({"type": "GuiUpdateMessage", "uuid": "nothing", "updates": updates}))
    return ["text", b"", b"\xff\xff", b"\x81" * 100, *words]


def test_messages_that_make_no_sense_print_nothing(page, capfd, caplog):
    view = page()
    for message in junk():
        with connect(
            f"ws://localhost:{view.port}",
            origin=f"http://localhost:{view.port}",
            subprotocols=[UPGRADE["Sec-WebSocket-Protocol"]],
        ) as socket:
            socket.send(message)
            time.sleep(0.01)
    time.sleep(0.5)
    view.stop()
    assert capfd.readouterr() == ("", "")
    assert not [record for record in caplog.records if record.levelno >= logging.WARNING]


@pytest.mark.parametrize("token", ["", " ", "\t\n"])
@pytest.mark.parametrize("host", ["localhost", "0.0.0.0"])
def test_a_blank_token_is_refused(token, host):
    with pytest.raises(mlt.UsageError, match="the token is blank"):
        mlt.view(tiny.scene(), host=host, port=0, token=token)


def test_no_other_host_without_a_token():
    with pytest.raises(mlt.UsageError, match="token"):
        mlt.view(tiny.scene(), host="0.0.0.0")
    assert is_local("localhost")
    assert is_local("127.0.0.1")
    assert is_local("::1")
    assert not is_local("0.0.0.0")
    assert not is_local("example.org")


def test_a_port_that_is_taken_gives_the_next_one(page):
    with listening_socket("localhost", 0) as taken:
        port = taken.getsockname()[1]
        view = mlt.view(tiny.scene(), port=port)
        with view:
            assert view.port > port
    with pytest.raises(mlt.UsageError, match="no host"):
        mlt.view(tiny.scene(), host="no.such.host.invalid", token="x")
    with pytest.raises(mlt.UsageError, match="65535"):
        mlt.view(tiny.scene(), port=70000)
    with pytest.raises(mlt.UsageError, match="port"):
        mlt.view(tiny.scene(), port=-1)


def test_a_server_that_would_not_be_behind_the_gate_is_stopped(monkeypatch):
    before = listeners()
    monkeypatch.setenv("_VISER_PORT_OVERRIDE", "0")
    with pytest.raises(mlt.UsageError, match="_VISER_PORT_OVERRIDE"):
        mlt.view(tiny.scene(), port=0)
    assert listeners() == before
