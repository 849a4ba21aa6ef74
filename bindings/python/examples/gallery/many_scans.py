# ---
# jupyter:
#   jupytext:
#     text_representation: {extension: .py, format_name: percent}
#   kernelspec: {display_name: Python 3, language: python, name: python3}
# ---

# %% [markdown]
# # Close a thousand scans on a cluster
#
# More scans than one machine takes go to a cluster of [Dask](https://distributed.dask.org) as they are: a function
# takes the path of a file, and what comes back is a line that says what became of it. Here the cluster is two
# processes on this machine; of another, `Client("tcp://its-scheduler:8786")` is all that differs, if its workers see
# the folder.
#
# The scans are small: spheres with a hole, of a thousand triangles. Two files are none, and of one every second
# triangle faces inwards.

# %%
import os
import signal
import tempfile
from pathlib import Path

import numpy as np
import pyvista as pv
import trimesh
from distributed import Client, as_completed
from distributed.deploy.subprocess import SubprocessCluster
from pictures import picture

folder = tempfile.TemporaryDirectory()
scans, filled = Path(folder.name, "scans"), Path(folder.name, "filled")
scans.mkdir()
filled.mkdir()
random = np.random.default_rng(7)
sphere = trimesh.creation.icosphere(subdivisions=3)
for number in range(1000):
    direction = random.normal(size=3)
    height = sphere.triangles_center @ (direction / np.linalg.norm(direction))
    scan = sphere.submesh([height < random.uniform(0.6, 0.95)], append=True)
    scan.apply_scale(random.uniform(1, 100))
    if number == 990:
        scan.faces[::2] = scan.faces[::2, ::-1]
    scan.export(scans / f"scan{number:04}.stl")
(scans / "scan0010.stl").write_text("this is no mesh")
(scans / "scan0500.stl").write_bytes((scans / "scan0501.stl").read_bytes()[:1000])

# %% [markdown]
# What is done to a file. The mesh stays with the worker: its result is a new file, which has its name only when it is
# whole. The cores belong to Dask, so that each call takes one thread. trimesh reads nothing from a broken file, and
# does not say so.


# %%
def close(scan: Path, folder: Path) -> dict[str, object]:
    """Fills the holes of a file; what became of them."""
    import fairmesh

    mesh = trimesh.load_mesh(scan)
    if len(mesh.faces) == 0:
        raise ValueError(f"{scan.name} has no triangle that could be read")
    result = fairmesh.fill_holes(mesh, threads=1)
    part = folder / f"{scan.stem}.{os.getpid()}.part"
    result.mesh.export(part, file_type="ply")
    part.replace(folder / f"{scan.stem}.ply")
    return {"success": result.is_success, "reasons": sorted({str(made.reason) for made in result.loops})}


# %% [markdown]
# In the midst of the work a worker is killed, as happens where memory runs out or a machine is switched off. Dask
# starts another one, which does what the first had not finished.

# %%
cluster = SubprocessCluster(n_workers=2, threads_per_worker=1, worker_kwargs={"memory_limit": "1 GiB"})
client = Client(cluster)
client.wait_for_workers(2)
paths = sorted(scans.iterdir())
futures = {client.submit(close, path, filled, key=path.name): path for path in paths}
told: dict[str, dict[str, object]] = {}
failed: dict[str, str] = {}
for future in as_completed(futures):
    name = futures[future].name
    why = future.exception()
    if why is None:
        told[name] = future.result()
    else:
        failed[name] = f"{type(why).__name__}: {why}"
    future.release()
    if len(told) + len(failed) == 300:
        killed = next(iter(client.run(os.getpid).values()))
        os.kill(killed, signal.SIGKILL)
print(len(told), "filled,", len(failed), "failed")

# %% [markdown]
# Every file is accounted for, and what failed or was left open is told by its name.

# %%
doubtful = {name: record["reasons"] for name, record in told.items() if not record["success"]}
for name, reason in {**failed, **doubtful}.items():
    print(name, reason)
assert sorted([*told, *failed]) == [path.name for path in paths] and len(paths) == 1000
assert sorted(failed) == ["scan0010.stl", "scan0500.stl"] and list(doubtful) == ["scan0990.stl"]
assert sorted(path.stem for path in filled.iterdir()) == [path.stem for path in paths if path.name in told]
assert all(pv.read(filled / f"{Path(name).stem}.ply").n_open_edges == 0 for name in list(told)[:10])

# %% [markdown]
# Another worker has taken the place of the one that was killed, and none has held more than a few scans at a time.

# %%
workers = client.run(lambda dask_worker: dask_worker.monitor.proc.memory_info().rss / 2**20)
print([f"{mebibytes:.0f} MiB" for mebibytes in workers.values()])
assert len(workers) == 2 and killed not in client.run(os.getpid).values()
assert max(workers.values()) < 500
client.close()
cluster.close()

# %%
first = [path.stem for path in paths if path.name in told][:16]


def side_by_side(stems: list[str], folder: Path, ending: str) -> pv.PolyData:
    """Meshes in rows of four, each of the size of its place."""
    shown = []
    for place, stem in enumerate(stems):
        mesh = pv.read(folder / f"{stem}.{ending}")
        mesh.points /= np.abs(mesh.points).max()
        shown.append(mesh.translate((2.2 * (place % 4), -2.2 * (place // 4), 0)))
    return pv.PolyData(pv.merge(shown))


picture(
    "many_scans",
    ("16 of 1,000 scans", side_by_side(first, scans, "stl"), {}),
    ("Closed", side_by_side(first, filled, "ply"), {}),
    zoom=1.2,
)
