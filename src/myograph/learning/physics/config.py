"""How much a training minds what is known of a muscle without any case."""

from pydantic import Field

from myograph.config import Model


class Physics(Model):
    """Weights of terms that are added to the loss; all are off.

    Parameters
    ----------
    volume
        Of the mean of (det F - 1)² [-], F = ∂T/∂X, at random integration points of the elements.
    clamped
        Of the mean square distance [mm²] of the nodes that no training case moves from where these are [1/mm²].
    points
        Points of each term in each step.
    """

    volume: float = Field(default=0.0, ge=0)
    clamped: float = Field(default=0.0, ge=0)
    points: int = Field(default=32, ge=1)

    @property
    def minded(self) -> bool:
        """Whether there is any such term."""
        return self.volume > 0 or self.clamped > 0
