"""What Open3D needs of the system is asked for, and named where it is missing."""

import ctypes

import pytest

from igl_periods.errors import RenderError
from igl_periods.pictures import drivers
from igl_periods.pictures.drivers import check_egl, check_vulkan


class Library:
    """A library whose functions do nothing, and return a number."""

    def __init__(self, result):
        self.result = result

    def __getattr__(self, name):
        result = self.result

        class Function:
            restype = None

            def __call__(self, *arguments):
                return result

        function = Function()
        setattr(self, name, function)
        return function


@pytest.mark.parametrize(
    ("check", "result", "library", "package"),
    [
        (check_egl, 0, "EGL finds no driver.*libegl-mesa0", "libEGL.so.1 is missing.*libegl1"),
        (
            check_vulkan,
            -9,
            "Vulkan finds no driver.*mesa-vulkan-drivers",
            "libvulkan.so.1 is missing.*mesa-vulkan-drivers",
        ),
    ],
)
def test_missing_drivers_are_named(monkeypatch, check, result, library, package):
    monkeypatch.setattr(ctypes, "CDLL", lambda name: Library(result))
    with pytest.raises(RenderError, match=library):
        check()

    def missing(name):
        raise OSError(f"{name}: cannot open shared object file")

    monkeypatch.setattr(ctypes, "CDLL", missing)
    with pytest.raises(RenderError, match=package):
        check()


def test_a_driver_that_hangs_is_named(monkeypatch):
    monkeypatch.setattr(ctypes, "CDLL", lambda name: Library(0))
    found = ["Mesa 22.3.6 (LLVM 15.0.6)"]
    monkeypatch.setattr(drivers, "_vulkan_drivers", lambda vulkan: found)
    with pytest.raises(RenderError, match=r"waits for ever for .* Mesa 22\.3\.6 .*newer Mesa"):
        check_vulkan()
    # Another device beside it, the renderer of a newer version, one in hardware.
    for driver in ("Mesa 25.0.7-2+deb13u1 (LLVM 19.1.7)", "Mesa 22.3.6", "560.35.03"):
        found[1:] = [driver]
        check_vulkan()
