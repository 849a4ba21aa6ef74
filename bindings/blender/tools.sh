# SPDX-License-Identifier: GPL-3.0-or-later
# Sourced by the scripts here. $out: where everything goes that is made or fetched.

# venv NAME PACKAGE==VERSION...: a virtual environment $out/NAME with these packages, made once. $PYTHON makes it.
venv() {
    local folder=$out/$1 wanted="${*:2}"
    [ "$(cat "$folder/fairmesh-packages" 2>/dev/null)" = "$wanted" ] && return
    rm -rf "$folder"
    "${PYTHON:-python3}" -m venv "$folder"
    # shellcheck disable=SC2086
    PIP_CACHE_DIR=$out/pip "$folder/bin/pip" install --quiet --disable-pip-version-check $wanted
    echo "$wanted" >"$folder/fairmesh-packages"
}

# What Blender 3.4 of Debian, its display and the pictures need.
install_blender() {
    local missing=() as_root=""
    command -v blender >/dev/null || missing+=(blender python3-numpy libgl1-mesa-dri)
    command -v xvfb-run >/dev/null || missing+=(xvfb xauth)
    command -v import >/dev/null || missing+=(imagemagick)
    python3 -c 'import venv, ensurepip' 2>/dev/null || missing+=(python3-venv)
    [ ${#missing[@]} -eq 0 ] && return
    [ "$(id -u)" -eq 0 ] || as_root=sudo
    $as_root apt-get -o DPkg::Lock::Timeout=300 update -qq
    $as_root apt-get -o DPkg::Lock::Timeout=300 install -y -qq --no-install-recommends "${missing[@]}"
}
