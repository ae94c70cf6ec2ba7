"""Clusters: own ones and others', without workers, lost, or unable to do the work."""

import threading

import distributed
import pytest
from support.mesh_folders import write_tori

from igl_periods.batch import BatchError, find_files, local_cluster, remote_cluster, run_batch
from igl_periods.batch import cluster as batch_cluster


def test_clusters_that_cannot_be_used(address, monkeypatch):
    monkeypatch.setattr(batch_cluster, "_CONNECTING", 0.5)
    for other in ("tcp://127.0.0.1:1", "nonsense://x"):
        with (
            pytest.raises(BatchError, match=r"there is no scheduler at .* that can be reached"),
            remote_cluster(other),
        ):
            pass
    found_versions = distributed.Client.get_versions

    def get_versions(client, **options):
        found = found_versions(client, **options)
        found["client"]["packages"]["igl_periods"] = "9.9"
        return found

    monkeypatch.setattr(distributed.Client, "get_versions", get_versions)
    with (
        pytest.raises(BatchError, match=r"has igl_periods \S+, and here it is 9.9"),
        remote_cluster(address),
    ):
        pass


def test_a_cluster_without_workers(tmp_path, monkeypatch):
    monkeypatch.setattr(batch_cluster, "_PATIENCE", 0.5)
    monkeypatch.setattr(batch_cluster, "_POLL", 0.1)
    monkeypatch.setattr(batch_cluster, "_CONNECTING", 0.5)
    with local_cluster(0) as client:
        with (
            pytest.raises(BatchError, match=r"has no workers\. Start some: 'dask worker tcp"),
            remote_cluster(client.scheduler.address),
        ):
            pass
        with pytest.raises(BatchError, match="has had no worker"):
            run_batch({"a": "a.off"}, tmp_path / "x.parquet", client=client)


def test_a_cluster_that_is_lost(tmp_path, monkeypatch):
    write_tori(tmp_path / "m", 1)
    with local_cluster(0) as client:
        threading.Timer(0.3, client.shutdown).start()
        with pytest.raises(BatchError, match="has been lost"):
            run_batch(find_files(tmp_path / "m"), tmp_path / "x.parquet", client=client)
