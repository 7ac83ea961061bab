import assur
from assur.kinematics.answers.style import given_words, style_of, texts_of, titles_of


def test_seven_digits_of_the_size_of_the_mechanism():
    style = style_of(assur.load("zeng2019"))
    assert style.number(456.33154, angle=False) == "456.3315"
    assert style.number(62.0, angle=True) == "62.0000"


def test_a_terminal_and_a_page_say_the_same_in_their_own_signs():
    record = assur.load("planar_3rrr")
    plain, page = style_of(record), style_of(record, typeset=True)
    pose = (-1.0, 2.0, -30.0)
    said = texts_of(record, plain, pose, direct=True)
    assert texts_of(record, page, pose, direct=True) == [text.replace("-", "\N{MINUS SIGN}") for text in said]
    titles = titles_of(record, plain, direct=True)
    assert titles == titles_of(record, page, direct=True) == ["x [mm]", "y [mm]", "phi [deg]"]
    assert given_words(record, plain, pose, direct=False).endswith("phi = -30.0000 deg")
    assert given_words(record, page, pose, direct=False).endswith("phi = \N{MINUS SIGN}30.0000\N{DEGREE SIGN}")


def test_parts_of_a_quaternion_have_no_unit():
    style = style_of(assur.load("gough_stewart"))
    assert style.coordinate_title("qw") == "qw"
    assert style.coordinate("qw", 0.5) == "0.500000"
    assert style.point_title(("x", "qw")) == f"(x, qw) [{style.unit}, 1]"
