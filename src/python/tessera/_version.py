# SPDX-License-Identifier: BSD-3-Clause
"""The version. It stands in CMakeLists.txt alone; what installs the package writes it into its metadata."""
import importlib.metadata
import pathlib
import re


def _version() -> str:
    project = pathlib.Path(__file__).resolve().parents[3] / "CMakeLists.txt"
    if project.is_file():
        found = re.search(r"^project\(tessera VERSION ([\d.]+)", project.read_text(), re.MULTILINE)
        if found:
            return found[1]
    return importlib.metadata.version("tessera")


__version__ = _version()
