"""The server of the workbench: what the page asks for, answered from the folder; started on a free port of the loopback."""

import asyncio
import contextlib
import importlib
import json
import socket
import threading
import time
import traceback
from collections.abc import AsyncIterator, Awaitable, Callable
from pathlib import Path
from typing import Any

import uvicorn
from starlette.applications import Starlette
from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import FileResponse, HTMLResponse, JSONResponse, Response, StreamingResponse
from starlette.routing import Mount, Route
from starlette.staticfiles import StaticFiles

import pages
from fmu_src.faults import InputFault, RunFault
from reducers.library import available
from workbench import jobs
from workbench.folder import Folder
from workbench.guard import REPORT_POLICY, Guard, new_token
from workbench.page_words import on_page

STATIC = Path(__file__).with_name("static")
# A dropped file [bytes]: as much as the readers take.
MOST_UPLOADED = 2_000_000_000
# How often a change is looked for, and how long at most a page hears nothing [s].
LOOK, SILENCE = 0.35, 15.0
HIGHEST_PORT = 65535

Handler = Callable[[Request], Awaitable[Response]]


class Workbench:
    """The answers; ``cores`` for what is computed."""

    def __init__(self, folder: Folder, cores: int):
        self.folder, self.cores = folder, cores
        self.trial: Any = None
        self.ending = False

    def routes(self) -> list[Route | Mount]:
        get, post = ["GET"], ["POST"]
        return [
            Route("/", self.index), Route("/events", self.events), Route("/plotly.js", self.plotly), Route("/narrow.js", self.narrow),
            Route("/in", said(self.intake), methods=get), Route("/in/choices", said(self.choices), methods=get),
            Route("/in/wishes", said(self.wish), methods=post), Route("/in/save", said(self.save), methods=post),
            Route("/in/scales", said(self.scales), methods=get),
            Route("/in/edit", said(self.edit), methods=post), Route("/in/mend", said(self.mend), methods=post),
            Route("/files/{name:path}", said(self.upload), methods=["PUT"]), Route("/files/{name:path}", said(self.remove), methods=["DELETE"]),
            Route("/state", said(self.state), methods=get), Route("/state", said(self.set_state), methods=post),
            Route("/jobs/{kind}", said(self.start), methods=post), Route("/jobs/{kind}/stop", said(self.stop), methods=post),
            Route("/results/{kind}", said(self.result), methods=get), Route("/results/{kind}/live", said(self.live), methods=get),
            Route("/results/{kind}/columns", said(self.columns), methods=get),
            Route("/results/{kind}/report", said(self.report), methods=get),
            Route("/try", said(self.controls), methods=post), Route("/try/curve", said(self.curve), methods=post),
            Route("/try/everywhere", said(self.everywhere), methods=post),
            Route("/reducer", said(self.reducer), methods=post), Route("/reducer/new", said(self.new_reducer), methods=post),
            Mount("/static", StaticFiles(directory=STATIC)),
        ]  # fmt: skip

    async def index(self, _: Request) -> Response:
        return FileResponse(STATIC / "index.html", media_type="text/html")

    async def plotly(self, _: Request) -> Response:
        """Drawn with only where a page of a result is looked at: it is large."""
        import plotly

        return FileResponse(Path(plotly.__file__).parent / "package_data" / "plotly.min.js", media_type="text/javascript",
                            headers={"cache-control": "private, max-age=86400"})  # fmt: skip

    async def narrow(self, _: Request) -> Response:
        """What fits figures of pages to a narrow card."""
        return FileResponse(Path(pages.__file__).parent / "narrow.js", media_type="text/javascript")

    # in -------------------------------------------------------------------------------------
    async def intake(self, _: Request) -> Response:
        from workbench.intake import view

        return JSONResponse(await run_in_threadpool(view, self.folder))

    async def choices(self, _: Request) -> Response:
        from workbench.intake import choices

        return JSONResponse(await run_in_threadpool(choices))

    async def scales(self, _: Request) -> Response:
        """What takes a model and some seconds, apart from what is read."""
        from workbench.scales import scales

        return JSONResponse(await run_in_threadpool(scales, self.folder))

    async def wish(self, request: Request) -> Response:
        from workbench.intake import wish

        await run_in_threadpool(wish, self.folder, await content(request))
        return await self.intake(request)

    async def save(self, request: Request) -> Response:
        from workbench.intake import save

        return JSONResponse(await run_in_threadpool(save, self.folder))

    async def edit(self, request: Request) -> Response:
        from workbench.editing import edit

        await run_in_threadpool(edit, self.folder, await content(request))
        return await self.intake(request)

    async def mend(self, request: Request) -> Response:
        from workbench.mending import mend

        await run_in_threadpool(mend, self.folder, await content(request))
        return await self.intake(request)

    async def upload(self, request: Request) -> Response:
        length = int(request.headers.get("content-length", "0"))
        if length > MOST_UPLOADED:
            raise InputFault(f"{request.path_params['name']}: {length} bytes; at most {MOST_UPLOADED} are taken")
        place = await run_in_threadpool(self.folder.new_file, request.path_params["name"], await request.body())
        return JSONResponse({"name": place.name})

    async def remove(self, request: Request) -> Response:
        """A measurement that was dropped by mistake; put aside, not deleted."""
        place = self.folder.inside(request.path_params["name"])
        if place not in [path.resolve() for path in self.folder.measurements()]:
            raise InputFault(f"{request.path_params['name']}: there is no such measurement")
        aside = self.folder.memory / "aside"
        aside.mkdir(parents=True, exist_ok=True)
        number = next(n for n in range(1, 100_000) if not (aside / f"{n}_{place.name}").exists())
        place.rename(aside / f"{number}_{place.name}")
        return JSONResponse({"aside": f".workbench/aside/{number}_{place.name}"})

    # state and jobs -------------------------------------------------------------------------
    def told(self) -> dict[str, Any]:
        """What all tabs show alike."""
        folder = self.folder
        view = folder.recall("view")
        if not view.get("model"):
            view["model"] = folder.measured()
        stamps: dict[str, str] = {}
        return {
            "folder": str(folder.root), "name": folder.root.name, "saved": folder.campaign.is_file(), "models": folder.models(), "view": view,
            "library": available(), "files": len(folder.measurements()), "jobs": {kind: jobs.status(folder, kind, stamps) for kind in jobs.KINDS},
        }  # fmt: skip

    async def state(self, _: Request) -> Response:
        return JSONResponse(await run_in_threadpool(self.told))

    async def set_state(self, request: Request) -> Response:
        """What was chosen: the model and so on, in all tabs."""
        given = await content(request)
        self.folder.remember("view", self.folder.recall("view") | given)
        return JSONResponse(await run_in_threadpool(self.told))

    async def events(self, request: Request) -> Response:
        async def lines() -> AsyncIterator[str]:
            before, last = "", time.monotonic()
            while not self.ending and not await request.is_disconnected():
                now = json.dumps(await run_in_threadpool(self.told))
                if now != before or time.monotonic() - last > SILENCE:
                    before, last = now, time.monotonic()
                    yield f"data: {now}\n\n"
                await asyncio.sleep(LOOK)

        return StreamingResponse(lines(), media_type="text/event-stream")

    async def start(self, request: Request) -> Response:
        await run_in_threadpool(jobs.start, self.folder, request.path_params["kind"], await content(request), self.cores)
        return JSONResponse(await run_in_threadpool(self.told))

    async def stop(self, request: Request) -> Response:
        await run_in_threadpool(jobs.stop, self.folder, request.path_params["kind"])
        return JSONResponse({})

    async def result(self, request: Request) -> Response:
        return JSONResponse(await run_in_threadpool(jobs.result, self.folder, request.path_params["kind"]))

    async def live(self, request: Request) -> Response:
        """What a job that runs has so far; empty if that is nothing yet."""
        place = jobs.place_of(self.folder, request.path_params["kind"])
        return JSONResponse(self.folder.recall(f"jobs/{place.name}/live"))

    async def columns(self, request: Request) -> Response:
        place = jobs.place_of(self.folder, request.path_params["kind"]) / "columns.bin"
        if not place.is_file():
            raise InputFault("there are no curves yet")
        return FileResponse(place, media_type="application/octet-stream")

    async def report(self, request: Request) -> Response:
        """The page of a result, one file that opens anywhere."""
        kind = request.path_params["kind"]
        place = jobs.place_of(self.folder, kind) / "report.html"
        if not place.is_file():
            raise InputFault("there is no page of a result yet")
        if colours := request.query_params.get("colours"):
            return HTMLResponse(await run_in_threadpool(coloured, place, colours == "dark"), headers={"content-security-policy": REPORT_POLICY})
        name = f"{self.folder.root.name}_{kind}.html" if "download" in request.query_params else None
        return FileResponse(place, media_type="text/html", filename=name, headers={"content-security-policy": REPORT_POLICY})

    # try and reducer ------------------------------------------------------------------------
    def hand(self) -> Any:
        if self.trial is None:
            from threadpoolctl import threadpool_limits

            from workbench.trying import Trial

            # Matrices are small here: on a busy machine a library's own threads take ten times as long for them.
            threadpool_limits(1, "blas")
            self.trial = Trial()
        return self.trial

    async def controls(self, request: Request) -> Response:
        given = await content(request)
        return JSONResponse(await run_in_threadpool(lambda: self.hand().controls(self.folder, str(given.get("model") or ""))))

    async def curve(self, request: Request) -> Response:
        """Words as JSON in one line, then the rows in single precision."""
        given = await content(request)
        words, rows = await run_in_threadpool(
            lambda: self.hand().curve(self.folder, str(given.get("model") or ""), str(given.get("run")), dict(given.get("values") or {}),
                                      bool(given.get("roughly")), str(given.get("beside") or "")))  # fmt: skip
        return Response(json.dumps(words | {"count": rows.shape[1]}).encode() + b"\n" + rows.astype("<f4").tobytes(), media_type="application/octet-stream")

    async def everywhere(self, request: Request) -> Response:
        given = await content(request)
        return JSONResponse(await run_in_threadpool(
            lambda: self.hand().everywhere(self.folder, str(given.get("model") or ""), dict(given.get("values") or {}))))  # fmt: skip

    async def reducer(self, request: Request) -> Response:
        from workbench.reducers import shown

        given = await content(request)
        return JSONResponse(await run_in_threadpool(shown, self.folder, str(given.get("model") or "")))

    async def new_reducer(self, request: Request) -> Response:
        from workbench.reducers import completed

        return JSONResponse(await run_in_threadpool(completed, self.folder, await content(request)))


def coloured(page: Path, dark: bool) -> str:
    """The page of a result as a screen of these colours shows it, whatever this screen is."""
    text = page.read_text(encoding="utf-8").replace("(prefers-color-scheme: dark)", "(min-width: 0px)" if dark else "(max-width: 0px)")
    return text.replace("color-scheme: light dark", f"color-scheme: {'dark' if dark else 'light'}")


def said(handler: Handler) -> Handler:
    """What is wrong with the input as an answer that the page shows."""

    async def answer(request: Request) -> Response:
        try:
            return await handler(request)
        except (InputFault, RunFault) as fault:
            return JSONResponse({"fault": on_page(str(fault))}, 409 if isinstance(fault, jobs.Taken) else 400)
        except OSError as problem:
            return JSONResponse({"fault": f"{problem}; look at the folder and its disk"}, 400)
        except Exception as problem:  # noqa: BLE001 - a fault of the program is said, and the server goes on
            traceback.print_exc()
            return JSONResponse({"fault": f"{type(problem).__name__}: {problem} (a fault of the program; the terminal has the whole of it)"}, 500)

    return answer


async def content(request: Request) -> dict[str, Any]:
    try:
        found = json.loads(await request.body() or b"{}")
    except ValueError:
        raise InputFault("what was sent is no JSON") from None
    if not isinstance(found, dict):
        raise InputFault("what was sent is no JSON object")
    return found


def app_of(bench: Workbench, token: str) -> Guard:
    return Guard(Starlette(routes=bench.routes()), token)


def serve(folder: Folder, port: int, cores: int, ready: Callable[[str], None]) -> None:
    """Until Ctrl-C; ``ready`` is told the address."""
    if not 0 <= port <= HIGHEST_PORT:
        raise InputFault(f"--port {port}: ports go from 0 (any that is free) to {HIGHEST_PORT}")
    token = new_token()
    bench = Workbench(folder, cores)
    with socket.socket() as listening:
        listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            listening.bind(("127.0.0.1", port))
        except OSError as problem:
            raise InputFault(f"--port {port}: {problem.strerror or problem}; give another one, or 0 for any that is free") from None
        config = uvicorn.Config(app_of(bench, token), log_level="error", lifespan="off", timeout_graceful_shutdown=1, ws="none", server_header=False)
        server = Server(config, bench, lambda: ready(f"http://127.0.0.1:{listening.getsockname()[1]}/{token}/"))
        with contextlib.suppress(KeyboardInterrupt):
            asyncio.run(server.serve([listening]))
        # Nobody is left who would look at it.
        jobs.stop_all(folder)


def warm() -> None:
    """What the first view reads with is large: it is loaded while the page paints."""
    importlib.import_module("workbench.intake")
    importlib.import_module("workbench.trying")


class Server(uvicorn.Server):
    """Says when it answers, and lets pages that listen go when it ends."""

    def __init__(self, config: uvicorn.Config, bench: Workbench, ready: Callable[[], None]):
        super().__init__(config)
        self.bench, self.ready = bench, ready

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        await super().startup(sockets)
        self.ready()
        threading.Thread(target=warm, daemon=True).start()

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        self.bench.ending = True
        await super().shutdown(sockets)
