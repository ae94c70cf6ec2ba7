"""Plain sentences and tables as HTML."""

import pytest

from igl_periods.reports.typesetting import figure, legend, mathematics, paragraphs, table


@pytest.mark.parametrize(
    ("text", "html"),
    [
        ("a_i meets b_i", "<i>a</i><sub>i</sub> meets <i>b</i><sub>i</sub>"),
        ("b12", "<i>b</i><sub>12</sub>"),
        ("ζ_1 ζ_2", "ζ<sub>1</sub> ζ<sub>2</sub>"),
        ("like h^0.67 with", "like <i>h</i><sup>0.67</sup> with"),
        ("at most 1e-05 was", "at most 10<sup>−5</sup> was"),
        ("2.4e+07", "2.4·10<sup>7</sup>"),
        ("I_2^5 / I_10", "<i>I</i><sub>2</sub><sup>5</sup> / <i>I</i><sub>10</sub>"),
        ("Lawson xi_{2,1}", "Lawson <i>ξ</i><sub>2,1</sub>"),
        ("x < y & 1", "x &lt; y &amp; 1"),
    ],
)
def test_mathematics_is_set(text, html):
    assert mathematics(text) == html


@pytest.mark.parametrize(
    "text", ["0.0065", "766 vertices", "a bound", "0x1e5", "b", "ab1", "page1e", "3.5", "a-b"]
)
def test_what_is_no_mathematics_stays(text):
    assert mathematics(text) == text


def test_tables_have_headers_and_captions():
    html = table("Facts & figures", [("genus", "2"), ("<name>", "1e-3")])
    assert "<caption>Facts &amp; figures</caption>" in html
    assert '<th scope="row">&lt;name&gt;</th><td>10<sup>−3</sup></td>' in html


def test_figures_say_what_is_to_be_seen():
    colours = legend([("a1", (1.0, 0.5, 0.0))])
    assert 'style="background:#ff8000"></span><i>a</i><sub>1</sub></li>' in colours
    assert legend([]) == ""
    html = figure(b"\x00", "image/png", 'a "b" a_1', colours)
    assert 'src="data:image/png;base64,AA==" alt="a &quot;b&quot; a_1"' in html
    assert html.endswith(f"<i>a</i><sub>1</sub>{colours}</figcaption></figure>")
    assert paragraphs(["one", "two"]) == "<p>one</p>\n<p>two</p>"
