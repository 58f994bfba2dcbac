// Stores the whole scene in the link: compressed, in the part after the #, which browsers never send to a server.

/** The largest size of an unpacked link, in bytes, so that a small link cannot fill the memory. */
const MOST = 4_000_000;

/** @param {string} text @returns {Promise<string>} the part after the # */
export async function packed(text) {
  const stream = new Blob([text]).stream().pipeThrough(new CompressionStream("deflate-raw"));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  let binary = "";
  for (const byte of bytes) binary += String.fromCharCode(byte);
  return `s=${btoa(binary).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "")}`;
}

/** @param {string} hash with or without # @returns {Promise<string | null>} the scene, or null if the link contains none */
export async function unpacked(hash) {
  const match = /^#?s=([\w-]+)$/.exec(hash);
  if (!match) return null;
  const binary = atob(match[1].replaceAll("-", "+").replaceAll("_", "/"));
  const bytes = Uint8Array.from(binary, (c) => c.charCodeAt(0));
  const reader = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw")).getReader();
  const decoder = new TextDecoder();
  let text = "";
  let size = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) return text + decoder.decode();
    size += value.length;
    if (size > MOST) {
      await reader.cancel();
      throw new Error("The link holds more than four megabytes.");
    }
    text += decoder.decode(value, { stream: true });
  }
}
