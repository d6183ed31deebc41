"""Tests run in the root of the repository, because paths of case files are relative to it."""

import signal
from pathlib import Path

import pytest

# A shell may have started its background processes with the signal ignored.
signal.signal(signal.SIGINT, signal.default_int_handler)

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(autouse=True)
def at_the_root(monkeypatch):
    monkeypatch.chdir(ROOT)

