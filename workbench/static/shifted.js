// What was measured, moved along its axis for looking: what the prediction has at the places where it stands then, and what is left there.

// Where a path turns back for good: by less than this share of its length along the axis it only trembles.
const TURN = 0.02;

// Indices [0, ..., length] between which a path goes one way.
export function ways(x) {
  let low = Infinity,
    high = -Infinity;
  for (const v of x) {
    if (v < low) low = v;
    if (v > high) high = v;
  }
  const least = TURN * (high - low),
    found = [0];
  let way = 0,
    far = 0;
  for (let i = 1; i < x.length; i++) {
    if (way === 0 ? Math.abs(x[i] - x[0]) > least : way * (x[i] - x[far]) >= 0) {
      if (way === 0) way = Math.sign(x[i] - x[0]);
      far = i;
    } else if (way !== 0 && way * (x[far] - x[i]) > least) {
      found.push(far);
      way = -way;
      far = i;
    }
  }
  return [...found, x.length];
}

// The values over x at x + shift, way by way; NaN beyond the ends of a way.
export function moved(x, values, shift) {
  const found = new Float32Array(x.length).fill(NaN),
    turns = ways(x);
  for (let k = 0; k + 1 < turns.length; k++) {
    const from = turns[k],
      // A way ends where the next one begins.
      to = Math.min(turns[k + 1], x.length - 1),
      up = x[to] >= x[from] ? 1 : -1;
    // As far as the path has come, for one that trembles.
    const reached = new Float64Array(to - from + 1);
    for (let i = from; i <= to; i++) reached[i - from] = Math.max(up * x[i], i > from ? reached[i - from - 1] : -Infinity);
    let j = 0;
    // One after the other along the way: a pointer goes on with them.
    for (let i = from; i < turns[k + 1]; i++) {
      const at = up * (x[i] + shift);
      while (j > 0 && reached[j] > at) j--;
      while (j + 2 < reached.length && reached[j + 1] < at) j++;
      const size = reached[j + 1] - reached[j],
        share = size > 0 ? (at - reached[j]) / size : 0;
      // In single precision ends are met within a thousandth of a step.
      if (!(share >= -1e-3 && share <= 1.001)) continue;
      found[i] = values[from + j] + share * (values[from + j + 1] - values[from + j]);
    }
  }
  return found;
}

// ``noise``: one number, or one for each sample.
export function shifted(x, measured, predicted, noise, shift) {
  const there = moved(x, predicted, shift),
    sigma = typeof noise === "number" ? () => noise : (i) => noise[i];
  return { x: x.map((v) => v + shift), predicted: there, residual: measured.map((v, i) => (v - there[i]) / Math.max(sigma(i), 1e-300)) };
}

// Root mean square without what is not known, and without samples that stand far off.
export function rms(values, aside = []) {
  const off = new Set(aside);
  let sum = 0,
    count = 0;
  values.forEach((v, i) => {
    if (v !== v || off.has(i)) return;
    sum += v * v;
    count++;
  });
  return Math.sqrt(sum / count);
}
