#!/usr/bin/env bash
# Makes the release on GitHub of a tag, with its part of CHANGELOG.md and all of target/packaging/dist: packaging/publish_github.sh vX.Y.Z
# It is a draft until all files are there. Run again after a failure it goes on with those that are missing. Needs gh, and GH_TOKEN.
set -euo pipefail
. "$(dirname "$0")/tools.sh"
tag=${1-}
cd "$root"
packaging/check_tag.sh "$tag"
need gh gh
(cd "$dist" && awk '!/^#/ { print $1 "  " $3 }' MANIFEST | sha256sum --quiet -c) || fail "files of target/packaging/dist are not those of MANIFEST"
awk -v heading="## [$version]" '/^## / { inside = index($0, heading) == 1; next } inside' CHANGELOG.md >"$out/notes.md"
[ -s "$out/notes.md" ] || fail "CHANGELOG.md says nothing of $version"
# Also one that is a draft.
gh release view "$tag" >/dev/null 2>&1 ||
    gh release create "$tag" --draft --verify-tag --title "fairmesh $version" --notes-file "$out/notes.md"
# A file whose upload was broken off has another size, and is replaced.
there=$(gh release view "$tag" --json assets --jq '.assets[] | select(.state == "uploaded") | "\(.size) \(.name)"')
for file in "$dist"/*; do
    name=${file##*/}
    if grep -qxF "$(wc -c <"$file") $name" <<<"$there"; then
        echo "$name is there"
    else
        gh release upload "$tag" "$file" --clobber
        echo "$name"
    fi
done
gh release edit "$tag" --draft=false
