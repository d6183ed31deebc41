"""Matrix units: test vectors from models and GPUs, products compared with dot products, errors."""

import csv

import numpy as np
import pytest

import crossbar_gi as cg


def codes(text, digits):
    return np.array([int(text[at : at + digits], 16) for at in range(0, len(text), digits)], dtype=np.uint64)


def uniform(seed, *shape):
    return np.random.default_rng(seed).random(shape, dtype=np.float32) * 448


def test_units_are_those_of_the_program():
    units = cg.units()
    assert len(units) == 36 and units[0]["name"] == "volta_f16_f32"
    (hopper,) = [unit for unit in units if unit["name"] == "hopper_fp8_f32"]
    assert (hopper["types"], hopper["block"], hopper["bits_kept"]) == (["e4m3", "e5m2"], 32, 13)


@pytest.mark.parametrize(
    "unit, digits",
    [("volta_f16_f32_c16", 4), ("hopper_f16_f16", 4), ("hopper_fp8_f32", 2), ("blackwell_nvf4", 1), ("fma_f64", 16)],
)
def test_dot_gives_the_results_of_the_vectors(unit, digits):
    with open(f"refsim/lanes/tests/matrix_vectors/{unit}.csv") as file:
        for row in list(csv.DictReader(file))[:100]:
            x, y = (codes(row[side], digits) for side in "ab")
            types = (row["ta"], row["tb"]) if "ta" in row else None
            scales = tuple(codes(row[side], 2) for side in ("sa", "sb")) if "sa" in row else None
            # If c is in half precision, its words in the vectors have other bits above it.
            c = codes(row["c"], 16)[0] & np.uint64(0xFFFF if unit.endswith("16") else 2**64 - 1)
            found = cg.dot(x, y, unit=unit, c=c, types=types, scales=scales)
            if row["result"] == "nan":
                assert np.isnan(found)
            else:
                assert found.view(f"u{found.itemsize}") == int(row["result"], 16)


def test_a_product_is_its_dot_products():
    a, b = uniform(1, 5, 100), uniform(2, 100, 19)
    c = np.arange(95, dtype=np.float32).reshape(5, 19)
    for unit, dtype in [("hopper-fp8", np.float32), ("hopper-f16-f16", np.float16), ("cdna3-fp8", np.float32)]:
        product = cg.matmul(a, b, c, unit)
        assert product.dtype == dtype
        np.testing.assert_array_equal(product, cg.dot(a[:, None], b.T, unit=unit, c=c))
    bits = cg.to_bits(a, "e4m3fn:sat")
    np.testing.assert_array_equal(cg.matmul(bits, b, c, types="e4m3"), cg.matmul(a, b, c))


def test_promotion_adds_parts_in_single_precision():
    a, b = uniform(3, 8, 1024), uniform(4, 1024, 8)
    parts = [cg.matmul(a[:, k : k + 128], b[k : k + 128]) for k in range(0, 1024, 128)]
    np.testing.assert_array_equal(cg.matmul(a, b, promote=128), sum(parts, np.float32(0)))
    exact = cg.round(a, "e4m3fn:sat") @ cg.round(b, "e4m3fn:sat")
    errors = [np.abs(cg.matmul(a, b, **how) / exact - 1).max() for how in ({}, {"promote": 128}, {"bits": 25})]
    assert errors[0] > 5 * max(errors[1:])


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda: cg.matmul([[1.0]], [[1.0]], unit="pascal"), "matrix unit: expected volta_f16_f32"),
        (lambda: cg.matmul([1.0], [[1.0]]), r"a: shape: expected two axes with at least one element each, found \[1\]"),
        (lambda: cg.matmul(np.ones((2, 3)), np.ones((2, 3))), r"b: shape: expected 3 rows.*found \[2, 3\]"),
        (lambda: cg.matmul(np.ones((0, 3)), np.ones((3, 2))), "at least one element"),
        (lambda: cg.matmul([[1.0]], [[1.0]], promote=48), "expected a multiple of 32, its block, found 48"),
        (lambda: cg.matmul([[1.0]], [[1.0]], types="e2m1"), "type of hopper_fp8_f32: expected e4m3 e5m2, found e2m1"),
        (lambda: cg.matmul([[1.0]], [[1.0]], bits=61), "expected 1 to 60"),
        (lambda: cg.matmul([[np.nan]], [[1.0]], unit="blackwell-f8f6f4", types="e2m1"), "e2m1 has no NaN"),
        (lambda: cg.matmul([["x"]], [[1.0]]), "expected numbers in a"),
        (lambda: cg.matmul(np.array([[256]], dtype=np.uint16), [[1.0]]), "expected patterns of e4m3, found 100"),
        (lambda: cg.dot([1.0], [1.0, 2.0, 3.0], unit="hopper-f16", c=[1.0, 2.0]), "broadcast"),
        (lambda: cg.dot([1.0], [1.0], unit="blackwell-nvf4"), "scales of a of blackwell_nvf4: expected 1, found 0"),
        (lambda: cg.dot([1.0], [1.0], "fp16", unit="hopper-f16"), "leave format, order and accumulator out"),
        (lambda: cg.dot([1.0], [1.0]), "expected a format, or a unit"),
        (lambda: cg.dot([1.0], [1.0], "fp16", c=1.0), "need a unit"),
    ],
)
def test_errors_say_what_was_expected(call, message):
    with pytest.raises(ValueError, match=message):
        call()
