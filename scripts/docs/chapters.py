"""The pages that are made from the package: chapters and reference.

A *chapter* is the first page of a package, its docstring.  A page of the *reference* holds all that
a package exports.  Every object has one entry, under the shortest name by which it is imported:
``igl_periods.period_matrix``, not ``igl_periods.periods.period_matrix``.
"""

import functools
import importlib
import inspect
import re
from pathlib import Path
from types import ModuleType

from plain_mathematics import escaped, escaped_lines, without_roles

import igl_periods as ip

SOURCE = Path(ip.__file__).parent
# Public modules that are not packages, and the chapters to which they belong.
LONE_MODULES = {"genus_two": "moduli"}
# Packages whose names one imports from them; of the others what matters is in igl_periods itself.
ENTERED = ("surfaces", "forms", "domains", "pictures", "reports", "batch", "distributed")
# Pictures of data/gallery that show what a chapter is about.
FIGURES = {
    "topology": ("lawson_2_1_cycles.png", "Canonical cycles on Lawson's surface of genus 2"),
    "elements": ("accuracy.svg", "Certified digits against unknowns and seconds"),
    "differentials": ("lawson_2_1_checkerboard.png", "A holomorphic form as a checkerboard"),
    "surfaces": ("wente_20x20_checkerboard.png", "Wente's torus"),
    "pictures": ("lawson_2_1_density.png", "The length of a holomorphic form in colours"),
}
# Where nothing else says so: exceptions, and what is defined directly below igl_periods.
HOME = "errors"


def package_names():
    """The packages, in the order in which the docstring of igl_periods lists them."""
    listed = re.findall(r"``(\w+)``", ip.__doc__)
    there = {path.parent.name for path in SOURCE.glob("*/__init__.py")}
    return [name for name in listed if name in there]


def face(package):
    return importlib.import_module(f"igl_periods.{package}")


def identity(module, name):
    """What tells an object from others: functions and classes by themselves, values by name."""
    value = getattr(module, name)
    known = inspect.isroutine(value) or inspect.isclass(value)
    return (value.__module__, value.__qualname__) if known else name


@functools.cache
def entries():
    """{where an object is defined, or its name if it is a value: its entry in the reference}."""
    modules = ["", *LONE_MODULES, *package_names()]
    found = {}
    for short in modules:
        module = importlib.import_module(f"igl_periods.{short}".rstrip("."))
        for name in public_names(module):
            found.setdefault(identity(module, name), f"{module.__name__}.{name}")
    return found


def public_names(module):
    """The names that a module exports, without modules."""
    names = getattr(module, "__all__", None) or [
        name
        for name, value in vars(module).items()
        if not name.startswith("_") and getattr(value, "__module__", None) == module.__name__
    ]
    return [name for name in names if not isinstance(getattr(module, name), ModuleType)]


def package_of(where):
    """The package in whose chapter an object is at home, by the module that defines it."""
    parts = where.split(".")
    if len(parts) > 1 and parts[1] in package_names():
        return parts[1]
    return LONE_MODULES.get(parts[1] if len(parts) > 1 else "", HOME)


@functools.cache
def entries_of():
    """{package: the names of its entries, those of igl_periods itself first}."""
    homes = {name: [] for name in [*package_names(), HOME]}
    for key, entry in entries().items():
        if isinstance(key, tuple):
            home = package_of(key[0])
        else:  # a value: it is at home where a package exports it
            exporting = [p for p in package_names() if key in public_names(face(p))]
            home = exporting[0] if exporting else package_of(entry)
        homes[home].append(entry)
    return homes


def located(entry):
    """The object of an entry."""
    module, _, name = entry.rpartition(".")
    return getattr(importlib.import_module(module), name)


def summary(entry):
    """The first paragraph of a docstring, on one line; nothing for values."""
    value = located(entry)
    if not (inspect.isroutine(value) or inspect.isclass(value)):
        return ""
    text = " ".join((inspect.getdoc(value) or "").split("\n\n")[0].split())
    return escaped(without_roles(text))


def role(entry):
    value = located(entry)
    return "class" if inspect.isclass(value) else "func" if inspect.isroutine(value) else "data"


def title(text, line="="):
    return f"{text}\n{line * len(text)}\n\n"


def is_for_users(entry):
    """Whether an entry is reached by ip.name, or by a package that users enter."""
    parts = entry.split(".")
    return len(parts) == 2 or parts[1] in ENTERED or parts[1] in LONE_MODULES


def table(names):
    """Names with what they are, as a list table."""
    yield ".. list-table::\n   :widths: 35 65\n   :class: names\n\n"
    for entry in names:
        shown = entry.removeprefix("igl_periods.")
        yield f"   * - :py:{role(entry)}:`{shown} <{entry}>`\n     - {summary(entry)}\n"
    yield "\n"


def chapter(package):
    """The page of a package: its docstring, and what it exports for users."""
    doc = inspect.getdoc(face(package))
    first, _, rest = doc.partition("\n")
    yield f".. py:module:: igl_periods.{package}\n\n"
    yield title(
        package.replace("_", " ").capitalize() + ": " + decapitalised(escaped(first.rstrip(".")))
    )
    if package in FIGURES:
        file, what = FIGURES[package]
        yield f".. figure:: ../../../data/gallery/{file}\n"
        yield f"   :alt: {what}\n   :width: 400\n\n   {what}.\n\n"
    yield "\n".join(escaped_lines(rest.strip().splitlines())) + "\n\n"
    names = [entry for entry in entries_of()[package] if is_for_users(entry)]
    if names:
        yield title("Names", "-")
        yield from table(names)
    yield f"Everything that this package exports: :doc:`/reference/{package}`.\n"


def decapitalised(text):
    """Without the capital of the first word, unless it is a name or a symbol."""
    first = text.split()[0]
    return text if not first[1:].islower() or first in ("Siegel",) else text[0].lower() + text[1:]


def entry_of_reference(entry):
    module, _, name = entry.rpartition(".")
    value = located(entry)
    yield f".. py:currentmodule:: {module}\n\n"
    if inspect.isclass(value):
        yield f".. autoclass:: {name}\n   :members:\n\n"
    elif inspect.isroutine(value):
        yield f".. autofunction:: {name}\n\n"
    else:
        shown = repr(value)
        yield f".. py:data:: {name}\n\n"
        if len(shown) < 60:
            yield f"   The value is ``{shown}``.\n\n"


def reference(package):
    """The page of all that a package exports."""
    yield title(f"igl_periods.{package}")
    names = entries_of()[package]
    if package != HOME:
        yield f"What it is about: :doc:`/chapters/{package}`.\n\n"
    users = [entry for entry in names if is_for_users(entry)]
    others = [entry for entry in names if not is_for_users(entry)]
    for entry in users:
        yield from entry_of_reference(entry)
    if others:
        if users:
            yield title("For the other packages", "-")
        for entry in others:
            yield from entry_of_reference(entry)


def contents(heading, text, folder, names):
    yield title(heading)
    yield text + "\n\n.. toctree::\n   :maxdepth: 1\n\n"
    yield from (f"   {name}\n" for name in names)
    yield f"\n.. {folder}\n"


def reference_index():
    yield title("Reference")
    yield "Every public name, in the order of the chapters.  ``ip`` is ``igl_periods``.\n\n"
    for package in [*package_names(), HOME]:
        users = [entry for entry in entries_of()[package] if is_for_users(entry)]
        yield title(package, "-")
        yield f"The whole of it: :doc:`{package}`.\n\n"
        if users:
            yield from table(users)
    yield ".. toctree::\n   :hidden:\n\n"
    yield from (f"   {name}\n" for name in [*package_names(), HOME])


def pages():
    """{path below the sources: text} of all pages made from the package."""
    made = {f"chapters/{name}.rst": "".join(chapter(name)) for name in package_names()}
    made |= {f"reference/{name}.rst": "".join(reference(name)) for name in [*package_names(), HOME]}
    made["reference/index.rst"] = "".join(reference_index())
    text = (
        "The packages of the library are the chapters of its mathematics; each begins with its\n"
        "conventions and formulas.  They are in reading order."
    )
    made["chapters/index.rst"] = "".join(contents("Chapters", text, "chapters", package_names()))
    return made
