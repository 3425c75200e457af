#!/bin/sh
# The kernels as WebAssembly with SIMD128: test_kernels and test_kernel_values under node. Skipped (77) without the tools.
# Usage: kernels_wasm.sh SOURCE_DIR SCRATCH
set -eu
for tool in clang-14 wasm-ld-14 node; do
    command -v "$tool" >/dev/null || { echo "skipped: no $tool; scripts/install-deps cross"; exit 77; }
done
[ -d /usr/include/wasm32-wasi ] || { echo "skipped: no wasi-libc; scripts/install-deps cross"; exit 77; }
. "$(dirname "$0")/kernels_sources.sh"
mkdir -p "$2"
cat >"$2/run.mjs" <<'END'
import { readFile } from "node:fs/promises";
import { WASI } from "node:wasi";
const wasi = new WASI({ version: "preview1", args: ["test"], env: {} });
const module = await WebAssembly.compile(await readFile(process.argv[2]));
const imports = { wasi_snapshot_preview1: wasi.wasiImport };
wasi.start(await WebAssembly.instantiate(module, imports));
END
mkdir -p "$2/objects"
rm -f "$2"/objects/*
compiler="clang-14 --target=wasm32-wasi -msimd128"
(cd "$2/objects" && $compiler $flags $(built_isas wasm) -c $(includes "$1") $(kernel_sources "$1") &&
    compile_isa "$compiler" "$1" wasm shading)
for name in kernels kernel_values; do
    $compiler $flags $(includes "$1") "$1"/test/*/test_"$name".c "$2"/objects/*.o -o "$2/test_$name.wasm"
    node --no-warnings "$2/run.mjs" "$2/test_$name.wasm" | tee "$2/$name.txt"
    grep -q "^$name: .* 0 failed" "$2/$name.txt"
done
grep -q 'instruction sets: scalar wasm' "$2/kernels.txt"
