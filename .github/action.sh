#!/usr/bin/env bash
# The work of action.yml: installs drystone, compares the scenes of a repository with their references, and writes a
# report on the scenes that differ from the commit BASE. Runs in the repository; SCENES is the folder of its scenes, and
# OUT the folder of the pages. Without the variables of GitHub it does the same on any machine.
set -euo pipefail
here=$(cd "$(dirname "$0")/.." && pwd)
scenes=${SCENES:-scenes}
mkdir -p "${OUT:=drystone-pages}"
out=$(cd "$OUT" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# The program: what is installed, else that of the release which `uses:` names, else built from the sources here.
if ! command -v drystone >/dev/null; then
    case "$(uname -sm)" in
        "Linux x86_64") target=x86_64-unknown-linux-musl ;;
        "Linux aarch64") target=aarch64-unknown-linux-musl ;;
        "Darwin arm64") target=aarch64-apple-darwin ;;
        "Darwin x86_64") target=x86_64-apple-darwin ;;
        *) target=x86_64-pc-windows-msvc ;;
    esac
    name=drystone-${ACTION_REF:-none}-$target
    address=${GITHUB_SERVER_URL:-https://github.com}/${ACTION_REPOSITORY:-}/releases/download/${ACTION_REF:-}/$name.tar.gz
    if [ -n "${ACTION_REPOSITORY:-}" ] && curl -fsSL "$address" -o "$work/program.tar.gz"; then
        tar xzf "$work/program.tar.gz" -C "$work"
        PATH=$work/$name:$PATH
    else
        cargo install --locked --quiet --path "$here" --root "$work"
        PATH=$work/bin:$PATH
    fi
fi

code=0
drystone snapshot "$scenes" --github --review "$out/snapshots.html" --summary "$out/summary.md" || code=$?

# What changed since BASE: both versions of each changed scene, and a report that compares them.
if [ -n "${BASE:-}" ] && { git cat-file -e "$BASE^{commit}" || git fetch --quiet --depth=1 origin "$BASE"; } 2>/dev/null; then
    mkdir "$work/before" "$work/after"
    git diff --name-only --no-renames -z "$BASE" -- "$scenes" | while IFS= read -r -d '' file; do
        [[ $file == *.json ]] || continue
        mkdir -p "$work/before/$(dirname "$file")" "$work/after/$(dirname "$file")"
        git show "$BASE:$file" >"$work/before/$file" 2>/dev/null || rm "$work/before/$file"
        [ ! -f "$file" ] || cp "$file" "$work/after/$file"
    done
    # Without a scene in both versions there is nothing to compare.
    (cd "$work" && drystone report --compare before after -o "$out/changes.html") || true
fi

if [ -f "$out/summary.md" ]; then
    # GitHub shows no pictures of the machine on which a job runs.
    sed '/^| old | new | difference |$/,/^$/d' "$out/summary.md" | tee -a "${GITHUB_STEP_SUMMARY:-/dev/null}"
fi
exit "$code"
