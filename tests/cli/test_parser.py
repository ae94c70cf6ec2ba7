"""Wrong command lines: what was meant, what has no effect; and signs that are not options."""

import argparse

import pytest

from igl_periods.cli.parser import Parser, refuse_without_effect
from igl_periods.cli.program import _parser


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ("comput x.off", "did you mean compute?"),
        ("--versoin", "there is no option --versoin; did you mean --version?"),
        ("compute x.off --tolerence 1e-3", "there is no option --tolerence; did you mean --tol"),
        ("compute x.off --tolerence=1e-3", "there is no option --tolerence; did you mean --tol"),
        ("render x.off --outptu p.png", "there is no option --outptu; did you mean --output?"),
        ("render x.off -o p.png --show cycle", "did you mean cycles?"),
        ("compute x.off --weights extrinsik", "did you mean extrinsic?"),
        ("demo wente", "did you mean wente_20x20?"),
        ("batch m -o x.csv --wokers 2", "did you mean --workers?"),
        ("compute x.off --json --colour", "there is no option --colour\n"),
    ],
)
def test_what_was_meant_is_named(arguments, message, capsys):
    with pytest.raises(SystemExit) as end:
        _parser().parse_args(arguments.split())
    assert end.value.code == 2
    assert message in capsys.readouterr().err


def test_what_argparse_accepts_is_accepted():
    options = _parser().parse_args(["compute", "--tol", "1e-3", "--max-mem=2", "--", "--odd.off"])
    assert (options.tolerance, options.max_memory, options.meshes) == (1e-3, 2.0, ["--odd.off"])


def test_values_may_begin_with_a_sign():
    arguments = ["render", "x.off", "-o", "p.png", "--direction", "-1,0,-.5"]
    options = _parser().parse_args([*arguments, "--show", "density", "--form", "-1+2j,0"])
    assert options.direction == (-1.0, 0.0, -0.5)
    assert options.form.tolist() == [-1 + 2j, 0]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ("--weights extrinsic --no-delaunay", "--no-delaunay has no effect with extrinsic"),
        ("--weights extrinsic --degree 2", "extrinsic weights have degree 1 and no bound"),
        ("--tolerance -1", "a bound is always positive"),
        ("--degree 0", "degree 1 at least"),
        ("--max-memory 0", "a number of gigabytes above 0"),
        ("--max-memory nan", "a number of gigabytes above 0"),
    ],
)
@pytest.mark.parametrize(
    "command", ["compute x.off", "identify x.off", "report x.off -o x.html", "view x.off"]
)
def test_options_that_contradict_each_other(command, arguments, message, capsys):
    with pytest.raises(SystemExit) as end:
        _parser().parse_args([*command.split(), *arguments.split()])
    assert end.value.code == 2
    assert message in capsys.readouterr().err


@pytest.mark.parametrize("option", ["--repair", "--weld 0", "--fill-holes 3"])
def test_gluings_are_never_repaired(option, capsys):
    with pytest.raises(SystemExit):
        _parser().parse_args(["compute", "a.json", "b.json", *option.split()])
    assert f"{option.split()[0]} has no effect on gluings" in capsys.readouterr().err
    # Beside a mesh it has an effect.
    assert _parser().parse_args(["compute", "a.json", "b.off", *option.split()]).meshes


def test_checks_name_the_option_as_it_is_written():
    parser = Parser()
    parser.add_argument("--no-flips", dest="flips", action="store_false")
    parser.add_argument("-s", "--size", type=int, default=3)
    for given, name in ((["--no-flips"], "--no-flips"), (["-s", "4"], "--size")):
        options = parser.parse_args(given)
        with pytest.raises(ValueError, match=f"^{name} has no effect here.$"):
            refuse_without_effect(parser, options, ("flips", "size"), "here")
    refuse_without_effect(parser, argparse.Namespace(flips=True, size=3), ("flips", "size"), "")
