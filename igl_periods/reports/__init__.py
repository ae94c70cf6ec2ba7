"""Results in words, as JSON, and as a page.

==================  ===========================================================================
``words``           every sentence about a bound, a mesh, a parametrization: once
``terminal_text``   what the command line prints
``enclosure_text``  the same of an enclosure
``json_document``   the same for programs
``page``            one self-contained HTML file, with pictures
==================  ===========================================================================
"""

from .words import parametrization_in_words
from .terminal_text import LARGEST_PRINTED, summary
from .enclosure_text import enclosure_summary, lengths_in_words
from .json_document import SCHEMA, result_to_json
from .page import write_report

__all__ = [
    "parametrization_in_words",
    "LARGEST_PRINTED",
    "summary",
    "enclosure_summary",
    "lengths_in_words",
    "result_to_json",
    "SCHEMA",
    "write_report",
]
