"""Judging examples in a process of its own: a crash, a hang and gigabytes are verdicts too."""

import multiprocessing
import os
import resource
import traceback
import warnings
from collections import Counter
from pathlib import Path
from tempfile import TemporaryFile

import igl_periods as ip

DOCUMENTED = (ip.MeshError, ip.ComplexError, ip.NotASiegelPointError, FileNotFoundError)
GIGABYTE = 1 << 30


class Judge:
    """Calls a function with examples, in another process.

    The function returns what an example came to, in a word, or raises: one of the documented
    errors, which is fine too, or anything else, a warning included, which is not.  Nor is output.
    """

    def __init__(self, function, patience=60.0, memory=4 * GIGABYTE):
        self.function, self.patience, self.memory = function, patience, memory
        self.count = Counter()
        self._process = None

    def __call__(self, *example):
        if self._process is None:
            self._start()
        self._pipe.send(example)
        if not self._pipe.poll(self.patience):
            self.close()
            raise AssertionError(f"no answer in {self.patience} s")
        try:
            fine, word = self._pipe.recv()
        except EOFError:
            self._process.join()
            code = self._process.exitcode
            self.close()
            raise AssertionError(f"the process ended with exit code {code}") from None
        self.count[word if fine else "wrong"] += 1
        assert fine, word

    def _start(self):
        context = multiprocessing.get_context("spawn")
        self._pipe, there = context.Pipe()
        self._process = context.Process(
            target=_serve, args=(there, self.function, self.memory), daemon=True
        )
        self._process.start()
        there.close()

    def close(self):
        if self._process is not None:
            self._process.kill()
            self._process.join()
            self._process = None


def _serve(pipe, function, memory):
    warnings.simplefilter("error")
    # Open3D says that there is no graphics card.
    warnings.simplefilter("ignore", ImportWarning)
    in_use = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_AS, (in_use + memory, resource.RLIM_INFINITY))
    with TemporaryFile() as printed:
        for stream in (1, 2):
            os.dup2(printed.fileno(), stream)
        while True:
            try:
                example = pipe.recv()
            except EOFError:
                return
            fine, word = _verdict(function, example)
            if printed.seek(0, os.SEEK_END) > 0:
                printed.seek(0)
                fine, word = False, f"printed: {printed.read()!r}\nafter {word}"
                printed.seek(0)
                printed.truncate()
            pipe.send((fine, word))


def _verdict(function, example):
    try:
        return True, function(*example)
    except DOCUMENTED as error:
        return len(str(error)) > 30, f"refused: {type(error).__name__}"
    except BaseException:
        return False, traceback.format_exc()
