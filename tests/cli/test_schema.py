"""The command ``schema``: the schema that comes with the package."""

import json

from igl_periods.cli.program import main
from igl_periods.reports import SCHEMA, json_schema


def test_schema(capsys):
    assert main(["schema"]) == 0
    printed = json.loads(capsys.readouterr().out)
    assert printed == json_schema()
    assert printed["properties"]["schema"] == {"const": SCHEMA}
