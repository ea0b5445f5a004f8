"""How well a prediction meets the truth: errors in mm and MPa, and the report that a person reads."""

from myograph.evaluation.evaluate import evaluate
from myograph.evaluation.metrics import NodeErrors, node_errors, stress_errors
from myograph.evaluation.page import write_report
from myograph.evaluation.report import Figure, Report
from myograph.evaluation.summary import ErrorSummary, Evaluation, summarise

__all__ = [
    "ErrorSummary",
    "Evaluation",
    "Figure",
    "NodeErrors",
    "Report",
    "evaluate",
    "node_errors",
    "stress_errors",
    "summarise",
    "write_report",
]
