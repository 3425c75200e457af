#!/bin/sh
# The kernels as WebAssembly with SIMD128: test_kernels under node. Skipped (77) without the tools.
# Usage: kernels_wasm.sh SOURCE_DIR SCRATCH
set -eu
for tool in clang-14 wasm-ld-14 node; do
    command -v "$tool" >/dev/null || { echo "skipped: no $tool; scripts/install-deps cross"; exit 77; }
done
[ -d /usr/include/wasm32-wasi ] || { echo "skipped: no wasi-libc; scripts/install-deps cross"; exit 77; }
. "$(dirname "$0")/kernels_sources.sh"
mkdir -p "$2"
# shellcheck disable=SC2046,SC2086
clang-14 --target=wasm32-wasi -msimd128 $flags $(sources "$1") -o "$2/test_kernels.wasm"
cat >"$2/run.mjs" <<'END'
import { readFile } from "node:fs/promises";
import { WASI } from "node:wasi";
const wasi = new WASI({ version: "preview1", args: ["test_kernels"], env: {} });
const module = await WebAssembly.compile(await readFile(process.argv[2]));
const imports = { wasi_snapshot_preview1: wasi.wasiImport };
wasi.start(await WebAssembly.instantiate(module, imports));
END
node --no-warnings "$2/run.mjs" "$2/test_kernels.wasm" | tee "$2/wasm.txt"
grep -q 'instruction sets: scalar wasm' "$2/wasm.txt"
grep -q 'kernels: .* 0 failed' "$2/wasm.txt"
