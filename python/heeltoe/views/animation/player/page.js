/** The page of an animation: the player, and the histories with the moment that is shown. */
import { colours, path, prepared } from "./canvas.js";
import { element } from "./element.js";
import { DamPlayer } from "./player.js";
import { between, momentAt, momentOf, readHistories, readScene, ticks } from "./scene.js";

const byId = (id) => document.getElementById(id);
const data = JSON.parse(byId("scene").textContent);
const scene = readScene(data);
const histories = readHistories(data);
const charts = byId("charts");
const plot = { left: 48, right: 10 };
const player = new DamPlayer(() => drawCharts(), data.speed);

// Traces with one unit that belong together share a chart.
const groups = new Map();
histories.traces.forEach((trace) => groups.set(trace.chart, [...(groups.get(trace.chart) || []), trace]));

function drawCharts() {
  const [context, width, height] = prepared(charts);
  const colour = colours();
  const [ribbon, axis, title] = [16, 34, 22];
  const across = (time) => plot.left + ((time - scene.start) / (scene.end - scene.start)) * (width - plot.left - plot.right);
  const room = (height - ribbon - axis - title) / groups.size;
  let top = 0;
  const times = ticks(scene.start, scene.end, Math.max(2, Math.min(8, width / 70)));
  for (const [name, traces] of groups) {
    const [from, to] = [top + title, top + room - 8];
    drawChart(context, colour, name, traces, across, times, [from, to], width);
    top += room;
  }
  context.fillStyle = colour("text");
  context.textAlign = "left";
  context.fillText("mode", plot.left, top + title - 8);
  top += title;
  for (let k = 0; k + 1 < histories.times.length; ) {
    let end = k + 1;
    while (end + 1 < histories.times.length && histories.mode[end] === histories.mode[k]) end++;
    const [x, next] = [across(histories.times[k]), across(histories.times[end])];
    context.fillStyle = colour(`mode-${scene.modes[histories.mode[k]].kind}`);
    context.fillRect(x, top, next - x + 0.3, ribbon);
    k = end;
  }
  context.fillStyle = colour("faint");
  context.textAlign = "center";
  context.textBaseline = "top";
  for (const time of times) context.fillText(String(time), across(time), top + ribbon + 4);
  context.textAlign = "right";
  context.fillText("time [s]", width - plot.right, top + ribbon + 19);
  context.strokeStyle = colour("cursor");
  context.lineWidth = 1.5;
  path(context, [[across(player.time), title], [across(player.time), top + ribbon]], false);
  context.stroke();
}

function drawChart(context, colour, name, traces, across, times, [from, to], width) {
  let [low, high] = [0, 0];
  for (const trace of traces) for (const value of trace.values) [low, high] = [Math.min(low, value), Math.max(high, value)];
  if (low === high) [low, high] = [-1, 1];
  const margin = 0.06 * (high - low);
  const up = (value) => to - ((value - low + margin) / (high - low + 2 * margin)) * (to - from);
  context.lineWidth = 1;
  context.strokeStyle = colour("rule");
  context.fillStyle = colour("faint");
  context.textBaseline = "middle";
  context.textAlign = "right";
  for (const value of ticks(low, high, Math.max(3, (to - from) / 35))) {
    path(context, [[plot.left, up(value)], [width - plot.right, up(value)]], false);
    context.stroke();
    context.fillText(String(value), plot.left - 6, up(value));
  }
  for (const time of times) {
    path(context, [[across(time), from], [across(time), to]], false);
    context.stroke();
  }
  context.textBaseline = "alphabetic";
  context.textAlign = "left";
  context.fillStyle = colour("text");
  context.fillText(`${name} [${traces[0].unit}]${name === "slip" ? ", + downstream" : ""}`, plot.left, from - 7);
  context.textAlign = "right";
  let right = width - plot.right;
  for (const trace of [...traces].reverse()) {
    context.fillStyle = colour(`trace-${trace.role}`);
    context.fillText(trace.label, right, from - 7);
    right -= context.measureText(trace.label).width + 10;
  }
  const moment = momentAt(histories.times, player.time);
  // What reaches far would hide what does not.
  const reach = (trace) => trace.values.reduce((most, value) => Math.max(most, Math.abs(value)), 0);
  [...traces].sort((one, other) => reach(other) - reach(one)).forEach((trace) => {
    context.strokeStyle = colour(`trace-${trace.role}`);
    context.lineWidth = 1.1;
    context.beginPath();
    trace.values.forEach((value, sample) => context.lineTo(across(histories.times[sample]), up(value)));
    context.stroke();
    context.fillStyle = colour(`trace-${trace.role}`);
    context.beginPath();
    context.arc(across(player.time), up(between(trace.values, moment)), 3.5, 0, 2 * Math.PI);
    context.fill();
  });
}

/** Go to the moment of the charts that is pressed or dragged to. */
function followPointer() {
  const scrub = (event) => {
    const box = charts.getBoundingClientRect();
    const share = (event.clientX - box.left - plot.left) / (box.width - plot.left - plot.right);
    player.goTo(scene.start + share * (scene.end - scene.start));
  };
  charts.addEventListener("pointerdown", (event) => {
    charts.setPointerCapture(event.pointerId);
    scrub(event);
  });
  charts.addEventListener("pointermove", (event) => event.buttons && scrub(event));
}

/** Be light or dark as the system is. */
function followTheme() {
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const apply = () => {
    document.documentElement.dataset.theme = dark.matches ? "dark" : "light";
    player.redraw();
  };
  dark.addEventListener("change", apply);
  apply();
}

/** Go to the moment that the address names. */
function followAddress() {
  const time = momentOf(location.hash);
  if (time !== null) player.goTo(time);
}

byId("dam").append(player.view);
byId("charts").before(player.now);
byId("controls").append(player.controls);
for (const kind of new Set(Array.from(new Set(histories.mode), (mode) => scene.modes[mode].kind))) {
  const sign = element("i", {});
  sign.style.background = `var(--mode-${kind})`;
  byId("mode-legend").append(element("span", {}, sign, kind));
}
player.show(scene);
player.goTo(scene.start);
followPointer();
followTheme();
followAddress();
window.addEventListener("hashchange", followAddress);
window.addEventListener("resize", () => player.redraw());
document.addEventListener("keydown", (event) => {
  // Sliders and lists have a use of their own for the arrow keys, buttons and boxes for space.
  if (!["INPUT", "SELECT", "BUTTON"].includes(event.target.tagName)) player.key(event);
});
