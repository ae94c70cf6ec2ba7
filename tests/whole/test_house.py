"""The rules of the house that import-linter does not know: names, lengths, tests, faces."""

import ast
import importlib
import types
from pathlib import Path

import pytest

import igl_periods as ip

ROOT = Path(__file__).parents[2]
SOURCE = ROOT / "igl_periods"
MODULES = sorted(path for path in SOURCE.rglob("*.py") if path.name != "__init__.py")
FACES = sorted(path for path in SOURCE.glob("*/__init__.py"))

# Modules without a test file of their own, and what tests them.
TESTED_ELSEWHERE = {
    "__main__.py": "tests/cli/test_program.py",
    "arrays.py": "annotations, checked by mypy",
    "distributed/__main__.py": "tests/distributed/test_command.py",
    "genus_two.py": "tests/moduli/test_genus_two.py",
    "errors.py": "the tests of the modules that raise them",
    "meshes/formats/compression.py": "tests/meshes/formats/test_read_dialects.py",
    "meshes/formats/gltf_accessors.py": "tests/meshes/formats/test_gltf.py",
    "meshes/formats/mesh_file.py": "tests/meshes/formats/test_read.py",
    "meshes/formats/placement.py": "tests/meshes/formats/test_gltf.py",
    "meshes/formats/ply_tables.py": "tests/meshes/formats/test_ply.py",
    "meshes/outlines.py": "tests/meshes/test_polygons.py",
    "periods/differentiable.py": "tests/periods/test_derivative.py",
    "surfaces/lawson/chart.py": "tests/surfaces/lawson/test_unstructured.py",
    "surfaces/named_surface.py": "tests/surfaces/test_named_surfaces.py",
}

# Rooms that a user enters by ``ip.…``.
PUBLIC_MODULES = {"forms", "genus_two", "surfaces"}


def relative(path):
    return path.relative_to(SOURCE).as_posix()


@pytest.mark.parametrize("path", MODULES, ids=relative)
def test_no_module_is_longer_than_a_person_reads_at_a_time(path):
    assert len(path.read_text().splitlines()) <= 400


@pytest.mark.parametrize("face", FACES, ids=relative)
def test_no_module_has_the_name_of_a_public_function_of_its_package(face):
    package = importlib.import_module(f"igl_periods.{face.parent.name}")
    modules = {path.stem for path in face.parent.iterdir() if path.name != "__init__.py"}
    public = {
        name for name in package.__all__ if not isinstance(getattr(package, name), types.ModuleType)
    }
    same = modules & public
    assert not same, (
        f"{face.parent.name}: {same} are modules and public functions: rename the modules"
    )


def test_public_names_that_are_modules_are_meant():
    modules = {name for name in ip.__all__ if isinstance(getattr(ip, name), types.ModuleType)}
    assert modules == PUBLIC_MODULES
    assert {path.stem for path in SOURCE.iterdir()} & set(ip.__all__) == PUBLIC_MODULES


def test_only_public_names_are_visible():
    assert {name for name in dir(ip) if not name.startswith("_")} == set(ip.__all__)
    assert len(set(ip.__all__)) == len(ip.__all__)
    assert all(getattr(ip, name).__doc__ for name in ip.__all__)


@pytest.mark.parametrize("face", FACES, ids=relative)
def test_faces_say_what_is_inside_and_export_it(face):
    package = importlib.import_module(f"igl_periods.{face.parent.name}")
    assert package.__doc__ is not None
    first, blank, *_ = package.__doc__.splitlines()
    assert first.endswith(".")
    assert blank == ""
    assert len(set(package.__all__)) == len(package.__all__)
    assert all(hasattr(package, name) for name in package.__all__)


@pytest.mark.parametrize("path", MODULES, ids=relative)
def test_every_module_has_its_tests(path):
    name = relative(path)
    mirror = ROOT / "tests" / path.relative_to(SOURCE).with_name(f"test_{path.name}")
    tested = mirror.exists() != (name in TESTED_ELSEWHERE)
    assert tested, f"write {mirror.relative_to(ROOT)}, or enter {name} in TESTED_ELSEWHERE"


def test_exceptions_are_about_modules_that_exist():
    assert set(TESTED_ELSEWHERE) <= {relative(path) for path in MODULES}


def imports(path):
    """Modules that a file imports from inside the library, as it names them."""
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.ImportFrom) and node.module and node.level == 0:
            yield node.module
        elif isinstance(node, ast.Import):
            yield from (name.name for name in node.names)


@pytest.mark.parametrize("path", MODULES + FACES, ids=relative)
def test_other_packages_are_imported_by_their_faces(path):
    own = path.relative_to(SOURCE).parts[0]
    for module in imports(path):
        parts = module.split(".")
        if parts[0] == "igl_periods" and len(parts) > 2:
            assert parts[1] == own, f"{relative(path)} imports {module}"


def test_every_public_function_is_documented():
    for name in ip.__all__:
        value = getattr(ip, name)
        assert getattr(value, "__doc__", None) or isinstance(value, int), name


def test_every_public_name_has_an_example():
    for name in ip.__all__:
        value = getattr(ip, name)
        if callable(value) and not (isinstance(value, type) and issubclass(value, Exception)):
            assert ">>> " in value.__doc__, f"{name} has no example in its docstring"
