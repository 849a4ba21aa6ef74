#!/usr/bin/env bash
# Hands the package of npm.sh to npm's registry, if it is not there yet: packaging/publish_npm.sh
# Needs npm 11.5.1 or newer for trusted publishing; NPM_CONFIG_REGISTRY and NPM_CONFIG_PROVENANCE are npm's own.
set -euo pipefail
. "$(dirname "$0")/tools.sh"
need npm "nodejs npm"
need openssl openssl
archive=$dist/fairmesh-$version.tgz
[ -e "$archive" ] || fail "$archive is not there: packaging/npm.sh"
ours=sha512-$(openssl dgst -sha512 -binary "$archive" | base64 -w0)
# npm ends with 1 where there is no such package, and with nothing said where there is no such version of it.
theirs=$(npm view "fairmesh@$version" dist.integrity 2>"$out/npm-view.log") || grep -q E404 "$out/npm-view.log" || fail "$(cat "$out/npm-view.log")"
case $theirs in
"") npm publish --access public "$archive" ;;
"$ours") echo "fairmesh $version is on npm" ;;
*) fail "npm has another fairmesh $version: $theirs, not $ours" ;;
esac
