"""Comparison with other packages: nanoseconds per product of two arrays, and first hits of trimesh with Embree.

    pip install crossbar-gi gfloat ml_dtypes apytypes trimesh embreex
    python python/benches/compare.py

Prints the tables of docs/python.md. Times are processor times on one thread, from the shortest of several runs.
"""

import importlib.metadata
import os

# Must be set before the package starts its threads.
os.environ["RAYON_NUM_THREADS"] = "1"

import sys
import time

import numpy as np

import crossbar_gi as cg

N = 100_000


def shortest(work, seconds=1.0):
    """The time of the shortest of several runs, in nanoseconds per element."""
    best, end = float("inf"), time.perf_counter() + seconds
    while time.perf_counter() < end:
        start = time.process_time()
        work()
        best = min(best, time.process_time() - start)
    return 1e9 * best / N


def version(package):
    return f"{package} {importlib.metadata.version(package)}"


def products():
    """Products of 100,000 pairs in fp16, e4m3fn, and s3.12 rounded down; operands have the same format."""
    import apytypes
    import gfloat
    import ml_dtypes
    from gfloat.formats import format_info_binary16, format_info_ocp_e4m3

    r = np.random.default_rng(1)
    print("| format | package | ns per element |\n|---|---|---|")
    for name, dtype, info in [
        ("fp16", np.float16, format_info_binary16),
        ("e4m3fn", ml_dtypes.float8_e4m3fn, format_info_ocp_e4m3),
    ]:
        x, y = (cg.round(r.standard_normal(N), name) for _ in range(2))
        a, b, bits = x.astype(dtype), y.astype(dtype), cg.to_bits(x, name)
        rows = [
            (version("crossbar-gi"), lambda: cg.mul(x, y, name)),
            (version("crossbar-gi") + ", bit patterns", lambda: cg.mul(bits, bits, name)),
            (version("gfloat"), lambda: gfloat.round_ndarray(info, x * y)),
            (version("numpy") if dtype is np.float16 else version("ml_dtypes"), lambda: a * b),
        ]
        exponent, mantissa = (5, 10) if name == "fp16" else (4, 3)
        u, v = (apytypes.APyFloatArray.from_array(z, exponent, mantissa) for z in (x, y))
        rows.append((version("apytypes") + (" (IEEE layout)" if name == "e4m3fn" else ""), lambda: u * v))
        for package, work in rows:
            print(f"| {name} | {package} | {shortest(work):.2f} |")
    x, y = (cg.round(8 * r.random(N) - 4, "s3.12:rdn") for _ in range(2))
    u, v = (apytypes.APyFixedArray.from_float(z, int_bits=4, frac_bits=12) for z in (x, y))
    cut = dict(int_bits=4, frac_bits=12, quantization=apytypes.QuantizationMode.TRN, overflow=apytypes.OverflowMode.SAT)
    print(f"| s3.12:rdn | {version('crossbar-gi')} | {shortest(lambda: cg.mul(x, y, 's3.12:rdn')):.2f} |")
    print(f"| s3.12:rdn | {version('apytypes')}, product and cast | {shortest(lambda: (u * v).cast(**cut)):.2f} |")
    theirs, ours = (u * v).cast(**cut).to_numpy(), cg.mul(x, y, "s3.12:rdn")
    assert (theirs == ours).all(), "apytypes and crossbar_gi agree on fixed point"


def first_hits():
    """Compare exact first hits with Embree's (single precision), for ordinary and hard rays on a trimesh sphere."""
    import trimesh
    from trimesh.ray.ray_pyembree import RayMeshIntersector

    mesh = trimesh.creation.icosphere(subdivisions=5)
    oracle = cg.oracle(mesh.vertices, mesh.faces)
    hard = cg.hard_rays(mesh.vertices, mesh.faces, 60_000, seed=1)
    r = np.random.default_rng(2)
    eyes = r.standard_normal((60_000, 3))
    eyes *= 3 / np.linalg.norm(eyes, axis=1, keepdims=True)
    plain = (eyes.astype(np.float32), (r.uniform(-1, 1, (60_000, 3)) - eyes).astype(np.float32))
    embree = RayMeshIntersector(mesh)
    print(f"\n{len(mesh.faces)} triangles; {version('trimesh')}, {version('embreex')}\n")
    print("| rays | package | µs per ray | wrong triangles | of these leaks | otherwise wrong | right for a ray nearby |")
    print("|---|---|---|---|---|---|---|")
    for name, origins, directions in [("ordinary", *plain), ("hard", hard.origins, hard.directions)]:
        for package, hits in [
            ("trimesh with Embree", lambda: embree.intersects_first(origins, directions)),
            ("crossbar_gi, exact", lambda: oracle.first_hits(origins, directions)["triangle"]),
        ]:
            spent = 1e-3 * shortest(hits) * N / len(origins)
            triangle = np.asarray(hits())
            # trimesh returns no t here, so only triangles are judged.
            verdicts = cg.oracle(mesh.vertices, mesh.faces, ulps=2**32 - 1).judge(
                origins, directions, triangle, np.ones(len(triangle), np.float32)
            )
            wrong = verdicts["kind"] != cg.Kind.RIGHT
            leaks = np.isin(verdicts["kind"], [kind for kind in cg.Kind if kind.is_leak])
            rounding = verdicts["rounding"] & wrong
            other = wrong & ~leaks & ~rounding
            print(
                f"| {len(origins)} {name} | {package} | {spent:.2f} | {wrong.sum()} | {leaks.sum()} | {other.sum()} "
                f"| {rounding.sum()} |"
            )


if __name__ == "__main__":
    print(f"Python {sys.version.split()[0]}, {version('numpy')}, {os.cpu_count()} cores\n")
    products()
    first_hits()
