"""The fields of a sound case, and what is said to those that are not."""

from heeltoe.case.read import read_case
from heeltoe.errors.error import InputError
from shared.dams import TYPICAL_SECTION

DAM = {
    "section": TYPICAL_SECTION,
    "crack": {"friction": 1.0},
    "reservoir": {"depth": "95 m"},
    "motion": {"file": "taft.txt"},
}


def dam(**changes):
    """Return the fields of a sound case with some blocks changed; a block that is None goes."""
    return {name: value for name, value in (DAM | changes).items() if value is not None}


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
