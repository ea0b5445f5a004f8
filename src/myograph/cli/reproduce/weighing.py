"""What a saved model weighs: kilobytes, milliseconds of one answer on one core, multiply-adds; the same in plain C.

One answer is all nodes of one case; its time is that of the fastest, as another trial runs beside this one. In C a
model of neural modes stands as `myograph export c` writes it: all modes as floats, and the fewest modes as int8 that
stay within `INT8_WITHIN_MM` of them. Without a compiler nothing is said of C.
"""

import contextlib
import shutil
import subprocess
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from myograph.cli.reproduce.trial import Trial
from myograph.ensemble.pairs.predictor import Predictor
from myograph.ensemble.pairs.protocols import Split
from myograph.ensemble.pairs.sampler import PairSampler
from myograph.errors import InputError
from myograph.export.c import Wanted, c_source, reduced_muscle
from myograph.files import refusing
from myograph.inference.latency import forward_times
from myograph.inference.loaded import load
from myograph.inference.low_rank import read_low_rank
from myograph.inference.model_file import NETWORK

INT8_WITHIN_MM, KILOBYTE, ANSWERS, ANSWERS_IN_C = 0.05, 1000, 200, 2000
COMPILER = ("-std=c99", "-O2")
CALLED, MODES, SIZE_IN_C = "muscle", "neural_modes", "c_kb"
MAIN = """#include "muscle.h"
#include <stdio.h>
#include <time.h>

static float position[3 * MUSCLE_NODES];

int main(void)
{
    float activation[5] = {0.1f, 0.2f, 0.7f, 0.4f, 0.3f}, sum = 0.0f;
    const clock_t start = clock();
    for (int i = 0; i < ANSWERS; i++) {
        activation[2] = (float)i / (float)ANSWERS;
        muscle_predict(activation, 0.0f, position);
        sum += position[i % (3 * MUSCLE_NODES)];
    }
    printf("%.9g %g\\n", 1000.0 * (double)(clock() - start) / CLOCKS_PER_SEC / ANSWERS, (double)sum);
    return 0;
}
"""


def weighed(predictor: Predictor, sampler: PairSampler, split: Split) -> dict[str, float]:
    """Sizes [kB], times of one answer [ms], multiply-adds."""
    from myograph.learning.counting import multiply_adds
    from myograph.learning.saving import Training, save_model
    from myograph.learning.torch_predictor import TorchPredictor

    assert isinstance(predictor, TorchPredictor)
    question = sampler.batch(split.test[:1]).question
    numbers = sum(value.numel() * value.element_size() for value in predictor.module.state_dict().values())
    told = {"weights_kb": numbers / KILOBYTE, "multiply_adds": multiply_adds(predictor, question)}
    with refusing(Path("temporary files")), tempfile.TemporaryDirectory() as folder:
        place = Path(folder) / "model"
        save_model(predictor, Training(sampler.cases, split), place)
        told["onnx_kb"] = (place / NETWORK).stat().st_size / KILOBYTE
        told["onnx_ms"] = float(forward_times(load(place), ANSWERS).min())
        if predictor.name == MODES:
            told |= in_c(place, Path(folder))
    return told


def lacks_c(trial: Trial, told: Mapping[str, Any]) -> bool:
    """Whether figures of a trial were taken where there was no compiler, and there is one now."""
    weighed_in_c = trial.weighed and trial.method == MODES
    return weighed_in_c and SIZE_IN_C not in told and found_compiler() is not None


def found_compiler() -> str | None:
    """Of C; None where there is none."""
    return shutil.which("cc") or shutil.which("gcc")


def in_c(model: Path, folder: Path) -> dict[str, float]:
    """Size and time of neural modes in plain C; nothing where there is no compiler."""
    compiler = found_compiler()
    if compiler is None:
        return {}
    muscle = read_low_rank(model)
    whole = reduced_muscle(muscle, Wanted("float", tolerance_mm=None, surface=False))
    told = {SIZE_IN_C: whole.bytes / KILOBYTE}
    with contextlib.suppress(InputError):
        told["c_int8_kb"] = reduced_muscle(muscle, Wanted("int8", INT8_WITHIN_MM, surface=False)).bytes / KILOBYTE
    for name, text in {**c_source(whole, CALLED).files, "main.c": MAIN}.items():
        (folder / name).write_text(text, encoding="utf-8")
    command = [compiler, *COMPILER, f"-DANSWERS={ANSWERS_IN_C}", "main.c", f"{CALLED}.c", "-lm", "-o", "program"]
    try:
        subprocess.run(command, cwd=folder, capture_output=True, check=True)
        done = subprocess.run([folder / "program"], capture_output=True, text=True, check=True)
    except (OSError, subprocess.CalledProcessError):
        return told
    return {**told, "c_ms": float(done.stdout.split()[0])}
