"""The demonstrations, in the order of a course."""

from coplanar.tour.demos.arms import arm_pose, arm_reach, trace_circle, trace_lemniscate
from coplanar.tour.demos.driving import arc_chain, clothoid, drive_square, holonomic, ramp
from coplanar.tour.demos.flight import aim_speed, aim_time, shot
from coplanar.tour.demos.tracking import track_astroid, track_astroid_p
from coplanar.tour.demos.wheels import omni_three, rolling_wheel

DEMOS = (
    arm_pose,
    arm_reach,
    trace_circle,
    trace_lemniscate,
    rolling_wheel,
    drive_square,
    arc_chain,
    clothoid,
    holonomic,
    omni_three,
    ramp,
    track_astroid,
    track_astroid_p,
    shot,
    aim_time,
    aim_speed,
)

__all__ = ["DEMOS"]
