"""The curve of genus 2 that belongs to a period matrix: :mod:`igl_periods.moduli.genus_two`."""

from .moduli.genus_two import absolute_igusa_invariants as absolute_igusa_invariants
from .moduli.genus_two import igusa_clebsch_invariants as igusa_clebsch_invariants
from .moduli.genus_two import rosenhain_roots as rosenhain_roots
from .moduli.invariant_derivatives import igusa_derivatives as igusa_derivatives
from .moduli.invariant_derivatives import rosenhain_derivatives as rosenhain_derivatives
