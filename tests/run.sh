#!/usr/bin/env bash
# Installs what is missing, builds and runs every test; then the core, the adapter and the oracle under the address and
# undefined behaviour sanitizers, and what threads share under the thread sanitizer. The last lines are CTest's summaries.
# The exit status is 0 only if everything was built and passed.
#   tests/run.sh            all of it
#   tests/run.sh --quick    only the release build, with a few random steps and without the tests that take long (CTest's
#                           label `slow`)
set -euo pipefail

quick=()
case ${1-} in
  "") ;;
  --quick)
    quick=(--label-exclude '^slow$')
    export PAPERPROOF_GUARANTEE_STEPS=${PAPERPROOF_GUARANTEE_STEPS:-500}
    ;;
  *)
    echo "$0: expected nothing or --quick, not $1" >&2
    exit 2
    ;;
esac

cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=compare/packages.sh
source compare/packages.sh

install_missing "${build_packages[@]}" "${test_packages[@]}"
mapfile -t optional < <(installable_packages "${optional_test_packages[@]}")
(install_missing "${optional[@]}") || echo "going on without ${optional[*]}: tests that need it are skipped"

jobs=$(build_jobs)

# run_preset PRESET TARGET SETTING... -- OPTION...: configures a preset with the settings, builds the target, and tests with
# the options of ctest.
run_preset() {
  local preset=$1 target=$2 log=build/$1/ctest.log settings=()
  shift 2
  while [[ $1 != -- ]]; do settings+=("$1") && shift; done
  cmake --preset "$preset" "${whole_build[@]}" "${settings[@]}" &&
    cmake --build --preset "$preset" --target "$target" --parallel "$jobs" &&
    ctest --preset "$preset" "${@:2}" --parallel "$jobs" --no-tests=error 2>&1 | tee "$log"
}

rm -f build/*/ctest.log
status=0
run_preset release all -DPAPERPROOF_BENCHMARKS=OFF -- "${quick[@]}" </dev/null || status=1
if ((${#quick[@]})); then exit "$status"; fi
# Without line numbers, which take a sixth of the time to compile, and in few processes: the preset alone has the one, and
# a process for each test.
sanitized=(-DCMAKE_EXE_LINKER_FLAGS=-fuse-ld=lld -DPAPERPROOF_TESTS_TOGETHER=ON)
run_preset asan-ubsan sanitized_tests "${sanitized[@]}" -DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1 -- --label-regex '^sanitized$' </dev/null || status=1
# The thread sanitizer runs for two seconds, so that it is not worth optimising for.
run_preset tsan threads_tests "${sanitized[@]}" -DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O0 \
  -DPAPERPROOF_COMPARE=OFF -DPAPERPROOF_BOX2D=OFF -- --tests-regex '^threads_tests' </dev/null || status=1

for preset in tsan asan-ubsan release; do
  echo
  echo "== $preset"
  if [[ -f build/$preset/ctest.log ]]; then
    sed -n '/tests passed,/,$p' "build/$preset/ctest.log"
  else
    echo "was not built"
  fi
done
exit "$status"
