// SPDX-License-Identifier: Apache-2.0
// The viewer of one scene: one canvas in which the pictures lie over or beside one another.
'use strict';

class Viewer {
  constructor(element, scene) {
    this.element = element;
    this.scene = scene;
    this.view = {mode: scene.pictures.length > 2 ? 'split' : 'flip', show: 'image', exposure: scene.exposure,
                 curve: 'plain', zoom: 1, x: scene.width / 2, y: scene.height / 2, split: 0.5,
                 left: Math.min(1, scene.pictures.length - 1), right: scene.pictures.length - 1,
                 last: 0};
    this.pointers = new Map();
    this.buildControls();
    this.listen();
    this.resize();
    this.fit();
  }

  // --- the controls -----------------------------------------------------------------------

  buildControls() {
    const bar = document.createElement('div');
    bar.className = 'bar';
    this.buttons = [];
    this.group(bar, this.scene.pictures.map((p, i) =>
      [p.name, `show ${p.name} (key ${i || "r"})`, () => this.show(i), v => v.left === i]));
    this.group(bar, [['flip', 'f'], ['split', 's'], ['side by side', 'g']].map(([mode, key]) =>
      [mode, `${mode} (key ${key})`, () => this.set({mode}), v => v.mode === mode]));
    this.group(bar, [['blink', 'flip by itself (key b)', () => this.blink(),
                      () => Boolean(this.blinking)]]);
    bar.append(this.select('right', 'right of the split',
                           this.scene.pictures.map((p, i) => [i, 'right: ' + p.name]), Number));
    bar.append(this.select('show', 'image or error (key e)', [['image', 'image'],
      ['relative', 'relative square error'], ['difference', 'difference'], ['flip', 'HDR-FLIP']]));
    bar.append(this.select('curve', 'tone curve (key t)',
                           [['plain', 'clipped'], ['filmic', 'filmic']]));
    bar.append(this.range('exposure', -10, 10, 0.25, 'exposure'));
    bar.append(this.range('split', 0, 1, 0.005, 'split'));
    this.group(bar, [['fit', 'whole picture (key 0)', () => this.fit()],
                     ['1:1', 'one pixel per pixel (key p)', () => this.zoomTo(devicePixelRatio)],
                     ['?', 'help (key h)', () => toggleHelp()]]);
    this.canvas = document.createElement('canvas');
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute('role', 'img');
    this.status = document.createElement('div');
    this.status.className = 'status';
    this.legend = document.createElement('div');
    this.legend.className = 'legend';
    this.element.append(bar, this.canvas, this.legend, this.status);
    this.context = this.canvas.getContext('2d');
  }

  group(bar, entries) {
    const group = document.createElement('div');
    group.className = 'group';
    for (const [text, title, action, pressed] of entries) {
      const button = document.createElement('button');
      Object.assign(button, {textContent: text, title, onclick: action, type: 'button'});
      if (pressed) this.buttons.push([button, pressed]);
      group.append(button);
    }
    bar.append(group);
  }

  select(name, title, options, convert = String) {
    const select = document.createElement('select');
    select.title = title;
    select.setAttribute('aria-label', title);
    select.name = name;
    for (const [value, text] of options) select.add(new Option(text, value));
    select.value = this.view[name];
    select.onchange = () => this.set({[name]: convert(select.value)});
    (this.inputs ??= []).push([select, name]);
    return select;
  }

  range(name, min, max, step, text) {
    const label = document.createElement('label'), input = document.createElement('input');
    const number = document.createElement('output');
    Object.assign(input, {type: 'range', name, min, max, step, value: this.view[name]});
    input.oninput = () => this.set({[name]: Number(input.value)});
    label.append(text + ' ', input, number);
    (this.inputs ??= []).push([input, name, number]);
    return label;
  }

  // --- what is shown ----------------------------------------------------------------------

  set(change) {
    Object.assign(this.view, change);
    this.draw();
  }

  show(i) {
    if (!this.scene.pictures[i] || i === this.view.left) return;
    this.set({last: this.view.left, left: i});
  }

  flipBack() { this.show(this.view.last); }

  fit() {
    const {width, height} = this.scene, [w, h] = this.paneSize();
    this.set({zoom: Math.min(w / width, h / height), x: width / 2, y: height / 2});
  }

  zoomTo(zoom, x = this.view.x, y = this.view.y) {
    this.set({zoom: clamp(zoom, 0.05, 64), x, y});
  }

  // Zooms so that the image point under the canvas point stays.
  zoomAround(factor, px, py) {
    const [ix, iy] = this.imagePoint(px, py), v = this.view;
    const zoom = clamp(v.zoom * factor, 0.05, 64), f = v.zoom / zoom;
    this.set({zoom, x: ix + (v.x - ix) * f, y: iy + (v.y - iy) * f});
  }

  lookAt(x, y, size) {
    const [w, h] = this.paneSize();
    this.zoomTo(0.8 * Math.min(w, h) / size, x + size / 2, y + size / 2);
    this.element.scrollIntoView({block: 'nearest'});
  }

  // --- geometry, in canvas pixels ---------------------------------------------------------

  columns() {
    if (this.view.mode !== 'side by side') return 1;
    const n = this.scene.pictures.length, {width, height} = this.scene;
    let best = 1, size = 0;
    for (let c = 1; c <= n; ++c) {
      const s = Math.min(this.canvas.width / c / width,
                         this.canvas.height / Math.ceil(n / c) / height);
      if (s > size) [best, size] = [c, s];
    }
    return best;
  }

  panes() {
    const n = this.scene.pictures.length, {width, height} = this.canvas;
    if (this.view.mode !== 'side by side') {
      return [{x: 0, y: 0, w: width, h: height, picture: this.scene.pictures[this.view.left]}];
    }
    const columns = this.columns(), w = width / columns, h = height / Math.ceil(n / columns);
    return this.scene.pictures.map((picture, i) =>
      ({x: i % columns * w, y: Math.floor(i / columns) * h, w, h, picture}));
  }

  paneSize() {
    const pane = this.panes()[0];
    return [pane.w, pane.h];
  }

  paneAt(px, py) {
    const inside = p => px >= p.x && px < p.x + p.w && py >= p.y && py < p.y + p.h;
    return this.panes().find(inside) ?? this.panes()[0];
  }

  imagePoint(px, py) {
    const pane = this.paneAt(px, py), {x, y, zoom} = this.view;
    return [x + (px - pane.x - pane.w / 2) / zoom, y + (py - pane.y - pane.h / 2) / zoom];
  }

  resize() {
    const width = this.element.clientWidth, {width: w, height: h} = this.scene;
    const height = clamp(width * h / w, 180, Math.max(innerHeight * 0.7, 240));
    this.canvas.style.height = height + 'px';
    this.canvas.width = Math.round(width * devicePixelRatio);
    this.canvas.height = Math.round(height * devicePixelRatio);
  }

  // --- drawing ----------------------------------------------------------------------------

  draw() {
    if (this.scheduled) return;
    this.scheduled = requestAnimationFrame(() => {
      this.scheduled = 0;
      this.drawNow();
    });
  }

  drawNow() {
    const {context, view} = this, pictures = this.scene.pictures;
    context.fillStyle = '#000';
    context.fillRect(0, 0, this.canvas.width, this.canvas.height);
    for (const pane of this.panes()) this.drawPane(pane);
    if (view.mode === 'split') {
      const x = Math.round(view.split * this.canvas.width);
      this.drawPane({x: 0, y: 0, w: this.canvas.width, h: this.canvas.height,
                     picture: pictures[view.right], from: x});
      context.fillStyle = '#fff';
      context.fillRect(x - 1, 0, 2, this.canvas.height);
      context.fillRect(x - 7 * devicePixelRatio, this.canvas.height / 2 - 14,
                       14 * devicePixelRatio, 28);
    }
    this.updateControls();
  }

  drawPane({x, y, w, h, picture, from}) {
    const {context, view} = this, z = view.zoom;
    context.save();
    context.beginPath();
    context.rect(from ?? x, y, x + w - (from ?? x), h);
    context.clip();
    context.imageSmoothingEnabled = z < 1;
    context.fillStyle = '#000';
    context.fillRect(x, y, w, h);
    context.drawImage(picture.paint(view, this.scene.reference), x + w / 2 - view.x * z,
                      y + h / 2 - view.y * z, this.scene.width * z, this.scene.height * z);
    context.font = `${13 * devicePixelRatio}px system-ui, sans-serif`;
    const label = this.label(picture), size = context.measureText(label).width;
    const left = from === undefined ? x + 6 : x + w - size - 18;
    context.fillStyle = '#000a';
    context.fillRect(left, y + 6, size + 12, 21 * devicePixelRatio);
    context.fillStyle = '#fff';
    context.fillText(label, left + 6, y + 6 + 15 * devicePixelRatio);
    context.restore();
  }

  // The name, and the mean of the error that is shown.
  label(picture) {
    const {show} = this.view;
    if (show === 'image' || picture === this.scene.reference) return picture.name;
    const mean = picture.meanOf(show, this.scene.reference);
    return `${picture.name}: mean ${mean.toPrecision(3)}`;
  }

  // Flips between the picture and the last one by itself, until it is called again.
  blink() {
    if (this.blinking) {
      clearInterval(this.blinking);
      this.blinking = 0;
    } else {
      this.set({mode: 'flip'});
      this.blinking = setInterval(() => this.flipBack(), 400);
    }
    this.draw();
  }

  updateControls() {
    for (const [button, pressed] of this.buttons) {
      button.setAttribute('aria-pressed', pressed(this.view));
    }
    for (const [input, name, number] of this.inputs) {
      input.value = this.view[name];
      if (number) number.textContent = name === 'exposure' ? ' ' + this.view.exposure : '';
      const isSplit = name === 'split' || name === 'right';
      (number ? input.parentElement : input).hidden = isSplit && this.view.mode !== 'split';
    }
    const names = this.view.mode === 'flip' ? [this.view.left]
      : this.view.mode === 'split' ? [this.view.left, this.view.right] : [];
    this.canvas.setAttribute('aria-label', `${this.view.mode}: ` +
      (names.map(i => this.scene.pictures[i].name).join(' | ') || 'all pictures'));
    this.showLegend();
  }

  showLegend() {
    const scale = SCALES[this.view.show];
    if (this.legendOf === scale) return;
    this.legendOf = scale;
    this.legend.replaceChildren();
    if (!scale) return;
    const [title, map, texts] = scale, bar = document.createElement('div');
    const stops = Array.from({length: 17}, (_, i) => `rgb(${map(i / 16).join()})`);
    bar.className = 'scale';
    bar.style.background = `linear-gradient(90deg, ${stops.join()})`;
    const marks = document.createElement('div');
    marks.className = 'marks';
    marks.append(...texts.map(text => {
      const mark = document.createElement('span');
      mark.textContent = text;
      return mark;
    }));
    this.legend.append(title, bar, marks);
  }

  // --- mouse and fingers ------------------------------------------------------------------

  listen() {
    const c = this.canvas;
    c.onwheel = event => {
      event.preventDefault();
      this.zoomAround(Math.pow(2, -clamp(event.deltaY, -200, 200) / 200), ...this.place(event));
    };
    c.onpointerdown = event => this.grab(event);
    c.onpointermove = event => this.move(event);
    c.onpointerup = c.onpointercancel = event => this.release(event);
    c.onpointerleave = () => { this.status.textContent = ''; };
    c.ondblclick = () => this.fit();
    addEventListener('resize', () => {
      this.resize();
      this.draw();
    });
  }

  place(event) {
    const box = this.canvas.getBoundingClientRect();
    return [(event.clientX - box.left) * devicePixelRatio,
            (event.clientY - box.top) * devicePixelRatio];
  }

  grab(event) {
    const [x] = this.place(event);
    this.canvas.setPointerCapture(event.pointerId);
    this.canvas.focus({preventScroll: true});
    this.pointers.set(event.pointerId, this.place(event));
    const distance = Math.abs(x - this.view.split * this.canvas.width);
    this.slides = this.view.mode === 'split' && this.pointers.size === 1 &&
      distance < 16 * devicePixelRatio;
  }

  move(event) {
    const place = this.place(event), before = this.pointers.get(event.pointerId);
    if (!before) return this.tell(place);
    if (this.slides) {
      this.set({split: clamp(place[0] / this.canvas.width, 0, 1)});
    } else if (this.pointers.size === 2) {
      const other = [...this.pointers].find(([id]) => id !== event.pointerId)[1];
      const spread = p => Math.hypot(p[0] - other[0], p[1] - other[1]);
      this.zoomAround(spread(place) / Math.max(spread(before), 1), ...other);
    } else {
      this.set({x: this.view.x - (place[0] - before[0]) / this.view.zoom,
                y: this.view.y - (place[1] - before[1]) / this.view.zoom});
    }
    this.pointers.set(event.pointerId, place);
  }

  release(event) {
    this.pointers.delete(event.pointerId);
    this.slides = false;
  }

  // The values of all pictures under the pointer.
  tell(place) {
    const [x, y] = this.imagePoint(...place).map(Math.floor), {width, height} = this.scene;
    const inside = x >= 0 && y >= 0 && x < width && y < height;
    this.status.textContent = !inside ? '' : `pixel ${x}, ${y}   ` + this.scene.pictures.map(p => `${p.name} ` +
        p.radiance(y * width + x).map(v => v.toPrecision(3)).join(' ')).join('   ');
  }
}

// What false colors mean: a title, the color map over [0, 1], and texts along it.
const SCALES = {
  image: null,
  relative: ['relative square error', inferno, ['0.0001', '0.001', '0.01', '0.1', '1', '10']],
  difference: ['image minus reference, times 2^exposure', t => blueWhiteRed(2 * t - 1),
               ['-0.5', '0', '+0.5']],
  flip: ['HDR-FLIP: 0 is no visible difference', inferno, ['0', '0.5', '1']],
};
