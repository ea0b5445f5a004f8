"""Parameter sets from print, by name; the starting point for an arm of your own and what the laws' pages draw.

All in MPa. `bulk` and `K` are ours, high enough to keep the volume to a thousandth. Recalled rather than looked up, so
to be checked against the source before a study rests on them: the sets of `roehrle`.
"""

from myograph.materials.blemker import Blemker
from myograph.materials.blemker_tendon import BlemkerTendon
from myograph.materials.guccione import Guccione
from myograph.materials.heidlauf_roehrle import HeidlaufRoehrle
from myograph.materials.law import Law
from myograph.materials.roehrle import Roehrle
from myograph.materials.trans_iso_mooney_rivlin import TransIsoMooneyRivlin

LITERATURE: dict[str, Law] = {
    "roehrle muscle": Roehrle(c1=3.56e-2, c2=3.86e-3, c3=3.57e-8, c4=42.6, sigma_max=0.3, bulk=50.0),
    "roehrle tendon": Roehrle(c1=2.31, c2=1.15e-6, c3=7.99, c4=16.6, sigma_max=0.0, bulk=500.0),
    "heidlauf_roehrle muscle": HeidlaufRoehrle(c1=3.176e-12, c2=1.813e-2, b=1.075e-4, d=9.1733, p_max=0.073, bulk=50.0),
    "blemker muscle": Blemker(G1=5e-4, G2=5e-4, P1=0.05, P2=6.6, L_ofl=1.07, l_star=1.4, sigma_max=0.3, K=100.0),
    "blemker_tendon tendon": BlemkerTendon(G1=0.05, G2=0.05, L1=2.7, L2=46.4, l_star=1.03, K=5000.0),
    "trans_iso_mooney_rivlin tendon": TransIsoMooneyRivlin(
        C1=13.85, C2=0.0, C3=2.07, C4=61.44, C5=640.7, l_m=1.03, K=5000.0
    ),
    "guccione passive heart": Guccione(C=2e-3, bf=8.0, bt=2.0, bfs=4.0, bulk=10.0),
    "guccione active heart": Guccione(C=2e-3, bf=8.0, bt=2.0, bfs=4.0, T_a=0.06, bulk=10.0),
}
"""Law and tissue -> the law with its published parameters."""
