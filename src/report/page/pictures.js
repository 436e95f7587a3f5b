"use strict";
// The pictures of the runs. Uses the functions of page.js.

/// Shows the picture of a run on the left and its reference on the right, if the page contains them.
function lookAt(run) {
  const place = (kind) => data.pictures.findIndex((picture) => run && picture.run === run.name && picture.kind === kind);
  for (const [side, index] of [["left", place("picture")], ["right", place("reference")]]) {
    if (index < 0) continue;
    element(`${side}-picture`).value = index;
    element(`${side}-picture`).dispatchEvent(new Event("change"));
  }
}

function showPictures() {
  if (data.pictures.length === 0) return void element("pictures-section").remove();
  for (const side of ["left", "right"]) {
    const select = element(`${side}-picture`);
    data.pictures.forEach((picture, i) => select.add(new Option(`${picture.run}: ${picture.kind}`, i)));
    select.value = side === "left" ? 0 : data.pictures.length - 1;
    const show = () => { element(`${side}-image`).src = data.pictures[select.value].src; };
    select.addEventListener("change", show);
    show();
  }
  const slide = () => {
    const percent = element("slider").value;
    element("left-image").style.clipPath = `inset(0 ${100 - percent}% 0 0)`;
    element("divider").style.left = `${percent}%`;
  };
  element("slider").addEventListener("input", slide);
  slide();
}

/// Returns up to three runs with a picture: the fastest run, the run of the Pareto front whose time is nearest to the
/// geometric mean of both others, and the most accurate run (the fastest of equally accurate runs).
function threePrices() {
  const key = data.leading_error;
  const runs = data.runs.filter((run) => run.errors[key] !== undefined &&
    data.pictures.some((picture) => picture.run === run.name && picture.kind === "picture")).sort((a, b) => a.p50 - b.p50);
  if (runs.length === 0) return [];
  const [fastest] = runs;
  const best = runs.reduce((a, b) => b.errors[key] < a.errors[key] ? b : a);
  const middle = Math.sqrt(fastest.p50 * best.p50);
  const far = (run) => Math.abs(Math.log(run.p50 / middle));
  const between = data.fronts[key].map((i) => data.runs[i]).filter((run) => runs.includes(run) && run !== fastest && run !== best)
    .sort((a, b) => far(a) - far(b)).slice(0, 1);
  return [fastest, ...between, best].filter((run, i, all) => all.indexOf(run) === i);
}

function showPrices() {
  const runs = threePrices();
  if (runs.length < 2) return void element("prices-section").remove();
  const key = data.leading_error;
  element("prices-count").textContent = runs.length === 2 ? "two" : "three";
  element("prices").replaceChildren(...runs.map((run) => {
    const figure = document.createElement("figure");
    const image = document.createElement("img");
    image.src = data.pictures.find((picture) => picture.run === run.name && picture.kind === "picture").src;
    image.alt = run.name;
    const caption = document.createElement("figcaption");
    const price = Object.assign(document.createElement("strong"), { textContent: `${figures(run.p50)} ms` });
    caption.append(price, ` per frame, ${titles[key]}: ${figures(scaled(key, run.errors[key]))}. Run ${numberOf(run)}: ${shortName(run)}`);
    figure.append(image, caption);
    return figure;
  }));
}
