"""Writes docs/results*.md from the docs/results*.json beside them; results of a run take the place of their preset's.

python docs/write_results.py [myograph-reproduce/results.json]
"""

import json
import sys
from pathlib import Path

from myograph.evaluation.experiments.results import file_name, results_page

HERE = Path(__file__).parent


def main() -> None:
    """Write."""
    for source in [Path(path) for path in sys.argv[1:]] or sorted(HERE.glob("results*.json")):
        text = source.read_text(encoding="utf-8")
        results = json.loads(text)
        page, name = results_page(results), file_name(results["preset"])
        (HERE / f"{name}.json").write_text(text, encoding="utf-8")
        (HERE / f"{name}.md").write_text(page, encoding="utf-8")


if __name__ == "__main__":
    main()
