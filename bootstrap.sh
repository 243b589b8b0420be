#!/usr/bin/env bash
# Sets up, builds and runs scarp on a bare Debian 12: no display, no GPU, nothing but apt is assumed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
export PATH # bash has a default where the environment has none

usage() {
  cat >&2 <<'TEXT'
Usage: ./bootstrap.sh demo | test | paraview

  demo      install what is missing, build, and reproduce the collapse of a pile
            of aluminium rods (Bui et al. 2008) in demo/bui2008/
  test      install what is missing and run every check: formatting, compiler
            warnings, clang-tidy, sanitizers, tests
  paraview  install ParaView and let it read back the series of the demo

Each is safe to repeat.  Only Debian packages are installed, and only those
missing, as root or through sudo.
TEXT
}

program_packages=(g++ cmake ninja-build libvtk9-dev libosmesa6-dev libtomlplusplus-dev libcli11-dev
  nlohmann-json3-dev libfmt-dev libeigen3-dev fonts-dejavu-core)
# clang-tidy takes omp.h from libomp-dev; parallel and chromium are for end-to-end tests.
test_packages=(libgtest-dev libbenchmark-dev ccache clang-format clang-tidy libomp-dev parallel chromium)

logs=build/log
demo=demo/bui2008
processors=$(nproc)
if [ -t 1 ]; then on_terminal=yes; else on_terminal=; fi

fail() {
  printf '\n%s: %s\n' bootstrap.sh "$*" >&2
  exit 1
}

clock() { printf '%d:%02d' $((SECONDS / 60)) $((SECONDS % 60)); }

say() { printf '[%s] %s\n' "$(clock)" "$*"; }

# Reports with the line that a command prints, at once on a terminal, else twice a minute.
watch() { # DESCRIPTION COMMAND ...
  local seconds=0
  while sleep 1; do
    seconds=$((seconds + 1))
    if [ -n "$on_terminal" ]; then
      printf '\r\033[K%.79s' "[$(clock)] $1: $("${@:2}")"
    elif [ $((seconds % 30)) = 0 ]; then
      say "  ... $("${@:2}")"
    fi
  done
}

# Runs a command with a watch over it.
watched() { # DESCRIPTION COMMAND ... -- COMMAND ...
  local report=() status=0 id
  while [ "$1" != -- ]; do
    report+=("$1")
    shift
  done
  shift
  watch "${report[@]}" 2>/dev/null &
  id=$!
  # shellcheck disable=SC2064 # the id of this watch
  trap "kill $id 2>/dev/null || true" EXIT
  "$@" || status=$?
  kill "$id" 2>/dev/null || true
  wait "$id" 2>/dev/null || true
  trap - EXIT
  return "$status"
}

last_line() { # LOG
  tail -c 1000 "$1" | tr '\r' '\n' | grep -v 'warnings generated' | tail -n 1 | tr -cd '[:print:]' |
    cut -c 1-100
}

# The end of a log without what went well.
show_failure() { # LOG
  grep -vE '^\[[0-9]+/[0-9]+\] Build|^clang-tidy-|warnings generated|^ +Start |  Passed  ' "$1" |
    tail -n 150 >&2
}

logged() { # LOG COMMAND ...
  "${@:2}" >"$1" 2>&1 </dev/null
}

# Runs a command as one stage.  What it prints goes to a log, which is shown if it fails.
stage() { # NAME DESCRIPTION COMMAND ...
  local log=$logs/$1.log what=$2 began=$SECONDS status=0
  shift 2
  mkdir -p "$logs"
  : >"$log"
  if [ -n "$on_terminal" ]; then printf '[%s] %s' "$(clock)" "$what"; else say "$what ..."; fi
  watched "$what" last_line "$log" -- logged "$log" "$@" || status=$?
  if [ -n "$on_terminal" ]; then printf '\r\033[K'; fi
  if [ "$status" != 0 ]; then
    show_failure "$log"
    fail "exit code $status from: $what (all of its output: $log)"
  fi
  say "$what: done in $((SECONDS - began)) s"
}

as_root() {
  if [ "$(id -u)" = 0 ]; then "$@"; else sudo "$@"; fi
}

apt_install() {
  as_root apt-get update -o Acquire::Retries=3 &&
    as_root env DEBIAN_FRONTEND=noninteractive \
      apt-get install -y --no-install-recommends -o Acquire::Retries=3 "$@"
}

install_missing() { # PACKAGE ...
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    fail "this is no Debian-like system (no dpkg-query or apt-get); it needs: $*"
  fi
  local package missing=()
  for package in "$@"; do
    dpkg-query -W -f '${Status}\n' "$package" 2>/dev/null | grep -q '^install ok installed$' ||
      missing+=("$package")
  done
  if [ ${#missing[@]} = 0 ]; then
    say "packages: all $# installed"
    return
  fi
  if [ "$(id -u)" != 0 ]; then
    command -v sudo >/dev/null ||
      fail "run as root, or install sudo; packages are missing: ${missing[*]}"
    sudo -v || fail "sudo refused; packages are missing: ${missing[*]}"
  fi
  say "packages missing: ${missing[*]}"
  stage packages "install them" apt_install "${missing[@]}"
}

set_up() { # PACKAGE ...
  local system
  # shellcheck source=/dev/null
  system=$(. /etc/os-release 2>/dev/null && echo "${ID:-} ${VERSION_ID:-}") || true
  if [ "$system" != "debian 12" ]; then
    say "note: made for Debian 12; this is ${system:-another system}"
  fi
  install_missing "$@"
}

build_program() {
  stage configure "configure build/ (Release)" cmake --preset release -DBUILD_TESTING=OFF
  stage build "build build/scarp" cmake --build build --target scarp -j "$processors"
}

frames_written() { echo "$(find "$demo" -name '*.vtp' 2>/dev/null | wc -l) frames"; }

reproduce() {
  local command=(build/scarp reproduce bui2008 --out "$demo" --cell 0.0025)
  say "run ${command[*]}"
  if [ -n "$on_terminal" ]; then
    "${command[@]}" # shows its progress itself
  else
    watched "run" frames_written -- "${command[@]}"
  fi
}

check_format() {
  find core io render apps tests \( -name '*.cpp' -o -name '*.hpp' \) -print0 |
    xargs -0 clang-format --dry-run -Werror
}

run_demo() {
  set_up "${program_packages[@]}"
  build_program
  reproduce
  say "finished.  Look at:"
  find "$demo" -type f ! -name '*.vtp' | LC_ALL=C sort | sed 's/^/  /'
}

run_tests() {
  set_up "${program_packages[@]}" "${test_packages[@]}"
  stage format "check formatting (clang-format)" check_format
  stage configure "configure build/ (Release, warnings are errors)" cmake --preset ci
  stage build "build program and tests" cmake --build --preset ci -j "$processors"
  stage sanitize-configure "configure build/sanitize/ (sanitizers, sources joined)" cmake --preset sanitize
  stage tidy "check sources (clang-tidy)" cmake --build build/sanitize --target tidy
  stage sanitize-build "build unit and image tests with address and undefined-behaviour sanitizers" \
    cmake --build --preset sanitize -j "$processors"
  stage sanitize "run them" ctest --preset sanitize
  say "logs of these stages: $logs/; pictures that differ: build/tests/image/results/"
  say "run all tests of build/ (ctest --preset ci)"
  exec ctest --preset ci
}

# Debian's python3-paraview conflicts with libvtk9-dev, so it is unpacked, not installed; with pvbatch
# beside it, which looks for its modules there before it looks among those of VTK.
unpack_paraview() { # DIRECTORY
  rm -rf "$1" && mkdir -p "$1" && as_root apt-get update -o Acquire::Retries=3 &&
    (cd "$1" && apt-get download python3-paraview && dpkg-deb -x python3-paraview_*.deb .) &&
    cp /usr/bin/pvbatch "$1/usr/bin/"
}

run_paraview() {
  local paraview=build/paraview
  set_up "${program_packages[@]}" paraview
  if ! [ -x $paraview/usr/bin/pvbatch ]; then
    stage paraview "unpack ParaView's Python modules in $paraview/" unpack_paraview $paraview
  fi
  build_program
  if ! [ -f "$demo/run.json" ]; then reproduce; fi
  say "let ParaView read $demo (pvbatch tests/end_to_end/paraview_reads_series.py $demo)"
  $paraview/usr/bin/pvbatch tests/end_to_end/paraview_reads_series.py "$demo"
}

case "$#:${1:-}" in
  1:demo) run_demo ;;
  1:test) run_tests ;;
  1:paraview) run_paraview ;;
  *)
    usage
    exit 2
    ;;
esac
