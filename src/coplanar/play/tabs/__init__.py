"""The tabs, in the order in which they stand."""

from coplanar.play.tab import Tab
from coplanar.play.tabs.arm import ArmTab
from coplanar.play.tabs.base import BaseTab
from coplanar.play.tabs.drive import DriveTab
from coplanar.play.tabs.lab import LabTab
from coplanar.play.tabs.motion import MotionTab
from coplanar.play.tabs.shoot import ShootTab

TABS: dict[str, Tab] = {tab.name: tab for tab in (ArmTab(), DriveTab(), BaseTab(), MotionTab(), ShootTab(), LabTab())}

__all__ = ["TABS"]
