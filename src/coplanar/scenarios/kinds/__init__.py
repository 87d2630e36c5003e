"""The kinds of scenario, by their type, in the order of a course."""

from collections.abc import Mapping
from types import MappingProxyType

from coplanar.scenarios.kinds.aim import AimScenario
from coplanar.scenarios.kinds.arm_pose import ArmPose
from coplanar.scenarios.kinds.arm_reach import ArmReach
from coplanar.scenarios.kinds.arm_trace import ArmTrace
from coplanar.scenarios.kinds.drive import Drive
from coplanar.scenarios.kinds.frames import Frames
from coplanar.scenarios.kinds.holonomic import Holonomic
from coplanar.scenarios.kinds.lab import Lab
from coplanar.scenarios.kinds.program import ProgramScenario
from coplanar.scenarios.kinds.ramp import RampScenario
from coplanar.scenarios.kinds.rolling_wheel import RollingScenario
from coplanar.scenarios.kinds.shot import ShotScenario
from coplanar.scenarios.kinds.track import Track
from coplanar.scenarios.kinds.wheels import Wheels
from coplanar.scenarios.scenario import Scenario

KINDS: Mapping[str, type[Scenario]] = MappingProxyType(
    {
        str(kind.model_fields["type"].default): kind
        for kind in (
            Frames, ArmPose, ArmReach, ArmTrace, RollingScenario, Drive, ProgramScenario, Holonomic, Wheels,
            RampScenario, Track, ShotScenario, AimScenario, Lab,
        )
    }
)  # fmt: skip

__all__ = [
    "KINDS",
    "AimScenario",
    "ArmPose",
    "ArmReach",
    "ArmTrace",
    "Drive",
    "Frames",
    "Holonomic",
    "Lab",
    "ProgramScenario",
    "RampScenario",
    "RollingScenario",
    "ShotScenario",
    "Track",
    "Wheels",
]
