"""The application of a live run: its pages, its scene, and its WebSocket.

    /?token=              the bridge                /scene.glb?token=      the ships
    /instructor?token=    the instructor            /replay.html?token=    the run, once it has ended
    /ws?token=&role=      the WebSocket             /live.js, /live.css    the bundle, which is no secret

No path of a request is looked for on the disk.
"""

from __future__ import annotations

import socket
from typing import Any

from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import PlainTextResponse, Response
from starlette.routing import Route, WebSocketRoute
from starlette.websockets import WebSocket

from ... import __version__
from ...scenario.tables.environment import MAXIMUM_CURRENT, MAXIMUM_WIND
from ..session.pacer import FASTEST, SLOWEST
from ..session.session import Session
from .access import Tokens, is_own_origin
from .hub import MOST_CLIENTS, Hub
from .messages import ROLES
from .outline import describe_obstacles
from .pages import HEADERS, build_live_page, make_policy, read_bundle
from .scene import build_live_scene, describe_ships, write_glb

__all__ = ["LiveApp"]

DENIED = "the token is missing or wrong: take the address that `shipcollision live` has printed\n"


class LiveApp:
    """The application for a session; `own` is the ship of the bridge. `asgi` is what a server runs."""

    def __init__(
        self, session: Session, own: str, *, tokens: Tokens | None = None, host: str = "127.0.0.1",
        sets_pace: bool = True, **limits: Any,
    ) -> None:  # fmt: skip
        self.session, self.tokens = session, tokens or Tokens()
        scenario, ships = session.scenario, session.run.ships
        scene = build_live_scene(scenario, ships)
        hello = {
            "version": __version__, "scenario": scenario.name, "description": scenario.scenario.description,
            "own": own, "ships": describe_ships(scenario, ships, scene), "step": scenario.step, "scene": "/scene.glb",
            "origin": scene.origin.tolist(), "rates": [SLOWEST, FASTEST], "sets_pace": sets_pace,
            "obstacles": describe_obstacles(scene),
            "environment_limits": {"wind": MAXIMUM_WIND, "current": MAXIMUM_CURRENT},
        }  # fmt: skip
        self._title, self._glb = f"{scenario.name}, live", write_glb(scene)
        self._names = frozenset({"localhost", host.lower(), socket.gethostname().lower()})
        self.hub = Hub(session, hello, sets_pace=sets_pace, **limits)
        self.asgi = Starlette(
            routes=[
                Route("/", self._bridge), Route("/instructor", self._instructor), Route("/scene.glb", self._scene),
                Route("/replay.html", self._replay), Route("/live.js", self._script), Route("/live.css", self._style),
                WebSocketRoute("/ws", self._socket),
            ]
        )  # fmt: skip

    async def _bridge(self, request: Request) -> Response:
        return self._page(request, "bridge")

    async def _instructor(self, request: Request) -> Response:
        return self._page(request, "instructor")

    def _page(self, request: Request, role: str) -> Response:
        if not self._admits(request, role):
            return _deny()
        policy = make_policy(request.headers.get("host", ""))
        page = build_live_page(self._title, role)
        return Response(page, media_type="text/html", headers={**HEADERS, "Content-Security-Policy": policy})

    async def _scene(self, request: Request) -> Response:
        if not self._admits(request, "bridge"):
            return _deny()
        return Response(self._glb, media_type="model/gltf-binary", headers=HEADERS)

    async def _replay(self, request: Request) -> Response:
        if not self._admits(request, "bridge"):
            return _deny()
        page = self.session.page
        if page is None:
            why = "the run has not ended" if self.session.snapshot.running else "none was written"
            return PlainTextResponse(f"there is no replay: {why}\n", 404, HEADERS)
        return Response(page.read_bytes(), media_type="text/html", headers=HEADERS)

    async def _script(self, request: Request) -> Response:
        return Response(read_bundle("live.js"), media_type="text/javascript", headers=HEADERS)

    async def _style(self, request: Request) -> Response:
        return Response(read_bundle("live.css"), media_type="text/css", headers=HEADERS)

    async def _socket(self, socket: WebSocket) -> None:
        role = socket.query_params.get("role", "bridge")
        origin, host = socket.headers.get("origin"), socket.headers.get("host", "")
        allowed = role in ROLES and self.tokens.admits(socket.query_params.get("token", ""), role)
        if not allowed or not is_own_origin(origin, host, self._names) or self.hub.clients >= MOST_CLIENTS:
            await socket.close(1008)
            return
        await self.hub.serve(socket, role)

    def _admits(self, request: Request, role: str) -> bool:
        return self.tokens.admits(request.query_params.get("token", ""), role)


def _deny() -> Response:
    return PlainTextResponse(DENIED, 403, HEADERS)
