"""Who may ask the server: right name, own origin, token; how much; and what a session lasts."""

from __future__ import annotations

from dataclasses import replace

import pytest

from heeltoe.app.sessions import Sessions
from heeltoe.app.settings import Settings

pytest.importorskip("starlette")

from starlette.testclient import TestClient
from starlette.websockets import WebSocketDisconnect

from heeltoe.app.server import application
from shared.app import HEADERS, HOME, client_of


@pytest.fixture
def settings(tmp_path):
    return Settings("127.0.0.1", 8642, tmp_path)


@pytest.fixture(scope="module")
def ask(tmp_path_factory):
    with client_of(Settings("127.0.0.1", 8642, tmp_path_factory.mktemp("app")), follow_redirects=False) as client:
        yield client


@pytest.mark.parametrize("host", ["127.0.0.1:8642", "localhost:8642", "[::1]:8642"])
def test_own_names(ask, host):
    assert ask.get("/", headers={"host": host}).status_code == 200


@pytest.mark.parametrize(
    "host", ["evil.example:8642", "127.0.0.1", "127.0.0.1:80", "", "evil.example", "192.0.2.7:8642"]
)
def test_foreign_names_are_refused(ask, host):
    assert ask.get("/", headers={"host": host}).status_code == 403
    with (
        pytest.raises(WebSocketDisconnect),
        ask.websocket_connect("/talk", headers={"host": host, "origin": f"http://{host}"}),
    ):
        pass


@pytest.mark.parametrize("origin", ["http://evil.example", "http://127.0.0.1:1", "https://127.0.0.1:8642", "null"])
def test_foreign_origins_are_refused(ask, origin):
    assert ask.get("/", headers={"origin": origin}).status_code == 403
    assert ask.post("/upload", headers={"origin": origin}, content=b"1").status_code == 403
    with pytest.raises(WebSocketDisconnect), ask.websocket_connect("/talk", headers={"origin": origin}):
        pass


def test_a_conversation_says_where_it_comes_from(ask):
    with pytest.raises(WebSocketDisconnect), ask.websocket_connect("/talk"):
        pass
    with ask.websocket_connect("/talk", headers=HEADERS) as tab:
        assert tab.receive_json()["of"] == "hello"
        assert tab.receive_json()["case"]["title"] == "Typical dam cracked at its base"


def test_every_answer_says_what_a_browser_may_do_with_it(ask):
    for path in ("/", "/page/main.js", "/plotly.js", "/player/player.js", "/nothing"):
        policy = ask.get(path).headers["content-security-policy"]
        assert "script-src 'self';" in policy
        assert "default-src 'self'" in policy


@pytest.mark.parametrize(
    "path",
    [
        "/page/../server.py",
        "/page/%2e%2e/server.py",
        "/page/..%2fserver.py",
        "/page//etc/passwd",
        "/player/..%2fwrite.py",
    ],
)
def test_nothing_else_is_read(ask, path):
    assert ask.get(path).status_code == 404


@pytest.fixture(params=["127.0.0.1", "0.0.0.0"])
def stranger(request, tmp_path):
    """Somebody else on this machine, or on another one: what asks without the token, and the settings of the app."""
    settings = Settings(request.param, 8642, tmp_path, token="secret")
    home = HOME if request.param == "127.0.0.1" else "http://192.0.2.7:8642"
    with TestClient(application(settings), base_url=home, follow_redirects=False) as client:
        client.headers |= {"origin": home, "host": home.removeprefix("http://")}
        yield client, settings


def folders_of_tabs(settings):
    """Return what a tab would have left; what the server makes to be ready is none of a tab."""
    return [path for path in settings.folder.iterdir() if not path.name.startswith("warm-")]


ASKED = ["/", "/talk", "/upload", "/plotly.js", "/page/main.js", "/player/player.js", "/download/x", "/nothing"]


@pytest.mark.parametrize("method", ["GET", "HEAD", "POST", "PUT", "DELETE", "OPTIONS"])
def test_nothing_is_answered_without_the_token(stranger, method):
    client, settings = stranger
    for path in ASKED:
        for cookie in ("", f"{settings.cookie}=wrong", f"{settings.cookie}=", "heeltoe-1=secret"):
            for query in ("", "?token=", "?token=wrong", "?token=s\u00e9cret"):
                reply = client.request(method, f"{path}{query}", headers={"cookie": cookie})
                assert (reply.status_code, "token" in reply.text) == (403, method != "HEAD"), (path, cookie, query)
        if method != "GET":
            assert client.request(method, f"{path}?token=secret").status_code == 403
    assert folders_of_tabs(settings) == []


@pytest.mark.parametrize("query", ["", "?token=", "?token=wrong", "?token=secret"])
def test_no_tab_is_taken_without_the_cookie(stranger, query):
    client, settings = stranger
    with client.websocket_connect(f"/talk{query}") as socket, pytest.raises(WebSocketDisconnect) as closed:
        socket.receive_json()
    # The page of an app that has been started again says so.
    assert closed.value.code == 1008
    assert "address that heeltoe app has printed" in closed.value.reason
    assert folders_of_tabs(settings) == []


def test_the_address_brings_the_token_and_a_cookie_keeps_it(stranger):
    client, settings = stranger
    reply = client.get("/?token=secret")
    assert (reply.status_code, reply.headers["location"]) == (303, "/")
    assert reply.headers["set-cookie"] == "heeltoe-8642=secret; HttpOnly; Path=/; SameSite=lax"
    # Other servers of this machine have cookies in the same browser, and not all write them well.
    client.cookies.clear()
    client.headers["cookie"] = f'_xsrf=2|a|b; username="2|1:0|x"; strange[1]=; {settings.cookie}=secret'
    assert client.get("/").status_code == 200
    with client.websocket_connect("/talk") as tab:
        assert tab.receive_json()["of"] == "hello"
    assert client.get("/", headers={"host": "evil.example:8642"}).status_code == 403


def test_every_app_has_a_token_of_its_own(tmp_path):
    one, other = (Settings("127.0.0.1", 8642, tmp_path) for _ in range(2))
    assert one.token != other.token
    assert len(one.token) == 32


def enter(ask):
    return ask.websocket_connect("/talk", headers=HEADERS)


def test_uploads_are_few_and_small(tmp_path):
    small = Settings("127.0.0.1", 8642, tmp_path, largest_upload=10, most_uploads=2)
    with client_of(small) as ask, enter(ask) as tab:
        headers = {"origin": HOME, "x-session": tab.receive_json()["session"]}
        assert ask.post("/upload", content=b"12345678901", headers=headers).status_code == 413
        name = ask.post("/upload?name=../../evil.py", content=b"1234", headers=headers).json()["name"]
        assert [path.name for path in tmp_path.rglob("*") if path.is_file()] == [name]
        assert ask.post("/upload", content=b"1", headers=headers).status_code == 200
        assert ask.post("/upload", content=b"1", headers=headers).status_code == 413
        assert ask.post("/upload", content=b"1", headers={**headers, "x-session": "guessed"}).status_code == 403


@pytest.mark.parametrize(
    "message",
    ["", "{", "[]", "1", '{"do": 1}',
     '{"do": "__class__"}', '{"do": "rigid"}', '{"do": "rigid", "values": {"title": 1}}',
     '{"do": "rigid", "values": {"crack.friction": "1"}}', '{"do": "rigid", "values": {"crack.friction": NaN}}',
     '{"do": "open example", "name": "../../secret"}', '{"do": "cancel", "number": 7}', '{"do": "units", "units": "x"}',
     "[" * 100_000],
)  # fmt: skip
def test_what_no_page_asks_is_told_and_the_tab_goes_on(ask, message):
    with enter(ask) as tab:
        tab.receive_json()
        tab.receive_json()
        tab.send_text(message)
        assert tab.receive_json()["of"] == "bad request"
        tab.send_json({"do": "rigid", "values": {"crack.friction": 1.2}, "serial": 5})
        answer = tab.receive_json()
        assert (answer["of"], answer["serial"], answer["ok"]) == ("rigid", 5, True)


def test_open_tabs_are_so_many_and_the_next_one_is_told(settings):
    few = replace(settings, most_open=2)
    with client_of(few) as ask, enter(ask) as one:
        name = one.receive_json()["session"]
        with enter(ask) as two:
            two.receive_json()
            with enter(ask) as three, pytest.raises(WebSocketDisconnect) as closed:
                three.receive_json()
            assert closed.value.code == 1013
            assert "2 tabs are open" in closed.value.reason
            query = f"/talk?session={name}&again="
            with ask.websocket_connect(query, headers=HEADERS) as again:
                assert again.receive_json()["session"] == name  # loaded anew, it is no other


def test_sessions_are_few_and_end(settings):
    sessions = Sessions(replace(settings, most_sessions=2))
    first = sessions.enter("")
    assert sessions.enter(first.name) is not first  # a tab that was doubled
    sessions.leave(first)
    assert sessions.enter(first.name) is first
    sessions.leave(first)
    sessions.enter("")
    assert sessions.get(first.name) is None
    assert not first.folder.exists()
    brief = Sessions(replace(settings, idle_s=-1.0))
    gone = brief.enter("")
    brief.leave(gone)
    assert brief.get(gone.name) is None
