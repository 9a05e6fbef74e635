// SPDX-License-Identifier: BSD-3-Clause
// three.js, then the arrays, then the view.

async function start() {
  try {
    const text = await inflated(elementText("viewer-three"));
    const script = document.createElement("script");
    script.textContent = new TextDecoder().decode(text);
    document.head.append(script);
    const data = JSON.parse(elementText("viewer-data"));
    const arrays = await unpackedArrays(elementText("viewer-arrays"), data.arrays);
    window.tesseraViewer = data.kind === "model" ? new ModelViewer(data, arrays) : new Viewer(data, arrays);
    byId("canvas").dataset.ready = "yes";
  } catch (error) {
    showMessage(`This browser does not show the view: ${error.message}`);
  }
}

start();
