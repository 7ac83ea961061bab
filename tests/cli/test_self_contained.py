import pytest

from assur.cli.self_contained import outside_needs


@pytest.mark.parametrize(
    "page",
    [
        '<img src="https://doi.org/a.png">',
        '<link rel="stylesheet" href="a.css">',
        '<script src="//doi.org/a.js"></script>',
        "<style>@import 'a.css';</style>",
        "<style>p { background: url(a.png) }</style>",
        "<style>p { background: url('a.png') }</style>",
        '<p style="background: url(http://doi.org/a.png)">',
        '<object data="a.svg"></object>',
        '<svg><image xlink:href="a.png"/></svg>',
        '<svg><use href="a.svg#x"/></svg>',
    ],
)
def test_what_is_loaded_from_outside_is_found(page):
    assert outside_needs(page)


@pytest.mark.parametrize(
    "page",
    [
        "<p>url(x.png)</p>",
        '<a href="https://arxiv.org">x</a>',
        '<img src="data:image/png;base64,AA">',
        "<style>p { background: url(data:image/png;base64,AA); mask: url('#m') }</style>",
        '<svg xmlns="http://www.w3.org/2000/svg"><use href="#x"/></svg>',
    ],
)
def test_what_is_inside_or_a_link_is_not(page):
    assert outside_needs(page) == []
