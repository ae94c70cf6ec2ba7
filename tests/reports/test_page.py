"""The report: one page that holds everything, and asks the network for nothing."""

import base64
import io
import json
import re
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from support.browser import browse
from support.random_surfaces import torus_of_revolution

import igl_periods as ip
from igl_periods.errors import RenderError
from igl_periods.reports import page as report
from igl_periods.reports.page import write_report
from igl_periods.surfaces import flat_torus, triply_periodic_minimal_surface

LAWSON = Path(__file__).parents[2] / "data" / "lawson_2_1.off"


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
    """The report of a mesh of genus 2, with small pictures and without a surface to turn."""
    path = tmp_path_factory.mktemp("report") / "report.html"
    V, F, mesh = ip.load_mesh(LAWSON)
    pm = ip.period_matrix(V, F).reduced()
    how = {"mesh": mesh, "options": {"degree": 1}, "size": (120, 90), "interactive": False}
    write_report(path, pm, name="<Lawson & co>", **how)
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


def test_the_page_tells_options_invariants_and_how_to_cite(written):
    page = Page(written[0])
    for words in (
        "edge weightsintrinsic",
        "degree of the functions1",
        "proved in ball arithmeticno",
        "Lawson ξ2,1",
        "this does not prove it",
        "I25 / I10",
        "hyperellipticyes",
        "@incollection{BobenkoMercatSchmies2011,",
        "@software{igl_periods,",
        f"version = {{{ip.__version__}}}",
    ):
        assert words in page.text, words
    text = written[0].read_text(encoding="utf-8")
    assert str(LAWSON.parent) not in text
    assert "<i>a</i><sub>1</sub>" in text
    assert "h^" not in page.text


def test_the_page_can_be_read_without_seeing_it(written):
    text = written[0].read_text(encoding="utf-8")
    assert '<html lang="en">' in text
    assert re.findall(r"<h(\d)", text) == ["1", *6 * ["2"]]
    assert all(re.findall(r'<img [^>]*alt="([^"]*)"', text))
    assert text.count("<img") == text.count("alt=")
    assert text.count("<th ") == text.count('<th scope="row">') > 10
    assert text.count('<table class="facts"><caption>') == 5


def test_legends_are_below_the_pictures(written):
    text = written[0].read_text(encoding="utf-8")
    legends = re.findall(r'<ul class="legend">(.*?)</ul>', text)
    assert [legend.count("<li>") for legend in legends] == [4, 3, 3]
    assert all("</figcaption>" in text.partition(legend)[2][:40] for legend in legends)


def test_surfaces_without_positions_are_drawn_in_the_plane(tmp_path):
    path = tmp_path / "torus.html"
    write_report(path, ip.period_matrix(flat_torus(0.2 + 1.1j, 4)), name="torus", size=(60, 45))
    page = Page(path)
    assert len(page.data("image/png")) == 5
    assert len(page.data("image/svg+xml")) == 6
    assert page.tags.count("iframe") == 1
    assert "script-src 'unsafe-inline'; worker-src blob:" in path.read_text(encoding="utf-8")
    assert "No mesh file was read" in page.text


def test_what_cannot_be_drawn_has_a_report_without_pictures(tmp_path, caplog):
    V, F = torus_of_revolution(2.0, 0.7, 8, 6)
    path = tmp_path / "torus.html"
    write_report(path, ip.period_matrix(np.concatenate([V, V], axis=1), F), name="torus")
    page = Page(path)
    assert page.data("image/png") == []
    assert "iframe" not in page.tags
    assert "There are no pictures: the surface lies in R^6" in page.text
    assert "no pictures: the surface lies in R^6" in caplog.text


def test_machines_that_cannot_draw_make_a_report_without_pictures(tmp_path, monkeypatch, caplog):
    def render_all(*_):
        raise RenderError("libEGL.so.1 is missing")

    monkeypatch.setattr(report, "render_all", render_all)
    V, F, _ = ip.load_mesh(LAWSON)
    write_report(tmp_path / "report.html", ip.period_matrix(V, F), name="Lawson")
    page = Page(tmp_path / "report.html")
    assert "There are no pictures: libEGL.so.1 is missing" in page.text
    assert page.tags.count("iframe") == 1
    assert "no pictures: libEGL.so.1 is missing" in caplog.text


def test_spheres_and_uncertified_matrices(tmp_path, monkeypatch):
    path = tmp_path / "report.html"
    V = [[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
    sphere = ip.period_matrix(V, [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
    write_report(path, sphere, name="sphere", size=(80, 60), interactive=False)
    page = Page(path)
    assert len(page.data("image/png")) == 1
    assert "The surface is a sphere" in page.text
    monkeypatch.setattr(report, "_pictures", lambda *_: "")
    V, F, _ = ip.load_mesh(LAWSON)
    write_report(path, ip.period_matrix(V, F, weights="extrinsic"), name="extrinsic")
    assert "There is no bound" in Page(path).text


@pytest.mark.slow
def test_a_browser_shows_the_page_without_complaint(written, tmp_path):
    path, pm = written
    write_report(tmp_path / "turning.html", pm, name="Lawson", size=(120, 90))
    turning = "document.querySelector('iframe').contentWindow.viewer.then((v) => v.layers.first)"

    async def work(page):
        return await page.evaluate(turning), await page.picture()

    (first, picture), page = browse(
        (tmp_path / "turning.html").as_uri(), tmp_path / "1", work, ("--window-size=900,1600",)
    )
    assert first == 0
    assert page.complaints == []
    # The pictures are there: colours, not only text.
    assert np.mean(np.ptp(picture, axis=2) > 60) > 0.005
    # A request to the network would be refused, and seen here.
    broken = tmp_path / "broken.html"
    text = path.read_text(encoding="utf-8")
    broken.write_text(text.replace("</main>", '<img src="http://example.invalid/x.png"></main>'))

    async def look(page):
        return await page.picture()

    _, page = browse(broken.as_uri(), tmp_path / "2", look)
    (complaint,) = page.complaints
    assert "Content Security Policy" in complaint


def test_remarks_are_on_the_page_and_bad_places_are_refused(tmp_path, monkeypatch):
    pm = ip.period_matrix(flat_torus(0.2 + 1.1j, 4))
    monkeypatch.setattr(report, "_pictures", lambda *_: "")
    write_report(tmp_path / "r.html", pm, name="torus", remarks=["Bound < 1 was asked for."])
    assert "Bound < 1 was asked for." in Page(tmp_path / "r.html").text
    monkeypatch.setattr(report, "mesh_quality", None)
    with pytest.raises(FileNotFoundError, match="there is no folder"):
        write_report(tmp_path / "no" / "r.html", pm, name="torus")


def test_cells_of_periodic_surfaces_are_shown_in_copies(tmp_path):
    V, F, lattice = triply_periodic_minimal_surface("D", 1)
    pm = ip.period_matrix(ip.DeltaComplex.from_mesh(V, F, lattice=lattice)).reduced()
    path = tmp_path / "page.html"
    write_report(path, pm, name="D", size=(64, 48), copies=(2, 1, 1), interactive=False)
    text = path.read_text(encoding="utf-8")
    assert "There are no pictures" not in text
    assert text.count("<img") > 5
