#!/usr/bin/env bash
# SPDX-License-Identifier: MIT OR Apache-2.0
# A plugin that the loader would refuse is refused by CMake before. After build.sh debian, pymeshlab and pymeshlab-2022.
set -euo pipefail
here=$(cd "$(dirname "$0")/.." && pwd)
work=$(cd "$here/../target/meshlab" && pwd)

cached() { sed -n "s/^$2:[A-Z]*=//p" "$work/build-$1/CMakeCache.txt"; }

# refused WORDS OPTIONS...
refused() {
    local words=$1 said
    shift
    rm -rf "$work/build-refused"
    if said=$(cmake -S "$here" -B "$work/build-refused" -Dfairmesh_DIR="$work/fairmesh/lib/cmake/fairmesh" "$@" 2>&1); then
        printf 'test_build.sh: not refused: %s\n' "$*" >&2
        exit 1
    fi
    # CMake breaks lines.
    if ! tr -s '\n ' ' ' <<<"$said" | grep -qF -- "$words"; then
        printf 'test_build.sh: refused, but without the words "%s": %s\n' "$words" "$said" >&2
        exit 1
    fi
}

old=$(cached debian MESHLAB_LIBRARY) old_source=$(cached debian MESHLAB_SOURCE)
new=$(cached pymeshlab MESHLAB_LIBRARY) new_source=$(cached pymeshlab MESHLAB_SOURCE)
between_source=$(cached pymeshlab-2022 MESHLAB_SOURCE)

refused "MESHLAB_SCALAR is double, but" -DMESHLAB_LIBRARY="$old" -DMESHLAB_SOURCE="$old_source" -DMESHLAB_SCALAR=double
refused "MESHLAB_SCALAR is float, but" -DMESHLAB_LIBRARY="$new" -DMESHLAB_SOURCE="$new_source" -DMESHLAB_SCALAR=float
refused "The sources are those of MeshLab 2022.02, but" -DMESHLAB_LIBRARY="$new" -DMESHLAB_SOURCE="$between_source"
refused "The sources are those of MeshLab 2025.07, but" -DMESHLAB_LIBRARY="$old" -DMESHLAB_SOURCE="$new_source"
refused "there is no file" -DMESHLAB_LIBRARY=/nowhere.so -DMESHLAB_SOURCE="$new_source"
refused "is not MeshLab's source tree" -DMESHLAB_LIBRARY="$new" -DMESHLAB_SOURCE=/usr
rm -rf "$work/build-refused"

# Nothing else is seen from outside.
for host in debian pymeshlab pymeshlab-2022; do
    symbols=$(nm -D --defined-only "$work/$host/libfilter_fairmesh.so" | awk '{print $3}' | sort | tr '\n' ' ')
    [ "$symbols" = "qt_plugin_instance qt_plugin_query_metadata " ] || {
        printf 'test_build.sh: %s shows %s\n' "$host" "$symbols" >&2
        exit 1
    }
done

# The loaders themselves: a plugin of the wrong version, and one of the wrong interface, are refused, and the host lives.
loads() { "$work/venv-$1/bin/python" -c 'import pymeshlab, sys; pymeshlab.load_plugin(sys.argv[1])' "$2"; }
loads pymeshlab "$work/pymeshlab/libfilter_fairmesh.so"
if said=$(loads pymeshlab "$work/pymeshlab-2022/libfilter_fairmesh.so" 2>&1); then exit 1; fi
grep -q 'PyMeshLabException' <<<"$said"
printf 'test_build.sh: wrong versions, scalars and sources are refused\n'
