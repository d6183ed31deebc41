"""The studies of Crossbar, as lists of dictionaries for ``pandas.DataFrame``."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any

from . import _native
from .cards import SHADER_SIZE, CaseLike, _read

#: The systems whose programs :func:`precision` can study, in addition to cases.
SYSTEMS = ("ray-engine", "radiosity", "subsurface", "cpca", "all-frequency", "bi-scale")


def entries() -> list[dict[str, str]]:
    """The entries of :func:`reproduce`: ``id`` and ``title`` of each table or figure."""
    return [{"id": name, "title": title} for name, title in _native.entries()]


def reproduce(*ids: str, full_size: bool = False) -> list[dict[str, Any]]:
    """The papers' printed values and ours, judged by bounds; each row has the date when its bound was stated.

    Args:
        ids: Ids from :func:`entries`, or papers (``cpca``); by default all entries, which takes minutes.
        full_size: True to recompute recorded entries, which takes minutes for most and hours for two.

    Returns:
        One dictionary per printed figure, as in rows.csv of ``crossbar reproduce``: ``entry``, ``figure``,
        ``ours``, ``low`` and ``high`` (the bound), ``verdict`` and others.

    Raises:
        ValueError: if an id does not exist, or with full_size if no entry has a record.
    """
    document = json.loads(_native.reproduce(list(ids), full_size))
    rows: list[dict[str, Any]] = document["rows"]
    return rows


def precision(
    case: CaseLike,
    *,
    goal: str | None = None,
    families: Sequence[str] = ("float", "fixed"),
    budget: int = 10_000,
    device: str | None = None,
    switches: Mapping[str, str] | None = None,
    table: str = "curve",
) -> list[dict[str, Any]]:
    """Search for the fewest bits with which a pixel program meets a goal.

    Args:
        case: A case as for :func:`crossbar_gi.run`, or one of :data:`SYSTEMS`.
        goal: ``MEASURE<=NUMBER``, such as ``"flip<=0.01"``; by default each code may be off by one (docs/precision.md).
        families: ``"float"``, ``"fixed"`` or both.
        budget: Maximum number of runs of the program; after these, the best result so far is returned.
        device: A device that replaces the case's.
        switches: Switches of the device, by name.
        table: The table to return: ``"curve"`` (the measures by format), ``"formats"`` (of cards), ``"measures"``,
            ``"switches"``, or another table of the document.

    Returns:
        The rows of the table, one dictionary per row.

    Raises:
        ValueError: if the case or the goal is rejected, or the document has no such table.
    """
    if isinstance(case, str) and case in SYSTEMS:
        text = _native.precision(None, (case, device, list((switches or {}).items())), goal, list(families), budget)
    else:
        read = _read(case, device, None, switches or {}, None, {}, SHADER_SIZE, "bgra8")
        text = _native.precision(read, (None, None, []), goal, list(families), budget)
    document = json.loads(text)
    tables = {name: value for name, value in document.items() if isinstance(value, list)}
    if table not in tables:
        raise ValueError(f"expected one of the tables {', '.join(sorted(tables))}, found {table!r}")
    rows: list[dict[str, Any]] = tables[table]
    return rows
