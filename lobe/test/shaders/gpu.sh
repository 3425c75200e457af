#!/bin/sh
# Compares the shaders' values on every installed Vulkan driver. Usage: gpu.sh PROGRAM LOBE_DIR SCRATCH [--all]
#   lavapipe and SwiftShader run on the CPU; drivers without their GPU are skipped
set -eu
program=$1
lobe=$2
scratch=$3
all=${4:-}
here=$lobe/test/shaders
for tool in python3 glslangValidator; do
    command -v "$tool" >/dev/null || { echo "shaders: $tool is missing; run scripts/install-deps shaders"; exit 77; }
done
rm -rf "$scratch"
mkdir -p "$scratch"
"$lobe/scripts/shaders" "$scratch"
"$lobe/scripts/shaders" --half "$scratch/half.glsl"
for shader in cases area sweep light half falloff; do
    glslangValidator -V --target-env vulkan1.1 -I"$scratch" -I"$here" -o "$scratch/$shader.spv" "$here/$shader.comp"
done
glslangValidator -DBURNISH_EXACT -V --target-env vulkan1.1 -I"$scratch" -o "$scratch/falloff_exact.spv" "$here/falloff.comp"
for shader in cases area; do
    glslangValidator -D -e main -S comp -V --target-env vulkan1.1 -I"$scratch" -I"$here" -o "$scratch/${shader}_hlsl.spv" "$here/$shader.hlsl"
done

tried=0
for driver in /usr/share/vulkan/icd.d/*.json /etc/vulkan/icd.d/*.json /usr/lib/chromium/vk_swiftshader_icd.json; do
    [ -e "$driver" ] || continue
    status=0
    VK_ICD_FILENAMES=$driver "$program" "$scratch" "$lobe/test/data/lobes.csv" "$lobe/test/data/area.csv" $all || status=$?
    case $status in
    0) tried=$((tried + 1)) ;;
    77) ;;
    *) echo "FAILED with $driver"; exit 1 ;;
    esac
done
[ "$tried" -gt 0 ] || { echo "shaders: no Vulkan driver runs; run scripts/install-deps shaders"; exit 77; }
echo "shaders: $tried drivers"
