# SPDX-License-Identifier: BSD-3-Clause
"""Headless Chromium over the WebDriver protocol, with nothing but the standard library."""
import base64
import json
import re
import subprocess
import urllib.error
import urllib.request

ELEMENT = "element-6066-11e4-a52e-4f735466cecf"  # as the protocol names a reference to one


class Browser:
    """A window. Ends with the `with` that it is made in."""

    def __init__(self, options=(), width=1400, height=1000):
        self.driver = subprocess.Popen(["chromedriver", "--port=0"], stdout=subprocess.PIPE,
                                       stderr=subprocess.DEVNULL, text=True)
        self.session = None
        for line in self.driver.stdout:
            started = re.search(r"started successfully on port (\d+)", line)
            if started:
                break
        else:
            raise RuntimeError("chromedriver does not start")
        self.address = f"http://127.0.0.1:{started[1]}"
        arguments = ["--headless=new", "--no-sandbox", "--disable-dev-shm-usage",
                     f"--window-size={width},{height}", *options]
        asked = {"alwaysMatch": {"browserName": "chrome",
                                 "goog:chromeOptions": {"args": arguments},
                                 "goog:loggingPrefs": {"browser": "ALL"}}}
        self.session = self.post("/session", {"capabilities": asked})["sessionId"]
        self.address += f"/session/{self.session}"

    def __enter__(self):
        return self

    def __exit__(self, *_):
        try:
            self.ask("DELETE", "")
        finally:
            self.driver.terminate()
            self.driver.wait()

    def ask(self, method, path, body=None):
        data = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request(self.address + path, data, method=method)
        request.add_header("Content-Type", "application/json")
        try:
            with urllib.request.urlopen(request, timeout=120) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as error:
            raise RuntimeError(json.load(error)["value"]["message"]) from None

    def post(self, path, body):
        return self.ask("POST", path, body)

    def open(self, address):
        self.post("/url", {"url": address})

    def run(self, script, *arguments):
        """What a JavaScript function body returns."""
        return self.post("/execute/sync", {"script": script, "args": list(arguments)})

    def find(self, css):
        return self.post("/element", {"using": "css selector", "value": css})[ELEMENT]

    def count(self, css):
        return self.run("return document.querySelectorAll(arguments[0]).length", css)

    def click(self, css):
        self.post(f"/element/{self.find(css)}/click", {})

    def type(self, css, text):
        self.post(f"/element/{self.find(css)}/value", {"text": text})

    def text(self, css):
        return self.ask("GET", f"/element/{self.find(css)}/text")

    def picture(self, css=None):
        """PNG of an element, or the window."""
        place = f"/element/{self.find(css)}/screenshot" if css else "/screenshot"
        return base64.b64decode(self.ask("GET", place))

    def drag(self, css, x, y):
        """From the middle of an element by so many pixels."""
        origin = {ELEMENT: self.find(css)}
        move = {"type": "pointerMove", "duration": 0, "x": 0, "y": 0, "origin": origin}
        moves = [{"type": "pointerMove", "duration": 50, "x": x * i // 4, "y": y * i // 4,
                  "origin": origin} for i in range(1, 5)]
        self.point([move, {"type": "pointerDown", "button": 0}, *moves,
                    {"type": "pointerUp", "button": 0}])

    def point(self, steps):
        """What the mouse does."""
        self.post("/actions", {"actions": [
            {"type": "pointer", "id": "mouse", "parameters": {"pointerType": "mouse"},
             "actions": steps}]})

    def rest(self):
        """The mouse in the window's corner, where it points to nothing."""
        self.point([{"type": "pointerMove", "duration": 0, "x": 1, "y": 1, "origin": "viewport"}])

    def complaints(self):
        """Errors and warnings on the console since the last call."""
        return [entry["message"] for entry in self.post("/se/log", {"type": "browser"})
                if entry["level"] in ("SEVERE", "WARNING")]
