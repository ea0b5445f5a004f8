"""All laws by their names, and the type that configurations choose them by: `law = "gauss"`."""

from typing import Annotated, get_args

from pydantic import Field

from myograph.materials.blemker import Blemker
from myograph.materials.blemker_tendon import BlemkerTendon
from myograph.materials.gauss import Gauss
from myograph.materials.guccione import Guccione
from myograph.materials.heidlauf_roehrle import HeidlaufRoehrle
from myograph.materials.law import Law
from myograph.materials.mooney_rivlin import MooneyRivlin
from myograph.materials.neo_hooke import NeoHooke
from myograph.materials.roehrle import Roehrle
from myograph.materials.toe_tendon import ToeTendon
from myograph.materials.trans_iso_mooney_rivlin import TransIsoMooneyRivlin

_AnyLaw = (
    Gauss
    | ToeTendon
    | Roehrle
    | HeidlaufRoehrle
    | Blemker
    | BlemkerTendon
    | TransIsoMooneyRivlin
    | Guccione
    | NeoHooke
    | MooneyRivlin
)
AnyLaw = Annotated[_AnyLaw, Field(discriminator="law")]
"""For fields of configurations: the key `law` chooses."""

LAWS: dict[str, type[Law]] = {law.model_fields["law"].default: law for law in get_args(_AnyLaw)}
"""Name -> law."""
