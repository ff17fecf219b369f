"""The two live pages: a frame of HTML around the bundle, and a plain page where the bundle has no live page.

Scripts and styles come from this server alone; a content security policy forbids every other address.
"""

from __future__ import annotations

import html
from importlib.resources import files

__all__ = ["HEADERS", "build_live_page", "make_policy", "read_bundle"]

HEADERS = {
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Cache-Control": "no-store",
}
"""Of every answer: the token in the address goes nowhere, nothing is kept, and no page from elsewhere frames ours."""

_PAGE = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title}</title>
<link rel="icon" href="data:,">
<link rel="stylesheet" href="/live.css">
</head>
<body data-role="{role}">
<script src="/live.js"></script>
</body>
</html>
"""

_PLAIN_SCRIPT = """
const query = new URLSearchParams(location.search);
const role = document.body.dataset.role;
const shown = document.body.appendChild(document.createElement("pre"));
const socket = new WebSocket(`ws://${location.host}/ws?token=${query.get("token")}&role=${role}`);
socket.onmessage = ({ data }) => {
  const message = JSON.parse(data);
  if (message.type === "state") shown.textContent = JSON.stringify(message, null, 1);
};
"""


def make_policy(host: str) -> str:
    """The content security policy of a live page that was asked for at `host`."""
    return (
        "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; "
        f"media-src 'self' data: blob:; connect-src 'self' blob: ws://{host} wss://{host}; worker-src 'self' blob:; "
        "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
    )


def build_live_page(title: str, role: str) -> str:
    """The page of the bridge or of the instructor."""
    return _PAGE.format(title=html.escape(title), role=html.escape(role))


def read_bundle(name: str) -> str:
    """live.js or live.css of the bundle; a plain stand-in where the bundle has none."""
    file = files("shipcollision_fmu.show.page") / "bundle" / name
    if file.is_file():
        return file.read_text(encoding="utf-8")
    return _PLAIN_SCRIPT if name.endswith(".js") else ""
