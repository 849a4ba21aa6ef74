#!/usr/bin/env bash
# Makes the page of live fairing, one file with everything inside, of a folder with the npm package: build.sh PACKAGE FILE
# Needs node and npm, cargo for the command line, which makes the shapes, and python3 with pip: the head is a file of the package MNE.
# Everything that is fetched is pinned, into target/web/page.
set -euo pipefail
package=$(realpath "$1")
file=$(realpath -m "$2")
cd "$(dirname "$0")"
root=$(cd ../../.. && pwd)
mne="mne==1.13.2"
digest=36bbdd9fdc68431309a75e9dc6331b9de085cb6836688ac50b7b89f141a83cc3
target=${CARGO_TARGET_DIR:-$root/target}
mkdir -p "$target/web/page" "$(dirname "$file")"
target=$(cd "$target" && pwd)
work=$target/web/page
for tool in node npm; do
    command -v $tool >/dev/null || { echo "$tool was not found: apt-get install nodejs npm" >&2; exit 1; }
done
python3 -m pip --version >/dev/null 2>&1 || { echo "pip was not found: apt-get install python3-pip" >&2; exit 1; }

# The programs that make it, beside a copy of the sources: nothing is installed into the repository.
if ! cmp -s package-lock.json "$work/installed"; then
    cp package.json package-lock.json "$work"
    npm --prefix "$work" ci --silent --no-audit --no-fund
    cp package-lock.json "$work/installed"
fi
head=$work/mne/data/fsaverage/fsaverage-head.fif
if [ ! -e "$head" ]; then
    python3 -m pip --disable-pip-version-check download -q --no-deps --only-binary :all: -d "$work/wheels" "$mne"
    wheel=$(echo "$work"/wheels/mne-*.whl)
    echo "$digest  $wheel" | sha256sum --quiet -c -
    python3 -m zipfile -e "$wheel" "$work/wheels/mne"
    mkdir -p "$(dirname "$head")"
    cp "$work/wheels/mne/mne/data/fsaverage/fsaverage-head.fif" "$head"
    cp "$work"/wheels/mne/mne-*.dist-info/licenses/LICENSE.txt "$work/mne/LICENSE.txt"
    rm -r "$work/wheels"
fi

(cd "$root" && cargo build --release --locked --quiet -p fairmesh-cli)
rm -rf "$work/shapes" "$work/sources"
node shapes.mjs "$target/release/fairmesh" "$head" "$work/shapes"
{
    cat "$package/THIRD-PARTY.txt"
    for each in three three-mesh-bvh; do
        printf '\n\n%s\n\n' "$each"
        cat "$work/node_modules/$each/LICENSE"
    done
    printf '\n\nMNE, of which the head is\n\n'
    cat "$work/mne/LICENSE.txt"
} >"$work/licences.txt"
mkdir -p "$work/sources/web"
cp -r ../src ../tsconfig.json "$work/sources/web"
mkdir "$work/sources/web/page"
cp -r src ./*.mjs page.html style.css tsconfig.json "$work/sources/web/page"
ln -s "$work/node_modules" "$work/sources/node_modules"
cd "$work/sources/web/page"
"$work/node_modules/.bin/tsc" -p .
node bundle.mjs "$package/dist/fairmesh.wasm" "$work/licences.txt" "$work/shapes" "$file"
