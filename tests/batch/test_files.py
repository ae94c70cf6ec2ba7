"""Which files a run is about: folders, lists, names."""

import os

import pytest
from support.mesh_folders import TETRAHEDRON, write_tori

import igl_periods as ip
from igl_periods.batch import find_files, rows_of


def test_a_folder_is_searched_with_all_folders_in_it(tmp_path):
    for name in ("b.off", "a/z.OBJ", "a/y/x.json", "c.txt", ".hidden.off", ".git/d.off"):
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.touch()
    (tmp_path / "lost.ply").symlink_to("nowhere.ply")
    os.mkfifo(tmp_path / "pipe.off")
    found = find_files(tmp_path)
    assert list(found) == ["a/y/x.json", "a/z.OBJ", "b.off", "lost.ply"]
    assert found["a/z.OBJ"] == tmp_path / "a/z.OBJ"


def test_a_list_is_relative_to_its_folder(tmp_path, monkeypatch):
    folder = tmp_path / "lists"
    folder.mkdir()
    text = "\ufeff# meshes\n\nb.off\n  sub/a b.off  \r\n../c.off\nb.off\n/d.off\n"
    (folder / "list.txt").write_text(text)
    monkeypatch.chdir(tmp_path)
    found = find_files("lists/list.txt")
    assert list(found) == ["b.off", "sub/a b.off", "../c.off", "/d.off"]
    assert found["sub/a b.off"] == folder / "sub/a b.off"


def test_several_sources_are_named_as_given(tmp_path, monkeypatch):
    write_tori(tmp_path / "one", 1)
    write_tori(tmp_path / "two", 1)
    monkeypatch.chdir(tmp_path)
    assert list(find_files("two", "one/torus_00.off")) == ["two/torus_00.off", "one/torus_00.off"]
    assert list(find_files("one/torus_00.off")) == ["torus_00.off"]


def test_names_that_are_no_text(tmp_path):
    path = os.path.join(os.fsencode(tmp_path), b"caf\xe9.off")
    with open(path, "w") as file:
        file.write(TETRAHEDRON)
    ((name, found),) = find_files(tmp_path).items()
    assert name == "caf\\xe9.off"
    assert rows_of(found, name=name)[0]["genus"] == 0


@pytest.mark.parametrize(
    ("content", "error", "message"),
    [
        (None, FileNotFoundError, "there is no folder and no list"),
        (b"# nothing\n\n", ip.MeshError, "there is no path in this list"),
        (b"PAR1\0\0", ip.MeshError, "neither a folder nor a mesh nor a text file"),
    ],
)
def test_lists_that_are_none(tmp_path, content, error, message):
    if content is not None:
        (tmp_path / "list").write_bytes(content)
    with pytest.raises(error, match=message):
        find_files(tmp_path / "list")


def test_an_empty_folder(tmp_path):
    with pytest.raises(ip.MeshError, match=r"there is no mesh in the folder .* \(\.obj \.off"):
        find_files(tmp_path)
