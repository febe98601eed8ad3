// The scene in numbers: reading the data of the page, and where everything is at a moment. Nothing here draws.
const KINDS = { float32: Float32Array, int32: Int32Array, int8: Int8Array };

/** Return the array that was packed as text. */
export function unpacked(field) {
  const text = atob(field.data);
  const bytes = new Uint8Array(text.length);
  for (let k = 0; k < text.length; k++) bytes[k] = text.charCodeAt(k);
  return new KINDS[field.kind](bytes.buffer);
}

/** Return what is played with all arrays unpacked; `count`s say how many there are of what. */
export function readScene(data) {
  const scene = { ...data };
  for (const name of ["times", "ground", "forces", "status", "mode"]) scene[name] = unpacked(data[name]);
  scene.crackCount = data.status.shape[1];
  scene.parts = data.parts.map(readPart);
  scene.start = scene.times[0];
  scene.end = scene.times[scene.times.length - 1];
  return scene;
}

/** Return a part with all arrays unpacked. */
function readPart(part) {
  const arrays = Object.fromEntries(Object.entries(part).map(([name, field]) => [name, unpacked(field)]));
  return { ...arrays, shapeCount: part.shapes.shape[0], pointCount: part.points.shape[0] };
}

/** Return foot and head of each anchor where the parts are drawn so: its head moves with a point of its part. */
export function anchorLines(scene, drawn) {
  return (scene.anchors || []).map(({ foot, head, part, point }) => {
    const [[x, z]] = picked(drawn[part], [point]);
    const [[x0, z0]] = picked(scene.parts[part].points, [point]);
    return [foot, [head[0] + x - x0, head[1] + z - z0]];
  });
}

/** Return the histories beside a scene with all arrays unpacked. */
export function readHistories(data) {
  const { traces, historyTimes, historyMode } = data;
  return {
    times: unpacked(historyTimes),
    mode: unpacked(historyMode),
    traces: traces.map((trace) => ({ ...trace, values: unpacked(trace.values) })),
  };
}

/** Return the sample before a moment, how far it is on the way to the next, and the nearest sample. */
export function momentAt(times, time) {
  let low = 0;
  let high = times.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= time) low = middle;
    else high = middle;
  }
  const length = times[high] - times[low];
  const share = length > 0 ? Math.min(1, Math.max(0, (time - times[low]) / length)) : 0;
  return { before: low, after: high, share, nearest: share < 0.5 ? low : high };
}

/** Return values between samples. */
export function between(values, moment) {
  return (1 - moment.share) * values[moment.before] + moment.share * values[moment.after];
}

/** Return where the points of a part are drawn, x and z in turn, displaced so many times as far. */
export function drawnPoints(part, moment, exaggeration) {
  const found = Float64Array.from(part.points);
  const size = 2 * part.pointCount;
  for (let r = 0; r < part.shapeCount; r++) {
    const before = part.amplitudes[moment.before * part.shapeCount + r];
    const after = part.amplitudes[moment.after * part.shapeCount + r];
    const amount = exaggeration * ((1 - moment.share) * before + moment.share * after);
    for (let k = 0; k < size; k++) found[k] += amount * part.shapes[r * size + k];
  }
  return found;
}

/** Return the points of some places, as pairs. */
export function picked(points, places) {
  return Array.from(places, (place) => [points[2 * place], points[2 * place + 1]]);
}

/** Return the forces of a moment as pairs, in lengths of the arrow of the legend, and whether they were cut. */
export function forcesAt(scene, frame) {
  const found = [];
  for (let k = 0; k < scene.crackCount; k++) {
    const place = 2 * (frame * scene.crackCount + k);
    const [x, z] = [scene.forces[place] / scene.forceScale, scene.forces[place + 1] / scene.forceScale];
    const size = Math.hypot(x, z);
    const shorter = size > scene.cut ? scene.cut / size : 1;
    found.push({ vector: [x * shorter, z * shorter], cut: shorter < 1 });
  }
  return found;
}

/** Return the outline of an arrow by its tip, its vector and the width of its shaft; a short one is all head. */
export function arrowOutline([x, y], [u, v], width) {
  const size = Math.hypot(u, v);
  if (size < 1e-3 * width) return [];
  const head = Math.min(4 * width, size);
  const half = 0.35 * head;
  const shaft = Math.min(width / 2, half);
  const corners = [[size, shaft], [head, shaft], [head, half], [0, 0], [head, -half], [head, -shaft], [size, -shaft]];
  return corners.map(([back, side]) => [x - (back * u + side * v) / size, y - (back * v - side * u) / size]);
}

/** Return where a face, from bottom to top, reaches a level first; its top where it does not. */
export function atLevel(face, level) {
  const above = face.findIndex(([, z]) => z >= level);
  if (above < 0) return face[face.length - 1][0];
  if (above === 0) return face[0][0];
  const [[x0, z0], [x1, z1]] = [face[above - 1], face[above]];
  return x0 + ((x1 - x0) * (level - z0)) / (z1 - z0);
}

/** Return the outline of the water on one side of the dam, out to an edge, and where its surface meets the dam. */
export function waterOutline(parts, drawn, level, upstream, edge) {
  const [side, back] = upstream ? ["upstream", "downstream"] : ["downstream", "upstream"];
  const face = parts.map((part, k) => picked(drawn[k], part[side])).reverse().flat();
  const above = face.findIndex(([, z]) => z >= level);
  // Above the crest the water goes on to its far edge.
  const far = picked(drawn[0], parts[0][back]).pop();
  const end = above < 0 ? far[0] : atLevel(face, level);
  const shore = above < 0 ? [...face, far] : face.slice(0, above);
  return { outline: [[edge, face[0][1]], ...shore, [end, level], [edge, level]], end };
}

/** Return round numbers from low to high, about so many. */
export function ticks(low, high, count) {
  const rough = (high - low) / count;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((each) => each * power).find((each) => each >= rough * 0.999);
  const found = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k++) {
    found.push(Number((k * step).toPrecision(12)));
  }
  return found;
}

/** Return 1, 2, 5, 10, ... and the value that the page starts with, in order. */
export function exaggerations(own) {
  const found = [own];
  for (let power = 1; power <= Math.max(10, 10 * own) && power <= 1e5; power *= 10) {
    for (const step of [1, 2, 5]) if (step * power !== own && step * power <= Math.max(10, 10 * own)) found.push(step * power);
  }
  return found.sort((a, b) => a - b);
}

/** Return the moment that a place such as "#t=6.5" names, null where it names none. */
export function momentOf(hash) {
  const found = /(?:^#|&)t=([0-9.]+)/.exec(hash);
  return found && Number.isFinite(Number(found[1])) ? Number(found[1]) : null;
}
