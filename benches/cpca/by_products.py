"""The compression of benches/cpca by NumPy's matrix products: what `crossbar::prt::cpca::compress` is held against.

    python by_products.py SIGNAL.npy CLUSTERS VECTORS ITERATIONS [iterative|doubling]

Affine form; starts from points k * points // CLUSTERS. Prints the squared error, a checksum of the clusters and the
processor time, user and system, of all threads: of the whole, and of the products with what follows them.
"""

import os
import sys
import zlib

import numpy as np

BLOCK = 128
NO_ERROR = 2.0**-40
NO_EIGENVALUE = 2.0**-44


def spent():
    times = os.times()
    return times.user + times.system


def classified(points, means, vectors):
    """The best cluster of each point, the lowest of equals, and the squared error there.

    `vectors` is clusters x vectors x dimension, padded by zeros.
    """
    clusters, count, dimension = vectors.shape
    by_vector = [np.ascontiguousarray(vectors[:, v].T) for v in range(count)]
    offsets = [np.einsum("kj,kj->k", vectors[:, v], means) for v in range(count)]
    lengths, doubled = np.einsum("kj,kj->k", means, means), -2.0 * means.T
    best, least = np.empty(len(points), np.intp), np.empty(len(points))
    along, distances, errors = (np.empty((BLOCK, clusters)) for _ in range(3))
    for first in range(0, len(points), BLOCK):
        x = points[first : first + BLOCK]
        a, d, e = along[: len(x)], distances[: len(x)], errors[: len(x)]
        np.matmul(x, doubled, out=d)
        d += lengths
        d += np.einsum("pj,pj->p", x, x)[:, None]
        np.copyto(e, d)
        for rows, offset in zip(by_vector, offsets):
            np.matmul(x, rows, out=a)
            a -= offset
            a *= a
            e -= a
        d *= NO_ERROR
        e[e <= d] = 0.0
        here = e.argmin(axis=1)
        best[first : first + BLOCK] = here
        least[first : first + BLOCK] = e[np.arange(len(x)), here]
    return best, least


def fill_empty(best, least, clusters):
    sizes = np.bincount(best, minlength=clusters)
    worst = iter(np.argsort(-least, kind="stable"))
    for empty in np.flatnonzero(sizes == 0):
        for point in worst:
            if least[point] > 0.0 and sizes[best[point]] > 1:
                sizes[best[point]] -= 1
                sizes[empty] = 1
                best[point], least[point] = empty, 0.0
                break


def fit(points, best, means, vectors, count, changed):
    """Means and vectors of the clusters whose points have changed."""
    order = np.argsort(best, kind="stable")
    ends = np.searchsorted(best[order], np.arange(len(means) + 1))
    for cluster in np.flatnonzero(changed):
        members = points[order[ends[cluster] : ends[cluster + 1]]]
        if len(members) == 0:
            continue
        means[cluster] = members.mean(axis=0)
        vectors[cluster] = 0.0
        if count and len(members) > 1:
            residuals = members - means[cluster]
            if len(members) >= points.shape[1]:
                values, found = np.linalg.eigh(residuals.T @ residuals)
                found = found.T
            else:
                values, found = np.linalg.eigh(residuals @ residuals.T)
                found = (residuals.T @ found).T
                found = np.linalg.qr(found[::-1][:count].T)[0].T[::-1]
                values = values[-len(found) :]
            values, found = values[::-1][:count], found[::-1][:count]
            kept = int((values > values[0] * NO_EIGENVALUE).sum()) if values[0] > 0.0 else 0
            vectors[cluster, :kept] = found[:kept]


def compressed(points, clusters, growth, iterations):
    count, dimension = len(points), points.shape[1]
    means = points[np.arange(clusters) * count // clusters].copy()
    vectors = np.zeros((clusters, 0, dimension))
    best, least, in_products, steps = np.full(count, -1), None, 0.0, 0
    for number in growth:
        if number:
            vectors = np.zeros((clusters, number, dimension))
            fit(points, best, means, vectors, number, np.ones(clusters, bool))
        for _ in range(iterations):
            start = spent()
            now, least = classified(points, means, vectors)
            in_products += spent() - start
            steps += 1
            fill_empty(now, least, clusters)
            moved = now != best
            if not moved.any():
                break
            changed = np.zeros(clusters, bool)
            changed[now[moved]] = True
            changed[best[moved & (best >= 0)]] = True
            best = now
            fit(points, best, means, vectors, number, changed)
    return best, means, vectors, in_products, steps


def main():
    path, clusters, vectors, iterations = sys.argv[1], *map(int, sys.argv[2:5])
    method = sys.argv[5] if len(sys.argv) > 5 else "iterative"
    points = np.load(path).astype(np.float64)
    growth = list(range(vectors + 1))
    if method == "doubling":
        growth = [0] + [n for n in (1 << i for i in range(16)) if n < vectors] + [vectors]
    start = spent()
    best, means, found, in_products, steps = compressed(points, clusters, growth, iterations)
    whole = spent() - start
    residuals = points - means[best]
    along = np.einsum("pvj,pj->pv", found[best], residuals) if len(points) < 50_000 else 0.0
    error = (residuals**2).sum() - (along**2).sum()
    checksum = zlib.crc32(best.astype("<u4").tobytes())
    print(f"classifications {steps} error {error:.12e} clusters {checksum:08x}")
    print(f"processor time {whole:.2f} s, {in_products:.2f} s of it products")


if __name__ == "__main__":
    main()
