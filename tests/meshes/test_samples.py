"""The surfaces that come with the package."""

import re
from pathlib import Path

import pytest

import igl_periods as ip
from igl_periods.meshes import SAMPLES

ROOT = Path(__file__).parents[2]


def test_samples_are_in_the_wheel():
    listed = re.findall(r'^  "data/([\w.]+)",$', (ROOT / "pyproject.toml").read_text(), re.M)
    assert sorted(listed) == sorted(file for file, _ in SAMPLES.values())


@pytest.mark.parametrize("name", SAMPLES)
def test_samples_have_the_genus_that_is_said(name):
    file = ip.sample_files()[name]
    if file.suffix == ".json":
        K = ip.DeltaComplex.from_json(file.read_text())
    else:
        K = ip.DeltaComplex.from_mesh(*ip.load_mesh(file)[:2])
    said = re.search(r"genus (\d)", SAMPLES[name][1])
    assert K.genus == (int(said[1]) if said else 1)
