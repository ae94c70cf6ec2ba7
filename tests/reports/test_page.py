"""The report: one page that holds everything, and asks the network for nothing."""

import base64
import io
import json
import re
import shutil
import subprocess
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import igl_periods as ip
from igl_periods.errors import RenderError
from igl_periods.reports import page as report
from igl_periods.reports.page import write_report
from igl_periods.surfaces import flat_torus, triply_periodic_minimal_surface

LAWSON = Path(__file__).parents[2] / "data" / "lawson_2_1.off"


BROWSERS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")


class Page(HTMLParser):
    """The attributes that name something outside the page, its text, and its tags."""

    VOID = ("meta", "link", "img", "br", "hr")

    def __init__(self, path):
        super().__init__()
        self.sources, self.tags, self.text, self.open = [], [], "", []
        self.feed(path.read_text(encoding="utf-8"))
        assert self.open == []

    def handle_starttag(self, tag, attributes):
        self.tags.append(tag)
        self.sources += [value for name, value in attributes if name in ("src", "href", "srcset")]
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.text += data

    def data(self, kind):
        start = f"data:{kind};base64,"
        return [base64.b64decode(s[len(start) :]) for s in self.sources if s.startswith(start)]


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """The report of a mesh of genus 2, with small pictures."""
    path = tmp_path_factory.mktemp("report") / "report.html"
    V, F, mesh = ip.load_mesh(LAWSON)
    pm = ip.period_matrix(V, F).reduced()
    write_report(path, pm, name="<Lawson & co>", mesh=mesh, size=(120, 90))
    return path, pm


def test_the_page_needs_nothing_else(written):
    page = Page(written[0])
    assert all(source.startswith("data:") for source in page.sources)
    assert "script" not in page.tags
    text = written[0].read_text(encoding="utf-8")
    assert "default-src 'none'; img-src data:; style-src 'unsafe-inline'" in text
    assert "url(" not in text.split("<body>")[0]
    assert "<Lawson" not in text
    assert "<Lawson & co>" in page.text


def test_the_page_holds_pictures_and_histograms(written):
    page = Page(written[0])
    pictures = [np.asarray(Image.open(io.BytesIO(data))) for data in page.data("image/png")]
    assert len(pictures) == 5
    for picture in pictures:
        assert picture.shape == (90, 120, 3)
        assert 0.1 < np.mean((picture < 250).any(axis=2)) < 0.9
    histograms = page.data("image/svg+xml")
    assert len(histograms) == 6
    assert all(svg.count(b"<path") > 20 for svg in histograms)
    assert page.tags.count("figcaption") == 11


def test_the_page_holds_the_matrix_and_what_is_known_about_it(written):
    path, pm = written
    page = Page(path)
    (document,) = (json.loads(data) for data in page.data("application/json"))
    matrix = np.array(document["matrix"]["real"]) + 1j * np.array(document["matrix"]["imag"])
    assert np.array_equal(matrix, pm.matrix)
    (stated,) = re.findall(r"known to within (\S+), relative", page.text)[:1]
    assert pm.bound <= float(stated) <= 1.1 * pm.bound
    # Imaginary, by the symmetries of the surface.
    cells = re.findall(r"(−?\d+\.\d+) i(?![a-z])", page.text)
    printed = 1j * np.array([float(x.replace("−", "-")) for x in cells])
    np.testing.assert_allclose(printed.reshape(2, 2), pm.matrix, rtol=0, atol=5.1e-3)
    assert "766 vertices, 1536 triangles" in page.text
    assert "What limits the accuracy" in page.text
    assert "together 2 = 2g − 2" in page.text
    assert "Period matrices of polyhedral surfaces" in page.text


def test_surfaces_without_positions_have_a_report_without_pictures(tmp_path):
    path = tmp_path / "torus.html"
    write_report(path, ip.period_matrix(flat_torus(0.2 + 1.1j, 4)), name="torus")
    page = Page(path)
    assert page.data("image/png") == []
    assert len(page.data("image/svg+xml")) == 6
    assert "There are no pictures: the surface has no positions in space" in page.text
    assert "No mesh file was read" in page.text


def test_machines_that_cannot_draw_make_a_report_without_pictures(tmp_path, monkeypatch, caplog):
    def render(*_):
        raise RenderError("libEGL.so.1 is missing")

    monkeypatch.setattr(report, "render", render)
    V, F, _ = ip.load_mesh(LAWSON)
    write_report(tmp_path / "report.html", ip.period_matrix(V, F), name="Lawson")
    assert "There are no pictures: libEGL.so.1 is missing" in Page(tmp_path / "report.html").text
    assert "no pictures: libEGL.so.1 is missing" in caplog.text


def test_spheres_and_uncertified_matrices(tmp_path, monkeypatch):
    path = tmp_path / "report.html"
    V = [[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
    sphere = ip.period_matrix(V, [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
    write_report(path, sphere, name="sphere", size=(80, 60))
    page = Page(path)
    assert len(page.data("image/png")) == 1
    assert "The surface is a sphere" in page.text
    monkeypatch.setattr(report, "_pictures", lambda *_: "")
    V, F, _ = ip.load_mesh(LAWSON)
    write_report(path, ip.period_matrix(V, F, weights="extrinsic"), name="extrinsic")
    assert "There is no bound" in Page(path).text


@pytest.mark.slow
def test_a_browser_shows_the_page_without_complaint(written, tmp_path):
    browser = next(filter(None, map(shutil.which, BROWSERS)), None)
    if browser is None:
        pytest.skip(f"no browser: none of {', '.join(BROWSERS)} is installed")
    broken = tmp_path / "broken.html"
    text = written[0].read_text(encoding="utf-8")
    broken.write_text(text.replace("</body>", '<img src="http://example.invalid/x.png"></body>'))
    complaints, picture = browse(browser, written[0], tmp_path)
    assert complaints == []
    # The pictures are there: colours, not only text.
    assert np.mean(np.ptp(picture.astype(int), axis=2) > 60) > 0.01
    # A request to the network would be refused, and seen here.
    (complaint,), _ = browse(browser, broken, tmp_path)
    assert "Content Security Policy" in complaint


def browse(browser, page, folder):
    """What the browser complains about in its console, and what it shows."""
    screenshot = folder / "page.png"
    options = ["--headless", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr"]
    options += [f"--user-data-dir={folder / 'profile'}", "--window-size=900,1600"]
    done = subprocess.run(
        [browser, *options, f"--screenshot={screenshot}", page.as_uri()],
        capture_output=True,
        text=True,
        timeout=120,
        check=True,
    )
    complaints = [line for line in done.stderr.splitlines() if "CONSOLE" in line]
    return complaints, np.asarray(Image.open(screenshot).convert("RGB"))


def test_remarks_are_on_the_page_and_bad_places_are_refused(tmp_path, monkeypatch):
    pm = ip.period_matrix(flat_torus(0.2 + 1.1j, 4))
    write_report(tmp_path / "r.html", pm, name="torus", remarks=["Bound < 1 was asked for."])
    assert "Bound < 1 was asked for." in Page(tmp_path / "r.html").text
    monkeypatch.setattr(report, "mesh_quality", None)
    with pytest.raises(FileNotFoundError, match="there is no folder"):
        write_report(tmp_path / "no" / "r.html", pm, name="torus")


def test_cells_of_periodic_surfaces_are_shown_in_copies(tmp_path):
    V, F, lattice = triply_periodic_minimal_surface("D", 1)
    pm = ip.period_matrix(ip.DeltaComplex.from_mesh(V, F, lattice=lattice)).reduced()
    path = tmp_path / "page.html"
    write_report(path, pm, name="D", size=(64, 48), copies=(2, 1, 1))
    text = path.read_text(encoding="utf-8")
    assert "There are no pictures" not in text
    assert text.count("<img") > 5
