/**
 * Numbers that came as text (views/animation/page.py, packed).
 * @param {{kind: string, data: string}} packed
 * @returns {Float32Array}
 */
export function unpack(packed) {
  const text = atob(packed.data);
  const bytes = new Uint8Array(text.length);
  // Quicker than Uint8Array.from, for what is unpacked while a slider moves.
  for (let k = 0; k < text.length; k += 1) bytes[k] = text.charCodeAt(k);
  return new Float32Array(bytes.buffer);
}
