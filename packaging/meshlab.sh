#!/usr/bin/env bash
# Makes the MeshLab plugins for Linux x86_64, one archive for each program in meshlab_plugin/hosts.sh, of the static library that
# build.sh has built for linux-x86_64, into target/packaging/dist.
#   packaging/meshlab.sh [HOST...]
# They are compiled in a Debian 11 under target/packaging, which needs root and debootstrap: its glibc is 2.31, that of the oldest of the programs.
# Two runs give the same bytes.
set -euo pipefail
. "$(dirname "$0")/tools.sh"
cd "$root"
. meshlab_plugin/hosts.sh
. meshlab_plugin/fetch.sh
read -ra hosts <<<"${*:-$HOSTS}"
target=linux-x86_64
tree=$out/stage/$target/fairmesh-$version-$target
work=$out/meshlab
chroot=$out/debian-11
SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct 2>/dev/null || echo 1704067200)}
export SOURCE_DATE_EPOCH

install_debian() {
    need debootstrap debootstrap
    need unshare util-linux
    if [ ! -e "$chroot/complete" ]; then
        rm -rf --one-file-system "$chroot"
        debootstrap --variant=minbase --include=meshlab,cmake,g++,make,qtbase5-dev,libqt5opengl5-dev,libglew-dev,libglu1-mesa-dev,libeigen3-dev \
            bullseye "$chroot" http://deb.debian.org/debian >"$out/debian-11.log" || fail "see $out/debian-11.log"
        touch "$chroot/complete"
    fi
    mkdir -p "$chroot/build/meshlab_plugin" "$chroot/build/target/meshlab" "$chroot/build/fairmesh"
}

# in_debian COMMAND...: with the plugin's sources, the library and the results below /build, so that no other path is seen.
in_debian() {
    # shellcheck disable=SC2016
    unshare -m sh -c 'mount --bind "$2/meshlab_plugin" "$1/build/meshlab_plugin" && mount --bind "$3" "$1/build/target/meshlab" &&
        mount --bind "$4" "$1/build/fairmesh" && mount -t proc proc "$1/proc" && here=$1 && shift 4 &&
        exec chroot "$here" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 FAIRMESH_TREE=/build/fairmesh "$@"' \
        sh "$chroot" "$root" "$work" "$tree" "$@"
}

# The program's own library: Debian's is in the chroot, PyMeshLab's in its wheel.
library_of() {
    library=/usr/lib/x86_64-linux-gnu/meshlab/libmeshlab-common.so
    [ -n "$pypi" ] || return 0
    local folder=$work/wheels/$label
    library=/build/target/meshlab/wheels/$label/pymeshlab/lib/libmeshlab-common.so
    [ "$(cat "$folder/fetched" 2>/dev/null)" != "$pypi" ] || return 0
    rm -rf "$folder"
    python3 -m pip --disable-pip-version-check install -q --no-deps --no-compile --only-binary=:all: --python-version 3.11 \
        --platform manylinux_2_35_x86_64 --platform manylinux_2_31_x86_64 --target "$folder" "$pypi"
    echo "$pypi" >"$folder/fetched"
}

# The page in the archive.
read_me() {
    cat <<TEXT
# fairmesh $version in $program

Five filters, whose names begin with Fairmesh, in the menu
*Filters, Smoothing, Fairing and Deformation*. For Linux x86_64 with glibc 2.31 or newer, and for no other program: a plugin fits one version of MeshLab,
with one kind of numbers.

$install

The folder \`scripts\` has a script of MeshLab 2020.09 for each filter, with all its parameters. meshlab_plugin/README.md in the sources of fairmesh says what the
parameters and the results are.

## Licence

The plugin contains code of MeshLab and vcglib, and so is under the GNU General Public License, version 3 (\`COPYING\`). What fairmesh itself adds is under
MIT or Apache 2.0 (\`LICENSE-MIT\`, \`LICENSE-APACHE\`), and the crates in it under what \`THIRD-PARTY.txt\` says. The sources are those of fairmesh
$version, commit $(git rev-parse HEAD 2>/dev/null || echo unknown), and of Debian's $tarball
(SHA-256 $sha256).
TEXT
}

# How it gets into the program: sets $program and $install.
installing() {
    if [ -z "$pypi" ]; then
        program="MeshLab 2020.09 of Debian 11 and 12 and Ubuntu 22.04"
        install='    sudo cp libfilter_fairmesh.so /usr/lib/x86_64-linux-gnu/meshlab/plugins/

To uninstall, remove the file there. A script runs without a screen by

    xvfb-run meshlabserver -i scan.ply -s scripts/close_holes.mlx -o closed.ply'
        return
    fi
    program="PyMeshLab ${pypi#*==}"
    install="    pip install $pypi

    import pymeshlab
    pymeshlab.load_plugin(\"/path/to/libfilter_fairmesh.so\")    # an absolute path
    ms = pymeshlab.MeshSet()
    ms.load_new_mesh(\"scan.ply\")
    ms.apply_filter(\"meshing_close_holes_and_fair\")

The other filters are \`apply_coord_fairing_to_selection\`, \`meshing_erase_and_fill_selection\`, \`meshing_bridge_boundaries\` and
\`compute_scalar_by_smooth_mean_curvature_per_vertex\`."
}

# plugin HOST
plugin() {
    host=$1
    local name folder
    host "$host" || fail "no such host: $host; there are $HOSTS"
    fetch_sources
    unpack_sources
    library_of
    in_debian MESHLAB_RELEASE="$release" /build/meshlab_plugin/build.sh other "$host" "/build/target/meshlab/${source#"$work/"}" "$library" >&2
    name=fairmesh_meshlab-$version-$label-linux-x86_64
    folder=$work/stage/$name
    rm -rf "$folder"
    mkdir -p "$folder/scripts"
    install -m 755 "$work/$host/libfilter_fairmesh.so" "$folder"
    cp "$work/$host/COPYING" LICENSE-MIT LICENSE-APACHE "$tree/share/doc/fairmesh/THIRD-PARTY.txt" "$folder"
    cp meshlab_plugin/scripts/*.mlx "$folder/scripts"
    installing
    read_me >"$folder/README.md"
    # 4 % smaller than by gzip.
    python3 packaging/archive.py "$folder" "$work/$name.tar" >&2
    zopfli --i5 -c "$work/$name.tar" >"$dist/$name.tar.gz"
    echo "$dist/$name.tar.gz"
}

[ "$(id -u)" -eq 0 ] || fail "packaging/meshlab.sh changes into another Debian, which root alone may do"
[ -e "$tree/lib/libfairmesh.a" ] || fail "$tree is not there: packaging/build.sh $target"
need curl curl
need xz xz-utils
need zopfli zopfli
need git git
mkdir -p "$work"
install_debian
for host in "${hosts[@]}"; do plugin "$host"; done
