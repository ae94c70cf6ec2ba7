"""What is logged while a computation runs."""

import logging

import numpy as np
import pytest

from igl_periods import run_log as stages
from igl_periods.complexes.delta_complex import DeltaComplex
from igl_periods.harmonic.energies import linear_energies
from igl_periods.run_log import progress, stage
from igl_periods.siegel.reduction import siegel_reduce
from igl_periods.surfaces import thickened_lattice
from igl_periods.topology.cohomology import cochains_and_basis


@pytest.fixture
def impatient(monkeypatch):
    """Every report of progress is logged."""
    monkeypatch.setattr(stages, "_INTERVAL", 0.0)


def test_three_kinds_of_records(caplog, impatient):
    with caplog.at_level(logging.INFO, logger="igl_periods"), stage("counting"):
        progress("sheep", 3, 10)
        progress("goats", 12345)
    started, first, second, done = caplog.records
    assert (started.stage, started.seconds) == ("counting", None)
    assert (first.progress, first.done, first.total) == ("sheep", 3, 10)
    assert (second.progress, second.done, second.total) == ("goats", 12345, None)
    assert done.stage == "counting"
    assert done.seconds >= 0
    messages = [record.getMessage() for record in caplog.records[:3]]
    assert messages == ["counting …", "sheep: 3 of 10", "goats: 12,345"]


def test_progress_is_not_reported_all_the_time(caplog):
    with caplog.at_level(logging.INFO, logger="igl_periods"), stage("counting"):
        for k in range(1000):
            progress("sheep", k, 1000)
    reports = [record for record in caplog.records if hasattr(record, "progress")]
    # At most one in each interval, and none at once.
    assert len(reports) <= caplog.records[-1].seconds / stages._INTERVAL


def test_a_stage_that_fails(caplog):
    with (
        caplog.at_level(logging.INFO, logger="igl_periods"),
        pytest.raises(ValueError, match="black"),
        stage("counting"),
    ):
        raise ValueError("a black sheep")
    assert caplog.records[-1].getMessage() == "counting failed"


def test_siegel_reduction_reports_its_parts(caplog, impatient):
    rng = np.random.default_rng(0)
    A = rng.standard_normal((50, 50))
    Pi = rng.uniform(-1, 1, (50, 50)) + 1j * (A @ A.T / 50 + 0.1 * np.eye(50))
    with caplog.at_level(logging.INFO, logger="igl_periods"):
        siegel_reduce(0.5 * (Pi + Pi.T))
    reported = [(record.progress, record.done) for record in caplog.records]
    for part in ("pairwise moves", "exchanges in the lattice", "quasi-inversions"):
        assert max(done for name, done in reported if name == part) > 0


def test_harmonic_forms_report_their_equations_and_energies(caplog, impatient):
    K = DeltaComplex.from_mesh(*thickened_lattice((3, 3, 3), 3))
    cochains, _ = cochains_and_basis(K)
    with caplog.at_level(logging.INFO, logger="igl_periods"):
        linear_energies(K, cochains)
    reported = [(record.progress, record.done, record.total) for record in caplog.records]
    assert ("equations", 0, 56) in reported
    assert ("equations", 32, 56) in reported
    faces = [
        done for name, done, total in reported if (name, total) == ("energies on faces", K.n_faces)
    ]
    assert 0 in faces
    assert 0 < max(faces) < K.n_faces
