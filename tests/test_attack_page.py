"""The page of what attacks came to: other seeds are added to it."""

from __future__ import annotations

from shared.attack_page import write_page


def test_figures_of_other_seeds_are_added(tmp_path, monkeypatch):
    page = tmp_path / "attack.md"
    for seed, accepted in ((81, 1200), (82, 34)):
        monkeypatch.setattr("shared.attack_page.SEED", seed)
        write_page(page, [("cases", {"accepted": accepted, "defect": 1})], add=seed == 82)
    text = page.read_text()
    assert "| cases | 1,236 | 1,234 | 0 | 0 | 2 |" in text
    assert "| all | 1,236 |" in text
    assert "seeds 81, 82." in text
