#!/usr/bin/env bash
# Runs the tests and installs what they need (Debian 12). Stops at the first failure; logs are in target/test/.
#   ./test.sh          everything that has to pass before a change goes in: what continuous integration runs
#   ./test.sh quick    what needs Rust alone: formatting, clippy, documentation, `cargo test`
#   ./test.sh long     everything, then the long tier: a million vertices, a hundred meshes, many seeds, the torture run,
#                      and fuzzing for FUZZ_SECONDS a target (default 600)
#   ./test.sh packaging   of the long tier only what is published for each target, built, run and checked (docs/releasing.md)
#   ./test.sh NAME...  these steps of the full tier alone: lint workflows demo rust site python web blender meshlab address fuzzing
#                      thread; and `tests` of the quick tier
set -euo pipefail
cd "$(dirname "$0")"
logs=target/test
mkdir -p $logs

# step NAME COMMAND...: one line with its seconds; the whole log if it fails.
step() {
    local begin=$SECONDS log=$logs/$1.log
    if "${@:2}" >"$log" 2>&1; then
        printf 'passed %4d s  %s\n' $((SECONDS - begin)) "$1"
    else
        cat "$log"
        printf 'FAILED %4d s  %s, see %s\n' $((SECONDS - begin)) "$1" "$log"
        return 1
    fi
}

. packaging/install.sh

install_rust() {
    command -v cc >/dev/null || install_packages build-essential
    [ -e "$HOME/.cargo/env" ] && . "$HOME/.cargo/env"
    if ! command -v cargo >/dev/null; then
        command -v curl >/dev/null || install_packages curl ca-certificates
        curl --proto '=https' --tlsv1.2 -sSf https://sh.rustup.rs | sh -s -- -y --no-modify-path
        . "$HOME/.cargo/env"
    fi
    cargo fmt --version >/dev/null 2>&1 && cargo clippy --version >/dev/null 2>&1 ||
        rustup component add rustfmt clippy
}

# What the tests of the C interface need besides a compiler.
install_c_tools() {
    local missing=()
    command -v cmake >/dev/null || missing+=(cmake)
    command -v make >/dev/null || missing+=(make)
    command -v pkg-config >/dev/null || missing+=(pkg-config)
    command -v valgrind >/dev/null || missing+=(valgrind)
    command -v abidw >/dev/null || missing+=(abigail-tools)
    command -v doxygen >/dev/null || missing+=(doxygen)
    command -v c++ >/dev/null || missing+=(g++)
    python3 -c 'import ensurepip' 2>/dev/null || missing+=(python3-venv)
    # OpenMesh, and libclang for bindgen: for bindings/openmesh-sys only. Clang: for fuzzing.
    pkg-config --exists openmesh 2>/dev/null || missing+=(libopenmesh-dev)
    compgen -G '/usr/lib/llvm-*/lib/libclang[.-][0-9s]*' >/dev/null &&
        compgen -G '/usr/lib/llvm-*/lib/clang/*/include/stddef.h' >/dev/null || missing+=(libclang-dev)
    command -v clang >/dev/null && compgen -G '/usr/lib/llvm-*/lib/clang/*/lib/linux/libclang_rt.fuzzer-*.a' >/dev/null ||
        missing+=(clang libclang-rt-14-dev)
    [ ${#missing[@]} -eq 0 ] || install_packages "${missing[@]}"
}

# The one command that README.md promises, and what it has to leave behind.
demo() {
    local out=target/test/demo
    rm -rf $out &&
        cargo run --release --locked --quiet -- demo $out &&
        [ "$(ls $out | sort | tr '\n' ' ')" = "blend.png free.txt normals.txt result.ply start.ply " ] &&
        [ -s $out/start.ply ] && [ -s $out/blend.png ] &&
        head -c 3 $out/result.ply | grep -q '^ply' &&
        cargo run --release --locked --quiet -- fair docs/dented.ply -o $out/sphere.ply --selection free
}

# What is published for each target, built and run.
packaging() {
    step manifest packaging/manifest.sh
    step check packaging/check.sh
    step again packaging/check_again.sh
    local part
    for part in python blender meshlab meshlab_sources npm ports; do step "check_$part" "packaging/check_$part.sh"; done
}

# For other systems: their compilers, and what runs their programs.
install_packaging_tools() {
    local missing=()
    command -v x86_64-w64-mingw32-gcc >/dev/null || missing+=(gcc-mingw-w64-x86-64)
    command -v aarch64-linux-gnu-gcc >/dev/null || missing+=(gcc-aarch64-linux-gnu libc6-dev-arm64-cross)
    command -v qemu-aarch64-static >/dev/null || missing+=(qemu-user-static)
    command -v debootstrap >/dev/null || missing+=(debootstrap)
    command -v node >/dev/null || missing+=(nodejs)
    command -v npm >/dev/null || missing+=(npm)
    command -v chromium >/dev/null || missing+=(chromium)
    command -v firefox-esr >/dev/null || missing+=(firefox-esr)
    command -v xvfb-run >/dev/null || missing+=(xvfb xauth libgl1-mesa-dri)
    command -v ruby >/dev/null || missing+=(ruby)
    command -v patchelf >/dev/null || missing+=(patchelf)
    command -v meshlabserver >/dev/null || missing+=(meshlab xvfb libgl1-mesa-dri)
    command -v xz >/dev/null || missing+=(xz-utils)
    command -v zopfli >/dev/null || missing+=(zopfli)
    compgen -G '/usr/include/*/qt5/QtOpenGL' >/dev/null || missing+=(qtbase5-dev libqt5opengl5-dev libglew-dev libglu1-mesa-dev libeigen3-dev)
    [ ${#missing[@]} -eq 0 ] || install_packages "${missing[@]}"
}

# lint OPTIONS...: of clippy.
lint() {
    cargo --version &&
        cargo fmt --all --check &&
        cargo clippy --release --locked "$@" --all-targets -- -D warnings &&
        RUSTDOCFLAGS="-D warnings" cargo doc --release --locked --no-deps --lib
}

# The steps by their names.
run() {
    case $1 in
    lint) step lint lint --workspace --features fairmesh-capi/hooks ;;
    workflows) step workflows packaging/check_workflows.sh ;;
    demo) step demo demo ;;
    tests) step tests cargo test --locked ;;
    rust) step rust cargo test --release --locked --workspace -- --include-ignored --skip long:: ;;
    site) step site site/build.sh ;;
    # The programs that carry the library.
    python) step python bindings/python/test.sh ;;
    web) step web bindings/web/test.sh ;;
    blender) step blender bindings/blender/test.sh ;;
    meshlab) step meshlab meshlab_plugin/test.sh gui ;;
    # Builds of their own, with other compiler flags.
    address) step address tests/sanitize.sh address ;;
    fuzzing) step fuzzing fuzz/run.sh 60 ;;
    thread) step thread tests/sanitize.sh thread ;;
    *)
        sed -n '2,10p' "$0" >&2
        exit 2
        ;;
    esac
}

run_all() {
    local name
    for name in "$@"; do run "$name"; done
}

quick() {
    step lint lint
    run tests
}

full() {
    install_c_tools
    run_all lint workflows demo rust site
    # On two cores; each lane goes on when the other one has failed.
    trap 'kill 0' INT
    # These build in target/release and so come one after the other.
    run_all python web blender meshlab &
    local lane=$! failed=0
    run_all address fuzzing thread &
    wait $! || failed=1
    wait $lane || failed=1
    [ $failed -eq 0 ]
}

long() {
    install_packaging_tools
    packaging
    step rehearsal packaging/rehearse.sh
    step firefox bindings/web/page/test.sh target/web/run/node_modules/fairmesh firefox
    step oldest packaging/oldest_rust.sh
    step gallery bindings/python/test.sh long
    step guides cargo test --release --locked -p fairmesh-cli --test guides -- --ignored long::
    step long cargo test --release --locked --test library -- --ignored long::
    step benchmark benchmark/run.sh test
    step benchmark_quick benchmark/run.sh --only fairmesh --quick
    step torture tests/torture/run.sh --json target/test/torture.json
    step long_fuzzing env FUZZ_SEED=0 fuzz/run.sh "${FUZZ_SECONDS:-600}"
}

install_rust
case "${1:-full}" in
quick) quick ;;
full) full ;;
long)
    full
    long
    ;;
packaging)
    install_c_tools
    install_packaging_tools
    packaging
    ;;
*)
    # What the tests of the C interface need, the sanitizers and the lint of the workspace too.
    case " $* " in *\ lint\ * | *\ rust\ * | *\ address\ * | *\ thread\ *) install_c_tools ;; esac
    run_all "$@"
    ;;
esac
printf 'All tests have passed in %d s.\n' $SECONDS
