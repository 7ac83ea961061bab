"""Compliance against PyNite: the same rods as its members, hinges as releases, rigid links as members that are stiff.

Its hinges are about axes of its members, which are turned so that one of these is the hinge's. It has no shear.
"""

import numpy as np
import pytest

import assur
from assur.joint_graph.frames import screws
from assur.machine.elasticity.strains import strains
from assur.machine.elasticity.structure import structure

pytestmark = pytest.mark.engines
STIFF = 1e3
"""How much more rigid links resist than rods of their material: more, and PyNite's own matrix loses digits."""
FORCES = ("FX", "FY", "FZ", "MX", "MY", "MZ")
MOVES = ("DX", "DY", "DZ", "RX", "RY", "RZ")


class Frame:
    """The frame of a mechanism of revolute joints, and of prismatic ones along axes of the base on rigid links."""

    def __init__(self, record, values):
        from Pynite import FEModel3D

        self.own = structure(record, shear=False)
        self.state, self.record = strains(self.own, values), record
        self.axes = screws(record, values)[0]
        self.model, self.made, self.ties = FEModel3D(), {}, 0
        (profile,), (material,) = record.machine.profiles.values(), record.machine.materials.values()
        rigidity = material.elasticity / (2 * (1 + material.poisson))
        for name, more in (("soft", 1.0), ("stiff", STIFF)):
            self.model.add_material(name, more * material.elasticity, more * rigidity, material.poisson, 1.0)
        self.model.add_section("rod", profile.area, profile.iy, profile.iz, profile.torsion)
        self.model.add_section("link", 10 * profile.area, *(100 * np.array([profile.iy, profile.iz, profile.torsion])))
        self.releases = {}
        self.joints()
        self.rods()

    def node(self, body):
        """The node of a body."""
        if body not in self.made:
            self.made[body] = f"body{body}"
            self.model.add_node(self.made[body], *self.place(body))
        return self.made[body]

    def place(self, body):
        link, number = self.own.bodies[body]
        if body == self.own.platform:
            return self.state.point[0]
        turn, origin = (part[0] for part in self.state.frames[link])
        return origin + turn @ self.own.skeletons[link].nodes[number] if link in self.own.skeletons else origin

    def tied(self, body, point):
        """A node at a point that a stiff member ties to a body."""
        if np.linalg.norm(point - self.place(body)) < 1e-9:
            return self.node(body)
        self.ties += 1
        self.model.add_node(f"tie{self.ties}", *point)
        self.model.add_member(f"link{self.ties}", self.node(body), f"tie{self.ties}", "stiff", "link")
        return f"tie{self.ties}"

    def joints(self):
        """A hinge releases the end of one rod; a slide is a support with the drive's spring."""
        ends = [body for beam in self.own.beams for body in beam.bodies]
        borne = [body for sides in self.own.sides.values() for body in sides]
        for name, (parent, child) in self.own.sides.items():
            joint, (item,) = self.record.joints[name], self.record.joint_coordinates(name)
            turn, origin = (part[0] for part in self.state.frames[joint.child])
            point = origin + turn @ joint.child_at / 1e3
            if joint.type.name == "prismatic":
                along = int(np.argmax(np.abs(self.axes[3:, item.index])))
                node = self.tied(child, point)
                self.model.def_support(node, *(place != along for place in range(6)))
                self.model.def_support_spring(node, MOVES[along], self.record.machine.actuators[name].stiffness)
                continue
            alone = [body for body in (child, parent) if ends.count(body) == 1 == borne.count(body)]
            other = parent if alone[0] == child else child
            self.releases[alone[0]] = self.tied(other, point), self.axes[:3, item.index]

    def rods(self):
        for number, beam in enumerate(self.own.beams):
            nodes = [self.releases[body][0] if body in self.releases else self.node(body) for body in beam.bodies]
            name = f"rod{number}"
            self.model.add_member(name, *nodes, "soft", "rod")
            hinges = [self.releases[body][1] for body in beam.bodies if body in self.releases]
            if hinges:
                self.turn(self.model.members[name], hinges[0])
                first, second = (body in self.releases for body in beam.bodies)
                self.model.def_releases(name, Rzi=first, Rzj=second)

    def turn(self, member, axis):
        """Turn a member about itself so that its third axis is that of its hinges."""
        _, y, z = np.array(member.T())[:3, :3]
        for sense in (1.0, -1.0):
            member.rotation = sense * np.degrees(np.arctan2(-axis @ y, axis @ z))
            if abs(abs(np.array(member.T())[2, :3] @ axis) - 1.0) < 1e-9:
                return
        raise AssertionError("a hinge along its rod")

    def compliance(self):
        """(6, 6), displacement before rotation."""
        node = self.node(self.own.platform)
        for name in FORCES:
            self.model.add_node_load(node, name, 1.0, case=name)
            self.model.add_load_combo(name, {name: 1.0})
        self.model.analyze_linear(check_stability=False, sparse=False)
        return np.array([[getattr(self.model.nodes[node], move)[force] for force in FORCES] for move in MOVES])


@pytest.mark.filterwarnings("ignore")
def test_the_papers_mechanism_gives_way_as_a_frame_of_pynite():
    record = assur.load("zeng2019")
    own = record.stiffness([-15.4714, 9.6849, 456.3315], shear=False)
    other = Frame(record, own.values).compliance()
    sizes = np.sqrt(np.diag(own.compliance[0]))
    np.testing.assert_allclose(other / sizes / sizes[:, None], own.compliance[0] / sizes / sizes[:, None], atol=1e-4)
