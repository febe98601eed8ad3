"""Output for people: words, figures, terminal, files, animation, notebook, report."""
