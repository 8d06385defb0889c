"""Meshes from files."""

from __future__ import annotations

import os
import shutil
from pathlib import Path
from typing import Callable

from . import _core

__all__ = ["read_mesh"]


def _import_program() -> str:
    """Returns the path of chainmail-import, or an empty text if it is not found.

    A wheel has it next to this file, a build in its folder bin, and Debian in libexec.
    """
    package = Path(__file__).absolute().parent
    folders = [package, package.parents[1] / "bin"]
    if len(package.parents) > 3:
        folders.append(package.parents[3] / "libexec/chainmail")
    programs = [folder / "chainmail-import" for folder in folders]
    found = [str(program) for program in programs if program.is_file()]
    return found[0] if found else shutil.which("chainmail-import") or ""


def read_mesh(
    path: str | os.PathLike[str],
    *,
    lattice: tuple[int, int, int] | None = None,
    spacing: float | None = None,
    space_dimension: int | None = None,
    threshold: float | None = None,
    every: int | None = None,
    data_outside: bool = False,
    stiff_where_dense: bool = True,
    weld: float | None = None,
    import_program: str | os.PathLike[str] | None = None,
    job: _core.Job | None = None,
    progress: Callable[[float], object] | None = None,
) -> _core.Mesh:
    """Reads a mesh, a volume of voxels, or a pair of TetGen files.

    The format is recognised by the content, else by the ending.

    `lattice` and `spacing` (mesh units) are for .dat files that do not state them. `space_dimension` is the number of
    coordinates; default: those along which the mesh extends. `threshold` is the lowest density of voxels that become
    elements, and `every` the number of voxels along each axis that become one. `data_outside` allows a volume's header
    to name data outside its own folder. Without `stiff_where_dense`, links of dense voxels are not stiffer than others.
    Points as close as `weld` (mesh units) become one element; default: by the format. `import_program` is the path of
    the program chainmail-import, which runs the readers of other libraries in a sandbox. `progress` is called with the
    share that is done, 0 to 1.

    Raises Error, with the line if the file is text, if the file does not exist, is damaged or has an unknown format;
    and Cancelled.
    """
    return _core.read_mesh(
        path,
        lattice=lattice,
        spacing=spacing,
        space_dimension=space_dimension,
        threshold=threshold,
        every=every,
        data_outside=data_outside,
        stiff_where_dense=stiff_where_dense,
        weld=weld,
        import_program=_import_program() if import_program is None else os.fspath(import_program),
        job=job,
        progress=progress,
    )
