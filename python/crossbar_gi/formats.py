"""Number formats: the numbers of a format, and arithmetic in it.

A format is a string, with one syntax for all of Crossbar: ``s3.12`` (fixed point), ``n3.8`` (normalized integers),
``e5m10`` (float), ``e4m3fn`` (float without infinity), ``e8m0`` (powers of two), or an alias (``fp16``, ``bf16``,
``fp24``, ``fp32``, ``ps14``, ``fx12``), followed by rules: ``:rne :rna :rtz :rdn :rup :rod :rst`` (rounding),
``:sat :wrap :inf :nvovf`` (overflow), ``:keep :ftz`` (subnormals), ``:ieee :nv`` (special values).

Arrays of floats are numbers: they are first rounded into the format by its rules, and results are float64. Arrays of
*unsigned* integers have bit patterns of the format in their low bits, and so have the results. Shapes broadcast as in
NumPy. Each result is the exact result, rounded once, unless the function says otherwise.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native, matrix

#: Formats with more bits have no table, because it would have more than 2^20 rows.
MAX_TABLE_BITS = 20


@dataclass(frozen=True, slots=True)
class Format:
    """A number format, and facts about it.

    ``Format("e5m10:rtz")`` parses the string; numbers among the fields are float64.

    Raises:
        ValueError: if the string is not a format; the message says what is expected, and where.
    """

    #: The string, in its shortest form.
    name: str
    #: Width in bits.
    bits: int
    #: Largest finite number.
    max: float
    #: Most negative finite number.
    min: float
    #: Smallest positive number, including subnormal numbers.
    smallest: float
    #: Smallest positive number that is not subnormal.
    smallest_normal: float
    #: Distance from 1 to the next larger number; in fixed point, the distance between any two neighbors.
    epsilon: float
    #: True for fixed point and normalized integers.
    is_fixed: bool
    #: True if there is an infinity.
    has_infinity: bool
    #: True if there is a NaN.
    has_nan: bool

    def __init__(self, text: str) -> None:
        for name, value in _native.format_facts(text).items():
            object.__setattr__(self, name, value)

    def __str__(self) -> str:
        return self.name

    def table(self) -> NDArray[Any]:
        """Every value of the format: a structured array with ``bits`` and ``value``, in the order of the bits.

        Returns:
            Shape ``(2 ** bits,)``; patterns for NaN and infinity have these values.

        Raises:
            ValueError: if the format has more than 20 bits.
        """
        if self.bits > MAX_TABLE_BITS:
            found = f"found {self} of {self.bits}"
            raise ValueError(f"expected a format of at most {MAX_TABLE_BITS} bits for a table, {found}")
        table = np.empty(2**self.bits, dtype=[("bits", pattern_type(self)), ("value", np.float64)])
        table["bits"] = np.arange(2**self.bits)
        table["value"] = from_bits(table["bits"], self)
        return table


def pattern_type(format: Format | str) -> np.dtype[Any]:
    """The unsigned type that holds a format's bit patterns: uint8, uint16 or uint32."""
    bits = _format(format).bits
    return np.dtype(np.uint8 if bits <= 8 else np.uint16 if bits <= 16 else np.uint32)


def _format(format: Format | str) -> Format:
    if isinstance(format, Format):
        return format
    known = _KNOWN.get(format)
    if known is None:
        known = Format(format)
        if len(_KNOWN) < 256:
            _KNOWN[format] = known
    return known


#: Parsed formats, by their strings.
_KNOWN: dict[str, Format] = {}


def _patterns(name: str, array: NDArray[Any], format: Format) -> NDArray[np.uint32]:
    if format.bits < 32 and array.size and array.max() >> format.bits:
        at = np.argmax(array.reshape(-1) >> format.bits != 0)
        found = int(array.reshape(-1)[at])
        raise ValueError(f"expected patterns of {format.bits} bits for {format}, found {found:#x} in {name}")
    return array.astype(np.uint32, copy=False)


def _numbers(name: str, array: NDArray[Any]) -> NDArray[np.float64]:
    if array.dtype.kind not in "fiub":
        raise ValueError(f"expected numbers in {name}, found an array of {array.dtype}")
    return array.astype(np.float64, copy=False)


def _compute(operation: str, format: Format | str, seed: int, operands: tuple[ArrayLike, ...]) -> Any:
    known = _format(format)
    arrays = [np.asarray(operand) for operand in operands]
    try:
        shape = np.broadcast_shapes(*(array.shape for array in arrays))
    except ValueError:
        shapes = " and ".join(str(array.shape) for array in arrays)
        raise ValueError(f"expected shapes that broadcast together, found {shapes}") from None
    named = list(zip("xyz", arrays))
    unsigned = [array.dtype.kind == "u" for array in arrays]
    if all(unsigned):
        patterns = [_spread(_patterns(name, array, known), shape) for name, array in named]
        bits = np.empty(shape, np.uint32)
        _native.compute_patterns(operation, known.name, seed, patterns, bits)
        return bits.astype(pattern_type(known), copy=False)[()]
    if any(unsigned):
        kinds = " and ".join(str(array.dtype) for array in arrays)
        raise ValueError(f"expected numbers, or bit patterns (unsigned integers) in all operands, found {kinds}")
    numbers = [_spread(_numbers(name, array), shape) for name, array in named]
    out = np.empty(shape)
    _native.compute(operation, known.name, seed, numbers, out)
    return out[()]


def _spread(array: NDArray[Any], shape: tuple[int, ...]) -> NDArray[Any]:
    """View the array with a shape; arrays of a single element are unchanged."""
    return array if array.size == 1 or array.shape == shape else np.broadcast_to(array, shape)


def round(x: ArrayLike, format: Format | str, *, seed: int = 0) -> Any:
    """Round numbers into a format.

    Args:
        x: Numbers, any shape. (Bit patterns are returned unchanged, except that ``:ftz`` flushes subnormals.)
        format: The format. Under ``:rst``, element i (in C order) uses the i-th random word of the seed.
        seed: Seed of stochastic rounding.

    Returns:
        float64 numbers of the format, in the shape of ``x``, with infinities if the format has them.

    Raises:
        ValueError: if ``format`` is not a format, or ``x`` has a NaN but the format does not.
    """
    return _compute("round", format, seed, (x,))


def to_bits(x: ArrayLike, format: Format | str, *, seed: int = 0) -> Any:
    """Round numbers into a format, and return their bit patterns: uint8, uint16 or uint32, in the low bits.

    Raises:
        ValueError: as :func:`round`.
    """
    known = _format(format)
    numbers = _numbers("x", np.asarray(x))
    out = np.empty(numbers.shape, np.uint32)
    _native.to_patterns(known.name, seed, numbers, out)
    return out.astype(pattern_type(known), copy=False)[()]


def from_bits(bits: ArrayLike, format: Format | str) -> Any:
    """Convert bit patterns to the numbers that they represent, as float64; only normalized integers are rounded.

    Subnormal patterns keep their value in formats that flush them.

    Raises:
        ValueError: if ``bits`` are not unsigned integers, or are wider than the format.
    """
    known = _format(format)
    array = np.asarray(bits)
    if array.dtype.kind != "u":
        raise ValueError(f"expected bit patterns as unsigned integers, found an array of {array.dtype}")
    patterns = _patterns("bits", array, known)
    out = np.empty(patterns.shape)
    _native.from_patterns(known.name, patterns, out)
    return out[()]


def add(x: ArrayLike, y: ArrayLike, format: Format | str, *, seed: int = 0) -> Any:
    """``x + y``, rounded once. The module describes operands, results and errors."""
    return _compute("add", format, seed, (x, y))


def sub(x: ArrayLike, y: ArrayLike, format: Format | str, *, seed: int = 0) -> Any:
    """``x - y``, rounded once."""
    return _compute("sub", format, seed, (x, y))


def mul(x: ArrayLike, y: ArrayLike, format: Format | str, *, seed: int = 0) -> Any:
    """``x * y``, rounded once."""
    return _compute("mul", format, seed, (x, y))


def div(x: ArrayLike, y: ArrayLike, format: Format | str, *, seed: int = 0) -> Any:
    """``x / y``, rounded once. ``1 / 0`` gives infinity if the format has it, otherwise NaN, otherwise the end of the
    range (and always with ``:sat``). ``0 / 0`` gives NaN, or 0 in formats without NaN."""
    return _compute("div", format, seed, (x, y))


def fma(x: ArrayLike, y: ArrayLike, z: ArrayLike, format: Format | str, *, seed: int = 0) -> Any:
    """``x * y + z``, rounded once."""
    return _compute("fma", format, seed, (x, y, z))


def mad(x: ArrayLike, y: ArrayLike, z: ArrayLike, format: Format | str, *, seed: int = 0) -> Any:
    """``x * y + z``; the product is rounded, and so is the sum."""
    return _compute("mad", format, seed, (x, y, z))


def minimum(x: ArrayLike, y: ArrayLike, format: Format | str) -> Any:
    """``x`` where ``x < y``, else ``y``."""
    return _compute("minimum", format, 0, (x, y))


def maximum(x: ArrayLike, y: ArrayLike, format: Format | str) -> Any:
    """``x`` where ``x >= y``, else ``y``."""
    return _compute("maximum", format, 0, (x, y))


def floor(x: ArrayLike, format: Format | str) -> Any:
    """The largest whole number not above ``x``, rounded into the format."""
    return _compute("floor", format, 0, (x,))


def frac(x: ArrayLike, format: Format | str) -> Any:
    """``x - floor(x)``, rounded once."""
    return _compute("frac", format, 0, (x,))


def saturate(x: ArrayLike, format: Format | str) -> Any:
    """``x``, clamped to the range from 0 to 1."""
    return _compute("saturate", format, 0, (x,))


def rcp(x: ArrayLike, format: Format | str, *, seed: int = 0) -> Any:
    """``1 / x``, rounded once."""
    return _compute("rcp", format, seed, (x,))


def rsq(x: ArrayLike, format: Format | str, *, seed: int = 0) -> Any:
    """``1 / sqrt(|x|)``, rounded once; formats with ``:nv`` give NaN for negative numbers."""
    return _compute("rsq", format, seed, (x,))


def sqrt(x: ArrayLike, format: Format | str, *, seed: int = 0) -> Any:
    """Square root, rounded once."""
    return _compute("sqrt", format, seed, (x,))


def exp2(x: ArrayLike, format: Format | str, *, seed: int = 0) -> Any:
    """``2 ** x``, rounded once."""
    return _compute("exp2", format, seed, (x,))


def log2(x: ArrayLike, format: Format | str, *, seed: int = 0) -> Any:
    """Logarithm of ``|x|`` to base 2, rounded once; formats with ``:nv`` give NaN for negative numbers."""
    return _compute("log2", format, seed, (x,))


def dot(
    x: ArrayLike,
    y: ArrayLike,
    format: Format | str | None = None,
    *,
    order: str = "sequential",
    accumulator: Format | str | None = None,
    unit: str | None = None,
    c: ArrayLike = 0.0,
    types: str | tuple[str, str] | None = None,
    scales: tuple[ArrayLike, ArrayLike] | None = None,
) -> Any:
    """Sum of products along the last axis, in a format or in a matrix unit of a GPU.

    Args:
        x: Numbers of shape ``(..., n)``, or bit patterns.
        y: The same kind; the shapes broadcast.
        format: The format of operands and result.
        order: ``"sequential"``: ``((a + b) + c) + d``, or ``"tree"``: ``(a + b) + (c + d)``, where each product and
            each sum is rounded; ``"exact"``: the exact sum is rounded once; or ``"aligned:F"``, with F from 0 to
            28: products are rounded, and their aligned sum (docs/numbers.md) is rounded once.
        accumulator: The format in which products and sums are rounded; by default ``format``.
        unit: A unit of :func:`units`, instead of a format: rounding, types and results as in :func:`matmul`.
        c: Only with a unit: an addend, as numbers or bit patterns that broadcast to the result.
        types: Only with a unit that supports several types: the types of x and y, or one type for both.
        scales: Only with a unit that has scales: the scales of x and of y along the last axis, as bit patterns.

    Returns:
        Shape ``(...)``: float64 or bit patterns; with a unit, the unit's own type.

    Raises:
        ValueError: as :func:`round`; if an operand has no axis; under ``:rst``; if the unit does not support the types.
    """
    if unit is not None:
        if (format, order, accumulator) != (None, "sequential", None):
            raise ValueError("a unit has its own types and order: leave format, order and accumulator out")
        return matrix.dot(x, y, unit, c, types, scales)
    if format is None:
        raise ValueError("expected a format, or a unit (cg.units() lists them)")
    if types is not None or scales is not None or np.any(np.asarray(c) != 0):
        raise ValueError("c, types and scales need a unit")
    known, sums = _format(format), _format(format if accumulator is None else accumulator)
    arrays = [np.asarray(x), np.asarray(y)]
    if any(array.ndim == 0 for array in arrays):
        raise ValueError("expected arrays with an axis to sum along, found a single number")
    unsigned = [array.dtype.kind == "u" for array in arrays]
    if any(unsigned) and not all(unsigned):
        kinds = f"{arrays[0].dtype} and {arrays[1].dtype}"
        raise ValueError(f"expected numbers, or bit patterns in both operands, found {kinds}")
    try:
        shape = np.broadcast_shapes(arrays[0].shape, arrays[1].shape)
    except ValueError:
        shapes = f"{arrays[0].shape} and {arrays[1].shape}"
        raise ValueError(f"expected shapes that broadcast together, found {shapes}") from None
    numbers = [from_bits(array, known) if all(unsigned) else _numbers(name, array) for name, array in zip("xy", arrays)]
    left, right = (np.ascontiguousarray(np.broadcast_to(array, shape)) for array in numbers)
    out = np.empty(shape[:-1])
    _native.dot((known.name, sums.name), order, left, right, out)
    return to_bits(out, known) if all(unsigned) else out[()]
