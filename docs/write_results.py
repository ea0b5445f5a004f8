"""Writes docs/results*.md from the docs/results*.json beside them.

Sections of a run that is named take the place of their preset's; sections that the run lacks stay.

python docs/write_results.py [myograph-reproduce/results.json]
"""

import json
import sys
from pathlib import Path
from typing import Any

from myograph.evaluation.experiments.results import check_results, file_name, joined, results_page

HERE = Path(__file__).parent


def main() -> None:
    """Write."""
    for source in [Path(path) for path in sys.argv[1:]] or sorted(HERE.glob("results*.json")):
        results = _read(source)
        told = HERE / f"{file_name(results['preset'])}.json"
        if told.exists():
            results = joined(_read(told), results)
        told.write_text(json.dumps(results, indent=1) + "\n", encoding="utf-8")
        told.with_suffix(".md").write_text(results_page(results), encoding="utf-8")


def _read(path: Path) -> dict[str, Any]:
    results = json.loads(path.read_text(encoding="utf-8"))
    check_results(results)
    return results


if __name__ == "__main__":
    main()
