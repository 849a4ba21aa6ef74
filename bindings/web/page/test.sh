#!/usr/bin/env bash
# Tests the page of live fairing: makes it of a folder with the npm package, and uses it in a browser as people do, from disk.
#   page/test.sh PACKAGE [chrome|firefox]
# The page is target/web/live.html afterwards. Needs Debian's chromium, or firefox-esr with xvfb and xauth: without a screen it draws nothing.
set -euo pipefail
package=$(realpath "$1")
browser=${2-chrome}
cd "$(dirname "$0")"
root=$(cd ../../.. && pwd)
mkdir -p "${CARGO_TARGET_DIR:-$root/target}/web/page"
target=$(cd "${CARGO_TARGET_DIR:-$root/target}" && pwd)
# Gzipped, with the npm package.
LIMIT=$((3 * 1000 * 1000))

need() { command -v "$1" >/dev/null || { echo "$1 was not found: apt-get install $2" >&2; exit 1; }; }

need node nodejs
if [ "$browser" = chrome ]; then need chromium chromium; else need firefox-esr firefox-esr && need xvfb-run "xvfb xauth libgl1-mesa-dri"; fi
page=$target/web/live.html
./build.sh "$package" "$page"
archive=$(cd "$target/web/page" && npm pack --silent --pack-destination "$target/web/page" "$package")
bytes=$(($(gzip -9c "$page" | wc -c) + $(wc -c <"$target/web/page/$archive")))
rm "$target/web/page/$archive"
echo "page: $(gzip -9c "$page" | wc -c) bytes gzipped, with the npm package $bytes"
[ $bytes -lt $LIMIT ] || { echo "more than $LIMIT bytes" >&2; exit 1; }
if grep -aqF -e "$root" -e "$HOME/" "$page"; then echo "a path of this machine is in the page" >&2; exit 1; fi

tests=$target/web/page/tests
rm -rf "$tests"
cp -r tests "$tests"
cd "$tests"
export LIVE_PAGE=$page LIVE_PACKAGE=$package LIVE_PROGRAM=$target/release/fairmesh
case $browser in
chrome) rm firefox.test.mjs && node --test --test-concurrency=1 ./*.test.mjs ;;
firefox) LIBGL_ALWAYS_SOFTWARE=1 xvfb-run -a -s "-screen 0 1400x1000x24" node --test firefox.test.mjs ;;
*) echo "page/test.sh PACKAGE [chrome|firefox]" >&2 && exit 1 ;;
esac
