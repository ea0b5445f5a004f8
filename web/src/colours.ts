// Maps from 0..1 to colours that colour-blind readers tell apart: viridis for quantities, cividis for what is unsure, blue
// over white to red for what is below or above the middle of its ends.

const VIRIDIS = "440154 482173 433e85 38588c 2d708e 25858e 1e9b8a 2ab07f 52c569 86d549 c2df23 fde725";
const CIVIDIS = "00224e 0f2f6b 35456c 4d566d 626871 777a78 8e8d7a a69f76 bfb36b d9c95a f4df4a fee838";
const BLUE_RED = "053061 2166ac 4393c3 92c5de d1e5f0 f7f7f7 fddbc7 f4a582 d6604d b2182b 67001f";
export const UNSURE = new Set(["deviation", "stress_deviation", "error", "stress_error", "difference"]);
/** Fields whose middle says that nothing has changed. */
const TWO_SIDED = new Set(["fibre_stretch"]);
export const ENTRIES = 256;

/** Red, green, blue and 255 for each of 256 steps. */
export function lookupTable(field: string): Uint8Array<ArrayBuffer> {
  const map = TWO_SIDED.has(field) ? BLUE_RED : UNSURE.has(field) ? CIVIDIS : VIRIDIS;
  const stops = map.split(" ").map(channels);
  const table = new Uint8Array(new ArrayBuffer(4 * ENTRIES));
  for (let i = 0; i < ENTRIES; i++) {
    const along = (i / (ENTRIES - 1)) * (stops.length - 1);
    const low = Math.min(Math.floor(along), stops.length - 2);
    for (let c = 0; c < 3; c++) {
      const share = along - low;
      table[4 * i + c] = Math.round((1 - share) * stops[low]![c]! + share * stops[low + 1]![c]!);
    }
    table[4 * i + 3] = 255;
  }
  return table;
}

/** '#rrggbb' or 'rrggbb' as three numbers from 0 to 255. */
export function channels(colour: string): [number, number, number] {
  const number = parseInt(colour.replace("#", ""), 16);
  return [number >> 16, (number >> 8) & 255, number & 255];
}

/** A number for people: three significant digits, no exponent where it is not needed. */
export function written(value: number): string {
  if (!Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1000 || size < 0.001) return value.toExponential(1);
  return value.toPrecision(3).replace(/(\.\d*?)0+$/, "$1").replace(/\.$/, "");
}
