"""The journal: whatever happens to it, whole lines are kept."""

import pytest

from igl_periods.batch.journal import Journal


@pytest.fixture
def journal(tmp_path):
    """A journal of three files."""
    path = tmp_path / "x.parquet.journal"
    with Journal(path) as kept:
        for k in range(3):
            kept.append([(f"{k}.off", [{"hash": str(k), "bound": 0.1 + k / 3}])])
    return path


def test_a_journal_cut_anywhere_keeps_all_whole_lines(journal):
    whole = journal.read_bytes()
    with Journal(journal) as kept:
        everything = kept.rows
    assert len(everything) == 3
    for length in range(0, len(whole), 7):
        journal.write_bytes(whole[:length])
        lines = whole[:length].count(b"\n")
        with Journal(journal) as kept:
            assert list(kept.rows) == [f"{k}.off" for k in range(lines - 1)]
            kept.append([("new.off", [{"hash": None}])])
        with Journal(journal) as kept:
            assert kept.rows.pop("new.off") == [{"hash": None}]
            assert kept.rows.items() <= everything.items()


def test_damage_at_the_end_is_cut_off(journal):
    whole = journal.read_bytes()
    for damage in (b"\0" * 40, b"[]\n", b'["a", []]\n', b"{}\n{}\n", b"\xff\xfe\n", b"3\n"):
        journal.write_bytes(whole + damage)
        with Journal(journal) as kept:
            assert len(kept.rows) == 3
        assert journal.read_bytes() == whole


def test_the_last_line_about_a_file_counts(journal):
    with Journal(journal) as kept:
        kept.append([("1.off", [{"hash": "new"}])])
    with Journal(journal) as kept:
        assert kept.rows["1.off"] == [{"hash": "new"}]
    with Journal(journal, restart=True) as kept:
        assert kept.rows == {}


def test_a_journal_is_written_by_one_run_and_is_no_other_file(journal):
    with Journal(journal), pytest.raises(BlockingIOError, match="another run is writing"):
        Journal(journal)
    journal.write_text("my diary\n")
    with pytest.raises(FileExistsError, match="is not a journal of a batch"):
        Journal(journal, restart=True)
    assert journal.read_text() == "my diary\n"
