// The page's state, kept in its address.

export const at = (id) => document.getElementById(id);

export const DEFAULTS = {
  mesh: ":teapot", fit: "energy", order: "2", n: "40", against: "power", look: "lobes", equation: "blinn", resolution: "960,720",
  view: "split", divider: "31", azimuth: "0", elevation: "0", zoom: "1", language: "glsl",
  boxx: "-0.75", boxy: "1.5", boxw: "1.1", boxh: "0.8",
};
export const NUMBERS = { n: [1, 65536], divider: [0, 100], azimuth: [-36000, 36000], elevation: [-110, 70], zoom: [0.05, 50],
  boxx: [-2.2, 2.2], boxy: [0.2, 1.9], boxw: [0.1, 2.5], boxh: [0.1, 2.5] };
export const WITHOUT_ORDER = ["schlick", "gx", "gaussian", "power", "shift7", "shift3"];
export const ONE_ORDER = ["shift7", "shift3"];

// An address may choose only what its element offers.
const isOffered = (id, value) => [...at(id).querySelectorAll("option, button")].some((choice) => choice.value === value);

function stateOfAddress() {
  const found = { ...DEFAULTS };
  for (const [key, value] of new URLSearchParams(location.hash.slice(1))) {
    if (key in NUMBERS ? Number(value) >= NUMBERS[key][0] && Number(value) <= NUMBERS[key][1] : key in DEFAULTS && isOffered(key, value)) {
      found[key] = value;
    }
  }
  return found;
}

/** The highest order of an exponent. */
export const mostOrder = (n) => Math.max(2, Number(n));

/** Lowers an order that is too high for the exponent. */
export function settleOrder(state) {
  while (Number(state.order) > mostOrder(state.n)) {
    state.order = String(Number(state.order) / 2);
  }
}

export const state = stateOfAddress();
settleOrder(state);

/** The name of the reader's own mesh, which is not in the address. */
export const own = { mesh: null };

export function addressOfState() {
  const changed = Object.entries(state).filter(([key, value]) => value !== DEFAULTS[key] && !(key === "mesh" && own.mesh));
  const parameters = new URLSearchParams(changed);
  return parameters.size > 0 ? `#${parameters.toString().replaceAll("%3A", ":").replaceAll("%2C", ",")}` : location.pathname;
}

export const lobeOf = ({ fit, order }) => (WITHOUT_ORDER.includes(fit) ? fit : `${fit}:${order}`);

export const clamp = (x, [low, high]) => Math.min(high, Math.max(low, x));

/** Shows a one-line error; "" clears it. */
export const show = (message, id = "error") => (at(id).textContent = message);
