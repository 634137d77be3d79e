#!/usr/bin/env bash
# Runs all commands of limn's development. Each installs the Debian packages that it needs, then builds and runs.
set -euo pipefail
caller=$PWD
cd "$(dirname "${BASH_SOURCE[0]}")"

usage() {
    cat >&2 <<'TEXT'
usage: ./build.sh COMMAND [OPTION ...]

  figures                         build limn and render the eighteen figures to a relMSE of 2e-3, as EXR and PNG: build/figures
  test [--full]                   build and run the whole suite; --full: more random cases
  gallery                         render the pictures of docs/gallery.md, with their seconds and errors
  docs                            build the API reference: build/docs/html/index.html

  bench [--full] [MODEL ...]      rays a second beside Embree, building, threads, growth; queries beside Open3D, trimesh and embreex
  accuracy [--full]               how often intersections are wrong, in limn and in others
  convergence [--size 400] [--scene NAME ...] [--peer NAME ...]
                                  seconds to an error beside Mitsuba, Cycles and LuxCore
  convergence --promise           how good limn's estimate of its error is, and how often --error is kept
  reliability [films|faults|cluster ...]
                                  what checkpoints cost; killed renders, full disks, damaged films; a lost node of a Slurm

  check [compilers [--quick|--aarch64] | asan | tsan | memcheck]
                                  the suite and its digests under g++ 12, clang 14 and clang 19; under a sanitizer
  fuzz [film|gltf|image|obj|ply|stl|rays ...] [--seconds N]
                                  the readers on damaged files, half an hour each
  mutants [ROOM ...] [--sample N] [--seed S]
                                  random faults in the sources of a room: which of them does the suite miss?
  against COMMIT [SCENE ...]      samples, rays and instructions of this commit over those of another

What is measured is written to build/results/NAME.json and NAME.html; docs/results.md has the numbers to decide by.
TEXT
    exit 2
}

as_root() { if [[ $EUID -eq 0 ]]; then "$@"; else sudo "$@"; fi; }

# install_missing PACKAGE... installs the packages that are not installed yet, without questions. It does nothing on
# systems without dpkg-query, where the user must install them.
install_missing() {
    local missing=() package architecture
    command -v dpkg-query >/dev/null || return 0
    for package in "$@"; do
        # A package of the same name may be installed for several architectures. Check that of PACKAGE:ARCHITECTURE, or
        # else the machine's.
        [[ $package == *:* ]] && architecture=${package#*:} || architecture=$(dpkg --print-architecture)
        dpkg-query -W -f='${Architecture} ${db:Status-Status}\n' "$package" 2>/dev/null |
            grep -Ex "(all|$architecture) installed" >/dev/null || missing+=("$package")
    done
    [[ ${#missing[@]} -gt 0 ]] || return 0
    echo "installing: ${missing[*]}" >&2
    as_root env DEBIAN_FRONTEND=noninteractive apt-get update -q >&2 </dev/null
    as_root env DEBIAN_FRONTEND=noninteractive \
        apt-get install -y -q --no-install-recommends "${missing[@]}" >&2 </dev/null
}

# Packages to build the library and the programs.
program_packages=(
    g++ cmake ninja-build libopenimageio-dev libtinyobjloader-dev libstb-dev libtbb-dev libhwy-dev librandom123-dev libxxhash-dev
    libcli11-dev libfmt-dev nlohmann-json3-dev xplanet-images)

# Installs what the default targets need, which include the suite.
install_needs() {
    install_missing "${program_packages[@]}" pkg-config python3 python3-dev python3-venv catch2 librapidcheck-dev \
        libboost-dev make parallel
}

# configure OPTION... configures the release build. g++ takes a tenth less time if it collects its garbage later.
configure() {
    local later=--param=ggc-min-heapsize=300000
    "${CXX:-c++}" -Werror "$later" -E -x c++ /dev/null >/dev/null 2>&1 || later=
    CXXFLAGS="${CXXFLAGS:-} $later" cmake --preset release "$@"
}

build() {
    install_needs
    configure -DLIMN_BUILD_TESTS=ON
    cmake --build --preset release
}

figures() {
    install_missing "${program_packages[@]}"
    configure -DLIMN_BUILD_TESTS=OFF
    cmake --build --preset release --target figures
    local out=build/figures program name status failed=0
    mkdir -p "$out"
    rm -f "$out"/fig*
    for program in build/release/bin/fig[0-9][0-9]_*; do
        name=$(basename "$program")
        "$program" --error 2e-3 -o "$out/$name.exr" -o "$out/$name.png" --report "$out/$name.json" </dev/null && continue
        status=$?
        echo "$name failed, exit status $status" >&2
        [[ $status -lt 128 ]] || exit "$status"  # a signal ended the program: end too
        failed=1
    done
    local exr png
    exr=$(find "$out" -name 'fig*.exr' -size +0 | wc -l)
    png=$(find "$out" -name 'fig*.png' -size +0 | wc -l)
    echo "$exr EXR and $png PNG in $out"
    [[ $failed -eq 0 && $exr -eq 18 && $png -eq 18 ]]
}

# fuzz [READER ...] [--seconds N] fuzzes each reader for N seconds. By default it fuzzes all, half an hour each.
fuzz() {
    local readers=() seconds=1800 reader failed=0
    # Read the arguments.
    while [[ $# -gt 0 ]]; do
        case $1 in
            film | gltf | image | obj | ply | stl | rays) readers+=("$1") ;;
            --seconds)
                [[ ${2:-} =~ ^[1-9][0-9]*$ ]] || usage
                seconds=$2
                shift
                ;;
            *) usage ;;
        esac
        shift
    done
    [[ ${#readers[@]} -gt 0 ]] || readers=(film gltf image obj ply stl rays)
    # Run the fuzzers.
    install_needs
    install_missing clang-14 libclang-rt-14-dev
    for reader in "${readers[@]}"; do
        tests/fuzz/run.sh "$reader" "$seconds" || failed=1
    done
    return "$failed"
}

docs() {
    install_missing doxygen doxygen-awesome-css
    rm -rf build/docs
    mkdir -p build/docs
    LIMN_DOCS=build/docs LIMN_VERSION=$(sed -n 's/^project(limn VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt) \
        doxygen docs/Doxyfile
    echo "build/docs/html/index.html"
}

# python SCRIPT [OPTION ...] runs a script by Debian's Python, which finds the packages below.
python() { /usr/bin/python3 -B "$@"; }
report_packages=(git python3 python3-markdown python3-matplotlib python3-numpy python3-openimageio)

# Check the arguments that no script checks.
[[ $# -ge 1 ]] || usage
command=$1
shift
case $command in
    figures | gallery | docs) [[ $# -eq 0 ]] || usage ;;
    test) [[ $# -eq 0 || $* == --full ]] || usage ;;
esac
[[ " $* " != *" --full "* ]] || export LIMN_FULL=1

# Run the command.
case $command in
    figures) figures ;;
    test)
        build
        ctest --preset release
        ;;
    gallery)
        build
        install_missing "${report_packages[@]}"
        python apps/bench/gallery.py
        ;;
    docs) docs ;;
    bench)
        install_missing libembree-dev python3-venv "${report_packages[@]}"
        build
        LIMN_CALLER=$caller python apps/bench/bench.py "$@"
        ;;
    accuracy)
        install_missing libembree-dev "${report_packages[@]}"
        build
        python apps/bench/accuracy.py "$@"
        ;;
    convergence)
        build
        install_missing python3-venv "${report_packages[@]}"
        # Mitsuba is slow without LLVM. Not every Debian has this version.
        ! apt-cache show libllvm19 >/dev/null 2>&1 || install_missing libllvm19
        python apps/bench/convergence.py "$@"
        ;;
    reliability)
        build
        install_missing faketime "${report_packages[@]}"
        [[ $# -gt 0 && " $* " != *" cluster "* ]] || install_missing slurm-wlm
        python apps/bench/reliability.py "$@"
        ;;
    check)  # the script builds limn itself
        install_needs
        install_missing clang-14 clang-19 ccache valgrind dpkg-dev "${report_packages[@]}"
        if [[ " $* " == *" --aarch64 "* ]]; then
            as_root dpkg --add-architecture arm64
            install_missing g++-aarch64-linux-gnu qemu-user {libtbb,libhwy,libtinyobjloader,librapidcheck}-dev:arm64
        fi
        python tests/checks/check.py "$@"
        ;;
    fuzz) fuzz "$@" ;;
    mutants)
        install_needs
        install_missing ccache binutils "${report_packages[@]}"
        python tests/checks/mutants.py "$@"
        ;;
    against)
        install_needs
        install_missing ccache valgrind "${report_packages[@]}"
        python apps/bench/against.py "$@"
        ;;
    *) usage ;;
esac
