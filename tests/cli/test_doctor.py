import platform

import assur


def test_all_is_well_here(assur_cli):
    run = assur_cli("doctor", "--json")
    assert (run.code, run.err) == (0, "")
    assert run.json["faults"] == 0
    assert run.json["python"] == platform.python_version()
    names = {check["what"] for check in run.json["checks"]}
    assert names >= {"python", "numpy", "rich", "cyclopts", "output", "constraints.txt", "pytest (optional)"}
    assert names >= {f"{name} {part}" for name in assur.names() for part in ("home", "closed form")}
    assert all(check["answer"] in ("ok", "note", "fault") for check in run.json["checks"])


def test_a_person_sees_it_too(assur_cli):
    run = assur_cli("doctor")
    assert run.code == 0
    assert run.out.endswith("everything that is needed works\n")
    assert max(map(len, run.out.splitlines())) <= 80


def test_nothing_is_made(assur_cli, tmp_path):
    assert assur_cli("doctor", "-o", str(tmp_path / "a" / "b")).code == 0
    assert list(tmp_path.iterdir()) == []


def test_a_missing_package_is_a_fault(assur_cli, monkeypatch):
    monkeypatch.setattr("assur.cli.checkup.metadata.requires", lambda _: ["numpy>=2", "no-such-package>=1"])
    run = assur_cli("doctor", "--json")
    assert (run.code, run.json["faults"]) == (1, 1)
    assert {"what": "no-such-package", "answer": "fault", "found": "not installed, >=1 wanted"} in run.json["checks"]


def test_an_old_package_is_a_fault_and_a_missing_extra_is_a_note(assur_cli, monkeypatch):
    wanted = ["numpy>=99", "no-such-package; extra == 'dev'"]
    monkeypatch.setattr("assur.cli.checkup.metadata.requires", lambda _: wanted)
    answers = {check["what"]: check["answer"] for check in assur_cli("doctor", "--json").json["checks"]}
    assert answers["numpy"] == "fault"
    assert answers["no-such-package (optional)"] == "note"


def test_another_version_than_the_pinned_one_is_a_note(assur_cli, monkeypatch):
    monkeypatch.setattr("assur.cli.checkup._pins", lambda: {"numpy": "0.0.1"})
    run = assur_cli("doctor", "--json")
    found = next(check for check in run.json["checks"] if check["what"] == "numpy")
    assert (run.code, found["answer"]) == (0, "note")
    assert found["found"].endswith("tested with 0.0.1")


def test_a_folder_that_cannot_be_written_is_a_fault(assur_cli):
    run = assur_cli("doctor", "-o", "/proc/nothing", "--json")
    found = next(check for check in run.json["checks"] if check["what"] == "output")
    assert (run.code, found["answer"]) == (1, "fault")


def test_a_closed_form_that_disagrees_with_the_joint_graph_is_a_fault(assur_cli, monkeypatch):
    monkeypatch.setattr("assur.cli.checkup.AGREE", 0.0)
    run = assur_cli("doctor", "--json")
    faults = {check["what"] for check in run.json["checks"] if check["answer"] == "fault"}
    assert (run.code, faults) == (1, {f"{name} closed form" for name in assur.names()})
