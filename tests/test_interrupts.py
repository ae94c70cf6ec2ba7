"""Ctrl-C: one line and exit code 130 of the command, nothing else changed of other programs."""

import os
import signal
import subprocess
import sys

import pytest

from igl_periods.interrupts import INTERRUPTED, is_command

# A module of this name is imported early on, and interrupts whoever imports it.
INTERRUPTING = "import os, signal; os.kill(os.getpid(), signal.SIGINT)\n"


def usual_interrupts():
    """Whoever runs the tests in the background may have them ignored, and that is inherited."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def run(arguments, folder=None):
    path = os.pathsep.join([str(folder)] * bool(folder) + [os.environ.get("PYTHONPATH", "")])
    return subprocess.run(
        [sys.executable, *arguments],
        capture_output=True,
        check=False,
        env={**os.environ, "PYTHONPATH": path},
        preexec_fn=usual_interrupts,
        text=True,
    )


def interrupted_in(module, folder, arguments):
    (folder / f"{module}.py").write_text(INTERRUPTING)
    return run(arguments, folder)


@pytest.mark.parametrize("module", ["flint", "igl"])
def test_during_imports(tmp_path, module):
    done = interrupted_in(module, tmp_path, ["-m", "igl_periods", "compute", "x.off"])
    assert done.returncode == INTERRUPTED == 130
    assert (done.stdout, done.stderr) == ("", "igl-periods: interrupted.\n")


def test_the_installed_script_too(tmp_path):
    (tmp_path / "flint.py").write_text(INTERRUPTING)
    script = tmp_path / "igl-periods"
    script.write_text("import sys\nfrom igl_periods.cli import main\nsys.exit(main())\n")
    done = run([str(script), "compute", "x.off"], tmp_path)
    assert (done.returncode, done.stderr) == (130, "igl-periods: interrupted.\n")


def test_other_programs_are_interrupted_as_usual(tmp_path):
    done = interrupted_in("flint", tmp_path, ["-c", "import igl_periods"])
    assert "KeyboardInterrupt" in done.stderr
    program = "import signal, igl_periods; print(signal.getsignal(signal.SIGINT).__name__)"
    assert run(["-c", program]).stdout == "default_int_handler\n"


def test_workers_are_no_commands():
    spawned = ["python", "-c", "from multiprocessing.spawn import spawn_main", "--fork"]
    assert not is_command(spawned)
    assert not is_command(["python", "-m", "pytest", "igl-periods"])
    assert is_command(["python3", "-m", "igl_periods"])
