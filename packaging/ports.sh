#!/usr/bin/env bash
# Fills in the ports for conda and Homebrew in packaging/ports: version, addresses, and hashes of the archives that MANIFEST
# lists, into target/packaging/ports.
#   packaging/ports.sh [URL]    where the archives are; without it in the release of this version
set -euo pipefail
. "$(dirname "$0")/tools.sh"
url=${1:-$repository/releases/download/v$version}
ports=$out/ports

# hash KIND NAME: of an archive, which has to be the one in MANIFEST. cli: begins the names of the command line's.
hash_of() {
    local file=fairmesh-$version-$2 listed
    [[ $2 != cli:* ]] || file=fairmesh-cli-$version-${2#cli:}
    listed=$(awk -v file="$file" '$3 == file { print $1 }' "$dist/MANIFEST")
    [ -n "$listed" ] || fail "MANIFEST has no $file: packaging/manifest.sh"
    [ "$(sha256sum "$dist/$file" | cut -d' ' -f1)" = "$listed" ] || fail "$file is not the one of MANIFEST: packaging/manifest.sh --list"
    "${1,,}sum" "$dist/$file" | cut -d' ' -f1
}

[ -e "$dist/MANIFEST" ] || fail "$dist/MANIFEST is not there: packaging/manifest.sh"
rm -rf "$ports"
mkdir -p "$ports"
cp -r "$root/packaging/ports/." "$ports"
mapfile -t files < <(find "$ports" -type f)
sed -i -e "s|@VERSION@|$version|g" -e "s|@REPOSITORY@|$repository|g" -e "s|@URL@|$url|g" "${files[@]}"
mapfile -t places < <(grep -ohE '@SHA(256|512):[a-z0-9_:.-]+@' "${files[@]}" | sort -u)
[ ${#places[@]} -gt 5 ] || fail "the ports have no places for hashes any more"
for place in "${places[@]}"; do
    IFS=@: read -r _ kind name <<<"${place%@}"
    hash=$(hash_of "$kind" "$name")
    sed -i "s|$place|$hash|g" "${files[@]}"
done
if grep -rnE '@[A-Z0-9]+[:@]' "$ports"; then fail "something was not filled in"; fi
echo "$ports"
