#!/usr/bin/env bash
# faulty_commands.sh ROOT BIN: commands.sh must refuse each of these, with the message behind the #.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
block=$(mktemp)
trap 'rm -f "$block"' EXIT
status=0
while read -r line; do
    echo "$line" >"$block"
    if said=$("$here/commands.sh" "$1" "$2" "$block" 2>&1) || [[ $said != *"${line#*# }"* ]]; then
        echo "not refused as it should be: $line: $said" >&2
        status=1
    fi
done <<'LINES'
./build.sh figure # knows no command
./build.sh test --fast # no option
limn rendr a.obj # knows no command
limn render a.obj --sppp 3 # no option
build/release/bin/fig19_none # no program
cmake --preset relese # no preset
limm --help # no program
LIMN=a examples/cluster/none.sh # no program examples/cluster/none.sh
if true # syntax error
LINES
exit $status
