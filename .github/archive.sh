#!/usr/bin/env bash
# Packs the program with what belongs to it, and with further files beside the program:
# bash .github/archive.sh target/release drystone-v0.1.0-x86_64-unknown-linux-gnu interactive.js
set -euo pipefail
built=$1 name=$2
shift 2
program=$built/drystone
[ -x "$program" ] || program=$built/drystone.exe
mkdir -p "$name/completions" "$name/man"
cp "$program" "$@" README.md CHANGELOG.md LICENSE-MIT LICENSE-APACHE "$name"
"$program" completions bash >"$name/completions/drystone.bash"
"$program" completions zsh >"$name/completions/_drystone"
"$program" completions fish >"$name/completions/drystone.fish"
"$program" completions powershell >"$name/completions/_drystone.ps1"
"$program" man "$name/man"
tar czf "$name.tar.gz" "$name"
rm -r "$name"
