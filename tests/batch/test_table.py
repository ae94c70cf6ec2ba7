"""The table: rows are read back bit for bit, and a file is replaced when the new one is whole."""

import os
import stat

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from support.mesh_folders import TETRAHEDRON, two_tori

from igl_periods.batch.rows import rows_of
from igl_periods.batch.table import SCHEMA, write_rows


@pytest.fixture
def rows(tmp_path):
    (tmp_path / "sphere.off").write_text(TETRAHEDRON)
    (tmp_path / "broken.off").write_text("OFF")
    files = two_tori(tmp_path), tmp_path / "sphere.off", tmp_path / "broken.off"
    return [row for path in files for row in rows_of(path, name=path.name)]


def test_rows_are_read_back_bit_for_bit(rows, tmp_path):
    write_rows(rows, tmp_path / "x.parquet")
    table = pq.read_table(tmp_path / "x.parquet")
    assert table.schema.names == SCHEMA.names
    assert table.schema.metadata == SCHEMA.metadata
    assert len(rows) == 4
    for read, row in zip(table.to_pylist(), rows, strict=True):
        assert read == {name: row.get(name) for name in SCHEMA.names}


def test_the_permissions_are_those_of_any_new_file(rows, tmp_path):
    write_rows(rows, tmp_path / "x.parquet")
    (tmp_path / "other").touch()
    modes = {stat.S_IMODE(os.stat(tmp_path / name).st_mode) for name in ("x.parquet", "other")}
    assert len(modes) == 1


def test_rows_that_cannot_be_written_leave_the_file_as_it_was(rows, tmp_path, monkeypatch):
    output = tmp_path / "x.parquet"
    write_rows(rows, output)
    before, names = output.read_bytes(), sorted(os.listdir(tmp_path))

    def full(table, file):
        file.write(b"PAR1")
        raise OSError("no space left on device")

    monkeypatch.setattr(pq, "write_table", full)
    with pytest.raises(OSError, match="no space left"):
        write_rows(rows[:1], output)
    with pytest.raises(pa.ArrowInvalid):
        write_rows([{**rows[0], "genus": "two"}], output)
    assert output.read_bytes() == before
    assert sorted(os.listdir(tmp_path)) == names


def test_no_rows(tmp_path):
    write_rows([], tmp_path / "x.parquet")
    assert np.shape(pq.read_table(tmp_path / "x.parquet")) == (0, len(SCHEMA))
