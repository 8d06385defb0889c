"""Runs a parameter study in this process and on two workers of Dask, and compares."""

import chainmail
from distributed import Client

MESHES = {"coarse": chainmail.make_cloth(6, 6), "fine": chainmail.make_cloth(11, 11, spacing=0.5)}
METHODS = ["natural-queue", "exact"]
SOFTNESS = [chainmail.LinkSoftness(stretch=stretch) for stretch in (1.1, 1.3)]


def figures(table):
    return {name: column for name, column in table.items() if not name.startswith("ms_")}


if __name__ == "__main__":
    serial = chainmail.study(MESHES, METHODS, SOFTNESS)
    with Client(n_workers=2, threads_per_worker=1, dashboard_address=None) as client:
        parallel = chainmail.study(MESHES, METHODS, SOFTNESS, client=client)
    print("equal" if figures(serial) == figures(parallel) else "different")
