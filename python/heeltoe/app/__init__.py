"""The browser app: a page on this machine, whose numbers and plots follow its sliders."""
