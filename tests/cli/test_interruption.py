"""Ctrl-C in the midst of a long work: what was found so far is printed, and the exit code is 130."""

import signal
import subprocess
import sys

import pytest

from assur.cli import interruption
from assur.cli.exit_codes import INTERRUPTED


@pytest.fixture(autouse=True)
def key():
    """Ctrl-C raises `KeyboardInterrupt`, as at a terminal, whoever started the tests."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield lambda: signal.raise_signal(signal.SIGINT)
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler  # the command left no handler behind
    signal.signal(signal.SIGINT, before)


@pytest.fixture
def at_call(monkeypatch, key):
    """Press Ctrl-C when a function is called for the n-th time."""

    def pressing(place, number):
        module, _, name = place.rpartition(".")
        target = __import__(module, fromlist=[name])
        original, calls = getattr(target, name), []

        def counted(*arguments, **options):
            calls.append(1)
            if len(calls) == number:
                key()
            return original(*arguments, **options)

        monkeypatch.setattr(target, name, counted)

    return pressing


def told(run):
    assert run.code == INTERRUPTED == 130
    assert f"{interruption.SAID}\nat: " in run.err


def test_a_search_hands_over_the_solutions_that_it_has(assur_cli, at_call, monkeypatch):
    from assur.kinematics import search

    monkeypatch.setattr(search, "AGAIN", 10**6)  # it never ends of itself before its last start
    at_call("assur.kinematics.search.assemble", 2)
    run = assur_cli("direct", "fivebar", "127", "53", "--method", "search", "--json")
    told(run)
    assert run.json["interrupted"] is True
    assert len(run.json["solutions"]) == 2
    assert f"a search from {search.STARTS} starts" in run.json["right"]


def test_before_anything_is_found_nothing_is_printed(assur_cli, at_call):
    from assur.kinematics import search

    at_call("assur.kinematics.search.assemble", 1)
    # other dimensions than the file's: soundness of those may be known from another test
    run = assur_cli("direct", "fivebar", "127", "53", "--method", "search", "--set", "l1=101")
    assert (run.code, run.out) == (130, "")
    assert run.err == (
        "interrupted: there is no answer yet\n"
        f"at: direct: search of assemblies from many starts (0 of {search.MOST})\n"
        "done before: reading the file, soundness of the joint graph\n"
    )


PAVING = "assur.workspace.certified.paving._worst"


def test_bounds_reached_are_printed(assur_cli, at_call):
    at_call(PAVING, 3)
    run = assur_cli("workspace", "zeng2019", "--certify", "--gap", "1e-6", "--json")
    told(run)
    low, high = run.json["volume"]
    assert low < 22_814_586 < high
    assert (run.json["stopped"], run.json["interrupted"]) == ("interrupted", True)


def test_a_proof_of_a_box_is_undecided(assur_cli, at_call):
    at_call("assur.workspace.certified.paving._large", 2)
    run = assur_cli("workspace", "zeng2019", "--prove", "x=-110:90,y=-250:250,z=180:480")
    told(run)
    assert "interrupted" in run.out


def test_aspects_of_the_modes_that_are_done(assur_cli, at_call):
    at_call("assur.workspace.certified.paving._large", 2)
    run = assur_cli("aspects", "fivebar", "--mode", "all", "--json")
    told(run)
    assert run.json["interrupted"] is True


def test_a_certificate_is_written_with_what_is_proved(assur_cli, at_call, tmp_path):
    at_call("assur.certificates.tree._halved", 3)
    path = tmp_path / "c.json"
    run = assur_cli("certify", "fivebar", "-o", str(path))
    told(run)
    assert assur_cli("verify", str(path)).code == 0


def test_mechanisms_that_were_found_are_listed(assur_cli, at_call, tmp_path, monkeypatch):
    monkeypatch.setenv("ASSUR_CACHE", str(tmp_path / "cache"))
    at_call("assur.synthesis.plans.assemble", 4)
    run = assur_cli("synthesize", "--max-joints", "3", "--symmetric", "--json")
    told(run)
    whole = assur_cli("synthesize", "--max-joints", "3", "--symmetric", "--json").json
    assert 0 < len(run.json["mechanisms"]) < len(whole["mechanisms"])


def test_limbs_that_were_looked_at_are_counted(assur_cli, at_call):
    at_call("assur.synthesis.plans.verdict", 9)
    run = assur_cli("synthesize", "--max-joints", "3", "--symmetric")
    told(run)
    assert "0 mechanisms" in run.out


def test_figures_that_are_drawn_are_listed_and_no_half_known_one_is_written(assur_cli, at_call, tmp_path):
    words = ("figures", "fivebar", "--only", "structure", "workspace", "model", "--format", "svg", "-o", str(tmp_path))
    at_call("assur.figures.context.workspace", 1)
    run = assur_cli(*words, "--json")
    told(run)
    names = [item["name"] for item in run.json["figures"]]
    assert "structure" in names
    assert "workspace" not in names
    assert len(list(tmp_path.iterdir())) == len(names)


def test_a_report_says_which_sections_are_done_and_leaves_the_old_file(assur_cli, key, monkeypatch, tmp_path):
    from assur.report import report

    path = tmp_path / "r.html"
    path.write_text("old")
    monkeypatch.setattr(report, "ANALYSES", ())
    monkeypatch.setattr(report, "SECTIONS", (*report.SECTIONS[1:3], ("The third", lambda _: key())))
    run = assur_cli("report", "fivebar", "-o", str(path))
    told(run)
    assert run.out == "fivebar, report: not written\nsections done: The mechanism, Structure and topology\n"
    assert path.read_text() == "old"


@pytest.mark.sim
def test_what_was_compared_with_the_engine_is_printed(assur_cli, at_call):
    at_call("assur.crosscheck.crosscheck._compared", 4)
    run = assur_cli("crosscheck", "fivebar", "--samples", "3", "--json")
    told(run)
    assert next(item for item in run.json["differences"] if item["kind"] == "frames of links")["count"] == 3


def test_a_path_is_printed_as_far_as_it_was_followed(assur_cli, at_call):
    at_call("assur.kinematics.following.ranks.tried", 4)
    run = assur_cli("follow", "fivebar", "--from", "0", "200", "--to", "60", "220", "--json")
    told(run)
    assert len(run.json["shares"]) == 4
    assert 0 < run.json["shares"][-1] < 1
    assert run.json["stopped"]["kind"] == "interrupted"


@pytest.mark.parametrize(
    ("place", "at"),
    [
        ("assur.kinematics.contract.held.of_formulas", "check: closed form"),
        ("assur.kinematics.contract.held.solutions", "check: closed form: closed form against the joint graph"),
    ],
)
def test_a_check_says_which_parts_were_without_fault(assur_cli, at_call, tmp_path, monkeypatch, place, at):
    import shutil

    from assur.model.registry import load_record

    monkeypatch.setenv("ASSUR_CACHE", str(tmp_path / "cache"))
    shutil.copytree(load_record("fivebar").file.parent, tmp_path / "own")
    at_call(place.replace("held.of_formulas", "check.of_formulas"), 1)
    run = assur_cli("check", str(tmp_path / "own/mechanism.toml"))
    assert (run.code, run.out) == (130, "")
    assert f"\nat: {at}\n" in run.err
    assert "text of the files (0 faults)" in run.err
    assert "joint graph and labels (0 faults)" in run.err


def test_files_that_were_written_by_then_are_named(assur_cli, at_call, tmp_path):
    at_call("assur.results.files.replace_file", 3)
    run = assur_cli("export", "fivebar", "--format", "stl", "-o", str(tmp_path / "parts"))
    assert run.code == 130
    names = sorted(path.name for path in (tmp_path / "parts").iterdir())
    assert len(names) == 2
    assert all(name in run.err.rpartition("written before: ")[2] for name in names)


def test_an_answer_that_was_broken_off_says_where(assur_cli, at_call):
    at_call(PAVING, 3)
    run = assur_cli("workspace", "zeng2019", "--certify", "--gap", "1e-6", "--json")
    assert run.json["interrupted_at"].startswith("workspace: ")


def test_a_module_is_loaded_to_its_end(key, tmp_path, monkeypatch):
    """Half a module of compiled code cannot be loaded again, when the part that was done is printed."""
    (tmp_path / "slow_to_load.py").write_text("import signal\nsignal.raise_signal(signal.SIGINT)\nLOADED = True\n")
    monkeypatch.syspath_prepend(tmp_path)

    def loading():
        import slow_to_load

        assert slow_to_load.LOADED
        while True:
            pass

    with interruption.watched(), pytest.raises(KeyboardInterrupt):
        loading()


@pytest.mark.filterwarnings("error")
def test_what_is_called_back_does_not_swallow_it(key, capfd):
    class Kept:
        def __del__(self):
            key()

    def calling_back():
        kept = Kept()
        del kept
        while True:
            pass

    with interruption.watched(), pytest.raises(KeyboardInterrupt):
        calling_back()
    assert capfd.readouterr().err == ""


def test_an_error_that_a_library_makes_of_it_is_no_bug_of_ours(assur_cli, key, monkeypatch):
    def converting(*_, **__):
        try:
            key()
        except KeyboardInterrupt:
            raise SystemError("a callback failed") from None

    monkeypatch.setattr("assur.mechanism.Mechanism.direct", converting)
    run = assur_cli("direct", "fivebar", "127", "53")
    assert (run.code, run.out) == (130, "")
    assert run.err.startswith("interrupted: there is no answer yet\nat: direct\n")


@pytest.mark.parametrize("delay", [0.0, 0.05, 0.1])
def test_while_it_is_loaded_it_ends_by_a_word(delay):
    """From the moment at which assur's own code runs; before that it is Python that is started."""
    code = f"""
import signal, sys, threading, time
signal.signal(signal.SIGINT, signal.default_int_handler)
from assur.cli.main import main
def press():
    while signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        time.sleep(0.001)
    time.sleep({delay})
    signal.raise_signal(signal.SIGINT)
threading.Thread(target=press, daemon=True).start()
sys.exit(main(["direct", "h4_robot", "0", "0", "0", "0", "--method", "search"]))
"""
    call = [sys.executable, "-c", code]
    done = subprocess.run(call, capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == INTERRUPTED
    assert done.stderr.startswith("interrupted")
    assert "Traceback" not in done.stderr


def test_a_stage_that_answered_with_what_it_had_ends_the_work(key):
    with interruption.watched():
        interruption.go_on()
        with pytest.raises(KeyboardInterrupt):
            key()
        assert interruption.pressed()
        with pytest.raises(KeyboardInterrupt):
            interruption.go_on()
    with interruption.watched():
        assert not interruption.pressed()


def test_who_ignores_the_key_still_does(assur_cli):
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    with interruption.watched():
        signal.raise_signal(signal.SIGINT)
        assert not interruption.pressed()
    signal.signal(signal.SIGINT, signal.default_int_handler)


def test_what_is_printed_is_not_called_no_answer(assur_cli, at_call, tmp_path):
    """The answer stood, and its file was written: only its printing was cut short."""
    at_call("assur.cli.output._seen", 2)
    path = tmp_path / "m.xml"
    run = assur_cli("export", "fivebar", "-o", str(path))
    assert run.code == 130
    head, at, *_, files = run.err.splitlines()
    assert (head, at) == (interruption.CUT, "at: export: printing the answer")
    assert run.out
    assert path.exists()
    assert files == f"written before: {path}"


@pytest.mark.parametrize(("step", "objects"), [("_circumstances", 1), ("printing", 0)])
def test_behind_a_part_of_one_object_no_other_is_printed(assur_cli, key, monkeypatch, step, objects):
    from assur.cli import output

    original, calls = getattr(output, step), []

    def pressed_once(*arguments):
        value = original(*arguments)
        calls.append(1)
        if len(calls) == 1:
            key()
        return value

    monkeypatch.setattr(output, step, pressed_once)
    run = assur_cli("list", "--json")
    assert (run.code, run.out.count('"error"')) == (130, objects)
    assert run.err.startswith(interruption.CUT)


def test_of_many_files_the_last_are_named_and_the_others_counted():
    from assur import work

    with work.stage("export"):
        for number in range(11):
            work.written(f"{number}.stl")
        assert work.before() == "written before: 3 more, " + ", ".join(f"{number}.stl" for number in range(3, 11))


def test_parts_of_a_part_are_not_listed():
    from assur import work

    with work.stage("report"):
        with work.stage("audit"), work.stage("one row"):
            pass
        with work.stage("workspace"):
            with work.stage("a box"):
                pass
            assert work.before() == "done before: audit"


def test_an_answer_that_is_printed_part_by_part_is_what_was_found(assur_cli, at_call, tmp_path):
    at_call("assur.cli.output._seen", 6)
    run = assur_cli("demo", "-o", str(tmp_path))
    told(run)
    assert run.out


def test_where_the_search_was_stopped_no_absence_is_said(assur_cli, at_call):
    at_call("assur.workspace.certified.paving._large", 1)
    run = assur_cli("aspects", "zeng2019", "--mode", "+++++")
    told(run)
    assert "none so far: " in run.out
    assert "no box of this size" not in run.out
