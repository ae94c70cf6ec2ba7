"""References by other names than that of the entry, and to modules inside of packages.

Docstrings name objects by where they are defined, or by a package that exports them; entries have
one name.  A module inside a package is described on the page of its package.
"""

import importlib
import inspect
import sys

from chapters import HOME, LONE_MODULES, entries, package_names


def entry_name(target, module):
    """The name of the entry of what a docstring calls ``target``, or None."""
    value, owner, members = _found(target.lstrip("."), module)
    if owner is None:
        last = target.rpartition(".")[2]
        return entries().get(last) if value is not None else None
    entry = entries().get((owner.__module__, owner.__qualname__))
    return entry and ".".join([entry, *members])


def page_of_object(target, module):
    """The chapter of an object without an entry, or None."""
    owner = _found(target.lstrip("."), module)[1]
    return owner and page_of_module(owner.__module__, None)


def _found(target, module):
    """The object that is meant: by its path, from the module of the text, or anywhere inside."""
    inside = sorted(name for name in sys.modules if name.startswith("igl_periods."))
    own = [name for name in inside if module and name.startswith(f"{module}.")]
    for prefix in (
        "",
        f"{module}." if module else "",
        "igl_periods.",
        *(f"{n}." for n in own + inside),
    ):
        found = _followed(prefix + target)
        if found[0] is not None:
            return found
    return None, None, []


def _followed(path):
    """The object at a dotted path; its outermost function or class; the names below that."""
    parts = path.split(".")
    for n in range(len(parts), 0, -1):
        try:
            value = importlib.import_module(".".join(parts[:n]))
        except ImportError:
            continue
        owner, members = None, []
        for name in parts[n:]:
            value = (
                inspect.getattr_static(value, name, None) if owner else getattr(value, name, None)
            )
            if value is None:
                return None, None, []
            if owner is not None:
                members.append(name)
            elif inspect.isclass(value) or inspect.isroutine(value):
                owner = value
        return value, owner, members
    return None, None, []


def page_of_module(target, module):
    """The chapter of the package that a module is in, or None."""
    for path in (
        target,
        f"{module}{target}" if target.startswith(".") else f"igl_periods.{target}",
    ):
        parts = path.split(".")
        if parts[0] == "igl_periods":
            if len(parts) == 1:
                return "chapters/index"
            if parts[1] in package_names():
                return f"chapters/{parts[1]}"
            return f"reference/{LONE_MODULES.get(parts[1], HOME)}"
    return None


def resolve(app, env, node, contnode):
    """Find what Sphinx did not find; what is not found here either is warned of."""
    if node.get("refdomain") != "py":
        return None
    target, module = node["reftarget"], node.get("py:module")
    domain = env.get_domain("py")
    if node["reftype"] == "mod":
        page = page_of_module(target, module)
        if page is None:
            return None
        return _link(app, node, contnode, page, "")
    name = entry_name(target, module)
    if name is None or name not in domain.objects:
        page = page_of_object(target, module)
        return page and _link(app, node, contnode, page, "")
    found = domain.objects[name]
    return _link(app, node, contnode, found.docname, found.node_id)


def _link(app, node, contnode, page, anchor):
    from sphinx.util.nodes import make_refnode

    return make_refnode(app.builder, node["refdoc"], page, anchor, contnode)
