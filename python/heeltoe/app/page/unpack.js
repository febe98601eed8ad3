/**
 * Numbers that came as text (views/animation/page.py, packed).
 * @param {{kind: string, data: string}} packed
 * @returns {Float32Array}
 */
export function unpack(packed) {
  const bytes = Uint8Array.from(atob(packed.data), (each) => each.charCodeAt(0));
  return new Float32Array(bytes.buffer);
}
