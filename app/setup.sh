# shellcheck shell=bash disable=SC2034
# Functions shared by app/run and tests/run: install packages, configure, build. Both source this file and set
# -euo pipefail. `root` is the folder of the checkout.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

build_packages=(
  g++ cmake ninja-build ccache
  libeigen3-dev nlohmann-json3-dev libcli11-dev
  libcgal-dev libgmsh-dev libteem-dev libpugixml-dev zlib1g-dev libnlopt-dev libbullet-dev libseccomp-dev
  qt6-base-dev libqt6opengl6-dev qt6-svg-dev
)
# The version of clang-format that the sources follow: that of Debian 12.
format_version=14
# Needed to show a window on a minimal machine: a software driver for OpenGL, and fonts.
window_packages=(libgl1-mesa-dri fonts-dejavu-core)
test_packages=(librapidcheck-dev xvfb jwm ffmpeg clang-format doxygen python3 python3-jsonschema zsh fish)
check_packages=(clang-tidy python3)
# The Python module and its tests.
python_packages=(pybind11-dev python3-dev python3-numpy)
python_test_packages=(python3-pytest python3-distributed mypy)
# For packages: made by tests/package/check, and checked.
package_packages=(build-essential help2man dpkg-dev debhelper dh-python lintian desktop-file-utils appstream libxml2-utils debootstrap)
mutant_packages=(python3)
bench_packages=(libbenchmark-dev)
fuzz_packages=(clang libclang-rt-dev)

# Lets ccache reuse objects of other checkouts and earlier builds. The last two are needed for precompiled headers.
export CCACHE_BASEDIR=$root CCACHE_NOHASHDIR=1 CCACHE_SLOPPINESS=pch_defines,time_macros CCACHE_PCH_EXTSUM=1

say() { printf '%s\n' "$*"; }
fail() {
  printf '%s: %s\n' "${program:-setup}" "$*" >&2
  exit 1
}

# Installs those of the given packages that are missing.
need_packages() {
  local present='' package missing=()
  if command -v dpkg-query >/dev/null; then
    # An installed package may provide a name that has become virtual, such as libqt6opengl6-dev on Debian 13.
    present=" $(dpkg-query -W -f '${db:Status-Status} ${Package}, ${Provides}\n' | sed -n 's/^installed //p' |
      sed 's/ *([^)]*)//g' | tr -s ',\n' '  ') "
  fi
  for package in "$@"; do
    [[ $present == *" $package "* ]] || missing+=("$package")
  done
  [[ ${#missing[@]} -gt 0 ]] || return 0
  if ! command -v apt-get >/dev/null; then
    [[ -z ${CHAINMAIL_PACKAGES_PRESENT:-} ]] || return 0
    fail "apt-get was not found; install the contents of these Debian packages, then start again with" \
      "CHAINMAIL_PACKAGES_PRESENT=1: ${missing[*]}"
  fi
  install_packages "${missing[@]}"
}

install_packages() {
  local log=$root/build/setup.log apt=(env DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=300)
  if [[ $EUID -ne 0 ]]; then
    command -v sudo >/dev/null || fail "packages are missing and sudo was not found; run as root: apt-get install $*"
    apt=(sudo "${apt[@]}")
  fi
  mkdir -p "$root/build"
  say "Installing $# packages, which may take a few minutes: $*"
  # A package source that does not answer matters only if a missing package comes from it.
  "${apt[@]}" update >"$log" 2>&1 || true
  "${apt[@]}" install -y --no-install-recommends "$@" >>"$log" 2>&1 </dev/null || {
    grep '^E:' "$log" >&2 || tail -n 5 "$log" >&2
    fail "the packages could not be installed; see $log"
  }
}

# configure PRESET OPTION…: configures build/PRESET, unless it is already configured with these options.
# An OPTION that begins with ? applies only to a new build folder.
configure() {
  local preset=$1 folder=$root/build/$1 wanted=$root$'\n' present='' option options=() fresh=()
  shift
  for option in "$@"; do
    options+=("${option#\?}")
    [[ $option == \?* ]] || wanted+=" $option"
  done
  if [[ -e $folder/build.ninja && $root/CMakePresets.json -ot $folder/configured ]]; then
    present=$(<"$folder/configured")
    [[ "$present " != "$wanted "* ]] || return 0
    [[ $present == "$root"$'\n'* ]] || fresh=(--fresh) # the checkout has moved to another folder
  fi
  mkdir -p "$folder"
  rm -f "$folder/configured"
  say "Configuring $preset"
  (cd "$root" && cmake --preset "$preset" "${fresh[@]}" "${options[@]}") >"$folder/configure.log" 2>&1 || {
    grep -A 8 'CMake Error' "$folder/configure.log" >&2 || tail -n 8 "$folder/configure.log" >&2
    fail "$preset could not be configured; see $folder/configure.log"
  }
  printf '%s\n' "$root" " ${options[*]}" >"$folder/configured"
}

# build PRESET [TARGET…]: shows progress on a terminal, otherwise only errors. `builder` is a command that starts it.
builder=()
build() {
  local preset=$1 targets=() quiet=()
  shift
  [[ $# -eq 0 ]] || targets=(--target "$@")
  [[ -t 1 ]] || quiet=(-- --quiet)
  [[ -e $root/build/$preset/.ninja_log ]] || say "Building $preset, which takes a few minutes the first time"
  (cd "$root" && "${builder[@]}" cmake --build --preset "$preset" "${targets[@]}" "${quiet[@]}") ||
    fail "$preset could not be built; see the compiler's messages above"
}
