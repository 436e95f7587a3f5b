"""A web server on this machine that gives byte ranges of files of a folder, or fails to in every way that a test asks for.

    python3 range_server.py FOLDER [--port N] [--mbit F] [--latency-ms F]
"""
import argparse
import http.server
import pathlib
import re
import threading
import time


class Faults:
    """What the server does wrong from now on; each may be set at any time."""

    def __init__(self):
        self.ranges = True         # else every answer is the whole file
        self.says_when = True      # ETag and Last-Modified
        self.tag = ""              # behind the ETag: another one is another content
        self.damage = None         # f(path, offset, bytes) -> bytes
        self.status = None         # f(number of the request) -> a status, or None
        self.body = "whole"        # short, endless, crumbs, other (another range), none, encoded, header
        self.mbit = None           # of all connections together
        self.latency = 0.0         # seconds before each answer


class RangeServer(http.server.ThreadingHTTPServer):
    """Serves `folder` on 127.0.0.1 while it is entered; counts what it was asked for."""

    daemon_threads = True
    allow_reuse_address = True

    def __init__(self, folder, port=0, tls=None):
        super().__init__(("127.0.0.1", port), Handler)
        if tls:
            self.socket = tls.wrap_socket(self.socket, server_side=True)
        self.scheme = "https" if tls else "http"
        self.folder = pathlib.Path(folder)
        self.faults = Faults()
        self.lock = threading.Lock()
        self.requests = self.body_bytes = 0
        self.ranges_sent = []
        self.connections = set()
        self.line_free = 0.0  # when the throttled line has sent all that it was given

    def address(self, name):
        return f"{self.scheme}://127.0.0.1:{self.server_port}/{name}"

    def __enter__(self):
        threading.Thread(target=self.serve_forever, kwargs={"poll_interval": 0.02}, daemon=True).start()
        return self

    def __exit__(self, *_):
        """Dies as if killed: open connections break, too."""
        self.shutdown()
        self.server_close()
        with self.lock:
            connections = list(self.connections)
        for connection in connections:
            try:
                connection.shutdown(2)
            except OSError:
                pass

    def handle_error(self, request, client_address):
        pass  # whoever hangs up does it on purpose

    def send_paced(self, write, data):
        """In pieces, as fast as the line is."""
        for start in range(0, len(data), 8192):
            piece = data[start:start + 8192]
            if self.faults.mbit:
                with self.lock:
                    self.line_free = max(self.line_free, time.monotonic()) + len(piece) * 8e-6 / self.faults.mbit
                    until = self.line_free
                time.sleep(max(0.0, until - time.monotonic()))
            write(piece)
            with self.lock:
                self.body_bytes += len(piece)


class Handler(http.server.BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    disable_nagle_algorithm = True

    def setup(self):
        super().setup()
        with self.server.lock:
            self.server.connections.add(self.connection)

    def finish(self):
        with self.server.lock:
            self.server.connections.discard(self.connection)
        super().finish()

    def log_message(self, *_):
        pass

    def refuse(self, status, headers=()):
        self.send_response(status)
        for name, value in headers:
            self.send_header(name, value)
        self.send_header("Content-Length", "0")
        self.end_headers()

    def do_GET(self):
        server, faults = self.server, self.server.faults
        with server.lock:
            server.requests += 1
            number = server.requests
        time.sleep(faults.latency)
        status = faults.status(number) if faults.status else None
        if status:
            return self.refuse(status, [("Location", self.path)] if status in (301, 302) else ())
        path = server.folder / self.path.lstrip("/").split("?")[0]
        if not path.is_file():
            return self.refuse(404)
        size = path.stat().st_size
        asked = re.fullmatch(r"bytes=(\d+)-(\d+)", self.headers.get("Range", ""))
        if not asked or not faults.ranges:
            return self.whole(path)
        first, last = int(asked[1]), min(int(asked[2]), size - 1)
        if first > last:
            return self.refuse(416, [("Content-Range", f"bytes */{size}")])
        self.part(path, first, last, size)

    def whole(self, path):
        self.send_response(200)
        self.send_header("Content-Length", str(path.stat().st_size))
        self.end_headers()
        self.server.send_paced(self.wfile.write, path.read_bytes())

    def part(self, path, first, last, size):
        server, faults = self.server, self.server.faults
        if faults.body == "crumbs":
            last = first
        with server.lock:
            server.ranges_sent.append((first, last))
        with open(path, "rb") as file:
            file.seek(first)
            data = file.read(last - first + 1)
        if faults.damage:
            data = faults.damage(self.path, first, data)
        told = first + 1 if faults.body == "other" else first
        self.send_response(206)
        self.send_header("Content-Range", f"bytes {told}-{last}/{size}")
        if faults.says_when:
            self.send_header("ETag", f'"{size:x}{faults.tag}"')
            self.send_header("Last-Modified", self.date_time_string(path.stat().st_mtime))
        if faults.body == "encoded":
            self.send_header("Content-Encoding", "gzip")
        if faults.body == "header":
            for i in range(2000):
                self.send_header(f"X-{i}", "x" * 100)
        if faults.body != "endless":
            self.send_header("Content-Length", str(len(data)))
        self.end_headers()
        if faults.body == "none":
            data = b""
        if faults.body == "short":
            data = data[:len(data) // 2]
        self.server.send_paced(self.wfile.write, data)
        if faults.body == "endless":
            for _ in range(1 << 14):  # a GiB; whoever takes it all fails for time
                self.wfile.write(bytes(1 << 16))
        if faults.body in ("none", "short", "endless"):
            self.close_connection = True


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("folder")
    parser.add_argument("--port", type=int, default=8000)
    parser.add_argument("--mbit", type=float)
    parser.add_argument("--latency-ms", type=float, default=0)
    options = parser.parse_args()
    with RangeServer(options.folder, options.port) as server:
        server.faults.mbit, server.faults.latency = options.mbit, options.latency_ms / 1000
        print(server.address(""), flush=True)
        try:
            threading.Event().wait()
        except KeyboardInterrupt:
            print(f"{server.requests} requests, {server.body_bytes} bytes")


if __name__ == "__main__":
    main()
