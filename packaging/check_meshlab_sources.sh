#!/usr/bin/env bash
# Checks that the MeshLab plugin is compiled on systems for which no plugin is published: as an extra plugin by MeshLab's own function, here on Linux with
# the library of PyMeshLab, in which it is then run; and its sources by compilers for Windows and macOS, with Debian's headers of Qt, as far as that goes
# without MeshLab there. Nothing is linked or run for those.
#   packaging/check_meshlab_sources.sh
# Needs packaging/build.sh linux-x86_64, and what meshlab_plugin/test.sh installs.
set -euo pipefail
. "$(dirname "$0")/tools.sh"
cd "$root"
. meshlab_plugin/hosts.sh
. meshlab_plugin/fetch.sh
work=$out/meshlab
check=$out/check/meshlab-sources
tree=$out/stage/linux-x86_64/fairmesh-$version-linux-x86_64
qt=$(compgen -G '/usr/include/*/qt5') || fail "Qt's headers are missing: apt-get install qtbase5-dev libqt5opengl5-dev"
for header in GL/glew.h GL/glu.h eigen3/Eigen/Core; do
    [ -e "/usr/include/$header" ] || fail "$header is missing: apt-get install libglew-dev libglu1-mesa-dev libeigen3-dev"
done
need cmake cmake
need xz xz-utils
[ -e "$tree/lib/libfairmesh.a" ] || fail "$tree is not there: packaging/build.sh linux-x86_64"

host pymeshlab
mkdir -p "$work" "$check"
fetch_sources
unpack_sources
release=${pypi#*==}
release=${release%.post*}
# 2025.7 is 2025.07 in the program.
release=${release%.*}.$(printf %02d "${release#*.}")

extra_plugin() {
    environment "$out/pymeshlab" "$pypi" numpy==1.26.4
    cmake -S meshlab_plugin/tests/extra_plugin -B "$check/extra" -DCMAKE_BUILD_TYPE=Release -Dfairmesh_DIR="$tree/lib/cmake/fairmesh" \
        -DMESHLAB_SOURCE="$source" -DMESHLAB_VERSION="$release" \
        -DMESHLAB_LIBRARY="$(compgen -G "$out/pymeshlab/lib/python3*/site-packages/pymeshlab/lib/libmeshlab-common.so")" >"$check/log" || fail "$(cat "$check/log")"
    cmake --build "$check/extra" --parallel 2 >"$check/log" 2>&1 || fail "$(tail -40 "$check/log")"
    "$out/pymeshlab/bin/python" packaging/rehearsal/use_pymeshlab.py "$check/extra/plugins/libfilter_fairmesh.so"
}

# What macOS has in a folder of its own, and what of GLEW does not depend on the system.
headers() {
    mkdir -p "$check/include/GL" "$check/include/OpenGL"
    cp /usr/include/GL/{glew,glu,gl,glext}.h "$check/include/GL"
    cp /usr/include/GL/glu.h "$check/include/OpenGL"
    local name
    for name in gl gl3 gl3ext glext; do echo '#include <GL/gl.h>' >"$check/include/OpenGL/$name.h"; done
}

# for_system TARGET: all sources as one, or vcglib would be read seventeen times.
for_system() {
    local file includes=()
    for file in "$root"/meshlab_plugin/src/*.cpp; do
        [ "${file##*/}" = plugin_2020.cpp ] || echo "#include \"$file\""
    done >"$check/all.cpp"
    for file in meshlab_plugin/src include "$source/src" "$source/src/vcglib" "$qt" "$qt"/Qt{Core,Gui,Widgets,OpenGL,Xml} /usr/include/eigen3 "$check/include"; do
        includes+=("-I$file")
    done
    zig c++ -target "$1" -std=c++17 -w -c "-DMESHLAB_VERSION=${release}d" -DMESHLAB_SCALAR=double "${includes[@]}" "$check/all.cpp" -o "$check/$1.o" ||
        fail "the plugin's sources are not compiled for $1"
    echo "MeshLab $release, $1: compiled, not linked"
}

install_zig
headers
for_system x86_64-windows-gnu
for_system aarch64-macos
extra_plugin
