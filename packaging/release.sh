#!/usr/bin/env bash
# Makes a release of what is committed: one commit that sets the version and dates the changelog, and a tag. It pushes nothing.
#   packaging/release.sh [--dry-run] VERSION
# With --dry-run everything is done and looked at, and then taken back. What is refused leaves everything as it was.
set -euo pipefail
cd "$(dirname "$0")/.."

refuse() {
    echo "no release: $*" >&2
    exit 1
}

# has PATTERN: whether a line of the newest part of the changelog is like this. It is read to its end: who stops before ends what writes it.
has() { sed -n '/^## \[Unreleased\]$/,/^## \[[0-9]/p' CHANGELOG.md | grep -v '^## ' | grep "$1" >/dev/null; }

# is_after A B: in the order of versions.
is_after() { [ "$1" != "$2" ] && [ "$(printf '%s\n' "$1" "$2" | sort -V | tail -1)" = "$1" ]; }

check_request() {
    local stated
    [ -z "$(git status --porcelain)" ] || refuse "the tree has changes that are not committed"
    ! git rev-parse -q --verify "refs/tags/v$version" >/dev/null || refuse "there is a tag v$version"
    stated=$(sed -n 's/^version = "\(.*\)"/\1/p' Cargo.toml | head -1)
    [ "$stated" = "$version" ] || is_after "$version" "$stated" || refuse "$version is older than $stated, which Cargo.toml states"
    [ -z "$last" ] || is_after "$version" "$last" || refuse "$version is not newer than $last, the last release"
}

check_changelog() {
    grep -qx '## \[Unreleased\]' CHANGELOG.md || refuse "CHANGELOG.md has no part [Unreleased]"
    has '^- ' || refuse "[Unreleased] of CHANGELOG.md is empty"
    has '^ABI: .' || refuse "[Unreleased] of CHANGELOG.md has no line \"ABI: ...\""
}

# What registries show for ever.
check_address() {
    if grep -q '^repository = .*\.invalid' Cargo.toml; then
        [ "$dry" = yes ] || refuse "\`repository\` in Cargo.toml is not the real one (docs/releasing.md)"
        echo "a release would be refused: \`repository\` in Cargo.toml is not the real one" >&2
    fi
}

write() {
    local day
    day=$(date -u +%F)
    packaging/set_version.sh "$version" >/dev/null
    sed -i "s/^## \[Unreleased\]$/&\n\n## [$version] - $day/" CHANGELOG.md
    sed -i '/^date-released: /d' CITATION.cff
    sed -i "s/^version: .*/&\ndate-released: $day/" CITATION.cff
}

sign() {
    if git config user.signingkey >/dev/null; then echo -s; else echo -a; fi
}

# Whatever ends this before the commit: nothing has happened.
take_back() { git reset -q --hard "$before"; }

dry=no
if [ "${1-}" = --dry-run ]; then
    dry=yes
    shift
fi
version=${1-}
[ $# -eq 1 ] && [[ $version =~ ^[0-9]+\.[0-9]+\.[0-9]+$ ]] || {
    sed -n '3p' "$0" >&2
    exit 2
}
last=$(sed -n 's/^## \[\([0-9.]*\)\].*/\1/p' CHANGELOG.md | sort -V | tail -1)
check_request
check_changelog
check_address
before=$(git rev-parse HEAD)
trap take_back EXIT
write
packaging/check_interface.sh "${last:+v$last}" || refuse "the C interface does not agree"
git add -u
if [ "$dry" = yes ]; then
    git diff --cached --stat
    echo "$version can be released; nothing was changed"
    exit
fi
git commit -q --allow-empty -m "Release $version"
trap - EXIT
git tag "$(sign)" -m "fairmesh $version" "v$version"
echo "v$version is there: git push --atomic origin HEAD v$version"
