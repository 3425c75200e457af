// math/burnishArctangent.wgsl: part of burnish, highlights without pow
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// WGSL.
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

// The angle of (x, y) in [-pi, pi], within 1e-6. Vulkan permits an error of 4096 ulp in atan.
fn burnishArctangent(y: f32, x: f32) -> f32 {
    let high = max(abs(x), abs(y));
    let t = min(abs(x), abs(y)) / max(high, 1.0e-37);
    let z = t * t;

                  let odd = ((((0.0080058695 * z - 0.0374396637) * z + 0.0843499963) * z - 0.1351193412) * z + 0.1988725216) * z;
    var angle = ((odd - 0.3332700497) * z + 0.9999994138) * t;
    if (abs(y) > abs(x)) {
        angle = 1.57079633 - angle;
    }
    if (x < 0.0) {
        angle = 3.14159265 - angle;
    }
    if (y < 0.0) {
        angle = -angle;
    }
    return angle;
}
