# The compiled part, from python/src. Users call the Python modules in this folder instead.
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

__version__: str

def compute(
    operation: str, format: str, seed: int, operands: Sequence[NDArray[np.float64]], out: NDArray[np.float64]
) -> None: ...
def compute_patterns(
    operation: str, format: str, seed: int, operands: Sequence[NDArray[np.uint32]], out: NDArray[np.uint32]
) -> None: ...
def to_patterns(format: str, seed: int, numbers: NDArray[np.float64], out: NDArray[np.uint32]) -> None: ...
def from_patterns(format: str, patterns: NDArray[np.uint32], out: NDArray[np.float64]) -> None: ...
def dot(
    formats: tuple[str, str],
    order: str,
    x: NDArray[np.float64],
    y: NDArray[np.float64],
    out: NDArray[np.float64],
) -> None: ...
def format_facts(text: str) -> dict[str, Any]: ...
def units() -> list[tuple[str, str, list[str], str, int, int, int | None, str, str, str]]: ...

_Numbers = NDArray[np.float64] | NDArray[np.uint64]
_Types = tuple[str | None, str | None]
_Words = tuple[NDArray[np.uint64], int]

def matmul(
    unit: str,
    types: _Types,
    a: _Numbers,
    b: _Numbers,
    c: NDArray[np.float64] | None,
    bits_promote: tuple[int | None, int | None],
) -> _Words: ...
def unit_dot(
    unit: str,
    types: _Types,
    operands: tuple[_Numbers, _Numbers, _Numbers],
    length: int,
    scales: tuple[NDArray[np.uint8], NDArray[np.uint8]] | None,
) -> _Words: ...
def kinds() -> list[str]: ...
def aims() -> list[str]: ...
def hard_rays(
    vertices: NDArray[np.float32], faces: NDArray[np.uint32], each: int, seed: int
) -> tuple[NDArray[np.float32], NDArray[np.float32], NDArray[np.uint8]]: ...
def entries() -> list[tuple[str, str]]: ...
def reproduce(ids: list[str], full_size: bool) -> str: ...
def precision(
    case: Case | None,
    system: tuple[str | None, str | None, list[tuple[str, str]]],
    goal: str | None,
    families: list[str],
    budget: int,
) -> str: ...
def diff(
    pictures: tuple[NDArray[np.float32], NDArray[np.float32]], is_srgb: bool, exposure_ppd: tuple[float, float]
) -> tuple[float | None, float, float, NDArray[np.float64]]: ...
def compare(
    left: Case,
    right: Case,
    executors: tuple[str, str],
    pixel: tuple[int, int] | None,
    registers: bool,
) -> str: ...

_Hits = tuple[NDArray[np.int32], NDArray[np.uint32], NDArray[np.float64]]
_Rays = tuple[NDArray[np.float32], NDArray[np.float32]]

class Oracle:
    def __new__(
        cls,
        vertices: NDArray[np.float32],
        faces: NDArray[np.uint32],
        sides_hit: str,
        tolerance: tuple[int, float],
        nearby_ulps: int,
    ) -> Oracle: ...
    def first_hits(self, origins: NDArray[np.float32], directions: NDArray[np.float32]) -> _Hits: ...
    def judge(
        self, rays: _Rays, triangles: NDArray[np.int64], ts: NDArray[np.float32], aims: NDArray[np.uint8]
    ) -> tuple[NDArray[np.uint8], NDArray[np.uint8], NDArray[np.bool_], _Hits, NDArray[np.int64]]: ...
    def report(
        self, rays: _Rays, triangles: NDArray[np.int64], ts: NDArray[np.float32], aims: NDArray[np.uint8]
    ) -> str: ...

class Case:
    def __new__(
        cls,
        source: tuple[str, str | None],
        device: str | None,
        format: str | None,
        switches: list[tuple[str, str]],
        step_budget: int | None,
    ) -> Case: ...
    def with_inputs(
        self,
        constants: list[tuple[int, Sequence[float]]],
        textures: list[tuple[int, NDArray[np.float32]]],
    ) -> Case: ...
    def warnings(self) -> list[str]: ...
    def run(
        self, executor_name: str
    ) -> tuple[str, list[NDArray[np.float64]], NDArray[np.float64] | None]: ...
    def trace(self, x: int, y: int, executor_name: str) -> str: ...
