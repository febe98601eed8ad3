// Drawing and controls.
(() => {
  const scene = readScene(JSON.parse(document.getElementById("scene").textContent));
  const element = (id) => document.getElementById(id);
  const dam = element("dam");
  const charts = element("charts");
  const state = { time: scene.start, playing: false, speed: scene.speed, exaggeration: scene.exaggeration, last: null };

  /** Return the colours of the page as they are now, by day or by night. */
  function colours() {
    const style = getComputedStyle(document.documentElement);
    return (name) => style.getPropertyValue(`--${name}`).trim();
  }

  /** Make a canvas as large as it is shown, in the pixels of the screen, and return its context in CSS pixels. */
  function prepared(canvas) {
    const ratio = window.devicePixelRatio || 1;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
    }
    const context = canvas.getContext("2d");
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    context.font = "12px system-ui, sans-serif";
    return [context, width, height];
  }

  function path(context, points, closed) {
    context.beginPath();
    points.forEach(([x, y], k) => (k ? context.lineTo(x, y) : context.moveTo(x, y)));
    if (closed) context.closePath();
  }

  function drawDam(moment) {
    const [context, width, height] = prepared(dam);
    const colour = colours();
    const drawn = scene.parts.map((part) => drawnPoints(part, moment, state.exaggeration));
    if (scene.views.length === 1) {
      drawView(context, colour, moment, drawn, 0, [0, 0, width, height]);
      return;
    }
    // The whole dam in the corner or above, the crack large.
    const gap = 8;
    if (width > 1.1 * height) {
      const small = Math.round(0.36 * width);
      drawView(context, colour, moment, drawn, 0, [0, 0, small, Math.min(height, small)]);
      drawView(context, colour, moment, drawn, 1, [small + gap, 0, width - small - gap, height]);
    } else {
      const small = Math.round(0.36 * height);
      drawView(context, colour, moment, drawn, 0, [0, 0, width, small]);
      drawView(context, colour, moment, drawn, 1, [0, small + gap, width, height - small - gap]);
    }
  }

  /** Draw one view of the dam into a box (left, top, width, height) of the canvas. */
  function drawView(context, colour, moment, drawn, number, [left, top, width, height]) {
    const [x0, x1, z0, z1] = scene.views[number];
    const scale = Math.min(width / (x1 - x0), height / (z1 - z0));
    const middle = left + (width - scale * (x1 - x0)) / 2;
    const foot = top + height;
    const at = ([x, z]) => [middle + scale * (x - x0), foot - scale * (z - z0)];
    const detailed = number === scene.views.length - 1;
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
      context.fillStyle = colour("ground");
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
      if (detailed && element("grid").checked) {
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
    context.setLineDash([5, 4]);
    stroke(picked(scene.parts[scene.above].points, scene.parts[scene.above].outline).map(at), "faint", 1, true);
    context.setLineDash([]);
    if (number === 0) drawGroundArrow(fill, colour, context, [left, width, ground, foot]);
    if (detailed) drawCrack(context, colour, fill, at, moment, picked(drawn[scene.above], scene.parts[scene.above].crack), scale);
    else {
      const [near0, near1, low, high] = scene.views[1];
      context.setLineDash([4, 3]);
      stroke([[near0, low], [near1, low], [near1, high], [near0, high]].map(at), "faint", 1, true);
      context.setLineDash([]);
    }
    context.restore();
    context.strokeStyle = colour("line");
    context.lineWidth = 1;
    context.strokeRect(left + 0.5, top + 0.5, width - 1, height - 1);
  }

  /** Draw the ground's acceleration upstream of the dam, where no forces are drawn. */
  function drawGroundArrow(fill, colour, context, [left, width, ground, foot]) {
    const trace = scene.traces[0].values;
    const peak = trace.reduce((most, value) => Math.max(most, Math.abs(value)), 0) || 1;
    const now = between(trace, momentAt(scene.historyTimes, state.time)) / peak;
    const [x, depth, long] = [left + 0.15 * width, foot - ground, 0.13 * width * now];
    context.fillStyle = colour("text");
    context.font = "11px system-ui, sans-serif";
    context.textAlign = "center";
    context.textBaseline = "middle";
    context.fillText("ground accelerates", Math.max(x, left + 60), ground + 0.25 * depth);
    fill(arrowOutline([x + long, ground + 0.66 * depth], [long, 0], Math.min(0.14 * depth, 0.015 * width)), "text");
  }

  function drawCrack(context, colour, fill, at, moment, crack, scale) {
    const view = scene.views[scene.views.length - 1];
    const few = scene.crackCount === 2;
    const long = scene.arrow * (view[3] - view[2]) * scale;
    document.querySelector(".legend .arrow").style.width = `${long}px`;
    if (element("forces").checked) {
      forcesAt(scene, moment.nearest).forEach(({ vector: [x, z], cut }, k) => {
        fill(arrowOutline(at(crack[k]), [x * long, -z * long], few ? 5 : 2.6), cut ? "force-cut" : "force");
      });
    }
    crack.forEach((point, k) => {
      const status = scene.status[moment.nearest * scene.crackCount + k];
      if (status < 0) return;
      context.beginPath();
      context.arc(...at(point), few ? 5 : 3, 0, 2 * Math.PI);
      context.fillStyle = colour(`status-${status}`);
      context.fill();
      context.strokeStyle = colour("edge");
      context.lineWidth = 1;
      context.stroke();
    });
  }

  // Traces with one unit that belong together share a chart.
  const groups = new Map();
  scene.traces.forEach((trace) => groups.set(trace.chart, [...(groups.get(trace.chart) || []), trace]));
  const plot = { left: 48, right: 10 };

  function drawCharts(moment) {
    const [context, width, height] = prepared(charts);
    const colour = colours();
    const [ribbon, axis, title] = [16, 34, 22];
    const across = (time) => plot.left + ((time - scene.start) / (scene.end - scene.start)) * (width - plot.left - plot.right);
    const each = (height - ribbon - axis - title) / groups.size;
    let top = 0;
    const history = momentAt(scene.historyTimes, state.time);
    const times = ticks(scene.start, scene.end, Math.max(2, Math.min(8, width / 70)));
    for (const [name, traces] of groups) {
      const [from, to] = [top + title, top + each - 8];
      drawChart(context, colour, name, traces, across, times, [from, to], width, history);
      top += each;
    }
    context.fillStyle = colour("text");
    context.textAlign = "left";
    context.fillText("mode", plot.left, top + title - 8);
    top += title;
    for (let k = 0; k + 1 < scene.historyTimes.length; ) {
      let end = k + 1;
      while (end + 1 < scene.historyTimes.length && scene.historyMode[end] === scene.historyMode[k]) end++;
      const [x, next] = [across(scene.historyTimes[k]), across(scene.historyTimes[end])];
      context.fillStyle = colour(`mode-${scene.modes[scene.historyMode[k]].kind}`);
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
    context.beginPath();
    context.moveTo(across(state.time), title);
    context.lineTo(across(state.time), top + ribbon);
    context.stroke();
  }

  function drawChart(context, colour, name, traces, across, times, [from, to], width, history) {
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
    // What reaches far would hide what does not.
    const reach = (trace) => trace.values.reduce((most, value) => Math.max(most, Math.abs(value)), 0);
    [...traces].sort((one, other) => reach(other) - reach(one)).forEach((trace) => {
      context.strokeStyle = colour(`trace-${trace.role}`);
      context.lineWidth = 1.1;
      context.beginPath();
      trace.values.forEach((value, sample) => context.lineTo(across(scene.historyTimes[sample]), up(value)));
      context.stroke();
      context.fillStyle = colour(`trace-${trace.role}`);
      context.beginPath();
      context.arc(across(state.time), up(between(trace.values, history)), 3.5, 0, 2 * Math.PI);
      context.fill();
    });
  }

  function draw() {
    const moment = momentAt(scene.times, state.time);
    const mode = scene.modes[scene.mode[moment.nearest]];
    drawDam(moment);
    drawCharts(moment);
    element("now").textContent = `${state.time.toFixed(2)} s`;
    element("mode").textContent = mode.name;
    element("time").value = state.time;
    element("time").setAttribute("aria-valuetext", `${state.time.toFixed(2)} seconds, ${mode.name}`);
    const own = state.exaggeration;
    element("exaggeration-text").textContent = own === 1 ? "displacements drawn to scale" : `displacements drawn × ${own}`;
    element("exaggeration-value").textContent = `× ${own}`;
    element("exaggeration").setAttribute("aria-valuetext", `${own} times`);
  }

  // One drawing per picture of the screen, however many things ask for it.
  let asked = false;
  function redraw() {
    if (asked) return;
    asked = true;
    requestAnimationFrame((now) => {
      asked = false;
      if (state.playing) advance(now);
      draw();
      if (state.playing) redraw();
    });
  }

  function advance(now) {
    if (state.last !== null) state.time += ((now - state.last) / 1000) * state.speed;
    state.last = now;
    if (state.time < scene.end) return;
    if (element("repeat").checked) state.time = scene.start;
    else {
      state.time = scene.end;
      play(false);
    }
  }

  function play(wanted) {
    if (wanted && state.time >= scene.end) state.time = scene.start;
    state.playing = wanted;
    state.last = null;
    element("play").textContent = wanted ? "Pause" : "Play";
    element("play").setAttribute("aria-label", wanted ? "Pause" : "Play");
    redraw();
  }

  function goTo(time) {
    state.time = Math.min(scene.end, Math.max(scene.start, time));
    state.last = null;
    redraw();
  }

  function fillControls() {
    element("time").min = scene.start;
    element("time").max = scene.end;
    const speeds = [...new Set([0.1, 0.2, 0.5, 1, 2, 4, scene.speed])].sort((a, b) => a - b);
    for (const speed of speeds) element("speed").add(new Option(`${speed} ×`, speed, false, speed === scene.speed));
    const choices = exaggerations(scene.exaggeration);
    element("exaggeration").min = 0;
    element("exaggeration").max = choices.length - 1;
    element("exaggeration").value = choices.indexOf(scene.exaggeration);
    element("exaggeration").addEventListener("input", (event) => {
      state.exaggeration = choices[event.target.value];
      redraw();
    });
    const legend = (id, kind, name, style) => {
      const entry = document.createElement("span");
      const sign = entry.appendChild(document.createElement("i"));
      sign.className = kind;
      Object.assign(sign.style, style);
      entry.append(name);
      element(id).append(entry);
    };
    // A rigid part has no elements.
    element("grid").parentElement.hidden = scene.parts.every((part) => part.grid.length === 0);
    legend("legend", "arrow", scene.forceText, {});
    scene.statusNames.forEach((name, k) => legend("legend", "dot", name, { background: `var(--status-${k})` }));
    legend("legend", "dashed", "before the earthquake", {});
    const kinds = new Set(Array.from(new Set(scene.historyMode), (mode) => scene.modes[mode].kind));
    for (const kind of kinds) legend("mode-legend", "", kind, { background: `var(--mode-${kind})` });
  }

  function listen() {
    element("play").addEventListener("click", () => play(!state.playing));
    element("time").addEventListener("input", (event) => goTo(Number(event.target.value)));
    element("speed").addEventListener("change", (event) => (state.speed = Number(event.target.value)));
    for (const id of ["forces", "grid"]) element(id).addEventListener("change", redraw);
    const scrub = (event) => {
      const box = charts.getBoundingClientRect();
      const share = (event.clientX - box.left - plot.left) / (box.width - plot.left - plot.right);
      goTo(scene.start + share * (scene.end - scene.start));
    };
    charts.addEventListener("pointerdown", (event) => {
      charts.setPointerCapture(event.pointerId);
      scrub(event);
    });
    charts.addEventListener("pointermove", (event) => event.buttons && scrub(event));
    document.addEventListener("keydown", (event) => {
      // Sliders and lists have a use of their own for the arrow keys, buttons and boxes for space.
      const used = ["INPUT", "SELECT", "BUTTON"].includes(event.target.tagName);
      if (event.ctrlKey || event.altKey || event.metaKey || used) return;
      const step = event.shiftKey ? 1 : 0.1;
      const deeds = {
        " ": () => play(!state.playing),
        ArrowLeft: () => goTo(state.time - step),
        ArrowRight: () => goTo(state.time + step),
        Home: () => goTo(scene.start),
        End: () => goTo(scene.end),
      };
      if (!(event.key in deeds)) return;
      event.preventDefault();
      deeds[event.key]();
    });
    const follow = () => {
      const time = momentOf(location.hash);
      if (time !== null) goTo(time);
    };
    window.addEventListener("hashchange", follow);
    window.addEventListener("resize", redraw);
    new ResizeObserver(redraw).observe(dam);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
    follow();
  }

  fillControls();
  listen();
  redraw();
})();
