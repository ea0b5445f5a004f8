r"""The conventions in print for one fibre stress T, as what they make of the energy's slope over the stretch l.

    nominal         P = T F a0 ⊗ a0 / l       force per reference area              dψ/dl = T
    second_piola    S = T a0 ⊗ a0             pulls l times harder                  dψ/dl = T l
    cauchy          J σ = T n ⊗ n, |n| = 1    pulls l times weaker: S = T / l²      dψ/dl = T / l

Trap: the word "active stress" in a paper may mean any of them; a law names the one it uses.
"""

from typing import Literal

Convention = Literal["nominal", "second_piola", "cauchy"]

POWER: dict[Convention, int] = {"nominal": 0, "second_piola": 1, "cauchy": -1}
"""Power of the stretch by which T is multiplied in dψ/dl."""
