"""Parameter studies: the same drag for each combination of mesh, softness and method.

Each combination is a point, which depends on its input alone. So points may run in any order, in other processes and
again after a process was lost, and give the same rows.
"""

from __future__ import annotations

import math
import statistics
import time
from typing import Any, Callable, Iterable, Iterator, Literal, Mapping, NamedTuple, Optional, Sequence, Union

from ._core import (
    Body,
    Deformer,
    Drag,
    LinkSoftness,
    Mesh,
    displacement,
    distance,
    elastic_energy,
    violation,
)
from .errors import Error

__all__ = ["standard_drag", "study", "study_graph"]

Table = dict[str, list[Any]]
Precision = Literal["float", "double"]
Meshes = Union[Mesh, Mapping[str, Mesh]]
Softnesses = Union[LinkSoftness, Sequence[LinkSoftness], None]
DragOf = Union[Drag, Callable[[Mesh], Drag], None]
Prepare = Optional[Callable[[Body], object]]

_MOST_POINTS = 1_000_000

_NO_FIGURES: dict[str, Any] = {
    "passes": None,
    "checked": None,
    "moved": None,
    "stopped": None,
    "violation_max": None,
    "violation_rms": None,
    "violation_fraction": None,
    "displacement_max": None,
    "displacement_rms": None,
    "energy": None,
    "exact_distance_max": None,
    "exact_distance_rms": None,
    "ms_median": None,
    "ms_max": None,
}


class _Object(NamedTuple):
    """What all points of a mesh and a softness share."""

    name: str
    mesh: Mesh
    softness: LinkSoftness
    drag: Drag
    prepare: Prepare
    precision: Precision


class _Point(NamedTuple):
    """A method with a number of sweeps on an object."""

    object: _Object
    method: str
    sweeps: int
    repetitions: int


def standard_drag(mesh: Mesh) -> Drag:
    """Returns the drag of a study that names none: element 0 moves away from the centre of the mesh, by 0.3 of the
    diagonal of its bounds, in 10 equal steps."""
    low, high = mesh.bounds
    start = mesh.rest_position(0)
    diagonal = sum((b - a) ** 2 for a, b in zip(low, high)) ** 0.5
    away = [at - (a + b) / 2 for at, a, b in zip(start, low, high)]
    length = sum(a * a for a in away) ** 0.5
    direction = [a / length for a in away] if length > 0 else ["xyz".index(mesh.axes[0]) == k for k in range(3)]
    return Drag("away", [0], [tuple(0.03 * step * diagonal * d for d in direction) for step in range(1, 11)])


def _body(one: _Object, precision: Precision) -> Body:
    body = Body(one.mesh, precision)
    body.set_softness(one.softness)
    if one.prepare is not None:
        one.prepare(body)
    return body


def _run(one: _Object, method: str, sweeps: int, precision: Precision) -> tuple[Body, dict[str, Any], list[float]]:
    """Runs the drag once, and returns the body, what the passes did, and their times (ms)."""
    deformer = Deformer(_body(one, precision), method)
    handle = deformer.grab(one.drag.elements)
    done = {"passes": 0, "checked": 0, "moved": 0, "stopped": 0}
    times = []
    for motion in one.drag.path:
        pose = handle.after(*motion) if len(motion) == 2 and isinstance(motion[0], tuple) else handle.after(motion)
        start = time.perf_counter()
        result = deformer.move(handle, pose)
        if sweeps > 0:
            deformer.relax(sweeps)
        times.append(1000 * (time.perf_counter() - start))
        done["passes"] += 1
        done["checked"] += result.checked
        done["moved"] += result.moved
        done["stopped"] += result.stopped
    return deformer.body, done, times


def _reference(one: _Object) -> Any:
    """Returns the positions of Exact ChainMail in double at the end of the drag, or None if it has no answer."""
    try:
        return _run(one, "exact", 0, "double")[0].positions()
    except Error:
        return None


def _figures(body: Body, reference: Any) -> dict[str, Any]:
    links, moved = violation(body), displacement(body)
    apart: dict[str, Any] = {"max": None, "rms": None} if reference is None else distance(body, reference)
    return {
        "violation_max": links["max"],
        "violation_rms": links["rms"],
        "violation_fraction": links["fraction"],
        "displacement_max": moved["max"],
        "displacement_rms": moved["rms"],
        "energy": elastic_energy(body),
        "exact_distance_max": apart["max"],
        "exact_distance_rms": apart["rms"],
    }


def _row(point: _Point, reference: Any) -> dict[str, Any]:
    one = point.object
    row: dict[str, Any] = {
        "mesh": one.name,
        "elements": one.mesh.element_count,
        "links": one.mesh.link_count,
        "drag": one.drag.name,
        "method": point.method,
        **one.softness.as_dict(),
        "sweeps": point.sweeps,
        "refusal": "",
        **_NO_FIGURES,
    }
    try:
        runs = [_run(one, point.method, point.sweeps, one.precision) for _ in range(point.repetitions)]
    except Error as error:
        row["refusal"] = str(error)
        return row
    body, done, _ = runs[0]
    times = [time for run in runs for time in run[2]]
    return {**row, **done, **_figures(body, reference), "ms_median": statistics.median(times), "ms_max": max(times)}


def _checked(
    meshes: Meshes, methods: Sequence[str], softness: Softnesses, sweeps: Sequence[int], repetitions: int
) -> tuple[dict[str, Mesh], list[str], list[LinkSoftness], list[int]]:
    if isinstance(methods, str):
        methods = [methods]
    named = {"mesh": meshes} if isinstance(meshes, Mesh) else dict(meshes)
    softnesses = softness if isinstance(softness, Sequence) else [softness or LinkSoftness()]
    counts = {"meshes": len(named), "methods": len(methods), "softness": len(softnesses), "sweeps": len(sweeps)}
    for name, count in counts.items():
        if count == 0:
            raise Error(name, "there is none", "give at least one")
    if math.prod(counts.values()) > _MOST_POINTS:
        raise Error("study", f"it has {math.prod(counts.values())} points", f"give at most {_MOST_POINTS}")
    if repetitions < 1:
        raise Error("repetitions", "the number is below 1", "use a number from 1")
    return named, list(methods), list(softnesses), list(sweeps)


def _objects(
    named: Mapping[str, Mesh], softnesses: Iterable[LinkSoftness], drag: DragOf, prepare: Prepare, precision: Precision
) -> Iterator[_Object]:
    for name, mesh in named.items():
        of_mesh = standard_drag(mesh) if drag is None else drag if isinstance(drag, Drag) else drag(mesh)
        for softness in softnesses:
            yield _Object(name, mesh, softness, of_mesh, prepare, precision)


def _table(rows: Sequence[Mapping[str, Any]]) -> Table:
    return {column: [row[column] for row in rows] for column in rows[0]}


def study_graph(
    meshes: Meshes,
    methods: Sequence[str] = ("natural-queue",),
    softness: Softnesses = None,
    *,
    drag: DragOf = None,
    sweeps: Sequence[int] = (0,),
    precision: Precision = "double",
    prepare: Prepare = None,
    repetitions: int = 1,
) -> Any:
    """Returns a study as one Dask object (dask.delayed), whose result is the table. Needs the package dask.

    The arguments are those of study(). Each point and each reference is a task of its own.
    """
    import dask

    named, methods, softnesses, sweeps = _checked(meshes, methods, softness, sweeps, repetitions)
    reference_task, row_task = dask.delayed(_reference, pure=False), dask.delayed(_row, pure=False)
    rows = []
    for one in _objects(named, softnesses, drag, prepare, precision):
        reference = reference_task(one)
        rows += [row_task(_Point(one, m, s, repetitions), reference) for m in methods for s in sweeps]
    return dask.delayed(_table, pure=False)(rows)


def study(
    meshes: Meshes,
    methods: Sequence[str] = ("natural-queue",),
    softness: Softnesses = None,
    *,
    drag: DragOf = None,
    sweeps: Sequence[int] = (0,),
    precision: Precision = "double",
    prepare: Prepare = None,
    repetitions: int = 1,
    client: Any = None,
    progress: Callable[[float], object] | None = None,
) -> Table:
    """Runs the same drag for each combination of mesh, softness, method and number of sweeps.

    `meshes` is a mesh, or a dictionary of them by name. `methods` are names. `softness` is a LinkSoftness or a sequence
    of them; default: the default softness. `drag` is a Drag, or a function that returns one for a mesh; default:
    standard_drag(). `sweeps` are numbers of sweeps of relaxation after each move. `precision` is `double` or `float`.
    `prepare` is a function that gets each body at rest, to cut links, pin elements or set the softness of links.
    `repetitions` is the number of runs, for times.

    With a `client` of the package distributed, the points run on its workers; `prepare` must be a function that its
    workers can load. Else they run here, one after the other, and `progress` is called with the share that is done,
    0 to 1. The rows are equal bit for bit, except times.

    Returns a dictionary of columns (lists of equal length), a row per point, for pandas.DataFrame: mesh, elements,
    links, drag, method, the six numbers of the softness, sweeps, refusal (the reason why there is no result), passes,
    checked, moved and stopped (sums over passes), violation_max, violation_rms (rest lengths), violation_fraction,
    displacement_max, displacement_rms (mesh units), energy, exact_distance_max and exact_distance_rms (distance to
    Exact ChainMail at the end of the drag, in mean rest lengths; None if it has no answer), and the times ms_median
    and ms_max of a pass with its sweeps (ms). Raises Error for an empty argument.
    """
    if client is not None:
        graph = study_graph(
            meshes,
            methods,
            softness,
            drag=drag,
            sweeps=sweeps,
            precision=precision,
            prepare=prepare,
            repetitions=repetitions,
        )
        table: Table = client.compute(graph).result()
        return table
    named, methods, softnesses, sweeps = _checked(meshes, methods, softness, sweeps, repetitions)
    objects = list(_objects(named, softnesses, drag, prepare, precision))
    rows: list[dict[str, Any]] = []
    for one in objects:
        reference = _reference(one)
        for method in methods:
            for count in sweeps:
                rows.append(_row(_Point(one, method, count, repetitions), reference))
                if progress is not None:
                    progress(len(rows) / (len(objects) * len(methods) * len(sweeps)))
    return _table(rows)
