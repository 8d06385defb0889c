"""Parameter studies with Dask: a graph, and worker processes of which one is killed."""

import chainmail
import pytest

from study_helpers import DieOnce, drag_element_seven, pin_the_last

dask = pytest.importorskip("dask")
distributed = pytest.importorskip("distributed")

TIMES = {"ms_median", "ms_max"}
STUDY = dict(
    meshes={"cloth": chainmail.make_cloth(8, 6), "tetra": chainmail.make_tetra(4, 3, 3)},
    methods=["natural-queue", "generalized", "exact"],
    softness=[chainmail.LinkSoftness(stretch=stretch) for stretch in (1.1, 1.3)],
    sweeps=[0, 2],
)


def without_times(table):
    return {name: column for name, column in table.items() if name not in TIMES}


@pytest.fixture
def client(tmp_path):
    with dask.config.set({"temporary-directory": str(tmp_path), "distributed.scheduler.allowed-failures": 3}):
        with distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, memory_limit="1GiB", dashboard_address=None
        ) as cluster, distributed.Client(cluster) as client:
            yield client


def test_a_graph_gives_the_rows_of_this_process():
    table = chainmail.study_graph(**STUDY, prepare=pin_the_last).compute(scheduler="synchronous")
    assert without_times(table) == without_times(chainmail.study(**STUDY, prepare=pin_the_last))


def test_points_are_tasks_of_their_own():
    graph = chainmail.study_graph(**STUDY)
    assert len(dict(graph.__dask_graph__())) >= 2 * 2 + 24


def test_a_worker_that_is_killed_changes_nothing(client, tmp_path):
    expected = without_times(chainmail.study(**STUDY))
    mark = tmp_path / "a worker died"
    before = set(client.scheduler_info()["workers"])
    table = chainmail.study(**STUDY, prepare=DieOnce(str(mark)), client=client)
    assert mark.exists()  # a worker ended in the middle of a point
    client.wait_for_workers(2)  # and another one took its place
    assert set(client.scheduler_info()["workers"]) != before
    assert without_times(table) == expected


def test_errors_of_workers_arrive(client):
    future = client.submit(drag_element_seven, chainmail.make_line(3))
    with pytest.raises(chainmail.Error, match="element 7: there is no such element"):
        future.result()
