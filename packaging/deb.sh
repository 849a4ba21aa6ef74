#!/usr/bin/env bash
# Makes the Debian package of the command line of what build.sh has built for linux-x86_64 or linux-aarch64, into target/packaging/dist.
# Needs dpkg-deb. Two runs give the same bytes.
set -euo pipefail
. "$(dirname "$0")/tools.sh"
target=${1-}
case $target in
linux-x86_64) architecture=amd64 ;;
linux-aarch64) architecture=arm64 ;;
*) fail "usage: packaging/deb.sh linux-x86_64|linux-aarch64" ;;
esac
cd "$root"
need dpkg-deb dpkg
from=$out/stage/$target/fairmesh-cli-$version-$target
[ -x "$from/fairmesh" ] || fail "$from is not there: packaging/build.sh $target"
SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git -C "$root" log -1 --format=%ct 2>/dev/null || echo 1704067200)}
export SOURCE_DATE_EPOCH
tree=$out/stage/$target/deb
share=$tree/usr/share
rm -rf "$tree"
umask 022
install -D "$from/fairmesh" "$tree/usr/bin/fairmesh"
install -D -m 644 "$from/completions/fairmesh.bash" "$share/bash-completion/completions/fairmesh"
install -D -m 644 "$from/completions/_fairmesh" "$share/zsh/vendor-completions/_fairmesh"
install -D -m 644 "$from/completions/fairmesh.fish" "$share/fish/vendor_completions.d/fairmesh.fish"
# Nobody reads mail there: what is to be said is said on the page.
IFS=/ read -r _ _ host owner _ <<<"$repository"
maintainer="fairmesh developers <$owner@users.noreply.$host>"
mkdir -p "$share/man/man1" "$share/doc/fairmesh" "$tree/DEBIAN"
for page in "$from"/man/man1/*; do gzip -9nc "$page" >"$share/man/man1/${page##*/}.gz"; done
{
    echo "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/"
    printf '\nFiles: *\nCopyright: 2025-2026 fairmesh developers\nLicense: MIT or Apache-2.0\n'
    sed 's/^$/./; s/^/ /' LICENSE-MIT
    printf ' .\n Apache-2.0: /usr/share/common-licenses/Apache-2.0\n .\n The licences of the crates in the program: THIRD-PARTY.txt.gz.\n'
} >"$share/doc/fairmesh/copyright"
{
    printf 'fairmesh (%s) unstable; urgency=medium\n\n  * What is new:\n    %s/blob/v%s/CHANGELOG.md\n\n -- %s  ' "$version" "$repository" "$version" "$maintainer"
    LC_ALL=C date -u -R -d "@$SOURCE_DATE_EPOCH"
} | gzip -9n >"$share/doc/fairmesh/changelog.gz"
gzip -9nc "$from/THIRD-PARTY.txt" >"$share/doc/fairmesh/THIRD-PARTY.txt.gz"
cat >"$tree/DEBIAN/control" <<CONTROL
Package: fairmesh
Version: $version
Architecture: $architecture
Maintainer: $maintainer
Installed-Size: $(du -k --apparent-size -s "$tree/usr" | cut -f1)
Depends: libc6 (>= $GLIBC)
Section: graphics
Priority: optional
Homepage: $repository
Description: fill holes, remove bumps, blend and join meshes, exactly smooth
 Closes holes, takes bumps, dents and noise away, and joins tubes: the part of
 a mesh that is chosen gets the smoothest shape that goes on from what is
 around it, and everything else stays as it is.
CONTROL
(cd "$tree" && find usr -type f -print0 | LC_ALL=C sort -z | xargs -0 md5sum >DEBIAN/md5sums)
find "$tree" -exec touch -h -d "@$SOURCE_DATE_EPOCH" {} +
dpkg-deb --root-owner-group -Zxz --build "$tree" "$dist/fairmesh_${version}_$architecture.deb"
