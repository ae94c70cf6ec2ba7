"""What Open3D needs of the system, asked for before it does: it would end the whole process.

Version 0.19 draws through EGL, which can do without a display; version 0.20 through Vulkan.
"""

from __future__ import annotations

import ctypes

from igl_periods.errors import RenderError
from igl_periods.extras import missing_library

_SURFACELESS = 0x31DD  # EGL_PLATFORM_SURFACELESS_MESA
_INSTANCE_CREATE_INFO = 1  # VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO


def check_egl() -> None:
    """Raise RenderError unless EGL starts without a display."""
    egl = _loaded("libEGL.so.1")
    egl.eglGetPlatformDisplay.restype = egl.eglGetDisplay.restype = ctypes.c_void_p
    for display in (egl.eglGetPlatformDisplay(_SURFACELESS, None, None), egl.eglGetDisplay(None)):
        if display and egl.eglInitialize(ctypes.c_void_p(display), None, None):
            return
    raise RenderError(
        "cannot draw without a display: EGL finds no driver. The software renderer of Mesa is one "
        "(on Debian and Ubuntu: apt-get install libegl-mesa0 libgl1-mesa-dri)."
    )


def check_vulkan() -> None:
    """Raise RenderError unless Vulkan finds a device, be it one in software."""
    vulkan, instance, devices = _loaded("libvulkan.so.1"), ctypes.c_void_p(), ctypes.c_uint32()
    wanted = _InstanceCreateInfo(type=_INSTANCE_CREATE_INFO)
    if vulkan.vkCreateInstance(ctypes.byref(wanted), None, ctypes.byref(instance)) == 0:
        vulkan.vkEnumeratePhysicalDevices(instance, ctypes.byref(devices), None)
        vulkan.vkDestroyInstance(instance, None)
    if devices.value == 0:
        raise RenderError(
            "cannot draw: Vulkan finds no driver. The software renderer of Mesa is one (on Debian "
            "and Ubuntu: apt-get install mesa-vulkan-drivers)."
        )


class _InstanceCreateInfo(ctypes.Structure):
    """VkInstanceCreateInfo, of an instance without layers and extensions."""

    _fields_ = (
        ("type", ctypes.c_int),
        ("next", ctypes.c_void_p),
        ("flags", ctypes.c_uint32),
        ("application", ctypes.c_void_p),
        ("layer_count", ctypes.c_uint32),
        ("layers", ctypes.c_void_p),
        ("extension_count", ctypes.c_uint32),
        ("extensions", ctypes.c_void_p),
    )


def _loaded(library: str) -> ctypes.CDLL:
    try:
        return ctypes.CDLL(library)
    except OSError as error:
        raise RenderError(f"cannot draw: {missing_library(error)}") from error
