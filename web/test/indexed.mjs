// PNG files of 256 colours, a third of what a browser writes: for the documentation's pictures.

import { deflateSync } from 'node:zlib';

/** The picture (a PNG, decoded by the page of a browser) in its 256 most frequent colours, the others as the nearest of these. */
export async function indexed(page, png) {
  const { width, height, text } = await page.evaluate(async (base64) => {
    const picture = Object.assign(new Image(), { src: `data:image/png;base64,${base64}` });
    await picture.decode();
    const pen = Object.assign(document.createElement('canvas'), { width: picture.width, height: picture.height }).getContext('2d');
    pen.drawImage(picture, 0, 0);
    const bytes = pen.getImageData(0, 0, picture.width, picture.height).data;
    let s = '';
    for (let i = 0; i < bytes.length; i += 32768) s += String.fromCharCode(...bytes.subarray(i, i + 32768));
    return { width: picture.width, height: picture.height, text: btoa(s) };
  }, png.toString('base64'));
  return encoded(width, height, Buffer.from(text, 'base64'));
}

function encoded(width, height, pixels) {
  const bins = new Map(); // by the upper five bits of each channel: { count, sum of each channel }
  const binOf = (i) => ((pixels[i] >> 3) << 10) | ((pixels[i + 1] >> 3) << 5) | (pixels[i + 2] >> 3);
  for (let i = 0; i < pixels.length; i += 4) {
    const key = binOf(i);
    const bin = bins.get(key) ?? bins.set(key, { count: 0, sum: [0, 0, 0] }).get(key);
    bin.count += 1;
    for (const k of [0, 1, 2]) bin.sum[k] += pixels[i + k];
  }
  for (const bin of bins.values()) bin.colour = bin.sum.map((s) => Math.round(s / bin.count));
  const palette = [...bins.values()].sort((a, b) => b.count - a.count).slice(0, 256).map((bin) => bin.colour);
  const distance = (a, b) => (a[0] - b[0]) ** 2 + (a[1] - b[1]) ** 2 + (a[2] - b[2]) ** 2;
  for (const bin of bins.values()) bin.index = palette.reduce((best, c, i) => (distance(c, bin.colour) < distance(palette[best], bin.colour) ? i : best), 0);
  const rows = Buffer.alloc((width + 1) * height); // each begins with its filter, 0
  for (let y = 0; y < height; y++) for (let x = 0; x < width; x++) rows[y * (width + 1) + 1 + x] = bins.get(binOf(4 * (y * width + x))).index;
  const head = Buffer.alloc(13);
  head.writeUInt32BE(width, 0);
  head.writeUInt32BE(height, 4);
  head.set([8, 3, 0, 0, 0], 8); // eight bits, a palette
  return Buffer.concat([Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]), chunk('IHDR', head), chunk('PLTE', Buffer.from(palette.flat())), chunk('IDAT', deflateSync(rows, { level: 9 })), chunk('IEND', Buffer.alloc(0))]);
}

function chunk(type, data) {
  const body = Buffer.concat([Buffer.from(type, 'latin1'), data]);
  const result = Buffer.alloc(body.length + 8);
  result.writeUInt32BE(data.length, 0);
  body.copy(result, 4);
  result.writeUInt32BE(crc(body), body.length + 4);
  return result;
}

/** The CRC-32 of PNG (polynomial 0xedb88320, reflected). */
function crc(bytes) {
  let c = 0xffffffff;
  for (const byte of bytes) {
    c ^= byte;
    for (let bit = 0; bit < 8; bit++) c = c & 1 ? (c >>> 1) ^ 0xedb88320 : c >>> 1;
  }
  return (c ^ 0xffffffff) >>> 0;
}
