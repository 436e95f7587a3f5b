"""Compares the 3D Tiles of a model, drawn by CesiumJS in headless Chromium, with pictures by `gnomon render`.

    npm install cesium
    python3 bench/tiles_in_cesium.py build/release/gnomon node_modules/cesium --poses 10 MODEL.gnm ...

Both draw --poses random views (default: 10) of 800x600 pixels, unlit, without shadows, over the same background.
CesiumJS draws at an error of 1 pixel, and `gnomon render` at 0.25 pixels. The script prints per model:
- coverage: pixels that only one picture covers, in percent of all pixels; mean and max over the views
- colour: mean difference of the pixels that both pictures cover, in percent of full scale; mean and max
- holes: background pixels of CesiumJS that our picture covers completely in the 5x5 pixels around them
- complaints: the first three errors of the browser
"""
import argparse
import base64
import functools
import http.server
import io
import json
import pathlib
import random
import subprocess
import sys
import tempfile
import threading
import time

import numpy as np
from matplotlib import image

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tests/browser"))
from webdriver import Browser  # noqa: E402

WIDTH, HEIGHT, FOV_Y = 800, 600, 50.0
BACKGROUND = np.array([255, 0, 255])
PAGE = """<!doctype html><canvas id="c" width="%d" height="%d"></canvas>
<script>window.CESIUM_BASE_URL = '/cesium/Build/Cesium/';</script>
<script src="/cesium/Build/Cesium/Cesium.js"></script>
<script>
window.errors = []; window.onerror = m => errors.push(String(m));
const canvas = document.getElementById('c');
const scene = new Cesium.Scene({canvas, contextOptions: {webgl: {preserveDrawingBuffer: true, antialias: false}}});
scene.backgroundColor = Cesium.Color.MAGENTA;
scene.highDynamicRange = false; scene.msaaSamples = 1;
for (const part of ['skyBox', 'sun', 'moon', 'skyAtmosphere']) scene[part] = undefined;
async function open(url) {
    const tiles = await Cesium.Cesium3DTileset.fromUrl(url, {maximumScreenSpaceError: 1, skipLevelOfDetail: false,
        customShader: new Cesium.CustomShader({lightingModel: Cesium.LightingModel.UNLIT}), cacheBytes: 2**30});
    tiles.tileFailed.addEventListener(e => errors.push('tile ' + e.url + ' ' + e.message));
    scene.primitives.add(tiles);
    window.tiles = tiles;
}
function show(pose) {
    window.shown = false;
    const V = a => Cesium.Cartesian3.fromArray(a);
    scene.camera.frustum = new Cesium.PerspectiveFrustum({fov: pose.fov, aspectRatio: canvas.width / canvas.height,
        near: pose.near, far: pose.far});
    scene.camera.setView({destination: V(pose.eye), orientation: {direction: V(pose.direction), up: V(pose.up)}});
    let frames = 0;
    function frame() {
        scene.initializeFrame(); scene.render();
        if (++frames > 5 && tiles.tilesLoaded) window.shown = true; else requestAnimationFrame(frame);
    }
    frame();
}
</script>""" % (WIDTH, HEIGHT)


class Handler(http.server.SimpleHTTPRequestHandler):
    def __init__(self, *words, places, **options):
        self.places = places
        super().__init__(*words, **options)

    def translate_path(self, path):
        _, name, rest = path.split("?")[0].split("/", 2) if path.count("/") > 1 else (None, path.strip("/"), "")
        return str(self.places[name] / rest) if name in self.places else ""

    def log_message(self, *_):
        pass


def in_tiles(vector, up):
    """Converts a vector from the axes of the model to the axes of its tiles, which have z up. `up` is "y" or "z"."""
    x, y, z = vector
    return [x, -z, y] if up == "y" else [x, y, z]


def poses(info, count):
    """Yields `count` random views around the model: eye, target, and half of the model's diagonal."""
    low, high = (np.array(info["bounds"][end]) for end in ("min", "max"))
    draw = random.Random(1)
    radius = float(np.linalg.norm(high - low)) / 2
    for _ in range(count):
        direction = np.array([draw.gauss(0, 1) for _ in range(3)])
        direction /= np.linalg.norm(direction)
        target = (low + high) / 2 + (high - low) * [draw.uniform(-0.1, 0.1) for _ in range(3)]
        yield target + direction * radius * draw.uniform(1.3, 3), target, radius


def ours(program, model, eye, target, folder):
    png = folder / "ours.png"
    words = [program, "render", model, "-o", png, "--size", f"{WIDTH}x{HEIGHT}", "--fov-y", FOV_Y, "--samples", 1,
             "--shading", "unlit", "--shadows", "off", "--background", "#ff00ff", "--error-pixels", 0.25,
             "--eye", ",".join(map(repr, map(float, eye))), "--target", ",".join(map(repr, map(float, target)))]
    subprocess.run(list(map(str, words)), check=True, capture_output=True)
    return pixels(png.read_bytes())


def pixels(png):
    return np.round(image.imread(io.BytesIO(png))[..., :3] * 255).astype(int)


def theirs(browser, up, eye, target, radius):
    view = (target - eye) / np.linalg.norm(target - eye)
    above = np.array([0, 0, 1.0] if up == "z" else [0, 1.0, 0])
    above -= view * (above @ view)
    wide = 2 * np.arctan(np.tan(np.radians(FOV_Y) / 2) * WIDTH / HEIGHT)  # Cesium uses the angle of the longer side
    pose = {"eye": in_tiles(eye, up), "direction": in_tiles(view, up), "up": in_tiles(above / np.linalg.norm(above), up),
            "fov": wide, "near": radius / 100, "far": radius * 10}
    browser.run("show(" + json.dumps(pose, default=float) + ")")
    end = time.monotonic() + 120
    while not browser.run("return window.shown") and time.monotonic() < end:
        time.sleep(0.05)
    return pixels(base64.b64decode(browser.run("return canvas.toDataURL('image/png')").split(",")[1]))


def around(mask, reach):
    """Returns the mask of all pixels at most `reach` columns and rows from a pixel of `mask`."""
    grown = mask.copy()
    for dy in range(-reach, reach + 1):
        for dx in range(-reach, reach + 1):
            grown |= np.roll(mask, (dy, dx), (0, 1))
    return grown


def compare(program, browser, address, model, count, folder, keep):
    info = json.loads(subprocess.run([program, "info", model, "--json"], check=True, capture_output=True).stdout)
    up = "z" if "z" in json.dumps(info.get("up", "y")) else "y"
    browser.open(address + "/page/index.html")
    browser.run("open('/tiles/%s/tileset.json').catch(error => errors.push(String(error)))" % model.stem)
    while not browser.run("return !!window.tiles || errors.length"):
        time.sleep(0.1)
    assert not browser.run("return errors"), browser.run("return errors")
    coverage, colour, holes = [], [], []
    for number, (eye, target, radius) in enumerate(poses(info, count)):
        a, b = ours(program, model, eye, target, folder), theirs(browser, up, eye, target, radius)
        covered = [(each != BACKGROUND).any(-1) for each in (a, b)]
        both = covered[0] & covered[1]
        coverage.append(float((covered[0] != covered[1]).mean()))
        colour.append(float(np.abs(a - b)[both].mean() / 255) if both.any() else 0.0)
        holes.append(int((~around(~covered[0], 2) & ~covered[1]).sum()))
        if keep:
            image.imsave(keep / f"{model.stem}_{number}.png", np.concatenate([a, b], 1).astype(np.uint8))
    errors = browser.run("return errors")
    print(f"{model.stem}: {count} poses; coverage differs in {100 * np.mean(coverage):.3f}% of pixels, at most "
          f"{100 * max(coverage):.3f}%; colour by {100 * np.mean(colour):.2f}%, at most {100 * max(colour):.2f}%; "
          f"holes {sum(holes)} pixels in {sum(map(bool, holes))} poses; complaints {errors[:3]}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("cesium", type=pathlib.Path)
    parser.add_argument("models", type=pathlib.Path, nargs="+")
    parser.add_argument("--poses", type=int, default=10)
    parser.add_argument("--keep", type=pathlib.Path, help="folder for pairs of pictures, ours at the left")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name, Browser(WIDTH + 40, HEIGHT + 200) as browser:
        folder = pathlib.Path(name)
        (folder / "index.html").write_text(PAGE)
        places = {"cesium": options.cesium.resolve(), "tiles": folder / "tiles", "page": folder}
        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Handler, places=places))
        threading.Thread(target=server.serve_forever, daemon=True).start()
        for model in options.models:
            subprocess.run([options.program, "export", model, "--format", "3dtiles", "-o",
                            folder / "tiles" / model.stem], check=True, capture_output=True)
            compare(options.program, browser, f"http://127.0.0.1:{server.server_port}", model, options.poses, folder,
                    options.keep)
        server.shutdown()


if __name__ == "__main__":
    main()
