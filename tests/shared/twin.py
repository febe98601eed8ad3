"""An independent twin of the rigid kernel: plain small steps after Moreau and Jean, many blocks at once.

It is written from the equations of motion alone. State and forces are those of the reference point,

    q = (y, z, theta),   M = diag(m_y, m_z, J),   f(t) = f_0 + f_h a(t) + f_v a_v(t),

contacts are the heel and toe gaps and the slip, `u = (t.q', n_h.q', n_t.q')` with t = (1, 0, H), n_h = (0, 1, -B_h),
n_t = (0, 1, B_t). One step h advances velocity by impulses and position by the trapezoidal rule:

    M (v2 - v1) = integral of f + n_h p_h + n_t p_t + t p_T,      q2 = q1 + h (v1 + v2) / 2.

A corner takes part if its gap, foreseen half a step ahead, is closed; it then obeys Newton's law of restitution
against the velocity it came with (0 for one that was held). Which corners push, and whether the base sticks or slips,
is found by trying all ten combinations; where the laws leave a choice (static friction above kinetic: a base at rest
may stay or go) sticking comes first. No event is located, no mode is named: slip, rocking, lift-off, impacts and
the end of bouncing all come out of the same step.

Order of accuracy. Forces are linear on every piece of the record and steps never straddle two pieces, so the impulse
of the loads is exact. What remains is where in its step an event falls. A slip that starts from rest or comes to rest
shifts the position by O(h^2). A slip that reverses at once, whose friction jumps, and a corner that strikes, noticed
up to a step late or early, shift the velocity by O(h) and all that follows. So the twin is of second order where blocks
slide and stop, of first order where they bounce.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from heeltoe.base.arrays import Floats

SLIP, HEEL, TOE = 0, 1, 2
#: Which corners push, in the order tried: as few as will do.
SETS = ([HEEL], [TOE], [HEEL, TOE])
#: 0 sticks; +1 and -1 slip downstream and upstream.
FRICTIONS = (0, 1, -1)
CASES = [(pushing, sign) for sign in FRICTIONS for pushing in SETS]
#: Rounding allowed in the inequalities, relative to the velocities and impulses at hand.
ROUNDING = 1e-11


@dataclass(frozen=True)
class Pieces:
    """Ground acceleration [m/s2] of n blocks on k pieces, each linear; where two pieces do not meet it jumps.

    `start` and `end` are (k, 2, n): piece, (downstream, upward), block; `length` (n,) is the length of a piece [s].
    """

    length: Floats
    start: Floats
    end: Floats

    def take(self, which: NDArray[np.intp]) -> Pieces:
        return Pieces(self.length[which], self.start[..., which], self.end[..., which])

    def samples(self, block: int) -> tuple[Floats, Floats, Floats]:
        """Return times and accelerations of one block's record as the kernel reads them; jumps repeat the time."""
        edge = self.length[block] * np.arange(len(self.start) + 1)
        time = np.column_stack((edge[:-1], edge[1:])).ravel()
        both = np.stack((self.start[:, :, block], self.end[:, :, block]), axis=1)
        return time, both[:, :, 0].ravel(), both[:, :, 1].ravel()


class Twin:
    """Blocks given by name, each value an (n,) array: the fields of the kernel's block, in SI units."""

    def __init__(self, block: dict[str, Floats]) -> None:
        one, zero = np.ones_like(block["height"]), np.zeros_like(block["height"])
        self.directions = np.array(
            [
                [one, zero, block["height"]],
                [zero, one, -block["heel_distance"]],
                [zero, one, block["toe_distance"]],
            ]
        )
        self.masses = np.array([block["mass_horizontal"], block["mass_vertical"], block["inertia"]])
        parts = ("horizontal", "vertical", "moment")
        self.load = {
            case: np.array([block[f"{case}_{part}"] for part in parts])
            for case in ("static", "per_horizontal", "per_vertical")
        }
        self.friction_static = block["friction_static"]
        self.friction_kinetic = block["friction_kinetic"]
        self.restitution = block["restitution"]
        # Velocity gained at each contact per unit impulse at each contact.
        self.gain = np.einsum("idn,dn,jdn->ijn", self.directions, 1.0 / self.masses, self.directions)
        self.solvers = np.stack([self._solver(*case) for case in CASES])

    def _solver(self, pushing: list[int], sign: int) -> Floats:
        """Return K with p = -K r: the impulses that bring the wanted rows of the velocity defect r to zero."""
        n = self.gain.shape[-1]
        gain = np.moveaxis(self.gain, -1, 0)
        solver = np.zeros((n, 3, 3))
        if sign == 0:
            rows = [SLIP, *pushing]
            solver[np.ix_(range(n), rows, rows)] = np.linalg.inv(gain[np.ix_(range(n), rows, rows)])
        else:
            pull = -sign * self.friction_kinetic[:, None, None]
            reduced = gain[np.ix_(range(n), pushing, pushing)] + pull * gain[np.ix_(range(n), pushing, [SLIP])]
            # A corner that friction pulls in faster than its push drives it out has no answer in slipping (Painlevé).
            bad = np.linalg.det(reduced) <= 1e-9 * np.linalg.det(gain[np.ix_(range(n), pushing, pushing)])
            reduced[bad] = np.eye(len(pushing))
            inverse = np.linalg.inv(reduced)
            inverse[bad] = np.nan
            solver[np.ix_(range(n), pushing, pushing)] = inverse
            solver[np.ix_(range(n), [SLIP], pushing)] = pull * inverse.sum(axis=1, keepdims=True)
        return np.ascontiguousarray(np.moveaxis(solver, 0, -1))

    def impulses(self, free: Floats, target: Floats, active: NDArray[np.bool_]) -> tuple[Floats, NDArray[np.bool_]]:
        """Return impulses (3, n) that take the contact velocity `free` (3, n) to one that obeys all laws.

        `target` (3, n) is the least velocity each corner must leave with (0 for the slip), `active` (3, n) which
        corners are closed. Also returned: where no combination obeys all laws.
        """
        defect = free - target
        tried = -np.einsum("cijn,jn->cin", self.solvers, defect)
        after = defect + np.einsum("ijn,cjn->cin", self.gain, tried)
        speed = ROUNDING * np.abs(free).max(axis=0)
        push = speed / np.minimum(self.gain[HEEL, HEEL], self.gain[TOE, TOE])
        holds = np.ones((len(CASES), free.shape[1]), dtype=bool)
        for k, (pushing, sign) in enumerate(CASES):
            for corner in (HEEL, TOE):
                if corner in pushing:
                    holds[k] &= active[corner] & (tried[k, corner] >= -push)
                else:
                    holds[k] &= ~active[corner] | (after[k, corner] >= -speed)
            if sign == 0:
                normal = tried[k, HEEL] + tried[k, TOE]
                holds[k] &= np.abs(tried[k, SLIP]) <= self.friction_static * normal + push
            else:
                holds[k] &= sign * after[k, SLIP] >= -speed
        chosen = holds.argmax(axis=0)
        known = holds.any(axis=0)
        impulse = np.take_along_axis(tried, chosen[None, None], axis=0)[0]
        leaves = (~active | (defect >= -speed))[HEEL:].all(axis=0)
        return np.where(known, impulse, 0.0), ~known & ~leaves

    def run(self, ground: Pieces, substeps: int, start: Floats | None = None) -> dict[str, Floats]:
        """Step through the ground motion with `substeps` steps per piece; returns (n,) results by name.

        `start` (2, 3, n) gives slip and gaps and their velocities; without it the blocks stand still in contact.
        """
        if start is None:
            q, v = np.zeros_like(self.masses), np.zeros_like(self.masses)
        else:
            q, v = (np.linalg.solve(np.moveaxis(self.directions, -1, 0), w.T[..., None])[..., 0].T for w in start)
        step = ground.length / substeps
        active = np.zeros(q.shape, dtype=bool)
        closed = ROUNDING * (self.directions[TOE, 2] - self.directions[HEEL, 2])
        lost = np.zeros(q.shape[1])
        seen = self._seen(q)
        low, high = seen, seen
        for start, end in zip(ground.start, ground.end, strict=True):
            for k in range(substeps):
                a = start + (end - start) * ((k + 0.5) / substeps)  # the mean over the step, exactly
                force = self.load["static"] + self.load["per_horizontal"] * a[0] + self.load["per_vertical"] * a[1]
                now = np.einsum("idn,dn->in", self.directions, v)
                foreseen = np.einsum("idn,dn->in", self.directions, q) + 0.5 * step * now
                active[HEEL:] = foreseen[HEEL:] <= closed
                target = -self.restitution * np.minimum(now, 0.0)
                target[SLIP] = 0.0
                after = v + step * force / self.masses
                p, none = self.impulses(np.einsum("idn,dn->in", self.directions, after), target, active)
                after += np.einsum("idn,in->dn", self.directions, p) / self.masses
                q += 0.5 * step * (v + after)
                v = after
                lost += none
                seen = self._seen(q)
                low, high = np.minimum(low, seen), np.maximum(high, seen)
        return {
            "slip": seen[0],
            "slip_min": low[0],
            "slip_max": high[0],
            "rotation": seen[1],
            "rotation_min": low[1],
            "rotation_max": high[1],
            "lost": lost,
        }

    def _seen(self, q: Floats) -> Floats:
        """Slip and rotation."""
        return np.stack((q[0] + self.directions[SLIP, 2] * q[2], q[2]))
