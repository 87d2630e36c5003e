"""Planar arms in URDF, against yourdfpy."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from coplanar import Arm, Pose
from coplanar.errors import InvalidInput, InvalidShape, InvalidValue, UnknownName
from coplanar.logs import read_urdf, write_urdf

RNG = np.random.default_rng(7)


def agrees_with_yourdfpy(path, *, tip=None, atol=1e-12):
    """Our arm and yourdfpy's forward kinematics put the tool at one place, at twenty postures."""
    yourdfpy = pytest.importorskip("yourdfpy")
    ours = read_urdf(path, tip=tip)
    theirs = yourdfpy.URDF.load(str(path), load_meshes=False)
    for values in RNG.uniform(-1.5, 1.5, (20, len(ours.names))):
        theirs.update_cfg(dict(zip(ours.names, values, strict=True)))
        frame = theirs.get_transform(ours.tip, ours.root)
        tool = ours.arm.forward(ours.joints(values))
        np.testing.assert_allclose(ours.in_root(tool.position), frame[:3, 3], atol=atol)
        seen = frame[:3, :2].T @ ours.plane[:3, :2]
        x, y = seen[0] if math.hypot(*seen[0]) > 0.5 else seen[1]
        assert math.remainder(math.atan2(y, x) - tool.theta, math.tau) == pytest.approx(0.0, abs=atol)
    return ours


def chain(*joints, links=None):
    """A URDF of these joints in a row, one a line."""
    names = links or [f"l{i}" for i in range(len(joints) + 1)]
    text = ['<robot name="r">', *(f'<link name="{name}"/>' for name in names)]
    for i, joint in enumerate(joints):
        kind, _, rest = joint.partition(" ")
        limit = '<limit lower="-2" upper="3" effort="1" velocity="1"/>' if kind in ("revolute", "prismatic") else ""
        text.append(
            f'<joint name="j{i}" type="{kind}"><parent link="l{i}"/><child link="l{i + 1}"/>{limit}{rest}</joint>'
        )
    return "\n".join([*text, "</robot>"])


def origin(xyz="0 0 0", rpy="0 0 0"):
    return f'<origin xyz="{xyz}" rpy="{rpy}"/>'


def axis(xyz="0 0 1"):
    return f'<axis xyz="{xyz}"/>'


TURN, END = "revolute " + axis(), "fixed " + origin("1 0 0")


@pytest.fixture
def written(tmp_path):
    def write(text):
        path = tmp_path / "arm.urdf"
        path.write_text(text, encoding="utf-8")
        return path

    return write


PLANAR = {
    "two links": ["revolute " + axis(), "revolute " + origin("1 0 0") + axis(), "fixed " + origin("0.5 0 0")],
    "an axis the other way": [
        "revolute " + axis(), "continuous " + origin("1 0.2 0") + axis("0 0 -2"), "fixed " + origin("0.5 0.1 0")
    ],
    "all axes the other way": [
        "revolute " + axis("0 0 -1"), "revolute " + origin("1 0 0") + axis("0 0 -1"), "fixed " + origin("0.5 0 0")
    ],
    "stacked along the axes": [
        "fixed " + origin("0.3 0.1 0.4", "0 0 0.5"), "revolute " + origin("0 0 0.1") + axis(),
        "revolute " + origin("1 0 0.2", "0 0 0.3") + axis(), "fixed " + origin("0 0 0.1"),
        "fixed " + origin("0.5 0.1 -0.3", "0 0 1"), "fixed " + origin("0.1 0.2 0", "0 0 -2"),
    ],
    "upright, about y": [
        "revolute " + origin("0.1 0.2 0.3") + axis("0 1 0"), "revolute " + origin("1 0 0") + axis("0 1 0"),
        "fixed " + origin("0 0.1 0.5", "0 0.3 0"),
    ],
    "about x, the default axis": [
        "revolute " + origin("0.1 0.2 0.3"), "revolute " + origin("0 1 0.5"), "fixed " + origin("0 0.3 0.5", "0.4 0 0")
    ],
    "frames that are turned": [
        "revolute " + origin("0 0 0.3", "1.5707963267948966 0 0") + axis(),
        "revolute " + origin("1 0.2 0", "0 0 0.7") + axis("0 0 -1"),
        "revolute " + origin("0.5 0 0", "3.141592653589793 0 0.1") + axis(),
        "fixed " + origin("0.2 0 0", "0 1.5707963267948966 0"),
    ],
    "any plane": [
        "fixed " + origin("0.3 0.1 0.4", "0.5 -0.8 1.1"), "revolute " + origin("0 0 0.1") + axis(),
        "revolute " + origin("1 0 0.2", "0 0 0.3") + axis("0 0 -1"), "fixed " + origin("0.5 0.1 -0.3", "0 0 1"),
    ],
    "a slide in between": [
        "revolute " + axis(), "prismatic " + origin("0.5 0 0", "0 0 0.4") + axis("0 1 0"),
        "revolute " + origin("0 -0.3 0") + axis(), "fixed " + origin("0.2 0.1 0"),
    ],
    "a slide at the end": [
        "revolute " + axis(), "prismatic " + origin("0.5 0 0") + axis("-1 0 0"), "fixed " + origin("0.2 0.1 0")
    ],
    "a slide at the end of no length": ["revolute " + axis(), "prismatic " + origin("0.5 0 0") + axis("0 1 0")],
    "slides alone": ["prismatic " + axis("1 0 0"), "prismatic " + axis("0 1 0"), "fixed " + origin("0 0.2 0")],
}  # fmt: skip


@pytest.mark.parametrize("name", PLANAR)
def test_planar_chains(written, name):
    ours = agrees_with_yourdfpy(written(chain(*PLANAR[name])))
    assert ours.tilt < 1e-15
    assert ours.root == "l0"
    np.testing.assert_allclose(ours.plane[:3, :3] @ ours.plane[:3, :3].T, np.eye(3), atol=1e-15)
    assert np.linalg.det(ours.plane) == pytest.approx(1.0)


def test_signs_limits_and_names(written):
    ours = read_urdf(written(chain(*PLANAR["an axis the other way"])))
    assert ours.names == ("j0", "j1")
    assert ours.signs == (1.0, -1.0)
    assert ours.arm.limits == ((-2.0, 3.0), (-math.inf, math.inf))
    assert ours.joints({"j1": 0.5}).tolist() == [0.0, -0.5]
    assert ours.joints([[0.1, 0.2], [0.3, 0.4]]).tolist() == [[0.1, -0.2], [0.3, -0.4]]
    assert ours.values([0.1, -0.2]).tolist() == [0.1, 0.2]
    with pytest.raises(UnknownName, match="did you mean 'j1'"):
        ours.joints({"j11": 0.5})
    with pytest.raises(InvalidShape):
        ours.joints([1.0])
    ours = read_urdf(written(chain(*PLANAR["all axes the other way"])))
    assert ours.signs == (-1.0, -1.0)
    assert ours.arm.limits == ((-3.0, 2.0), (-3.0, 2.0))


def test_an_upright_plane_is_seen_with_z_up(written):
    ours = read_urdf(written(chain(*PLANAR["upright, about y"])))
    np.testing.assert_allclose(ours.plane[:3, 0], [1.0, 0.0, 0.0], atol=1e-15)
    np.testing.assert_allclose(ours.plane[:3, 1], [0.0, 0.0, 1.0], atol=1e-15)
    assert ours.signs == (-1.0, -1.0)


def test_a_rounded_right_angle_is_one(written):
    bent = chain(TURN, "revolute " + origin("1 0 0", "1.57 0 0") + axis("0 1 0"), END)
    path = written(bent)
    ours = agrees_with_yourdfpy(path, atol=1e-3)
    assert ours.tilt == pytest.approx(math.pi / 2 - 1.57, rel=1e-6)
    with pytest.raises(InvalidValue, match=r"line 7 of .*'j1', 0\.0456 deg off"):
        read_urdf(path, tilt=1e-4)
    assert agrees_with_yourdfpy(written(bent.replace("1.57", repr(math.pi / 2)))).tilt < 1e-15


BRANCHES = """<robot name="r"><link name="a"/><link name="b"/><link name="c"/><link name="d"/>
<joint name="q" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/><limit/></joint>
<joint name="tip" type="fixed"><parent link="b"/><child link="c"/><origin xyz="1 0 0"/></joint>
<joint name="eye" type="fixed"><parent link="b"/><child link="d"/><origin xyz="0 2 0"/></joint>
</robot>"""


def test_a_tree_needs_its_tip(written):
    path = written(BRANCHES)
    with pytest.raises(InvalidValue, match=r"line 3 of .*'b' with 2 joints on it.*tip=, one of c, d"):
        read_urdf(path)
    assert agrees_with_yourdfpy(path, tip="c").arm.links == (1.0,)
    assert agrees_with_yourdfpy(path, tip="d").arm.links == (2.0,)
    with pytest.raises(UnknownName, match=r"tip in .*one of a, b, c, d"):
        read_urdf(path, tip="e")
    with pytest.raises(InvalidValue, match="nothing moves"):
        read_urdf(path, tip="a")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (chain(TURN, "revolute " + origin("1 0 0") + axis("0 1 0"), END), r"line 7 of .*'j1', 90 deg off.*parallel"),
        (chain(TURN, "prismatic " + origin("1 0 0") + axis("0 0 1"), END), "line 7 of .*'j1', 90 deg off.*a slide"),
        (chain(TURN, "prismatic " + origin("1 0 0") + axis("1 0 0"), TURN.replace("lute ", "lute " + origin("1 1 0")),
               END), "line 8 of .*slide 'j1'.*along the slide"),
        (chain(TURN, TURN, END), "line 6 of .*'j0' and the next on one axis"),
        (chain(TURN), "line 4 of .*'j0' with nothing off its axis.*add a fixed joint"),
        (chain(TURN, "fixed " + origin("0 0 1")), "line 5 of .*nothing off"),
        (chain("fixed ", "fixed "), "nothing moves"),
        (chain("floating ", END), "line 5 of .*'floating'"),
        (chain("planar ", END), "line 5 of .*'planar'"),
        (chain(TURN + '<mimic joint="j1"/>', END), "line 5 of .*mimics"),
        (chain("revolute " + axis("0 0 0"), END), "line 5 of .*longer than 0"),
        (chain("revolute " + axis("0 0"), END), "line 5 of .*3 finite numbers"),
        (chain("revolute " + axis("0 0 nan"), END), "line 5 of .*3 finite numbers"),
        (chain("revolute " + axis("${x} 0 1"), END), "line 5 of .*expand the xacro"),
        (chain("revolute " + axis("1.7e308 1.7e308 1.7e308"), END), "line 5 of .*longer than 0"),
        (chain(TURN, "fixed " + origin("1.7e308 1.7e308 0")), "arm.urdf"),
        (chain(TURN, END, links=["l0", "l1"]), "line 5 of .*child 'l2'.*a link of this file"),
        (chain(TURN, END).replace('<parent link="l0"/>', ""), "line 5 of .*<parent>"),
        (chain(TURN, END).replace('<parent link="l0"/>', "<parent/>"), "line 5 of .*<parent> without link"),
        (chain(TURN, END).replace('type="revolute"', ""), "line 5 of .*<joint> without type"),
        (chain(TURN, END).replace('lower="-2"', 'lower="4"'), "line 5 of .*lower <= upper"),
        (chain(TURN, END).replace('<limit lower="-2" upper="3" effort="1" velocity="1"/>', ""), "without <limit>"),
        (chain(TURN, END).replace('child link="l2"', 'child link="l1"'), "line 6 of .*carried by one joint"),
        (chain(TURN, END).replace('parent link="l0"', 'parent link="l2"'), "0 links at ends"),
        (chain(), "0 links at ends"),
        ("<sdf/>", "line 1 of .*<robot>"),
        ("<robot>\n<link/>\n</robot>", "line 2 of .*<link> without name"),
        ("<robot>\n<joint>", "line 2 of"),
        ("", "line 1 of .*no element found"),
        ("<!DOCTYPE robot [<!ENTITY a 'aaaa'>]>\n<robot>&a;</robot>", "line 1 of .*<!DOCTYPE robot>"),
        ('<!DOCTYPE robot SYSTEM "file:///etc/passwd">\n<robot/>', "line 1 of .*without a document type"),
        ("<robot>&lol;</robot>", "line 1 of"),
        ("<robot>" * 100_000, "line 1 of .*at most 50 elements"),
        ('<?xml version="1.0" encoding="martian"?><robot/>', "arm.urdf"),
        ('<?xml version="1.0" encoding="utf-7"?><robot/>', "arm.urdf"),
        ("<robot>\x00</robot>", "line 1 of"),
    ],
)  # fmt: skip
def test_what_is_no_planar_chain(written, text, words):
    with pytest.raises(InvalidValue, match=words):
        read_urdf(written(text))


def test_links_in_a_ring(written):
    ring = chain(TURN, END).replace('parent link="l0"', 'parent link="l2"')
    with pytest.raises(InvalidValue, match="carry themselves"):
        read_urdf(written(ring), tip="l1")


def test_limits_left_out_are_zero_as_the_format_says(written):
    path = written(chain(TURN, END).replace('lower="-2" upper="3" ', ""))
    assert read_urdf(path).arm.limits == ((0.0, 0.0),)


ARMS = {
    "two links": Arm((1.0, 0.5)),
    "everything": Arm(
        (1.0, 0.5, 0.3), base=Pose(1.0, -2.0, 0.3), tool=Pose(0.1, 0.2, 0.4), limits=[(-1.0, 1.0), None, (-2.0, 2.5)],
        bends=(0.1, -0.2, 3.0),
    ),
    "slides": Arm(
        (1.0, 0.5, 0.0), joints="RPP", limits=[None, (0.0, 0.4), (-0.1, 0.2)], bends=(0.0, math.pi / 2, -1.0),
        tool=Pose(0.0, 0.1, 2.0), base=Pose(0.0, 0.0, -2.0),
    ),
    "a slide first": Arm((0.2, 0.5), joints="PR", limits=[(0.0, 1.0), (-1.0, 1.0)]),
}  # fmt: skip


@pytest.mark.parametrize("name", ARMS)
def test_an_arm_goes_out_and_comes_back(tmp_path, name):
    arm = ARMS[name]
    back = agrees_with_yourdfpy(write_urdf(arm, tmp_path / "arm.urdf"))
    assert (back.names, back.root, back.tip) == (tuple(f"q{i + 1}" for i in range(arm.n)), "world", "tool")
    assert back.signs == (1.0,) * arm.n
    assert (back.arm.joints, back.arm.limits) == (arm.joints, arm.limits)
    np.testing.assert_allclose(back.arm.links, arm.links, atol=1e-15)
    np.testing.assert_allclose(back.arm.bends, arm.bends, atol=1e-15)
    for ours, theirs in ((back.arm.base, arm.base), (back.arm.tool, arm.tool)):
        np.testing.assert_allclose(ours.as_array(), theirs.as_array(), atol=1e-15)
    assert [p.name for p in tmp_path.iterdir()] == ["arm.urdf"]


LENGTHS = st.floats(1e-3, 1e3)
ANGLES = st.floats(-3.1, 3.1)


@given(st.data(), st.integers(1, 5))
@settings(deadline=None, max_examples=40)
def test_any_arm_keeps_its_kinematics(tmp_path_factory, data, n):
    joints = "".join(data.draw(st.lists(st.sampled_from("RP"), min_size=n, max_size=n)))
    arm = Arm(
        data.draw(st.lists(LENGTHS, min_size=n, max_size=n)), joints=joints, limits=[(-1.0, 2.0)] * n,
        bends=data.draw(st.lists(ANGLES, min_size=n, max_size=n)),
        base=Pose(*data.draw(st.tuples(ANGLES, ANGLES, ANGLES))),
        tool=Pose(*data.draw(st.tuples(ANGLES, ANGLES, ANGLES))),
    )  # fmt: skip
    back = read_urdf(write_urdf(arm, tmp_path_factory.mktemp("urdf") / "arm.urdf"))
    q = RNG.uniform(-1.0, 2.0, (5, n))
    ours, theirs = back.arm.forward(back.joints(q)), arm.forward(q)
    size = sum(arm.links)
    np.testing.assert_allclose(back.in_root(ours.position)[:, :2], theirs.position, atol=1e-12 * (10.0 + size))
    np.testing.assert_allclose(np.cos(ours.theta - theirs.theta), 1.0, atol=1e-12)


def test_names_and_what_the_format_does_not_hold(tmp_path):
    path = tmp_path / "arm.urdf"
    back = read_urdf(write_urdf(Arm((1.0, 0.5)), path, names=("a & b", '"<é>"'), robot="it's"))
    assert back.names == ("a & b", '"<é>"')
    before = path.read_bytes()
    for arm, more, words in (
        (Arm((1.0,), angles="absolute"), {}, "relative angles"),
        (Arm((1.0,), limits=[(0.0, math.inf)]), {}, "both sides of joint 0"),
        (Arm((1.0, 1.0), joints="RP"), {}, "joint 1.*a slide has them always"),
        (Arm((1.0, 1.0)), {"names": ("a", "a")}, "2 different names"),
        (Arm((1.0,)), {"names": ("a\nb",)}, "control characters"),
        (Arm((1.0,)), {"robot": ""}, "robot"),
        (Arm((1.0,)), {"effort": 0.0}, "effort"),
        ("arm", {}, "needed a Arm"),
    ):
        with pytest.raises(InvalidInput, match=words):
            write_urdf(arm, path, **more)
    assert path.read_bytes() == before
    with pytest.raises(InvalidValue, match="a place that can be written"):
        write_urdf(Arm((1.0,)), tmp_path / "no" / "arm.urdf")
