#!/usr/bin/env bash
# Rehearses a release of this commit: everything that a person and the workflow do, up to and including the uploads, against stand-ins on this machine,
# from a clean clone. Every upload fails once and goes on when it is run again; a second release over the first changes nothing. Then what was
# published is installed from the stand-ins in fresh environments, and each runs one fair and one fill.
#   packaging/rehearse.sh [STEP...]      steps: release build look publish repeat install
# Debian 12 with Rust; installs what it needs, and leaves everything in target/rehearsal.
# Functions are called through quietly and fails.
# shellcheck disable=SC2329
set -euo pipefail
. "$(dirname "$0")/tools.sh"
. "$root/packaging/install.sh"
work=${CARGO_TARGET_DIR:-$root/target}/rehearsal
here=$root/packaging/rehearsal
# The address that a person would write into Cargo.toml.
ADDRESS=https://github.com/fairmesh-rehearsal/fairmesh
PYPI_TOOLS="pypiserver==2.4.2 twine==6.2.0 check-wheel-contents==0.6.3 cyclonedx-python-lib[json-validation]==11.12.0"
# The newest that runs on Debian's node.
NPM_TOOLS="verdaccio@6.2.0 publint@0.3.25 @arethetypeswrong/cli@0.18.5"
GITHUB=$work/github
clone=$work/clone
tag=v$version

export GIT_AUTHOR_NAME=rehearsal GIT_COMMITTER_NAME=rehearsal
export GIT_AUTHOR_EMAIL=rehearsal@localhost GIT_COMMITTER_EMAIL=rehearsal@localhost

say() { printf '%5d s  %s\n' $SECONDS "$*"; }

# fails WORDS COMMAND...: as it shall, and says so.
fails() {
    local words=$1
    shift
    if "$@" >"$work/log" 2>&1; then fail "it was to fail: $*"; fi
    grep -q "$words" "$work/log" || fail "$* has failed otherwise: $(cat "$work/log")"
}

# quietly COMMAND...: what it says is shown if it fails.
quietly() { "$@" >"$work/log" 2>&1 || fail "$* has failed: $(tail -40 "$work/log")"; }

install_tools() {
    local missing=()
    command -v npm >/dev/null || missing+=(nodejs npm)
    command -v lintian >/dev/null || missing+=(lintian)
    command -v cmake >/dev/null || missing+=(cmake)
    command -v ruby >/dev/null || missing+=(ruby)
    command -v patchelf >/dev/null || missing+=(patchelf)
    command -v pkg-config >/dev/null || missing+=(pkg-config)
    command -v debootstrap >/dev/null || missing+=(debootstrap)
    command -v curl >/dev/null || missing+=(curl ca-certificates)
    command -v xz >/dev/null || missing+=(xz-utils)
    command -v zopfli >/dev/null || missing+=(zopfli)
    command -v openssl >/dev/null || missing+=(openssl)
    python3 -c 'import ensurepip' 2>/dev/null || missing+=(python3-venv)
    command -v abidw >/dev/null || missing+=(abigail-tools)
    command -v aarch64-linux-gnu-gcc >/dev/null || missing+=(gcc-aarch64-linux-gnu libc6-dev-arm64-cross)
    command -v x86_64-w64-mingw32-gcc >/dev/null || missing+=(gcc-mingw-w64-x86-64)
    [ ${#missing[@]} -eq 0 ] || quietly install_packages "${missing[@]}"
    # shellcheck disable=SC2086
    environment "$work/pypi-tools" $PYPI_TOOLS
    if [ "$(cat "$work/npm-tools/installed" 2>/dev/null)" != "$NPM_TOOLS" ]; then
        mkdir -p "$work/npm-tools"
        # verdaccio asks for it by a name that not every registry has.
        echo '{ "private": true, "overrides": { "node-fetch": "2.7.0" } }' >"$work/npm-tools/package.json"
        # shellcheck disable=SC2086
        quietly npm --prefix "$work/npm-tools" install --no-audit --no-fund $NPM_TOOLS
        echo "$NPM_TOOLS" >"$work/npm-tools/installed"
    fi
}

# What a person does: the address, the release, the push. GitHub is a repository in a folder.
release() {
    [ -z "$(git -C "$root" status --porcelain)" ] || fail "the tree has changes that are not committed"
    rm -rf "$work"/{origin.git,person,clone,tap.git,tap,github,served,answers}
    git clone -q --bare "$root" "$work/origin.git"
    git clone -q "$work/origin.git" "$work/person"
    cd "$work/person"
    sed -i "s|^repository = .*|repository = \"$ADDRESS\"|" Cargo.toml
    git commit -q -a -m "The project's address"
    CARGO_TARGET_DIR=$work/target quietly packaging/release.sh "$version"
    git push -q --atomic origin HEAD "$tag"
    git clone -q --branch "$tag" "$work/origin.git" "$clone" 2>/dev/null
    if grep -rlI 'fairmesh\.invalid/fairmesh' "$clone" --include=Cargo.toml; then fail "the placeholder is still there"; fi
}

# What the workflow builds.
build() {
    cd "$clone"
    quietly packaging/check_tag.sh "$tag"
    CARGO_TARGET_DIR=$work/target quietly packaging/manifest.sh
}

# What others' programs say of it.
look() {
    local found=$work/target/packaging/dist bin=$work/npm-tools/node_modules/.bin
    cd "$clone"
    CARGO_TARGET_DIR=$work/target quietly packaging/check_workflows.sh
    quietly "$work/pypi-tools/bin/twine" check --strict "$found"/*.whl "$found/fairmesh-$version.tar.gz"
    quietly "$work/pypi-tools/bin/check-wheel-contents" "$found"/*.whl
    quietly "$bin/publint" --strict "$found/fairmesh-$version.tgz"
    quietly "$bin/attw" --profile esm-only --exclude-entrypoints fairmesh.wasm -- "$found/fairmesh-$version.tgz"
    # shellcheck disable=SC2016
    quietly "$work/pypi-tools/bin/python" -c 'import sys
from cyclonedx.schema import SchemaVersion
from cyclonedx.validation.json import JsonStrictValidator
for name in sys.argv[1:]:
    with open(name) as file:
        error = JsonStrictValidator(SchemaVersion.V1_6).validate_str(file.read())
    assert error is None, f"{name}: {error}"' "$found"/*.cdx.json
    quietly lintian --allow-root --fail-on error,warning "$found/fairmesh_${version}_amd64.deb" "$found/fairmesh_${version}_arm64.deb"
    if grep -rlaF "$work" "$found"; then fail "a path of this machine is in it"; fi
}

# free_port: one that nobody uses.
free_port() { python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])'; }

# wait_for URL
wait_for() {
    local k
    for k in $(seq 100); do
        curl -sf -o "$work/page" "$1" && return
        sleep 0.2
    done
    fail "$1 does not answer after $k trials"
}

# serve: the registries, until the script ends. Cargo finds its own by the configuration above the clone.
serve() {
    [ -z "${served-}" ] || return 0
    served=yes
    crates=http://127.0.0.1:$(free_port) pypi=http://127.0.0.1:$(free_port) npm=http://127.0.0.1:$(free_port)
    mkdir -p "$work"/served/{crates,pypi,npm} "$work/.cargo" "$GITHUB"
    python3 "$here/crates_io.py" "$work/served/crates" "${crates##*:}" &
    "$work/pypi-tools/bin/pypi-server" run -p "${pypi##*:}" -i 127.0.0.1 -P . -a . --disable-fallback "$work/served/pypi" >"$work/pypi.log" 2>&1 &
    cat >"$work/served/npm/config.yaml" <<CONFIG
storage: $work/served/npm/storage
uplinks: { npmjs: { url: https://registry.npmjs.org } }
packages: { fairmesh: { access: \$all, publish: \$all }, '**': { access: \$all, proxy: npmjs } }
CONFIG
    "$work/npm-tools/node_modules/.bin/verdaccio" -c "$work/served/npm/config.yaml" -l "$npm" >"$work/npm.log" 2>&1 &
    # shellcheck disable=SC2046
    trap 'kill $(jobs -p)' EXIT
    printf '[registries.stand-in]\nindex = "sparse+%s/index/"\n[source.crates-io]\nreplace-with = "stand-in"\n[source.stand-in]\nregistry = "sparse+%s/index/"\n' \
        "$crates" "$crates" >"$work/.cargo/config.toml"
    printf '//%s/:_authToken=rehearsal\n' "${npm#http://}" >"$work/npmrc"
    wait_for "$crates/index/config.json"
    wait_for "$pypi/simple/"
    wait_for "$npm/-/ping"
}

# As the action does it that the workflow uses: what is there is skipped. twine itself has an option for that, but for PyPI alone.
publish_pypi() {
    local file there
    there=$(curl -s "$pypi/simple/fairmesh/")
    for file in "$@"; do
        grep -q ">${file##*/}<" <<<"$there" ||
            "$work/pypi-tools/bin/twine" upload --disable-progress-bar --repository-url "$pypi" -u rehearsal -p rehearsal "$file"
    done
}

publish_crates() {
    FAIRMESH_CRATES_INDEX=$crates/index CARGO_REGISTRIES_STAND_IN_TOKEN=rehearsal CARGO_TARGET_DIR=$work/target packaging/publish_crates.sh
}

publish_npm() {
    NPM_CONFIG_REGISTRY=$npm NPM_CONFIG_USERCONFIG=$work/npmrc CARGO_TARGET_DIR=$work/target packaging/publish_npm.sh
}

publish_github() {
    PATH=$here:$PATH FAIRMESH_REHEARSAL_GITHUB=$GITHUB CARGO_TARGET_DIR=$work/target packaging/publish_github.sh "$tag"
}

# What goes to PyPI: archives of the library have a target in their names.
python_files() { find "$work/target/packaging/dist" -name '*.whl' -o -name "fairmesh-$version.tar.gz" | sort; }

# Homebrew's tap is a repository, too: the formula goes there by a commit.
publish_tap() {
    [ -d "$work/tap.git" ] || git init -q --bare -b main "$work/tap.git"
    FAIRMESH_TAP=$work/tap.git CARGO_TARGET_DIR=$work/target packaging/publish_tap.sh
}

# Everything that a job uploads, at once or after its failure.
upload() {
    local files
    cd "$clone"
    serve
    mapfile -t files < <(python_files)
    quietly publish_pypi "${files[@]}"
    quietly publish_crates
    quietly publish_npm
    quietly publish_github
    quietly publish_tap
}

# Each upload fails once on its way.
publish() {
    local files
    cd "$clone"
    serve
    mapfile -t files < <(python_files)
    # The second half does not come.
    quietly publish_pypi "${files[@]:0:3}"
    touch "$work/served/crates/fail-fairmesh"
    fails 'this failure is planned' publish_crates
    npm=http://127.0.0.1:9 fails 'ECONNREFUSED' publish_npm
    touch "$GITHUB/fail-fairmesh-$version-windows-x86_64.zip"
    fails 'this failure is planned' publish_github
    [ -e "$GITHUB/$tag/.draft" ] || fail "half a release is shown"
    say "each upload has failed on its way"
    upload
    [ ! -e "$GITHUB/$tag/.draft" ] || fail "the release is still a draft"
    [ "$(find "$work/served/pypi" -type f | wc -l)" = ${#files[@]} ] || fail "PyPI has other files"
    diff -r -x .notes.md "$work/target/packaging/dist" "$GITHUB/$tag" || fail "the release has other files"
}

# What was published, as bytes.
published() { (cd "$work" && find served/pypi served/crates github -type f -exec sha256sum {} + | sort && git -C tap.git rev-parse main); }

# A second release over the first.
repeat() {
    local before
    before=$(published)
    upload
    [ "$(published)" = "$before" ] || fail "the second time something has changed: $(diff <(echo "$before") <(published))"
}

# In a fresh environment, numpy from PyPI.
install_python() {
    rm -rf "$work/python"
    python3 -m venv "$work/python"
    quietly "$work/python/bin/pip" --disable-pip-version-check install --index-url https://pypi.org/simple numpy trimesh
    quietly "$work/python/bin/pip" --disable-pip-version-check install --index-url "$pypi/simple/" --no-deps --only-binary :all: fairmesh
    "$work/python/bin/python" "$here/use_python.py"
}

install_npm() {
    rm -rf "$work/node"
    mkdir -p "$work/node"
    echo '{ "private": true, "type": "module" }' >"$work/node/package.json"
    cp "$here/use_node.mjs" "$work/node"
    quietly npm --prefix "$work/node" --registry "$npm" install --no-audit --no-fund fairmesh
    node "$work/node/use_node.mjs"
}

# uses_program FAIRMESH: the command line.
uses_program() {
    local program=$1
    [ "$("$program" --version)" = "fairmesh $version" ] || fail "$program is of another version"
    "$program" fair "$root/docs/dented.ply" -o "$work/faired.ply" --selection free | grep '^converged' || fail "$program has faired nothing"
    "$program" generate sphere-hole --vertices 1000 --outside 1 -o "$work/open.ply" >"$work/log"
    "$program" fill "$work/open.ply" -o "$work/filled.ply" | grep '^loop 0, .*: converged' || fail "$program has filled nothing"
}

# As `cargo install` takes it from the registry; how fast it is, is not asked.
install_crate() {
    rm -rf "$work/cargo"
    # It reads no configuration but the user's.
    CARGO_PROFILE_RELEASE_OPT_LEVEL=0 CARGO_TARGET_DIR=$work/cargo-target \
        quietly cargo install --config "$work/.cargo/config.toml" --locked --root "$work/cargo" fairmesh-cli
    uses_program "$work/cargo/bin/fairmesh"
}

install_deb() {
    rm -rf "$work/deb"
    dpkg-deb -x "$GITHUB/$tag/fairmesh_${version}_amd64.deb" "$work/deb"
    uses_program "$work/deb/usr/bin/fairmesh"
}

# The library, for programs in C and C++.
install_library() {
    local tree=$work/library/fairmesh-$version-linux-x86_64
    rm -rf "$work/library"
    mkdir -p "$work/library"
    tar -xzf "$GITHUB/$tag/fairmesh-$version-linux-x86_64.tar.gz" -C "$work/library"
    for language in c cpp; do
        quietly cmake -S "$root/examples/$language" -B "$work/library/$language" "-Dfairmesh_DIR=$tree/lib/cmake/fairmesh" -DCMAKE_BUILD_TYPE=Release
        quietly cmake --build "$work/library/$language"
    done
    "$work/library/c/smooth_dent" | tail -1
    "$work/library/cpp/fill_hole"
}

install_blender_zip() {
    local user
    (out=$work/blender && mkdir -p "$out" && . "$root/bindings/blender/tools.sh" && install_blender)
    user=$(mktemp -d)
    mkdir -p "$user/scripts/addons"
    BLENDER_USER_RESOURCES=$user BLENDER_USER_SCRIPTS=$user/scripts BLENDER_USER_CONFIG=$user/config \
        blender -b --factory-startup --python-exit-code 7 --python "$here/use_blender.py" -- \
        "$root/bindings/blender/tests" "$GITHUB/$tag/fairmesh_blender-$version-linux_x64.zip" >"$work/log" 2>&1 || fail "$(tail -40 "$work/log")"
    rm -rf "$user"
    grep '^Blender [0-9.]* *$' "$work/log" | tail -1
}

install_meshlab_plugin() {
    local label pypi folder
    # shellcheck disable=SC1091
    . "$root/meshlab_plugin/hosts.sh"
    host pymeshlab
    folder=fairmesh_meshlab-$version-$label-linux-x86_64
    rm -rf "$work/meshlab"
    mkdir -p "$work/meshlab"
    tar -xzf "$GITHUB/$tag/$folder.tar.gz" -C "$work/meshlab"
    environment "$work/pymeshlab" "$pypi" numpy==1.26.4
    "$work/pymeshlab/bin/python" "$here/use_pymeshlab.py" "$work/meshlab/$folder/libfilter_fairmesh.so"
}

# Compiled from the sources as conda-forge does it.
install_conda() {
    (cd "$clone" && CARGO_TARGET_DIR=$work/target quietly packaging/check_ports.sh)
    uses_program "$work/target/packaging/check/ports/conda/unpacked/bin/fairmesh"
}

install_formula() {
    rm -rf "$work/tap"
    git clone -q "$work/tap.git" "$work/tap"
    grep -q "url \"$ADDRESS/releases/download/$tag/" "$work/tap/Formula/fairmesh.rb" || fail "the formula has another address"
    echo "Homebrew: the formula is in its tap; Homebrew itself is not run"
}

install_all() {
    serve
    install_python
    install_npm
    install_deb
    install_library
    install_crate
    install_blender_zip
    install_meshlab_plugin
    install_conda
    install_formula
}

main() {
    mkdir -p "$work"
    install_tools
    local step
    for step in "$@"; do
        case $step in
        release) release ;;
        build) build ;;
        look) look ;;
        publish) publish ;;
        repeat) repeat ;;
        install) install_all ;;
        *) fail "no such step: $step" ;;
        esac
        say "$step"
    done
}

if [ $# -eq 0 ]; then set -- release build look publish repeat install; fi
main "$@"
exit
