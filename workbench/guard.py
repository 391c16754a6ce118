"""Who is let in: pages of this machine that know the token, and nobody else."""

import hmac
import secrets
from urllib.parse import urlsplit

from starlette.responses import PlainTextResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

# Scripts, styles and pictures come from here alone; nothing may be fetched from elsewhere, and nobody may frame the page.
POLICY = (
    "default-src 'self'; img-src 'self' data: blob:; style-src 'self' 'unsafe-inline'; connect-src 'self'; object-src 'none'; base-uri 'none';"
    " form-action 'none'; frame-ancestors 'self'"
)
# A page of a result is one file with its script inside; it may fetch nothing at all.
REPORT_POLICY = "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; font-src data:; frame-ancestors 'self'"
HEADERS = ((b"referrer-policy", b"no-referrer"), (b"x-content-type-options", b"nosniff"), (b"cross-origin-resource-policy", b"same-origin"))
# Names of this machine.
LOOPBACK = ("127.0.0.1", "localhost", "[::1]")
CHANGING = ("POST", "PUT", "DELETE", "PATCH")


def new_token() -> str:
    return secrets.token_urlsafe(24)


class Guard:
    """Lets requests through whose path begins with the token, and takes it off; 404 for all others.

    The address must be one of this machine (no name that another site lets point here), and what changes something must come from a page
    of this server.
    """

    def __init__(self, app: ASGIApp, token: str):
        self.app, self.token = app, token

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            await self.app(scope, receive, send)
            return
        headers = {name.lower(): value.decode("latin-1") for name, value in scope["headers"]}
        host = headers.get(b"host", "")
        if host.rpartition(":")[0] not in LOOPBACK:
            await PlainTextResponse("this server answers to addresses of this machine alone", 403)(scope, receive, send)
            return
        origin = headers.get(b"origin")
        # A sandboxed page has the origin "null" and changes nothing.
        if scope["method"] in CHANGING and (origin is None or urlsplit(origin).netloc != host):
            await PlainTextResponse("what changes something must come from a page of this server", 403)(scope, receive, send)
            return
        first, _, rest = scope["path"].removeprefix("/").partition("/")
        if not hmac.compare_digest(first.encode("utf-8", "replace"), self.token.encode()):
            await PlainTextResponse("not found: open the address that rvwear workbench prints", 404)(scope, receive, send)
            return
        inner = dict(scope, path=f"/{rest}", raw_path=f"/{rest}".encode(), root_path="")

        async def sent(message: Message) -> None:
            if message["type"] == "http.response.start":
                have = {name.lower() for name, _ in message["headers"]}
                policy = () if b"content-security-policy" in have else ((b"content-security-policy", POLICY.encode()),)
                cached = () if b"cache-control" in have else ((b"cache-control", b"no-store"),)
                message["headers"] = [*message["headers"], *HEADERS, *policy, *cached]
            await send(message)

        await self.app(inner, receive, sent)
