import re

import pytest

from assur.synthesis.front import front, values

REASON = re.compile(
    r"(a smaller κ|fewer redundant constraints|fewer joints|more zeros) \(rank (\d+): (\d+)\) costs? (.*)"
)
RESPECTS = ("a smaller κ", "fewer redundant constraints", "fewer joints", "more zeros")
COSTS = (r"κ (\d+)", r"(\d+) redundant constraints? more", r"(\d+) joints? more", r"(\d+) zeros? less")


@pytest.fixture(params=["small", "of_two_limbs", "in_legs"])
def designs(request):
    return request.getfixturevalue(request.param).designs


def beats(first, second):
    never_worse = all(one <= two for one, two in zip(first, second, strict=True))
    return never_worse and any(one < two for one, two in zip(first, second, strict=True))


def test_of_all_mechanisms_the_front_has_those_that_none_beats(designs):
    kept = {rank for point in front(designs) for rank in point.ranks}
    every = [values(design) for design in designs]
    for rank, own in enumerate(every, 1):
        assert (rank in kept) == (not any(beats(other, own) for other in every))


def test_mechanisms_of_one_point_are_worth_the_same_and_the_best_speaks_for_them(designs):
    for point in front(designs):
        assert point.design is designs[point.ranks[0] - 1]
        assert {values(designs[rank - 1]) for rank in point.ranks} == {values(point.design)}


def test_every_reason_is_true_of_the_mechanism_that_it_names(designs):
    for point in front(designs):
        own = values(point.design)
        for said in point.reason.split("; ")[1:]:
            respect, rank, better, cost = REASON.fullmatch(said).groups()
            place, other = RESPECTS.index(respect), values(designs[int(rank) - 1])
            assert other[place] < own[place]
            assert abs(other[place]) == int(better)
            told = [re.search(pattern, cost) for pattern in COSTS]
            more = [new - old for old, new in zip(own, other, strict=True)]
            assert [number is not None for number in told] == [worse > 0 for worse in more]
            changes = [other[0], *more[1:]]
            assert all(number is None or int(number[1]) == by for number, by in zip(told, changes, strict=True))


def test_each_point_says_in_what_it_is_the_best_of_all(small):
    points = front(small.designs)
    least = [min(column) for column in zip(*(values(design) for design in small.designs), strict=True)]
    words = ("smallest κ", "fewest redundant constraints", "fewest joints", "most zeros of the decoupling")
    for point in points:
        best = point.reason.partition("; ")[0].split(", ")
        told = [
            word for word, own, all_least in zip(words, values(point.design), least, strict=True) if own == all_least
        ]
        assert best == (told or ["between the others"])


def test_nothing_found_has_no_front():
    assert front(()) == ()
