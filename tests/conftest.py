"""What all tests share."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
_BESIDE = ROOT.parent / "shared" / "records"
if "HEELTOE_RECORDS" not in os.environ and _BESIDE.is_dir():
    os.environ["HEELTOE_RECORDS"] = str(_BESIDE)


@pytest.fixture(scope="session")
def records() -> Path:
    """Directory of strong-motion records, which are not part of the project."""
    if not os.environ.get("HEELTOE_RECORDS"):
        pytest.skip("no strong-motion records here; set HEELTOE_RECORDS")
    return Path(os.environ["HEELTOE_RECORDS"])
