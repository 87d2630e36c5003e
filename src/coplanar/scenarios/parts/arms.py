"""An arm as a file describes it."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from coplanar.arms import Arm
from coplanar.scenarios.part import Part
from coplanar.scenarios.parts.common import PosePart
from coplanar.scenarios.quantities import Angle, Distance, Joint

Posture = Annotated[tuple[Joint, ...], Field(min_length=1, max_length=64)]


class ArmPart(Part):
    """A serial arm on revolute (R) and prismatic (P) joints."""

    links: Annotated[tuple[Distance, ...], Field(min_length=1, max_length=64)] = Field(
        description="Length of every link, base first"
    )
    joints: Annotated[str, Field(max_length=64)] | None = Field(
        default=None, description="One letter a link, R turns and P slides; all turn unless given"
    )
    angles: Literal["relative", "absolute"] = Field(
        default="relative", description="Joint angles from the link before, or from the base's x axis"
    )
    base: PosePart = Field(default=PosePart(), description="Where the arm stands in the world")
    tool: PosePart = Field(default=PosePart(), description="The tool in the frame at the end of the last link")
    limits: Annotated[tuple[tuple[Joint | None, Joint | None] | None, ...], Field(max_length=64)] | None = Field(
        default=None, description="Lower and upper limit of every joint; null where there is none"
    )
    bends: Annotated[tuple[Angle, ...], Field(max_length=64)] | None = Field(
        default=None, description="A fixed angle added to every link's direction"
    )

    def build(self) -> Arm:
        """The arm."""
        return Arm(
            self.links, joints=self.joints, angles=self.angles, base=self.base.build(), tool=self.tool.build(),
            limits=self.limits, bends=self.bends,
        )  # fmt: skip
