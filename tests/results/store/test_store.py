"""Stores whose disk fails at every operation, in every way; files that are damaged in every way; shards and merges."""

import json
import os
import shutil

import numpy as np
import pytest

from assur.errors import DamagedStoreError, UsageError
from assur.results.store import store as store_module
from assur.results.store.layout import Array, Plan, Shard, block_length
from assur.results.store.merged import parts_in
from assur.results.store.store import SolvedBlock, Store
from faulty_disk import FaultyDisk, Killed

PLAN = Plan(
    {"kind": "numbers", "seed": 3}, (Array("many", "float64", (2,), (5, 7)), Array("few", "int8", (), (5, 7))), 9
)
"""35 places in 4 blocks, the last one short."""
WAYS = ("fails", "torn", "last")


@pytest.fixture(scope="module", autouse=True)
def noted_after_every_block():
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(store_module, "SAVED", 0.0)
        patched.setattr(store_module, "SHARE", 0.0)
        yield


def solved(plan, number):
    """The numbers of a block, from the places alone."""
    places = np.arange(plan.part(number).start, plan.part(number).stop)
    many = np.sqrt([places + plan.question["seed"], places + 0.5])
    return SolvedBlock({"many": many, "few": places % 5}, {"fives": {"0": int(np.sum(places % 5 == 0))}})


def told(plan, counts):
    return json.dumps({"length": plan.length, "counts": counts}).encode()


def files_of(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def filled(folder, disk=None, shard=None, repair=False, plan=PLAN):
    plan = Plan(plan.question, plan.arrays, plan.block, shard)
    with Store(folder, plan, told, disk or FaultyDisk()) as store:
        faults = store.open(repair=repair)
        store.fill((number, solved(plan, number)) for number in store.missing)
        store.finish()
        return faults


def joined(folders, into, disk=None):
    parts = parts_in(folders)
    with Store(into, parts[0].plan.whole, told, disk or FaultyDisk()) as store:
        store.open()
        left = set(store.missing)
        store.fill((n, part.solved(n)) for part in parts for n in part.plan.blocks if n in left)
        store.finish()


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    folder = tmp_path_factory.mktemp("whole")
    filled(folder, FaultyDisk(real=True))
    return folder


@pytest.fixture(scope="module")
def shards(tmp_path_factory):
    folders = [tmp_path_factory.mktemp("shards") / f"{k}" for k in (1, 2, 3)]
    for k, folder in enumerate(folders, start=1):
        filled(folder, shard=Shard(k, 3))
    return folders


def test_the_arrays_are_what_was_put(whole):
    places = np.arange(35)
    np.testing.assert_array_equal(np.load(whole / "many.npy"), np.sqrt([places + 3, places + 0.5]).reshape(2, 5, 7))
    np.testing.assert_array_equal(np.load(whole / "few.npy"), (places % 5).reshape(5, 7))
    assert json.loads((whole / "sweep.json").read_text()) == {"length": 35, "counts": {"fives": {"0": 7}}}
    assert sorted(files_of(whole)) == ["few.npy", "many.npy", "state.json", "sweep.json"]


def damage_of(folder):
    """A flipped bit in one block, a header, and a lost file."""
    flip(folder / "many.npy", 128 + 8 * 12)
    flip(folder / "few.npy", 3)


def flip(path, place, bit=0):
    raw = bytearray(path.read_bytes())
    raw[place] ^= 1 << bit
    path.write_bytes(bytes(raw))


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("work", ["whole", "shard", "merge", "repair"])
def test_whatever_fails_the_same_command_ends_in_the_same_bytes(whole, shards, tmp_path, work, way):
    wanted = files_of(shards[1] if work == "shard" else whole)

    def run(folder, disk):
        if work == "merge":
            joined(shards, folder, disk)
        else:
            filled(folder, disk, Shard(2, 3) if work == "shard" else None, repair=work == "repair")

    def prepared(name):
        folder = tmp_path / name / "deep"
        if work == "repair":
            shutil.copytree(whole, folder)
            damage_of(folder)
        return folder

    counted = FaultyDisk()
    run(prepared("once"), counted)
    assert {"write", "sync", "rename", "sync folder", "remove"} <= {kind for kind, _ in counted.log}
    for number in range(counted.count):
        folder, disk = prepared(str(number)), FaultyDisk(number, way)
        with pytest.raises(OSError if way == "fails" else Killed):
            run(folder, disk)
        assert [kind for kind, _ in disk.log[: number + 1]] == [kind for kind, _ in counted.log[: number + 1]]
        for path in folder.glob("*.npy") if work != "repair" else ():
            assert path.read_bytes() == wanted[path.name], "it looks finished and is not"
        run(folder, FaultyDisk())
        assert files_of(folder) == wanted, counted.log[number]
        shutil.rmtree(tmp_path / str(number))


@pytest.mark.parametrize("saved", [0.0, 1e9])
def test_ctrl_c_at_any_instant_loses_nothing_that_was_written(whole, tmp_path, monkeypatch, saved):
    """What is then said to be done is what the note says."""
    monkeypatch.setattr(store_module, "SAVED", saved)
    counted = FaultyDisk()
    filled(tmp_path / "once", counted)
    for number in range(counted.count):
        folder, disk = tmp_path / str(number), FaultyDisk(number, "interrupted")
        with Store(folder, PLAN, told, disk) as store:
            with pytest.raises(KeyboardInterrupt):
                interrupted(store)
            state = folder / "state.json"
            assert store.places_done == (json.loads(state.read_text())["done"] if state.exists() else 0)
            put = {number for number in PLAN.blocks if number not in store.missing}
            assert put == set(store.done)
        filled(folder)
        assert files_of(folder) == files_of(whole)


def interrupted(store):
    store.open()
    store.fill((number, solved(PLAN, number)) for number in store.missing)
    store.finish()


def edit(folder, **entries):
    path = folder / "state.json"
    path.write_text(json.dumps({**json.loads(path.read_text()), **entries}, indent=1))


def rewrite(path, change):
    path.write_bytes(change(path.read_bytes()))


def make_folder(path):
    path.unlink()
    path.mkdir()


NOTE = "state.json: blocks 0-3: is"
DAMAGE = {
    "a flipped bit": (lambda at: flip(at / "many.npy", 128 + 8 * 12, 3), "many.npy: block 1: its numbers"),
    "two": (lambda at: [flip(at / "many.npy", 128 + 8 * k) for k in (0, 34)], "many.npy: blocks 0, 3: its numbers"),
    "the last bit": (lambda at: flip(at / "few.npy", -1), "few.npy: block 3: its numbers"),
    "zeros": (lambda at: rewrite(at / "many.npy", lambda raw: raw[:128] + bytes(560)), "many.npy: blocks 0-3: its"),
    "truncated": (lambda at: rewrite(at / "few.npy", lambda raw: raw[:-9]), "few.npy: blocks 2-3: its numbers"),
    "empty": (lambda at: (at / "few.npy").write_bytes(b""), "few.npy: has 0 bytes; 163 are due"),
    "longer": (lambda at: rewrite(at / "few.npy", lambda raw: raw + b"x"), "few.npy: has 164 bytes; 163 are due"),
    "header": (lambda at: flip(at / "many.npy", 3), "many.npy: its header is not what was written"),
    "no header": (lambda at: rewrite(at / "many.npy", lambda raw: bytes(128) + raw[128:]), "many.npy: its header"),
    "missing": (lambda at: (at / "many.npy").unlink(), "many.npy: blocks 0-3: is missing"),
    "all missing": (
        lambda at: [(at / f"{n}.npy").unlink() for n in ("many", "few")],
        "few.npy: blocks 0-3: is missing",
    ),
    "note missing": (lambda at: (at / "state.json").unlink(), "state.json: is missing"),
    "note empty": (lambda at: (at / "state.json").write_bytes(b""), f"{NOTE} not what was written"),
    "note no text": (lambda at: (at / "state.json").write_bytes(b"\xff{"), f"{NOTE} not what was written"),
    "note flipped": (lambda at: flip(at / "state.json", 40), f"{NOTE} not what was written"),
    "note's end": (lambda at: flip(at / "state.json", -3), f"{NOTE} not what was written"),
    "note's check": (lambda at: flip(at / "state.json", -9), f"{NOTE} not what was written"),
    "done = -5": (lambda at: edit(at, done=-5), f"{NOTE} not what was written"),
    "total = null": (lambda at: edit(at, total=None), f"{NOTE} not what was written"),
    "blocks = null": (lambda at: edit(at, blocks=None), f"{NOTE} not what was written"),
    "told otherwise": (lambda at: flip(at / "sweep.json", 9), "sweep.json: is not what was written"),
}


@pytest.mark.parametrize("kind", DAMAGE)
def test_damage_is_told_with_file_and_block_and_is_repaired(whole, tmp_path, kind):
    folder, (damage, said) = tmp_path / "damaged", DAMAGE[kind]
    shutil.copytree(whole, folder)
    damage(folder)
    before = files_of(folder)
    with pytest.raises(DamagedStoreError) as caught:
        filled(folder)
    assert f"{folder}/{said}" in caught.value.message
    assert caught.value.exit_code == 3
    assert "--repair" in caught.value.hint
    assert files_of(folder) == before
    faults = filled(folder, repair=True)
    assert any(f"{folder}/{said}" in str(fault.problem) for fault in faults)
    assert files_of(folder) == files_of(whole)
    assert filled(folder) == ()


@pytest.mark.parametrize("kind", ["pipe", "device", "another file"])
def test_what_is_no_file_of_ours_is_replaced_and_never_written_through(whole, tmp_path, kind):
    folder, other = tmp_path / "damaged", tmp_path / "precious"
    shutil.copytree(whole, folder)
    other.write_bytes(b"of somebody else")
    (folder / "many.npy").unlink()
    if kind == "pipe":
        os.mkfifo(folder / "many.npy")
    else:
        (folder / "many.npy").symlink_to("/dev/zero" if kind == "device" else other)
    with pytest.raises(DamagedStoreError, match=r"many\.npy: "):
        filled(folder)
    filled(folder, repair=True)
    assert files_of(folder) == files_of(whole)
    assert not (folder / "many.npy").is_symlink()
    assert other.read_bytes() == b"of somebody else"


def test_of_a_flipped_bit_one_block_alone_is_computed_again(whole, tmp_path):
    shutil.copytree(whole, tmp_path / "damaged")
    flip(tmp_path / "damaged" / "many.npy", 128 + 8 * 12)
    disk = FaultyDisk()
    filled(tmp_path / "damaged", disk, repair=True)
    writes = [path.name for kind, path in disk.log if kind == "write" and path.name.endswith(".npy.part")]
    assert sorted(writes) == ["few.npy.part"] * 2 + ["many.npy.part"] * 3  # a row, two rows; each its header


def test_a_folder_in_place_of_a_file_is_told(whole, tmp_path):
    for name in ("many.npy", "state.json"):
        shutil.copytree(whole, tmp_path / name)
        make_folder(tmp_path / name / name)
        with pytest.raises(DamagedStoreError, match=f"{name}: blocks 0-3: is no file"):
            filled(tmp_path / name)


def test_a_block_that_is_damaged_before_the_end_is_told_too(whole, tmp_path):
    with pytest.raises(Killed):
        filled(tmp_path / "new", FaultyDisk(34, "last"))
    assert 0 < len(json.loads((tmp_path / "new" / "state.json").read_text())["blocks"]) < 4
    flip(tmp_path / "new" / "many.npy.part", 128 + 8 * 5)
    with pytest.raises(DamagedStoreError, match=r"many\.npy\.part: block 0: its numbers"):
        filled(tmp_path / "new")
    filled(tmp_path / "new", repair=True)
    assert files_of(tmp_path / "new") == files_of(whole)


def test_another_question_is_refused_also_where_it_is_to_be_repaired(whole, tmp_path):
    shutil.copytree(whole, tmp_path / "copy")
    for plan in (Plan({**PLAN.question, "seed": 4}, PLAN.arrays, 9), Plan(PLAN.question, PLAN.arrays, 10)):
        for repair in (False, True):
            with pytest.raises(UsageError, match=r"belongs to another question; it differs in (seed|block)\n"):
                filled(tmp_path / "copy", plan=plan, repair=repair)
    with pytest.raises(UsageError, match="it differs in shard"):
        filled(tmp_path / "copy", shard=Shard(1, 2))
    assert files_of(tmp_path / "copy") == files_of(whole)


def test_a_folder_is_worked_on_by_one_process_at_a_time(tmp_path):
    with Store(tmp_path, PLAN) as store:
        store.open()
        with Store(tmp_path, PLAN) as other, pytest.raises(UsageError, match="another process works on it"):
            other.open()
    filled(tmp_path)


def test_files_of_somebody_else_are_left_in_peace(tmp_path):
    (tmp_path / "few.npy").write_bytes(b"mine")
    for repair in (False, True):
        with pytest.raises(UsageError, match="already there"):
            filled(tmp_path, repair=repair)
    assert files_of(tmp_path) == {"few.npy": b"mine"}


@pytest.mark.parametrize("count", [1, 2, 3, 7])
def test_shards_joined_are_the_whole_to_the_byte(whole, tmp_path, count):
    folders = [tmp_path / f"part-{k}" for k in range(1, count + 1)]
    for k, folder in enumerate(folders, start=1):
        filled(folder, shard=Shard(k, count))
    joined(folders[::-1], tmp_path / "joined")
    assert files_of(tmp_path / "joined") == files_of(whole)


def test_what_cannot_be_merged_is_refused(whole, shards, tmp_path):
    one, two, three = shards

    def refused(folders, said, error=UsageError):
        with pytest.raises(error, match=said):
            parts_in(folders)

    refused([], "no shards to merge")
    refused([one, three], "shard 2 of 3 is not among the folders")
    refused([one, two, two, three], "are the same shard")
    refused([one, tmp_path], "no shard is there")
    refused([one, whole], "a whole grid, no shard of one")
    filled(tmp_path / "other", shard=Shard(2, 3), plan=Plan({**PLAN.question, "seed": 4}, PLAN.arrays, 9))
    refused([one, tmp_path / "other", three], "shard of another question.*seed")
    filled(tmp_path / "four", shard=Shard(4, 4))
    refused([one, two, tmp_path / "four"], "the number of shards")
    with pytest.raises(Killed):
        filled(tmp_path / "half", FaultyDisk(15, "last"), shard=Shard(3, 3))
    refused([one, two, tmp_path / "half"], "0 of 2 blocks are done")
    shutil.copytree(two, tmp_path / "damaged")
    flip(tmp_path / "damaged" / "few.npy", -1)
    refused([one, tmp_path / "damaged", three], r"damaged/few\.npy: block 1: its", DamagedStoreError)
    flip(tmp_path / "damaged" / "state.json", 9)
    refused([one, tmp_path / "damaged", three], r"damaged/state\.json: is not what was written", DamagedStoreError)


@pytest.mark.parametrize("text", ["", "2", "0/3", "4/3", "1/0", "a/b", "1/2/3", "-1/3", "1.0/2", "²/3"])
def test_a_shard_is_one_of_n(text):
    with pytest.raises(UsageError, match="is not I/N"):
        Shard.read(text)


def test_blocks_depend_on_the_grid_alone_and_shards_share_them_evenly():
    for size in (1, 1023, 35_000, 10**6, 10**9):
        length = block_length(size, 65536)
        plan = Plan({}, (Array("few", "int8", (), (size,)),), length)
        for count in (1, 2, 3, 7, 64):
            parts = [Plan({}, plan.arrays, length, Shard(k, count)) for k in range(1, count + 1)]
            assert [n for part in parts for n in part.blocks] == list(plan.blocks)
            assert sum(part.length for part in parts) == size
            blocks = [len(part.blocks) for part in parts]
            assert max(blocks) - min(blocks) <= 1
