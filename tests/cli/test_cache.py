from assur import cache


def test_what_is_kept_is_listed_and_cleared(assur_cli, tmp_path, monkeypatch):
    monkeypatch.setenv("ASSUR_CACHE", str(tmp_path))
    cache.keep("loops", "a.py", b"x" * 2_500_000)
    run = assur_cli("cache")
    assert run.code == 0
    assert "kept: 2.5 MB of at most 512.0 MB" in run.out
    data = assur_cli("cache", "--json").json
    assert (data["folder"], data["bytes"], data["limit"]) == (str(tmp_path), 2_500_000, 512_000_000)
    loops = next(kind for kind in data["kinds"] if kind["name"] == "loops")
    assert (loops["entries"], loops["bytes"]) == (1, 2_500_000)
    assert assur_cli("cache", "--clear", "--json").json["removed"] == {"entries": 1, "bytes": 2_500_000}
    assert assur_cli("cache", "--json").json["bytes"] == 0
