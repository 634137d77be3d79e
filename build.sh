#!/usr/bin/env bash
# Everything that is done with limn, on a fresh Debian 12 too: installs what is missing, builds, runs.
set -euo pipefail
caller=$PWD
cd "$(dirname "${BASH_SOURCE[0]}")"

usage() {
    cat >&2 <<'TEXT'
usage: ./build.sh COMMAND [--full] [MODEL.obj ...]
       ./build.sh queries [--full] [MODEL.obj ...]
       ./build.sh convergence [--size 400] [--scene NAME ...] [--peer NAME ...] [--again]
       ./build.sh compilers [--quick | --aarch64]
       ./build.sh sanitize asan|tsan|memcheck
       ./build.sh fuzz [load_film] [load_gltf] [load_image] [load_obj] [load_ply] [load_scene] [load_stl] [read_rays]
                       [--seconds N]
       ./build.sh release [--renew]

  figures      build limn and render the eighteen figures to a relMSE of 2e-3 into build/figures/, as EXR and PNG
  test         build and run the whole suite
  gallery      the pictures and figures of docs/gallery.md, with their seconds and errors
  convergence  speed against error beside Mitsuba, Cycles and LuxCore, then promise: docs/speed-against-error.md;
               --size 400: five of the scenes in larger pictures
  promise      how good limn's estimate of its error is, how often --error is kept: docs/speed-against-error.md
  accuracy     how often intersections are wrong, in limn and in others: docs/accuracy.md
  bench        rays a second beside Embree, scaling, growth, instruction counts: docs/performance.md
  queries      wrong answers and speeds of limn, embreex, Open3D, trimesh and CGAL: docs/queries.md
  compilers    the suite and its digests under g++ 12, clang 14 and clang 19: docs/checks.md; --quick: clang 19, in minutes;
               --aarch64: limn::core too, cross-built (adds Debian's packages of that architecture)
  sanitize     the suite under asan (with UBSan), tsan or memcheck: docs/checks.md
  fuzz         the readers of films, compiled scenes, pictures, models and rays on damaged files, half an hour each
  films        what checkpoints cost, how even shards are, how long a merge takes: docs/long-renders.md
  faults       killed renders, full disks, damaged films: docs/long-renders.md
  cluster      a render on a Slurm of two nodes here, one of which is lost: docs/long-renders.md (installs Slurm; root)
  mutants      faults that the suite must catch: docs/mutants.md
  docs         the API reference: build/docs/html/index.html
  release      whether all reports are of these sources, and claims true; --renew writes anew those that are not

--full takes the longer form if there is one; bench and queries measure the models too. Reports continue where they were
interrupted, as long as the sources stay the same.
TEXT
    exit 2
}

as_root() { if [[ $EUID -eq 0 ]]; then "$@"; else sudo "$@"; fi; }

# install_missing PACKAGE...: those that are not there yet; asks nothing. Other systems than Debian must have them.
install_missing() {
    local missing=() package architecture
    command -v dpkg-query >/dev/null || return 0
    for package in "$@"; do
        # PACKAGE:ARCHITECTURE is one of another; there may be packages of the same name.
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

# Compiler, what the libraries link and what the programs need.
program_packages=(
    g++ cmake ninja-build libopenimageio-dev libtinyobjloader-dev libstb-dev libtbb-dev libhwy-dev librandom123-dev libxxhash-dev
    libcli11-dev libfmt-dev nlohmann-json3-dev xplanet-images)

# And what the suite needs: the default targets are all of these.
install_needs() {
    install_missing "${program_packages[@]}" pkg-config python3 python3-dev python3-venv catch2 librapidcheck-dev \
        libboost-dev make parallel
}

# configure OPTION...: the usual build. g++ compiles in a tenth less time if it collects its garbage later.
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
        [[ $status -lt 128 ]] || exit "$status"  # interrupted: so is the whole
        failed=1
    done
    local exr png
    exr=$(find "$out" -name 'fig*.exr' -size +0 | wc -l)
    png=$(find "$out" -name 'fig*.png' -size +0 | wc -l)
    echo "$exr EXR and $png PNG in $out"
    [[ $failed -eq 0 && $exr -eq 18 && $png -eq 18 ]]
}

# fuzz [TARGET ...] [--seconds N]
fuzz() {
    local targets=() seconds=1800 target failed=0
    while [[ $# -gt 0 ]]; do
        case $1 in
            load_film | load_gltf | load_image | load_obj | load_ply | load_scene | load_stl | read_rays) targets+=("$1") ;;
            --seconds)
                [[ ${2:-} =~ ^[1-9][0-9]*$ ]] || usage
                seconds=$2
                shift
                ;;
            *) usage ;;
        esac
        shift
    done
    [[ ${#targets[@]} -gt 0 ]] || targets=(load_film load_gltf load_image load_obj load_ply load_scene load_stl read_rays)
    install_needs
    install_missing clang-14 libclang-rt-14-dev
    for target in "${targets[@]}"; do
        tests/fuzz/run.sh "$target" "$seconds" || failed=1
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

[[ $# -ge 1 ]] || usage
command=$1
shift
full=()
models=()
others=()
for option in "$@"; do
    if [[ $option == --full ]]; then
        full=(--full)
        export LIMN_FULL=1
    elif [[ $command =~ ^(bench|queries)$ && $option == *.obj ]]; then
        models+=("$(cd "$caller" && realpath -m "$option")")
    elif [[ $command =~ ^(convergence|compilers|sanitize|fuzz|release)$ ]]; then
        others+=("$option")
    else
        usage
    fi
done

case $command in
    figures) figures ;;
    test)
        build
        ctest --preset release
        ;;
    convergence)
        build
        install_missing python3 python3-venv python3-matplotlib python3-numpy python3-openimageio
        # Mitsuba is slow without; not every Debian has it.
        ! apt-cache show libllvm19 >/dev/null 2>&1 || install_missing libllvm19
        /usr/bin/python3 apps/bench/convergence.py "${others[@]}"
        # A part is for whoever looks at that part.
        [[ ${#others[@]} -gt 0 ]] || /usr/bin/python3 apps/bench/promise.py
        ;;
    promise)
        build
        /usr/bin/python3 apps/bench/promise.py
        ;;
    gallery)
        build
        install_missing git
        /usr/bin/python3 apps/bench/gallery.py
        ;;
    release)
        install_missing python3 git
        /usr/bin/python3 -B apps/bench/release.py "${full[@]}" "${others[@]}"
        ;;
    accuracy)
        install_missing libembree-dev python3 python3-matplotlib python3-numpy
        build
        /usr/bin/python3 apps/bench/accuracy.py "${full[@]}"
        ;;
    queries)
        install_missing python3-numpy libcgal-dev libgmp-dev libmpfr-dev
        build
        /usr/bin/python3 -B apps/bench/queries.py "${full[@]}" "${models[@]}"
        ;;
    compilers)  # builds trees of its own, as the next two do
        install_needs
        install_missing clang-14 clang-19 ccache
        if [[ " ${others[*]} " == *" --aarch64 "* ]]; then
            as_root dpkg --add-architecture arm64
            install_missing g++-aarch64-linux-gnu qemu-user {libtbb,libhwy,libtinyobjloader,librapidcheck}-dev:arm64
        fi
        /usr/bin/python3 -B tests/checks/compilers.py "${others[@]}"
        ;;
    sanitize)
        install_needs
        install_missing valgrind dpkg-dev ccache
        /usr/bin/python3 -B tests/checks/sanitize.py "${others[@]}"
        ;;
    mutants)
        install_needs
        install_missing ccache
        /usr/bin/python3 tests/mutants/run.py "${full[@]}"
        ;;
    films | faults | cluster)
        build
        install_missing python3 python3-numpy python3-openimageio
        case $command in
            films) /usr/bin/python3 -B apps/bench/films.py ;;
            faults)
                install_missing faketime
                /usr/bin/python3 -B tests/faults/run.py
                ;;
            cluster)
                install_missing slurm-wlm
                as_root env PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 tests/cluster/run.py
                ;;
        esac
        ;;
    fuzz) fuzz "${others[@]}" ;;
    docs) docs ;;
    bench)
        install_missing libembree-dev valgrind ccache python3 python3-matplotlib python3-numpy
        build
        /usr/bin/python3 apps/bench/performance.py "${full[@]}" "${models[@]}"
        ;;
    *) usage ;;
esac
