#!/usr/bin/env bash
# Whether this commit is what its tag says, before anything of it is published: packaging/check_tag.sh vX.Y.Z
set -euo pipefail
. "$(dirname "$0")/tools.sh"
tag=${1-}
cd "$root"
[ "$tag" = "v$version" ] || fail "the tag is $tag, and Cargo.toml says $version"
grep -qE "^## \[${version//./\\.}\] - [0-9-]+$" CHANGELOG.md || fail "CHANGELOG.md has no part [$version]: packaging/release.sh makes releases"
! grep -q '^repository = .*\.invalid' Cargo.toml || fail "\`repository\` in Cargo.toml is not the real one"
echo "$tag is a release"
