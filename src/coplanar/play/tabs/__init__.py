"""The tabs, in the order in which they stand."""

from coplanar.play.tab import Tab
from coplanar.play.tabs.arm import ArmTab

TABS: dict[str, Tab] = {tab.name: tab for tab in (ArmTab(),)}

__all__ = ["TABS"]
