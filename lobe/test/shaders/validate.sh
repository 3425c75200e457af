#!/bin/sh
# Validates the shaders with their languages' own tools. Usage: validate.sh LOBE_DIR SCRATCH
#   glslang compiles GLSL 330, 450, ES 300 and HLSL; spirv-val checks the result; spirv-cross turns it into HLSL, Metal and
#   ES 300, which glslang compiles again. With BURNISH_EXACT no addition of a product may be fused. If npm can install it,
#   Dawn compiles the WGSL and runs it on SwiftShader
set -eu
lobe=$1
scratch=$2
here=$lobe/test/shaders
for tool in python3 glslangValidator spirv-val spirv-opt spirv-dis spirv-cross; do
    command -v "$tool" >/dev/null || { echo "shaders: $tool is missing; run scripts/install-deps shaders"; exit 77; }
done
rm -rf "$scratch"
mkdir -p "$scratch"
cd "$scratch"
shaders=$PWD/split
failed=0

# says WHAT COMMAND...: fails with what the command prints.
says() {
    what=$1
    shift
    "$@" >says.txt 2>&1 && return 0
    failed=$((failed + 1))
    echo "FAILED $what: $*"
    head -n 12 says.txt
    return 0
}

# glsl_shader HEAD FILES..., hlsl_shader FILE: a fragment shader that calls everything, on standard output.
glsl_shader() {
    echo "$1"
    shift
    cat "$@"
    cat <<'END'
in vec3 N; in vec3 L; in vec3 V; in float n;
out vec4 color;
void main() { color = vec4(everyFunction(N, L, V, n)); }
END
}
hlsl_shader() {
    cat "$1"
    sed 's/vec3/float3/g' "$here/every.glsl"
    echo 'float4 main(float3 N : A, float3 L : B, float3 V : C, float n : D) : SV_Target { return everyFunction(N, L, V, n); }'
}

# Every file of one subject alone, with what it includes.
"$lobe/scripts/shaders" "$shaders"
for file in $(cd split && find glsl hlsl -type f); do
    language=${file%%/*}
    if [ "$language" = glsl ]; then
        printf '#version 330\n#extension GL_GOOGLE_include_directive : require\n#include "%s"\nvoid main() {}\n' "$file" >one.frag
        says "$file" glslangValidator -Isplit -G -o one.spv one.frag
    else
        printf '#include "%s"\nfloat4 main() : SV_Target { return 0; }\n' "$file" >one.frag
        says "$file" glslangValidator -Isplit -D -e main -S frag -V -o one.spv one.frag
    fi
done

# The body checked below calls every function.
for function in $(sed -n 's/^[a-z0-9]* \([A-Za-z0-9]*\)(.*{$/\1/p' "$shaders/burnish.glsl"); do
    says "$function is called" sh -c "cat '$here/every.glsl' '$shaders/burnish.glsl' | grep -c '[^a-z].*$function(' | grep -qv '^1\$'"
done

# Everything together: versions of GLSL, and through SPIR-V.
glsl_shader '#version 330' "$shaders/burnish.glsl" "$here/every.glsl" >330.frag
glsl_shader "#version 300 es
precision highp float;" "$shaders/burnish.glsl" "$here/every.glsl" >es300.frag
glsl_shader '#version 450
#define BURNISH_EXACT' "$shaders/burnish.glsl" "$here/every.glsl" | sed 's/^in vec3 N.*/layout(location = 0) in vec3 N; layout(location = 1) in vec3 L; layout(location = 2) in vec3 V; layout(location = 3) in float n;/; s/^out/layout(location = 0) out/' >450.frag
hlsl_shader "$shaders/burnish.hlsl" >plain.hlsl
{ echo '#define BURNISH_EXACT'; cat plain.hlsl; } >exact.hlsl
says "GLSL 330" glslangValidator 330.frag
says "GLSL ES 300" glslangValidator es300.frag
says "GLSL 450" glslangValidator -V -o 450.spv 450.frag
says "HLSL" glslangValidator -D -e main -S frag -V -o plain.spv plain.hlsl
says "HLSL, exact" glslangValidator -D -e main -S frag -V -o exact.spv exact.hlsl
for module in 450 plain exact; do
    says "SPIR-V of $module" spirv-val "$module.spv"
    says "to HLSL" spirv-cross --hlsl --shader-model 50 "$module.spv" --output round.hlsl
    says "and back" glslangValidator -D -e main -S frag -V -o round.spv round.hlsl
    says "to Metal" spirv-cross --msl "$module.spv" --output round.metal
    says "to ES 300" spirv-cross --version 300 --es "$module.spv" --output round.frag
    says "and back" glslangValidator round.frag
done

# Inlined, an add of a product is marked, or a compiler may fuse it.
for module in 450 exact; do
    spirv-opt -O "$module.spv" -o inlined.spv
    spirv-dis inlined.spv -o inlined.txt
    says "precise in $module" python3 "$here/contraction.py" inlined.txt
done

if command -v node >/dev/null && command -v npm >/dev/null; then
    dawn=$scratch.dawn
    [ -d "$dawn/node_modules/webgpu" ] || npm install --silent --no-save --prefix "$dawn" webgpu@0.6 >npm.txt 2>&1 || true
    if [ -d "$dawn/node_modules/webgpu" ]; then
        # WGSL has no includes: LYGIA's tools resolve them
        for file in $(cd split && find wgsl burnish.wgsl -type f); do
            python3 "$here/includes.py" "split/$file" >"$(echo "$file" | tr / _)"
        done
        says "WGSL" node "$here/wgsl.mjs" "$dawn" ./*.wgsl
        VK_ICD_FILENAMES=/usr/lib/chromium/vk_swiftshader_icd.json \
            node "$here/wgsl_values.mjs" "$dawn" "$shaders/burnish.wgsl" "$lobe/test/data/lobes.csv" "$lobe/test/data/area.csv" || failed=$((failed + 1))
    else
        echo "shaders: SKIPPED: WGSL, npm can't get webgpu"
    fi
else
    echo "shaders: SKIPPED: WGSL, no node or npm"
fi
echo "shaders: $failed failed"
[ "$failed" -eq 0 ]
