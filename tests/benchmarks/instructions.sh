#!/usr/bin/env bash
# Instructions of a point-step, counted by valgrind: a slower kernel shows whatever else the machine does.
# Two runs that differ in their number of steps, so that setting up cancels; one thread.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

usage() {
  cat >&2 <<'TEXT'
Usage: tests/benchmarks/instructions.sh compare | record

  compare  count, and fail where there are over 5 % more than data/instructions.csv
           has for this compiler
  record   count, and put the numbers of this compiler into data/instructions.csv

Builds in build/instructions for x86-64-v3 (AVX2, FMA): valgrind knows no AVX-512.
TEXT
  exit 2
}

fail() {
  printf 'instructions.sh: %s\n' "$*" >&2
  exit 1
}

[ $# = 1 ] || usage
case $1 in compare | record) mode=$1 ;; *) usage ;; esac
command -v valgrind >/dev/null || fail "valgrind is missing (apt install valgrind)"

build=build/instructions
table=data/instructions.csv
flags=-march=x86-64-v3
allowed=1.05
few=10 many=40

mkdir -p $build
{
  cmake -S . -B $build -G Ninja -DCMAKE_BUILD_TYPE=Release -DSCARP_NATIVE=OFF -DSCARP_RENDER=OFF \
    -DBUILD_TESTING=ON "-DCMAKE_CXX_FLAGS=$flags" &&
    cmake --build $build --target scarp_steps -j "$(nproc)"
} >$build/log 2>&1 || { tail -n 40 $build/log >&2 && fail "the build failed: $build/log"; }
compiler=$("$(sed -n 's/^CMAKE_CXX_COMPILER:[^=]*=//p' $build/CMakeCache.txt)" --version |
  head -n 1 | sed 's/^[cg]++[^ ]* /gcc /' | tr ',' ' ')

# What valgrind says it has collected, and the program its number of points.
count() { # DIMENSION SHAPE TRANSFER STEPS
  OMP_NUM_THREADS=1 valgrind --tool=callgrind --callgrind-out-file=/dev/null $build/scarp_steps "$@" \
    2>$build/valgrind.log >$build/points || fail "valgrind failed: $build/valgrind.log"
  sed -n 's/.*Collected : //p' $build/valgrind.log
}

recorded() { # CONFIGURATION: the number of this compiler and these flags, if there is one
  [ -f $table ] || return 0
  awk -F, -v name="$1" -v compiler="$compiler" -v flags="$flags" \
    '$1 == name && $2 == compiler && $3 == flags { print $4 }' $table
}

rows=() worse=0 unknown=0
for configuration in "2 linear flip" "2 bspline flip" "2 bspline apic" "3 linear flip" "3 bspline flip" \
  "3 bspline apic"; do
  read -r dimension shape transfer <<<"$configuration"
  name="${dimension}-D $shape $transfer"
  first=$(count "$dimension" "$shape" "$transfer" $few)
  second=$(count "$dimension" "$shape" "$transfer" $many)
  points=$(<$build/points)
  now=$(awk -v a="$first" -v b="$second" -v n="$points" -v steps=$((many - few)) \
    'BEGIN { printf "%.1f", (b - a) / (n * steps) }')
  rows+=("$name,$compiler,$flags,$now")
  before=$(recorded "$name")
  if [ -z "$before" ]; then
    verdict="not recorded" unknown=$((unknown + 1))
  elif awk -v a="$now" -v b="$before" -v c=$allowed 'BEGIN { exit !(a > b * c) }'; then
    verdict="WORSE than $before" worse=$((worse + 1))
  else
    verdict="recorded: $before"
  fi
  printf '%-18s %9s instructions a point-step  %s\n' "$name" "$now" "$verdict"
done

if [ "$mode" = record ]; then
  {
    echo "# Instructions of a point-step by callgrind: tests/benchmarks/instructions.sh record"
    echo "configuration,compiler,flags,instructions_per_point_step"
    if [ -f $table ]; then
      awk -F, -v compiler="$compiler" -v flags="$flags" \
        '!/^#/ && $1 != "configuration" && !($2 == compiler && $3 == flags)' $table
    fi
    printf '%s\n' "${rows[@]}"
  } >$table.partial
  mv $table.partial $table
  echo "$table"
  exit 0
fi
[ $worse = 0 ] || fail "$worse of ${#rows[@]} need over 5 % more instructions; if that is meant: $0 record"
if [ $unknown != 0 ]; then echo "note: $table has $unknown of these not for $compiler"; fi
