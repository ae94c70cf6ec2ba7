"""Proved digits: period matrices in balls."""

from .computation import enclose as enclose
from .enclosure import PeriodEnclosure as PeriodEnclosure
from .proof import Proved as Proved
