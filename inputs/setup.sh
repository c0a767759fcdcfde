# SPDX-License-Identifier: GPL-2.0-or-later
# Shared by inputs/run, tests/run and .ci/format: what Furrow needs from Debian, and how it is
# built. Source it; it defines functions and variables only.

furrow_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
furrow_build=${FURROW_BUILD:-$furrow_root/build}

# To build and run.
furrow_packages="g++ cmake ninja-build liggghts libliggghts-dev libopenmpi-dev openmpi-bin libeigen3-dev libhdf5-dev
  libvtk9-dev libcgal-dev libassimp-dev libyaml-cpp-dev libfmt-dev libcli11-dev nlohmann-json3-dev libspectra-dev pybind11-dev
  python3 python3-dev python3-numpy python3-h5py python3-click python3-jinja2 python3-jsonschema python3-matplotlib python3-pandas
  python3-scipy python3-yaml libjs-three"
# To test as well.
furrow_test_packages="libgtest-dev libgmock-dev libbenchmark-dev mypy chromium-headless-shell
  ffmpeg python3-pip python3-setuptools python3-wheel python3-mpi4py python3-nbclient python3-ipykernel"
# For furrow-post surrogate and map.
furrow_map_packages="python3-sklearn python3-gdal"
# To build with sanitizers: gcc takes half an hour for the kernels then, and has no libFuzzer.
furrow_sanitizer_packages="clang libclang-rt-dev"
furrow_format_packages="clang-format python3"
# To build the site of all pages.
furrow_site_packages="python3-sphinx python3-myst-parser furo python3-sphinxcontrib.bibtex doxygen python3-breathe
  libjs-mathjax"

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

# More words for cmake, e.g. furrow_options=(-D FURROW_WERROR=ON)
furrow_options=()

# build_furrow <tests: ON|OFF> <target>...
build_furrow() {
  local tests=$1 log="$furrow_build/build.log"
  # Sixteen sources of a library at a time take half the time of one by one.
  local at_first=(-G Ninja -D CMAKE_UNITY_BUILD=ON -D CMAKE_UNITY_BUILD_BATCH_SIZE=16)
  shift
  mkdir -p "$furrow_build"
  echo "Building in $furrow_build"
  # A build folder that was configured keeps its generator, its way of compiling and its tests:
  # switching back and forth would compile for nothing.
  [ ! -f "$furrow_build/CMakeCache.txt" ] || at_first=()
  grep -qs 'FURROW_TESTS:BOOL=ON' "$furrow_build/CMakeCache.txt" && tests=ON
  [ -z "${FURROW_WERROR:-}" ] || furrow_options+=(-D FURROW_WERROR="$FURROW_WERROR")
  { cmake -S "$furrow_root" -B "$furrow_build" "${at_first[@]}" -D FURROW_TESTS="$tests" "${furrow_options[@]}" &&
      cmake --build "$furrow_build" --parallel "$(nproc)" --target "$@"; } >"$log" 2>&1 ||
    { show_build_errors "$log"; echo "The build failed; whole log: $log" >&2; exit 1; }
}

# show_build_errors <log>: what the compiler, the linker or CMake said, or the end of the log
show_build_errors() {
  { grep -E -A 4 'error:|undefined reference|ld returned|CMake Error' "$1" || tail -n 40 "$1"; } | head -n 60 >&2
}

# Open MPI refuses root and more ranks than cores unless it is configured. Bound ranks of two
# programs would wait for the same cores.
export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_btl_vader_single_copy_mechanism=none
export OMPI_MCA_hwloc_base_binding_policy=none
# Its hwloc searches displays, accelerators and disks at every start, a fifth of the time of a short run.
export HWLOC_PLUGINS_PATH=none HWLOC_COMPONENTS=-linuxio,-pci
[ "$(id -u)" -ne 0 ] || export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
