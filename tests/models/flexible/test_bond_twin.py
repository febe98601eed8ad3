"""A dam pushed until its joint fails, and one that is shaken, against a program with all unknowns, stiff springs and
Newton's method."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.sparse import block_diag, coo_array
from scipy.sparse.linalg import splu

from heeltoe import flexible, statics
from heeltoe.models.flexible.body.bond import node_lengths
from heeltoe.models.flexible.body.elastic import dofs
from heeltoe.models.flexible.body.reduced import build_flexible_dam
from heeltoe.models.run import earthquake
from shared.dams import plane_case

G, FRICTION = 9.80665, 1.0
#: Times [s] and pushes [g]: slow at the end, where inertia bears what is pushed too fast.
TIMES, PUSHES = (0.0, 3.0, 11.0), (0.0, 1.35, 1.65)
BOND = {
    "tensile_strength": "0.3 MPa",
    "cohesion": "0.6 MPa",
    "fracture_energy": "300 N/m",
    "shear_energy": "1500 N/m",
}


def pushed_case():
    """Return a dam whose ground goes upstream faster and faster: it is pushed downstream."""
    return plane_case(
        {
            "section": {
                "height": "30 m",
                "crest_width": "5 m",
                "neck_height": "25 m",
                "neck_width": "6 m",
                "base_width": "26 m",
            },
            "concrete": {"modulus": "25 GPa"},
            "crack": {"elevation": "6 m", "friction": FRICTION, "bond": BOND},
            "uplift": {"pattern": "none"},
            "motion": {"points": [[f"{t} s", f"{-push} g"] for t, push in zip(TIMES, PUSHES, strict=True)]},
            "flexible": {"elements_across": 8, "evidence": "none"},
            "analysis": {"silence": "0 s"},
        }
    )


class Joint:
    """Nodes of a joint, each on springs of a stiffness [N/m3] that soften and slip by the law; widest opening, path
    and place of the slip are kept."""

    def __init__(self, lengths, bond, stiffness):
        self.lengths, self.stiffness = lengths, stiffness
        self.tensile, self.cohesion, opening, shear, *_ = bond
        self.reach = 2.0 * opening / self.tensile, 2.0 * shear / self.cohesion
        self.history = np.zeros((3, lengths.size))

    def damage(self, history):
        return np.minimum(np.hypot(history[0] / self.reach[0], history[1] / self.reach[1]), 1.0)

    def bears(self, way, gap):
        """Return shear and tension (2, k) [N], and the history that goes with them."""
        widest, path, slip = self.history
        new = self.history.copy()
        new[0] = np.maximum(widest, np.maximum(gap, 0.0))
        trial = self.stiffness * (way - slip)
        before = None
        for _ in range(60):
            left = 1.0 - self.damage(new)
            envelope = self.tensile * left * np.minimum(np.maximum(gap, 0.0) / np.maximum(new[0], 1e-30), 1.0)
            tension = np.where(gap > 0.0, np.minimum(self.stiffness * gap, envelope), self.stiffness * gap)
            limit = np.maximum(self.cohesion * left - FRICTION * tension, 0.0)
            shear = np.clip(trial, -limit, limit)
            moved = (trial - shear) / self.stiffness
            if before is not None and np.array_equal(before, moved):
                break
            before = moved
            new[1], new[2] = path + np.abs(moved), slip + moved
        return self.lengths * np.array([shear, tension]), new


class Twin:
    """Both parts with all their unknowns, held together by the joint."""

    def __init__(self, case):
        dam = build_flexible_dam(case)
        upper, lower = dam.bodies
        self.size = upper.mesh.nodes.size
        total = self.size + lower.mesh.nodes.size
        free = np.setdiff1d(np.arange(total), self.size + dofs(lower.mesh.fixed))
        self.free = free
        self.stiffness = block_diag([upper.stiffness, lower.stiffness]).tocsr()[free][:, free]
        self.weight = np.concatenate([upper.load, lower.load])[free]
        pushed = np.tile([1.0, 0.0], total // 2)
        self.push = (block_diag([upper.mass, lower.mass]) @ pushed)[free]
        place = np.full(total, -1)
        place[free] = np.arange(free.size)
        self.above, self.below = place[dofs(upper.mesh.crack)], place[self.size + dofs(lower.mesh.crack)]
        along = upper.mesh.nodes[upper.mesh.crack, 0]
        self.joint = Joint(node_lengths(along - along[0]), dam.lines[0].bond, 1e3 * 25e9)
        self.moved = np.zeros(free.size)

    def apart(self, moved):
        return (moved[self.above] - moved[self.below]).reshape(-1, 2).T

    def equilibrium(self, load):
        """Move to the equilibrium under the weight and so many g; whether there is one near."""
        moved = self.moved.copy()
        outer = self.weight + load * G * self.push
        for _ in range(60):
            apart = self.apart(moved)
            forces, history = self.joint.bears(*apart)
            inner = np.zeros(moved.size)
            np.add.at(inner, self.above, forces.T.reshape(-1))
            np.add.at(inner, self.below, -forces.T.reshape(-1))
            missing = outer - inner - self.stiffness @ moved
            if np.abs(missing).max() < 1e-7 * np.abs(self.weight).sum():
                self.moved, self.joint.history = moved, history
                return True
            moved = moved + splu((self.stiffness + self.tangent(apart, forces)).tocsc()).solve(missing)
            if not np.abs(moved).max() < 0.1:
                return False
        return False

    def tangent(self, apart, forces):
        rows, columns, values = [], [], []
        for axis in (0, 1):
            little = np.zeros_like(apart)
            little[axis] = 1e-11
            slopes = (self.joint.bears(*(apart + little))[0] - forces) / 1e-11
            for other in (0, 1):
                for left, sign in ((self.above, 1.0), (self.below, -1.0)):
                    for right, way in ((self.above, 1.0), (self.below, -1.0)):
                        rows.append(left[other::2])
                        columns.append(right[axis::2])
                        values.append(sign * way * slopes[other])
        joined = (np.concatenate(rows), np.concatenate(columns))
        return coo_array((np.concatenate(values), joined), shape=self.stiffness.shape)

    def cracked(self):
        return float(self.joint.lengths[self.joint.damage(self.joint.history) >= 1.0].sum())


@pytest.mark.slow
def test_a_push_until_the_joint_fails_is_that_of_a_static_program():
    case = pushed_case()
    twin = Twin(case)
    assert twin.equilibrium(0.0)
    load, step = 0.0, 0.1
    while step > 2e-3:
        kept = twin.moved, twin.joint.history
        if twin.equilibrium(load + step):
            load += step
        else:
            (twin.moved, twin.joint.history), step = kept, step / 2.0
    assert load > 1.2
    assert twin.cracked() == 0.0
    bond = flexible(case).joint
    # Beyond the last equilibrium the joint breaks in one go.
    for moment in (bond.first_cracking_s, bond.cracked_through_s):
        assert np.interp(moment, TIMES, PUSHES) == pytest.approx(load, rel=0.02)


class ShakenTwin(Twin):
    """The same shaken: Newmark's method, all unknowns, the joint solved by itself through what it feels of the rest."""

    def __init__(self, case):
        super().__init__(case)
        # So stiff that the joint gives next to nothing, and no stiffer: blows are solved sooner.
        self.joint.stiffness = 10.0 * 25e9
        masses = block_diag([body.mass for body in build_flexible_dam(case).bodies])
        self.mass = masses.tocsr()[self.free][:, self.free]

    def run(self, ground, dt, damping, gamma=0.6):
        """Return which nodes are broken (n, k) after each step under accelerations of the ground [m/s2].

        `damping` is by the stiffness [s]; a little more than one half for `gamma` takes what stiff springs leave of
        blows."""
        assert self.equilibrium(0.0)
        beta, rubs = (gamma + 0.5) ** 2 / 4.0, damping * self.stiffness
        whole = self.mass / (beta * dt**2) + gamma / (beta * dt) * rubs + self.stiffness
        solve = splu(whole.tocsc()).solve
        count = self.above.size // 2
        gaps = np.zeros((2 * count, self.moved.size))
        for axis in (0, 1):
            rows = axis * count + np.arange(count)
            gaps[rows, self.above[axis::2]], gaps[rows, self.below[axis::2]] = 1.0, -1.0
        answers = solve(gaps.T.copy())
        felt = gaps @ answers
        moved, speed, pull = self.moved.copy(), np.zeros(self.moved.size), np.zeros(self.moved.size)
        broken = np.zeros((ground.size, count), dtype=bool)
        for step, acceleration in enumerate(ground):
            known = moved / (beta * dt**2) + speed / (beta * dt) + (0.5 / beta - 1.0) * pull
            rubbed = gamma / (beta * dt) * moved + (gamma / beta - 1.0) * speed + dt * (0.5 * gamma / beta - 1.0) * pull
            outer = self.weight - acceleration * self.push + self.mass @ known + rubs @ rubbed
            alone = solve(outer)
            forces, self.joint.history = self.meet(gaps @ alone, gaps @ moved, felt)
            after = alone - answers @ forces
            change = (after - moved) / (beta * dt**2) - speed / (beta * dt) - (0.5 / beta - 1.0) * pull
            speed = speed + dt * ((1.0 - gamma) * pull + gamma * change)
            moved, pull = after, change
            broken[step] = self.joint.damage(self.joint.history) >= 1.0
        return broken

    def meet(self, alone, start, felt):
        """Return the forces of the joint (2 k,) whose gaps would be `alone` without them, and its history, by Newton's
        method from gaps at the `start`."""
        apart, count = start, start.size // 2

        def state(gaps):
            forces, history = self.joint.bears(*gaps.reshape(2, count))
            return forces.reshape(-1), history, gaps - alone + felt @ forces.reshape(-1)

        forces, history, missing = state(apart)
        for _ in range(300):
            if np.abs(missing).max() < 1e-11:
                return forces, history
            slopes = np.zeros((2 * count, 2 * count))
            for axis in (0, 1):
                little = apart.copy()
                little[axis * count : (axis + 1) * count] += 1e-10
                way = (state(little)[0] - forces) / 1e-10
                for other in (0, 1):
                    rows = other * count + np.arange(count)
                    slopes[rows, axis * count + np.arange(count)] = way[rows]
            change = np.linalg.solve(np.eye(2 * count) + felt @ slopes, missing)
            # The law has corners: a shorter way where the whole one misses more, at worst a tenth of it.
            for share in (1.0, 0.5, 0.25, 0.1):
                tried = state(apart - share * change)
                if np.linalg.norm(tried[2]) < np.linalg.norm(missing):
                    break
            apart = apart - share * change
            forces, history, missing = tried
        raise AssertionError("the joint of the twin finds no state")


def shaken_case():
    """Return a dam whose joint cracks for a third of its length in ten seconds of a record."""
    pushed = pushed_case()
    return pushed.with_(
        {
            "crack.bond": BOND | {"tensile_strength": "0.2 MPa"},
            "reservoir": {"depth": "26 m", "compressible": False},
            "motion": {"file": "elcentro-1940-180-nga", "pga": "0.6 g", "duration": "10 s", "sign": "recorded"},
            "flexible.elements_across": 6,
            "flexible.damping": "stiffness",
        }
    )


@pytest.mark.slow
def test_ten_seconds_of_a_record_crack_the_joint_of_a_program_with_all_unknowns():
    case = shaken_case()
    response = flexible(case)
    shaking, twin, dt = earthquake(case).shaking, ShakenTwin(case), 2e-4
    moments = dt * np.arange(1, round(10.0 / dt) + 1)
    broken = twin.run(np.interp(moments, shaking.time, shaking.horizontal), dt, response.rayleigh_stiffness_s)
    first = moments[np.flatnonzero(broken.any(axis=1))[0]]
    assert response.joint.first_cracking_s == pytest.approx(first, abs=0.01)
    length = float(twin.joint.lengths[broken[-1]].sum())
    assert 0.0 < length < response.crack_width_m
    assert response.joint.cracked_length_m == pytest.approx(length, rel=0.05)


#: Depth of the water [m], where the elastic dam is open up to, and the crack of the beam of ``heeltoe statics`` [m].
RISING = ((36.0, 3.5, 1.72), (38.0, 6.1, 4.52), (40.0, 8.4, 7.32))


def rising_case(depth, across):
    """Return a dam whose joint bears no tension to speak of, with water up to above its crest."""
    bond = {"tensile_strength": "1 Pa", "cohesion": "1 Pa", "fracture_energy": "1e5 N/m", "shear_energy": "1e5 N/m"}
    return pushed_case().with_(
        {
            "section.base_width": "22 m",
            "crack.bond": bond,
            "reservoir": {"depth": f"{depth} m", "compressible": False},
            "motion": {"points": [["0 s", "0 g"], ["0.01 s", "0.0001 g"], ["0.02 s", "0 g"]]},
            "flexible.elements_across": across,
        }
    )


def open_at_rest(case):
    """Return the opening at the heel [m], and the nodes [m] between which the joint begins to press."""
    dam = build_flexible_dam(case)
    along = dam.bodies[0].mesh.nodes[dam.bodies[0].mesh.crack, 0]
    pressing = np.flatnonzero(dam.crack_forces[0][1] > 1e-6 * dam.crack_forces[0][1].max())[0]
    return flexible(case).histories["gap_heel_m"][0], tuple(along[pressing - 1 : pressing + 1] - along[0])


def open_of_twin(case):
    """Return the same of the program with all unknowns."""
    twin = Twin(case)
    assert twin.equilibrium(0.0)
    gaps = twin.apart(twin.moved)[1]
    tension = twin.joint.bears(*twin.apart(twin.moved))[0][1]
    mesh = build_flexible_dam(case).bodies[0].mesh
    along = mesh.nodes[mesh.crack, 0] - mesh.nodes[mesh.crack[0], 0]
    pressing = np.flatnonzero(-tension > 1e-6 * np.abs(tension).max())[0]
    return gaps[0], tuple(along[pressing - 1 : pressing + 1])


@pytest.mark.parametrize(("depth", "opens", "beam"), RISING)
def test_rising_water_opens_the_heel_as_in_a_static_program_and_farther_than_a_beam_cracks(depth, opens, beam):
    case = rising_case(depth, 16)
    heel, tip = open_at_rest(case)
    twin_heel, twin_tip = open_of_twin(case)
    assert heel == pytest.approx(twin_heel, rel=0.01)
    assert tip == pytest.approx(twin_tip)
    assert tip[0] < opens < tip[1]
    # The stress at the heel is higher than that of a beam, whose sections stay plane.
    (usual,) = (item for item in statics(case).cases if item.name == "usual")
    assert (usual.cracked_from, usual.cracked_length_m) == ("heel", pytest.approx(beam, abs=0.01))
    assert 0.8 < opens - beam < 2.1


@pytest.mark.slow
def test_rising_water_opens_the_heel_as_on_half_the_mesh_of_a_static_program():
    heel, tip = open_at_rest(rising_case(38.0, 16))
    twin_heel, twin_tip = open_of_twin(rising_case(38.0, 32))
    assert heel == pytest.approx(twin_heel, rel=0.01)
    assert sum(tip) / 2.0 == pytest.approx(sum(twin_tip) / 2.0, abs=0.01 * 22.7)
