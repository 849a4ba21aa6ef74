#!/usr/bin/env bash
# Writes docs/gallery.md, docs/rounding.md, their pictures and docs/guides/sharp-edges/*.png anew. The scans that it shows come from Debian's libcgal-demo, which
# is installed where it is missing, and from PyPI's tvb-data (50 MB), into target/gallery; so do the programs that round beside fairmesh (Python 3.11).
#   site/gallery.sh
set -euo pipefail
cd "$(dirname "$0")/.."
cargo build --release --locked --quiet -p fairmesh-cli
scans=target/gallery/scans
mkdir -p $scans
archive=/usr/share/doc/libcgal-demo/data.tar.gz
if [ ! -e $archive ]; then
    . packaging/install.sh
    install_packages libcgal-demo
fi
[ -e $scans/data/meshes ] || tar -xzf $archive -C $scans
skull=$scans/tvb_data/surfaceData/outer_skull_4096
if [ ! -e $skull ]; then
    python3 -m venv target/gallery/venv
    target/gallery/venv/bin/pip download -q --disable-pip-version-check --no-deps -d $scans tvb-data==3.0.0
    python3 -m zipfile -e $scans/tvb_data-3.0.0-*.whl $scans
    python3 -m zipfile -e $skull.zip $skull
fi
python3 site/gallery.py "${CARGO_TARGET_DIR:-target}/release/fairmesh" $scans
python3 site/sharp_edges.py "${CARGO_TARGET_DIR:-target}/release/fairmesh" $scans/data/meshes
python3 -m venv target/gallery/peers
target/gallery/peers/bin/pip install -q --disable-pip-version-check bpy==5.0.1 manifold3d==3.5.4 meshlib==3.1.4.297 numpy==1.26.4 pillow==13.0.0
target/gallery/peers/bin/python site/rounding.py "${CARGO_TARGET_DIR:-target}/release/fairmesh"
