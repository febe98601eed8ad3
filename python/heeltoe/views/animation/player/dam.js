/** The dam at a moment on a canvas: its parts, the water, the ground, forces and contact along the crack. */
import { colours, path, prepared } from "./canvas.js";
import { anchorLines, arrowOutline, between, drawnPoints, forcesAt, picked, waterOutline } from "./scene.js";

/**
 * Draw a scene on a canvas, with the forces and the lines between elements where they are wanted, and return how long
 * the arrow of the legend is [CSS pixels].
 */
export function drawDam(canvas, scene, moment, { exaggeration, forces, grid }) {
  const [context, width, height] = prepared(canvas);
  const drawn = scene.parts.map((part) => drawnPoints(part, moment, exaggeration));
  const draw = (number, box) => drawView(context, scene, moment, drawn, number, box, { forces, grid });
  if (scene.views.length === 1) return draw(0, [0, 0, width, height]);
  // The whole dam in the corner or above, the crack large.
  const gap = 8;
  if (width > 1.1 * height) {
    const small = Math.round(0.36 * width);
    draw(0, [0, 0, small, Math.min(height, small)]);
    return draw(1, [small + gap, 0, width - small - gap, height]);
  }
  const small = Math.round(0.36 * height);
  draw(0, [0, 0, width, small]);
  return draw(1, [0, small + gap, width, height - small - gap]);
}

/** Draw one view of the dam into a box (left, top, width, height) of the canvas. */
function drawView(context, scene, moment, drawn, number, [left, top, width, height], { forces, grid }) {
  const [x0, x1, z0, z1] = scene.views[number];
  const scale = Math.min(width / (x1 - x0), height / (z1 - z0));
  const middle = left + (width - scale * (x1 - x0)) / 2;
  const foot = top + height;
  const at = ([x, z]) => [middle + scale * (x - x0), foot - scale * (z - z0)];
  const detailed = number === scene.views.length - 1;
  const colour = colours();
  const fill = (points, name) => {
    path(context, points, true);
    context.fillStyle = colour(name);
    context.fill();
  };
  const stroke = (points, name, thickness, closed) => {
    path(context, points, closed);
    context.strokeStyle = colour(name);
    context.lineWidth = thickness;
    context.stroke();
  };
  context.save();
  context.beginPath();
  context.rect(left, top, width, height);
  context.clip();
  const ground = at([0, scene.base])[1];
  if (ground < foot) {
    context.fillStyle = colour("soil");
    context.fillRect(left, ground, width, foot - ground);
    stroke([[left, ground], [left + width, ground]], "edge", 1, false);
  }
  for (const [level, side, edge] of [[scene.water, "upstream", left], [scene.tailwater, "downstream", left + width]]) {
    const surface = at([0, level])[1];
    if (level === null || level <= scene.base || surface >= foot) continue;
    const { outline, end } = waterOutline(scene.parts, drawn, level, side === "upstream", x0 + (edge - middle) / scale);
    fill(outline.map(at), "water");
    stroke([[edge, surface], [at([end, level])[0], surface]], "surface", 1.5, false);
  }
  scene.parts.map((part, k) => [part, drawn[k], k > scene.above ? "lower" : "upper"]).reverse().forEach(([part, points, name]) => {
    const outline = picked(points, part.outline).map(at);
    fill(outline, name);
    if (detailed && grid) {
      context.beginPath();
      for (let k = 0; k < part.grid.length; k += 2) {
        const [start, end] = picked(points, part.grid.subarray(k, k + 2)).map(at);
        context.moveTo(...start);
        context.lineTo(...end);
      }
      context.strokeStyle = colour("grid");
      context.lineWidth = 0.6;
      context.stroke();
    }
    stroke(outline, "edge", 1, true);
    stroke(picked(points, part.crack).map(at), "edge", 2, false);
  });
  // Where the part above the crack was before the earthquake, against which its slip is seen.
  const upper = scene.parts[scene.above];
  context.setLineDash([5, 4]);
  stroke(picked(upper.points, upper.outline).map(at), "faint", 1, true);
  context.setLineDash([]);
  for (const line of anchorLines(scene, drawn)) {
    context.setLineDash([7, 3, 2, 3]);
    stroke(line.map(at), "anchor", 1.5, false);
    context.setLineDash([]);
    const [x, y] = at(line[1]);
    fill([[x - 3, y - 3], [x + 3, y - 3], [x + 3, y + 3], [x - 3, y + 3]], "anchor");
  }
  if (number === 0) drawGroundArrow(context, colour, fill, between(scene.ground, moment), [left, width, ground, foot]);
  const long = scene.arrow * (z1 - z0) * scale;
  if (detailed) {
    const crack = picked(drawn[scene.above], upper.crack);
    if (forces) drawForces(scene, moment, crack.map(at), fill, long);
    drawContact(context, colour, scene, moment, crack.map(at));
  } else {
    const [near0, near1, low, high] = scene.views[1];
    context.setLineDash([4, 3]);
    stroke([[near0, low], [near1, low], [near1, high], [near0, high]].map(at), "faint", 1, true);
    context.setLineDash([]);
  }
  context.restore();
  context.strokeStyle = colour("line");
  context.lineWidth = 1;
  context.strokeRect(left + 0.5, top + 0.5, width - 1, height - 1);
  return long;
}

/** Draw the ground's acceleration, a share of its peak, upstream of the dam, where no forces are drawn. */
function drawGroundArrow(context, colour, fill, acceleration, [left, width, ground, foot]) {
  const [x, depth, long] = [left + 0.15 * width, foot - ground, 0.13 * width * acceleration];
  context.fillStyle = colour("text");
  context.font = "11px system-ui, sans-serif";
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.fillText("ground accelerates", Math.max(x, left + 60), ground + 0.25 * depth);
  fill(arrowOutline([x + long, ground + 0.66 * depth], [long, 0], Math.min(0.14 * depth, 0.015 * width)), "text");
}

function drawForces(scene, moment, crack, fill, long) {
  const width = scene.crackCount === 2 ? 5 : 2.6;
  forcesAt(scene, moment.nearest).forEach(({ vector: [x, z], cut }, k) => {
    fill(arrowOutline(crack[k], [x * long, -z * long], width), cut ? "force-cut" : "force");
  });
}

/** Mark what each point of the crack does. */
function drawContact(context, colour, scene, moment, crack) {
  crack.forEach((point, k) => {
    const status = scene.status[moment.nearest * scene.crackCount + k];
    if (status < 0) return;
    context.beginPath();
    context.arc(...point, scene.crackCount === 2 ? 5 : 3, 0, 2 * Math.PI);
    context.fillStyle = colour(`status-${status}`);
    context.fill();
    context.strokeStyle = colour("edge");
    context.lineWidth = 1;
    context.stroke();
  });
}
