// SPDX-License-Identifier: BSD-3-Clause
// Small parts of the panel beside the view.

function byId(id) {
  return document.getElementById(`viewer-${id}`);
}

function buttonOf(text, title, onClick) {
  const button = document.createElement("button");
  button.type = "button";
  button.textContent = text;
  button.title = title;
  button.addEventListener("click", onClick);
  return button;
}

function optionOf(value, text) {
  const option = document.createElement("option");
  option.value = value;
  option.textContent = text;
  return option;
}

async function copyText(text) {
  try {
    await navigator.clipboard.writeText(text);
  } catch {  // In a frame, or a page without that right.
    const area = document.createElement("textarea");
    area.value = text;
    document.body.append(area);
    area.select();
    document.execCommand("copy");
    area.remove();
  }
}

// Buttons that copy the text of an element.
function enableCopies() {
  for (const button of document.querySelectorAll("#viewer [data-copies]")) {
    button.addEventListener("click", async () => {
      await copyText(document.getElementById(button.dataset.copies).textContent);
      button.textContent = "Copied";
      setTimeout(() => { button.textContent = "Copy"; }, 1200);
    });
  }
}

function showMessage(text) {
  byId("message").textContent = text;
  byId("message").hidden = false;
}

// With spaces between thousands, or in thousands and millions where that is enough.
function countText(count) {
  if (count < 1e5) return Math.round(count).toLocaleString("en");
  return count < 1e6 ? `${Math.round(count / 1e3)} thousand` : `${(count / 1e6).toPrecision(3)} million`;
}
