"""Matrix units of GPUs, Volta to Blackwell and CDNA1 to CDNA3: their products and sums, bit for bit.

A unit is a name from :func:`units`; ``-`` means the same as ``_``, and a final ``_f32`` may be omitted. Arrays of
floats are numbers: they are rounded to nearest even into the unit's types, and types of up to 8 bits saturate. Arrays
of *unsigned* integers are bit patterns of these types. Results have the type of the unit's result (float16, float32 or
float64), so ``d.view(np.uint32)`` gives the words of a float32 result.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native

_FIELDS = ("name", "chips", "types", "c", "k", "block", "bits_kept", "result", "confidence", "source")


def units() -> list[dict[str, Any]]:
    """The units, oldest first, as ``crossbar units`` lists them; ``pandas.DataFrame(cg.units())`` makes a table.

    Returns:
        Dictionaries with ``name``, ``chips``, ``types`` of a and b, type of ``c``, number of products of an instruction
        (``k``) and of one sum (``block``), ``bits_kept`` below the largest exponent (None without an aligned adder),
        type of the ``result``, ``confidence`` (``measured``, ``two models`` or ``one model``) and ``source``.
    """
    return [dict(zip(_FIELDS, row)) for row in _native.units()]


def matmul(
    a: ArrayLike,
    b: ArrayLike,
    c: ArrayLike | None = None,
    unit: str = "hopper-fp8",
    promote: int | None = None,
    *,
    types: str | tuple[str, str] | None = None,
    bits: int | None = None,
) -> NDArray[Any]:
    """``a @ b + c`` as a matrix unit computes it.

    Args:
        a: Numbers or bit patterns, shape ``(m, k)``. ``k`` can have any value, because padding zeros change nothing.
        b: Shape ``(k, n)``.
        c: Numbers, shape ``(m, n)``; zeros by default.
        unit: The unit.
        promote: Number of products after which the partial sum is added to a single-precision sum, rounded to nearest,
            and the unit restarts from zero; by default there is one accumulator.
        types: Types of a and b, or one type for both; by default the first type that the unit supports. Required for
            bit patterns if the unit supports several types.
        bits: Number of bits of each addend that are kept below the largest exponent, 1 to 60, instead of the unit's.

    Returns:
        Shape ``(m, n)``.

    Raises:
        ValueError: if shapes do not match, or the unit does not support these operands or ``promote``.
    """
    addend = None if c is None else _operand("c", c).astype(np.float64)
    words = _native.matmul(unit, _types(types), _operand("a", a), _operand("b", b), addend, (bits, promote))
    return _typed(words, (len(np.asarray(a)), np.asarray(b).shape[1]))


def dot(
    x: ArrayLike,
    y: ArrayLike,
    unit: str,
    c: ArrayLike = 0.0,
    types: str | tuple[str, str] | None = None,
    scales: tuple[ArrayLike, ArrayLike] | None = None,
) -> Any:
    """Sums of products along the last axis; :func:`crossbar_gi.dot` with a ``unit``."""
    arrays = [_operand("x", x), _operand("y", y)]
    if any(array.ndim == 0 for array in arrays):
        raise ValueError("expected arrays with an axis to sum along, found a single number")
    shape = _shape(*(array.shape for array in arrays))
    left, right = (np.broadcast_to(array, shape).reshape(-1, shape[-1]) for array in arrays)
    addend = _operand("c", c)
    _shape(addend.shape, shape[:-1])
    both: tuple[NDArray[np.uint8], NDArray[np.uint8]] | None = None
    if scales is not None:
        some = [np.asarray(scale) for scale in scales]
        if any(scale.dtype.kind != "u" or scale.ndim == 0 for scale in some):
            raise ValueError("expected scales as bit patterns (unsigned integers) along the last axis")
        rows = [np.broadcast_to(scale, (*shape[:-1], scale.shape[-1])) for scale in some]
        left_scales, right_scales = (row.reshape(-1, row.shape[-1]).astype(np.uint8) for row in rows)
        both = (left_scales, right_scales)
    addends = np.broadcast_to(addend, shape[:-1]).reshape(-1)
    words = _native.unit_dot(unit, _types(types), (left, right, addends), shape[-1], both)
    return _typed(words, shape[:-1])[()]


def _shape(*shapes: tuple[int, ...]) -> tuple[int, ...]:
    try:
        return np.broadcast_shapes(*shapes)
    except ValueError:
        found = " and ".join(map(str, shapes))
        raise ValueError(f"expected shapes that broadcast together, found {found}") from None


def _operand(name: str, array: ArrayLike) -> NDArray[Any]:
    found = np.asarray(array)
    if found.dtype.kind == "u":
        return found.astype(np.uint64)
    if found.dtype.kind not in "fib":
        raise ValueError(f"expected numbers in {name}, found an array of {found.dtype}")
    return found.astype(np.float64)


def _types(types: str | tuple[str, str] | None) -> tuple[str | None, str | None]:
    return (types, types) if types is None or isinstance(types, str) else (types[0], types[1])


def _typed(words: tuple[NDArray[np.uint64], int], shape: tuple[int, ...]) -> NDArray[Any]:
    """View words as numbers of their type."""
    return words[0].astype(f"u{words[1] // 8}").view(f"f{words[1] // 8}").reshape(shape)
