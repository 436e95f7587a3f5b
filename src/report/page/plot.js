"use strict";
// Figures as SVG with error bars, ticks that do not overlap, and downloads. Uses `element` and `figures` of page.js.

/// The palette of Okabe and Ito (2008). Each series also has its own shape, dash or pattern, for grey prints.
const palette = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#777777", "#b8a800"];
const dashes = ["", "7 4", "2 3", "9 3 2 3", "12 4", "4 2", "1 5", "7 2 2 2"];
const shapes = ["circle", "square", "triangle", "diamond", "cross", "down", "ring", "box"];
const kFont = 12;
const kPattern = 8; // side of a pattern of bars

const pen = document.createElement("canvas").getContext("2d");
pen.font = `${kFont}px sans-serif`;
const textWidth = (text) => pen.measureText(text).width;

function svg(tag, attributes = {}, ...children) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) if (value !== undefined) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

/// Returns `text`, shortened to `width` pixels.
function fitted(text, width) {
  if (textWidth(text) <= width) return text;
  let end = text.length;
  while (end > 1 && textWidth(`${text.slice(0, end)}…`) > width) --end;
  return `${text.slice(0, end)}…`;
}

function linearTicks(low, high, count) {
  const rough = (high - low) / count;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * ([1, 2, 5].find((factor) => factor * power >= rough * (1 - 1e-9)) ?? 10);
  const ticks = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high * (1 + 1e-9); ++i) ticks.push(Number((i * step).toPrecision(12)));
  return ticks;
}

function decadeTicks(low, high, factors, every = 1) {
  const ticks = [];
  for (let power = Math.floor(Math.log10(low)); power <= Math.log10(high); ++power)
    if (power % every === 0) for (const factor of factors) ticks.push(Number((factor * 10 ** power).toPrecision(12)));
  return ticks.filter((tick) => tick >= low * (1 - 1e-9) && tick <= high * (1 + 1e-9));
}

/// Returns the scale of an axis: position(value) in pixels and ticks {value, label, at}. It chooses the most ticks whose
/// labels do not overlap. A logarithmic axis has no place for 0: `zero` is the value that is drawn instead.
function scaleOf({ low, high, from, to, log, zero, isVertical }) {
  const place = log ? Math.log : (value) => value;
  const position = (value) => from + (place(value) - place(low)) / (place(high) - place(low)) * (to - from);
  const label = (value) => value === zero ? "0" : figures(value);
  const counts = [10, 8, 6, 5, 4, 3, 2];
  const start = zero === undefined ? low : zero * 1.8;
  const sets = log ? [
    ...(high / start < 20 ? counts.map((count) => linearTicks(start, high, count)) : []),
    ...[[1, 2, 3, 5], [1, 2, 5], [1, 3], [1]].map((factors) => decadeTicks(start, high, factors)),
    ...[2, 3, 4].map((every) => decadeTicks(start, high, [1], every))] :
    counts.map((count) => linearTicks(low, high, count));
  const ticksOf = (values) => [...(zero === undefined ? [] : [zero]), ...values]
    .map((value) => ({ value, label: label(value), at: position(value) }));
  const space = (tick) => isVertical ? kFont + 2 : textWidth(tick.label) + 8;
  const isClear = (ticks) => ticks.every((tick, i) => i === 0 ||
    Math.abs(tick.at - ticks[i - 1].at) >= (space(tick) + space(ticks[i - 1])) / 2);
  const all = sets.map(ticksOf).filter((ticks) => ticks.length > 1);
  return { position, ticks: all.find(isClear) ?? ticksOf([]) };
}

function marker(shape, x, y, color, ink) {
  const r = 5;
  const points = (list) => svg("polygon", { points: list.map(([dx, dy]) => `${x + r * dx},${y + r * dy}`).join(" "), fill: color, stroke: ink, "stroke-width": 0.7 });
  switch (shape) {
    case "square": return points([[-0.9, -0.9], [0.9, -0.9], [0.9, 0.9], [-0.9, 0.9]]);
    case "triangle": return points([[0, -1.1], [1.1, 0.9], [-1.1, 0.9]]);
    case "down": return points([[0, 1.1], [1.1, -0.9], [-1.1, -0.9]]);
    case "diamond": return points([[0, -1.3], [1.1, 0], [0, 1.3], [-1.1, 0]]);
    case "cross": return svg("path", { d: `M${x - r},${y - r}l${2 * r},${2 * r}m0,${-2 * r}l${-2 * r},${2 * r}`, stroke: color, "stroke-width": 2.5, fill: "none" });
    case "ring": return svg("circle", { cx: x, cy: y, r, fill: "none", stroke: color, "stroke-width": 2.5 });
    case "box": return svg("rect", { x: x - r, y: y - r, width: 2 * r, height: 2 * r, fill: "none", stroke: color, "stroke-width": 2.5 });
    default: return svg("circle", { cx: x, cy: y, r, fill: color, stroke: ink, "stroke-width": 0.7 });
  }
}

/// Returns the pattern that fills bars of series `i`.
function pattern(i, id, ink) {
  const marks = ["", "M0,8L8,0", "M4,0V8", "M0,0L8,8M0,8L8,0", "M0,4H8", "M3,4h2"];
  return svg("pattern", { id, width: kPattern, height: kPattern, patternUnits: "userSpaceOnUse" },
    svg("rect", { width: kPattern, height: kPattern, fill: palette[i % palette.length] }),
    svg("path", { d: marks[i % marks.length], stroke: ink, "stroke-width": i === 5 ? 2 : 1, fill: "none" }));
}

/// The parts that all figures share: size, colours, a legend above the plot, and room for the axes.
function canvasOf(id, { series, height, left }) {
  const style = getComputedStyle(document.documentElement);
  const [ink, line, card] = ["--ink", "--line", "--card"].map((name) => style.getPropertyValue(name).trim());
  const width = Math.max(280, Math.floor(element(id).clientWidth));
  const image = svg("svg", { xmlns: "http://www.w3.org/2000/svg", width, height, viewBox: `0 0 ${width} ${height}`, "font-family": "sans-serif", "font-size": kFont, fill: ink, role: "img" },
    svg("rect", { width, height, fill: card }));
  let [x, y] = [left, kFont];
  for (const set of series.filter(({ label }) => label)) {
    const label = fitted(set.label, width - left - 40);
    if (x > left && x + 34 + textWidth(label) > width) [x, y] = [left, y + kFont + 6];
    if (set.fill) image.append(svg("rect", { x, y: y - 9, width: 22, height: 11, fill: set.fill, stroke: ink, "stroke-width": 0.5 }));
    else {
      if (set.isLine) image.append(svg("line", { x1: x, x2: x + 22, y1: y - 4, y2: y - 4, stroke: set.color, "stroke-width": 2, "stroke-dasharray": set.dash }));
      if (set.shape) image.append(marker(set.shape, x + 11, y - 4, set.color, ink));
    }
    image.append(svg("text", { x: x + 28, y }, label));
    x += 44 + textWidth(label);
  }
  return { image, ink, line, width, height, top: y + 16 };
}

function drawAxes(view, xScale, yScale, { left, right, bottom, xTitle, yTitle }) {
  const { image, ink, line, top } = view;
  const axes = svg("g", { class: "axes" });
  for (const { label, at } of xScale.ticks) axes.append(
    svg("line", { x1: at, x2: at, y1: top, y2: bottom, stroke: line }),
    svg("text", { class: "tick x", x: Math.min(at, view.width - textWidth(label) / 2), y: bottom + 16, "text-anchor": "middle" }, label));
  for (const { label, at } of yScale?.ticks ?? []) axes.append(
    svg("line", { x1: left, x2: right, y1: at, y2: at, stroke: line }),
    svg("text", { class: "tick y", x: left - 6, y: at + 4, "text-anchor": "end" }, label));
  axes.append(svg("path", { d: `M${left},${top}V${bottom}H${right}`, stroke: ink, fill: "none" }));
  axes.append(svg("text", { x: (left + right) / 2, y: bottom + 36, "text-anchor": "middle" }, fitted(xTitle, right - left + left)));
  if (yTitle) {
    const middle = (top + bottom) / 2;
    axes.append(svg("text", { x: 13, y: middle, "text-anchor": "middle", transform: `rotate(-90 13 ${middle})` }, fitted(yTitle, bottom - top + 30)));
  }
  image.append(axes);
}

function errorBar(x1, y1, x2, y2, color) {
  const cap = 4;
  const ends = x1 === x2 ? `M${x1 - cap},${y1}h${2 * cap}M${x1 - cap},${y2}h${2 * cap}` : `M${x1},${y1 - cap}v${2 * cap}M${x2},${y2 - cap}v${2 * cap}`;
  return svg("path", { class: "error-bar", d: `M${x1},${y1}L${x2},${y2}${ends}`, stroke: color, "stroke-width": 1.3, fill: "none" });
}

/// Writes the number of its run beside each point, on the side with the fewest other marks.
function numberPoints(image, points, area) {
  const boxes = points.map(({ x, y }) => ({ x, y, half: 5 }));
  const done = new Set();
  for (const { x, y, run, number } of points) {
    if (!run || number === undefined || done.has(run)) continue;
    done.add(run);
    const spots = [12, 19, 26].flatMap((far) => [[1, -0.7], [1, 0.7], [-1, -0.7], [-1, 0.7], [0, -1], [0, 1], [1, 0], [-1, 0]]
      .map(([dx, dy]) => ({ x: x + far * dx, y: y + far * dy, half: 3 + 3.5 * number.length, far })));
    const cost = (spot) => spot.far / 10 + boxes.reduce((sum, box) => sum +
      Math.max(0, spot.half + box.half - Math.abs(spot.x - box.x)) * Math.max(0, 7 + box.half - Math.abs(spot.y - box.y)), 0) +
      (spot.x < area.left || spot.x > area.right || spot.y < area.top || spot.y > area.bottom ? 100 : 0);
    const best = spots.reduce((a, b) => cost(b) < cost(a) ? b : a);
    boxes.push(best);
    image.append(svg("text", { x: best.x, y: best.y + 4, "text-anchor": "middle", "font-size": 11 }, number));
  }
}

/// Draws points and lines. A series has {label, points: [{x, y, xRange, yRange, run, number, title}], color, shape, dash,
/// isLine}. Ranges are error bars.
function drawXY(id, { series, xTitle, yTitle, xLog, yLog, xZero, yZero, height = 340, onClick, whole }) {
  const left = 70;
  const view = canvasOf(id, { series, height, left });
  const [right, bottom] = [view.width - 12, height - 48];
  const points = series.flatMap((set) => set.points);
  const zeroed = (value, log, zero) => log && !(value > 0) ? zero : value;
  const limits = (axis, range, log, zero, isFromZero) => {
    const values = points.flatMap((point) => [point[axis], ...(point[range] ?? [])]).map((value) => zeroed(value, log, zero));
    if (values.length === 0) return [log ? 1 : 0, 10];
    const [min, max] = [Math.min(...values), Math.max(...values)];
    if (log) return min < max ? [min / (max / min) ** 0.05, max * (max / min) ** 0.05] : [min / 2, max * 2];
    const pad = 0.05 * (max - min || Math.abs(max) || 1);
    return [isFromZero && min >= 0 && min < 0.4 * max ? 0 : min - pad, max + pad];
  };
  const [xLow, xHigh] = limits("x", "xRange", xLog, xZero, true);
  const [yLow, yHigh] = limits("y", "yRange", yLog, yZero, true);
  const xScale = scaleOf({ low: xLow, high: xHigh, from: left, to: right, log: xLog, zero: xZero });
  const yScale = scaleOf({ low: yLow, high: yHigh, from: bottom, to: view.top, log: yLog, zero: yZero, isVertical: true });
  if (whole) xScale.ticks = xScale.ticks.filter((tick) => Number.isInteger(tick.value));
  drawAxes(view, xScale, yScale, { left, right, bottom, xTitle, yTitle });
  const at = (x, y) => [xScale.position(zeroed(x, xLog, xZero)), yScale.position(zeroed(y, yLog, yZero))];
  const drawn = [];
  for (const set of series) {
    const places = set.points.map((point) => at(point.x, point.y));
    if (set.isBand) {
      const edge = (i) => set.points.map((point) => at(point.x, point.yRange[i]).join(","));
      view.image.append(svg("polygon", { class: "error-bar", points: [...edge(0), ...edge(1).reverse()].join(" "), fill: set.color, "fill-opacity": 0.18 }));
    }
    if (set.isLine) view.image.append(svg("polyline", { points: places.map((place) => place.join(",")).join(" "), fill: "none", stroke: set.color, "stroke-width": 1.8, "stroke-dasharray": set.dash }));
    set.points.forEach((point, i) => {
      const [x, y] = places[i];
      if (point.xRange) view.image.append(errorBar(at(point.xRange[0], point.y)[0], y, at(point.xRange[1], point.y)[0], y, set.color));
      if (point.yRange && !set.isBand) view.image.append(errorBar(x, at(point.x, point.yRange[0])[1], x, at(point.x, point.yRange[1])[1], set.color));
      if (!set.shape) return;
      const mark = marker(set.shape, x, y, set.color, view.ink);
      mark.classList.add("point");
      if (point.title) mark.append(svg("title", {}, point.title));
      if (point.run) {
        mark.dataset.run = point.run.name;
        mark.style.cursor = "pointer";
        mark.addEventListener("click", () => onClick?.(point.run));
      }
      view.image.append(mark);
      drawn.push({ x, y, run: point.run, number: point.number });
    });
  }
  numberPoints(view.image, drawn, { left, right, top: view.top, bottom });
  const rows = series.flatMap((set) => set.points.map((point) =>
    [set.label ?? "", point.run?.name ?? "", point.x, ...(point.xRange ?? ["", ""]), point.y, ...(point.yRange ?? ["", ""])]));
  publish(id, view.image, [["series", "run", xTitle, "low", "high", yTitle, "low", "high"], ...rows]);
}

/// Draws horizontal bars. `groups` are the rows: {label, bars: [[{value, series}, ...], ...]} with stacked parts per bar,
/// {range} for an error bar at the end, and {note} for a text after the bar.
function drawBars(id, { series, groups, xTitle }) {
  const left = Math.min(260, Math.max(70, 0.28 * element(id).clientWidth));
  const [thick, gap] = [15, 8];
  const heightOf = (group) => group.bars.length * (thick + 2) + gap;
  const body = groups.reduce((sum, group) => sum + heightOf(group), 0);
  const filled = series.map((set, i) => ({ ...set, fill: `url(#${id}-${i})` }));
  const probe = canvasOf(id, { series: filled, height: 10, left });
  const view = canvasOf(id, { series: filled, height: probe.top + body + 54, left });
  view.image.prepend(svg("defs", {}, ...series.map((set, i) => pattern(i, `${id}-${i}`, view.ink))));
  const ends = groups.flatMap((group) => group.bars.map((bar) => Math.max(bar.parts.reduce((sum, part) => sum + part.value, 0), bar.range?.[1] ?? 0)));
  const note = Math.max(0, ...groups.flatMap((group) => group.bars.map((bar) => bar.note ? textWidth(bar.note) + 14 : 0)));
  const right = view.width - 12;
  const scale = scaleOf({ low: 0, high: Math.max(...ends, 1e-9) * (right - left) / Math.max(50, right - left - note), from: left, to: right });
  const bottom = view.top + body;
  drawAxes(view, scale, null, { left, right, bottom, xTitle });
  let y = view.top + gap / 2;
  const rows = [];
  for (const group of groups) {
    view.image.append(svg("text", { x: left - 6, y: y + heightOf(group) / 2, "text-anchor": "end" }, fitted(group.label, left - 10), svg("title", {}, group.label)));
    for (const bar of group.bars) {
      let sum = 0;
      for (const part of bar.parts) {
        const x = scale.position(sum);
        sum += part.value;
        view.image.append(svg("rect", { x, y, width: Math.max(0, scale.position(sum) - x), height: thick, fill: filled[part.series].fill, stroke: view.ink, "stroke-width": 0.5 },
          svg("title", {}, `${series[part.series].label}: ${figures(part.value)}`)));
        rows.push([group.label, series[part.series].label, part.value, ...(bar.range ?? ["", ""]), bar.note ?? ""]);
      }
      if (bar.range) view.image.append(errorBar(scale.position(bar.range[0]), y + thick / 2, scale.position(bar.range[1]), y + thick / 2, view.ink));
      if (bar.note) view.image.append(svg("text", { x: scale.position(Math.max(sum, bar.range?.[1] ?? 0)) + 8, y: y + thick - 3 }, bar.note));
      y += thick + 2;
    }
    y += gap;
  }
  publish(id, view.image, [["row", "series", xTitle, "low", "high", "note"], ...rows]);
}

/// Shows a figure with its downloads.
function publish(id, image, rows) {
  const cell = (value) => /[",\n]/.test(value) ? `"${String(value).replaceAll('"', '""')}"` : String(value ?? "");
  const link = (kind, type, text) => Object.assign(document.createElement("a"),
    { href: `data:${type};charset=utf-8,${encodeURIComponent(text)}`, download: `${id}.${kind}`, textContent: kind.toUpperCase() });
  const links = Object.assign(document.createElement("p"), { className: "downloads" });
  links.append("Download: ", link("svg", "image/svg+xml", new XMLSerializer().serializeToString(image)), " ",
    link("csv", "text/csv", `${rows.map((row) => row.map(cell).join(",")).join("\n")}\n`));
  element(id).replaceChildren(image, links);
}
