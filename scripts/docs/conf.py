"""How Sphinx builds the site; ``python scripts/docs`` calls it."""

import logging
import os
import sys
import warnings
from importlib.metadata import version as installed_version
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path[:0] = [str(HERE), str(ROOT)]

from cross_references import resolve  # noqa: E402
from plain_mathematics import escaped_lines  # noqa: E402

project = "igl_periods"
author = "the igl_periods maintainers"
project_copyright = author
release = version = installed_version("igl_periods")
language = "en"

extensions = [
    "sphinx.ext.autodoc",
    "sphinx.ext.mathjax",
    "sphinx-mathjax-offline",
    "myst_parser",
    "numpydoc",
    "sphinx_gallery.gen_gallery",
]
exclude_patterns = ["examples/GALLERY_HEADER.rst"]
root_doc = "index"

autodoc_typehints = "none"
autodoc_member_order = "bysource"
autodoc_class_signature = "mixed"
numpydoc_show_class_members = False
numpydoc_xref_param_type = False
add_module_names = False
python_display_short_literal_types = True

myst_enable_extensions = ["attrs_block", "colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 3

# What the tutorials draw is drawn once; those that need another launcher or a framework are shown
# and not run.
warnings.filterwarnings("ignore", message=".*FigureCanvasAgg is non-interactive.*")
sphinx_gallery_conf = {
    "examples_dirs": str(ROOT / "scripts" / "examples"),
    "gallery_dirs": "examples",
    "filename_pattern": r"/(?!jax_|torch_|one_mesh_under_mpi)\w+\.py$",
    "ignore_pattern": r"__init__\.py",
    "within_subsection_order": "tutorial_order.by_number",
    "abort_on_example_error": True,
    "show_memory": False,
    "min_reported_time": 3600,
    "write_computation_times": False,
    "download_all_examples": False,
    "remove_config_comments": True,
    "plot_gallery": "IGL_PERIODS_TUTORIALS_NOT_RUN" not in os.environ,
    "image_scrapers": ("matplotlib",),
    "thumbnail_size": (400, 300),
    "capture_repr": (),
}
suppress_warnings = ["config.cache"]

html_theme = "furo"
html_title = f"igl_periods {release}"
html_static_path = [str(HERE / "static")]
html_css_files = ["site.css"]
html_js_files = ["site.js"]
html_show_search_summary = False  # it would be fetched, which pages from files may not do
html_copy_source = False
html_show_sourcelink = False
html_theme_options = {"navigation_with_keys": False}
pygments_style = "a11y-high-contrast-light"
pygments_dark_style = "a11y-high-contrast-dark"


logging.getLogger("igl_periods").setLevel(logging.WARNING)


def escape(app, what, name, obj, options, lines):
    lines[:] = escaped_lines(lines)


def setup(app):
    app.connect("autodoc-process-docstring", escape, priority=400)  # before numpydoc
    app.connect("missing-reference", resolve)
