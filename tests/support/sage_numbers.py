"""Numbers and surfaces with the methods of Sage and sage-flatsurf that are read here."""

from fractions import Fraction


class SageRational:
    """A rational number of Sage: numerator and denominator are methods."""

    def __init__(self, p, q=1):
        self.value = Fraction(p, q)
        self.list_of = None

    def parent(self):
        return "QQ"

    def numerator(self):
        return self.value.numerator

    def denominator(self):
        return self.value.denominator

    def minpoly(self):
        return SagePolynomial([-self.value, Fraction(1)])

    def without_its_field(self):
        return self

    def __float__(self):
        return float(self.value)


class SagePolynomial:
    def __init__(self, coefficients):
        self.coefficients = coefficients

    def list(self):
        return [SageRational(c) for c in self.coefficients]


class SageField:
    """A number field with an embedding: its polynomial, its generator."""

    def __init__(self, polynomial, near):
        self.polynomial, self.near = polynomial, near

    def __call__(self, coefficients):
        return SageElement(self, coefficients)

    def defining_polynomial(self):
        return SagePolynomial(self.polynomial)

    def gen(self):
        return self([0, 1])


class SageElement:
    def __init__(self, field, coefficients):
        self.field = field
        self.coefficients = [Fraction(c) for c in coefficients]

    def parent(self):
        return self.field

    def list(self):
        return [SageRational(c) for c in self.coefficients]

    def minpoly(self):
        return self.field.defining_polynomial()

    def __float__(self):
        return float(sum(float(c) * self.field.near**k for k, c in enumerate(self.coefficients)))

    def without_its_field(self):
        """The generator as an element of the field of all algebraic numbers."""
        return SageAlgebraic(self)


class SageAlgebraic:
    def __init__(self, element):
        self.element = element

    def parent(self):
        return "AA"

    def minpoly(self):
        return self.element.minpoly()

    def __float__(self):
        return float(self.element)


class SagePolygon:
    def __init__(self, vertices):
        self._vertices = vertices

    def vertices(self):
        return tuple(self._vertices)


class SageSurface:
    """A surface of sage-flatsurf: labels, polygons, opposite edges."""

    def __init__(self, polygons, gluings):
        self._polygons = {label: SagePolygon(v) for label, v in polygons.items()}
        self._opposite = {one: other for pair in gluings for one, other in (pair, pair[::-1])}

    def labels(self):
        return iter(self._polygons)

    def polygon(self, label):
        return self._polygons[label]

    def opposite_edge(self, label, edge):
        return self._opposite.get((label, edge))
