"""Tables of results: a line for each name, figures where they belong, dashes where there are none."""

import pytest

from myograph.evaluation.experiments.columns import Column, cells, known, number

ROWS = [
    {"name": "a", "protocol": "thesis", "mean_mm": 1.25, "parameters": 5860},
    {"name": "a", "protocol": "strict", "mean_mm": 2.5, "mean_mm_std": 0.1234, "parameters": 5860},
    {"name": "b", "left_out": "needs a package"},
    {"name": "c", "protocol": "strict", "mean_mm": 0.00123},
]
COLUMNS = (
    Column("thesis", "mean_mm", "thesis"),
    Column("strict", "mean_mm", "strict"),
    Column("off", "mean_mm", "off_grid"),
    Column("numbers", "parameters"),
)


def test_a_line_has_the_figures_of_a_name_under_their_protocols():
    assert cells(ROWS, COLUMNS) == [
        ["a", "1.25", "2.5 ± 0.123", "–", "5,860"],
        ["b", "needs a package"],
        ["c", "–", "0.00123", "–", "–"],
    ]


def test_a_column_without_any_figure_is_not_known():
    assert [column.heading for column in known(ROWS, COLUMNS)] == ["thesis", "strict", "numbers"]


@pytest.mark.parametrize(
    ("value", "text"),
    [(0.0001234, "< 0.001"), (0.00123, "0.00123"), (999.4, "999"), (999.6, "1,000"), (12345.6, "12,346"), (0.0, "0")],
)
def test_numbers_have_three_digits_or_groups(value, text):
    assert number(value) == text
