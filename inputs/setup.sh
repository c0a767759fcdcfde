# SPDX-License-Identifier: GPL-2.0-or-later
# Shared by inputs/run and tests/run: what Furrow needs from Debian, and how it is built. Source it; it defines functions only.

furrow_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
furrow_build=${FURROW_BUILD:-$furrow_root/build}

# To build and run.
furrow_packages="g++ cmake ninja-build liggghts libliggghts-dev libopenmpi-dev openmpi-bin libeigen3-dev libhdf5-dev
  libvtk9-dev libyaml-cpp-dev libfmt-dev libcli11-dev nlohmann-json3-dev python3 python3-numpy python3-h5py python3-matplotlib
  python3-scipy"
# To test besides.
furrow_test_packages="libgtest-dev libgmock-dev libbenchmark-dev mypy"

# install_packages <package>...: those that are missing, from Debian, once
install_packages() {
  local missing=() package
  for package in "$@"; do
    dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q "ok installed" || missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return
  local as_root=""
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || { echo "These Debian packages are missing; install them as root: ${missing[*]}" >&2; exit 1; }
    as_root=sudo
  fi
  echo "Installing from Debian: ${missing[*]}"
  local log
  log=$(mktemp)
  $as_root apt-get update >"$log" 2>&1 &&
    $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "${missing[@]}" >>"$log" 2>&1 ||
    { tail -20 "$log" >&2; echo "apt-get could not install: ${missing[*]} (whole log: $log)" >&2; exit 1; }
  rm -f "$log"
}

# build_furrow <tests: ON|OFF> <target>...
build_furrow() {
  local tests=$1 log="$furrow_build/build.log"
  shift
  mkdir -p "$furrow_build"
  echo "Building in $furrow_build"
  # A build folder that was configured with tests keeps them: switching back and forth would compile for nothing.
  grep -qs 'FURROW_TESTS:BOOL=ON' "$furrow_build/CMakeCache.txt" && tests=ON
  { cmake -S "$furrow_root" -B "$furrow_build" -G Ninja -DFURROW_TESTS="$tests" && cmake --build "$furrow_build" --target "$@"; } >"$log" 2>&1 ||
    { grep -E "error|Error" "$log" | head -20 >&2; tail -5 "$log" >&2; echo "The build failed; whole log: $log" >&2; exit 1; }
}

# Open MPI refuses root and more ranks than cores unless told; ranks that wait should give way where cores are shared.
export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_btl_vader_single_copy_mechanism=none
[ "$(id -u)" -ne 0 ] || export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
