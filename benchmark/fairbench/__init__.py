"""A benchmark of filling holes, fairing regions, removing bumps, joining loops and rounding edges, where the truth is known."""
