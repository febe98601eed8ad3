"""The fields of a sound case, and what is said to those that are not."""

from heeltoe.case.read import read_case
from heeltoe.errors import InputError

DAM = {
    "section": {
        "height": "100 m",
        "crest_width": "8 m",
        "neck_height": "90 m",
        "neck_width": "8 m",
        "base_width": "80 m",
    },
    "crack": {"friction": 1.0},
    "reservoir": {"depth": "95 m"},
    "motion": {"file": "taft.txt"},
}
PULSE = {"points": [["0 s", "0.8 g"], ["0.1 s", "0.8 g"], ["0.1 s", "0 g"], ["0.4 s", "0 g"]]}


def dam(**changes):
    """Return the fields of a sound case with some blocks changed; a block that is None goes."""
    return {name: value for name, value in (DAM | changes).items() if value is not None}


def polygon(*corners):
    return {"polygon": [[f"{x} m", f"{z} m"] for x, z in corners]}


def write(path, content):
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return path


def refusal(*source):
    """Return the error that the input gives, None where it is accepted."""
    try:
        read_case(*source)
    except InputError as error:
        return error
    return None
