"""A surface to turn: what its page holds, and what a browser makes of it."""

import json
import re

import numpy as np
import pytest
from support.browser import browse

import igl_periods as ip
from igl_periods.pictures.all_scenes import CHECKERBOARD, CYCLES, scenes_of_matrix
from igl_periods.pictures.scenes import plain_scene
from igl_periods.pictures.viewer import Viewer, interactive, viewer_of_scenes
from igl_periods.surfaces import flat_torus

NAMES = ["surface", "checkerboard", "length |ζ|", "origin of the bound"]
# A control is pressed as a person does.
PRESS = """viewer.then(async () => {
  [...document.querySelectorAll("label")].find((l) => l.textContent === "NAME").click();
  await new Promise((done) => setTimeout(done, 200));
})"""
KEY = """viewer.then((v) => {
  const scene = document.getElementById("scene");
  scene.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowLeft" }));
})"""
FADE = """viewer.then((v) => {
  const slider = document.getElementById("transparency");
  slider.value = 60;
  slider.dispatchEvent(new Event("input"));
})"""
LEGEND = 'viewer.then(() => [...document.querySelectorAll("#legend li")].map((l) => l.textContent))'
CAPTION = 'document.getElementById("caption").textContent'
STEPS = {
    "first": "viewer.then((v) => v.painted)",
    "turned": "viewer.then((v) => v.turn(0.7, 0.3))",
    "keyed": KEY,
    "board": PRESS.replace("NAME", "checkerboard"),
    "bare": PRESS.replace("NAME", "canonical cycles"),
    "again": PRESS.replace("NAME", "canonical cycles"),
    "faded": FADE,
}


@pytest.fixture(scope="module")
def viewer(torus):
    return interactive(torus, title="A <torus>")


@pytest.fixture(scope="module")
def session(viewer, tmp_path_factory):
    """The one visit of a browser: pictures and texts by name, and the page."""
    folder = tmp_path_factory.mktemp("viewer")
    viewer.save(folder / "torus.html")

    async def work(page):
        found = {}
        for name, step in STEPS.items():
            await page.evaluate(step)
            found[name] = await page.picture()
        return found | {
            "caption": await page.evaluate(CAPTION),
            "legend": await page.evaluate(LEGEND),
        }

    address = (folder / "torus.html").as_uri()
    return browse(address, folder, work, ("--window-size=560,400",))


def coloured(picture):
    return np.ptp(picture, axis=2) > 60


def differ(one, other):
    return np.mean(np.abs(one - other).max(axis=2) > 24)


def test_a_browser_draws_the_surface_and_complains_of_nothing(session):
    found, page = session
    first = found["first"]
    drawn = (first < 250).any(axis=2)
    assert 0.1 < drawn.mean() < 0.9
    assert len(np.unique(first[drawn] // 8, axis=0)) > 50
    assert page.complaints == []
    assert [url for url in page.requests if url.startswith("http")] == []


def test_the_surface_turns(session):
    found, _ = session
    assert differ(found["first"], found["turned"]) > 0.05
    assert differ(found["turned"], found["keyed"]) > 0.01


def test_layers_are_switched_by_their_controls(session):
    found, _ = session
    # Half of the checkerboard is dark blue, nothing of the plain surface is.
    blue = [np.mean(found[k][..., 2] > found[k][..., 0] + 30) for k in ("keyed", "board")]
    assert blue[1] > blue[0] + 0.05
    assert "checkerboard of a holomorphic form" in found["caption"]
    assert differ(found["board"], found["bare"]) > 0.002


def test_cycles_are_seen_through_the_surface(session):
    found, _ = session
    assert found["legend"] == ["a1", "b1"]
    # a_1 is red, b_1 cyan; the parts behind the surface come to be seen.
    seen = [np.sum(coloured(p) & (p[..., 2] < 1.2 * p[..., 1]) | (p[..., 0] > 1.5 * p[..., 1]))
            for p in (found["board"], found["faded"])]  # fmt: skip
    assert seen[1] > 1.2 * seen[0] > 0
    assert differ(found["board"], found["faded"]) > 0.05


def layers(viewer):
    """What the controls know."""
    text = re.search(r'id="layers">(.*?)</script>', viewer.html, re.DOTALL)[1]
    return json.loads(text)


def test_the_page_holds_what_is_needed_and_nothing_of_the_network(viewer):
    known = layers(viewer)
    assert [layer["name"] for layer in known["colourings"]] == NAMES
    assert [layer["name"] for layer in known["curves"]] == [CYCLES, "cut"]
    assert [layer["visible"] for layer in known["curves"]] == [True, False]
    assert [len(layer["legend"]) for layer in known["colourings"]] == [0, 0, 3, 3]
    assert "A &lt;torus&gt;" in viewer.html
    assert "<torus>" not in viewer.html
    assert "default-src 'none'" in viewer.html
    assert re.findall(r'(?:src|href)="(?!data:)', viewer.html) == []
    assert len(viewer.html) < 2e6


def test_notebooks_show_the_page_in_a_frame(viewer, torus):
    shown = torus.show(title="A <torus>")
    assert isinstance(shown, Viewer)
    frame = shown._repr_html_()
    assert frame.startswith("<iframe")
    assert frame.count("<") == 2
    assert repr(shown) == repr(viewer)
    assert re.fullmatch(r"Viewer\('A <torus>', 1\.\d MB\)", repr(shown))
    assert (
        "Surface" in ip.DeltaComplex.from_mesh([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]]).show().title
    )


def test_the_first_layer_is_chosen_and_a_picture_stands_in(torus):
    picture = np.zeros((3, 4, 3), dtype=np.uint8)
    page = viewer_of_scenes(
        scenes_of_matrix(torus), title="torus", picture=picture, first=CHECKERBOARD
    )
    known = layers(page)
    assert known["colourings"][known["first"]]["name"] == CHECKERBOARD
    assert not any(layer["visible"] for layer in known["curves"])
    assert '<img src="data:image/png;base64,' in page.html


def test_flat_surfaces_are_seen_from_above():
    K = flat_torus(0.2 + 1.1j, 4)
    for page in (interactive(K), interactive(ip.period_matrix(K))):
        eye, target, up = np.reshape(layers(page)["camera"], (3, 3))
        assert np.array_equal(eye[:2], target[:2])
        assert eye[2] > 0.5
        assert up.tolist() == [0, 1, 0]


def test_scenes_of_different_surfaces_are_refused(torus):
    one, other = plain_scene(torus.complex), plain_scene(ip.DeltaComplex.from_mesh(*TETRAHEDRON))
    for scenes, count in (({}, 0), ({"one": one, "other": other}, 2)):
        with pytest.raises(ValueError, match=f"not of {count} surfaces"):
            viewer_of_scenes(scenes, title="nothing")


def test_bad_places_are_refused(viewer, tmp_path):
    with pytest.raises(FileNotFoundError, match="there is no folder"):
        viewer.save(tmp_path / "nowhere" / "page.html")


TETRAHEDRON = (
    [[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
    [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
)
