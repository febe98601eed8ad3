"""What people see: words, figures, terminal, files, animation, notebook, report."""
