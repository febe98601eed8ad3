"""A dam pushed until its joint fails, against a static program of its own: all unknowns, stiff springs, Newton."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.sparse import block_diag, coo_array
from scipy.sparse.linalg import splu

from heeltoe import flexible, read_case
from heeltoe.models.flexible.body.bond import node_lengths
from heeltoe.models.flexible.body.elastic import dofs
from heeltoe.models.flexible.body.reduced import build_flexible_dam

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
    return read_case(
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
        self.tensile, self.cohesion, opening, shear, _ = bond
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
        for _ in range(60):
            left = 1.0 - self.damage(new)
            envelope = self.tensile * left * np.minimum(np.maximum(gap, 0.0) / np.maximum(new[0], 1e-30), 1.0)
            tension = np.where(gap > 0.0, np.minimum(self.stiffness * gap, envelope), self.stiffness * gap)
            limit = np.maximum(self.cohesion * left - FRICTION * tension, 0.0)
            shear = np.clip(trial, -limit, limit)
            moved = (trial - shear) / self.stiffness
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
