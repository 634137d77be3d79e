#!/usr/bin/env bash
# Everything that is done with limn, on a fresh Debian 12 too: installs what is missing, builds, runs.
set -euo pipefail
caller=$PWD
cd "$(dirname "${BASH_SOURCE[0]}")"

usage() {
    cat >&2 <<'TEXT'
usage: ./build.sh COMMAND [--full] [MODEL.obj ...]
       ./build.sh convergence [--full] [--scene NAME ...] [--peer NAME ...] [--reuse] [--again]
       ./build.sh fuzz [load_image] [load_obj] [--seconds N]

  figures      render the eighteen figures to a relMSE of 2e-3 into build/figures/, as EXR and PNG
  test         build and run the whole suite
  convergence  speed against error beside Mitsuba, Cycles and LuxCore: docs/speed-against-error.md
  accuracy     how often intersections are wrong, here and elsewhere: docs/accuracy.md
  bench        rays a second beside Embree, scaling, growth, instruction counts: docs/performance.md
  mutants      faults that the suite must catch
  fuzz         the readers of pictures and models on damaged files, half an hour each
  docs         the API reference: build/docs/html/index.html

--full takes the longer form where there is one; bench measures the models too.
TEXT
    exit 2
}

# install_missing PACKAGE...: those that are not there yet; asks nothing. Other systems than Debian must have them.
install_missing() {
    local missing=() package
    command -v dpkg-query >/dev/null || return 0
    for package in "$@"; do
        [[ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)" == installed ]] ||
            missing+=("$package")
    done
    [[ ${#missing[@]} -gt 0 ]] || return 0
    echo "installing: ${missing[*]}" >&2
    local as_root=()
    [[ $EUID -eq 0 ]] || as_root=(sudo)
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update -q >&2 </dev/null
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
        apt-get install -y -q --no-install-recommends "${missing[@]}" >&2 </dev/null
}

# Compiler, what the libraries link, and what programs and suite need: the default targets are all of these.
install_needs() {
    install_missing \
        g++ cmake ninja-build pkg-config python3 \
        libopenimageio-dev libtinyobjloader-dev libstb-dev libtbb-dev libhwy-dev librandom123-dev \
        libcli11-dev libfmt-dev nlohmann-json3-dev \
        catch2 librapidcheck-dev libboost-dev xplanet-images
}

build() {
    install_needs
    cmake --preset release
    cmake --build --preset release
}

figures() {
    build
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
            load_image | load_obj) targets+=("$1") ;;
            --seconds)
                [[ ${2:-} =~ ^[1-9][0-9]*$ ]] || usage
                seconds=$2
                shift
                ;;
            *) usage ;;
        esac
        shift
    done
    [[ ${#targets[@]} -gt 0 ]] || targets=(load_image load_obj)
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
    elif [[ $command == bench && $option == *.obj ]]; then
        models+=("$(cd "$caller" && realpath -m "$option")")
    elif [[ $command == convergence || $command == fuzz ]]; then
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
        /usr/bin/python3 apps/bench/convergence.py "${full[@]}" "${others[@]}"
        # Unless a part alone was asked for.
        [[ ${#others[@]} -gt 0 ]] || /usr/bin/python3 apps/bench/promise.py "${full[@]}"
        ;;
    accuracy)
        install_missing libembree-dev python3 python3-matplotlib python3-numpy
        [[ ${#full[@]} -eq 0 ]] || install_missing clang-19 ccache
        build
        /usr/bin/python3 apps/bench/accuracy.py "${full[@]}"
        ;;
    mutants)  # builds a tree of its own
        install_needs
        install_missing ccache
        /usr/bin/python3 tests/mutants/run.py "${full[@]}"
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
