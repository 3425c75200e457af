// yowasp.mjs: a command of one of YoWASP's npm packages, such as yosys of @yowasp/yosys.
// Usage: node yowasp.mjs PACKAGE COMMAND ARGUMENTS...   It sees of the current folder the files that the arguments name, *.v and
// *.vh, and writes into it. The package is looked for in node_modules of the current folder and of those above.
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
import { readdirSync, readFileSync, statSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { pathToFileURL } from 'node:url';

const [packageName, command, ...args] = process.argv.slice(2);
const found = createRequire(process.cwd() + '/').resolve(packageName);
const { commands } = await import(pathToFileURL(found));
const files = {};
for (const name of readdirSync('.')) {
    if ((/\.vh?$/.test(name) || args.some((argument) => argument.includes(name))) && statSync(name).isFile()) {
        files[name] = readFileSync(name, 'utf8');
    }
}
try {
    const after = await commands[command](args, files);
    for (const [name, content] of Object.entries(after)) {
        if (content !== files[name] && (typeof content === 'string' || content instanceof Uint8Array)) {
            writeFileSync(name, content);
        }
    }
} catch (error) {
    console.error(error.message);
    process.exit(1);
}
