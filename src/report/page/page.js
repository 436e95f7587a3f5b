"use strict";
const data = JSON.parse(document.getElementById("data").textContent);
const element = (id) => document.getElementById(id);
const kWrong = "wrong_pixels_all";

/// Returns a number with three significant digits, as the sentences cite it.
function figures(value) {
  if (value === null || value === undefined) return "";
  if (value === 0) return "0";
  const decimals = Math.min(24, Math.max(0, 2 - Math.floor(Math.log10(Math.abs(value)))));
  const text = value.toFixed(decimals);
  return text.includes(".") ? text.replace(/\.?0+$/, "") : text;
}

const percent = (fraction) => `${figures(100 * fraction)}%`;
const known = (key) => data.runs.filter((run) => run.errors[key] !== undefined);
const numberOf = (run) => String(data.runs.indexOf(run) + 1);

/// The errors of the plots. Shares are shown in percent.
const shares = new Set([kWrong, "wrong_or_missed_fraction", "image_difference"]);
const scaled = (key, value) => shares.has(key) ? 100 * value : value;
const titles = {
  [kWrong]: "wrong pixels, % of all", promised_aliasing: "aliasing bound", shadow_edge_p99_px: "edge distance, pixels",
  measured_aliasing: "measured aliasing", wrong_or_missed_fraction: "wrong or missed, % of lit side", image_difference: "image difference, %",
};

/// Returns the settings in which `run` differs from most runs. If there are none, returns "usual settings".
function shortName(run) {
  const usual = (key) => {
    const counts = new Map();
    for (const each of data.runs) counts.set(each.settings[key], (counts.get(each.settings[key]) ?? 0) + 1);
    return [...counts].sort((a, b) => b[1] - a[1])[0][0];
  };
  const own = Object.keys(run.settings).filter((key) => run.settings[key] !== usual(key));
  return own.map((key) => `${key} ${run.settings[key]}`).join(", ") || "usual settings";
}

const timeRange = (run) => run.noise === null ? undefined : [run.p50 * Math.max(0, 1 - run.noise), run.p50 * (1 + run.noise)];
const errorRange = (run, key) => run.error_ranges?.[key]?.map((value) => scaled(key, value));

function describe(run) {
  const errors = data.errors.filter((e) => run.errors[e.key] !== undefined).map((e) => `${titles[e.key]}: ${figures(scaled(e.key, run.errors[e.key]))}`);
  return [`Run ${numberOf(run)}: ${shortName(run)}`,
    `${figures(run.p50)} ms${run.noise === null ? "" : ` ± ${percent(run.noise)}`} (95%: ${figures(run.p95)} ms, 99%: ${figures(run.p99)} ms)`, ...errors].join("\n");
}

/// The meaning of the columns of the table and of the settings.
const terms = {
  "#": "Number of the run in the figures.",
  settings: "Settings in which the run differs from most runs.",
  "median ms": "Median frame time. 95% ms and 99% ms are the 95th and 99th percentile.",
  "noise, %": "Spread of the repetitions: half the range of their medians. Two times differ measurably if their ranges are disjoint.",
  "image triangles": "Mean number of triangles drawn into the image per frame; shadow triangles: into all shadow maps.",
  "storage factor": "Texels of all maps per pixel for an aliasing bound of 1.",
  [titles[kWrong]]: "Share of all pixels whose result (lit or dark) differs from integer arithmetic on the same triangles. This is the measure of accuracy. Exact shadows have 0.",
  [titles.promised_aliasing]: "Max width of a texel per width of a pixel, known before a frame is drawn. It ignores the slant of surfaces.",
  [titles.measured_aliasing]: "The same ratio, measured at the pixels.",
  [titles.wrong_or_missed_fraction]: "Share of the pixels that face the light whose shadow differs from ray tracing. It includes casters that are thinner than a texel.",
  [titles.shadow_edge_p99_px]: "Distance of shadow edges from ray-traced edges: 99% of the edge pixels are nearer.",
  [titles.image_difference]: "Mean absolute difference from full detail with ray-traced shadows. It also measures the level of detail.",
  "crawl, %": "Share of fixed points whose shadow changed between two frames although only the eye moved.",
  "bound kept": "Whether all frames had at most the aliasing of --max-aliasing.",
  error_pixels: "Level of detail: max geometric error in pixels.",
  shadow_maps: "Number of shadow maps.",
  z_partitions: "Number of slices of the view along its depth. Each slice has its own maps.",
  face_partitions: "Whether the view is also partitioned along the faces of its frustum.",
  shadow_texels: "Total number of texels of all shadow maps.",
  cull_casters: "Triangles that a map draws: all (off), those that can shadow its slice (on), or those that can shadow visible surfaces (receivers).",
  warp: "Reparameterisation that gives texels near the eye more resolution.",
  filter: "Width of the filter in texels; 0 is no filter.",
  stabilize: "Maps move by whole texels, so that shadow edges do not flicker.",
  occlusion: "Whether hidden clusters are culled.",
  shadows: "Shadow maps, exact shadows, rays, or none.",
  cells: "Layout of the sample grid of exact shadows.",
};

const made = (tag, textContent) => Object.assign(document.createElement(tag), { textContent });

/// Fills a list with the meanings of `keys`.
function explain(list, keys) {
  list.replaceChildren(...keys.filter((key) => terms[key]).flatMap((key) => [made("dt", key), made("dd", terms[key])]));
}

function drawErrorTime() {
  const { key } = data.errors.find((e) => e.key === element("error-kind").value);
  const log = element("log-error").checked;
  const visible = known(key);
  const positive = visible.flatMap((run) => [run.errors[key], ...(run.error_ranges?.[key] ?? [])]).filter((error) => error > 0).map((error) => scaled(key, error));
  const hasZero = visible.some((run) => run.errors[key] === 0 || run.error_ranges?.[key]?.[0] === 0);
  const point = (run) => ({ x: run.p50, y: scaled(key, run.errors[key]), xRange: timeRange(run), yRange: errorRange(run, key), run, number: numberOf(run), title: describe(run) });
  const isExact = (run) => run.settings.cells !== undefined;
  const kinds = [["shadow maps", (run) => run.shadow_maps > 0, 0], ["exact shadows", isExact, 1], ["others", (run) => !isExact(run) && !(run.shadow_maps > 0), 2]];
  const front = data.fronts[key].map((i) => data.runs[i]);
  drawXY("error-time", {
    xTitle: "median frame time, ms", yTitle: titles[key], yLog: log, yZero: log && hasZero ? Math.min(...positive, 1) / 4 : undefined,
    height: 420, onClick: lookAt,
    series: [
      { label: "Pareto front", isLine: true, color: palette[6], dash: dashes[1], points: front.map((run) => ({ x: run.p50, y: scaled(key, run.errors[key]) })) },
      ...kinds.map(([label, is, i]) => ({ label, shape: shapes[i], color: palette[i], points: visible.filter(is).map(point) })).filter((set) => set.points.length > 0),
    ],
  });
  explain(element("error-terms"), [titles[key]]);
}

/// Shows the run that the program recommends for the limit in `input`. `steps` are pairs of a limit and the recommended
/// run from this limit on.
function answerLimit(input, output, steps, scale) {
  const limit = element(input).valueAsNumber / scale;
  if (Number.isNaN(limit)) return void (element(output).textContent = "");
  const step = steps.filter(([from]) => from <= limit * (1 + 1e-12)).at(-1);
  if (!step) return void (element(output).textContent = "no run");
  const run = data.runs[step[1]];
  element(output).textContent = `${run.options}   (run ${numberOf(run)}: ${figures(run.p50)} ms, ${percent(run.errors[kWrong])} wrong pixels)`;
}

function showLimits() {
  for (const [name, steps, scale] of [["budget", data.budget_steps, 1], ["bound", data.bound_steps, 100]]) {
    if (steps.length === 0) element(`${name}-control`).remove();
    else element(name).addEventListener("input", () => answerLimit(name, `${name}-answer`, steps, scale));
  }
}

function drawMaps() {
  const groups = new Map();
  for (const run of data.runs.filter((r) => r.shadow_maps > 0)) {
    const { shadow_maps: _, z_partitions: __, ...others } = run.settings;
    const key = JSON.stringify(others);
    if (!groups.has(key)) groups.set(key, []);
    groups.get(key).push(run);
  }
  const sweeps = [...groups.values()].filter((runs) => new Set(runs.map((r) => r.shadow_maps)).size > 1);
  const caption = element("maps-caption");
  if (sweeps.length === 0) {
    caption.textContent = "No two runs differ only in their number of maps.";
    return void element("time-maps").remove();
  }
  const differing = Object.keys(data.runs[0].settings).filter((key) => !["shadow_maps", "z_partitions"].includes(key) &&
    new Set(sweeps.map((runs) => runs[0].settings[key])).size > 1);
  const series = sweeps.flatMap((runs, i) => {
    const sorted = [...runs].sort((a, b) => a.shadow_maps - b.shadow_maps);
    const name = differing.map((k) => `${k} ${runs[0].settings[k]}`).join(", ");
    return ["shadow", "image"].map((stage, j) => ({
      label: [name, `${stage} pass`].filter(Boolean).join(": "), isLine: true, color: palette[(2 * i + j) % palette.length], dash: dashes[(2 * i + j) % dashes.length],
      shape: shapes[(2 * i + j) % shapes.length],
      points: sorted.map((run) => ({ x: run.shadow_maps, y: run.stages[stage], yRange: run.stage_ranges?.[stage], run, title: describe(run) })),
    }));
  });
  drawXY("time-maps", { xTitle: "number of shadow maps", yTitle: "ms", series, onClick: lookAt, whole: true });
  const culling = new Set(sweeps.map((runs) => runs[0].settings.cull_casters));
  const casters = culling.has("on") && culling.has("off") ? " With and without culling of casters per partition." :
    culling.has("auto") || culling.has("receivers") ? " Casters are culled per partition and by visible surfaces." :
    culling.has("on") ? " Casters are culled per partition." : culling.has("off") ? " Casters are not culled." : "";
  caption.textContent = `Median times of the shadow and image passes, as in figure 13 of Lloyd et al. 2006.${casters}`;
}

/// Draws exact shadows for each layout of the sample grid, with shadow maps of the same layout.
function drawCells() {
  const exact = data.runs.filter((run) => run.settings.cells !== undefined);
  if (exact.length < 2) return void element("cells-section").remove();
  const usual = data.runs.find((run) => run.shadow_maps > 0) ?? exact[0];
  const alike = (run) => ["error_pixels", "shadow_texels", "cull_casters", "filter"].every((key) => run.settings[key] === usual.settings[key]);
  const mapsOf = (scheme) => data.runs.find((run) => run.shadow_maps > 0 && run.scheme === scheme && alike(run));
  const names = { "map": "one map, no warp", "map+w": "one map, warp", "zp4": "4 slices, no warp", "zp4+w": "4 slices, warp" };
  const bar = (run, series) => ({
    parts: [{ value: run.stages.shadow, series }], range: run.stage_ranges?.shadow,
    note: run.errors[kWrong] === undefined ? "" : `${percent(run.errors[kWrong])} wrong`,
  });
  drawBars("cells", {
    xTitle: "time of the shadow pass, ms", series: [{ label: "exact shadows" }, { label: "shadow maps" }],
    groups: Object.keys(names).map((scheme) => [scheme, exact.find((run) => run.scheme === scheme), mapsOf(scheme)]).filter(([, run]) => run)
      .map(([scheme, run, maps]) => ({ label: names[scheme], bars: [bar(run, 0), ...(maps ? [bar(maps, 1)] : [])] })),
  });
}

function drawStorage() {
  if (data.storage.length === 0) return void element("storage-maps").parentElement.remove();
  const schemes = [...new Set(data.storage.map((p) => p.scheme))];
  drawXY("storage-maps", {
    xTitle: "number of shadow maps", yTitle: "storage factor", yLog: true, whole: true,
    series: schemes.map((label, i) => ({
      label, isLine: true, color: palette[i % palette.length], dash: dashes[i % dashes.length], shape: shapes[i % shapes.length],
      points: data.storage.filter((p) => p.scheme === label).map((p) => ({ x: p.maps, y: p.S })),
    })),
  });
}

function drawAliasing() {
  const both = known("promised_aliasing").filter((run) => run.errors.measured_aliasing !== undefined);
  if (both.length === 0) element("promise").parentElement.remove();
  else {
    const largest = Math.max(1, ...both.map((run) => run.errors.promised_aliasing));
    drawXY("promise", { xTitle: titles.promised_aliasing, yTitle: titles.measured_aliasing, onClick: lookAt, series: [
      { label: "runs", shape: shapes[0], color: palette[0], points: both.map((run) => ({ x: run.errors.promised_aliasing, y: run.errors.measured_aliasing, run, number: numberOf(run), title: describe(run) })) },
      { label: "measured = bound", isLine: true, color: palette[1], dash: dashes[1], points: [{ x: 0, y: 0 }, { x: largest, y: largest }] },
    ] });
  }
  const wrong = known("promised_aliasing").filter((run) => run.errors[kWrong] !== undefined);
  if (wrong.length === 0) return void element("wrong").parentElement.remove();
  const outliers = new Set(data.correlation.outliers.map((i) => data.runs[i]));
  const points = (isOutlier) => wrong.filter((run) => outliers.has(run) === isOutlier)
    .map((run) => ({ x: run.errors.promised_aliasing, y: 100 * run.errors[kWrong], yRange: errorRange(run, kWrong), run, number: numberOf(run), title: describe(run) }));
  drawXY("wrong", { xTitle: titles.promised_aliasing, yTitle: titles[kWrong], onClick: lookAt, series: [
    { label: "runs", shape: shapes[0], color: palette[0], points: points(false) },
    ...(outliers.size ? [{ label: "outliers", shape: shapes[1], color: palette[1], points: points(true) }] : []),
  ] });
  element("correlation").textContent = "Bars show the spread of the frames. " +
    (data.correlation.runs < 3 ? "The runs are too few for a correlation." :
      `The rank correlation (Spearman) of ${data.correlation.runs} runs is ${figures(data.correlation.rank)}.` +
      (outliers.size ? ` Outliers are the runs whose ranks differ by more than a third: ${[...outliers].map(numberOf).join(", ")}.` : ""));
}

function drawStages() {
  const stages = ["plan", "select", "cull", "stream", "shadow", "image"];
  drawBars("stages", {
    xTitle: "ms", series: stages.map((label) => ({ label })),
    groups: data.runs.map((run) => ({ label: `${numberOf(run)}: ${shortName(run)}`, bars: [{
      parts: stages.map((stage, series) => ({ value: run.stages[stage], series })), range: timeRange(run) ?? [run.p50, run.p50] }] })),
  });
}

/// The runs of the figure along the path: at first the fastest, the most accurate and the recommended run.
const pathRuns = new Set();
function drawPath() {
  const runs = data.runs.filter((run) => pathRuns.has(run));
  drawXY("path", {
    xTitle: "frame", yTitle: "ms", whole: true,
    series: runs.map((run, i) => ({
      label: `${numberOf(run)}: ${shortName(run)}`, isLine: true, isBand: run.frame_ranges?.length > 0, color: palette[i % palette.length], dash: dashes[i % dashes.length],
      points: run.frames.map((ms, frame) => ({ x: frame, y: ms, yRange: run.frame_ranges?.[frame] })),
    })),
  });
}

function choosePath() {
  const fastest = data.runs.reduce((a, b) => b.p50 < a.p50 ? b : a, data.runs[0]);
  const accurate = known(data.leading_error).reduce((a, b) => a && a.errors[data.leading_error] <= b.errors[data.leading_error] ? a : b, undefined);
  for (const run of [fastest, accurate, data.runs[data.recommended.run]]) if (run) pathRuns.add(run);
  element("path-runs").replaceChildren("Runs:", ...data.runs.map((run) => {
    const box = Object.assign(document.createElement("input"), { type: "checkbox", checked: pathRuns.has(run) });
    box.addEventListener("change", () => {
      if (box.checked) pathRuns.add(run);
      else pathRuns.delete(run);
      drawPath();
    });
    const label = made("label", ` ${numberOf(run)}`);
    label.title = shortName(run);
    label.prepend(box);
    return label;
  }));
}

function showTable() {
  const number = (value, extra) => ({ value, extra, text: (run) => figures(value(run)) });
  const columns = [
    ["#", number((r) => data.runs.indexOf(r) + 1)], ["settings", { value: shortName, text: shortName }],
    ["median ms", number((r) => r.p50)], ["95% ms", number((r) => r.p95, true)], ["99% ms", number((r) => r.p99, true)],
    ["noise, %", number((r) => r.noise === null ? null : 100 * r.noise, true)],
    ...data.errors.map(({ key }, i) => [titles[key], number((r) => r.errors[key] === undefined ? null : scaled(key, r.errors[key]), i > 1)]),
    ["crawl, %", number((r) => r.crawl === null ? null : 100 * r.crawl, true)],
    ["image triangles", number((r) => r.image_triangles, true)], ["shadow triangles", number((r) => r.shadow_triangles, true)],
    ["storage factor", number((r) => r.storage_factor || null, true)], ["bound kept", { value: (r) => r.bound_kept ? "yes" : "no", text: (r) => r.bound_kept ? "yes" : "no", extra: true }],
  ];
  const varies = (text) => new Set(data.runs.map(text)).size > 1;
  const shown = columns.filter(([title, { text }]) => ["#", "settings", "median ms"].includes(title) || varies(text));
  const settings = [...new Set(data.runs.flatMap((run) => Object.keys(run.settings)))];
  const same = [
    ...settings.filter((key) => !varies((run) => run.settings[key] ?? "")).map((key) => `${key} ${data.runs[0].settings[key]}`),
    ...columns.filter((column) => !shown.includes(column)).filter(([, { text }]) => text(data.runs[0]) !== "").map(([title, { text }]) => `${title} ${text(data.runs[0])}`),
  ];
  element("same").textContent = data.runs.length > 0 && same.length > 0 ? `The same for all runs: ${same.join("; ")}.` : "";
  const table = element("table");
  let order = data.runs.map((_, i) => i);
  const render = () => {
    const onFront = new Set(data.fronts[element("error-kind").value]);
    table.tBodies[0].replaceChildren(...order.map((i) => {
      const row = document.createElement("tr");
      if (onFront.has(i)) row.className = "front";
      for (const [, { text, extra }] of shown) row.append(Object.assign(made("td", text(data.runs[i])), { className: extra ? "extra" : "" }));
      return row;
    }));
  };
  const head = table.createTHead().insertRow();
  table.createTBody();
  for (const [title, { value, extra }] of shown) {
    const cell = Object.assign(made("th", title), { title: terms[title] ?? "", className: extra ? "extra" : "" });
    let ascending = false;
    cell.addEventListener("click", () => {
      ascending = !ascending;
      const compare = (a, b) => typeof a === "number" && typeof b === "number" ? a - b : String(a ?? "").localeCompare(String(b ?? ""), "en", { numeric: true });
      order = [...order].sort((i, j) => (ascending ? 1 : -1) * compare(value(data.runs[i]), value(data.runs[j])));
      render();
    });
    head.append(cell);
  }
  element("error-kind").addEventListener("change", render);
  explain(element("terms"), [...shown.map(([title]) => title), ...settings.filter((key) => varies((run) => run.settings[key] ?? ""))]);
  render();
}

function showNoise() {
  const noises = data.runs.map((run) => run.noise).filter((noise) => noise !== null).sort((a, b) => a - b);
  element("noise").textContent = noises.length === 0 ? `Each run has one repetition, so its noise is unknown; ${percent(data.unknown_noise)} is assumed.` :
    `The noise of the runs is ${percent(noises[Math.floor(noises.length / 2)])} (median) and at most ${percent(noises.at(-1))}.`;
}

function showHeader() {
  element("model").textContent = data.model;
  element("sentences").replaceChildren(...data.sentences.map((sentence) => made("p", sentence)));
  const { recommended } = data;
  if (recommended.command === undefined) element("command").parentElement.remove();
  else element("command").textContent = recommended.command;
  element("recommended-why").textContent = (recommended.run === undefined ? "" : `Run ${recommended.run + 1}. `) + recommended.reason;
  for (const [name, value] of Object.entries(data.context))
    element("context").append(made("dt", name), made("dd", typeof value === "string" ? value : JSON.stringify(value)));
  for (const [title, file] of [["CSV, one row per frame", data.csv], ["JSON", data.json]])
    if (file) element("links").append(Object.assign(made("a", title), { href: file }), " ");
}

function drawAll() {
  for (const draw of [drawErrorTime, drawMaps, drawCells, drawStorage, drawAliasing, drawStages, drawPath]) draw();
}

for (const { key } of data.errors.slice(0, 3)) if (known(key).length > 0) element("error-kind").add(new Option(titles[key], key));
if (element("error-kind").length === 0) element("error-kind").add(new Option(titles[kWrong], kWrong));
element("error-kind").value = data.leading_error;
element("error-kind").addEventListener("change", drawErrorTime);
element("log-error").addEventListener("change", drawErrorTime);
showHeader();
showNoise();
showLimits();
if (data.runs.length > 0) {
  choosePath();
  drawAll();
}
showPrices();
showPictures();
showTable();
let drawnWidth = document.documentElement.clientWidth;
addEventListener("resize", () => {
  if (document.documentElement.clientWidth === drawnWidth || data.runs.length === 0) return;
  drawnWidth = document.documentElement.clientWidth;
  for (const draw of [drawErrorTime, drawStages, drawPath]) draw();
  for (const [id, draw] of [["time-maps", drawMaps], ["cells", drawCells], ["storage-maps", drawStorage]]) if (element(id)) draw();
  if (element("promise") && element("wrong")) drawAliasing();
});
document.documentElement.dataset.ready = "yes";
