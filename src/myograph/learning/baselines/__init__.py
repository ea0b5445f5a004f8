"""Methods that a network must beat; they stand in every table. One file each.

do_nothing           nothing changes                                        nothing learned
affine               the best affine map                                    from sensors, nothing learned
thin_plate_spline    the smoothest map                                      from sensors, nothing learned
gappy_pod            modes of the training cases, fitted to the sensors     from sensors
feed_forward         the thesis's network                                   from activations
pod_gp               Gaussian processes on modes                            from activations
deeponet             a field conditioned on what drives it                  from activations, sensors, or both

The last three are imported from their own files; `pod_gp` needs scikit-learn.
"""

from myograph.ensemble.pairs.predictor import Predictor
from myograph.learning.baselines.affine import Affine
from myograph.learning.baselines.do_nothing import DoNothing
from myograph.learning.baselines.gappy_pod import GappyPod
from myograph.learning.baselines.thin_plate_spline import ThinPlateSpline

__all__ = ["BASELINES", "Affine", "DoNothing", "GappyPod", "ThinPlateSpline"]

BASELINES: dict[str, Predictor] = {method.name: method for method in (DoNothing(), Affine(), ThinPlateSpline())}
"""By name, those that need no learning."""
