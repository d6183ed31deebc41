"""Shaders and cases on emulated graphics cards: pictures, results of each instruction, comparison of two sides."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native

#: A case: the path of a TOML file, its text, a dictionary of the same fields, or only the text of a pixel shader.
CaseLike = str | os.PathLike[str] | Mapping[str, Any]

#: Width and height of the target for a shader without a case.
SHADER_SIZE = (64, 64)


class Run:
    """The results of a draw."""

    #: Targets, each float64 of shape (height, width, 4): red, green, blue and alpha as numbers; rows go from the top.
    targets: list[NDArray[np.float64]]
    #: Depth buffer, float64 of shape (height, width), or None.
    depth: NDArray[np.float64] | None
    #: Counts of the draw: ``fragments_shaded``, ``texture_reads``, ``bytes_read``, ...
    counts: dict[str, int]
    #: Modelled times on the card in microseconds: ``rates_us`` and ``pipeline_us``; None if a figure of the card is
    #: unknown. docs/timing.md lists what the models omit.
    modelled: dict[str, float | None]
    #: The probes of the case, each with a field ``passed``.
    probes: list[dict[str, Any]]
    #: The JSON document of the draw: device, format of the pixel registers, switches, and more.
    document: dict[str, Any]
    #: Warnings about the case.
    warnings: list[str]

    def __init__(self, case: _native.Case, executor: str) -> None:
        text, self.targets, self.depth = case.run(executor)
        self.document = json.loads(text)
        self.counts = self.document["counts"]
        self.modelled = self.document["modelled"]
        self.probes = self.document["probes"]
        self.warnings = case.warnings()
        self._case = case

    def __repr__(self) -> str:
        sizes = ", ".join("x".join(str(side) for side in target.shape[1::-1]) for target in self.targets)
        return f"<Run on {self.document['device']} in {self.document['format']}: {sizes}>"

    def trace(self, x: int, y: int) -> list[dict[str, Any]]:
        """The results of every instruction at a pixel, from the reference executor.

        Args:
            x: Column, from the left.
            y: Row, from the top.

        Returns:
            One dictionary per component that an instruction wrote: ``pass`` (index of the pixel's fragment),
            ``instruction`` (its index), ``line``, ``text``, ``name`` (the component), ``value``, ``bits``, ``flags``.
            Empty if nothing covers the pixel.

        Raises:
            ValueError: if the pixel lies outside the targets.
        """
        if x < 0 or y < 0:
            raise ValueError(f"expected a pixel, found column {x}, row {y}")
        document = json.loads(self._case.trace(x, y, "scalar"))
        return [
            {
                "pass": number,
                "instruction": step["instruction"],
                "line": step.get("source", {}).get("line"),
                "text": step.get("source", {}).get("text"),
                "name": written["name"],
                "value": float(written["value"]),
                "bits": written["bits"],
                "flags": step["flags"] or [],
            }
            for number, part in enumerate(document["passes"])
            for step in part["steps"]
            for written in step["written"]
        ]


def _toml(value: Any) -> str:
    """A value as TOML on one line. TOML and JSON write strings, numbers and lists alike."""
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{json.dumps(str(key))} = {_toml(item)}" for key, item in value.items()) + " }"
    if isinstance(value, (np.ndarray, np.generic)):
        return _toml(value.tolist())
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_toml(item) for item in value) + "]"
    if isinstance(value, float):
        # JSON has no infinity; TOML calls it `inf`.
        return repr(value)
    if isinstance(value, os.PathLike):
        return json.dumps(os.fspath(value))
    if isinstance(value, (str, bool, int)):
        return json.dumps(value, ensure_ascii=False)
    raise ValueError(f"expected text, a number, a list or a dictionary in a case, found {type(value).__name__}")


def _shader_case(
    text: str, format: str | None, inputs: Mapping[str, ArrayLike], size: tuple[int, int], target: str
) -> dict[str, Any]:
    """A case that draws a quad over the whole target, with ``t0`` from (0, 0) to (1, 1)."""
    version = text.split(maxsplit=1)[0].replace(".", "_")
    device = {"device": "r200"} if format is None else {"shader_model": version, "format": format}
    if text.lstrip().startswith("!!"):
        device = {"device": "nv35"}
    textures = {name: np.shape(value) for name, value in inputs.items() if name[:1] == "t" and name[1:].isdigit()}
    return {
        **device,
        "pixel": {"source": text},
        "geometry": {"full_screen": True},
        "target": {"size": list(size), "format": target},
        # Their texels are filled in later.
        "texture": [
            {"slot": int(name[1:]), "format": target, "size": [shape[1], shape[0]],
             "texels": [[0]] * (shape[0] * shape[1])}
            for name, shape in textures.items()
            if len(shape) == 3
        ],
    }


def _is_shader(text: str) -> bool:
    return text.lstrip().startswith(("ps_", "ps.", "!!", "xps"))


def _read(
    case: CaseLike,
    device: str | None,
    format: str | None,
    switches: Mapping[str, str],
    step_budget: int | None,
    inputs: Mapping[str, ArrayLike],
    size: tuple[int, int],
    target: str,
) -> _native.Case:
    if isinstance(case, str) and _is_shader(case):
        case = _shader_case(case, None if device else format, inputs, size, target)
    folder: str | None
    if isinstance(case, Mapping):
        source, folder = "\n".join(f"{json.dumps(key)} = {_toml(value)}" for key, value in case.items()), "."
    elif isinstance(case, str) and "\n" in case:
        source, folder = case, "."
    else:
        source, folder = os.fspath(case), None
    read = _native.Case((source, folder), device, format, list(switches.items()), step_budget)
    return _with_inputs(read, inputs)


def _with_inputs(case: _native.Case, inputs: Mapping[str, ArrayLike]) -> _native.Case:
    constants: list[tuple[int, Sequence[float]]] = []
    textures: list[tuple[int, NDArray[np.float32]]] = []
    for name, value in inputs.items():
        kind, digits = name[:1], name[1:]
        if kind not in ("c", "t") or not digits.isdigit():
            raise ValueError(f"expected inputs named c0, c1, ... (constants) or t0, t1, ... (textures), found {name!r}")
        array = np.asarray(value, dtype=np.float64)
        if kind == "c":
            if array.shape != (4,):
                raise ValueError(f"expected 4 numbers for {name}, found shape {array.shape}")
            constants.append((int(digits), array.tolist()))
        else:
            if array.ndim != 3:
                raise ValueError(f"expected texels of shape (height, width, 4) for {name}, found shape {array.shape}")
            textures.append((int(digits), array.astype(np.float32)))
    return case.with_inputs(constants, textures) if inputs else case


def run(
    case: CaseLike,
    *,
    device: str | None = None,
    format: str | None = None,
    switches: Mapping[str, str] | None = None,
    inputs: Mapping[str, ArrayLike] | None = None,
    size: tuple[int, int] = SHADER_SIZE,
    target: str = "bgra8",
    executor: str = "batch",
    step_budget: int | None = None,
) -> Run:
    """Draw a case, or a pixel shader over a whole target, on an emulated card.

    Args:
        case: The path of a case file, its text, a dictionary with its fields (docs/cases.md; paths in it are relative
            to the working directory), or the text of a pixel shader. A shader alone is drawn over the whole target,
            with ``t0`` from (0, 0) to (1, 1).
        device: A card that replaces the case's: ``"r300"``, ``"nv30"``, ..., or a device file. Without it, a shader
            alone runs on r200 (OpenGL: nv35), or, with a ``format``, on a device without limits in this format.
        format: The number format of the pixel registers.
        switches: Switches of the device, by name.
        inputs: Constants ``c0``, ... of the pixel program (4 numbers each) and textures ``t0``, ... (arrays of shape
            (height, width, 4), rounded to their texel formats); they replace the case's constants and textures.
        size: Width and height of the target, for a shader alone.
        target: Texel format of target and textures, for a shader alone.
        executor: ``"batch"``, or ``"scalar"`` (the reference); both give the same bits.
        step_budget: Maximum number of instructions that a pixel may execute.

    Raises:
        ValueError: if the case, the shader or an input is rejected; the message says where and why.
    """
    read = _read(case, device, format, switches or {}, step_budget, inputs or {}, size, target)
    return Run(read, executor)


def compare(
    case: CaseLike,
    *,
    left: Mapping[str, Any] | None = None,
    right: Mapping[str, Any] | None = None,
    inputs: Mapping[str, ArrayLike] | None = None,
    size: tuple[int, int] = SHADER_SIZE,
    target: str = "bgra8",
    pixel: tuple[int, int] | None = None,
    registers: bool = False,
) -> dict[str, Any]:
    """Run a case on two sides, and find the first difference and its instruction.

    Args:
        case: As for :func:`run`.
        left: Settings of the left side that replace the case's: ``device``, ``format``, ``switches``, ``executor``.
        right: The same for the right side: ``{"format": "fp32"}``, for example. Both sides run on the reference
            executor by default; if their settings are equal, the right side runs on the batch executor.
        inputs: As for :func:`run`, on both sides.
        size: As for :func:`run`.
        target: As for :func:`run`.
        pixel: The pixel (column, row) to trace, even if the targets do not differ there.
        registers: True to trace every pixel.

    Returns:
        The document of ``crossbar compare --json`` (docs/compare.md): ``equal``, ``different`` (pixels), ``surfaces``,
        ``counts``, and ``first``, the first difference, with its stage as text.

    Raises:
        ValueError: if a side cannot be set up.
    """
    sides = [dict(left or {}), dict(right or {})]
    given = [side.pop("executor", None) for side in sides]
    executors = (given[0] or "scalar", given[1] or ("batch" if sides[0] == sides[1] else "scalar"))
    cases = []
    for name, side in zip(("left", "right"), sides):
        unknown = side.keys() - {"device", "format", "switches"}
        if unknown:
            known = "device, format, switches and executor"
            raise ValueError(f"expected {known} on the {name} side, found {', '.join(sorted(unknown))}")
        settings = (side.get("device"), side.get("format"), side.get("switches") or {})
        cases.append(_read(case, *settings, None, inputs or {}, size, target))
    text = _native.compare(cases[0], cases[1], executors, pixel, registers)
    document: dict[str, Any] = json.loads(text)
    return document


class Difference:
    """The difference of two pictures."""

    #: Structural similarity (SSIM) of the luma: 1 for equal pictures, None for pictures smaller than 11 x 11 pixels.
    ssim: float | None
    #: Mean FLIP: the difference seen by an observer who flips between the pictures, from 0 (none) to 1.
    flip: float
    #: Largest FLIP of a pixel.
    flip_maximum: float
    #: FLIP of each pixel, shape (height, width).
    flip_map: NDArray[np.float64]
    #: Root mean square of the differences of all channels.
    rmse: float
    #: Largest difference of a channel of a pixel.
    maximum: float

    def __init__(self, first: NDArray[Any], second: NDArray[Any], srgb: bool, exposure: float, ppd: float) -> None:
        pair = (first.astype(np.float32), second.astype(np.float32))
        self.ssim, self.flip, self.flip_maximum, self.flip_map = _native.diff(pair, srgb, (exposure, ppd))
        apart = second.astype(np.float64) - first.astype(np.float64)
        self.rmse, self.maximum = float(np.sqrt(np.mean(apart**2))), float(np.max(np.abs(apart)))

    def __repr__(self) -> str:
        return f"<Difference: SSIM {self.ssim}, FLIP {self.flip}, RMSE {self.rmse}>"


def diff(a: ArrayLike, b: ArrayLike, *, srgb: bool = False, exposure: float = 1.0, ppd: float = 67.0) -> Difference:
    """Compare two pictures as an observer perceives them.

    Args:
        a: Shape (height, width, 3 or 4); alpha is ignored. Floats are linear light or, with ``srgb``, display values
            from 0 to 1; uint8 numbers are display values from 0 to 255.
        b: The same shape.
        srgb: True if the floats are display values.
        exposure: Factor by which linear light is multiplied.
        ppd: Pixels per degree of the observer.

    Raises:
        ValueError: if a shape is wrong, or a number is NaN.
    """
    pictures = []
    for name, picture in (("a", np.asarray(a)), ("b", np.asarray(b))):
        if picture.ndim != 3 or picture.shape[2] not in (3, 4) or picture.size == 0:
            raise ValueError(f"expected a picture of shape (height, width, 3) as {name}, found {picture.shape}")
        if picture.dtype == np.uint8:
            srgb, picture = True, picture / 255.0
        picture = picture[:, :, :3]
        if np.isnan(picture).any():
            y, x, channel = np.argwhere(np.isnan(picture))[0]
            raise ValueError(f"expected numbers, found NaN in {name}[{y}, {x}, {channel}]")
        pictures.append(picture)
    if pictures[0].shape != pictures[1].shape:
        raise ValueError(f"expected two pictures of the same size, found {pictures[0].shape} and {pictures[1].shape}")
    if not (ppd > 0 and exposure > 0):
        raise ValueError(f"expected a positive exposure and number of pixels per degree, found {exposure} and {ppd}")
    return Difference(pictures[0], pictures[1], srgb, exposure, ppd)
