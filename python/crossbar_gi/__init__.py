"""Crossbar for Python, on NumPy arrays.

- :func:`oracle`, :func:`hard_rays`: exact first hits of rays on a mesh, and comparison of other hits with them.
- :class:`Format`, :func:`round`, :func:`add`, :func:`mul`, :func:`fma`, :func:`dot`, ...: arithmetic in any number
  format, each result rounded once.
- :func:`matmul`, :func:`units`, :func:`dot` with a ``unit``: products as the matrix units of GPUs compute them.
- :func:`run`, :func:`compare`, :func:`diff`: shaders on emulated graphics cards of 2001 to 2008, bit for bit.
- :func:`reproduce`, :func:`precision`: the studies, as lists of dictionaries.

Results are the same on every computer and with any number of threads. Long work runs on all cores without the
interpreter's lock; Ctrl-C interrupts it.
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
