#!/usr/bin/env bash
# Runs ./bootstrap.sh in a bare Debian 12 made for it, with an empty environment.
#
#   tests/clean_root.sh [--worktree] [--dir DIR] [demo | test | paraview]...
#
# Without a name: demo, then test, in the same root.  DIR/base (default: scarp-clean-root in the
# folder for temporary files) is made once with debootstrap and kept; DIR/root is a fresh copy of it
# for this run with what is committed (--worktree: what is in the work tree) in DIR/root/scarp, and
# stays for a look afterwards.  Needs root, debootstrap and git.
set -euo pipefail
project=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
release=bookworm
directory=${TMPDIR:-/tmp}/scarp-clean-root
worktree=
names=()

fail() {
  printf 'clean_root.sh: %s\n' "$*" >&2
  exit 2
}

while [ $# -gt 0 ]; do
  case "$1" in
    --worktree) worktree=yes ;;
    --dir)
      directory=${2:?--dir needs a folder}
      shift
      ;;
    demo | test | paraview) names+=("$1") ;;
    *) fail "unknown: $1 (see the top of the file)" ;;
  esac
  shift
done
[ ${#names[@]} -gt 0 ] || names=(demo test)
[ "$(id -u)" = 0 ] || fail "needs root"
command -v debootstrap >/dev/null || fail "needs debootstrap"
base=$directory/base
root=$directory/root

# This machine's archives of the release, if it has them: one "URI suite component..." a line.
# shellcheck disable=SC2016 # apt's own $(NAME)
archives() {
  apt-get indextargets --format '$(REPO_URI) $(RELEASE) $(COMPONENT)' 'Created-By: Packages' |
    awk -v release="$release" 'index($2, release) == 1'
}

make_base() {
  rm -rf "$base" "$base.partial"
  mkdir -p "$directory"
  local mirror
  mirror=$(archives | awk -v release="$release" '$2 == release { print $1; exit }')
  debootstrap --variant=minbase "$release" "$base.partial" ${mirror:+"$mirror"}
  rm -rf "$base.partial"/var/lib/apt/lists/* "$base.partial"/var/cache/apt/*.bin
  mv "$base.partial" "$base"
}

# How this machine reaches the archives: sources, proxy, tolerance of its clock, name server.
copy_network() {
  archives | sed 's/^/deb /' >"$directory/sources.list"
  if [ -s "$directory/sources.list" ]; then
    cp "$directory/sources.list" "$root/etc/apt/sources.list"
  fi
  {
    apt-config dump | grep -Ei '^Acquire::(https?|Check-[a-z-]+|Retries)\b' || true
    if [ -n "${http_proxy:-}" ]; then printf 'Acquire::http::Proxy "%s";\n' "$http_proxy"; fi
  } >"$root/etc/apt/apt.conf.d/99machine"
  cp -L /etc/resolv.conf "$root/etc/resolv.conf"
}

copy_project() {
  mkdir "$root/scarp"
  if [ -n "$worktree" ]; then
    git -C "$project" ls-files -z --cached --others --exclude-standard |
      tar -C "$project" --null --files-from - --ignore-failed-read -c
  else
    git -C "$project" archive HEAD
  fi | tar -x --no-same-owner -C "$root/scarp"
}

with_time() {
  local line
  while IFS= read -r line; do printf '%(%H:%M:%S)T %s\n' -1 "$line"; done
}

# The mounts live in a mount namespace of their own, so they end with the command.
run_inside() { # NAME
  env -i "$(command -v unshare)" --mount --pid --fork --kill-child --mount-proc="$root/proc" \
    "$(command -v chroot)" "$root" /bin/bash -c "cd /scarp && exec ./bootstrap.sh $1" </dev/null 2>&1 |
    with_time
}

if ! [ -d "$base" ]; then make_base; fi
rm -rf "$root"
cp -a "$base" "$root"
copy_network
copy_project
for name in "${names[@]}"; do
  began=$SECONDS
  printf '== ./bootstrap.sh %s in %s\n' "$name" "$root"
  status=0
  run_inside "$name" || status=$?
  printf '== ./bootstrap.sh %s: exit code %d after %d s\n' "$name" "$status" $((SECONDS - began))
  [ "$status" = 0 ] || exit "$status"
done
