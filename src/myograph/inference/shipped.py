"""The models that come with the package, and the truth that they are held against.

models/NAME/            a saved model
models/truth/MUSCLE.npz cases of that muscle, see `myograph.inference.truth`
"""

from importlib.resources import files
from pathlib import Path

from myograph.case import MUSCLES
from myograph.ensemble.muscle_cases import MuscleCases
from myograph.errors import InputError
from myograph.inference.model_file import MODEL_FILE, ModelFile, read_model_file
from myograph.inference.truth import read_truth

_ORDER = ("biceps", *(muscle for muscle in MUSCLES if muscle != "biceps"))
_NONE = "this installation has no models of its own; give the folder of a saved one (myograph train makes them)"


def models_folder() -> Path:
    """Where they lie."""
    return Path(str(files("myograph"))) / "models"


def shipped_models() -> dict[str, Path]:
    """Name -> folder; empty where the package has none."""
    found = models_folder()
    folders = sorted(found.iterdir()) if found.is_dir() else []
    return {folder.name: folder for folder in folders if (folder / MODEL_FILE).is_file()}


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
        return min(fitting, key=lambda folder: (_ORDER.index(told[folder].muscle), folder.name))
    if Path(named).exists() or named not in shipped:
        if not Path(named).exists():
            known = f"; the shipped ones are {', '.join(shipped)}" if shipped else ""
            raise InputError(f"{named}: expected the folder of a saved model, found nothing there{known}")
        return Path(named)
    return shipped[named]


def shipped_truth(muscle: str) -> MuscleCases:
    """The cases of a muscle; raises InputError where the package has none."""
    path = models_folder() / "truth" / f"{muscle}.npz"
    if not path.is_file():
        raise InputError(f"this installation has no cases of {muscle} to evaluate on; give the folder of a dataset")
    return read_truth(path)


def _answers(model: ModelFile, from_sensors: bool) -> bool:
    signature = model.signature
    needs_sensors = signature.takes_sensors and signature.least_sensors > 0
    return signature.takes_sensors if from_sensors else "activation" in signature.inputs and not needs_sensors
