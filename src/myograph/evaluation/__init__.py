"""How well a prediction meets the truth: errors in mm, and the report that a person reads."""

from myograph.evaluation.metrics import ErrorSummary, NodeErrors, evaluate, node_errors, summarise
from myograph.evaluation.page import write_report
from myograph.evaluation.report import Figure, Report

__all__ = [
    "ErrorSummary",
    "Figure",
    "NodeErrors",
    "Report",
    "evaluate",
    "node_errors",
    "summarise",
    "write_report",
]
