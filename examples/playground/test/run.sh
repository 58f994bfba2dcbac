#!/usr/bin/env bash
# Tests the playground in Chromium, with mouse and keyboard as a user would. Needs pkg/ (see build.sh), Node.js with npm, and Chromium.
# usage: examples/playground/test/run.sh [FILE.mjs …]
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../../.." && pwd)
tools=${PLAYGROUND_TOOLS:-$root/target/playground-tools}

[ -f "$here/../pkg/drystone.js" ] || { echo "pkg/ is missing: run examples/playground/build.sh first" >&2; exit 2; }

# Exact versions, so that the same sources give the same result.
if [ ! -d "$tools/node_modules/playwright-core" ]; then
    mkdir -p "$tools"
    (cd "$tools" && npm install --silent --no-save --no-package-lock --prefix . playwright-core@1.65.1)
fi
# Debian 12 has Node.js 18, which is too old for the tests.
if [ "$(node -p 'process.versions.node.split(".")[0]')" -lt 20 ]; then
    if [ ! -x "$tools/node/package/bin/node" ]; then
        mkdir -p "$tools/node"
        name=node-linux-$(node -p process.arch)
        (cd "$tools/node" && npm pack --silent "$name@20.19.5" && tar xzf "$name-20.19.5.tgz" && rm "$name-20.19.5.tgz")
    fi
    export PATH=$tools/node/package/bin:$PATH
fi
axe=$root/target/axe/package/axe.min.js
if [ ! -f "$axe" ]; then
    mkdir -p "$root/target/axe"
    (cd "$root/target/axe" && npm pack --silent axe-core@4.14.1 && tar xzf axe-core-4.14.1.tgz)
fi

export PLAYGROUND_TOOLS=$tools PLAYGROUND_AXE=$axe PLAYGROUND_SHOTS=${PLAYGROUND_SHOTS:-$root/target/playground-shots}
mkdir -p "$PLAYGROUND_SHOTS"
files=("$@")
[ ${#files[@]} -gt 0 ] || files=("$here"/*.mjs)
# Run the tests one after the other, so that a measurement does not wait for another browser.
exec node --test --test-concurrency=1 --test-reporter=spec "${files[@]}"
