"""Gluings in JSON files: what is written is read, and what is none is refused."""

import json

import numpy as np
import pytest
from support.random_surfaces import random_gluing, random_lengths

import igl_periods as ip
from igl_periods.meshes.gluing_file import read_gluing


@pytest.mark.parametrize("seed", range(3))
def test_what_is_written_is_read_bit_for_bit(tmp_path, seed):
    rng = np.random.default_rng(seed)
    twin = random_gluing(12, rng)
    lengths = random_lengths(twin, rng)
    path = tmp_path / "surface.json"
    path.write_text(json.dumps({"lengths": lengths.tolist(), "twin": twin.tolist()}))
    K = read_gluing(path)
    assert np.array_equal(K.twin, twin)
    assert np.array_equal(K.lengths, ip.DeltaComplex.from_gluing(lengths, twin).lengths)


@pytest.mark.parametrize(
    "content",
    [
        "",
        "[]",
        "{",
        '{"lengths": [[1, 1, 1]]}',
        '{"lengths": [[1], [1, 2]], "twin": []}',
        "[" * 9999,
    ],
)
def test_files_that_hold_no_gluing(tmp_path, content):
    path = tmp_path / "surface.json"
    path.write_text(content)
    with pytest.raises(ip.MeshError, match="the file holds no gluing"):
        read_gluing(path)


def test_gluings_that_are_none_are_refused_as_such(tmp_path):
    path = tmp_path / "surface.json"
    path.write_text('{"lengths": [[1, 1, 1]], "twin": [[0, 2, 1]]}')
    with pytest.raises(ip.ComplexError):
        read_gluing(path)


def test_no_file(tmp_path):
    with pytest.raises(FileNotFoundError, match="nowhere"):
        read_gluing(tmp_path / "nowhere.json")
