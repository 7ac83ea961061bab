from pathlib import Path

import pytest

import assur
from assur.errors import UnknownNameError, UsageError
from assur.model.file.reader import read_text
from assur.synthesis.drafting.copying import copied, in_catalogue, mechanism_name


@pytest.mark.parametrize("name", assur.names())
def test_a_copy_is_the_same_mechanism_under_another_name(name):
    found = copied(name, Path("folder/my.toml"))
    first, second = assur.load(name), read_text(found.text, Path("folder/my.toml"))
    assert second.name == "my"
    assert (second.title, second.unit, second.platform.pose) == (first.title, first.unit, first.platform.pose)
    assert {key: item.value for key, item in second.parameters.items()} == {
        key: item.value for key, item in first.parameters.items()
    }
    assert list(second.joints) == list(first.joints)
    assert (found.closed_form is None) == (first.closed_form is None)
    own = first.file.read_text(encoding="utf-8")
    assert f"a copy of {name} from the catalogue" in found.text.splitlines()[0]
    assert all(line in found.text for line in own.splitlines() if not line.startswith("name"))


def test_the_header_says_what_next():
    text = copied("fivebar", Path("my.toml")).text
    assert all(f"assur {word} my.toml" in text for word in ("check", "show", "figures"))


def test_a_name_may_be_its_beginning():
    assert in_catalogue("zeng") == "zeng2019"
    assert in_catalogue("three_p2") == "three_p2us"


@pytest.mark.parametrize(("name", "hint"), [("three_", "did you mean three_"), ("zneg2019", "zeng2019"), ("", "")])
def test_a_name_that_could_be_several_or_none_is_refused_with_the_near_ones(name, hint):
    with pytest.raises(UnknownNameError) as caught:
        in_catalogue(name)
    assert hint in caught.value.hint


def test_what_is_left_out_says_why():
    from assur.model.registry import left_out

    item = left_out()[0]
    with pytest.raises(UnknownNameError) as caught:
        in_catalogue(item.name)
    assert item.reason in caught.value.hint


@pytest.mark.parametrize("name", ["my.txt", "my", ".toml", "ä.toml", "a b.toml"])
def test_a_file_must_be_able_to_name_a_mechanism(name):
    with pytest.raises(UsageError):
        mechanism_name(Path(name))
