// SPDX-License-Identifier: Apache-2.0
// Starts the viewers and gives them the keys.
'use strict';

const viewers = [];

function toggleHelp() {
  const help = document.getElementById('help');
  help.open ? help.close() : help.showModal();
}

// The viewer that keys act on: the focused one, or the one nearest to the middle of the window.
function activeViewer() {
  const distance = v => {
    const box = v.canvas.getBoundingClientRect();
    return Math.abs((box.top + box.bottom) / 2 - innerHeight / 2);
  };
  return viewers.find(v => v.element.contains(document.activeElement)) ??
    [...viewers].sort((a, b) => distance(a) - distance(b))[0];
}

function next(list, value, step = 1) {
  return list[(list.indexOf(value) + step + list.length) % list.length];
}

const KEYS = {
  f: v => v.set({mode: 'flip'}),
  s: v => v.set({mode: 'split'}),
  g: v => v.set({mode: 'side by side'}),
  e: v => v.set({show: next(Object.keys(SCALES), v.view.show)}),
  t: v => v.set({curve: next(['plain', 'filmic'], v.view.curve)}),
  r: v => v.view.left === 0 ? v.flipBack() : v.show(0),
  ' ': v => v.flipBack(),
  ArrowRight: v => v.show(next([...v.scene.pictures.keys()], v.view.left)),
  ArrowLeft: v => v.show(next([...v.scene.pictures.keys()], v.view.left, -1)),
  ']': v => v.set({exposure: Math.min(v.view.exposure + 0.5, 10)}),
  '[': v => v.set({exposure: Math.max(v.view.exposure - 0.5, -10)}),
  '.': v => v.set({split: Math.min(v.view.split + 0.05, 1)}),
  ',': v => v.set({split: Math.max(v.view.split - 0.05, 0)}),
  '+': v => v.zoomTo(v.view.zoom * 1.5),
  '=': v => v.zoomTo(v.view.zoom * 1.5),
  '-': v => v.zoomTo(v.view.zoom / 1.5),
  p: v => v.zoomTo(devicePixelRatio),
  '0': v => v.fit(),
  b: v => v.blink(),
  h: () => toggleHelp(),
  '?': () => toggleHelp(),
};

function onKey(event) {
  const typing = event.target.matches?.('input, select, textarea') && event.key !== 'Escape';
  const viewer = activeViewer();
  if (typing || !viewer || event.ctrlKey || event.metaKey || event.altKey) return;
  const digit = /^Digit([1-9])$/.exec(event.code);
  if (digit) {
    const i = Number(digit[1]);
    event.shiftKey ? viewer.scene.pictures[i] && viewer.set({right: i}) : viewer.show(i);
  } else if (KEYS[event.key]) {
    KEYS[event.key](viewer);
  } else {
    return;
  }
  event.preventDefault();
}

// The first scene's pictures are decoded at once, the others' when they come near the window.
function start() {
  const scenes = JSON.parse(document.getElementById('pictures').textContent);
  const openIt = element => open(element, new Scene(scenes[Number(element.dataset.scene)]));
  const near = new IntersectionObserver(entries => {
    for (const {target, isIntersecting} of entries) {
      if (!isIntersecting) continue;
      near.unobserve(target);
      openIt(target);
    }
  }, {rootMargin: '600px'});
  const [first, ...others] = document.querySelectorAll('.viewer');
  others.forEach(element => near.observe(element));
  addEventListener('keydown', onKey);
  document.querySelectorAll('.filter').forEach(startFilter);
  openIt(first);
}

// Check boxes that hide methods from the plots and tables of their scene.
function startFilter(bar) {
  bar.hidden = false;
  for (const box of bar.querySelectorAll('input')) {
    box.onchange = () => {
      const marked = `[data-method="${box.dataset.method}"]:not(input)`;
      for (const element of bar.closest('section').querySelectorAll(marked)) {
        element.style.display = box.checked ? '' : 'none';
      }
    };
  }
}

async function open(element, scene) {
  element.textContent = 'Unpacking the pictures ...';
  try {
    await scene.load();
  } catch (error) {
    element.textContent = `This browser cannot show the pictures: ${error}`;
    return;
  }
  element.textContent = '';
  const viewer = new Viewer(element, scene);
  viewers.push(viewer);
  for (const inset of element.closest('section').querySelectorAll('[data-inset]')) {
    inset.onclick = () => viewer.lookAt(...inset.dataset.inset.split(',').map(Number));
  }
  element.dataset.ready = 'true';
}

start();
