#!/bin/sh
# Prints the time and memory of a check of a thousand snapshots, and of other tools that compare the same thousand
# pairs of PNG files. Needs node with pixelmatch and pngjs installed in the folder $2, and `compare` of ImageMagick.
#   tests/bench/snapshots.sh target/release/drystone FOLDER_OF_NODE_MODULES
set -eu
drystone=$(realpath "$1")
modules=$(realpath "$2")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
mkdir scenes
printf 'widths = [560]\n' > scenes/drystone-snapshots.toml
i=0
while [ $i -lt 1000 ]; do
  cat > "scenes/s$i.json" <<END
{ "drystone": 1, "title": "Lintel $i", "friction": 0.6,
  "ground": [{ "polygon": [[-1, -1], [7, -1], [7, 0], [-1, 0]] }],
  "blocks": [
    { "id": "left", "polygon": [[0, 0], [1, 0], [1, 3], [0, 3]], "weight": 60 },
    { "id": "right", "polygon": [[5, 0], [6, 0], [6, 3], [5, 3]], "weight": 60 },
    { "id": "lintel", "polygon": [[0, 3], [6, 3], [6, 4], [0, 4]], "weight": $((100 + i)) } ] }
END
  i=$((i + 1))
done
"$drystone" snapshot scenes --accept -q
measured() {
  what=$1
  shift
  /usr/bin/time -f "$what: %e s, %U s of processor, %M kB at most" "$@"
}
measured "drystone, facts, SVG and pixels made and compared" "$drystone" snapshot scenes
printf 'widths = [560]\nlayers = ["facts"]\n' > scenes/drystone-snapshots.toml
rm -f scenes/*.svg
mkdir pictures
mv scenes/*.png pictures/
measured "drystone, facts alone" "$drystone" snapshot scenes
cat > "$modules/pairs.mjs" <<'END'
import fs from "node:fs";
import pixelmatch from "pixelmatch";
import { PNG } from "pngjs";
const folder = process.argv[2];
let differ = 0;
for (const name of fs.readdirSync(folder)) {
  const bytes = fs.readFileSync(`${folder}/${name}`);
  const [one, other] = [PNG.sync.read(bytes), PNG.sync.read(fs.readFileSync(`${folder}/${name}`))];
  // One value is changed, because pixelmatch returns at once for equal pictures.
  other.data[4000] ^= 64;
  differ += pixelmatch(one.data, other.data, null, one.width, one.height, { threshold: 0.1, includeAA: true }) > 0;
}
console.log(`${differ} differ`);
END
measured "pixelmatch, pixels read and compared" node "$modules/pairs.mjs" "$folder/pictures"
measured "compare of ImageMagick, pixels read and compared" sh -c \
  'for p in pictures/*.png; do compare -metric AE "$p" "$p" null: 2>/dev/null; done'
