"""Writes docs/results.md from docs/results.json, or from the results of a run, which then take its place.

python docs/write_results.py [myograph-reproduce/results.json]
"""

import json
import sys
from pathlib import Path

from myograph.evaluation.experiments.results import results_page

HERE = Path(__file__).parent


def main() -> None:
    """Write."""
    text = Path(sys.argv[1] if len(sys.argv) > 1 else HERE / "results.json").read_text(encoding="utf-8")
    page = results_page(json.loads(text))
    (HERE / "results.json").write_text(text, encoding="utf-8")
    (HERE / "results.md").write_text(page, encoding="utf-8")


if __name__ == "__main__":
    main()
