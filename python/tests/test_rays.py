"""The oracle: exact hits, verdicts, errors."""

import fractions
import os
import signal
import threading
import time

import numpy as np
import pytest

import crossbar_gi as cg

SQUARE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], np.float64)
FACES = np.array([[0, 1, 2], [0, 2, 3]])


def sphere(rings=24, segments=48):
    """Vertices and faces of a closed mesh."""
    theta = np.pi * np.arange(1, rings) / rings
    phi = 2 * np.pi * np.arange(segments) / segments
    ring = np.stack([np.outer(np.sin(theta), np.cos(phi)), np.outer(np.sin(theta), np.sin(phi))], -1).reshape(-1, 2)
    points = np.column_stack([ring, np.repeat(np.cos(theta), segments)])
    vertices = np.concatenate([[[0, 0, 1.0]], points, [[0, 0, -1.0]]])
    at = lambda r, s: 1 + r * segments + s % segments
    faces = [[0, at(0, s), at(0, s + 1)] for s in range(segments)]
    for r in range(rings - 2):
        for s in range(segments):
            faces += [[at(r, s), at(r + 1, s), at(r + 1, s + 1)], [at(r, s), at(r + 1, s + 1), at(r, s + 1)]]
    last = len(vertices) - 1
    faces += [[at(rings - 2, s + 1), at(rings - 2, s), last] for s in range(segments)]
    return vertices, np.array(faces)


def moeller_trumbore(vertices, faces, origins, directions):
    """The textbook test in float32, on each ray and each triangle: the nearest triangle (-1 for none) and its t."""
    a, b, c = (vertices[faces[:, k]].astype(np.float32) for k in range(3))
    e1, e2 = b - a, c - a
    triangle, best = np.full(len(origins), -1), np.full(len(origins), np.inf, np.float32)
    for i, (o, d) in enumerate(zip(origins, directions)):
        with np.errstate(all="ignore"):
            p = np.cross(d, e2)
            inverse = np.float32(1) / np.einsum("ij,ij->i", e1, p)
            s = o - a
            u = np.einsum("ij,ij->i", s, p) * inverse
            q = np.cross(s, e1)
            v = (q @ d) * inverse
            t = np.einsum("ij,ij->i", e2, q) * inverse
            t = np.where((u >= 0) & (v >= 0) & (u + v <= 1) & (t >= 0), t, np.inf)
        k = int(np.argmin(t))
        if t[k] < np.inf:
            triangle[i], best[i] = k, t[k]
    return triangle, best


def test_exact_hits_of_a_square():
    o = cg.oracle(SQUARE, FACES)
    origins = [[0.75, 0.25, 2], [0.5, 0.5, 2], [2, 2, 2], [0.75, 0.25, -2]]
    directions = [[0, 0, -1], [0, 0, -4], [0, 0, -1], [0, 0, 1]]
    hits = o.first_hits(origins, directions)
    assert hits["triangle"].tolist() == [0, 0, -1, 0]
    assert hits["ties"].tolist() == [1, 2, 0, 1]
    assert hits["t"][:2].tolist() == [2.0, 0.5] and np.isnan(hits["t"][2])
    # From behind, there is a hit only if both sides count.
    front = cg.oracle(SQUARE, FACES, sides="front").first_hits(origins, directions)
    assert front["triangle"].tolist() == [0, 0, -1, -1]


def test_t_is_the_nearest_double_to_the_fraction():
    r = np.random.default_rng(1)
    corners = r.standard_normal((3, 3)).astype(np.float32)
    weights = r.dirichlet(np.ones(3), 200)
    origins = r.standard_normal((200, 3)).astype(np.float32)
    directions = ((weights @ corners) - origins).astype(np.float32)
    hits = cg.oracle(corners, [[0, 1, 2]]).first_hits(origins, directions)
    f = fractions.Fraction
    cross = lambda x, y: [x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]]
    dot = lambda x, y: sum(a * b for a, b in zip(x, y))
    a, b, c = ([f(float(x)) for x in corner] for corner in corners)
    n = cross([x - y for x, y in zip(b, a)], [x - y for x, y in zip(c, a)])
    assert (hits["triangle"] == 0).sum() > 150
    for i in np.flatnonzero(hits["triangle"] == 0):
        o, d = ([f(float(x)) for x in vector] for vector in (origins[i], directions[i]))
        assert hits["t"][i] == float(dot(n, [x - y for x, y in zip(a, o)]) / dot(n, d))


def test_every_kind_of_verdict_has_its_name():
    assert [kind.name.lower().replace("_", " ") for kind in cg.Kind] == [
        name.replace("leak through to what is behind", "leak through") for name in cg._native.kinds()
    ]
    assert [aim.name.lower() for aim in cg.Aim] == cg._native.aims()


def test_verdicts():
    o = cg.oracle(SQUARE, FACES)
    origins, directions = np.tile([[0.75, 0.25, 2.0]], (6, 1)), np.tile([[0, 0, -1.0]], (6, 1))
    found = o.judge(origins, directions, [0, -1, 1, 7, 0, 0], [2, 0, 2, 2, 2.001, np.nan])
    kind = cg.Kind
    wrong = [kind.LEAK, kind.WRONG_NEIGHBOUR, kind.NO_SUCH_TRIANGLE, kind.T_OFF, kind.T_OFF]
    assert found["kind"].tolist() == [kind.RIGHT, *wrong]
    assert (found["triangle"] == 0).all() and (found["t"] == 2.0).all()
    assert found["ulps"].tolist()[:2] == [0, -1] and found["ulps"][4] > 4 and found["ulps"][5] == -1
    ones = {kind.RIGHT: 1, kind.NO_SUCH_TRIANGLE: 1, kind.LEAK: 1, kind.WRONG_NEIGHBOUR: 1}
    assert cg.counts(found) == {**ones, kind.T_OFF: 2}
    # On the diagonal either triangle is right.
    both = o.judge([[0.5, 0.5, 2]] * 2, [[0, 0, -1]] * 2, [0, 1], [2, 2])
    assert (both["kind"] == cg.Kind.RIGHT).all() and (both["ties"] == 2).all()
    loose = cg.oracle(SQUARE, FACES, ulps=2**32 - 1)
    assert loose.judge(origins[:1], directions[:1], [0], [9])["kind"] == kind.RIGHT


def test_the_exact_answer_is_right_and_the_textbook_test_leaks():
    vertices, faces = sphere()
    rays = cg.hard_rays(vertices, faces, 3000, seed=1)
    assert 2500 < len(rays.origins) <= 3000 and set(rays.aims.tolist()) == {1, 2, 3, 4, 5, 6}
    assert rays.origins.dtype == np.float32 and rays.origins.shape == rays.directions.shape
    np.testing.assert_array_equal(rays.directions, cg.hard_rays(vertices, faces, 3000, seed=1).directions)
    # t is rounded twice, to float64 and then to float32, so it is sometimes one step off.
    o = cg.oracle(vertices, faces, ulps=1)
    hits = o.first_hits(rays.origins, rays.directions)
    exact = o.judge(rays.origins, rays.directions, hits["triangle"], hits["t"], rays.aims)
    assert (exact["kind"] == cg.Kind.RIGHT).all() and (exact["aim"] == rays.aims).all()
    found = moeller_trumbore(vertices, faces, rays.origins, rays.directions)
    verdicts = cg.oracle(vertices, faces).judge(rays.origins, rays.directions, *found, rays.aims)
    leaks = np.isin(verdicts["kind"], [kind for kind in cg.Kind if kind.is_leak])
    assert leaks.sum() > 10, cg.counts(verdicts)
    # A leak is a missed hit that rounding does not explain.
    assert (verdicts["triangle"][leaks] >= 0).all() and not verdicts["rounding"][leaks].any()
    text = cg.oracle(vertices, faces).report(rays.origins, rays.directions, *found, rays.aims)
    assert f"of {len(rays.origins)} rays disagree" in text and "let triangle" in text


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda: cg.oracle(SQUARE[:, :2], FACES), r"expected vertices of shape \(n, 3\), found \(4, 2\)"),
        (lambda: cg.oracle(SQUARE, FACES.T), r"expected faces of shape \(m, 3\), found \(3, 2\)"),
        (
            lambda: cg.oracle(np.where(SQUARE == 1, np.nan, SQUARE), FACES),
            r"expected finite vertices, found nan in vertices\[1, 0\] \(as float32\)",
        ),
        (lambda: cg.oracle(SQUARE * 1e39, FACES), r"expected finite vertices, found 1e\+39 in vertices\[1, 0\]"),
        (
            lambda: cg.oracle(SQUARE, FACES + 2),
            r"expected indices below 4 \(counted from 0\), found 4 in faces\[0, 2\]",
        ),
        (lambda: cg.oracle(SQUARE, FACES - 1), r"found -1 in faces\[0, 0\]"),
        (lambda: cg.oracle(SQUARE, FACES * 1.0), "expected faces as integers, found an array of float64"),
        (lambda: cg.oracle(SQUARE, FACES, sides="back"), 'expected sides "both" or "front", found "back"'),
        (lambda: cg.oracle(SQUARE, FACES, absolute=-1), "expected an absolute tolerance of 0 or more, found -1"),
        (lambda: cg.oracle(SQUARE, FACES).first_hits([0, 0, 1], [0, 0, 1]), r"origins of shape \(n, 3\), found \(3,\)"),
        (
            lambda: cg.oracle(SQUARE, FACES).first_hits(SQUARE, SQUARE[:2]),
            "expected a direction for each origin, found 4 and 2",
        ),
        (
            lambda: cg.oracle(SQUARE, FACES).first_hits(SQUARE, SQUARE),
            r"ray 0: expected a direction, found \(0, 0, 0\)",
        ),
        (
            lambda: cg.oracle(SQUARE, FACES).judge(SQUARE[1:], SQUARE[1:], [0, 0], [1, 1, 1]),
            "expected a triangle for each of 3 rays, found 2",
        ),
        (
            lambda: cg.oracle(SQUARE, FACES).judge(SQUARE[1:], SQUARE[1:], [0.0] * 3, [1] * 3),
            "expected triangles as integers, found an array of float64",
        ),
        (lambda: cg.hard_rays(SQUARE, FACES, 5), "expected 6 rays or more and a seed of 0 or more, found 5 and 0"),
    ],
)
def test_errors_say_what_was_expected(call, message):
    with pytest.raises(ValueError, match=message):
        call()


def test_an_empty_mesh_and_no_rays():
    o = cg.oracle(np.empty((0, 3)), np.empty((0, 3), int))
    assert o.first_hits(SQUARE, SQUARE + 1)["triangle"].tolist() == [-1] * 4
    assert len(cg.oracle(SQUARE, FACES).first_hits(np.empty((0, 3)), np.empty((0, 3)))) == 0
    assert len(cg.hard_rays(np.empty((0, 3)), np.empty((0, 3), int), 60).origins) == 0


def test_other_threads_run_meanwhile():
    vertices, faces = sphere(60, 120)
    rays = cg.hard_rays(vertices, faces, 120_000, seed=3)
    o = cg.oracle(vertices, faces)
    ticks, done = [], threading.Event()

    def tick():
        while not done.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.001)

    thread = threading.Thread(target=tick)
    thread.start()
    start = time.perf_counter()
    o.first_hits(rays.origins, rays.directions)
    end = time.perf_counter()
    done.set()
    thread.join()
    assert sum(start < tick < end for tick in ticks) >= 3, f"{len(ticks)} ticks in {end - start} s"


def test_ctrl_c_ends_long_work():
    vertices, faces = sphere(60, 120)
    rays = cg.hard_rays(vertices, faces, 60_000, seed=4)
    o = cg.oracle(vertices, faces)
    start = time.perf_counter()
    o.first_hits(rays.origins, rays.directions)
    once = time.perf_counter() - start
    # One call of four seconds or more, which a signal interrupts after a fraction of a second.
    many = [np.tile(part, (int(4 / once) + 2, 1)) for part in (rays.origins, rays.directions)]
    timer = threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    start = time.perf_counter()
    with pytest.raises(KeyboardInterrupt):
        o.first_hits(*many)
    assert time.perf_counter() - start < 3
