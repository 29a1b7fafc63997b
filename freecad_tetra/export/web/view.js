// SPDX-License-Identifier: LGPL-2.1-or-later
// The view: expands the packed pieces into triangles, and draws them when something changes.
"use strict";
(() => {
  const unpack = (text, Kind) => {
    const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    return new Kind(bytes.buffer);
  };
  const points = unpack(DATA.points, Float32Array);
  const sizes = unpack(DATA.sizes, Uint16Array);
  const corners = unpack(DATA.corners, Uint32Array);
  const piece = unpack(DATA.piece, Uint32Array);
  const face = unpack(DATA.face, Int32Array);
  const quality = unpack(DATA.quality, Float32Array);
  const pieces = quality.length;

  const element = (id) => document.getElementById(id);
  const canvas = element("view");
  const HOME = { turn: -0.96, tilt: 0.49, zoom: 1, explode: 0, cut: 1, axis: 1, colour: "piece", edges: true };
  const state = { ...HOME };

  // Middles of the pieces' boxes, and the extent of all.
  const low = new Float32Array(3 * pieces).fill(Infinity);
  const high = new Float32Array(3 * pieces).fill(-Infinity);
  const reach = [0, 0, 0];
  for (let f = 0, at = 0; f < sizes.length; ++f) {
    for (let i = 0; i < sizes[f]; ++i, ++at) {
      for (let k = 0; k < 3; ++k) {
        const x = points[3 * corners[at] + k], slot = 3 * piece[f] + k;
        low[slot] = Math.min(low[slot], x);
        high[slot] = Math.max(high[slot], x);
        reach[k] = Math.max(reach[k], Math.abs(x));
      }
    }
  }
  const middle = low.map((x, i) => (x + high[i]) / 2);
  const radius = Math.hypot(...reach) || 1;

  // Oklab, so that colours of like lightness differ in hue alone: as in the still pictures.
  const oklab = (lightness, a, b) => {
    const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
    const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
    const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
    const linear = [
      4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
      -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
      -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s,
    ];
    return linear.map((x) => Math.round(255 * Math.min(1, Math.max(0, x)) ** (1 / 2.2)));
  };
  const GOLDEN = Math.PI * (3 - Math.sqrt(5));
  const hue = (n) => oklab(n % 2 ? 0.72 : 0.8, 0.105 * Math.cos(0.9 + n * GOLDEN), 0.105 * Math.sin(0.9 + n * GOLDEN));
  const INNER = [214, 217, 222];
  const scale = (q) => oklab(0.5 + 0.4 * q, 0.16 - 0.28 * q, 0.02 + 0.1 * q);  // red to green
  const COLOURS = {
    piece: (f) => hue(piece[f]),
    face: (f) => (face[f] < 0 ? INNER : hue(face[f])),
    quality: (f) => scale(quality[piece[f]]),
  };

  // Triangles and outlines with a position, the middle of their piece and a normal each.
  const normalOf = (from, count) => {
    const n = [0, 0, 0];
    const at = (i, k) => points[3 * corners[from + i] + k] - points[3 * corners[from] + k];
    for (let i = 1; i + 1 < count; ++i) {
      n[0] += at(i, 1) * at(i + 1, 2) - at(i, 2) * at(i + 1, 1);
      n[1] += at(i, 2) * at(i + 1, 0) - at(i, 0) * at(i + 1, 2);
      n[2] += at(i, 0) * at(i + 1, 1) - at(i, 1) * at(i + 1, 0);
    }
    const length = Math.hypot(...n) || 1;
    return n.map((x) => x / length);
  };
  const expand = () => {
    let triangles = 0;
    for (const size of sizes) triangles += size - 2;
    const solid = new Float32Array(27 * triangles), lines = new Float32Array(18 * corners.length);
    const owner = new Uint32Array(3 * triangles);
    let s = 0, l = 0, v = 0, from = 0;
    for (let f = 0; f < sizes.length; ++f) {
      const normal = normalOf(from, sizes[f]), centre = middle.subarray(3 * piece[f], 3 * piece[f] + 3);
      const put = (target, at, corner) => {
        const p = 3 * corners[from + corner];
        target.set(points.subarray(p, p + 3), at);
        target.set(centre, at + 3);
        target.set(normal, at + 6);
      };
      for (let i = 1; i + 1 < sizes[f]; ++i) {
        for (const corner of [0, i, i + 1]) {
          put(solid, s, corner);
          owner[v++] = f;
          s += 9;
        }
      }
      for (let i = 0; i < sizes[f]; ++i) {
        put(lines, l, i);
        put(lines, l + 9, (i + 1) % sizes[f]);
        l += 18;
      }
      from += sizes[f];
    }
    return { solid, lines, owner };
  };

  const VERTEX = `
    attribute vec3 position, middle, normal, colour;
    uniform mat3 turn;
    uniform vec4 view;   // x and y scale, depth scale, how far lines come forward
    uniform vec3 side;   // axis of the cut, towards the eye of the first view
    uniform float explode, cut;
    varying vec3 shade, bright;
    void main() {
      vec3 p = turn * (position + explode * middle);
      vec3 n = turn * normal;
      float key = max(0.0, dot(n, normalize(vec3(0.35, 0.45, 1.0))));
      float fill = max(0.0, dot(n, normalize(vec3(-0.9, -0.2, 0.4))));
      bright = vec3(0.52 + 0.52 * key + 0.12 * fill);
      shade = colour;
      gl_Position = vec4(p.xy * view.xy, -p.z * view.z - view.w, 1.0);
      if (dot(side, middle) > cut) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    }`;
  const FRAGMENT = `
    precision mediump float;
    varying vec3 shade, bright;
    uniform float ink;
    void main() { gl_FragColor = vec4(mix(shade * bright, vec3(0.11, 0.15, 0.2), ink), 1.0); }`;

  const fail = (text) => {
    element("problem").textContent = text;
    element("problem").hidden = false;
  };
  const gl = canvas.getContext("webgl", { antialias: true, alpha: true, preserveDrawingBuffer: true });
  if (!gl) return fail("This browser offers no WebGL.");

  const program = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) return fail(gl.getShaderInfoLog(shader));
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) return fail(gl.getProgramInfoLog(program));
  gl.useProgram(program);
  const uniform = (name) => gl.getUniformLocation(program, name);
  const slot = (name) => gl.getAttribLocation(program, name);
  const buffer = (values) => {
    const made = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, made);
    gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
    return made;
  };
  const { solid, lines, owner } = expand();
  const solidBuffer = buffer(solid), lineBuffer = buffer(lines), colourBuffer = gl.createBuffer();

  const paint = () => {
    const colours = new Uint8Array(3 * owner.length), known = new Map();
    for (let v = 0; v < owner.length; ++v) {
      if (!known.has(owner[v])) known.set(owner[v], COLOURS[state.colour](owner[v]));
      colours.set(known.get(owner[v]), 3 * v);
    }
    gl.bindBuffer(gl.ARRAY_BUFFER, colourBuffer);
    gl.bufferData(gl.ARRAY_BUFFER, colours, gl.STATIC_DRAW);
  };

  const bind = (vertices) => {
    gl.bindBuffer(gl.ARRAY_BUFFER, vertices);
    ["position", "middle", "normal"].forEach((name, i) => {
      gl.enableVertexAttribArray(slot(name));
      gl.vertexAttribPointer(slot(name), 3, gl.FLOAT, false, 36, 12 * i);
    });
  };

  const draw = () => {
    const ratio = window.devicePixelRatio || 1;
    const width = Math.round(canvas.clientWidth * ratio), height = Math.round(canvas.clientHeight * ratio);
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    const [ct, st, ce, se] = [Math.cos(state.turn), Math.sin(state.turn), Math.cos(state.tilt), Math.sin(state.tilt)];
    // Columns: right, up and towards the eye, of x, y and z; z is up, as in CAD.
    gl.uniformMatrix3fv(uniform("turn"), false, [-st, -se * ct, ce * ct, ct, -se * st, ce * st, 0, ce, se]);
    const size = (0.9 * state.zoom) / radius, short = Math.min(width, height);
    const depth = 1 / (radius * (1 + state.explode) * 1.01);
    const view = [(size * short) / width, (size * short) / height, depth];
    gl.uniform3fv(uniform("side"), [1, -1, 1].map((towards, k) => (k === state.axis ? towards : 0)));
    gl.uniform1f(uniform("explode"), state.explode);
    gl.uniform1f(uniform("cut"), state.cut >= 1 ? 1e30 : (2 * state.cut - 1) * reach[state.axis]);
    bind(solidBuffer);
    gl.bindBuffer(gl.ARRAY_BUFFER, colourBuffer);
    gl.enableVertexAttribArray(slot("colour"));
    gl.vertexAttribPointer(slot("colour"), 3, gl.UNSIGNED_BYTE, true, 0, 0);
    gl.uniform4fv(uniform("view"), [...view, 0]);
    gl.uniform1f(uniform("ink"), 0);
    gl.drawArrays(gl.TRIANGLES, 0, owner.length);
    if (!state.edges) return;
    bind(lineBuffer);
    gl.disableVertexAttribArray(slot("colour"));
    gl.uniform4fv(uniform("view"), [...view, 0.0008]);
    gl.uniform1f(uniform("ink"), 0.75);
    gl.drawArrays(gl.LINES, 0, 2 * corners.length);
  };

  let waiting = false;
  const redraw = () => {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => {
      waiting = false;
      draw();
    });
  };

  const read = () => {
    const colour = element("colour").value;
    const other = colour !== state.colour;
    state.explode = Number(element("explode").value);
    state.cut = Number(element("cut").value);
    state.axis = Number(element("axis").value);
    state.edges = element("edges").checked;
    state.colour = colour;
    if (other) paint();
    redraw();
  };
  element("panel").addEventListener("input", read);
  element("panel").addEventListener("submit", (event) => event.preventDefault());
  element("panel").addEventListener("reset", () => {
    Object.assign(state, { turn: HOME.turn, tilt: HOME.tilt, zoom: HOME.zoom });
    setTimeout(read);
  });

  const spin = (dx, dy) => {
    state.turn -= dx;
    state.tilt = Math.min(Math.PI / 2, Math.max(-Math.PI / 2, state.tilt + dy));
    redraw();
  };
  const zoom = (factor) => {
    state.zoom = Math.min(50, Math.max(0.05, state.zoom * factor));
    redraw();
  };
  canvas.addEventListener("pointerdown", (event) => canvas.setPointerCapture(event.pointerId));
  canvas.addEventListener("pointermove", (event) => {
    if (event.buttons) spin(event.movementX * 0.008, event.movementY * 0.008);
  });
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    zoom(Math.exp(-event.deltaY * 0.0012));
  }, { passive: false });
  canvas.addEventListener("keydown", (event) => {
    const keys = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1] };
    if (keys[event.key]) spin(...keys[event.key]);
    if (event.key === "+") zoom(1.15);
    if (event.key === "-") zoom(1 / 1.15);
  });
  window.addEventListener("resize", redraw);

  element("title").textContent = DATA.title;
  element("count").textContent = `${pieces.toLocaleString("en")} ${DATA.kind}`;
  if (face.every((f) => f < 0)) element("colour").querySelector("[value=face]").disabled = true;
  paint();
  draw();
})();
