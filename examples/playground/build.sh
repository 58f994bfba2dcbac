#!/usr/bin/env bash
# Compiles the library for browsers into examples/playground/pkg/, as a package for npm: drystone.js,
# drystone_bg.wasm, and declarations for TypeScript; with Node.js also interactive.js, the script of interactive
# reports. Does not compile if pkg/ was already built from the same sources.
#
# usage: examples/playground/build.sh [--debian]
#
# Needs a Rust toolchain from rustup, with the component rust-src, because the standard library is compiled for size
# as well. If rustup cannot fetch this component, its target wasm32-unknown-unknown is used, and the module is larger.
# If rustup can fetch neither, or with --debian, the compiler of Debian's packages is unpacked in target/, but not
# installed.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
cd "$root"
pkg=$here/pkg
wasm=wasm32-unknown-unknown
target=${CARGO_TARGET_DIR:-$root/target}
tools=$target/wasm-tools
debian=$target/wasm-toolchain

# The files on which the result depends.
inputs() { find Cargo.toml Cargo.lock src assets/fonts/advances.bin examples/playground/build.sh -type f | LC_ALL=C sort; }
key=$(inputs | xargs -d '\n' sha256sum | sha256sum | cut -c 1-16)
if [ -f "$pkg/drystone_bg.wasm" ] && [ "$(cat "$pkg/sources" 2>/dev/null)" = "$key" ]; then
    echo "pkg/ was already built from these sources"
    ! command -v node >/dev/null || node "$here/interactive.mjs"
    exit 0
fi

# The version of the program that writes the JavaScript must be exactly that of the crate.
version=$(sed -n '/^name = "wasm-bindgen"$/{n;s/version = "\(.*\)"/\1/p}' Cargo.lock)
bindgen=$tools/bin/wasm-bindgen
if [ "$("$bindgen" --version 2>/dev/null)" != "wasm-bindgen $version" ]; then
    # Do not use --locked, because its lock file names a crate that no longer exists.
    cargo install --quiet wasm-bindgen-cli --version "$version" --root "$tools"
fi

# Unpacks Debian's compiler, with its libraries and the sources of the standard library.
unpack_debian() {
    [ ! -f "$debian/complete" ] || return 0
    rm -rf "$debian"
    mkdir -p "$debian/root"
    (
        cd "$debian"
        named() { apt-cache depends "$1" | sed -n "s/.*Depends: \($2\)\$/\1/p" | sort -u; }
        library=$(named libstd-rust-web-dev 'libstd-rust-web-[0-9.]*')
        llvm=$(named "$library" 'libllvm[0-9]*')
        apt-get download rustc-web rust-web-src libstd-rust-web-dev "$library" "$llvm"
        for file in *.deb; do dpkg -x "$file" root; done
        rm ./*.deb
        touch complete
    )
}

arguments=(rustc --locked --lib --crate-type cdylib --profile web --target "$wasm" --no-default-features --features wasm)
# These options make the module smaller. The standard library is compiled for size, because its compiled form sorts
# every type with a separate copy of a large function. Messages of internal errors contain no positions in the
# sources, because the command-line program reports the same errors with their positions.
small_std=(-Z build-std=std,panic_abort -Z build-std-features=optimize_for_size)
export CARGO_ENCODED_RUSTFLAGS=-Zlocation-detail=none
has_component() { rustup component list --installed | grep -qx "$1" || rustup component add "$1"; }
if [ "${1:-}" != --debian ] && has_component rust-src; then
    RUSTC_BOOTSTRAP=1 cargo "${arguments[@]}" "${small_std[@]}" --target-dir "$target/wasm-std"
    made=$target/wasm-std/$wasm/web/drystone.wasm
elif [ "${1:-}" != --debian ] && { rustup target list --installed | grep -qx "$wasm" || rustup target add "$wasm"; }; then
    CARGO_ENCODED_RUSTFLAGS='' cargo "${arguments[@]}" --target-dir "$target"
    made=$target/$wasm/web/drystone.wasm
else
    unpack_debian
    linker=$(find "$(rustc --print sysroot)/lib/rustlib" -name rust-lld -type f | head -n 1)
    RUSTC=$debian/root/usr/bin/rustc RUSTC_BOOTSTRAP=1 LD_LIBRARY_PATH=$debian/root/usr/lib/x86_64-linux-gnu \
        CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER=$linker \
        cargo "${arguments[@]}" "${small_std[@]}" --target-dir "$target/wasm-debian"
    made=$target/wasm-debian/$wasm/web/drystone.wasm
fi

rm -rf "$pkg"
"$bindgen" --target web --remove-name-section --remove-producers-section --out-dir "$pkg" --out-name drystone "$made"
cp LICENSE-MIT LICENSE-APACHE "$pkg"
number=$(sed -n 's/^version = "\(.*\)"$/\1/p' Cargo.toml | head -n 1)
cat > "$pkg/package.json" <<JSON
{
  "name": "drystone",
  "version": "$number",
  "description": "Decides whether a structure of dry-laid blocks stands, finds its forces, and draws figures.",
  "license": "MIT OR Apache-2.0",
  "type": "module",
  "main": "drystone.js",
  "types": "drystone.d.ts",
  "files": ["drystone.js", "drystone_bg.wasm", "drystone.d.ts", "drystone_bg.wasm.d.ts", "interactive.js", "LICENSE-MIT", "LICENSE-APACHE"],
  "sideEffects": false
}
JSON
echo "$key" > "$pkg/sources"
file=$pkg/drystone_bg.wasm
printf 'drystone_bg.wasm: %d bytes, %d with gzip\n' "$(wc -c < "$file")" "$(gzip -9 -c "$file" | wc -c)"
if command -v node >/dev/null; then
    node -e 'const z = require("zlib"); const packed = z.brotliCompressSync(require("fs").readFileSync(process.argv[1])); console.log(`${packed.length} with brotli`)' "$file"
    node "$here/interactive.mjs"
fi
