"use strict";
const data = JSON.parse(document.getElementById("data").textContent);
const element = (id) => document.getElementById(id);
const style = getComputedStyle(document.documentElement);
const [ink, line, accent] = ["--ink", "--line", "--accent"].map((name) => style.getPropertyValue(name).trim());
const palette = ["#4477aa", "#ee6677", "#228833", "#ccbb44", "#66ccee", "#aa3377", "#bb5500", "#777777"];

Object.assign(Chart.defaults, { color: ink, borderColor: line, animation: false, maintainAspectRatio: false });

const figures = (value) => value === null || value === undefined ? "" : Number(value.toPrecision(4)).toString();
const percent = (fraction) => `${figures(100 * fraction)}%`;
const axis = (title, logarithmic) => ({ type: logarithmic ? "logarithmic" : "linear", title: { display: true, text: title } });
/// A logarithmic axis of its own would reach down to a power of ten, and label little but those.
const around = (values) => ({ min: Math.min(...values) / 1.2, max: Math.max(...values) * 1.2, ticks: { callback: figures } });
const known = (key) => data.runs.map((run, i) => ({ run, i })).filter(({ run }) => run.errors[key] !== undefined);

/// The settings of `run` in which it differs from most of the runs: a name that fits under a bar.
function shortName(run) {
  const usual = (key) => {
    const counts = new Map();
    for (const each of data.runs) counts.set(each.settings[key], (counts.get(each.settings[key]) ?? 0) + 1);
    return [...counts].sort((a, b) => b[1] - a[1])[0][0];
  };
  const own = Object.keys(run.settings).filter((key) => run.settings[key] !== usual(key));
  return own.map((key) => `${key} ${run.settings[key]}`).join(", ") || "the usual settings";
}

function describe(run) {
  const errors = data.errors.filter((e) => run.errors[e.key] !== undefined).map((e) => `${e.key} ${figures(run.errors[e.key])}`);
  return [`${data.runs.indexOf(run) + 1}: ${run.name}`, `${figures(run.p50)} ms${run.noise === null ? "" : ` ± ${percent(run.noise)}`} (p95 ${figures(run.p95)}, p99 ${figures(run.p99)})`, ...errors];
}

/// A logarithmic axis has no place for 0: the one below all others that `zero` names, if it does.
const zeroTick = (zero) => zero === undefined ? {} : {
  afterBuildTicks: (scale) => { scale.ticks = [{ value: zero }, ...scale.ticks.filter((tick) => tick.value > 1.5 * zero)]; },
  ticks: { callback: (value) => value === zero ? "0" : figures(value) },
};

function scatter(id, xTitle, yTitle, datasets, logarithmic = {}) {
  return new Chart(element(id), {
    type: "scatter",
    data: { datasets },
    options: {
      onClick: (event, items, chart) => items.length && lookAt(chart.data.datasets[items[0].datasetIndex].data[items[0].index].run),
      scales: {
        x: axis(xTitle, logarithmic.x),
        y: { ...axis(yTitle, logarithmic.y), ...(logarithmic.y ? around(datasets.flatMap((set) => set.data.map((point) => point.y))) : {}), ...zeroTick(logarithmic.zero) },
      },
      plugins: { tooltip: { callbacks: { label: (item) => item.raw.run ? describe(item.raw.run) : `${figures(item.raw.x)}, ${figures(item.raw.y)}` } } },
    },
  });
}

/// What each column of the table means, and each error of the plots.
const terms = {
  "#": "The number of the run in the plots.",
  run: "The settings in which the runs differ.",
  "p50 ms": "The median frame time: half of the frames were faster. p95 and p99: 95 and 99 of 100 were.",
  noise: "How far the medians of the repetitions lie from their middle, at most. Two times are told apart where they differ by more than both noises.",
  "mean image tri": "Triangles drawn for the picture, a frame on average; mean shadow tri: those drawn into shadow maps.",
  S: "Storage factor: the texels that all maps together need for each pixel, so that no texel is wider than a pixel.",
  wrong_pixels_all: "The share of all pixels, background and what is turned from the light included, that are lit where integer arithmetic has the run's own triangles shadow them, or the other way round.",
  promised_aliasing: "The most pixels that a shadow texel may be wide, known before the frame is drawn, for surfaces that face eye and light alike.",
  measured_aliasing: "The same, as found at the pixels of the pictures.",
  wrong_or_missed_fraction: "The share of the pixels that face the light whose shadow is not the one that rays find at the run's own detail, casters too thin for a map's texels included.",
  shadow_edge_p99_px: "How far the shadow edges lie from those that rays find; 99 of 100 edge pixels are nearer.",
  image_difference: "The mean difference from full detail in ray-traced shadows, a share of full scale: it tells coarse models from fine ones too.",
  crawl: "The share of fixed points of the model whose shadow changed from one frame to the next, though nothing but the eye moved.",
  "promise kept": "Whether all frames kept the aliasing that --max-aliasing asks for, where a number of maps was chosen for it.",
  error_pixels: "Level of detail: how many pixels the model's surface may be off.",
  shadow_maps: "The number of shadow maps.",
  z_partitions: "Slices of the view by depth, each with a map of its own.",
  face_partitions: "Whether slices are cut along the faces of the view's pyramid as well.",
  shadow_texels: "The texels of all shadow maps together.",
  cull_casters: "Which triangles a map draws: all (off), those that can throw a shadow into its slice (on), or those of them that can change a pixel (receivers).",
  warp: "How a map gives what is near to the eye more texels.",
  filter: "How many texels a lookup averages across; 0 is one texel.",
  stabilize: "Maps that move by whole texels, so that edges stand still.",
  occlusion: "Whether what is hidden in the picture is left out before it is drawn.",
  shadows: "Shadow maps, exact shadows, rays, or none.",
  cells: "The layout by which exact shadows sort what is visible.",
};

/// Fills a list with the terms of `keys` that there are.
function explain(list, keys) {
  const made = (tag, textContent) => Object.assign(document.createElement(tag), { textContent });
  list.replaceChildren(...keys.filter((key) => terms[key]).flatMap((key) => [made("dt", key), made("dd", terms[key])]));
}

/// Writes the number of its run beside each point, on the side where the fewest others are in its way.
const pointNumbers = {
  id: "pointNumbers",
  afterDatasetsDraw(chart) {
    const points = chart.data.datasets.flatMap((set, i) => chart.isDatasetVisible(i) && chart.config.type === "scatter" ?
      chart.getDatasetMeta(i).data.map((point, j) => ({ x: point.x, y: point.y, run: set.data[j].run })) : []).filter((point) => point.run);
    const boxes = points.map(({ x, y }) => ({ x, y, half: 4 }));
    const { ctx } = chart;
    ctx.save();
    Object.assign(ctx, { font: "11px system-ui, sans-serif", fillStyle: ink, textAlign: "center", textBaseline: "middle" });
    const done = new Set();
    for (const { x, y, run } of points) {
      const number = String(data.runs.indexOf(run) + 1);
      const place = `${number} ${Math.round(x)} ${Math.round(y)}`;
      if (done.has(place)) continue; // a point of the front lies on that of its run
      done.add(place);
      const spots = [10, 17, 24].flatMap((far) => [[1, -0.6], [1, 0.6], [-1, -0.6], [-1, 0.6], [0, -1], [0, 1], [1, 0], [-1, 0]]
        .map(([dx, dy]) => ({ x: x + far * dx, y: y + far * dy, half: 3 + 3 * number.length, far })));
      const { left, right, top, bottom } = chart.chartArea;
      const cost = (spot) => spot.far / 10 + boxes.reduce((sum, box) => sum +
        Math.max(0, spot.half + box.half - Math.abs(spot.x - box.x)) * Math.max(0, 6 + box.half - Math.abs(spot.y - box.y)), 0) +
        (spot.x < left || spot.x > right || spot.y < top || spot.y > bottom ? 100 : 0);
      const best = spots.reduce((a, b) => cost(b) < cost(a) ? b : a);
      boxes.push(best);
      ctx.fillText(number, best.x, best.y);
    }
    ctx.restore();
  },
};
Chart.register(pointNumbers);

let errorTime;
function drawErrorTime() {
  const kind = data.errors.find((e) => e.key === element("error-kind").value);
  const logarithmic = element("log-error").checked;
  const visible = known(kind.key);
  const errors = visible.map(({ run }) => run.errors[kind.key]);
  const zero = logarithmic && errors.includes(0) ? Math.min(...errors.filter((error) => error > 0), 1) / 4 : undefined;
  const point = (run) => ({ x: run.p50, y: run.errors[kind.key] === 0 && logarithmic ? zero : run.errors[kind.key], run });
  const front = data.fronts[kind.key].map((i) => data.runs[i]);
  if (errorTime) errorTime.destroy();
  errorTime = scatter("error-time", "median frame time, ms", kind.label, [
    { label: "Pareto front", data: front.map(point), showLine: true, borderColor: accent, backgroundColor: accent, pointRadius: 5 },
    { label: "runs", data: visible.map(({ run }) => point(run)), backgroundColor: palette[0], pointRadius: 4 },
  ], { y: logarithmic, zero });
  explain(element("error-terms"), [kind.key]);
  answerBudget();
  answerBound();
}

function answer(output, run) {
  element(output).textContent = run ? `${run.options}   (${figures(run.p50)} ms, error ${figures(run.errors[element("error-kind").value])})` : "no run does";
}

function answerBudget() {
  const [budget, kind] = [element("budget").valueAsNumber, element("error-kind").value];
  if (Number.isNaN(budget)) return void (element("budget-answer").textContent = "");
  const runs = known(kind).map(({ run }) => run).filter((run) => run.p50 * (1 + (run.noise ?? 0)) <= budget);
  answer("budget-answer", runs.sort((a, b) => a.errors[kind] - b.errors[kind] || a.p50 - b.p50)[0]);
}

function answerBound() {
  const [bound, kind] = [element("bound").valueAsNumber, element("error-kind").value];
  if (Number.isNaN(bound)) return void (element("bound-answer").textContent = "");
  const runs = known(kind).map(({ run }) => run).filter((run) => run.errors[kind] <= bound);
  answer("bound-answer", runs.sort((a, b) => a.p50 - b.p50 || a.errors[kind] - b.errors[kind])[0]);
}

function drawMaps() {
  const groups = new Map();
  for (const run of data.runs.filter((r) => r.shadow_maps > 0)) {
    const { shadow_maps: _, z_partitions: __, ...others } = run.settings;
    const key = JSON.stringify(others);
    if (!groups.has(key)) groups.set(key, []);
    groups.get(key).push(run);
  }
  const sweeps = [...groups.entries()].filter(([, runs]) => new Set(runs.map((r) => r.shadow_maps)).size > 1);
  const differing = [...new Set(data.runs.flatMap((r) => Object.keys(r.settings)))]
    .filter((key) => new Set(sweeps.map(([, runs]) => runs[0].settings[key])).size > 1);
  const datasets = [];
  sweeps.forEach(([, runs], i) => {
    const sorted = [...runs].sort((a, b) => a.shadow_maps - b.shadow_maps);
    const name = differing.filter((k) => k !== "shadow_maps" && k !== "z_partitions").map((k) => `${k} ${runs[0].settings[k]}`).join(", ");
    const color = palette[i % palette.length];
    const add = (stage, dash) => datasets.push({
      label: [name, stage].filter(Boolean).join(": "), showLine: true, borderColor: color, backgroundColor: color, borderDash: dash,
      data: sorted.map((run) => ({ x: run.shadow_maps, y: run.stages[stage], run })),
    });
    add("shadow", []);
    add("image", [5, 4]);
  });
  scatter("time-maps", "shadow maps", "ms", datasets);
  const culling = new Set(sweeps.map(([, runs]) => runs[0].settings.cull_casters));
  const casters = culling.has("on") && culling.has("off") ? ", casters culled per partition and not" :
    culling.has("auto") || culling.has("receivers") ? ", casters culled per partition and by what is seen" :
    culling.has("on") ? ", casters culled per partition" : culling.has("off") ? ", casters not culled per partition" : "";
  element("maps-caption").textContent = sweeps.length === 0 ? "No two runs differ in their number of maps alone." :
    `The shape of the paper's figure 13: image and shadow passes${casters}.`;
}

/// Exact shadows over each layout of cells, and the maps that are laid out the same.
function drawCells() {
  const exact = data.runs.filter((run) => run.settings.cells !== undefined);
  if (exact.length < 2) return void element("cells-section").remove();
  const usual = data.runs.find((run) => run.shadow_maps > 0) ?? exact[0];
  const alike = (run) => ["error_pixels", "shadow_texels", "cull_casters", "filter"].every((key) => run.settings[key] === usual.settings[key]);
  const mapsOf = (scheme) => data.runs.find((run) => run.shadow_maps > 0 && run.scheme === scheme && alike(run));
  const names = { "map": "one map, no warp", "map+w": "one map, LSPSM", "zp4": "4 slices, no warp", "zp4+w": "4 slices, LSPSM" };
  const runs = Object.keys(names).map((scheme) => exact.find((run) => run.scheme === scheme)).filter(Boolean);
  const maps = runs.map((run) => mapsOf(run.scheme));
  const bar = (label, of, color) => ({ type: "bar", label, data: of.map((run) => run?.stages.shadow ?? null), backgroundColor: color, of });
  const wrong = (label, of, color) => ({
    type: "line", label, yAxisID: "wrong", showLine: false, pointRadius: 7, pointStyle: "rectRot", backgroundColor: color, borderColor: ink, of,
    data: of.map((run) => run?.errors.wrong_pixels_all === undefined ? null : 100 * run.errors.wrong_pixels_all),
  });
  new Chart(element("cells"), {
    data: {
      labels: runs.map((run) => names[run.scheme]),
      datasets: [wrong("wrong pixels, exact", runs, palette[2]), wrong("wrong pixels, maps", maps, palette[1]),
        bar("exact shadows, ms", runs, palette[0]), bar("shadow maps, ms", maps, palette[7])],
    },
    options: {
      scales: {
        y: { beginAtZero: true, title: { display: true, text: "shadow stage, ms" } },
        wrong: { position: "right", beginAtZero: true, grid: { drawOnChartArea: false }, title: { display: true, text: "wrong pixels, % of all" } },
      },
      plugins: { tooltip: { callbacks: { label: (item) => item.dataset.of[item.dataIndex] ? describe(item.dataset.of[item.dataIndex]) : "" } } },
    },
  });
}

function drawStorage() {
  const schemes = [...new Set(data.storage.map((p) => p.scheme))];
  scatter("storage-maps", "shadow maps", "storage factor S", schemes.map((scheme, i) => ({
    label: scheme, showLine: true, borderColor: palette[i % palette.length], backgroundColor: palette[i % palette.length],
    data: data.storage.filter((p) => p.scheme === scheme).map((p) => ({ x: p.maps, y: p.S })),
  })), { y: true });
}

function drawPromises() {
  const both = known("promised_aliasing").filter(({ run }) => run.errors.measured_aliasing !== undefined);
  const largest = Math.max(1, ...both.map(({ run }) => run.errors.promised_aliasing));
  scatter("promise", "promised aliasing", "measured aliasing", [
    { label: "runs", data: both.map(({ run }) => ({ x: run.errors.promised_aliasing, y: run.errors.measured_aliasing, run })), backgroundColor: palette[0] },
    { label: "measured = promised", data: [{ x: 0, y: 0 }, { x: largest, y: largest }], showLine: true, pointRadius: 0, borderColor: accent },
  ]);
  const wrong = known("promised_aliasing").filter(({ run }) => run.errors.wrong_or_missed_fraction !== undefined);
  const disobedient = new Set(data.correlation.disobedient);
  const points = (wanted) => wrong.filter(({ i }) => disobedient.has(i) === wanted)
    .map(({ run }) => ({ x: run.errors.promised_aliasing, y: run.errors.wrong_or_missed_fraction, run }));
  scatter("wrong", "promised aliasing", "wrong or missed shadow pixels, fraction", [
    { label: "runs", data: points(false), backgroundColor: palette[0] },
    { label: "disobedient", data: points(true), backgroundColor: palette[1] },
  ]);
  element("correlation").textContent = data.correlation.runs < 3 ? "Too few runs were measured against rays for a correlation." :
    `Rank correlation ${figures(data.correlation.rank)} over ${data.correlation.runs} runs.` +
    (disobedient.size ? ` Disobedient (ranks differ by more than a third): ${[...disobedient].map((i) => data.runs[i].name).join("; ")}.` : "");
}

function drawStages() {
  const stages = ["plan", "select", "cull", "stream", "shadow", "image"];
  new Chart(element("stages"), {
    type: "bar",
    data: {
      labels: data.runs.map(shortName),
      datasets: stages.map((stage, i) => ({ label: stage, data: data.runs.map((run) => run.stages[stage]), backgroundColor: palette[i] })),
    },
    options: { scales: { x: { stacked: true }, y: { stacked: true, title: { display: true, text: "ms" } } } },
  });
}

function drawPath() {
  const longest = Math.max(0, ...data.runs.map((run) => run.frames.length));
  new Chart(element("path"), {
    type: "line",
    data: {
      labels: Array.from({ length: longest }, (_, i) => i),
      datasets: data.runs.map((run, i) => ({
        label: shortName(run), data: run.frames, borderColor: palette[i % palette.length], borderWidth: 1.5, pointRadius: 0, hidden: i >= palette.length,
      })),
    },
    options: {
      interaction: { mode: "nearest", intersect: false },
      scales: { x: { title: { display: true, text: "frame" } }, y: { title: { display: true, text: "ms" }, beginAtZero: true } },
    },
  });
}

function showTable() {
  const settings = [...new Set(data.runs.flatMap((run) => Object.keys(run.settings)))];
  const columns = [
    ["#", (r) => data.runs.indexOf(r) + 1], ["run", (r) => r.name], ...settings.map((key) => [key, (r) => r.settings[key] ?? ""]),
    ["p50 ms", (r) => r.p50], ["p95 ms", (r) => r.p95], ["p99 ms", (r) => r.p99], ["noise", (r) => r.noise],
    ["mean image tri", (r) => r.image_triangles], ["mean shadow tri", (r) => r.shadow_triangles], ["S", (r) => r.storage_factor],
    ...data.errors.map((e) => [e.key, (r) => r.errors[e.key] ?? null]), ["crawl", (r) => r.crawl], ["promise kept", (r) => r.promise_kept ? "yes" : "no"],
  ];
  const table = element("table");
  let order = data.runs.map((_, i) => i);
  const render = () => {
    const onFront = new Set(data.fronts[element("error-kind").value]);
    const body = order.map((i) => {
      const row = document.createElement("tr");
      if (onFront.has(i)) row.className = "front";
      for (const [, value] of columns) {
        const v = value(data.runs[i]);
        row.insertCell().textContent = typeof v === "number" || v === null ? figures(v) : v;
      }
      return row;
    });
    table.tBodies[0].replaceChildren(...body);
  };
  const head = table.createTHead().insertRow();
  table.createTBody();
  columns.forEach(([title, value]) => {
    const cell = document.createElement("th");
    cell.textContent = title;
    cell.title = terms[title] ?? "";
    let ascending = false;
    cell.addEventListener("click", () => {
      ascending = !ascending;
      const compare = (a, b) => typeof a === "number" && typeof b === "number" ? a - b : String(a ?? "").localeCompare(String(b ?? ""), "en", { numeric: true });
      order = [...order].sort((i, j) => (ascending ? 1 : -1) * compare(value(data.runs[i]), value(data.runs[j])));
      render();
    });
    head.append(cell);
  });
  element("error-kind").addEventListener("change", render);
  explain(element("terms"), columns.map(([title]) => title));
  render();
}

function showNoise() {
  const noises = data.runs.map((run) => run.noise).filter((noise) => noise !== null);
  element("noise").textContent = noises.length === 0 ? `Each run was walked once, so the noise of its time is not known; ± ${percent(data.unknown_noise)} is assumed.` :
    `Noise: the medians of a run's repetitions lie within ± ${percent(Math.max(...noises))} (worst run), ` +
    `± ${percent(noises.sort((a, b) => a - b)[Math.floor(noises.length / 2)])} (middle run). ` +
    "A setting meets a budget if its median and its noise do.";
}

function showContext() {
  element("model").textContent = data.model;
  element("sentences").replaceChildren(...data.sentences.map((sentence) => Object.assign(document.createElement("p"), { textContent: sentence })));
  element("run-names").replaceChildren(...data.runs.map((run) => Object.assign(document.createElement("li"), { textContent: shortName(run) })));
  const { recommended } = data;
  if (recommended === null) element("recommended").remove();
  else {
    const run = data.runs[recommended.run];
    const kind = data.errors.find((error) => error.key === recommended.error);
    element("command").textContent = recommended.command;
    element("recommended-why").textContent = `Run ${recommended.run + 1}: ${figures(run.p50)} ms a frame on this machine, ${kind.label}: ` +
      `${figures(run.errors[kind.key])}. Of the runs that noise lets tell apart it is the max accurate that takes at max ` +
      `${figures(recommended.times)} times the frame time of the fastest.`;
  }
  for (const [name, value] of Object.entries(data.context)) {
    element("context").append(
      Object.assign(document.createElement("dt"), { textContent: name }),
      Object.assign(document.createElement("dd"), { textContent: typeof value === "string" ? value : JSON.stringify(value) }));
  }
  for (const [title, file] of [["CSV", data.csv], ["JSON", data.json]]) {
    if (file) element("links").append(Object.assign(document.createElement("a"), { href: file, textContent: title }), " ");
  }
}

const measured = data.errors.filter((e) => known(e.key).length > 0);
for (const kind of measured.length ? measured : data.errors) element("error-kind").add(new Option(kind.label, kind.key));
element("error-kind").value = data.leading_error;
element("error-kind").addEventListener("change", drawErrorTime);
element("log-error").addEventListener("change", drawErrorTime);
element("budget").addEventListener("input", answerBudget);
element("bound").addEventListener("input", answerBound);
showContext();
showNoise();
drawErrorTime();
drawMaps();
drawCells();
drawStorage();
drawPromises();
drawStages();
drawPath();
showPrices();
showPictures();
showTable();
document.documentElement.dataset.ready = "yes";
