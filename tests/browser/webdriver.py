"""A browser that is told what to do over W3C's WebDriver: Chromium, by chromedriver, and the standard library only."""

import base64
import json
import os
import re
import shutil
import subprocess
import tempfile
import urllib.error
import urllib.request


class Browser:
    def __init__(self, width=1280, height=900):
        self.profile = tempfile.mkdtemp()
        self.driver = subprocess.Popen(["chromedriver", "--port=0"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        for line in self.driver.stdout:
            if found := re.search(r"started successfully on port (\d+)", line):
                self.address = f"http://127.0.0.1:{found[1]}"
                break
        arguments = ["--headless=new", "--disable-gpu", "--hide-scrollbars", "--force-device-scale-factor=1",
                     f"--user-data-dir={self.profile}", f"--window-size={width},{height}"]
        if os.geteuid() == 0:
            arguments.append("--no-sandbox")  # Chromium refuses to be root's otherwise
        self.session = ""
        made = self._ask("POST", "/session", {"capabilities": {"alwaysMatch": {
            "browserName": "chrome", "goog:chromeOptions": {"args": arguments},
            "goog:loggingPrefs": {"browser": "ALL", "performance": "ALL"}}}})
        self.session = "/session/" + made["sessionId"]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        try:
            self._ask("DELETE", "")
        finally:
            self.driver.terminate()
            self.driver.wait()
            shutil.rmtree(self.profile, ignore_errors=True)

    def _ask(self, how, path, what=None):
        body = None if what is None and how != "POST" else json.dumps(what or {}).encode()
        request = urllib.request.Request(self.address + self.session + path, body, {"Content-Type": "application/json"}, method=how)
        try:
            with urllib.request.urlopen(request, timeout=60) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as fault:
            raise RuntimeError(f"{path}: {fault.read().decode()[:400]}") from None

    def open(self, path):
        self._ask("POST", "/url", {"url": "file://" + os.path.abspath(path)})

    def run(self, script, *arguments):
        """What `script`, the body of a function, returns."""
        return self._ask("POST", "/execute/sync", {"script": script, "args": list(arguments)})

    def wait_for(self, expression, seconds=10):
        """Until the expression is true in the page."""
        return self._ask("POST", "/execute/async", {"script": """
            const [expression, seconds, done] = arguments, begun = performance.now();
            const look = new Function("return (" + expression + ")");
            const poll = () => {
              if (look()) done(true);
              else if (performance.now() - begun > 1000 * seconds) done(false);
              else setTimeout(poll, 20);
            };
            poll();""", "args": [expression, seconds]})

    def resize(self, width, height):
        self._ask("POST", "/window/rect", {"width": width, "height": height})

    def pointer(self, *steps):
        """Moves, presses and releases of the mouse at places in the window: ("move", x, y), ("down",), ("up",)."""
        kinds = {"move": "pointerMove", "down": "pointerDown", "up": "pointerUp"}
        actions = []
        for kind, *place in steps:
            action = {"type": kinds[kind]}
            action.update({"x": round(place[0]), "y": round(place[1]), "duration": 30} if place else {"button": 0})
            actions.append(action)
        self._ask("POST", "/actions", {"actions": [{"type": "pointer", "id": "mouse", "parameters": {"pointerType": "mouse"}, "actions": actions}]})

    def keys(self, text):
        """WebDriver's private code points stand for keys without a letter."""
        actions = [{"type": kind, "value": key} for key in text for kind in ("keyDown", "keyUp")]
        self._ask("POST", "/actions", {"actions": [{"type": "key", "id": "keys", "actions": actions}]})

    def screenshot(self, file, whole_page=False):
        if whole_page:
            width, height = self.run("return [innerWidth, document.documentElement.scrollHeight]")
            self._command("Emulation.setDeviceMetricsOverride", {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False})
        with open(file, "wb") as out:
            out.write(base64.b64decode(self._ask("GET", "/screenshot")))
        if whole_page:
            self._command("Emulation.clearDeviceMetricsOverride", {})

    def print(self, file):
        with open(file, "wb") as out:
            out.write(base64.b64decode(self._ask("POST", "/print", {"page": {"width": 21.0, "height": 29.7}, "background": True})))

    def _command(self, name, parameters):
        return self._ask("POST", "/goog/cdp/execute", {"cmd": name, "params": parameters})

    def console(self):
        return [entry["message"] for entry in self._ask("POST", "/se/log", {"type": "browser"})]

    def requests(self):
        """Addresses of everything that was asked for."""
        all_messages = [json.loads(entry["message"])["message"] for entry in self._ask("POST", "/se/log", {"type": "performance"})]
        return [m["params"]["request"]["url"] for m in all_messages if m["method"] == "Network.requestWillBeSent"]
