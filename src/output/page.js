// Values of curves under the pointer, on plots with `data-x` and `data-y`, and figures as large as the window. Pages are well-formed
// XML, so that neither an ampersand nor the sign for less stands here.
"use strict";
(() => {
  // A number as exact as a tenth of a pixel is, and a few digits.
  const told = (value, size, unit) => {
    const step = 10 ** Math.floor(Math.log10(Math.abs(size) / 500));
    const number = Number((Math.round(value / step) * step).toPrecision(6));
    return String(number).replace("-", "−") + (unit ? " " + unit : "");
  };
  // The height of a path at a place; null where it is not drawn.
  const height = (data, x) => {
    for (const run of data.split("M").slice(1)) {
      const numbers = run.match(/-?\d+/g).map(Number);
      let [from, y] = numbers;
      for (let k = 2; numbers.length > k; k += 2) {
        const [across, down] = [numbers[k], numbers[k + 1]];
        if (0 >= (x - from) * (x - from - across)) return y + (across ? (down * (x - from)) / across : 0);
        [from, y] = [from + across, y + down];
      }
    }
    return null;
  };
  const axis = (text) => {
    const [from, to, ...unit] = text.split(" ");
    return { from: Number(from), size: to - from, unit: unit.join(" ") };
  };
  const readable = (svg, plot) => {
    const reading = svg.parentElement.insertBefore(document.createElement("p"), svg.nextSibling);
    reading.className = "reading";
    reading.textContent = "Values stand here while the pointer is on the diagram.";
    const mark = plot.appendChild(document.createElementNS(plot.namespaceURI, "path"));
    mark.setAttribute("stroke", "#6e6e6e");
    mark.setAttribute("stroke-width", "6");
    const [s, value] = [axis(plot.dataset.x), axis(plot.dataset.y)];
    svg.addEventListener("pointermove", (event) => {
      const box = plot.viewBox.baseVal;
      const x = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse()).x;
      const share = (x - box.x) / box.width;
      if (0 > share || share > 1) return;
      const words = [...plot.querySelectorAll("g")].reverse().map((curve) => {
        const y = curve.firstElementChild ? height(curve.firstElementChild.getAttribute("d"), x) : null;
        const up = (box.y + box.height - y) / box.height;
        return curve.dataset.name + ": " + (y === null ? "–" : told(value.from + up * value.size, value.size, value.unit));
      });
      reading.textContent = ["s = " + told(s.from + share * s.size, s.size, s.unit), ...words].join("; ");
      mark.setAttribute("d", "M" + x + " " + box.y + "v" + box.height);
    });
  };
  const enlarge = (figure) => {
    document.querySelectorAll("figure.large").forEach((other) => other === figure || other.classList.remove("large"));
    if (figure) figure.classList.toggle("large");
  };
  document.documentElement.className = "live";
  document.addEventListener("keydown", (event) => event.key === "Escape" ? enlarge(null) : null);
  document.querySelectorAll("figure > svg").forEach((svg) => {
    svg.setAttribute("tabindex", "0");
    svg.addEventListener("click", () => enlarge(svg.parentElement));
    svg.addEventListener("keydown", (event) => event.key === "Enter" ? enlarge(svg.parentElement) : null);
    svg.querySelectorAll("svg[data-x]").forEach((plot) => readable(svg, plot));
  });
})();
