"""The reference cases by name."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from heeltoe.errors import InputError
from heeltoe.validation import (
    closed_forms,
    elastic_bar,
    evidence,
    flexible_blocks,
    flexible_dams,
    koyna,
    penalty,
    random_blocks,
    random_dams,
    textbook_walls,
    textbooks,
    thesis_blocks,
    thesis_dams,
    turning,
)
from heeltoe.validation.row import Row

CASES: dict[str, Callable[[], Iterable[Row]]] = {
    "impulse": thesis_blocks.impulse,
    "sine": thesis_blocks.sine,
    "push-and-sine": closed_forms.push_and_sine,
    "pulse": closed_forms.pulse,
    "free-rocking": closed_forms.free_rocking,
    "finite-rocking": turning.free_finite_rocking,
    "overturning": turning.overturning_pulses,
    "drifting": thesis_blocks.drifting,
    "dry-block": thesis_blocks.dry_block,
    "triangular": thesis_dams.triangular,
    "table-7.6-taft": thesis_dams.taft,
    "table-7.6-el-centro": thesis_dams.el_centro,
    "bouncing-bar": elastic_bar.bouncing_bar,
    "elastic-impulse": flexible_blocks.elastic_impulse,
    "elastic-sliding": flexible_blocks.elastic_sliding,
    "elastic-rocking": flexible_blocks.elastic_rocking,
    "contactors": flexible_blocks.contactors,
    "random-blocks": random_blocks.random_blocks,
    "random-dams": random_dams.random_dams,
    "koyna-chain": koyna.koyna_chain,
    "periods": flexible_dams.periods,
    "table-7.1": flexible_dams.table_7_1,
    "table-7.7": flexible_dams.table_7_7,
    "table-7.8": flexible_dams.table_7_8,
    "table-7.10": flexible_dams.table_7_10,
    "halving": flexible_dams.halving,
    "evidence": evidence.evidence,
    "penalty": penalty.penalty,
    "punmia-walls": textbooks.punmia_walls,
    "punmia-dams": textbooks.punmia_dams,
    "zangar": textbooks.zangar_pressure,
    "elementary": textbooks.elementary,
    "sarkar": textbook_walls.sarkar,
}


def run_case(name: str) -> list[Row]:
    """Return the rows of one case.

    Raises
    ------
    InputError
        Where there is no case of that name.
    Skipped
        Where a record it needs is not there.
    """
    if name not in CASES:
        raise InputError("no-such-validation", "NAME", name, names=", ".join(CASES))
    return list(CASES[name]())
