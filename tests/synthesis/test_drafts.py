import assur
from assur.synthesis.drafts import chosen, solved_by


def test_the_best_of_each_family_is_chosen_where_families_are_told(of_two_limbs):
    ranked = dict(chosen(of_two_limbs, 3))
    assert list(ranked.values()) == [family.designs[0] for family in of_two_limbs.families[:3]]
    for rank, design in ranked.items():
        assert of_two_limbs.designs[rank - 1] is design


def test_the_best_are_chosen_where_they_are_told_one_by_one(small):
    assert [design for _, design in chosen(small, 2)] == list(small.designs[:2])


def test_a_problem_without_square_roots_is_told_by_its_polynomial():
    assert solved_by(assur.load("planar_3rpr"), "direct") == "one polynomial of degree 6"


def test_what_resists_is_told():
    assert solved_by(assur.load("gough_stewart"), "direct").startswith("not derived: ")
