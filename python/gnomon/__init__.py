"""Level-of-detail models of large meshes, drawn with low-error shadows.

    import gnomon
    gnomon.build("scan.ply", "scan.gnm")
    model = gnomon.open("scan.gnm")
    picture = model.render(size=(800, 600), light=(1, 2, 1), shadows="exact")   # numpy, (600, 800, 4), uint8
    mesh = model.cut(triangles=100_000)                                         # mesh.positions, mesh.triangles, ...

Options of a view are those of `gnomon render`, with underscores for dashes.
"""
import json
import os
from typing import NamedTuple

from . import _gnomon

__version__ = _gnomon.version()


class Mesh(NamedTuple):
    """Triangles of a cut."""
    positions: object  # (vertices, 3), float64, the source's axes and units
    triangles: object  # (triangles, 3), uint32
    normals: object    # (vertices, 3), float32; 0 where the source has none
    colors: object     # (vertices, 4), uint8: red, green, blue, alpha
    error: float       # no point of the source is farther off, units


def _text(name, value):
    """`value` of option `name` as a command line has it."""
    if isinstance(value, bool):
        return "on" if value else "off"
    if isinstance(value, (str, os.PathLike)):
        return os.fspath(value)
    if hasattr(value, "__len__"):
        between = "x" if name in ("size", "shadow-texels") else ","
        return between.join(_text("", each) for each in value)
    return repr(value.item() if hasattr(value, "item") else value)


def _options(options):
    return {name.replace("_", "-"): _text(name.replace("_", "-"), value)
            for name, value in options.items() if value is not None}


class Model:
    """An open model, of a .gnm or the http(s):// address of one; tables and pages take at most `memory` bytes."""

    def __init__(self, path, memory=1 << 30):
        self._model = _gnomon.Model(os.fspath(path), memory)

    @property
    def info(self):
        """What `gnomon info --json` prints."""
        return json.loads(self._model.info())

    @property
    def damage(self):
        """The pages that could not be read since the model was opened, one line each. Coarser pages replace them."""
        return self._model.damage()

    def cut(self, *, error=None, triangles=None, **view):
        """A Mesh: the coarsest cut within `error`, the finest of at most so many `triangles`, or what a view shows."""
        if (error is not None) + (triangles is not None) + bool(view) != 1:
            raise TypeError("cut: say one of error, triangles, and options of a view")
        if error is not None:
            return Mesh(*self._model.cut_by_error(error))
        if triangles is not None:
            return Mesh(*self._model.cut_by_triangles(triangles))
        return Mesh(*self._model.cut_for_view(_options(view)))

    def plan(self, **view):
        """The plan of one frame, as `gnomon explain --json` prints it."""
        return json.loads(self._model.plan(_options(view)))

    def render(self, *, samples=16, **view):
        """A picture, (height, width, 4), uint8, sRGB, as `gnomon render` draws it: the mean of `samples` frames."""
        return self._model.render(_options(view), samples)


def open(path, memory=1 << 30):
    """Opens a model."""
    return Model(path, memory)


def build(inputs, output, *, memory=2 << 30, threads=0, tmp="", fields=(), up="auto", unit="m", source_root="",
          progress=None):
    """Builds `output`, a .gnm, of one mesh or several; returns what `gnomon build --json` prints. `progress` is told
    (stage, done, total) and ends the build where it returns False."""
    if isinstance(inputs, (str, os.PathLike)):
        inputs = [inputs]
    options = _gnomon.BuildOptions()
    options.memory, options.threads, options.tmp = memory, threads, os.fspath(tmp)
    options.fields, options.up, options.unit = list(fields), up, unit
    options.source_root = os.fspath(source_root)
    tell = None if progress is None else lambda *told: progress(*told) is not False
    return json.loads(_gnomon.build([os.fspath(each) for each in inputs], os.fspath(output), options, tell))


def schemes(near, far, *, fov_y=60.0, aspect=1.0, light=(0.0, 1.0, 0.0)):
    """What every scheme of shadow maps costs for a view frustum, 1 to 8 slices: dicts, as `gnomon theory table --json`.
    `light` is the direction towards it: right, up and along the view."""
    return _gnomon.schemes(near, far, fov_y, aspect, tuple(map(float, light)))
