from itertools import combinations_with_replacement, product
from types import SimpleNamespace

from assur.synthesis.classes import are_equal, chosen_classes, classes, number_of_members, simplest_members


def stand_in(text, joints=3, parallelograms=0, drives=1):
    limb = SimpleNamespace(joints=joints, parallelograms=parallelograms, driven=tuple(range(drives)))
    return SimpleNamespace(text=text, type=limb)


def test_limbs_of_one_class_have_one_poc_set(in_space):
    found = classes(in_space.limbs)
    assert sum(map(len, found)) == len(in_space.limbs)
    for members in found:
        assert len({(limb.known.poc.t, limb.known.poc.r, limb.type.freedoms) for limb in members}) == 1


def test_the_simplest_limb_of_a_class_comes_first(in_space):
    for members in classes(in_space.limbs):
        joints = [limb.type.joints for limb in members]
        assert joints == sorted(joints)


def test_the_number_of_members_is_that_of_the_ways_to_take_them():
    first, second = (tuple(stand_in(f"{name}{index}") for index in range(4)) for name in "ab")
    assert number_of_members([first, first, second]) == len(list(combinations_with_replacement(first, 2))) * 4
    assert number_of_members([first, first, first]) == len(list(combinations_with_replacement(first, 3)))
    assert number_of_members([first, second]) == len(list(product(first, second)))


def test_members_are_different_and_in_order():
    first = (stand_in("a1", 2), stand_in("a2", 3))
    second = (stand_in("b1", 3), stand_in("b2", 3, 1))
    texts = [[limb.text for limb in limbs] for limbs in simplest_members([first, first, second])]
    assert texts[0] == ["a1", "a1", "b1"]
    assert len(texts) == 6
    joints = [sum(limb.type.joints for limb in limbs) for limbs in simplest_members([first, first, second])]
    assert joints == sorted(joints)
    assert all(len(set(map(id, limbs))) > 1 for limbs in simplest_members([first, first, first]))


def test_sets_of_classes_have_the_drives_that_are_asked_for_and_equal_ones_are_those_of_one_class():
    one, other, twice = ((stand_in(name, drives=drives),) for name, drives in (("a", 1), ("b", 1), ("c", 2)))
    every = list(chosen_classes([one, other, twice], 2, 2))
    assert every == [(one, one), (one, other), (other, other)]
    assert list(chosen_classes([one, other, twice], 2, 2, equal=True)) == [some for some in every if are_equal(some)]
    assert list(chosen_classes([one, other, twice], 2, 3)) == [(one, twice), (other, twice)]
