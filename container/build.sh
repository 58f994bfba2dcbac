#!/bin/sh
# Builds the program of the container's image: static, stripped, at target/container/drystone. Needs a Rust toolchain with
# a musl target, which Alpine's is by itself.
set -eu
cd "$(dirname "$0")/.."
host=$(rustc -vV | sed -n 's/^host: //p')
target=${1:-$(echo "$host" | sed 's/-gnu$/-musl/')}
CARGO_PROFILE_RELEASE_STRIP=symbols RUSTFLAGS="-C target-feature=+crt-static" \
    cargo build --locked --release --target "$target" --bin drystone
mkdir -p target/container
cp "target/$target/release/drystone" target/container/drystone
./target/container/drystone --version
