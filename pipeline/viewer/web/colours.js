// SPDX-License-Identifier: BSD-3-Clause
// Which colour a triangle has, and the legend that says so.
//
// A colouring is a cell array and what its numbers mean: { array, label, names } tells kinds apart, and
// { array, label, scale } shows a quality, from 0 to 1 in steps of 1/250. Another cell array needs no more
// than another entry in the list of colourings that the page is written with.

const UNKNOWN_QUALITY = 255;
const QUALITY_STEPS = 250;
const GREY = [150, 155, 160];
const PICKED = [255, 140, 0];
const MOST_IN_LEGEND = 24;

function rgbOf(text) {
  return [1, 3, 5].map((i) => parseInt(text.slice(i, i + 2), 16));
}

function mixed(a, b, share) {
  return a.map((x, i) => Math.round((1 - share) * x + share * b[i]));
}

// The colour of each value of a colouring.
function coloursOf(colouring, palette) {
  if (!colouring.scale) {
    const colours = (colouring.colours ?? palette).map(rgbOf);
    return (value) => colours[value % colours.length];
  }
  const scale = colouring.scale.map(rgbOf);
  return (value) => {
    if (value === UNKNOWN_QUALITY) return GREY;
    return scale[Math.min(scale.length - 1, Math.floor((value / QUALITY_STEPS) * scale.length))];
  };
}

function nameOfValue(colouring, value) {
  return colouring.names?.[value] || `${colouring.label} ${value}`;
}

function legendItem(colour, text) {
  const item = document.createElement("li");
  const swatch = document.createElement("span");
  swatch.className = "swatch";
  swatch.style.background = `rgb(${colour.join(",")})`;
  item.append(swatch, text);
  return item;
}

// What is there, each once; of many kinds the first ones.
function legendOf(colouring, values, palette) {
  const colourOf = coloursOf(colouring, palette);
  if (colouring.scale) {
    const bins = colouring.scale.length;
    const items = colouring.scale.map((colour, bin) =>
      legendItem(rgbOf(colour), `${(bin / bins).toFixed(1)}–${((bin + 1) / bins).toFixed(1)}`));
    if (values.includes(UNKNOWN_QUALITY)) items.push(legendItem(GREY, "not read"));
    return items;
  }
  const kinds = [...new Set(values)].sort((a, b) => a - b);
  const items = kinds.slice(0, MOST_IN_LEGEND)
    .map((kind) => legendItem(colourOf(kind), nameOfValue(colouring, kind)));
  if (kinds.length > MOST_IN_LEGEND) {
    const rest = document.createElement("li");
    rest.textContent = `and ${kinds.length - MOST_IN_LEGEND} more; colours repeat`;
    items.push(rest);
  }
  return items;
}
