# Sourced by compare/run.sh and tests/run.sh: which Debian and Ubuntu packages this project needs, and how they get there.
# shellcheck shell=bash disable=SC2034  # the lists are used by the scripts that source this file

# To configure and build everything, tests and benchmarks included.
build_packages=(
  build-essential cmake ninja-build pkg-config
  libeigen3-dev                                        # controller
  libbox2d-dev                                         # box2d_adapter
  libpolyclipping-dev                                  # box2d_adapter/twin
  libboost-dev libcli11-dev libfmt-dev libmuparser-dev libpugixml-dev  # compare
  nlohmann-json3-dev zlib1g-dev libzstd-dev liblodepng-dev libjs-chart.js
  libgtest-dev  # tests
)
# To run every test.
test_packages=(
  clang          # the same bits from a second compiler, and the sanitizers
  supertux-data  # real levels
  python3 python3-gmpy2        # the checker of traces that shares no code with the project
  python3-jsonschema parallel  # schemas of what is written; shards over several processes
)
# Used by tests where the distribution has them: a browser, for the report (Ubuntu's is a snap), the sanitizers' part
# of clang (in older releases it comes with clang itself), the prover of bounds of rounding, and what draws pictures for
# documents (compare/plots.py).
optional_test_packages=(chromium libclang-rt-dev gappa python3-matplotlib)
# Of the engines of compare/peers those that Debian has, and npm for the others.
peer_packages=(libchipmunk-dev godot3-server)
command -v npm >/dev/null || peer_packages+=(nodejs npm)
# A compiler for Windows, and what runs its programs: for the one test that `tests/run.sh --windows` adds. 170 MB to download, half a minute to install.
windows_test_packages=(g++-mingw-w64-x86-64-posix wine64)

missing_packages() {
  local package
  for package in "$@"; do
    [[ $(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null) == installed ]] || echo "$package"
  done
}

# Installs what is missing of the packages named. When nothing is missing it needs neither root nor a network.
install_missing() {
  local missing as_root=()
  mapfile -t missing < <(missing_packages "$@")
  ((${#missing[@]})) || return 0
  if ! command -v apt-get >/dev/null; then
    echo "$0: no apt-get here; install by hand what these Debian packages hold: ${missing[*]}" >&2
    exit 2
  fi
  if ((EUID != 0)); then
    # Without a terminal nobody can type a password.
    if ! command -v sudo >/dev/null || { [[ ! -t 0 ]] && ! sudo -n true 2>/dev/null; }; then
      echo "$0: not root and no sudo; run first: apt-get install --no-install-recommends ${missing[*]}" >&2
      exit 2
    fi
    as_root=(sudo)
  fi
  local apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive NEEDRESTART_MODE=a
    apt-get --quiet --yes --option DPkg::Lock::Timeout=300)
  echo "installing ${missing[*]}"
  if [[ -z ${package_lists_are_fresh:-} ]]; then
    "${apt[@]}" update </dev/null
    package_lists_are_fresh=1
  fi
  "${apt[@]}" install --no-install-recommends "${missing[@]}" </dev/null
}

# The packages named that the distribution can install. Ubuntu's chromium would need snapd, which a container has not.
installable_packages() {
  local package
  for package in "$@"; do
    [[ $(apt-cache policy "$package" 2>/dev/null) =~ Candidate:\ [0-9] ]] && echo "$package"
  done
  return 0
}

# Installs the engines of compare/peers that npm has, below build/, with the module through which the peers import them.
install_peers() {
  cmp --silent compare/peers/package-lock.json build/peers/package-lock.json && [[ -f build/peers/engine.mjs ]] && return
  mkdir -p build/peers
  rm -f build/peers/engine.mjs
  cp compare/peers/package.json compare/peers/package-lock.json build/peers
  npm ci --prefix build/peers --no-audit --no-fund || return
  echo 'export const installed = (name) => import(name);' >build/peers/engine.mjs
}

# For whoever builds everything once: up to 32 sources at a time, which takes half as long. Most of what a source takes to
# compile are the headers of Eigen, Boost and the standard library.
whole_build=(-DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=32)

# One compiler per core, and no more than memory allows: the heaviest sources take 2 GB.
build_jobs() {
  local cores memory_kb
  cores=$(nproc)
  memory_kb=$(awk '/^MemAvailable:/ { print $2 }' /proc/meminfo)
  local by_memory=$((memory_kb / 2000000))
  ((by_memory < 1)) && by_memory=1
  echo $((cores < by_memory ? cores : by_memory))
}
