#!/usr/bin/env bash
# Checks the plugins that meshlab.sh has made, from their archives alone: what they show and need, and their sizes; then all tests of
# meshlab_plugin/tests in the programs they are for: PyMeshLab in a fresh environment each, Debian's meshlabserver under Xvfb.
#   packaging/check_meshlab.sh [HOST...]
# Debian 12 with Python 3.11 and `apt-get install meshlab xvfb libgl1-mesa-dri python3.11-venv binutils`.
set -euo pipefail
. "$(dirname "$0")/tools.sh"
cd "$root"
. meshlab_plugin/hosts.sh
read -ra hosts <<<"${*:-$HOSTS}"
work=$out/check/meshlab
# Of PyMeshLab's wheels for 2022.2 and 2023.12 (manylinux_2_31), and of Debian 11, which has MeshLab 2020.09 as well.
OLDEST_GLIBC=2.31
OLDEST_GLIBCXX=3.4.28
# What they are, and a tenth more.
ARCHIVE_BYTES=$((2000 * 1000))
PLUGIN_BYTES=$((4400 * 1000))

bad() { fail "$label: $*"; }

# newest SYMBOLS NAME: the newest version of that name that is needed.
newest() { { grep -oE "$2_[0-9.]+" <<<"$1" || true; } | sort -uV | tail -1 | cut -d_ -f2; }

# not_newer THAN VERSION WHAT
not_newer() {
    [ -n "$2" ] || bad "no version of $3 was found in it"
    [ "$(printf '%s\n' "$1" "$2" | sort -V | tail -1)" = "$1" ] || bad "it needs $3 $2, the program's is $1"
}

# looks: at the files in $folder.
looks() {
    local plugin=$folder/libfilter_fairmesh.so symbols shown needed
    [ "$(wc -c <"$archive")" -le $ARCHIVE_BYTES ] || bad "the archive has $(wc -c <"$archive") bytes, more than $ARCHIVE_BYTES"
    [ "$(wc -c <"$plugin")" -le $PLUGIN_BYTES ] || bad "the plugin has $(wc -c <"$plugin") bytes, more than $PLUGIN_BYTES"
    [ "$(cd "$folder" && find . -type f | LC_ALL=C sort | tr '\n' ' ')" = "./COPYING ./LICENSE-APACHE ./LICENSE-MIT ./README.md ./THIRD-PARTY.txt ./libfilter_fairmesh.so $(
        cd meshlab_plugin && find scripts -type f -printf './%p\n' | LC_ALL=C sort | tr '\n' ' ')" ] || bad "other files are inside: $(ls -R "$folder")"
    diff -r "$folder/scripts" meshlab_plugin/scripts || bad "the scripts are others"
    grep -q 'GNU GENERAL PUBLIC LICENSE' "$folder/COPYING" || bad "COPYING is another licence"
    symbols=$(objdump -T "$plugin")
    shown=$(nm -D --defined-only "$plugin" | awk '{print $3}' | sort | tr '\n' ' ')
    [ "$shown" = "qt_plugin_instance qt_plugin_query_metadata " ] || bad "it shows $shown"
    needed=$(readelf -dW "$plugin")
    ! grep -E 'libfairmesh|RPATH|RUNPATH' <<<"$needed" || bad "it needs the library, or looks for libraries in a place of its own"
    ! readelf -SW "$plugin" | grep -qE '\.symtab|\.debug' || bad "it is not stripped"
    not_newer $OLDEST_GLIBC "$(newest "$symbols" GLIBC)" glibc
    not_newer $OLDEST_GLIBCXX "$(newest "$symbols" GLIBCXX)" libstdc++
    ! grep -lF -e "$root" -e "$HOME/" -e /build/ -r "$folder" || bad "a path of the machine that built it is inside"
    echo "$label: $(wc -c <"$archive") bytes, the plugin $(wc -c <"$plugin"); needs glibc $(newest "$symbols" GLIBC), libstdc++ $(newest "$symbols" GLIBCXX)"
}

# fresh_environment PACKAGE...: in $work/venv, made anew.
fresh_environment() {
    rm -rf "$work/venv"
    "$PYTHON" -m venv "$work/venv" || fail "no environment can be made: apt-get install python3.11-venv"
    PIP_CACHE_DIR=$out/pip "$work/venv/bin/pip" install --quiet --disable-pip-version-check "$@"
}

# The known answers are those of meshlab_plugin/tests.
runs() {
    if [ -n "$pypi" ]; then
        fresh_environment "$pypi" numpy==1.26.4
        "$work/venv/bin/python" meshlab_plugin/tests/test_pymeshlab.py "$folder/libfilter_fairmesh.so" || bad "it has failed in $pypi"
        return
    fi
    need meshlabserver meshlab
    need Xvfb 'xvfb libgl1-mesa-dri'
    local program=$dist/fairmesh-cli-$version-linux-x86_64.tar.gz
    [ -e "$program" ] || fail "$program is not there: packaging/build.sh linux-x86_64"
    tar -xzf "$program" -C "$work"
    fresh_environment numpy==1.26.4
    FAIRMESH_WORK=$work "$work/venv/bin/python" meshlab_plugin/tests/test_meshlabserver.py "$folder/libfilter_fairmesh.so" \
        "$work/fairmesh-cli-$version-linux-x86_64/fairmesh" || bad "it has failed in meshlabserver"
}

need objdump binutils
PYTHON=$(command -v python3.11) || fail "python3.11 was not found: apt-get install python3.11-venv"
rm -rf "$work"
mkdir -p "$work"
for host in "${hosts[@]}"; do
    host "$host" || fail "no such host: $host; there are $HOSTS"
    folder=$work/fairmesh_meshlab-$version-$label-linux-x86_64
    archive=$dist/${folder##*/}.tar.gz
    [ -e "$archive" ] || fail "$archive is not there: packaging/meshlab.sh $host"
    tar -xzf "$archive" -C "$work"
    looks
    runs
    echo "$label: passed"
done
