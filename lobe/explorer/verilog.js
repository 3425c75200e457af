// The lobe on screen in hardware: a module around burnish_lobe of rtl/, with the exponent's constants.

const UNITS = { taylor: 0, shift7: 1, shift3: 2, energy: 3 };
const SLOPE_UNIT = 4;
const NARROW = 128; // from this exponent on the port takes 1 - cosine

/** 2 zeta = slope / 2^shift, as burnish_lobe_q15_from_zeta. */
export function slopeOf(zeta) {
  const zetaQ16 = Math.round(zeta * 65536);
  let shift = 15;
  let slope = zetaQ16;
  while (slope > 0xffff) {
    --shift;
    slope = Math.floor((zetaQ16 + Math.floor(0x4000 / 2 ** shift)) / 2 ** (15 - shift));
  }
  return { slope, shift };
}

function exponentPort({ fit, exponent, zeta }) {
  const unit = UNITS[fit];
  if (unit !== undefined && Number.isInteger(exponent) && exponent <= 1023) {
    return [unit, `10'd${exponent}`, `n = ${exponent}`];
  }
  const { slope, shift } = slopeOf(zeta);
  return [SLOPE_UNIT, `{4'd${shift}, 16'd${slope}}`, `2 zeta = ${slope} / 2^${shift}`];
}

/** lobe: { fit, order, exponent, zeta, scale } */
export function verilogOf(lobe, name) {
  if (!lobe.zeta) {
    return `// No unit computes ${name}: lobe/rtl has lobes of the family, u to the m.`;
  }
  if (lobe.order > 16) {
    return "// rtl/ has orders 2, 4, 8 and 16.";
  }
  const [unit, port, meaning] = exponentPort(lobe);
  const isNarrow = lobe.exponent >= NARROW;
  const order = unit === 1 || unit === 2 ? 2 : lobe.order;
  return [
    `// ${name} for c^${lobe.exponent}, with burnish_lobe of rtl/: a result per clock`,
    ...(lobe.scale === 1 ? [] : [`// times ${lobe.scale.toPrecision(6)}, which is left to the material's colour`]),
    "module lobe (",
    "    input wire clk,",
    "    input wire enable,",
    isNarrow ? "    input wire [23:0] angle,   // 1 - c in UQ0.24, from burnish_chord" : "    input wire [15:0] angle,   // c in UQ1.15: 16'h8000 is 1",
    "    input wire valid,",
    "    output wire [15:0] value,  // UQ0.16",
    "    output wire value_valid",
    ");",
    `    burnish_lobe #(.UNIT(${unit}), .SQUARINGS(${Math.log2(order)}), .LAMBDA(${Number(isNarrow)}), .ROWS(2)) unit (`,
    `        .clk(clk), .enable(enable), .exponent(${port}), // ${meaning}`,
    "        .angle(angle), .user_in(valid), .value(value), .user_out(value_valid));",
    "endmodule",
  ].join("\n");
}
