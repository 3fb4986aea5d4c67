#!/usr/bin/env bash
# Installs what is missing, then builds and runs every test. Tests of core, adapter and oracle also run with sanitizers.
# The last lines are CTest's summary. The exit status is 0 only if everything was built and passed.
#   tests/run.sh            all of it, on this system
#   tests/run.sh --windows  the same, and a game for Windows, with packages of 170 MB (CTest's label `windows`)
#   tests/run.sh --quick    with a few random steps, without the sanitizers and the tests that take long (CTest's label `slow`)
set -euo pipefail

target=sanitized_tests
left_out=(--label-exclude '^windows$')
windows=
case ${1-} in
  "") ;;
  --windows)
    left_out=()
    windows=yes
    ;;
  --quick)
    target=
    left_out=(--label-exclude '^(slow|sanitized|windows)$')
    export PAPERPROOF_GUARANTEE_STEPS=${PAPERPROOF_GUARANTEE_STEPS:-500}
    ;;
  *)
    echo "$0: expected nothing, --windows or --quick, not $1" >&2
    exit 2
    ;;
esac

cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=compare/packages.sh
source compare/packages.sh

install_missing "${build_packages[@]}" "${test_packages[@]}" ${windows:+"${windows_test_packages[@]}"}
mapfile -t optional < <(installable_packages "${optional_test_packages[@]}" ${target:+"${peer_packages[@]}"})
(install_missing "${optional[@]}") || echo "going on without ${optional[*]}: tests that need it are skipped"
[[ -z $target ]] || (install_peers) || echo "going on without the engines of compare/peers that npm has: their test is skipped"

jobs=$(build_jobs)
{
  cmake --preset release "${whole_build[@]}" -DPAPERPROOF_BENCHMARKS=OFF -DPAPERPROOF_SANITIZED_TESTS=ON
  cmake --build --preset release --target all $target --parallel "$jobs"
  # One more than there are cores: some tests wait most of their time.
  ctest --preset release "${left_out[@]}" --parallel $((jobs + 1)) --no-tests=error
} </dev/null
