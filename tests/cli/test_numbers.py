import pytest
from hypothesis import given
from hypothesis import strategies as st

from assur.cli.numbers import assignments, interval, number, numbers, parts, shielded, whole_number
from assur.errors import UsageError


@given(st.floats(min_value=-1e60, max_value=1e60))
def test_every_float_reads_back_the_same(value):
    assert number(repr(value), "q") == value
    assert number(f" {value!r}", "q") == value


@pytest.mark.parametrize("text", ["5", "+5", "5.", "05", "5e0", "50E-1", ".5e1"])
def test_all_spellings_of_five(text):
    assert number(text, "q") == 5.0


@pytest.mark.parametrize(
    ("text", "message", "hint"),
    [
        ("nan", "q: nan is not a finite number", ""),
        ("-Inf", "q: -Inf is not a finite number", ""),
        ("Infinity", "q: Infinity is not a finite number", ""),
        ("1e999", "q: 1e999 is too large", ""),
        ("-1e61", "q: -1e61 is too large", ""),
        ("1,5", "q: '1,5' is not a number", "write a decimal point: 1.5"),
        ("-,5", "q: '-,5' is not a number", "write a decimal point: -.5"),
        ("1,", "q: '1,' is not a number", "leave out the comma: 1"),
        ("\N{MINUS SIGN}5", "q: '\N{MINUS SIGN}5' is not a number", "write the minus as a hyphen: -5"),
    ],
)
def test_what_is_no_number_is_refused(text, message, hint):
    with pytest.raises(UsageError) as caught:
        number(text, "q")
    assert (caught.value.message, caught.value.hint) == (message, hint)


@pytest.mark.parametrize(
    "text", ["", "abc", "1_000", "0x10", "5mm", "1 2", "--5", "٣", "1.5.2", ",", "1e", "1,000,000"]
)
def test_other_words_are_refused_with_an_example(text):
    with pytest.raises(UsageError, match="is not a number") as caught:
        number(text, "q")
    assert caught.value.hint == "give it like -143.3209 or 1.5e3, without a unit"


def test_a_wrong_number_of_values_is_refused_before_their_form():
    with pytest.raises(UsageError, match=r"^pose: 1 value, 2 wanted\nhint: give x, y$"):
        numbers(["abc"], ["x", "y"], "pose")


def test_a_wrong_value_is_named():
    with pytest.raises(UsageError, match=r"^y: 'abc' is not a number"):
        numbers(["1", "abc"], ["x", "y"], "pose")


def test_assignments():
    assert assignments(["l2=300", "l3 = 4"], "--set", "l2=300") == {"l2": "300", "l3": "4"}


def test_only_a_comma_in_front_of_a_name_parts():
    assert parts(["-3:3,a=1,5", " b = -1:2 , c=0 "], "--stroke") == ["-3:3", "a=1,5", "b = -1:2", "c=0"]
    assert assignments(["l2=3,5,l3=,5"], "--set", "l2=300") == {"l2": "3,5", "l3": ",5"}


@pytest.mark.parametrize("text", ["x=1:2,", "x=1:2, ", ",x=1:2", "x=1:2,,y=3:4", "x=1:2, ,y=3:4", "x=1:2,,", ","])
def test_a_comma_too_many_is_refused_as_such(text):
    with pytest.raises(UsageError, match="has a comma too many") as caught:
        assignments([text], "--box", "x=-1:1")
    assert caught.value.message == f"--box: '{text.strip()}' has a comma too many"
    assert caught.value.hint == "put one between two parts, none at the end"


@pytest.mark.parametrize("text", ["l2", "=3", "l2=", "=", ""])
def test_half_an_assignment_is_refused(text):
    with pytest.raises(UsageError, match=r"is not NAME=VALUE\nhint: for example --set l2=300$"):
        assignments([text], "--set", "l2=300")


def test_a_name_given_twice_is_refused():
    with pytest.raises(UsageError, match="--set: l2 is given twice"):
        assignments(["l2=1", "l2=2"], "--set", "l2=300")


@pytest.mark.parametrize("text", ["3:-3", "3:3", "0:-0"])
def test_an_interval_turned_round_or_empty_is_refused(text):
    with pytest.raises(UsageError, match=r"^--box x = .* is turned round or empty\nhint: give LOW < HIGH"):
        interval(text, "--box x", "x=-1:1")


def test_a_number_is_no_interval():
    with pytest.raises(UsageError, match=r"^--box x: '3' is not LOW:HIGH\nhint: for example --box x=-1:1$"):
        interval("3", "--box x", "x=-1:1")


@pytest.mark.parametrize("text", ["1.5", "abc", "", "1e3", "99999999999"])
def test_what_is_no_whole_number_is_refused(text):
    with pytest.raises(UsageError, match="is not a whole number"):
        whole_number(text, "--resolution")


def test_no_value_is_taken_for_an_option():
    words = ["m", "-1", "-1,5", "-.5", "-inf", "--mode", "--+-", "--stroke", "-3:3", "-h", "--json", "--", "-o", "-x"]
    assert shielded(words) == [
        *("m", " -1", " -1,5", " -.5", " -inf", "--mode=--+-", "--stroke", " -3:3"),
        *("-h", "--json", "--", "-o", "-x"),
    ]


def test_a_mode_that_is_missing_or_an_option_is_left_to_the_parser():
    assert shielded(["--mode"]) == ["--mode"]
    assert shielded(["--mode", "--json"]) == ["--mode", "--json"]


@pytest.mark.parametrize(
    ("what", "text", "hint"),
    [
        ("--box phi", "0:0", "give LOW < HIGH; to hold it: --at phi=0"),
        ("--along x", " 2.50 : 2.5", "give LOW < HIGH; to hold it: --at x=2.50"),
        ("--box phi", "1:0", "give LOW < HIGH"),
        ("--stroke q", "1:1", "give LOW < HIGH"),
        ("--stroke", "1:1", "give LOW < HIGH"),
    ],
)
def test_an_interval_of_one_value_is_held_with_at(what, text, hint):
    with pytest.raises(UsageError, match="is turned round or empty") as caught:
        interval(text, what, "x=-1:1")
    assert caught.value.hint == hint


def test_two_hyphens_end_the_options(assur_cli):
    plain, after = (assur_cli("direct", "fivebar", *words, "127", "53") for words in ((), ("--",)))
    assert (after.code, after.out) == (0, plain.out)
    assert assur_cli("direct", "zeng2019", "--", "162.6907", "-143.3209", "-24.6776").code == 0
