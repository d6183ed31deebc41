"""Exact first hits of rays on a mesh, comparison of other hits with them, and rays on which intersectors differ.

All decisions are exact for float32 values: vertices, origins and directions of other types are first rounded to
float32, and results are for the rounded values. ``t`` is in multiples of the given direction of a ray; the direction
need not have unit length.
"""

from __future__ import annotations

from enum import IntEnum
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native


class Kind(IntEnum):
    """Verdict on a hit. docs/examples/foreign_intersector.md describes each kind."""

    #: The exact answer, with t within the tolerance.
    RIGHT = 0
    #: A triangle id that the mesh does not have.
    NO_SUCH_TRIANGLE = 1
    #: No hit, although there is a surface: a hole.
    LEAK = 2
    #: A hit on a triangle behind the first one: a hole through which the ray hits something else.
    LEAK_THROUGH = 3
    #: A hit, although the ray hits nothing.
    FALSE_HIT = 4
    #: A triangle hit from behind, although only front faces count.
    BACK_FACE = 5
    #: A triangle unrelated to the correct one.
    WRONG_TRIANGLE = 6
    #: A triangle that shares an edge or a vertex with the correct one.
    WRONG_NEIGHBOUR = 7
    #: The correct triangle, with t outside the tolerance.
    T_OFF = 8
    #: Correct for a ray whose direction differs by a few ULPs, near a silhouette: rounding.
    SILHOUETTE = 9
    #: Correct for a ray whose origin differs by a few ULPs: rounding.
    START = 10
    #: A triangle behind the first one by no more than the tolerance: rounding.
    NEAR_TIE = 11

    @property
    def is_leak(self) -> bool:
        """True if the intersector missed a surface that this ray and every nearby ray hit."""
        return self in (Kind.LEAK, Kind.LEAK_THROUGH)


class Aim(IntEnum):
    """What a hard ray is aimed at."""

    #: Unknown.
    UNKNOWN = 0
    #: From outside, at a point of a shared edge.
    EDGE = 1
    #: From outside, at a vertex.
    VERTEX = 2
    #: Along an axis; the other two components are +0 or -0.
    AXIS = 3
    #: In the plane of a triangle.
    PLANE = 4
    #: From a point of a surface.
    SURFACE = 5
    #: From far away, a thousand to a million sizes of the mesh, at a point of an edge.
    FAR = 6


#: One verdict: the ``Kind`` and ``Aim``, True if rounding explains the answer, the exact first triangle (-1 for none),
#: the number of triangles at that t, the exact t (NaN for none), and the number of float32 steps between the given
#: and the exact t (-1 if either is missing or not finite).
VERDICT = np.dtype(
    [
        ("kind", np.uint8),
        ("aim", np.uint8),
        ("rounding", np.bool_),
        ("triangle", np.int32),
        ("ties", np.uint32),
        ("t", np.float64),
        ("ulps", np.int64),
    ]
)

#: An exact first hit: the smallest id of the triangles hit (-1 for none), their number, and t (NaN for none).
HIT = np.dtype([("triangle", np.int32), ("ties", np.uint32), ("t", np.float64)])


class HardRays(NamedTuple):
    """Rays on which intersectors differ."""

    #: Shape (n, 3), float32.
    origins: NDArray[np.float32]
    #: Shape (n, 3), float32, not normalised.
    directions: NDArray[np.float32]
    #: Shape (n,), codes of :class:`Aim`.
    aims: NDArray[np.uint8]


def _rows(what: str, array: ArrayLike) -> NDArray[np.float32]:
    """Finite float32 numbers of shape (n, 3)."""
    given = np.asarray(array)
    if given.ndim != 2 or given.shape[1] != 3:
        raise ValueError(f"expected {what} of shape (n, 3), found {given.shape}")
    if given.dtype.kind not in "fiu":
        raise ValueError(f"expected numbers as {what}, found an array of {given.dtype}")
    with np.errstate(over="ignore"):
        rows = np.ascontiguousarray(given, dtype=np.float32)
    finite = np.isfinite(rows)
    if not finite.all():
        row, axis = np.argwhere(~finite)[0]
        raise ValueError(f"expected finite {what}, found {given[row, axis]} in {what}[{row}, {axis}] (as float32)")
    return rows


def _faces(array: ArrayLike, vertices: int) -> NDArray[np.uint32]:
    given = np.asarray(array)
    if given.ndim != 2 or given.shape[1] != 3:
        raise ValueError(f"expected faces of shape (m, 3), found {given.shape}")
    if given.dtype.kind not in "iu":
        raise ValueError(f"expected faces as integers, found an array of {given.dtype}")
    wrong = (given < 0) | (given >= vertices)
    if wrong.any():
        row, corner = np.argwhere(wrong)[0]
        found = given[row, corner]
        raise ValueError(f"expected indices below {vertices} (counted from 0), found {found} in faces[{row}, {corner}]")
    return np.ascontiguousarray(given, dtype=np.uint32)


class Oracle:
    """A mesh with a search tree; :func:`oracle` makes it."""

    def __init__(self, native: _native.Oracle) -> None:
        self._native = native

    def first_hits(self, origins: ArrayLike, directions: ArrayLike) -> NDArray[Any]:
        """The exact first hit of each ray.

        Args:
            origins: Shape (n, 3), in the unit of the mesh.
            directions: Shape (n, 3), of any length except zero.

        Returns:
            Structured array :data:`HIT` of shape (n,).

        Raises:
            ValueError: if a shape is wrong, a number is not finite, or a direction is zero.
        """
        triangle, ties, t = self._native.first_hits(_rows("origins", origins), _rows("directions", directions))
        hits = np.empty(len(t), dtype=HIT)
        hits["triangle"], hits["ties"], hits["t"] = triangle, ties, t
        return hits

    def judge(
        self,
        origins: ArrayLike,
        directions: ArrayLike,
        triangle: ArrayLike,
        t: ArrayLike,
        aims: ArrayLike | None = None,
    ) -> NDArray[Any]:
        """Compare first hits with the exact ones.

        Args:
            origins: Shape (n, 3).
            directions: Shape (n, 3).
            triangle: Shape (n,), integers: the triangle that your code found, negative for none.
            t: Shape (n,): the t of that hit, in multiples of the ray's direction; any value if there is no hit. A t
                that is NaN or infinite is wrong.
            aims: Shape (n,): the aims from :func:`hard_rays`, if known.

        Returns:
            Structured array :data:`VERDICT` of shape (n,).

        Raises:
            ValueError: if a shape is wrong, a ray is not finite, or a direction is zero.
        """
        rays, triangles, ts, codes = self._found(origins, directions, triangle, t, aims)
        kinds, aim_codes, rounding, hits, ulps = self._native.judge(rays, triangles, ts, codes)
        verdicts = np.empty(len(kinds), dtype=VERDICT)
        verdicts["kind"], verdicts["aim"], verdicts["rounding"], verdicts["ulps"] = kinds, aim_codes, rounding, ulps
        verdicts["triangle"], verdicts["ties"], verdicts["t"] = hits
        return verdicts

    def report(
        self,
        origins: ArrayLike,
        directions: ArrayLike,
        triangle: ArrayLike,
        t: ArrayLike,
        aims: ArrayLike | None = None,
    ) -> str:
        """The results of :meth:`judge` as text: counts, and the ten worst rays and their triangles to the last bit.

        Raises:
            ValueError: as :meth:`judge`.
        """
        rays, triangles, ts, codes = self._found(origins, directions, triangle, t, aims)
        return self._native.report(rays, triangles, ts, codes)

    @staticmethod
    def _found(
        origins: ArrayLike, directions: ArrayLike, triangle: ArrayLike, t: ArrayLike, aims: ArrayLike | None
    ) -> tuple[
        tuple[NDArray[np.float32], NDArray[np.float32]], NDArray[np.int64], NDArray[np.float32], NDArray[np.uint8]
    ]:
        triangles, codes = np.asarray(triangle), np.asarray([] if aims is None else aims)
        if triangles.dtype.kind not in "iu":
            raise ValueError(f"expected triangles as integers, found an array of {triangles.dtype}")
        with np.errstate(over="ignore"):
            ts = np.ascontiguousarray(t, dtype=np.float32)
        for name, array in (("triangle", triangles), ("t", ts), ("aims", codes)):
            if array.ndim != 1:
                raise ValueError(f"expected {name} of shape (n,), found {array.shape}")
        rays = (_rows("origins", origins), _rows("directions", directions))
        ids = np.ascontiguousarray(triangles, dtype=np.int64)
        return rays, ids, ts, np.ascontiguousarray(codes, dtype=np.uint8)


def oracle(
    vertices: ArrayLike,
    faces: ArrayLike,
    *,
    sides: str = "both",
    ulps: int = 4,
    absolute: float = 0.0,
    nearby_ulps: int = 8,
) -> Oracle:
    """Make a judge of first hits on a mesh; for a trimesh mesh, ``oracle(mesh.vertices, mesh.faces)``.

    Args:
        vertices: Shape (n, 3), rounded to float32.
        faces: Shape (m, 3), integers: the corners of each triangle, counted from 0. Triangles without area are never
            hit.
        sides: ``"both"``, or ``"front"``: rays only hit the side on which the corners run counter-clockwise.
        ulps: Number of float32 steps by which t may be off; 2**32 - 1 allows any t.
        absolute: Additional distance by which t may be off, in multiples of the direction.
        nearby_ulps: A miss is not a leak if it is right for a ray within this number of ULPs; 0: it is always a leak.

    Raises:
        ValueError: if a shape is wrong, a coordinate is not finite, or an index is beyond the vertices.
    """
    points = _rows("vertices", vertices)
    if not 0 <= ulps < 2**32 or not 0 <= nearby_ulps < 2**16:
        raise ValueError(f"expected ulps of 0 to 2**32 - 1 and nearby_ulps below 2**16, found {ulps} and {nearby_ulps}")
    return Oracle(_native.Oracle(points, _faces(faces, len(points)), sides, (ulps, absolute), nearby_ulps))


def hard_rays(vertices: ArrayLike, faces: ArrayLike, n: int, seed: int = 0) -> HardRays:
    """Make rays on which intersectors differ, spread over a mesh: at most ``n // 6`` for each :class:`Aim`.

    Args:
        vertices: Shape (n, 3).
        faces: Shape (m, 3).
        n: Number of rays; you get fewer if the mesh has too few edges, vertices or triangles to aim at.
        seed: The same seed gives the same rays.

    Raises:
        ValueError: as :func:`oracle`, or if ``n`` is below 6.
    """
    if n < 6 or seed < 0:
        raise ValueError(f"expected 6 rays or more and a seed of 0 or more, found {n} and {seed}")
    points = _rows("vertices", vertices)
    origins, directions, aims = _native.hard_rays(points, _faces(faces, len(points)), n // 6, seed)
    return HardRays(origins.reshape(-1, 3), directions.reshape(-1, 3), aims)


def counts(verdicts: NDArray[Any]) -> dict[Kind, int]:
    """Count the verdicts of :meth:`Oracle.judge` by kind: right answers first, then the worst kind.

    Kinds that do not occur are omitted.
    """
    numbers = np.bincount(verdicts["kind"], minlength=len(Kind))
    return {kind: int(numbers[kind]) for kind in Kind if numbers[kind]}
