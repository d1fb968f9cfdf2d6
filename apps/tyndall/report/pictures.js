// SPDX-License-Identifier: Apache-2.0
// Pictures: from packed levels (picture_code.h) to colors on a canvas.
'use strict';

const INFERNO = [0x000004, 0x1b0c41, 0x4a0c6b, 0x781c6d, 0xa52c60, 0xcf4446, 0xed6925, 0xfb9b06,
  0xf7d13d, 0xfcffa4];
const NOT_A_NUMBER = 65535, INFINITE = 65534;
const clamp = (x, low, high) => Math.min(Math.max(x, low), high);

// t in [0, 1] to [r, g, b] bytes.
function inferno(t) {
  const x = clamp(t, 0, 1) * (INFERNO.length - 1), i = Math.min(Math.floor(x), INFERNO.length - 2);
  return [16, 8, 0].map(shift => {
    const a = (INFERNO[i] >> shift) & 255, b = (INFERNO[i + 1] >> shift) & 255;
    return Math.round(a + (b - a) * (x - i));
  });
}

// Blue below zero, white at zero, red above.
function blueWhiteRed(t) {
  const end = t < 0 ? [33, 102, 172] : [178, 24, 43], s = Math.min(Math.abs(t), 1);
  return end.map(c => Math.round(255 + (c - 255) * s));
}

async function inflate(id) {
  const text = document.getElementById(id).textContent.trim();
  const bytes = Uint8Array.from(atob(text), c => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// The inverse of pack_plane(): signed 16-bit numbers.
function unpackPlane(bytes, offset, width, count) {
  const values = new Int16Array(count);
  for (let i = 0; i < count; ++i) {
    const folded = bytes[offset + i] | bytes[offset + count + i] << 8;
    const difference = (folded >>> 1) ^ -(folded & 1);
    const left = i % width !== 0, above = i >= width;
    const prediction = left ? (above ? (values[i - 1] + values[i - width]) >> 1 : values[i - 1])
                            : (above ? values[i - width] : 0);
    values[i] = prediction + difference;
  }
  return values;
}

function srgb(x) {
  return x <= 0.0031308 ? 12.92 * x : 1.055 * Math.pow(x, 1 / 2.4) - 0.055;
}

function filmic(x) {
  return x > 1e4 ? 1 : x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
}

// One image of a scene, decoded on first use and painted once per look.
class Picture {
  constructor(info, scene) {
    this.name = info.name;
    this.info = info;
    this.scene = scene;
    this.canvas = null;
    this.look = '';
  }

  async load() {
    const {width, height} = this.scene, count = width * height;
    const bytes = await inflate(this.info.data);
    const green = unpackPlane(bytes, 0, width, count);
    const planes = [unpackPlane(bytes, 2 * count, width, count), green,
                    unpackPlane(bytes, 4 * count, width, count)];
    this.levels = planes.map((plane, c) => {
      const levels = new Uint16Array(count);
      for (let i = 0; i < count; ++i) levels[i] = c === 1 ? plane[i] : plane[i] + green[i];
      return levels;
    });
    if (this.info.flip) {
      this.flip = unpackPlane(await inflate(this.info.flip), 0, width, count);
    }
  }

  radiance(pixel) { return this.levels.map(plane => this.scene.radiance[plane[pixel]]); }

  // The canvas that shows this picture, or its error against `reference`, under `view`.
  paint(view, reference) {
    const look = [view.show, view.exposure, view.curve].join();
    if (this.canvas && this.look === look) return this.canvas;
    this.canvas ??= document.createElement('canvas');
    const {width, height} = this.scene;
    [this.canvas.width, this.canvas.height] = [width, height];
    const context = this.canvas.getContext('2d');
    const target = context.createImageData(width, height);
    const pixels = new Uint32Array(target.data.buffer);
    if (view.show === 'image') this.paintImage(pixels, view);
    else if (view.show === 'flip') this.paintFlip(pixels);
    else this.paintError(pixels, view, reference);
    context.putImageData(target, 0, 0);
    this.look = look;
    return this.canvas;
  }

  paintImage(pixels, view) {
    const table = this.scene.displayTable(view.exposure, view.curve), [r, g, b] = this.levels;
    for (let i = 0; i < pixels.length; ++i) {
      const bad = r[i] === NOT_A_NUMBER || g[i] === NOT_A_NUMBER || b[i] === NOT_A_NUMBER;
      pixels[i] = bad ? 0xffff00ff
                      : 0xff000000 | table[b[i]] << 16 | table[g[i]] << 8 | table[r[i]];
    }
  }

  // The mean over the pixels of an error, those left out where it is not a number.
  meanOf(show, reference) {
    this.means ??= {};
    return this.means[show] ??= mean(this.errors(show, reference));
  }

  *errors(show, reference) {
    const count = this.levels[0].length, value = this.scene.radiance;
    for (let i = 0; i < count; ++i) {
      if (show === 'flip') {
        yield this.flip[i] / 63;
        continue;
      }
      let sum = 0;
      for (let c = 0; c < 3; ++c) {
        const r = value[reference.levels[c][i]], d = value[this.levels[c][i]] - r;
        sum += show === 'relative' ? d * d / (r * r + this.scene.epsilon) : d;
      }
      yield sum / 3;
    }
  }

  paintFlip(pixels) {
    const colors = colorTable(64, inferno);
    for (let i = 0; i < pixels.length; ++i) pixels[i] = colors[this.flip ? this.flip[i] : 0];
  }

  paintError(pixels, view, reference) {
    const relative = view.show === 'relative', epsilon = this.scene.epsilon;
    const last = 254;  // even, so that white has the middle of blue to red
    const colors = colorTable(last + 1, relative ? inferno : t => blueWhiteRed(2 * t - 1));
    const value = this.scene.radiance, factor = Math.pow(2, view.exposure);
    for (let i = 0; i < pixels.length; ++i) {
      let sum = 0;
      for (let c = 0; c < 3; ++c) {
        const r = value[reference.levels[c][i]], d = value[this.levels[c][i]] - r;
        sum += relative ? d * d / (r * r + epsilon) : d * factor;
      }
      const t = relative ? (Math.log10(sum / 3) + 4) / 5 : 0.5 + sum / 3;
      pixels[i] = Number.isNaN(sum) ? 0xffff00ff : colors[Math.round(clamp(t, 0, 1) * last)];
    }
  }
}

function mean(values) {
  let sum = 0, count = 0;
  for (const x of values) {
    if (!Number.isFinite(x)) continue;
    sum += x;
    ++count;
  }
  return sum / count;
}

// `count` packed colors of a color map.
function colorTable(count, map) {
  return Uint32Array.from({length: count}, (_, i) => {
    const [r, g, b] = map(i / (count - 1));
    return 0xff000000 | b << 16 | g << 8 | r;
  });
}

// What the pictures of a scene share.
class Scene {
  constructor(info) {
    Object.assign(this, info);
    this.radiance = new Float32Array(65536);
    for (let i = 0; i < INFINITE; ++i) {
      this.radiance[i] = this.floor * (Math.pow(2, i / this.steps) - 1);
    }
    this.radiance[INFINITE] = Infinity;
    this.radiance[NOT_A_NUMBER] = NaN;
    this.pictures = info.pictures.map(p => new Picture(p, this));
    this.reference = this.pictures[0];
  }

  async load() { for (const picture of this.pictures) await picture.load(); }

  // Display byte by level.
  displayTable(exposure, curve) {
    const key = exposure + curve;
    if (this.tableKey === key) return this.table;
    const factor = Math.pow(2, exposure);
    this.table = new Uint8Array(65536).fill(255);
    for (let i = 0; i < INFINITE; ++i) {
      const x = this.radiance[i] * factor;
      if (curve === 'plain' && x >= 1 || x > 1e4) break;
      this.table[i] = Math.round(255 * srgb(clamp(curve === 'filmic' ? filmic(x) : x, 0, 1)));
    }
    this.tableKey = key;
    return this.table;
  }
}
