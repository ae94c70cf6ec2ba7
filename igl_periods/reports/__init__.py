"""Results in words, as JSON, and as a page.

==================  ===========================================================================
``words``           every sentence about a bound, a mesh, a parametrization: once
``terminal_text``   what the command line prints
``enclosure_text``  the same of an enclosure
``curve_text``      equations and invariants of curves
``json_document``   the same for programs
``findings``        invariants, symmetries, named surfaces
``typesetting``     sentences and tables as HTML
``histograms``      angles, weights and errors as pictures
``page``            one self-contained HTML file, with pictures
==================  ===========================================================================
"""

from .words import method_in_words, parametrization_in_words
from .terminal_text import LARGEST_PRINTED, summary
from .enclosure_text import enclosure_summary, lengths_in_words
from .curve_text import curve_summary, curve_to_json, invariant_lines, number_to_json
from .json_document import (
    SCHEMA,
    document_to_json,
    identification_to_json,
    json_schema,
    refusal_to_json,
    result_to_json,
)
from .page import write_report

__all__ = [
    "method_in_words",
    "parametrization_in_words",
    "LARGEST_PRINTED",
    "summary",
    "enclosure_summary",
    "lengths_in_words",
    "curve_summary",
    "curve_to_json",
    "invariant_lines",
    "number_to_json",
    "SCHEMA",
    "json_schema",
    "document_to_json",
    "refusal_to_json",
    "result_to_json",
    "identification_to_json",
    "write_report",
]
