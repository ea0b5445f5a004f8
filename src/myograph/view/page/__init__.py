"""The living page: an arm of neural modes as one HTML file that opens from disk, with sliders, offline.

source     the models of an arm, and the anatomy that they were made with
truth      cases of a dataset to compare with
network    a network that is asked anywhere, beside the modes of its muscle
solving    how long a solver takes
surface    what is drawn of a body: its skin, refined or thinned
content    all of it as JSON and one blob of numbers
template   the built page that these are put into
"""

from myograph.view.page.asked import PageArm
from myograph.view.page.content import page_content
from myograph.view.page.network import PageNetwork, is_network, read_network
from myograph.view.page.solving import SolveTime, shipped_solve_time
from myograph.view.page.source import ArmModels, read_arm_models
from myograph.view.page.template import filled_page, read_runtime, read_template
from myograph.view.page.truth import TruthCase, read_truth_cases

__all__ = [
    "ArmModels",
    "PageArm",
    "PageNetwork",
    "SolveTime",
    "TruthCase",
    "filled_page",
    "is_network",
    "page_content",
    "read_arm_models",
    "read_network",
    "read_runtime",
    "read_template",
    "read_truth_cases",
    "shipped_solve_time",
]
