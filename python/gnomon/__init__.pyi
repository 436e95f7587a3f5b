import os
from typing import Any, Callable, NamedTuple, Sequence

import numpy as np
from numpy.typing import NDArray

__version__: str
_Path = str | os.PathLike[str]

class Mesh(NamedTuple):
    positions: NDArray[np.float64]
    triangles: NDArray[np.uint32]
    normals: NDArray[np.float32]
    colors: NDArray[np.uint8]
    error: float

class Model:
    def __init__(self, path: _Path, memory: int = ...) -> None: ...
    @property
    def info(self) -> dict[str, Any]: ...
    @property
    def damage(self) -> list[str]: ...
    def cut(self, *, error: float | None = ..., triangles: int | None = ..., **view: Any) -> Mesh: ...
    def plan(self, **view: Any) -> dict[str, Any]: ...
    def render(self, *, samples: int = ..., **view: Any) -> NDArray[np.uint8]: ...

def open(path: _Path, memory: int = ...) -> Model: ...
def build(
    inputs: _Path | Sequence[_Path],
    output: _Path,
    *,
    memory: int = ...,
    threads: int = ...,
    tmp: _Path = ...,
    fields: Sequence[str] = ...,
    up: str = ...,
    unit: str = ...,
    source_root: _Path = ...,
    progress: Callable[[str, int, int], bool | None] | None = ...,
) -> dict[str, Any]: ...
def schemes(
    near: float, far: float, *, fov_y: float = ..., aspect: float = ..., light: Sequence[float] = ...
) -> list[dict[str, Any]]: ...
