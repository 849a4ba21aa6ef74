# SPDX-License-Identifier: GPL-3.0-or-later
# Sourced by the scripts here. $out: where everything goes that is made or fetched.

# venv NAME PACKAGE==VERSION...: a virtual environment $out/NAME with these packages, made once.
venv() {
    local folder=$out/$1 wanted="${*:2}"
    [ "$(cat "$folder/fairmesh-packages" 2>/dev/null)" = "$wanted" ] && return
    rm -rf "$folder"
    "${PYTHON:-python3}" -m venv "$folder"
    PIP_CACHE_DIR=$out/pip "$folder/bin/pip" install --quiet --disable-pip-version-check $wanted
    echo "$wanted" > "$folder/fairmesh-packages"
}
