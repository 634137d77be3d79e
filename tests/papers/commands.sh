#!/usr/bin/env bash
# commands.sh ROOT BIN BLOCK...: checks the shell commands of papers without running them. bash must be able to parse
# them; programs, commands of ours, options of ours and presets must exist.
set -euo pipefail
root=$1 bin=$2
shift 2
cd "$root"

fail() {
    echo "$block: $*" >&2
    exit 1
}

# has_option TEXT OPTION: whether a help text knows an option.
has_option() { grep -qE -- "(^|[[:space:],[])$2([[:space:],=]|\]|$)" <<<"$1"; }

check_options() {
    local help=$1 word
    shift
    for word in "$@"; do
        [[ $word != -?* ]] || has_option "$help" "${word%%=*}" || fail "there is no option $word"
    done
}

check_build() {
    local usage
    usage=$(./build.sh 2>&1 || true)
    grep -qE "^  ${1:-} " <<<"$usage" || fail "build.sh knows no command '${1:-}'"
    check_options "$usage" "${@:2}"
}

check_program() {
    local program=$bin/$1 help command=()
    shift
    [[ -x $program ]] || fail "there is no program $program"
    if [[ $program == */limn && ${1:-} != -* ]]; then
        command=("${1:-}")
        shift
    fi
    help=$("$program" "${command[@]}" --help 2>&1) || fail "$program knows no command ${command[*]}"
    check_options "$help" "$@"
}

check_preset() {
    local program=$1 previous='' word
    shift
    for word in "$@"; do
        [[ $previous != --preset ]] || "$program" --list-presets | grep -q "\"$word\"" || fail "no preset $word"
        previous=$word
    done
}

check_commands() {
    local words
    while read -ra words; do
        while [[ ${words[0]:-} =~ ^[A-Z_]+= ]]; do words=("${words[@]:1}"); done
        [[ ${#words[@]} -gt 0 ]] || continue
        case ${words[0]} in
            ./build.sh) check_build "${words[@]:1}" ;;
            build/release/bin/* | limn) check_program "${words[0]##*/}" "${words[@]:1}" ;;
            cmake | ctest) check_preset "${words[@]}" ;;
            *) command -v "${words[0]}" >/dev/null || fail "there is no program ${words[0]}" ;;
        esac
    done
}

for block in "$@"; do
    bash -n "$block"
    sed 's/#.*//; s/&&/\n/g; s/[|;]/\n/g' "$block" | check_commands
done
