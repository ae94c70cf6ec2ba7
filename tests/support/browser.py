"""A headless Chromium that is told what to do through its DevTools protocol."""

import asyncio
import base64
import contextlib
import io
import itertools
import json
import shutil
import subprocess
import time

import numpy as np
import pytest
from PIL import Image
from tornado.websocket import websocket_connect

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")
# Drawing in software; no sandbox, as in a container.
OPTIONS = (
    "--headless=new",
    "--no-sandbox",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--no-first-run",
    "--remote-debugging-port=0",
)
_PATIENCE = 60.0


def browser_program():
    """The browser there is; the test is skipped without one."""
    program = next(filter(None, map(shutil.which, BROWSERS)), None)
    if program is None:
        pytest.skip(f"no browser: none of {', '.join(BROWSERS)} is installed")
    return program


class Page:
    """A page that is open: what it evaluates, and what it complains about."""

    def __init__(self, connection):
        self.connection, self.numbers = connection, itertools.count(1)
        self.complaints, self.requests = [], []

    async def send(self, method, **parameters):
        """The answer to a message; what arrives meanwhile is kept."""
        number = next(self.numbers)
        await self.connection.write_message(
            json.dumps({"id": number, "method": method, "params": parameters})
        )
        while True:
            reply = json.loads(await self.connection.read_message())
            if reply.get("id") == number:
                assert "error" not in reply, reply["error"]
                return reply["result"]
            self._keep(reply.get("method"), reply.get("params", {}))

    def _keep(self, method, event):
        if method == "Runtime.consoleAPICalled" and event["type"] in ("error", "assert"):
            self.complaints.append(str(event["args"]))
        elif method == "Runtime.exceptionThrown":
            self.complaints.append(str(event["exceptionDetails"]))
        elif method == "Log.entryAdded" and event["entry"]["level"] == "error":
            self.complaints.append(event["entry"]["text"])
        elif method == "Network.requestWillBeSent":
            self.requests.append(event["request"]["url"])

    async def evaluate(self, expression):
        """The value of an expression, or what its promise becomes."""
        answer = await self.send(
            "Runtime.evaluate", expression=expression, awaitPromise=True, returnByValue=True
        )
        assert "exceptionDetails" not in answer, answer["exceptionDetails"]
        return answer["result"].get("value")

    async def picture(self):
        """What is to be seen, (height, width, 3), once two more frames are drawn."""
        await self.evaluate(
            "new Promise(r => requestAnimationFrame(() => requestAnimationFrame(r)))"
        )
        shot = await self.send("Page.captureScreenshot", format="png")
        picture = Image.open(io.BytesIO(base64.b64decode(shot["data"]))).convert("RGB")
        return np.asarray(picture).astype(int)


def browse(address, folder, work, options=()):
    """What the coroutine ``work(page)`` returns for the page at an address, and the page."""
    return asyncio.run(_browse(browser_program(), address, folder, work, options))


async def _browse(program, address, folder, work, options):
    profile = folder / "profile"
    command = [program, *OPTIONS, *options, f"--user-data-dir={profile}", "about:blank"]
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    process = subprocess.Popen(command, **quiet)
    try:
        connection = await websocket_connect(await _socket(profile), max_message_size=1 << 28)
        page = Page(connection)
        for domain in ("Runtime", "Log", "Network", "Page"):
            await page.send(f"{domain}.enable")
        await page.send("Page.navigate", url=address)
        await page.evaluate("document.readyState === 'complete' || new Promise(r => onload = r)")
        result = await asyncio.wait_for(work(page), _PATIENCE)
        connection.close()
        return result, page
    finally:
        process.terminate()
        process.wait(30)


async def _socket(profile):
    """The address of the first page of a browser that has just been started."""
    from tornado.httpclient import AsyncHTTPClient

    told, end = profile / "DevToolsActivePort", time.monotonic() + _PATIENCE
    while time.monotonic() < end:
        with contextlib.suppress(OSError, ValueError):
            port = int(told.read_text().splitlines()[0])
            answer = await AsyncHTTPClient().fetch(f"http://127.0.0.1:{port}/json/list")
            pages = [p for p in json.loads(answer.body) if p["type"] == "page"]
            if pages:
                return pages[0]["webSocketDebuggerUrl"]
        await asyncio.sleep(0.05)
    raise TimeoutError("the browser has opened no page")
