// yosys.mjs: the yosys of the npm package @yowasp/yosys as a command, for rtl/test/netlists.
// Usage: node yosys.mjs ARGUMENTS OF YOSYS   It sees and writes the files of the current folder only, *.v and *.vh.
// The package is looked for in node_modules of the current folder and of those above.
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
import { readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { pathToFileURL } from 'node:url';

const found = createRequire(process.cwd() + '/').resolve('@yowasp/yosys');
const { runYosys } = await import(pathToFileURL(found));
const files = {};
for (const name of readdirSync('.')) {
    if (/\.vh?$/.test(name)) {
        files[name] = readFileSync(name, 'utf8');
    }
}
try {
    const after = await runYosys(process.argv.slice(2), files);
    for (const [name, content] of Object.entries(after)) {
        if (content !== files[name] && (typeof content === 'string' || content instanceof Uint8Array)) {
            writeFileSync(name, content);
        }
    }
} catch (error) {
    console.error(error.message);
    process.exit(1);
}
