#!/usr/bin/env bash
# Writes the site to target/site: the Markdown files of this repository that docs/SUMMARY.md names, with their links as they are.
# Installs mdBook from crates.io into target/mdbook where it is missing, and reads nothing else from the network.
#   site/build.sh          writes and checks; the first page is target/site/index.html
#   site/build.sh PAGE     with the page of live fairing as live/index.html: bindings/web/test.sh makes it as target/web/live.html
set -euo pipefail
page=$([ $# -eq 0 ] || realpath -e "$1")
cd "$(dirname "$0")/.."
version=0.5.4
home=target/mdbook
if [ "$("$home/bin/mdbook" --version 2>/dev/null)" != "mdbook v$version" ]; then
    # Unoptimized: that builds in a minute, and writes this site in a second.
    CARGO_TARGET_DIR=$home/build cargo install mdbook --version $version --locked --debug \
        --no-default-features --features search --root $home --force --quiet
    rm -rf $home/build
fi
rm -rf target/site target/site-source
python3 site/gather.py target/site-source/pages
cp site/book.toml site/fairmesh.css target/site-source/
mkdir target/site-source/theme
cp site/favicon.svg target/site-source/theme/
"$home/bin/mdbook" build target/site-source --dest-dir "$PWD/target/site"
# mdBook would copy its first page there, whose links are those of docs/.
cp site/index.html target/site/index.html
[ -z "$page" ] || install -D -m 644 "$page" target/site/live/index.html
python3 -m unittest discover -q -s site
python3 site/check.py target/site
