"""The paper's figures, table and claims, accuracy, times and curvature continuity, measured with the program."""
