"""What Open3D needs of the system, asked for before it does: it would end the whole process.

Version 0.19 draws through EGL, which can do without a display; version 0.20 through Vulkan.
"""

from __future__ import annotations

import ctypes
import re

from igl_periods.errors import RenderError
from igl_periods.machine import missing_library

_SURFACELESS = 0x31DD  # EGL_PLATFORM_SURFACELESS_MESA


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
    """Raise RenderError unless Vulkan finds a driver, one in software too, that does not hang."""
    drivers = _vulkan_drivers(_loaded("libvulkan.so.1"))
    if not drivers:
        raise RenderError(
            "cannot draw: Vulkan finds no driver. The software renderer of Mesa is one (on Debian "
            "and Ubuntu: apt-get install mesa-vulkan-drivers)."
        )
    if all(_is_old_mesa(driver) for driver in drivers):
        raise RenderError(
            f"cannot draw: Open3D 0.20 waits for ever for the software renderer of {drivers[0]}. A "
            "newer Mesa will do, or Python 3.12 or older, where Open3D 0.19 draws."
        )


def _is_old_mesa(driver: str) -> bool:
    """Whether it is the renderer in software of Mesa 22 or older: 22.3 hangs, 25.0 does not."""
    found = re.match(r"Mesa (\d+)\..*LLVM", driver)
    return found is not None and int(found[1]) < 23


def _vulkan_drivers(vulkan: ctypes.CDLL) -> list[str]:
    """What the driver of each device says of itself, such as ``Mesa 25.0.7 (LLVM 19.1.7)``."""
    application = _ApplicationInfo(type=_APPLICATION_INFO, api=_VULKAN_1_1)
    wanted = _InstanceCreateInfo(
        type=_INSTANCE_CREATE_INFO, application=ctypes.addressof(application)
    )
    instance, count = ctypes.c_void_p(), ctypes.c_uint32()
    if vulkan.vkCreateInstance(ctypes.byref(wanted), None, ctypes.byref(instance)) != 0:
        return []
    try:
        vulkan.vkEnumeratePhysicalDevices(instance, ctypes.byref(count), None)
        devices = (ctypes.c_void_p * count.value)()
        vulkan.vkEnumeratePhysicalDevices(instance, ctypes.byref(count), devices)
        return [_driver(vulkan, device) for device in devices]
    finally:
        vulkan.vkDestroyInstance(instance, None)


def _driver(vulkan: ctypes.CDLL, device: int | None) -> str:
    driver = _DriverProperties(type=_DRIVER_PROPERTIES)
    properties = _DeviceProperties(type=_DEVICE_PROPERTIES_2, next=ctypes.addressof(driver))
    vulkan.vkGetPhysicalDeviceProperties2(ctypes.c_void_p(device), ctypes.byref(properties))
    return driver.info.decode(errors="replace")


# The structures of Vulkan, begun with their type and a pointer to the next one.
_APPLICATION_INFO, _INSTANCE_CREATE_INFO = 0, 1
_DEVICE_PROPERTIES_2, _DRIVER_PROPERTIES = 1_000_059_001, 1_000_196_000
_VULKAN_1_1 = (1 << 22) | (1 << 12)
_HEAD = (("type", ctypes.c_int), ("next", ctypes.c_void_p))


class _ApplicationInfo(ctypes.Structure):
    """VkApplicationInfo."""

    _fields_ = (
        *_HEAD,
        ("name", ctypes.c_char_p),
        ("version", ctypes.c_uint32),
        ("engine", ctypes.c_char_p),
        ("engine_version", ctypes.c_uint32),
        ("api", ctypes.c_uint32),
    )


class _InstanceCreateInfo(ctypes.Structure):
    """VkInstanceCreateInfo."""

    _fields_ = (
        *_HEAD,
        ("flags", ctypes.c_uint32),
        ("application", ctypes.c_void_p),
        ("layer_count", ctypes.c_uint32),
        ("layers", ctypes.c_void_p),
        ("extension_count", ctypes.c_uint32),
        ("extensions", ctypes.c_void_p),
    )


class _DeviceProperties(ctypes.Structure):
    """VkPhysicalDeviceProperties2, of which nothing is read: at most so many bytes."""

    _fields_ = (*_HEAD, ("properties", ctypes.c_uint64 * 256))


class _DriverProperties(ctypes.Structure):
    """VkPhysicalDeviceDriverProperties."""

    _fields_ = (
        *_HEAD,
        ("id", ctypes.c_int),
        ("name", ctypes.c_char * 256),
        ("info", ctypes.c_char * 256),
        ("conformance", ctypes.c_uint32),
    )


def _loaded(library: str) -> ctypes.CDLL:
    try:
        return ctypes.CDLL(library)
    except OSError as error:
        raise RenderError(f"cannot draw: {missing_library(error)}") from error
