"""A program that uses the types of the package: `mypy --strict` checks it, and test_typed.py runs it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

import crossbar_gi as cg


def leaks(vertices: NDArray[np.float64], faces: NDArray[np.int64]) -> int:
    """Rays that an intersector misses if it never hits anything."""
    rays: cg.HardRays = cg.hard_rays(vertices, faces, 60)
    judge: cg.Oracle = cg.oracle(vertices, faces, sides="front")
    nothing = np.full(len(rays.origins), -1)
    verdicts = judge.judge(rays.origins, rays.directions, nothing, nothing, rays.aims)
    found: dict[cg.Kind, int] = cg.counts(verdicts)
    return found.get(cg.Kind.LEAK, 0)


def main() -> tuple[int, float, float | None]:
    """One call of each kind."""
    vertices = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    largest: float = cg.Format("e5m10:rtz").max
    product = cg.mul(np.ones(3), [largest, 1, 2], cg.Format("fp16"))
    drawn: cg.Run = cg.run("docs/examples/highlight.toml")
    target: NDArray[np.float64] = drawn.targets[0]
    difference: cg.Difference = cg.diff(target, target)
    rows: list[dict[str, object]] = drawn.trace(0, 0)
    assert len(rows) > 0
    product_of_units: NDArray[np.float32] = cg.matmul([[1.0]], [[2.0]], unit="hopper-fp8", promote=128)
    assert product_of_units.dtype == np.float32 and cg.dot([1.0], [2.0], unit="hopper-f16") == product_of_units[0, 0]
    return leaks(vertices, np.array([[0, 1, 2], [0, 2, 3]])), float(product[0]), difference.ssim
