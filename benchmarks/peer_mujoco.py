"""MuJoCo on the push-and-sine block, at the settings that serve it best there."""

from __future__ import annotations

import mujoco
import numpy as np
from measure import repeat
from mujoco import rollout
from push_and_sine import DEPTH, FRICTION, GRAVITY, HEIGHT, INTERVAL, MASS, WIDTH, Attempt, error, force

# Found by trying: the contact as stiff as the time step allows (a time constant of two steps), elliptic cones and
# Newton's method to the last bit always; impedance, its ratio and the friction's own time constant are left to choose.
SETTINGS = {
    "impedance 0.9999": {"impedance": 0.9999},
    "impedance 0.99, ratio 100": {"impedance": 0.99, "ratio": 100},
    "impedance 0.99, friction over 4 steps": {"impedance": 0.99, "friction_steps": 4},
    "impedance 0.9": {"impedance": 0.9},
}


def _model(step: float, impedance: float, ratio: float = 1.0, friction_steps: float = 2.0) -> mujoco.MjModel:
    # A motion in the plane needs no more than two slides; a hinge for rotation changes the errors little.
    return mujoco.MjModel.from_xml_string(f"""
        <mujoco>
          <option timestep="{step}" gravity="0 0 {-GRAVITY}" cone="elliptic" impratio="{ratio}" solver="Newton"
                  tolerance="0" iterations="100" ls_tolerance="1e-10"/>
          <worldbody>
            <geom name="base" type="plane" size="50 50 1"/>
            <body pos="0 0 {HEIGHT / 2}">
              <joint type="slide" axis="1 0 0"/>
              <joint type="slide" axis="0 0 1"/>
              <geom name="block" type="box" size="{WIDTH / 2} {DEPTH / 2} {HEIGHT / 2}" mass="{MASS}"/>
            </body>
          </worldbody>
          <contact>
            <pair geom1="base" geom2="block" condim="3" friction="{FRICTION} {FRICTION} 0 0 0"
                  solref="{2 * step} 1" solreffriction="{friction_steps * step} 1"
                  solimp="{impedance} {impedance} 0.001"/>
          </contact>
        </mujoco>""")


def attempts(step: float) -> list[Attempt]:
    """Solve with every setting; the steps run inside MuJoCo, in one call, without Python between them."""
    result = []
    every = round(INTERVAL / step)
    for name, setting in SETTINGS.items():
        model = _model(step, **setting)
        data = mujoco.MjData(model)
        start = np.empty((1, mujoco.mj_stateSize(model, mujoco.mjtState.mjSTATE_FULLPHYSICS)))
        mujoco.mj_getState(model, data, start[0], mujoco.mjtState.mjSTATE_FULLPHYSICS)
        push = np.zeros((1, force(step).size, model.nv))
        push[0, :, 0] = force(step)
        along = int(mujoco.mjtState.mjSTATE_QFRC_APPLIED)

        def solve(model=model, data=data, start=start, push=push, along=along) -> np.ndarray:
            states, _ = rollout.rollout(model, data, start, push, control_spec=along)
            return states

        # The state begins with time, then the positions.
        slip = solve()[0, every - 1 :: every, 1].copy()
        result.append(Attempt("MuJoCo", name, step, error(slip), repeat(solve, 3)))
    return result
