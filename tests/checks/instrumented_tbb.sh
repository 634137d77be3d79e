#!/usr/bin/env bash
# Builds Debian's oneTBB with ThreadSanitizer, so that it sees how oneTBB's threads wait for each other.
# usage: instrumented_tbb.sh FOLDER; installed in FOLDER/installed
set -euo pipefail
mkdir -p "$1"
cd "$1"
rm -rf ./*
mkdir -p lists/partial sources
# The archives that are set up, for sources; whatever else apt is set up with stays as it is.
for list in /etc/apt/sources.list /etc/apt/sources.list.d/debian.*; do
    [[ -f $list ]] || continue
    case $list in
        *.sources) sed 's/^Types:.*/Types: deb-src/' "$list" >"sources/$(basename "$list")" ;;
        *.list) sed -n 's/^deb /deb-src /p' "$list" >"sources/$(basename "$list")" ;;
    esac
done
apt=(apt-get -q -o Dir::Etc::SourceList=/dev/null -o "Dir::Etc::SourceParts=$PWD/sources"
     -o "Dir::State::Lists=$PWD/lists" -o APT::Sandbox::User=root)
"${apt[@]}" update
"${apt[@]}" source --download-only onetbb
dpkg-source --no-check -x onetbb_*.dsc source
# -O1: as the rest. Its own warnings are not ours to mend.
cmake -S source -B build -G Ninja -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_FLAGS="-O1 -g" -DTBB_SANITIZE=thread \
    -DTBB_TEST=OFF -DTBB_STRICT=OFF -DCMAKE_INSTALL_PREFIX="$PWD/installed"
cmake --build build
cmake --install build
