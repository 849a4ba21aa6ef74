#!/usr/bin/env bash
# Puts the formula of ports.sh into Homebrew's tap, by a commit, if it is not there yet: packaging/publish_tap.sh
# FAIRMESH_TAP is the address of the tap's repository, by default homebrew-fairmesh beside this one's.
set -euo pipefail
. "$(dirname "$0")/tools.sh"
need git git
tap=${FAIRMESH_TAP:-${repository%/*}/homebrew-fairmesh}
work=$out/tap
ports=$("$root/packaging/ports.sh")
rm -rf "$work"
git clone -q "$tap" "$work"
cd "$work"
mkdir -p Formula
cp "$ports/homebrew/fairmesh.rb" Formula/fairmesh.rb
git add Formula
if git diff --cached --quiet; then
    echo "fairmesh $version is in the tap"
    exit
fi
git commit -q -m "fairmesh $version"
git push -q origin HEAD:main
echo "fairmesh $version"
