"""Degenerate meshes, gluings and files: a checked result or a documented error, nothing else.

No other exception, no warning, nothing printed, no crash, no hang, no gigabytes, no wrong result:
the certificates of all options of one surface overlap, a scale of a power of two changes no bit,
and what text files and tables of bytes say is read by a second, simpler reader as well.
"""

import os
import time

import numpy as np
import pytest
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st
from support import damaged_inputs, documented_outcomes
from support.separate_process import DOCUMENTED, Judge

HOLES = st.sampled_from([0, 4, 100])


# Kind of example: a strategy, and how many examples the default and the slow suite judge.
KINDS = {
    "file": (st.tuples(damaged_inputs.files(), st.booleans(), HOLES), 120, 5000),
    "scene file": (
        st.tuples(damaged_inputs.files(damaged_inputs.SCENES), st.booleans(), HOLES),
        40,
        1000,
    ),
    "mesh": (damaged_inputs.meshes(), 40, 1500),
    "repair": (st.tuples(damaged_inputs.meshes(), HOLES), 40, 1000),
    "lengths": (damaged_inputs.lengths(), 40, 500),
    "gluing": (damaged_inputs.gluings(), 40, 1500),
    "needles": (damaged_inputs.needles(), 20, 1000),
    "weights": (damaged_inputs.gluings(), 60, 500),
    "squares": (damaged_inputs.squares(), 40, 500),
}


@pytest.fixture(scope="module")
def judge():
    judge = Judge(documented_outcomes.verdict)
    yield judge
    judge.close()


def judge_many(judge, kind, number, **options):
    examples = KINDS[kind][0]
    judge.count.clear()

    @settings(
        max_examples=number,
        deadline=None,
        suppress_health_check=list(HealthCheck),
        database=None,
        **options,
    )
    @given(examples)
    def all_examples(example):
        judge(kind, example)

    all_examples()
    refused = sum(n for word, n in judge.count.items() if word.startswith("refused"))
    results = judge.count.total() - refused
    # A strategy that yields nothing but refusals, or none, would say nothing.
    assert results > number / 20, judge.count
    assert refused > 0, judge.count


@pytest.mark.parametrize("kind", KINDS)
def test_hundreds_of_damaged_examples(judge, kind):
    judge_many(judge, kind, KINDS[kind][1], derandomize=True, phases=[Phase.generate])


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_ten_thousand_damaged_examples(judge, kind):
    judge_many(judge, kind, KINDS[kind][2])


def misbehaviour(how):
    """What a judge has to notice."""
    match how:
        case "crash":
            os.abort()
        case "hang":
            time.sleep(60)
        case "gigabytes":
            np.ones(1 << 32)
        case "warning":
            np.float64(1e308) * 10
        case "print":
            os.write(1, b"words")
        case "exception":
            raise ValueError("not of a documented kind, whatever it says")
        case "silence":
            raise DOCUMENTED[0]("no")
    return "fine"


@pytest.fixture(scope="module")
def strict_judge():
    judge = Judge(misbehaviour)
    yield judge
    judge.close()


@pytest.mark.parametrize(
    ("how", "what"),
    [
        ("crash", "ended with exit code -6"),
        ("hang", "no answer in 0.5"),
        ("gigabytes", "Unable to allocate"),
        ("warning", "RuntimeWarning"),
        ("print", "printed: b'words'"),
        ("exception", "not of a documented kind"),
        ("silence", "refused: MeshError"),
    ],
)
def test_the_judge_notices(strict_judge, how, what):
    strict_judge("nothing")
    strict_judge.patience = 0.5 if how == "hang" else 60.0
    with pytest.raises(AssertionError, match=what):
        strict_judge(how)
    strict_judge.patience = 60.0
