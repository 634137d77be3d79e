#!/usr/bin/env bash
# links.sh ROOT TREE PAPER...: every file that a paper links to, shows, or names as `room/file` exists in ROOT, or in
# TREE, where the files are that the papers themselves spell out. `<room>` and the like stand for anything. Papers that
# show a program of the folder examples show it as it is.
set -euo pipefail
root=$1 tree=$2
shift 2
status=0

missing() {
    echo "$1: there is no $2" >&2
    status=1
}

for paper in "$@"; do
    folder=$(dirname "$paper")
    prose=$(awk '/^```/ { code = !code; next } !code' "$paper")
    while read -r target; do
        [[ $target == http*://* || -e $folder/${target%%#*} ]] || missing "$paper" "$target"
    done < <(grep -oE '\]\([^)]+\)' <<<"$prose" | sed 's/^](//; s/)$//')
    while read -r name; do
        pattern=$(sed 's/<[^>]*>/*/g' <<<"$name")
        compgen -G "$root/$pattern" >/dev/null || compgen -G "$tree/$pattern" >/dev/null || missing "$paper" "$name"
    done < <(grep -oE '`(\.ci|apps|cmake|docs|examples|include|lib|tests)/[^` ]*`' <<<"$prose" | tr -d '`')
done
for shown in README.md=minimal.cpp docs/queries.md=rays.cpp docs/python.md=rays.py; do
    program=$(<"$root/examples/${shown#*=}")
    [[ $(<"$root/${shown%=*}") == *"$program"* ]] || missing "${shown%=*}" "examples/${shown#*=} as it is"
done
exit $status
