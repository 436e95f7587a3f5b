#!/usr/bin/env python3
"""Draws shadow masks of the shadowtruth set with three.js in headless Chromium.

usage: three.py DIR MASKS THREE

DIR is the folder of the set, made by scripts/shadowtruth. The script writes one PNG file per case to the folder MASKS.
THREE is the folder of the npm package `three`.
"""
import http.server
import json
import pathlib
import subprocess
import sys
import tempfile
import threading

from grey_png import write_png

HERE = pathlib.Path(__file__).resolve().parent


class Server(http.server.ThreadingHTTPServer):
    def __init__(self, folder, masks, three):
        super().__init__(("127.0.0.1", 0), Handler)
        self.roots = {"set": folder, "three": three}
        self.masks, self.said, self.ended = masks, "", threading.Event()


class Handler(http.server.BaseHTTPRequestHandler):
    def log_message(self, *_):
        pass

    def answer(self, body, kind="application/octet-stream", code=200):
        self.send_response(code)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def do_GET(self):
        root, _, rest = self.path.lstrip("/").partition("/")
        if root == "":
            self.answer((HERE / "three.html").read_bytes(), "text/html")
        elif root == "cases":
            self.answer(json.dumps(sorted(p.stem for p in self.server.roots["set"].glob("*.glb"))).encode(), "application/json")
        elif root in self.server.roots and (self.server.roots[root] / rest).is_file():
            self.answer((self.server.roots[root] / rest).read_bytes(), "text/javascript" if rest.endswith(".js") else "model/gltf-binary")
        else:
            self.answer(b"", code=404)

    def do_POST(self):
        body = self.rfile.read(int(self.headers["Content-Length"]))
        if self.path == "/end":
            self.server.said = body.decode()
            self.server.ended.set()
        else:
            alpha = body[3::4]  # the opacity of the shadow, rows from bottom to top
            width = round(len(alpha) ** 0.5)
            rows = [alpha[y * width : (y + 1) * width] for y in reversed(range(width))]
            write_png(self.server.masks / f"{self.path.rpartition('/')[2]}.png", width, bytes(255 - a for a in b"".join(rows)))
        self.answer(b"")


def main():
    folder, masks, three = map(pathlib.Path, sys.argv[1:4])
    server = Server(folder, masks, three)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    with tempfile.TemporaryDirectory(prefix="shadowtruth_") as profile:
        browser = subprocess.Popen(
            ["chromium", "--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--use-angle=swiftshader",
             "--enable-unsafe-swiftshader", f"--user-data-dir={profile}", f"http://127.0.0.1:{server.server_port}/"],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)  # fmt: skip
        server.ended.wait(timeout=3600)
        browser.terminate()
        browser.wait()
    if not server.said or server.said.startswith("error"):
        sys.exit(f"three.py: {server.said or 'no answer from Chromium'}")
    print(f"three.js r{server.said}")


if __name__ == "__main__":
    main()
