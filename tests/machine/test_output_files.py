"""Outputs that cannot be written are refused, and left alone."""

import os

import pytest

from igl_periods.machine import check_output


def test_what_can_be_written_is_not_touched(tmp_path):
    check_output(tmp_path / "new.png")
    assert not (tmp_path / "new.png").exists()
    (tmp_path / "old.png").write_text("old")
    check_output(tmp_path / "old.png", tmp_path / "nothing.off")
    assert (tmp_path / "old.png").read_text() == "old"


def test_what_cannot_be_written_is_refused(tmp_path):
    (tmp_path / "mesh.obj").touch()
    (tmp_path / "link.obj").symlink_to(tmp_path / "mesh.obj")
    with pytest.raises(FileNotFoundError, match=r"there is no folder '.*no' for 'x.png'"):
        check_output(tmp_path / "no" / "x.png")
    with pytest.raises(NotADirectoryError, match=r"mesh.obj' is not a folder"):
        check_output(tmp_path / "mesh.obj" / "x.png")
    with pytest.raises(IsADirectoryError, match="is a folder"):
        check_output(tmp_path)
    with pytest.raises(FileExistsError, match="would replace what is read"):
        check_output(tmp_path / "link.obj", tmp_path / "mesh.obj")


def test_rights_are_asked_for(tmp_path, monkeypatch):
    # As whoever is not root sees it.
    (tmp_path / "old.png").touch()
    monkeypatch.setattr(os, "access", lambda path, mode: False)
    with pytest.raises(PermissionError, match="is there and must not be written"):
        check_output(tmp_path / "old.png")
    with pytest.raises(PermissionError, match="nothing can be written in the folder"):
        check_output(tmp_path / "new.png")
