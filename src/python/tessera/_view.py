# SPDX-License-Identifier: BSD-3-Clause
"""A page of a mesh to turn and to point at, made by the program; in a notebook a frame with it."""
from __future__ import annotations

import html
import pathlib
import sys
import tempfile
from typing import TYPE_CHECKING, Any, Optional

from . import _program
from ._errors import BY_EXIT_CODE, ProgramDied

if TYPE_CHECKING:
    from ._mesh import Mesh

_NAME = "view.html"


def show(mesh: Mesh, file: Optional[pathlib.Path], height: int) -> Optional[pathlib.Path]:
    """As `Mesh.show()`. Local."""
    display = _notebook_display()
    if file is None and display is not None:
        with tempfile.TemporaryDirectory(prefix="tessera_") as folder:
            page = _write(mesh, pathlib.Path(folder) / _NAME).read_text(encoding="utf-8")
        display(frame(page, height))
        return None
    written = _write(mesh, file or pathlib.Path(_NAME))
    print(f"open {written} in a browser")
    return written


def frame(page: str, height: int) -> str:
    """A frame that holds a page, as HTML. Local."""
    return (
        f'<iframe srcdoc="{html.escape(page)}" width="100%" height="{height}" style="border: 0" '
        'sandbox="allow-scripts" allow="clipboard-write"></iframe>'
    )


def _write(mesh: Mesh, file: pathlib.Path) -> pathlib.Path:
    file = file.absolute()
    code, said = _program.run([*_program.command_line(["info", str(mesh.file), "--html", str(file)], 1)], echo=False)
    if code != 0:
        raise BY_EXIT_CODE.get(code, ProgramDied)(_program.messages_of(said) or f"tessera info ended with code {code}", code)
    return file


def _notebook_display() -> Optional[Any]:
    """What shows HTML, if this process is the kernel of a notebook; on a terminal IPython would show a text."""
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython else None
    if shell is None or getattr(shell, "kernel", None) is None:
        return None
    from IPython.display import display

    # Not by its HTML class, which warns of frames.
    return lambda text: display({"text/html": text}, raw=True)
