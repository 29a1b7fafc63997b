#!/bin/bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Format, style, types and layers; every check runs, and the exit status is 1 when one of them fails.
set -uo pipefail
cd "$(dirname "$0")/.."

failed=()
check() {
    local name=$1
    shift
    "$@" || failed+=("$name")
}

mapfile -t cxx_files < <(find kernel benchmarks -name '*.cpp' -o -name '*.h' | sort)
check clang-format clang-format --dry-run --Werror "${cxx_files[@]}"
check ruff .venv/bin/ruff check --quiet .
check ruff-format .venv/bin/ruff format --quiet --check .
check mypy .venv/bin/python -m mypy --no-error-summary
check layers .venv/bin/python tools/check_layers.py .
check headers .venv/bin/python tools/check_headers.py .

if [[ ${#failed[@]} -gt 0 ]]; then
    echo "lint: failed: ${failed[*]} (make format repairs clang-format, ruff and ruff-format)" >&2
    exit 1
fi
echo "lint: ok"
