// Opens scenes and drawings from files, and saves SVG, PNG and JSON files.

/** The largest file that is accepted, in bytes. */
const MOST = 20_000_000;

/** @type {Record<string, string>} */
const DRAWINGS = { svg: "svg", dxf: "dxf", geojson: "geojson", wkt: "wkt" };

/**
 * Reads a scene, or makes one from a drawing.
 * @param {File} file @param {import("./solver.js").Solver} solver
 * @returns {Promise<{ text: string, notes: string[] }>}
 */
export async function readFile(file, solver) {
  if (file.size > MOST) throw new Error("The file is larger than 20 MB.");
  const ending = file.name.split(".").at(-1)?.toLowerCase() ?? "";
  const format = DRAWINGS[ending];
  if (ending === "json") return { text: await file.text(), notes: [] };
  const isPicture = ending === "png" || ending === "pdf";
  if (!format && !isPicture) throw new Error("Only scenes (.json), drawings (.svg, .dxf, .geojson, .wkt) and figures (.png, .pdf) can be opened.");
  const answer = isPicture
    ? await solver.sceneIn(new Uint8Array(await file.arrayBuffer()))
    : await solver.importDrawing(await file.text(), format);
  if (!answer) throw new Error("Another file was opened.");
  if (answer.problems) throw new Error(answer.problems.map((problem) => problem.message).join(" "));
  if (answer.error) throw new Error(answer.error);
  if (isPicture) return { text: answer.value, notes: [] };
  const { scene, notes } = answer.value;
  const words = (Array.isArray(notes) ? notes : []).map((note) => (typeof note === "string" ? note : String(note?.message ?? "")));
  return { text: typeof scene === "string" ? scene : JSON.stringify(scene), notes: words };
}

/** @param {string} name @param {Blob} blob */
export function save(name, blob) {
  const link = document.createElement("a");
  link.download = name;
  link.href = URL.createObjectURL(blob);
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

/** A file name from the title of a scene: letters, digits and hyphens. @param {any} scene */
export function fileName(scene) {
  const title = typeof scene?.title === "string" ? scene.title : "";
  return title.normalize("NFKD").toLowerCase().replace(/[^a-z0-9]+/g, "-").replace(/^-+|-+$/g, "").slice(0, 60) || "scene";
}

/** Converts an SVG to a PNG. @param {string} svg @param {number} scale @returns {Promise<Blob>} */
export async function toPng(svg, scale) {
  const url = URL.createObjectURL(new Blob([svg], { type: "image/svg+xml" }));
  try {
    const image = new Image();
    image.src = url;
    await image.decode();
    const canvas = document.createElement("canvas");
    canvas.width = Math.min(8000, Math.round(image.naturalWidth * scale));
    canvas.height = Math.min(8000, Math.round((canvas.width / image.naturalWidth) * image.naturalHeight));
    canvas.getContext("2d")?.drawImage(image, 0, 0, canvas.width, canvas.height);
    return await new Promise((resolve, reject) => canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error("The picture is too large."))), "image/png"));
  } finally {
    URL.revokeObjectURL(url);
  }
}
