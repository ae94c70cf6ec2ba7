"""One surface on several ranks: the parts, the solution, the bound, the command, failures."""

import importlib.util
import json
import os
import pickle
import shutil
import subprocess
import sys
from pathlib import Path

import igl
import numpy as np
import pytest
from distributed_runs import OPTIONS, SURFACES
from random_surfaces import OMEGA_1, OMEGA_2, torus_grid, torus_of_revolution

import igl_periods as ip
from igl_periods.complexes.delaunay import intrinsic_delaunay
from igl_periods.complexes.half_edges import edge_ends
from igl_periods.complexes.weights import cotan_weights
from igl_periods.distributed import __main__ as command
from igl_periods.distributed import period_matrix, pipeline
from igl_periods.distributed.collective import on_every_rank, on_root
from igl_periods.distributed.libraries import load_petsc, world
from igl_periods.distributed.partition import Partition
from igl_periods.harmonic.energies import dirichlet_matrix
from igl_periods.harmonic.laplace_matrix import laplacian
from igl_periods.periods.rounding import LEAST_ALLOWANCE
from igl_periods.symplectic.canonical_basis import standard_form
from igl_periods.topology.cohomology import cochains_and_basis

HERE = Path(__file__).parent
# Open MPI starts nothing as root, and no more ranks than there are cores, unless told to.
MPI_ENVIRONMENT = {
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "OMPI_MCA_mpi_yield_when_idle": "1",
    "PRTE_MCA_rmaps_default_mapping_policy": ":oversubscribe",
}


def mpiexec(n, *arguments):
    """Run Python on n ranks; skip where there is no PETSc or no MPI."""
    if not (
        importlib.util.find_spec("petsc4py")
        and importlib.util.find_spec("mpi4py")
        and shutil.which("mpiexec")
    ):
        pytest.skip("mpi4py, petsc4py or mpiexec is missing: scripts/setup --distributed")
    return subprocess.run(
        ["mpiexec", "-n", str(n), sys.executable, *map(str, arguments)],
        capture_output=True,
        text=True,
        timeout=300,
        env=os.environ | MPI_ENVIRONMENT,
        check=False,
    )


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    """What each rank got of ``distributed_runs.py`` on n ranks, run once for each n."""
    cache = {}

    def run(n):
        if n not in cache:
            path = tmp_path_factory.mktemp("ranks") / f"{n}.pickle"
            done = mpiexec(n, HERE / "distributed_runs.py", path)
            assert done.returncode == 0, done.stderr
            cache[n] = pickle.loads(path.read_bytes())
        return cache[n]

    return run


@pytest.fixture(scope="module")
def alone():
    """The same on one machine, without MPI."""
    return {
        (name, how): ip.period_matrix(K, delaunay=how != "no flips")
        for name, K in SURFACES.items()
        for how in OPTIONS
    }


# ---- The parts ----


def divided(K, n_ranks):
    cochains, _ = cochains_and_basis(K)
    partition = Partition.of(K, cochains, n_ranks)
    return cochains, partition, [partition.part(rank) for rank in range(n_ranks)]


@pytest.mark.parametrize("n_ranks", [1, 2, 5, 40])
@pytest.mark.parametrize("name", SURFACES)
def test_every_vertex_and_every_face_has_one_owner(name, n_ranks):
    K = SURFACES[name]
    _, partition, parts = divided(K, n_ranks)
    assert np.array_equal(np.sort(partition.place), np.arange(K.n_vertices))
    assert np.array_equal(np.sort(partition.faces), np.arange(K.n_faces))
    owned = np.concatenate([part.complex.labels[: part.n_owned] for part in parts])
    assert np.array_equal(owned, np.arange(K.n_vertices))
    assert sum(part.complex.n_faces for part in parts) == K.n_faces
    for part in parts:
        ghosts = np.arange(part.n_owned, part.complex.n_vertices)
        assert np.isin(ghosts, part.complex.corner_vertex).all()
        assert not np.isin(part.complex.labels[ghosts], part.complex.labels[: part.n_owned]).any()


@pytest.mark.parametrize("n_ranks", [1, 2, 5, 40])
@pytest.mark.parametrize("name", SURFACES)
def test_parts_are_complexes_with_closed_cochains(name, n_ranks):
    for part in divided(SURFACES[name], n_ranks)[2]:
        K = part.complex
        along = K.sign * part.cochains.toarray()[:, K.edge]
        assert not along.sum(axis=-1).any()
        inside = np.flatnonzero(K.twin.ravel() >= 0)
        other = K.twin.ravel()[inside]
        assert np.array_equal(K.twin.ravel()[other], inside)
        assert np.array_equal(K.edge.ravel()[other], K.edge.ravel()[inside])
        assert np.array_equal(K.lengths.ravel()[other], K.lengths.ravel()[inside])
        assert np.array_equal(K.sign.ravel()[other], -K.sign.ravel()[inside])
        assert np.count_nonzero(K.sign > 0) == K.n_edges


@pytest.mark.parametrize("n_ranks", [1, 2, 5, 40])
@pytest.mark.parametrize("name", SURFACES)
def test_laplacians_and_energies_of_the_parts_add_up(name, n_ranks):
    K = SURFACES[name]
    cochains, partition, parts = divided(K, n_ranks)
    place = partition.place
    whole = laplacian(K, cotan_weights(K)).toarray()
    summed = np.zeros_like(whole)
    f = np.random.default_rng(0).normal(size=(K.n_vertices, cochains.shape[0]))
    by_place = np.empty_like(f)
    by_place[place] = f
    D = np.zeros((cochains.shape[0],) * 2)
    for part in parts:
        labels = part.complex.labels
        local = laplacian(part.complex, cotan_weights(part.complex)).toarray()
        summed[np.ix_(labels, labels)] += local
        D += dirichlet_matrix(part.complex, part.cochains, by_place[labels])
    np.testing.assert_allclose(summed[np.ix_(place, place)], whole, atol=1e-12 * whole.max())
    np.testing.assert_allclose(D, dirichlet_matrix(K, cochains, f), rtol=1e-12, atol=1e-10)


def test_parts_have_short_boundaries():
    # 64 parts of 10,000 vertices: strips across the torus would have 200 ghosts, squares 25.
    V, _ = torus_of_revolution(2.0, 0.8, 100, 100)
    K = ip.DeltaComplex.from_mesh(V, torus_grid(100, 100))
    _, _, parts = divided(K, 64)
    ghosts = [part.complex.n_vertices - part.n_owned for part in parts]
    assert np.mean(ghosts) < 50
    assert max(part.n_owned for part in parts) - min(part.n_owned for part in parts) <= 1
    assert max(part.complex.n_faces for part in parts) < 1.5 * K.n_faces / 64


# ---- Solution and bound ----


@pytest.mark.parametrize("n", [1, 2, 3])
@pytest.mark.parametrize("how", ["tight", "no flips"])
@pytest.mark.parametrize("name", SURFACES)
def test_the_same_as_on_one_machine(runs, alone, name, how, n):
    pm, expected = runs(n)[0][name, how], alone[name, how]
    scale = np.sqrt(np.diag(expected.dirichlet))
    error = np.abs(pm.dirichlet - expected.dirichlet) / np.outer(scale, scale)
    assert error.max(initial=0.0) < 1e-12
    assert (pm.cocycles != expected.cocycles).nnz == 0
    assert pm.bound == pytest.approx(expected.bound, rel=1e-9, abs=1e-14)
    assert pm.rounding == pytest.approx(expected.rounding, rel=1e-6)
    assert pm.certified


def test_rounding_of_needles_is_allowed_for(runs, alone):
    # Only some of the ranks have extreme triangles: their loss has to reach rank 0.
    assert alone["needles", "tight"].rounding > 1.2 * LEAST_ALLOWANCE
    for n in (1, 2, 3):
        assert runs(n)[0]["needles", "tight"].rounding > 1.2 * LEAST_ALLOWANCE


@pytest.mark.parametrize("n", [1, 2, 3])
@pytest.mark.parametrize("name", SURFACES)
@pytest.mark.parametrize("how", ["loose", "unsolved"])
def test_what_the_solver_left_undone_makes_energies_larger(runs, alone, name, how, n):
    # D is a Gram matrix of closed forms, so its excess is one too: D − D_P1 ≥ 0.
    D, least = runs(n)[0][name, how].dirichlet, alone[name, how].dirichlet
    excess = np.linalg.eigvalsh(D - least) / max(np.trace(least), 1.0)
    assert excess.min(initial=0.0) >= -1e-13
    n_vertices = SURFACES[name].n_vertices
    if how == "unsolved" and n_vertices > 30:
        assert excess.max(initial=0.0) > 1e-3


@pytest.mark.parametrize("n", [1, 2, 3])
@pytest.mark.parametrize(("name", "exact"), [("L", OMEGA_1), ("Bolza", OMEGA_2)])
@pytest.mark.parametrize("how", ["tight", "loose", "unsolved"])
def test_the_exact_matrix_is_within_the_bound(runs, alone, name, exact, how, n):
    fine = ip.period_matrix(SURFACES[name], degree=8)
    gamma = ip.symplectic_isomorphisms(exact, fine, tolerance=1e-5, limit=1)[0]
    exact = ip.siegel_transform(gamma, exact)
    pm = runs(n)[0][name, how]
    Y = pm.matrix.imag
    root = np.linalg.inv(np.linalg.cholesky(Y))
    assert np.linalg.norm(root @ (exact - pm.matrix) @ root.T, 2) <= pm.bound
    assert (np.abs(exact - pm.matrix) <= pm.entry_bounds).all()
    # The bracket J D⁻¹ Jᵀ ≤ D_exact ≤ D of the theorem itself.
    X, Y = exact.real, exact.imag
    inverse = np.linalg.inv(Y)
    D_exact = np.block([[Y + X @ inverse @ X, -X @ inverse], [-inverse @ X, inverse]])
    J = standard_form(len(Y))
    assert np.linalg.eigvalsh(pm.dirichlet - D_exact).min() > -1e-12
    lower = J @ np.linalg.inv(pm.dirichlet) @ J.T
    assert np.linalg.eigvalsh(D_exact - lower).min() > -1e-12
    if how != "tight":
        assert pm.bound > 1.001 * alone[name, "tight"].bound


def test_only_rank_0_has_the_result(runs):
    root, *others = runs(3)
    assert len(others) == 2
    for found in others:
        assert all(pm is None for key, pm in found.items() if isinstance(key, tuple))
    assert root["one vertex", "tight"].genus == 2
    assert root["sphere", "tight"].matrix.shape == (0, 0)


def test_a_refusal_is_raised_on_every_rank(runs):
    for found in runs(3):
        assert "not closed: it has 3 boundary edges" in found["open"]


def test_unmet_tolerances_are_a_warning_on_rank_0(runs):
    root, other = runs(2)
    assert not other["warnings"]
    categories, messages = zip(*root["warnings"])
    assert set(categories) == {ip.ToleranceWarning}
    assert all("forms are not harmonic to rtol = 1e-08 after 1 iter" in text for text in messages)


def test_surfaces_cover_what_is_awkward():
    K = SURFACES["coarse torus"]
    flipped, _ = intrinsic_delaunay(K, ip.cohomology_basis(K))
    ends = np.sort(np.stack(edge_ends(flipped)), axis=0)
    assert np.unique(ends, axis=1).shape[1] < K.n_edges, "flips made edges with the same ends"
    assert (np.diff(np.stack(edge_ends(SURFACES["random"])), axis=0) == 0).any(), "loops"
    assert SURFACES["more ranks than faces"].n_faces < 3
    assert SURFACES["more ranks than vertices"].n_vertices == 2
    assert SURFACES["random"].genus > 5


# ---- Failures and options ----


class OneRank:
    """A communicator of rank 0 alone."""

    rank, size = 0, 1

    @staticmethod
    def bcast(value):
        return value

    @staticmethod
    def allgather(value):
        return [value]

    @staticmethod
    def Barrier():  # noqa: N802  (MPI's name)
        pass


@pytest.mark.parametrize("how", [on_root, on_every_rank])
def test_collective_work_returns_or_raises(how):
    assert how(OneRank(), lambda: 3) == 3
    with pytest.raises(KeyError, match="lost"):
        how(OneRank(), lambda: {}["lost"])


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"rtol": 0.0}, "rtol = 0.0: residuals fall by a factor"),
        ({"rtol": 1.0}, "rtol = 1.0"),
        ({"rtol": float("nan")}, "rtol = nan"),
        ({"max_iterations": 0}, "max_iterations = 0: one iteration"),
    ],
)
def test_options_without_meaning_are_refused(options, message):
    with pytest.raises(ValueError, match=message):
        period_matrix(SURFACES["L"], comm=OneRank(), **options)


@pytest.mark.parametrize(
    ("load", "module", "name"), [(world, "mpi4py", "mpi4py"), (load_petsc, "petsc4py", "petsc4py")]
)
def test_missing_libraries_are_named(monkeypatch, load, module, name):
    monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(ImportError, match=rf"{name} cannot be imported.*setup --distributed") as no:
        load()
    assert 'pip install "igl_periods[distributed]"' in str(no.value)


def test_neither_library_is_imported_with_the_package():
    code = (
        "import sys, igl_periods, igl_periods.distributed; "
        "assert not {'mpi4py', 'petsc4py'} & set(sys.modules)"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


# ---- The command ----

COMMAND = ("-m", "igl_periods.distributed")


@pytest.fixture
def torus(tmp_path):
    path = tmp_path / "torus.off"
    igl.write_triangle_mesh(str(path), *torus_of_revolution(2.0, 0.8, 20, 12))
    return path


def test_command_prints_one_document(torus):
    done = mpiexec(2, *COMMAND, torus, "--json", "--rtol", "1e-10")
    assert done.returncode == 0, done.stderr
    document = json.loads(done.stdout)
    pm = ip.period_matrix(*ip.load_mesh(torus)[:2])
    found = np.array(document["mesh_marking"]["dirichlet"])
    np.testing.assert_allclose(found, pm.dirichlet, rtol=1e-12, atol=1e-12)
    assert document["mesh_marking"]["bound"] == pytest.approx(pm.bound, rel=1e-9)
    assert document["options"]["rtol"] == 1e-10
    assert document["mesh"]["loaded"]["triangles"] == 480


def test_command_says_it_in_words():
    done = mpiexec(1, *COMMAND, HERE.parent / "data" / "omega_1.json", "--no-delaunay", "--quiet")
    assert done.returncode == 0, done.stderr
    assert "Period matrix Π of genus 2" in done.stdout
    assert "This is a theorem" in done.stdout


def test_a_refused_mesh_ends_all_ranks_and_is_told_once(tmp_path):
    path = tmp_path / "open.off"
    igl.write_triangle_mesh(str(path), np.eye(3), np.array([[0, 1, 2]]))
    done = mpiexec(2, *COMMAND, path)
    assert done.returncode == 1
    assert not done.stdout
    said = [line for line in done.stderr.splitlines() if line.startswith("igl-periods")]
    assert len(said) == 1
    assert f"{path}: the surface is not closed: it has 3 boundary edges" in said[0]


def test_a_failure_of_one_rank_alone_ends_all(torus):
    # Rank 1 fails where the others wait for it.
    code = (
        "import sys\n"
        "from igl_periods.distributed import __main__ as command, pipeline\n"
        "from igl_periods.distributed.libraries import world\n"
        "def fail(*_):\n"
        "    raise MemoryError('no memory on rank 1')\n"
        "if world().rank == 1:\n"
        "    pipeline.harmonic_potentials = fail\n"
        f"sys.exit(command.main([{str(torus)!r}]))\n"
    )
    done = mpiexec(2, "-c", code)
    assert done.returncode == 1
    assert done.stderr.count("MemoryError: no memory on rank 1") == 1


@pytest.mark.parametrize(
    ("arguments", "code", "message"),
    [
        (["missing.off"], 1, "igl-periods: there is no"),
        (["torus.off", "--rtol", "2"], 1, "torus.off: rtol = 2.0"),
        (["torus.off", "--rtol", "much"], 2, "invalid float value: 'much'"),
        (["--help"], 0, "all ranks of mpiexec"),
    ],
)
def test_exit_codes(torus, monkeypatch, capsys, arguments, code, message):
    monkeypatch.setattr(command, "world", OneRank)
    for module in (command, pipeline):
        monkeypatch.setattr(module, "load_petsc", lambda: None)
    monkeypatch.chdir(torus.parent)
    assert command.main(arguments) == code
    printed = capsys.readouterr()
    assert message in printed.out + printed.err


@pytest.mark.parametrize("missing", ["mpi4py", "petsc4py"])
def test_command_without_its_libraries_is_refused(monkeypatch, capsys, missing):
    if missing == "petsc4py":
        monkeypatch.setattr(command, "world", OneRank)
    monkeypatch.setitem(sys.modules, missing, None)
    assert command.main(["torus.off"]) == 1
    assert f"{missing} cannot be imported" in capsys.readouterr().err
