// Arrays of the data document: base64 of zlib-deflated little-endian numbers.

import { unzlibSync } from 'fflate';

const types = { f32: Float32Array, f64: Float64Array, i16: Int16Array, u32: Uint32Array };
const decoded = new WeakMap();

/** The numbers of an array of the document, row-major; null for an absent one. Decoded at its first use, then kept. */
export function numbers(array) {
  if (!array) return null;
  if (!decoded.has(array)) decoded.set(array, decode(array));
  return decoded.get(array);
}

function decode({ type, shape, deflate, shuffled }) {
  const Type = types[type];
  if (!Type) throw new Error(`an array of the unknown type "${type}"`);
  const count = shape.reduce((product, n) => product * n, 1);
  const bytes = unzlibSync(fromBase64(deflate), { out: new Uint8Array(count * Type.BYTES_PER_ELEMENT) });
  if (bytes.length !== count * Type.BYTES_PER_ELEMENT) throw new Error(`an array of ${shape.join(' × ')} ${type} holds ${bytes.length} bytes`);
  return new Type((shuffled ? gather(bytes, Type.BYTES_PER_ELEMENT) : bytes).buffer);
}

/** Undoes a shuffle: all first bytes of the numbers, then all second bytes, ...; smooth numbers deflate better so. */
function gather(bytes, width) {
  const result = new Uint8Array(bytes.length);
  const count = bytes.length / width;
  for (let b = 0; b < width; b++) for (let i = 0; i < count; i++) result[i * width + b] = bytes[b * count + i];
  return result;
}

function fromBase64(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const characters = atob(text);
  const bytes = new Uint8Array(characters.length);
  for (let i = 0; i < bytes.length; i++) bytes[i] = characters.charCodeAt(i);
  return bytes;
}

/** The document itself, from the page's data element. */
export function readDocument() {
  const data = JSON.parse(document.getElementById('data').textContent);
  if (data.schema !== 1) throw new Error(`a data document of schema ${data.schema}; this page reads schema 1`);
  return data;
}
