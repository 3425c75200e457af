/** Rows of CSV with a heading, as objects; numbers as text, "" where there is none. */
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

/** A number, or null where there is none. */
export const numberOf = (text) => (text === "" ? null : Number(text));
