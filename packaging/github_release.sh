#!/usr/bin/env bash
# Makes the release on GitHub of a tag, with its part of CHANGELOG.md and all of target/packaging/dist: packaging/github_release.sh vX.Y.Z
# Needs gh, and GH_TOKEN.
set -euo pipefail
. "$(dirname "$0")/tools.sh"
tag=${1-}
cd "$root"
packaging/check_tag.sh "$tag"
need gh gh
(cd "$dist" && awk '!/^#/ { print $1 "  " $3 }' MANIFEST | sha256sum --quiet -c) || fail "files of target/packaging/dist are not those of MANIFEST"
awk -v heading="## [$version]" '/^## / { inside = index($0, heading) == 1; next } inside' CHANGELOG.md >"$out/notes.md"
[ -s "$out/notes.md" ] || fail "CHANGELOG.md says nothing of $version"
gh release create "$tag" --verify-tag --title "fairmesh $version" --notes-file "$out/notes.md" "$dist"/*
