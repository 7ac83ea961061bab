from collections import Counter

from assur.synthesis.tally import Tally, total


def test_the_sum_of_parts():
    parts = [
        Tally(1, 10, 5, Counter({1: 5}), 3, 1, ("a",)),
        Tally(1, 20, 0),
        Tally(1, 30, 7, Counter({1: 4, 2: 3}), 2, 0, ("b", "c")),
    ]
    assert total(parts) == Tally(3, 60, 12, Counter({1: 9, 2: 3}), 5, 1, ("a", "b", "c"))
    assert total([]) == Tally()
