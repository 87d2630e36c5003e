"""The kinds of scenario, by their type."""

from collections.abc import Mapping
from types import MappingProxyType

from coplanar.scenarios.kinds.arm_reach import ArmReach
from coplanar.scenarios.kinds.track import Track
from coplanar.scenarios.scenario import Scenario

KINDS: Mapping[str, type[Scenario]] = MappingProxyType({"arm-reach": ArmReach, "track": Track})

__all__ = ["KINDS", "ArmReach", "Track"]
