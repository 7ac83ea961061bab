"""Ranks of twists of parts of the joint graph, beside the textbook's tables."""

from __future__ import annotations

import pytest

from assur.audit.configurations import configurations
from assur.audit.topology import Decomposition, decomposition_rows
from assur.audit.twists import (
    constraint_rank,
    expanded,
    freedom_sum,
    freedoms_with_inputs_locked,
    part,
    poc_dimensions,
)
from assur.errors import UnknownNameError, UsageError
from assur.kinematics.closure import closure_error, mobility
from assur.model.registry import load_record

RECORD = load_record("zeng2019")
LOOP1 = ("P1", "B1", "C1", "C2", "B2", "P2")


@pytest.mark.parametrize(
    ("joints", "link", "expected"),
    [
        (("P1",), "slider1", (1, 0, 1)),
        (("P1", "B1"), "link9", (1, 1, 2)),
        (("P1", "B1", "C1"), "link11", (2, 1, 3)),
        (LOOP1, "link11", (2, 1, 3)),
        (("P3", "Pa1"), "linkS", (2, 0, 2)),
        (("P3", "Pa1", "Pa2"), "platform", (3, 0, 3)),
        ((), "platform", (3, 0, 3)),
    ],
    ids=str,
)
def test_poc_dimensions(joints, link, expected):
    assert poc_dimensions(RECORD, link, joints) == expected


def test_the_whole_joint_graph_has_the_rank_of_its_closure():
    assert constraint_rank(RECORD) == int(mobility(RECORD, configurations(RECORD).values[0]).rank) == 14
    assert freedom_sum(RECORD) == 17


@pytest.mark.parametrize(
    ("joints", "rank", "loops"), [(LOOP1, 3, 1), (("Pa1",), 3, 1), (("Pa2",), 3, 1), (("P1",), 0, 0)]
)
def test_rank_of_a_part(joints, rank, loops):
    assert constraint_rank(RECORD, joints) == rank
    assert len(part(RECORD, joints).loops) == loops


def test_generalised_joints_stand_for_their_joints():
    assert expanded(RECORD, ("P3", "Pa1")) == ("P3", "B3a", "C3a", "C3b", "B3b")


def test_inputs_lock_every_random_configuration():
    here = configurations(RECORD)
    assert {freedoms_with_inputs_locked(RECORD, values) for values in here.values[:10]} == {0}


def test_configurations_close_and_so_do_their_motions():
    here = configurations(RECORD)
    assert len(here.values) == len(here.rates) == len(here.modes) > 50
    assert closure_error(RECORD, here.values).max() < 1e-8
    step = 1e-5
    assert closure_error(RECORD, here.values + step * here.rates).max() < 1e4 * step**2 * 280


def test_an_unknown_joint_or_link_is_refused():
    with pytest.raises(UnknownNameError, match="P9"):
        constraint_rank(RECORD, ("P9",))
    with pytest.raises(UnknownNameError, match="link12"):
        poc_dimensions(RECORD, "link12", ("P1", "B1"))


def test_a_part_in_two_pieces_is_refused():
    with pytest.raises(UsageError, match="do not hang together"):
        part(RECORD, ("P1", "D2"))


def test_a_wrong_number_is_found():
    loop = {"name": "L", "joints": LOOP1, "freedoms": "6", "inputs": "2", "xi": "4", "delta": "1"}
    names = ("freedoms", "inputs", "xi", "delta", "loop_count", "freedom", "kappa")
    entry = Decomposition(sources=dict.fromkeys(names, "S"), loops=(loop,), loop_count="1", freedom="3", kappa="0")
    wrong = {row.quantity: row.computed for row in decomposition_rows(RECORD, entry) if row.verdict == "wrong"}
    assert wrong["xi, L"] == 3
