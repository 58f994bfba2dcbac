#!/usr/bin/env bash
# Counts the instructions of three tasks in the dev profile, which the tests use. It fails if a count is more than 10
# % above the count in tests/bench/instructions.txt. Counts, unlike times, do not depend on other load, but they
# depend on the compiler. If the compiler is not the one named in the file, a message is printed and the tolerance is
# 20 %.
#
#   cargo build --locked && bash tests/bench/instructions.sh            compares
#   cargo build --locked && bash tests/bench/instructions.sh --accept   writes the current counts to the file
#
# Needs valgrind. The tasks are: the verdicts alone of structures of about ten blocks; a full check of a wall of about
# a hundred blocks; a check of four structures of about ten blocks, with figures as PNG.
set -euo pipefail
cd "$(dirname "$0")/../.."
export LC_ALL=C

program=${CARGO_TARGET_DIR:-target}/debug/drystone
kept=tests/bench/instructions.txt
[ -x "$program" ] || { echo "no $program: run cargo build first" >&2; exit 2; }
command -v valgrind >/dev/null || { echo "valgrind is not installed" >&2; exit 2; }

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# Structures of about ten blocks: stable, leaning too far, sliding.
mkdir "$folder/ten" "$folder/drawn"
for n in 8 9 10 11 12; do
    "$program" new arch --voussoirs "$n" -q -o "$folder/ten/arch-$n.json"
    "$program" new arch --voussoirs "$n" --thickness 0.2 -q -o "$folder/ten/thin-$n.json"
    "$program" new tower --blocks "$n" -q -o "$folder/ten/tower-$n.json"
    "$program" new tower --blocks "$n" --lean 0.2 -q -o "$folder/ten/leaning-$n.json"
done
for bricks in 2 3 4; do
    "$program" new wall --courses 4 --bricks "$bricks" -q -o "$folder/ten/wall-$bricks.json"
done
"$program" new wall --courses 10 --bricks 10 -q -o "$folder/hundred.json"

# For an unstable structure, drystone exits with 1, which is a valid answer. Codes above 1 are failures.
count() {
    local code=0
    valgrind --tool=cachegrind --cache-sim=no --cachegrind-out-file=/dev/null --log-file="$folder/log" "$@" \
        >"$folder/output" 2>&1 || code=$?
    if [ "$code" -gt 1 ]; then
        cat "$folder/output" "$folder/log" >&2
        return 1
    fi
    sed -n 's/.*I *refs: *//p' "$folder/log" | tr -d ,
}

ten=$(count "$program" batch "$folder/ten" -o "$folder/ten.ndjson" --jobs 1)
hundred=$(count "$program" check "$folder/hundred.json")
cp "$folder"/ten/{arch-10,tower-10,leaning-10,wall-2}.json "$folder/drawn"
figures=$(count "$program" batch "$folder/drawn" -o "$folder/drawn.ndjson" --jobs 1 --render "$folder/png" --format png)

compiler=$(rustc --version)
if [ "${1:-}" = --accept ]; then
    {
        echo "# Instructions in the dev profile; tests/bench/instructions.sh --accept writes this file."
        echo "compiler $compiler"
        printf '%s %s\n' ten "$ten" hundred "$hundred" figures "$figures"
    } >"$kept"
    cat "$kept"
    exit
fi

known() { sed -n "s/^$1 //p" "$kept"; }
most=10
if [ "$(known compiler)" != "$compiler" ]; then
    most=20
    echo "The counts in $kept were made with $(known compiler), and this is $compiler: the tolerance is $most %." >&2
    echo "On a commit that passes with the old compiler, --accept writes the counts of this compiler." >&2
fi
failed=0
for path in ten hundred figures; do
    before=$(known "$path")
    now=${!path}
    [ -n "$before" ] || { echo "$kept has no count of $path" >&2; exit 2; }
    awk -v path="$path" -v before="$before" -v now="$now" -v most="$most" 'BEGIN {
        change = 100 * (now / before - 1)
        printf "%-8s %8.1f million instructions, %+5.1f %% against %.1f\n", path, now / 1e6, change, before / 1e6
        exit change > most
    }' || failed=1
done
if [ "$failed" = 1 ]; then
    echo "A count is more than $most % above $kept. If the increase is justified, --accept writes the new counts." >&2
fi
exit "$failed"
