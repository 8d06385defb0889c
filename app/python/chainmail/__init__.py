"""ChainMail in Python: deformable objects that follow a handle in real time.

A first drag::

    import chainmail

    sheet = chainmail.make_cloth(20, 20)
    deformer = chainmail.Deformer(sheet, "natural-queue")
    result = deformer.move(0, (-5, -3))  # element 0 goes there; the others answer
    print(result.moved, "elements moved")
    print(deformer.body.positions())
"""

from importlib.util import find_spec as _find_spec

if _find_spec("numpy") is None:
    raise ImportError("chainmail needs NumPy, which is not installed; install python3-numpy, or run pip install numpy")

from ._core import (
    Body,
    Deformer,
    Drag,
    Elasticity,
    EquilibriumCertificate,
    Handle,
    Job,
    LinkSoftness,
    Mesh,
    MoveResult,
    Pose,
    ReferenceSolution,
    Rotation,
    Snapshot,
    __version__,
    calibrate,
    compare,
    deform,
    displacement,
    distance,
    elastic_energy,
    file_formats,
    make_block,
    make_cloth,
    make_grid,
    make_line,
    make_mesh,
    make_tetra,
    methods,
    physical_error,
    physical_error_of_rest,
    ramp,
    reference_solution,
    refusal,
    violation,
    write_mesh,
    write_preset,
)
from .errors import Cancelled, Error
from .files import read_mesh

from .parameter_study import standard_drag, study, study_graph

__all__ = [
    "Body",
    "Cancelled",
    "Deformer",
    "Drag",
    "Elasticity",
    "EquilibriumCertificate",
    "Error",
    "Handle",
    "Job",
    "LinkSoftness",
    "Mesh",
    "MoveResult",
    "Pose",
    "ReferenceSolution",
    "Rotation",
    "Snapshot",
    "__version__",
    "calibrate",
    "compare",
    "deform",
    "displacement",
    "distance",
    "elastic_energy",
    "file_formats",
    "make_block",
    "make_cloth",
    "make_grid",
    "make_line",
    "make_mesh",
    "make_tetra",
    "methods",
    "physical_error",
    "physical_error_of_rest",
    "ramp",
    "read_mesh",
    "reference_solution",
    "refusal",
    "standard_drag",
    "study",
    "study_graph",
    "violation",
    "write_mesh",
    "write_preset",
]
