#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Installs the Debian packages of debian-packages.txt that are missing, and nothing else. With
# groups as arguments (build, test) only those groups.
# Does nothing in a moment when all are there. Exit status 1: something is missing and cannot be
# installed here; the message names it.
set -euo pipefail

list=$(dirname "$0")/debian-packages.txt
packages=()
group=
while read -r word; do
  case $word in
    '' | '#'*) ;;
    '['*) group=${word//[][]/} ;;
    *) [[ $# == 0 || " $* " == *" $group "* ]] && packages+=("${word%% *}") ;;
  esac
done < "$list"

if ! command -v dpkg-query > /dev/null; then
  echo "setup: this is not a Debian system; install what these packages hold yourself:" >&2
  echo "  ${packages[*]}" >&2
  exit 0  # CMake says what it does not find
fi

installed=$(dpkg-query -W -f='${db:Status-Status} ${binary:Package}\n' "${packages[@]}" 2> /dev/null |
  sed -n 's/^installed \([^:]*\).*/\1/p' || true)
missing=()
for package in "${packages[@]}"; do
  grep -qxF "$package" <<< "$installed" || missing+=("$package")
done
((${#missing[@]} == 0)) && exit 0

explain() {
  echo "setup: $1" >&2
  echo "Missing Debian packages: ${missing[*]}" >&2
  echo "As root: apt-get update && apt-get install --no-install-recommends ${missing[*]}" >&2
  exit 1
}

if [ "$(id -u)" = 0 ]; then
  as_root=(env)
elif command -v sudo > /dev/null && { sudo -n true 2> /dev/null || [ -t 0 ]; }; then
  as_root=(sudo env)
else
  explain "cannot install packages: not root, and sudo is not there or wants a password"
fi
command -v apt-get > /dev/null || explain "cannot install packages: there is no apt-get"

echo "setup: installing ${missing[*]}"
as_root+=(DEBIAN_FRONTEND=noninteractive apt-get -o Dpkg::Use-Pty=0 -qq)
"${as_root[@]}" update || explain "apt-get update failed"
"${as_root[@]}" install -y --no-install-recommends "${missing[@]}" > /dev/null ||
  explain "apt-get install failed"
