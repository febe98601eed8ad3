"""Run all benchmarks and write their tables to results.md: ``python benchmarks/run.py``."""

from __future__ import annotations

from pathlib import Path

import crack_dam
import crack_peers
import rigid_ensemble
import rigid_peers
import rocking_peers
import spectra_peers

TITLE = "# Measured results\n\nWritten by `python benchmarks/run.py`; what the numbers mean is in the README beside it."


def main() -> None:
    """Run everything before anything is written: a benchmark that fails leaves the old results alone."""
    parts = [
        TITLE,
        rigid_ensemble.report(),
        rigid_peers.report(),
        rocking_peers.report(),
        spectra_peers.report(),
        crack_dam.report(),
        crack_peers.report(),
    ]
    target = Path(__file__).with_name("results.md")
    target.write_text("\n\n".join(parts) + "\n", encoding="utf-8")
    print(f"wrote {target}")


if __name__ == "__main__":
    main()
