"""The attack list: requests that the view must refuse. TOKEN, PORT and SECRET stand for the server's own values.

SECRET is the path of a file with a word in it that no answer may hold.
"""

# ruff: noqa: E501  # one request a line
HOST = "Host: 127.0.0.1:PORT"
ORIGIN = "Origin: http://127.0.0.1:PORT"
SOCKET = (
    "Upgrade: websocket",
    "Connection: Upgrade",
    "Sec-WebSocket-Version: 13",
    "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==",
)


def get(path, *headers, method="GET", version="HTTP/1.1", body=""):
    """A request as text."""
    return "\r\n".join([f"{method} {path} {version}", *headers, "", body])


WALKS = (
    "/TOKEN/../../../../../../etc/passwd", "/TOKEN/..%2f..%2f..%2f..%2fetc%2fpasswd", "/TOKEN/%2e%2e/%2e%2e/%2e%2e/etc/passwd",
    "/TOKEN/%252e%252e/%252e%252e/etc/passwd", "/TOKEN/..%5c..%5c..%5cetc%5cpasswd", "/TOKEN/..\\..\\..\\etc\\passwd",
    "/TOKEN/%c0%ae%c0%ae/%c0%ae%c0%ae/etc/passwd", "/TOKEN/....//....//etc/passwd", "/TOKEN/.%00./etc/passwd",
    "/TOKEN//etc/passwd", "/TOKEN/%2fetc%2fpasswd", "//etc/passwd", "/etc/passwd", "/../etc/passwd", "/SECRET", "/TOKEN/SECRET",
    "/TOKEN/file:///etc/passwd", "/TOKEN/index.html%00.png", "/TOKEN/./index.html", "/TOKEN/index.html",
    "/TOKEN/..;/..;/etc/passwd", "/TOKEN/%uff0e%uff0e/etc/passwd", "/TOKEN/\u2025/etc/passwd", "/TOKEN/~root/.bashrc",
    "/TOKEN/C:\\Windows\\win.ini", "/TOKEN/proc/self/environ",
)  # fmt: skip

ATTACKS = {
    **{f"walk {path}": get(path, HOST) for path in WALKS},
    "no token": get("/", HOST),
    "empty token": get("//", HOST),
    "another token": get("/AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA/", HOST),
    "token cut short": get("/TOKEN/", HOST).replace("TOKEN", "TOKEN-1"),
    "token in capitals": get("/UPPER/", HOST),
    "token encoded": get("/ENCODED/", HOST),
    "token in the query": get("/?token=TOKEN", HOST),
    "token in a cookie": get("/", HOST, "Cookie: token=TOKEN"),
    "token in a header": get("/", HOST, "Authorization: Bearer TOKEN"),
    "token after the query": get("/?/TOKEN/", HOST),
    "token in the fragment": get("/#/TOKEN/", HOST),
    "host of another site": get("/TOKEN/", "Host: evil.example"),
    "rebound host with our port": get("/TOKEN/", "Host: evil.example:PORT"),
    "host that begins like ours": get("/TOKEN/", "Host: 127.0.0.1.evil.example:PORT"),
    "host that ends like ours": get("/TOKEN/", "Host: evil.localhost:PORT"),
    "host with a user": get("/TOKEN/", "Host: evil@127.0.0.1:PORT"),
    "host without a port": get("/TOKEN/", "Host: 127.0.0.1"),
    "host with another port": get("/TOKEN/", "Host: 127.0.0.1:1"),
    "host as one number": get("/TOKEN/", "Host: 2130706433:PORT"),
    "host as zero": get("/TOKEN/", "Host: 0.0.0.0:PORT"),
    "host with a dot": get("/TOKEN/", "Host: localhost.:PORT"),
    "no host": get("/TOKEN/"),
    "two hosts": get("/TOKEN/", HOST, "Host: evil.example"),
    "forwarded host": get("/TOKEN/", "Host: evil.example", "X-Forwarded-Host: 127.0.0.1:PORT"),
    "whole address": get("http://127.0.0.1:PORT/TOKEN/", HOST),
    "whole address of another site": get("http://evil.example/TOKEN/", HOST),
    "file address": get("file:///etc/passwd", HOST),
    "asterisk": get("*", HOST),
    "origin of another site": get("/TOKEN/", HOST, "Origin: http://evil.example"),
    "origin null": get("/TOKEN/", HOST, "Origin: null"),
    "origin of a file": get("/TOKEN/", HOST, "Origin: file://"),
    "origin with another port": get("/TOKEN/", HOST, "Origin: http://127.0.0.1:1"),
    "origin over https": get("/TOKEN/", HOST, "Origin: https://127.0.0.1:PORT"),
    "two origins": get("/TOKEN/", HOST, ORIGIN, "Origin: http://evil.example"),
    "in a frame": get("/TOKEN/", HOST, "Sec-Fetch-Site: cross-site", "Sec-Fetch-Mode: navigate", "Sec-Fetch-Dest: iframe"),
    "as a script": get("/TOKEN/", HOST, "Sec-Fetch-Site: cross-site", "Sec-Fetch-Mode: no-cors", "Sec-Fetch-Dest: script"),
    "socket without origin": get("/TOKEN", HOST, *SOCKET),
    "socket with origin null": get("/TOKEN", HOST, *SOCKET, "Origin: null"),
    "socket of a file": get("/TOKEN", HOST, *SOCKET, "Origin: file://"),
    "socket of another site": get("/TOKEN", HOST, *SOCKET, "Origin: http://evil.example"),
    "socket of another port": get("/TOKEN", HOST, *SOCKET, "Origin: http://127.0.0.1:1"),
    "socket of localhost under a number": get("/TOKEN", HOST, *SOCKET, "Origin: http://localhost:PORT"),
    "socket without token": get("/", HOST, *SOCKET, ORIGIN),
    "socket with another token": get("/AAAAAAAA", HOST, *SOCKET, ORIGIN),
    "socket with the token in the query": get("/?TOKEN", HOST, *SOCKET, ORIGIN),
    "socket of a rebound host": get("/TOKEN", "Host: evil.example:PORT", *SOCKET, "Origin: http://evil.example:PORT"),
    "socket of two origins": get("/TOKEN", HOST, *SOCKET, ORIGIN, "Origin: http://evil.example"),
    "another protocol": get("/TOKEN", HOST, "Upgrade: h2c", "Connection: Upgrade", "HTTP2-Settings: AAMAAABkAAQAAP__"),
    "post": get("/TOKEN/", HOST, ORIGIN, "Content-Length: 2", method="POST", body="{}"),
    "put": get("/TOKEN/", HOST, "Content-Length: 2", method="PUT", body="{}"),
    "delete": get("/TOKEN/", HOST, method="DELETE"),
    "options": get("/TOKEN/", HOST, "Origin: http://evil.example", "Access-Control-Request-Method: GET", method="OPTIONS"),
    "trace": get("/TOKEN/", HOST, method="TRACE"),
    "connect": get("evil.example:443", HOST, method="CONNECT"),
    "get in small letters": get("/TOKEN/", HOST, method="get"),
    "old http": get("/TOKEN/", HOST, version="HTTP/1.0"),
    "no version": "GET /TOKEN/\r\n\r\n",
    "a long header": get("/TOKEN/", HOST, f"X-Long: {'a' * 100_000}"),
    "many headers": get("/TOKEN/", HOST, *(f"X-{k}: a" for k in range(1000))),
    "a long path": get(f"/TOKEN/{'a/' * 50_000}", HOST),
    "a folded header": get("/TOKEN/", HOST, "X-Folded: a", " b"),
    "chunks": get("/TOKEN/", HOST, "Transfer-Encoding: chunked", body="0\r\n\r\n"),
    "smuggled": get("/TOKEN/", HOST, "Content-Length: 44", "Transfer-Encoding: chunked", body="0\r\n\r\nGET /etc/passwd HTTP/1.1\r\n\r\n"),
    "not http": "\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03 /etc/passwd\r\n\r\n",
}  # fmt: skip
