"""Stages on a terminal: one line each, and none where nobody looks."""

import ast
import io
import logging
import os
import pty
import subprocess
import sys
from pathlib import Path

import pytest

import igl_periods
from igl_periods import run_log as stages
from igl_periods.cli.terminal import _StageFormatter, in_ascii
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


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        ("Π of genus 2", "Pi of genus 2"),
        ("(c Π₀ + d)⁻¹", "(c Pi_0 + d)^-1"),
        ("2 ≤ 3 × 3 − 1 ± ∞", "2 <= 3 x 3 - 1 +- inf"),
        ("counting … ξ_{2,1} in S³ at 90°", "counting ... xi_{2,1} in S^3 at 90 deg"),
        ("Möbius–Čech", "Mobius-Cech"),
        ("面.off \udcff", r"\u9762.off \udcff"),
        ("a\tplain line\n", "a\tplain line\n"),
    ],
)
def test_ascii_is_readable(text, plain):
    assert in_ascii(text) == plain


def test_what_the_library_prints_has_a_form_in_ascii():
    """No letter of any sentence is left as an escape; docstrings are not printed."""
    letters = set()
    for path in Path(igl_periods.__file__).parent.rglob("*.py"):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        docstrings = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr)}
        for node in ast.walk(tree):
            if isinstance(node, ast.Constant) and id(node) not in docstrings:
                letters |= set(str(node.value))
    assert {letter for letter in letters if "\\" in in_ascii(letter)} <= {"\\"}


def test_an_interrupted_stage_leaves_no_line_of_its_own(torus):
    program = (
        "import os, signal, sys\n"
        "from igl_periods.cli import compute, main\n"
        "def interrupted(*_, **__): os.kill(os.getpid(), signal.SIGINT)\n"
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "compute.reduced_if_feasible = interrupted\n"
        f"sys.exit(main(['compute', {str(torus)!r}]))\n"
    )
    reader, terminal = pty.openpty()
    done = subprocess.run([sys.executable, "-c", program], stderr=terminal, check=False)
    os.close(terminal)
    shown = os.read(reader, 10_000).decode()
    os.close(reader)
    assert done.returncode == 130
    assert shown.endswith("  Siegel reduction …\r\x1b[Kigl-periods: interrupted.\r\n")
