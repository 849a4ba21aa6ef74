#!/usr/bin/env python3
"""Runs the first Python program of each page given: first_programs.py PAGE...

They find their files below the current folder.
"""

import re
import sys
from pathlib import Path


def main():
    for page in sys.argv[1:]:
        text = Path(page).read_text(encoding="utf-8")
        program = re.search(r"^```python\n(.*?)^```", text, re.M | re.S).group(1)
        exec(compile(program, page, "exec"), {})


main()
