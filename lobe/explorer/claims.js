// The paper's claims, computed here, each with its verdict.
import { request } from "./request.js";
import { numberOf, parseCsv } from "./csv.js";
import { at } from "./state.js";

// The words of `burnish-lobe claims`, in the order in which they are counted.
const MARKS = {
  holds: ["holds", "✓"], "holds in part": ["part", "≈"], "does not hold": ["fails", "✕"],
  "measured by benchmark": ["elsewhere", "·"], "counted in machine code": ["elsewhere", "·"],
};

const number = (x) => (Math.abs(x) < 1e-13 ? "0" : String(Number(x.toPrecision(4))));
const element = (name, text, className) => Object.assign(document.createElement(name), { textContent: text, className: className ?? "" });

function rangeOf(values) {
  const judged = values.filter(({ judged }) => judged === "1").map(({ value }) => Number(value));
  const [low, high] = [number(Math.min(...judged)), number(Math.max(...judged))];
  return judged.length === 0 ? "" : low === high ? low : `${low} … ${high}`;
}

function tableOf(values) {
  const list = element("dl", "", "values");
  for (const { label, value, judged } of values) {
    const pair = element("div", "", judged === "1" ? "" : "aside");
    pair.append(element("dt", label), element("dd", number(Number(value))));
    list.append(pair);
  }
  return list;
}

function itemOf(rows) {
  const [claim] = rows;
  const values = rows.filter(({ label }) => label !== "");
  const bound = numberOf(claim.bound);
  const [kind, mark] = MARKS[claim.verdict];
  const details = document.createElement("details");
  details.id = `claim-${claim.id}`;
  const summary = element("summary", "", kind);
  const verdict = element("span", mark, "mark");
  verdict.title = claim.verdict;
  verdict.ariaHidden = "true";
  summary.append(verdict, element("span", claim.claim, "what"), element("span", rangeOf(values), "range"), element("span", claim.verdict, "verdict"));
  details.append(summary);
  if (claim.source !== "the paper") {
    details.append(element("p", `Source: ${claim.source}, not the paper`, "source"));
  }
  if (values.length > 0) {
    const asked = claim.relation === "" || bound === null ? "" : `: ${claim.relation} ${number(bound)}`;
    details.append(element("p", `${claim.quantity[0].toUpperCase()}${claim.quantity.slice(1)}${asked}`), tableOf(values));
  }
  if (claim.note) {
    details.append(element("p", claim.note, "note"));
  }
  details.append(element("code", claim.command));
  return details;
}

export async function showClaims() {
  const rows = parseCsv(await request("lobe", { words: ["claims", "--format=csv"] }));
  const claims = rows.reduce((map, row) => map.set(row.id, [...(map.get(row.id) ?? []), row]), new Map());
  const verdicts = [...claims.values()].map(([{ verdict }]) => verdict);
  const counts = Object.keys(MARKS).map((verdict) => [verdict, verdicts.filter((v) => v === verdict).length]).filter(([, count]) => count > 0);
  at("claims-count").textContent = `${verdicts.length} claims, computed just now. ${counts.map(([verdict, count]) => `${count} ${count > 1 ? verdict.replace("holds", "hold").replace("does", "do") : verdict}`).join(", ")}.`;
  at("all-claims").addEventListener("click", () => at("claims").classList.add("is-whole"));
  at("claims").replaceChildren(...[...claims.values()].map(itemOf));
}
