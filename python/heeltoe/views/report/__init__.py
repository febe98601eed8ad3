"""Reports: PDF by typst and self-contained HTML, from one content model."""
