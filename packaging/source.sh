#!/usr/bin/env bash
# Makes the archive of all sources of this commit, for those who build from sources: target/packaging/dist/fairmesh-VERSION-source.tar.gz
# Two runs give the same bytes; those that GitHub makes by itself may change.
set -euo pipefail
. "$(dirname "$0")/tools.sh"
need git git
mkdir -p "$dist"
git -C "$root" archive --format=tar --prefix="fairmesh-$version/" HEAD | gzip -9n >"$dist/fairmesh-$version-source.tar.gz"
echo "$dist/fairmesh-$version-source.tar.gz"
