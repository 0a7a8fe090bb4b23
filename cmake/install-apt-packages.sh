#!/bin/sh
# Installs those Debian packages of the list in $1 that are missing, with sudo unless we are root.
set -eu

if ! command -v dpkg-query >/dev/null; then
  echo "This is not Debian or Ubuntu: please provide what $1 lists by other means." >&2
  exit 0
fi

missing=""
while read -r package; do
  status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
  case " $status " in *' installed '*) continue ;; esac
  missing="$missing $package"
done <"$1"
[ -n "$missing" ] || exit 0

sudo=""
if [ "$(id -u)" != 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "As root, please run: apt-get install$missing" >&2
    exit 1
  fi
  sudo=sudo
fi

echo "Installing:$missing"
$sudo apt-get -q -o DPkg::Lock::Timeout=600 update
# shellcheck disable=SC2086 # a list of words
$sudo env DEBIAN_FRONTEND=noninteractive apt-get -q -y --no-install-recommends \
  -o DPkg::Lock::Timeout=600 install $missing
