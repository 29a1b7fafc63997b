# SPDX-License-Identifier: LGPL-2.1-or-later
"""A headless Chromium that is driven through chromedriver's HTTP interface (W3C WebDriver)."""

from __future__ import annotations

import base64
import io
import json
import shutil
import socket
import subprocess
import time
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

OPTIONS = [
    "--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--window-size=900,700",
    "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
]  # fmt: skip


class Browser:
    """One session; `url` is that of the driver."""

    def __init__(self, url: str, binary: str) -> None:
        self._url = url
        wanted = {
            "goog:chromeOptions": {"binary": binary, "args": OPTIONS},
            "goog:loggingPrefs": {"performance": "ALL", "browser": "ALL"},
        }
        made = self._send("POST", "/session", {"capabilities": {"alwaysMatch": wanted}})
        self._url += f"/session/{made['sessionId']}"

    def _send(self, method: str, path: str, body: dict[str, Any] | None = None) -> Any:
        data = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request(
            self._url + path, data, {"Content-Type": "application/json"}, method=method
        )
        with urllib.request.urlopen(request, timeout=120) as answer:
            return json.load(answer)["value"]

    def open(self, file: Path) -> None:
        """Load a local page."""
        self._send("POST", "/url", {"url": file.as_uri()})

    def run(self, script: str) -> Any:
        """Run JavaScript in the page; it may return a value."""
        return self._send("POST", "/execute/sync", {"script": script, "args": []})

    def canvas(self) -> np.ndarray:
        """Return what the canvas shows, (height, width, 4) uint8, two frames from now."""
        text = self._send(
            "POST",
            "/execute/async",
            {
                "script": "const done = arguments[0]; requestAnimationFrame(() => "
                "requestAnimationFrame(() => done(document.getElementById('view').toDataURL())))",
                "args": [],
            },
        )
        return np.asarray(Image.open(io.BytesIO(base64.b64decode(text.split(",")[1]))))

    def logs(self, kind: str) -> list[dict[str, Any]]:
        """Return the driver's log entries since the last call."""
        entries: list[dict[str, Any]] = self._send("POST", "/se/log", {"type": kind})
        return entries

    def requests(self) -> list[str]:
        """Return the addresses of all requests since the last call."""
        events = [json.loads(entry["message"])["message"] for entry in self.logs("performance")]
        return [
            str(event["params"]["request"]["url"])
            for event in events
            if event["method"] == "Network.requestWillBeSent"
        ]

    def quit(self) -> None:
        """End the session."""
        self._send("DELETE", "")


@contextmanager
def chromium() -> Iterator[Browser]:
    """Start chromedriver and a browser, and end both."""
    driver, binary = shutil.which("chromedriver"), shutil.which("chromium")
    assert driver and binary, "tools/install_debian.sh installs chromium and chromedriver"
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    process = subprocess.Popen(
        [driver, f"--port={port}"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    )
    try:
        _wait(port)
        browser = Browser(f"http://127.0.0.1:{port}", binary)
        try:
            yield browser
        finally:
            browser.quit()
    finally:
        process.terminate()
        process.wait(timeout=30)


def _wait(port: int) -> None:
    for _ in range(300):
        try:
            socket.create_connection(("127.0.0.1", port), timeout=1).close()
            return
        except OSError:
            time.sleep(0.1)
    raise TimeoutError("chromedriver does not answer")
