"""The models that come with the package, and the truth that they are held against.

models/NAME/             a saved model
models/arm/MUSCLE/       one of five that share the network for the elbow's angle; its name is arm/MUSCLE
models/truth/MUSCLE.npz  cases of that muscle, see `myograph.inference.truth`; truth/arm/MUSCLE.npz for the arm's bodies
"""

from importlib.resources import files
from pathlib import Path

from myograph.case import MUSCLES
from myograph.ensemble.muscle_cases import MuscleCases
from myograph.errors import InputError
from myograph.inference.model_file import MODEL_FILE, ModelFile, read_model_file
from myograph.inference.truth import read_truth

ARM, TRUTH = "arm", "truth"
"""Folders of more than one model, and of cases."""
_ORDER = ("biceps", *(muscle for muscle in MUSCLES if muscle != "biceps"))
_NONE = "this installation has no models of its own; give the folder of a saved one (myograph train makes them)"


def models_folder() -> Path:
    """Where they lie."""
    return Path(str(files("myograph"))) / "models"


def shipped_models() -> dict[str, Path]:
    """Name -> folder, those of single muscles first; empty where the package has none."""
    found = models_folder()
    paths = [path for pattern in ("*", f"{ARM}/*") for path in sorted(found.glob(f"{pattern}/{MODEL_FILE}"))]
    return {path.parent.relative_to(found).as_posix(): path.parent for path in paths}


def find_model(named: str | None, from_sensors: bool = False) -> Path:
    """The folder of a saved model, or of a shipped one by its name.

    Without a name the first shipped one that answers from activations, or from sensors; of biceps, if there is one.
    Raises InputError where there is none.
    """
    shipped = shipped_models()
    if named is None:
        told = {folder: read_model_file(folder) for folder in shipped.values()}
        fitting = [folder for folder, model in told.items() if _answers(model, from_sensors)]
        if not fitting:
            raise InputError(_NONE)
        return min(fitting, key=lambda folder: _ORDER.index(told[folder].muscle))
    place = Path(named)
    try:
        saved, there = (place / MODEL_FILE).is_file(), place.exists()
    except OSError as problem:
        raise InputError(f"{named}: cannot be read: {problem.strerror}") from None
    if not saved and named in shipped:
        return shipped[named]
    if not there:
        known = f"; the shipped ones are {', '.join(shipped)}" if shipped else ""
        raise InputError(f"{named}: expected the folder of a saved model, found nothing there{known}")
    return place


def shipped_truth(muscle: str, nodes: int | None = None) -> MuscleCases:
    """The cases of a muscle, whose body has that many nodes; raises InputError where the package has none."""
    folder, sizes = models_folder() / TRUTH, []
    for path in (folder / f"{muscle}.npz", folder / ARM / f"{muscle}.npz"):
        if not path.is_file():
            continue
        cases = read_truth(path)
        if nodes in (None, cases.nodes):
            return cases
        sizes.append(str(cases.nodes))
    found = f" with a body of {nodes} nodes, only of {' and '.join(sizes)}" if sizes else ""
    raise InputError(f"this installation has no cases of {muscle} to evaluate on{found}; give the folder of a dataset")


def _answers(model: ModelFile, from_sensors: bool) -> bool:
    signature = model.signature
    needs_sensors = signature.takes_sensors and signature.least_sensors > 0
    return signature.takes_sensors if from_sensors else "activation" in signature.inputs and not needs_sensors
