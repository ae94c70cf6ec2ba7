"""Text: a long token takes no more memory than it has."""

from support.mesh_files import (
    F4,
    GOOD_PLY,
    V4,
    written,
)

from igl_periods.meshes.load import load_mesh


def test_a_long_token_takes_no_more_memory_than_it_has(tmp_path):
    # A table of fixed width would have 40 GB.
    lines = GOOD_PLY.replace(b"comment", b"comment " + b"x" * 10).replace(
        b"vertex 4", b"vertex 200004"
    )
    zeros = b"0 0 0\n" * 200_000
    head, body = lines.split(b"end_header\n")
    body = body.replace(b"1 0 0\n", b"1." + b"0" * 200_000 + b" 0 0\n")
    V, F, _ = load_mesh(
        written(
            tmp_path / "mesh.ply",
            head + b"end_header\n" + body.replace(b"0 0 1\n", b"0 0 1\n" + zeros),
        )
    )
    assert F.tolist() == F4
    assert V[:4].tolist() == V4
