# SPDX-License-Identifier: MIT OR Apache-2.0
# shellcheck shell=bash disable=SC2154
# Sourced by build.sh and packaging/meshlab.sh: MeshLab's sources of a host of hosts.sh, for their headers. Goes to $work; needs `fail`.

# fetch_sources: from the first place that has the file, and checks what came.
fetch_sources() {
    local file=$work/downloads/$tarball url
    mkdir -p "$work/downloads"
    if [ -e "$file" ] && sha256sum --quiet --status -c <<<"$sha256  $file"; then return; fi
    for url in "https://deb.debian.org/debian/pool/main/m/meshlab/$tarball" "https://snapshot.debian.org/file/$sha1"; do
        if curl -fsSL --retry 2 --max-time 300 -o "$file.part" "$url" && sha256sum --status -c <<<"$sha256  $file.part"; then
            mv "$file.part" "$file"
            return
        fi
        printf 'not there, or not the same file: %s\n' "$url" >&2
    done
    fail "the sources of $host cannot be had. Put $tarball (SHA-256 $sha256) into $work/downloads, or pin another release in hosts.sh."
}

# unpack_sources: $source gets the headers.
unpack_sources() {
    source=$work/sources/${tarball%.orig.tar.xz}
    if [ -e "$source/ML_VERSION" ]; then return; fi
    rm -rf "$source"
    mkdir -p "$source"
    tar -xf "$work/downloads/$tarball" -C "$source" --strip-components=1 ||
        fail "$tarball cannot be unpacked (apt-get install xz-utils)"
}
