"""Crossbar for Python: arrays in, arrays out.

- :func:`oracle`, :func:`hard_rays`: exact first hits of rays on a mesh, and other people's hits held against them.
- :class:`Format`, :func:`round`, :func:`add`, :func:`mul`, :func:`fma`, :func:`dot`, ...: arithmetic in any number
  format, each result rounded once.
- :func:`matmul`, :func:`units`, :func:`dot` with a ``unit``: what the matrix units of GPUs make of a product.
- :func:`run`, :func:`compare`, :func:`diff`: shaders on emulated graphics cards of 2001 to 2008, bit for bit.
- :func:`reproduce`, :func:`precision`: the studies, as records.

What is computed is the same on every computer, for any number of threads. Work of more than an instant runs without
the interpreter's lock, on all cores, and Ctrl-C ends it.
"""

from ._native import __version__
from .cards import Difference, Run, compare, diff, run
from .formats import (
    Format,
    add,
    div,
    dot,
    exp2,
    floor,
    fma,
    frac,
    from_bits,
    log2,
    mad,
    maximum,
    minimum,
    mul,
    rcp,
    round,
    rsq,
    saturate,
    sqrt,
    sub,
    to_bits,
)
from .matrix import matmul, units
from .rays import HIT, VERDICT, Aim, HardRays, Kind, Oracle, counts, hard_rays, oracle
from .studies import entries, precision, reproduce

__all__ = [
    "HIT",
    "VERDICT",
    "Aim",
    "Difference",
    "Format",
    "HardRays",
    "Kind",
    "Oracle",
    "Run",
    "__version__",
    "add",
    "compare",
    "counts",
    "diff",
    "div",
    "dot",
    "entries",
    "exp2",
    "floor",
    "fma",
    "frac",
    "from_bits",
    "hard_rays",
    "log2",
    "mad",
    "matmul",
    "maximum",
    "minimum",
    "mul",
    "oracle",
    "precision",
    "rcp",
    "reproduce",
    "round",
    "rsq",
    "run",
    "saturate",
    "sqrt",
    "sub",
    "to_bits",
    "units",
]
