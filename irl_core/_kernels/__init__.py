"""Compiled loops: arrays in, arrays out. Each module is loaded, and Numba with it, when it is first used."""

from importlib import import_module
from types import ModuleType


def __getattr__(name: str) -> ModuleType:
    if name.startswith("_"):
        raise AttributeError(name)
    try:
        return import_module(f"{__name__}.{name}")
    except ModuleNotFoundError as error:
        raise AttributeError(f"There is no kernel module {name!r}.") from error
