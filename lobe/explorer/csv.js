/** Rows of CSV with a header, as objects; numbers as text, "" if missing. */
export function parseCsv(text) {
  const rows = [[]];
  for (const [, quoted, plain, end] of text.matchAll(/(?:"((?:[^"]|"")*)"|([^",\n]*))(,|\n|$)/g)) {
    rows.at(-1).push(quoted === undefined ? plain : quoted.replaceAll('""', '"'));
    if (end === "\n") {
      rows.push([]);
    }
  }
  const [keys, ...others] = rows;
  return others.filter((row) => row.length === keys.length).map((row) => Object.fromEntries(keys.map((key, i) => [key, row[i]])));
}

/** A number, or null if missing. */
export const numberOf = (text) => (text === "" ? null : Number(text));
