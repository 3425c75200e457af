// Curves over the angle and over the exponent, with uPlot.
import uPlot from "./uplot.js";

const color = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const FONT = "12px ui-monospace, Menlo, Consolas, monospace";
const HEIGHT = 210;

function axis(format) {
  return {
    stroke: () => color("--soft"), font: FONT, size: 52, gap: 6, values: (u, ticks) => ticks.map((tick) => (tick === null ? "" : format(tick))),
    grid: { stroke: () => color("--line"), width: 1 }, ticks: { show: false },
  };
}

// On a logarithmic axis 1, 2, 5, 10 ... are enough.
const round = (steps) => (u, i, low, high) =>
  Array.from({ length: 8 }, (_, k) => steps.map((step) => step * 10 ** (k - 2))).flat().filter((tick) => tick >= low * 0.999 && tick <= high * 1.001);

const short = (y) => String(Number(y.toPrecision(3)));
const line = (name, dash) => ({ stroke: () => color(name), width: 2, dash, points: { show: false }, spanGaps: true });
const LOBE = line("--lobe");
const OTHER = line("--other", [6, 4]);
const POWER = { ...line("--soft", [2, 3]), width: 1.5 };

/** One plot: id of its element, series, ranges, formats; `read` formats the numbers at the pointer for the caption. */
function plot({ id, series, x, y, isLogarithmic = false, marks = () => null }) {
  const element = document.getElementById(id);
  const reading = element.parentElement.querySelector(".reading");
  const curve = new uPlot({
    width: Math.max(200, element.clientWidth), height: HEIGHT, padding: [10, 8, 0, 0], legend: { show: false },
    cursor: { y: false, points: { size: 7 }, drag: { x: false, y: false } },
    scales: { x: { time: false, range: x.range, distr: isLogarithmic ? 3 : 1 }, y: { range: y.range, distr: y.isLogarithmic ? 3 : 1 } },
    axes: [{ ...axis(x.format), size: 34, ...(isLogarithmic && { splits: round([1]) }) }, { ...axis(y.format), ...(y.isLogarithmic && { splits: round([1, 2, 5]) }) }],
    series: [{}, ...series],
    hooks: {
      draw: [(u) => {
        const value = marks();
        if (value === null) {
          return;
        }
        const left = Math.round(u.valToPos(value, "x", true));
        u.ctx.save();
        u.ctx.strokeStyle = color("--soft");
        u.ctx.lineWidth = devicePixelRatio;
        u.ctx.setLineDash([]);
        u.ctx.beginPath();
        u.ctx.moveTo(left, u.bbox.top);
        u.ctx.lineTo(left, u.bbox.top + u.bbox.height);
        u.ctx.stroke();
        u.ctx.restore();
      }],
      setCursor: [(u) => {
        const i = u.cursor.idx;
        const values = i === null || i === undefined ? [] : u.data.slice(1, 3).map((curve) => curve[i]);
        reading.textContent = values.some(Number.isFinite) ? `${x.read(u.data[0][i])}: ${values.map((v) => (Number.isFinite(v) ? y.read(v) : "–")).join("  ")}` : "";
      }],
    },
  }, [[1, 2], ...series.map(() => [null, null])], element);
  const resize = () => curve.setSize({ width: element.clientWidth, height: HEIGHT });
  new ResizeObserver(resize).observe(element);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", resize);
  return curve;
}

const reach = (least) => (u, low, high) => {
  const most = Math.max(Math.abs(low ?? 0), Math.abs(high ?? 0), least) * 1.12;
  return [-most, most];
};
const decade = (least) => (u, low, high) => [Math.max(least, (low || 1) * 0.8), (high || 90) * 1.25];

export function makeCurves() {
  let end = 90;
  let exponent = 1;
  const degrees = (a) => `${short(a)}°`;
  const angle = { range: () => [0, end], format: degrees, read: (a) => `${a.toFixed(1)}°` };
  const power = { range: () => [1, 4096], format: String, read: (n) => `n ${n < 10 ? n.toFixed(1) : n.toFixed(0)}` };
  const over = (id, series, y) => plot({ id, series, y, x: power, isLogarithmic: true, marks: () => Math.min(exponent, 4096) });
  const value = plot({ id: "plot-value", series: [LOBE, OTHER, line("--overlay")], x: angle,
    y: { range: [0, 1.03], format: (v) => v.toFixed(1), read: (v) => v.toFixed(3) } });
  const error = plot({ id: "plot-error", series: [LOBE, OTHER, line("--overlay")], x: angle,
    y: { range: reach(1e-4), format: (v) => (v === 0 ? "0" : v.toFixed(3)), read: (v) => v.toFixed(4) } });
  const largest = over("plot-largest", [LOBE, OTHER], { range: (u, low, high) => [0, Math.max(1e-3, high ?? 0) * 1.12], format: short, read: (v) => v.toFixed(4) });
  const energy = over("plot-energy", [LOBE, OTHER], {
    range: (u, low, high) => [Math.min(95, (low ?? 100) - 2), Math.max(105, (high ?? 100) + 2)], format: (v) => `${short(v)}%`, read: (v) => `${v.toFixed(1)} %` });
  const width = over("plot-width", [LOBE, OTHER, POWER], { range: decade(0.1), isLogarithmic: true, format: degrees, read: (v) => `${v.toFixed(2)}°` });
  const boundary = over("plot-boundary", [LOBE, OTHER, POWER], { range: decade(0.1), isLogarithmic: true, format: degrees, read: (v) => `${v.toFixed(2)}°` });

  return {
    /** Values at angles in degrees; overlay: an array of them, or null. */
    overAngle(angles, lobe, other, power, overlay) {
      end = angles.at(-1);
      const side = (minus) => [angles, lobe.map(minus), other.map(minus), angles.map((_, i) => (Number.isFinite(overlay?.[i]) ? minus(overlay[i], i) : null))];
      value.setData(side((v) => v));
      error.setData(side((v, i) => v - power[i]));
    },
    /** Rows of `burnish-lobe table` over the exponent, of lobe, other and power. */
    overExponent(n, lobe, other, power) {
      largest.setData([n, lobe.error, other.error]);
      energy.setData([n, lobe.energy, other.energy]);
      width.setData([n, lobe.half, other.half, power.half]);
      boundary.setData([n, lobe.boundary, other.boundary, power.boundary]);
    },
    setExponent(n) {
      exponent = n;
      [largest, energy, width, boundary].forEach((curve) => curve.redraw(false));
    },
  };
}
