#!/usr/bin/env bash
# Installs what is missing, builds and runs every test, then the same under the address and undefined behaviour
# sanitizers. The last lines are CTest's summaries. The exit status is 0 only if everything was built and passed.
#   tests/run.sh            all of it
#   tests/run.sh --quick    only the release build, without the tests that take long (CTest's label `slow`)
set -euo pipefail

quick=()
case ${1-} in
  "") ;;
  --quick) quick=(--label-exclude '^slow$') ;;
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

# Configures, builds and tests one preset; what follows its name is handed to CMake.
run_preset() {
  local preset=$1 log=build/$1/ctest.log
  cmake --preset "$preset" "${whole_build[@]}" "${@:2}" &&
    cmake --build --preset "$preset" --parallel "$jobs" &&
    ctest --preset "$preset" "${quick[@]}" --parallel "$jobs" --no-tests=error 2>&1 | tee "$log"
}

rm -f build/*/ctest.log
status=0
run_preset release </dev/null || status=1
if ((${#quick[@]})); then exit "$status"; fi
# Without line numbers, which take a sixth of the time to compile, and in few processes: the preset alone has the one, and
# a process for each test.
run_preset asan-ubsan -DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1 -DCMAKE_EXE_LINKER_FLAGS=-fuse-ld=lld \
  -DPAPERPROOF_TESTS_TOGETHER=ON </dev/null || status=1

for preset in asan-ubsan release; do
  echo
  echo "== $preset"
  if [[ -f build/$preset/ctest.log ]]; then
    sed -n '/tests passed,/,$p' "build/$preset/ctest.log"
  else
    echo "was not built"
  fi
done
exit "$status"
