#!/usr/bin/env bash
# Records the page: a drag over the blend of three cylinders, as docs/live.gif. page/record.sh [FILE]
# Needs the page (page/test.sh makes it), Debian's chromium and python3-venv; Pillow comes from PyPI, into target/web/page.
set -euo pipefail
cd "$(dirname "$0")"
root=$(cd ../../.. && pwd)
file=$(realpath -m "${1-$root/docs/live.gif}")
target=$(cd "${CARGO_TARGET_DIR:-$root/target}" && pwd)
work=$target/web/page
LIMIT=$((1500 * 1000))
command -v chromium >/dev/null || { echo "chromium was not found: apt-get install chromium" >&2; exit 1; }
[ -e "$target/web/live.html" ] || { echo "$target/web/live.html is not there: bindings/web/test.sh" >&2; exit 1; }
[ -x "$work/pillow/bin/python" ] || python3 -m venv "$work/pillow"
"$work/pillow/bin/pip" --disable-pip-version-check install -q pillow==12.0.0
rm -rf "$work/frames" "$work/recorder"
mkdir "$work/frames"
cp -r tests "$work/recorder"
(cd "$work/recorder" && LIVE_PAGE=$target/web/live.html node record.mjs "$work/frames")
"$work/pillow/bin/python" animate.py "$work/frames" "$file"
bytes=$(wc -c <"$file")
echo "$file: $bytes bytes"
[ "$bytes" -lt $LIMIT ] || { echo "more than $LIMIT bytes" >&2; exit 1; }
