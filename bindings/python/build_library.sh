#!/usr/bin/env bash
# Builds the shared library for any Linux x86_64 with glibc 2.28 or newer, and prints its path; nothing else on stdout.
set -euo pipefail
exec python3 "$(dirname "$0")/build_library.py" --portable
