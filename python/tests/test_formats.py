"""Arithmetic: comparison with NumPy's types and with an independent rounding, edge cases, errors."""

import fractions
import math

import numpy as np
import pytest

import crossbar_gi as cg


def rng(seed):
    return np.random.default_rng(seed)


def numbers(seed, n=4000):
    """Doubles of many sizes, including ties and the ends of ranges."""
    r = rng(seed)
    plain = r.standard_normal(n) * 2.0 ** r.integers(-20, 20, n)
    halves = r.integers(-2**13, 2**13, n) / 2.0**12
    ends = np.array([0.0, -0.0, 1.0, 65504.0, 65519.999, 65520.0, 6e-8, 2.0**-25, 2.0**-24, math.inf, -math.inf])
    return np.concatenate([plain, halves, ends, 8.0 * r.random(n)])


@pytest.mark.parametrize("name, dtype", [("fp16", np.float16), ("fp32", np.float32)])
def test_ieee_formats_are_numpy_s_types(name, dtype):
    x, y = numbers(1), rng(2).permutation(numbers(3))
    with np.errstate(all="ignore"):
        a, b = x.astype(dtype), y.astype(dtype)
        for ours, theirs in [
            (cg.round(x, name), a),
            (cg.add(x, y, name), a + b),
            (cg.sub(x, y, name), a - b),
            (cg.mul(x, y, name), a * b),
            (cg.div(x, y, name), a / b),
            (cg.sqrt(np.abs(x), name), np.sqrt(np.abs(a))),
        ]:
            np.testing.assert_array_equal(ours, theirs.astype(np.float64))
            assert (np.signbit(ours) == np.signbit(theirs))[~np.isnan(ours)].all()


def down(x):
    """Rounding to s3.12:rdn, computed with fractions."""
    units = math.floor(fractions.Fraction(x) * 4096)
    return max(min(units, 2**15 - 1), -(2**15)) / 4096


def test_fixed_point_is_the_exact_result_rounded_once():
    x, y, z = ((rng(seed).integers(-(2**15), 2**15, 500) / 4096).tolist() for seed in (4, 5, 6))
    f = fractions.Fraction
    pairs = list(zip(x, y, z))
    assert cg.mul(x, y, "s3.12:rdn").tolist() == [down(f(a) * f(b)) for a, b, _ in pairs]
    assert cg.fma(x, y, z, "s3.12:rdn").tolist() == [down(f(a) * f(b) + f(c)) for a, b, c in pairs]
    assert cg.mad(x, y, z, "s3.12:rdn").tolist() == [down(f(down(f(a) * f(b))) + f(c)) for a, b, c in pairs]
    quotients = [down(f(a) / f(b)) for a, b, _ in pairs if b]
    assert [q for q, b in zip(cg.div(x, y, "s3.12:rdn").tolist(), y) if b] == quotients


def test_operands_are_rounded_first():
    # A third is 0x0555 in s3.12.
    assert cg.mul(1 / 3, 3, "s3.12:rtz") == 3 * 0x555 / 4096
    assert cg.round([1 / 3, -1 / 3], "s3.12:rdn").tolist() == [0x555 / 4096, -0x556 / 4096]


@pytest.mark.parametrize("name", ["s3.12:rdn", "fp16:rtz", "e4m3fn", "n3.8", "bf16:ftz", "e8m0", "fp24:rup", "s0.31"])
def test_numbers_and_patterns_agree(name):
    r, width = rng(7), cg.Format(name).bits
    a, b = (r.integers(0, 2**width, 2000, dtype=np.uint64).astype(cg.to_bits(1, name).dtype) for _ in range(2))
    x, y = cg.from_bits(a, name), cg.from_bits(b, name)
    for operation in (cg.add, cg.mul, cg.div):
        bits = operation(a, b, name)
        assert bits.dtype == a.dtype
        np.testing.assert_array_equal(cg.from_bits(bits, name), operation(x, y, name))
    if ":ftz" not in name:
        finite = np.isfinite(x)
        np.testing.assert_array_equal(cg.to_bits(x, name)[finite], a[finite])
    ordinary = x[np.isfinite(x) & (np.abs(x) > 1e-30)]
    np.testing.assert_array_equal(cg.round(ordinary, name), ordinary)


def test_shapes_broadcast_as_numpy_s():
    column, row = rng(8).random((300, 1)) * 4, rng(9).random((1, 257)) * 4
    whole = cg.mul(*np.broadcast_arrays(column, row), "s3.12:rdn")
    assert whole.shape == (300, 257)
    np.testing.assert_array_equal(cg.mul(column, row, "s3.12:rdn"), whole)
    cube = rng(10).random((3, 4, 500))
    np.testing.assert_array_equal(cg.add(cube, cube[:, :1], "fp16"), cg.add(cube, np.repeat(cube[:, :1], 4, 1), "fp16"))
    turned = np.asfortranarray(rng(11).random((200, 300)))
    straight = turned.copy("C")
    np.testing.assert_array_equal(cg.mul(turned, straight, "fp16"), cg.mul(straight, straight, "fp16"))
    np.testing.assert_array_equal(cg.mul(turned[::-2, ::3], 2, "fp16"), cg.mul(turned[::-2, ::3].copy(), 2.0, "fp16"))
    assert cg.mul(2, 3, "fp16") == 6.0 and isinstance(cg.mul(2, 3, "fp16"), float)
    assert cg.add(np.empty((0, 3)), 1, "fp16").shape == (0, 3)
    assert cg.add(np.ones((1, 1)), 1, "fp16").shape == (1, 1)


def test_large_arrays_are_the_same_on_many_threads():
    x = rng(12).standard_normal(1 << 20)
    whole = cg.mul(x, x, "e5m10:rtz")
    pieces = np.concatenate([cg.mul(part, part, "e5m10:rtz") for part in np.array_split(x, 101)])
    np.testing.assert_array_equal(whole, pieces)


def test_formats_know_their_ends():
    half = cg.Format("e5m10:rtz")
    assert (half.name, half.bits, half.max, half.min) == ("e5m10:rtz", 16, 65504.0, -65504.0)
    assert (half.smallest, half.smallest_normal, half.epsilon) == (2.0**-24, 2.0**-14, 2.0**-10)
    assert half.has_nan and half.has_infinity and not half.is_fixed
    fixed = cg.Format("ps14")
    assert (fixed.name, fixed.max, fixed.min, fixed.epsilon) == ("s3.12", 8 - 2.0**-12, -8.0, 2.0**-12)
    assert not fixed.has_nan and fixed.is_fixed
    assert cg.Format("e4m3fn").max == 448.0 and not cg.Format("e4m3fn").has_infinity
    assert str(half) == "e5m10:rtz" and half == cg.Format("e5m10:rtz")


def test_tables_have_every_value():
    table = cg.Format("e2m1fn").table()
    assert table["value"][:8].tolist() == [0.0, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0]
    for name in ("e4m3fn", "s3.4", "n2.5", "e5m2", "fp16"):
        form = cg.Format(name)
        table = form.table()
        assert len(table) == 2**form.bits
        finite = table["value"][np.isfinite(table["value"])]
        assert finite.max() == form.max and finite.min() == form.min
        assert finite[finite > 0].min() == form.smallest
    with pytest.raises(ValueError, match="expected a format of at most 20 bits for a table, found e7m16 of 24"):
        cg.Format("fp24").table()


def test_stochastic_rounding_is_unbiased_and_repeats():
    x = np.full(40_000, 1 + 0.25 / 1024)
    rounded = cg.round(x, "fp16:rst", seed=3)
    assert set(rounded.tolist()) == {1.0, 1 + 1 / 1024}
    assert abs(rounded.mean() - x[0]) < 0.02 / 1024
    np.testing.assert_array_equal(rounded, cg.round(x, "fp16:rst", seed=3))
    assert (rounded != cg.round(x, "fp16:rst", seed=4)).any()


def test_dot_products():
    x, y = np.array([2048.0, 1.0, 1.0]), np.ones(3)
    assert cg.dot(x, y, "fp16") == 2048.0
    assert cg.dot(x, y, "fp16", accumulator="fp32") == 2050.0
    assert cg.dot(x, y, "fp16", order="exact") == 2050.0
    many = rng(13).standard_normal((50, 17))
    exact = cg.dot(many, many, "fp16", order="exact")
    half = many.astype(np.float16).astype(np.float64)
    np.testing.assert_array_equal(exact, np.sum(half * half, axis=-1).astype(np.float16).astype(np.float64))
    # The order `sequential` adds step by step.
    total = cg.mul(many[:, 0], many[:, 0], "fp16")
    for k in range(1, 17):
        total = cg.add(total, cg.mul(many[:, k], many[:, k], "fp16"), "fp16")
    np.testing.assert_array_equal(cg.dot(many, many, "fp16"), total)
    bits = cg.to_bits(many, "fp16")
    np.testing.assert_array_equal(cg.from_bits(cg.dot(bits, bits, "fp16"), "fp16"), total)
    assert cg.dot(many, many[0], "fp16").shape == (50,)


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda: cg.mul([1.0], [1.0], "s3_12"), "number format `s3_12`: expected a layout"),
        (lambda: cg.mul([1.0], [1.0], "s3.12:inf"), "`:inf` at character 5 is for floats only"),
        (
            lambda: cg.mul([[1.0, math.nan]], 2.0, "s3.12"),
            r"expected numbers, found NaN in x\[0, 1\]: the format s3.12 has no NaN",
        ),
        (lambda: cg.add(1.0, math.nan, "e2m1fn"), "expected numbers, found NaN in y: the format e2m1fn has no NaN"),
        (
            lambda: cg.add(np.ones(3), np.ones(4), "fp16"),
            r"expected shapes that broadcast together, found \(3,\) and \(4,\)",
        ),
        (
            lambda: cg.add(np.ones(3), np.ones(3, np.uint16), "fp16"),
            r"expected numbers, or bit patterns \(unsigned integers\) in all operands, found float64 and uint16",
        ),
        (lambda: cg.add(["a"], [1.0], "fp16"), "expected numbers in x, found an array of <U1"),
        (
            lambda: cg.add(np.array([1, 0x1234], np.uint16), np.uint16(1), "e4m3fn"),
            "expected patterns of 8 bits for e4m3fn, found 0x1234 in x",
        ),
        (lambda: cg.from_bits([1, 2], "fp16"), "expected bit patterns as unsigned integers, found an array of int64"),
        (lambda: cg.dot(1.0, 2.0, "fp16"), "expected arrays with an axis to sum along, found a single number"),
        (
            lambda: cg.dot([1.0], [2.0], "fp16", order="any"),
            "expected the order sequential, tree, exact, or aligned:F with F from 0 to 28, found `any`",
        ),
        (lambda: cg.dot([1.0], [2.0], "fp16:rst"), "a dot product rounds more than once, and `:rst` has one word"),
    ],
)
def test_errors_say_what_was_expected(call, message):
    with pytest.raises(ValueError, match=message):
        call()


def test_nan_is_a_number_where_the_format_has_one():
    assert math.isnan(cg.add(math.nan, 1.0, "fp16"))
    # An infinity is not a NaN: fixed point turns it into an end of its range.
    assert cg.round([math.inf, -math.inf], "s3.12").tolist() == [cg.Format("s3.12").max, -8.0]
