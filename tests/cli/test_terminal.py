"""Stages on a terminal: one line each, and none where nobody looks."""

import io
import logging
import os
import pty
import subprocess
import sys

import pytest

from igl_periods import run_log as stages
from igl_periods.cli.terminal import _StageFormatter
from igl_periods.run_log import logger, progress, stage


def test_stages_are_shown_on_a_terminal_only(torus):
    command = [sys.executable, "-m", "igl_periods", "compute", str(torus)]
    piped = subprocess.run(command, capture_output=True, text=True, check=True)
    assert piped.stderr == ""
    reader, terminal = pty.openpty()
    subprocess.run(command, stdout=subprocess.DEVNULL, stderr=terminal, check=True)
    os.close(terminal)
    shown = os.read(reader, 10_000).decode()
    os.close(reader)
    for name in ("reading the file", "homology", "harmonic forms", "Siegel reduction"):
        assert name in shown


@pytest.fixture
def impatient(monkeypatch):
    """Every report of progress is logged."""
    monkeypatch.setattr(stages, "_INTERVAL", 0.0)


def test_a_terminal_shows_one_line_for_each_stage(impatient):
    handler = logging.StreamHandler(io.StringIO())
    handler.terminator = ""
    handler.setFormatter(_StageFormatter())
    logger.addHandler(handler)
    logger.setLevel(logging.INFO)
    try:
        with stage("counting"):
            progress("sheep", 3, 10)
        logger.info("a remark")
    finally:
        logger.removeHandler(handler)
        logger.setLevel(logging.NOTSET)
    shown = handler.stream.getvalue()
    # Each record starts the line again and clears it; only finished ones leave it.
    assert shown.count("\r\x1b[K") == 4
    lines = [line.split("\r\x1b[K")[-1] for line in shown.split("\n")]
    assert "counting … sheep: 3 of 10" in shown
    assert shown.count("\n") == 2
    assert lines[0].startswith("  counting  ")
    assert lines[1] == "  a remark"
