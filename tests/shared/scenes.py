"""What a page of an animation holds, taken out of it again."""

from __future__ import annotations

import base64
import json
import re

import numpy as np

from shared.dams import COARSE, ENDS

SMALL = [*COARSE, "motion.duration=1s", ENDS]


def page_scene(path):
    text = path.read_text(encoding="utf-8")
    return json.loads(re.search(r'<script type="application/json" id="scene">(.*?)</script>', text, re.S)[1])


def unpacked(field):
    plain = np.frombuffer(base64.b64decode(field["data"]), dtype=np.dtype(field["kind"]).newbyteorder("<"))
    return plain.reshape(field["shape"])
