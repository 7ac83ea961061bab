"""`assur sweep --scheduler`: the workers of a cluster do it, to the bytes of a single run, whoever of them is lost."""

import os
import signal

import pytest

from assur.kinematics.closed_form.cluster import fill_on_cluster, job_of, sweep_of
from assur.kinematics.closed_form.grids import Grid
from assur.kinematics.closed_form.stored import stored_sweep
from assur.mechanism import load

WORDS = ("sweep", "zeng2019", "--along", "x=30", "--along", "y=31", "--along", "z=32", "--set", "l2=300")


def grid_of(record, *counts):
    """Over the file's box."""
    low, high = zip(*(record.box[name] for name in record.platform.pose), strict=True)
    return Grid(record.platform.pose, low, high, counts)


def files_of(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def test_a_job_says_all_of_its_sweep(tmp_path):
    record = load("zeng2019", l2=300)
    sweep = stored_sweep(record, "inverse", grid_of(record, 3, 4, 5), "+++++", ("status",))
    again = sweep_of(job_of(sweep, "zeng2019"))
    assert again.plan() == sweep.plan()


@pytest.mark.cluster
def test_where_nobody_answers_it_is_said(assur_cli, tmp_path, monkeypatch):
    monkeypatch.setattr("assur.kinematics.closed_form.cluster.ANSWERS", 0.2)
    run = assur_cli(*WORDS, "--scheduler", "tcp://localhost:9", "-o", str(tmp_path))
    assert run.code == 2
    assert "error: --scheduler: no Dask scheduler answers at tcp://localhost:9\nhint: `dask scheduler`" in run.err


def test_without_dask_it_is_said(assur_cli, tmp_path, monkeypatch):
    monkeypatch.setattr("importlib.util.find_spec", lambda _: None)
    run = assur_cli(*WORDS, "--scheduler", "tcp://localhost:9", "-o", str(tmp_path))
    assert (run.code, "pip install '.[cluster]'" in run.err) == (2, True)


@pytest.fixture(scope="module")
def cluster():
    from distributed import LocalCluster

    with LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=":0") as found:
        yield found


@pytest.mark.cluster
@pytest.mark.filterwarnings("ignore")  # of Dask's own, where a worker is lost
def test_a_worker_that_is_killed_half_way_loses_nothing(assur_cli, tmp_path, cluster):
    assert assur_cli(*WORDS, "-o", str(tmp_path / "alone")).code == 0
    record = load("zeng2019", l2=300)
    sweep = stored_sweep(record, "inverse", grid_of(record, 30, 31, 32))
    killed = []

    def kill(done, total):
        if not killed and 2 * done >= total:
            killed.append(next(iter(cluster.workers.values())).pid)
            os.kill(killed[0], signal.SIGKILL)

    with sweep.store(tmp_path / "cluster") as store:
        store.open()
        fill_on_cluster(sweep, "zeng2019", store, cluster.scheduler_address, progress=kill)
        store.finish()
    assert killed
    assert files_of(tmp_path / "cluster") == files_of(tmp_path / "alone")


@pytest.mark.cluster
@pytest.mark.filterwarnings("ignore")
def test_a_cluster_works_out_a_shard_and_goes_on_where_a_single_process_stopped(assur_cli, tmp_path, cluster):
    words = (*WORDS, "--shard", "2/3")
    assert assur_cli(*words, "-o", str(tmp_path / "alone")).code == 0
    run = assur_cli(*words, "-o", str(tmp_path / "cluster"), "--scheduler", cluster.scheduler_address)
    assert (run.code, f"by NumPy, on the cluster at {cluster.scheduler_address}" in run.err) == (0, True)
    assert files_of(tmp_path / "cluster") == files_of(tmp_path / "alone")


@pytest.mark.cluster
@pytest.mark.filterwarnings("ignore")
def test_workers_that_have_another_mechanism_are_told(assur_cli, tmp_path, cluster, monkeypatch):
    monkeypatch.setattr("assur.kinematics.closed_form.formulas.version", lambda _: "0.0.1")
    run = assur_cli(*WORDS, "-o", str(tmp_path / "new"), "--scheduler", cluster.scheduler_address)
    assert run.code == 2
    assert "its workers take this for another question; it differs in version" in run.err
